"""The kernels' instruction sets: chosen at the start, by ROTORDROP_ISA, and what differs between them."""

import json
import os
import platform
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from tests.cli.program import IS_SANITIZED, PARAMS, PROGRAM, ProgramTest

X86 = platform.machine() == "x86_64"


def at_level(level, *arguments):
    return subprocess.run([PROGRAM, *arguments], env={**os.environ, "ROTORDROP_ISA": level}, capture_output=True, text=True)


def levels():
    """Those that this machine has, lowest first."""
    return [level for level in ("base", "v3", "v4", "v4-newton") if at_level(level, "--version").returncode == 0]


class InstructionSets(ProgramTest):
    def test_version_names_the_level_that_was_asked_for(self):
        found = levels()
        self.assertIn("base", found)
        for level in found:
            self.assertIn(f"; instruction set {level})", at_level(level, "--version").stdout)

    def test_default_is_the_fastest_level(self):
        """The highest one; with roots by Newton's method where the maker's take long."""
        environment = {key: value for key, value in os.environ.items() if key != "ROTORDROP_ISA"}
        text = subprocess.run([PROGRAM, "--version"], env=environment, capture_output=True, text=True).stdout
        of_the_rest = [level for level in levels() if level != "v4-newton"]
        is_intel = "GenuineIntel" in Path("/proc/cpuinfo").read_text(encoding="utf-8")
        self.assertEqual(re.search(r"instruction set ([\w-]+)", text)[1], levels()[-1] if is_intel else of_the_rest[-1])

    def test_unknown_level_is_an_input_error(self):
        result = at_level("avx2", "--version")
        self.assertEqual(result.returncode, 2)
        self.assertIn("base, v3, v4, v4-newton", result.stderr)

    def test_levels_agree_until_roundoff_grows(self):
        """Over the first impact (12 ms) an impact multiplies roundoff of 1e-16 by some 1e9: peak force and heat agree to 1e-6."""
        forces, heats = [], []
        for level in levels():
            with tempfile.TemporaryDirectory() as folder:
                result = at_level(level, "run", str(PARAMS / "neisi2019-settling.toml"), "-o", f"{folder}/out", "--set", "run.end_time=12 ms")
                self.assertEqual(result.returncode, 0, result.stderr)
                with open(f"{folder}/out/summary.json", encoding="utf-8") as file:
                    summary = json.load(file)
            forces.append([b["peak_contact_force"] for b in summary["bearings"].values()])
            heats.append(summary["energy"]["heat_deposited"])
        self.assertGreater(forces[0][0], 1000)
        for other, heat in zip(forces[1:], heats[1:]):
            for a, b in zip(forces[0], other):
                self.assertAlmostEqual(a, b, delta=1e-6 * a)
            self.assertAlmostEqual(heats[0], heat, delta=1e-6 * heats[0])

    def test_engines_of_one_level_let_nothing_but_their_factory_out(self):
        """The linker keeps one copy of an inline function: one of a higher level would end the program on an older processor."""
        rooms = Path(PROGRAM).resolve().parent / "src"
        closed = sorted([*rooms.glob("machine/rotordrop_make_lanes_v*.o"), *rooms.glob("bearing/rotordrop_row_kernels_v*.o")])
        if not closed:
            self.skipTest("no engines beside the program")
        self.assertEqual([path.stem for path in closed], [f"rotordrop_{engine}_{level}" for engine in ("row_kernels", "make_lanes")
                                                          for level in ("v3", "v4", "v4_newton")])
        for path in closed:
            symbols = subprocess.run(["nm", "--defined-only", "--extern-only", str(path)], capture_output=True, text=True, check=True).stdout
            named = [line for line in symbols.splitlines() if "DW.ref" not in line]
            self.assertEqual(len(named), 1, symbols)
            self.assertIn(path.stem.removeprefix("rotordrop_"), named[0])

    @unittest.skipUnless(X86 and shutil.which("qemu-x86_64"), "takes an emulator of old processors (qemu-user)")
    @unittest.skipIf(IS_SANITIZED, "sanitizers find no room in an emulator")
    def test_runs_on_a_processor_without_avx(self):
        """Nehalem (2008) ends with an illegal instruction at the first one of a higher level."""
        def emulated(processor, *arguments, **environment):
            return subprocess.run(["qemu-x86_64", "-cpu", processor, PROGRAM, *arguments], env={**os.environ, **environment},
                                  capture_output=True, text=True)

        self.assertIn("; instruction set base)", emulated("Nehalem", "--version").stdout)
        self.assertEqual(emulated("Nehalem", "--version", ROTORDROP_ISA="v3").returncode, 2)
        with tempfile.TemporaryDirectory() as folder:
            result = emulated("Nehalem", "run", str(PARAMS / "neisi2019-settling.toml"), "-o", f"{folder}/out", "--set", "run.end_time=9 ms",
                              "--set", "bearings.ball_model=inertial")
            self.assertEqual(result.returncode, 0, result.stderr)
            study = Path(folder) / "s.toml"
            study.write_text('case = "neisi2019-settling.toml"\nlanes = true\n[vary]\n"contact.friction_coefficient" = [0.1, 0.2]\n'
                             '[design]\nkind = "grid"\n[keep]\nresults = ["bearings.*.peak_contact_force"]\n', encoding="utf-8")
            result = emulated("Nehalem", "study", str(study), "-o", f"{folder}/lanes", "--jobs", "1", "--set", "run.end_time=8.8 ms",
                              "--set", "integration.method=tsitouras", "--set", "integration.tolerance=1e-6")
            self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()

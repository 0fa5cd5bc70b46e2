"""The installed program in a folder that was moved, and a project of its own against it: examples/own-parts, whose physics is computed here a second time.

ROTORDROP_PROGRAM lies in the build folder that is installed from. Skipped with sanitizers, whose options a project of its own does not have.
"""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import BUILD, CACHE, IS_SANITIZED, PROGRAM, SOURCE, page_data  # noqa: E402

sys.path.insert(0, str(SOURCE / "examples"))
from rotordrop_results import Results  # noqa: E402

EXAMPLE = SOURCE / "examples/own-parts"
AMBIENT = 293.15


def call(*command, cwd=None, code=0):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("ROTORDROP_")}
    done = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True, timeout=500, env=environment)
    assert done.returncode == code, f"{command}: {done.returncode}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return done.stdout + done.stderr


@unittest.skipUnless(CACHE, "the program lies in no build folder")
@unittest.skipIf(IS_SANITIZED, "built with sanitizers")
class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory(prefix="rotordrop-install-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        call("cmake", "--install", BUILD, "--prefix", cls.folder / "first")
        cls.prefix = cls.folder / "moved"
        (cls.folder / "first").rename(cls.prefix)
        cls.program = cls.prefix / "bin/rotordrop"


class Program(Installed):
    def test_it_knows_its_version(self):
        self.assertEqual(call(self.program, "--version"), call(PROGRAM, "--version"))

    def test_it_finds_its_own_cases_and_catalogue(self):
        bearings = self.prefix / "share/rotordrop/params/bearings"
        shutil.copy(bearings / "6014.toml", bearings / "only-here.toml")
        call(self.program, "new", "case", cwd=self.folder)
        self.assertEqual((self.folder / "case/reference.toml").read_text(), (self.prefix / "share/rotordrop/params/neisi2019.toml").read_text())
        case = '\n[bearings.TB1]\ncatalogue = "only-here"\n'
        with open(self.folder / "case/drop.toml", "a", encoding="utf-8") as file:
            file.write(case)
        self.assertIn("no errors found", call(self.program, "check", "case/drop.toml", cwd=self.folder))
        self.assertIn("the catalogue has no such bearing", call(PROGRAM, "check", "case/drop.toml", cwd=self.folder, code=2))

    @unittest.skipIf("ROTORDROP_FE:BOOL=OFF" in CACHE, "built without finite elements")
    def test_it_finds_its_own_modules(self):
        case = self.prefix / "share/rotordrop/params/neisi2019-settling.toml"
        arguments = ("run", case, "-o", self.folder / "fe", "--force", "--quiet", "--set", 'thermal.models=["fe"]', "--set", "run.end_time=1 ms")
        call(self.program, *arguments)
        found = sorted(path.name for path in self.prefix.rglob("rotordrop_*.so"))
        self.assertLessEqual({"rotordrop_fe.so", "rotordrop_mesh.so"}, set(found))
        for path in self.prefix.rglob("rotordrop_fe.so"):
            path.rename(path.with_suffix(".away"))
        try:
            self.assertIn("built without the finite-element module", call(self.program, *arguments, code=2))
        finally:
            for path in self.prefix.rglob("rotordrop_fe.away"):
                path.rename(path.with_suffix(".so"))

    def test_documents_and_examples_are_there(self):
        for name in ("share/doc/rotordrop/README.md", "share/doc/rotordrop/docs/tutorials/guide.md", "share/doc/rotordrop/LICENSE", "share/rotordrop/examples/plot_drop.py", "share/rotordrop/examples/own-parts/CMakeLists.txt"):
            self.assertTrue((self.prefix / name).is_file(), name)

    def test_no_header_needs_one_that_is_not_installed(self):
        include = self.prefix / "include/rotordrop"
        headers = list(include.rglob("*.h"))
        self.assertGreater(len(headers), 60)
        for header in headers:
            for name in re.findall(r'#include "([^"]+)"', header.read_text()):
                self.assertTrue((include / name).is_file(), f"{header.name} includes {name}")


class OwnParts(Installed):
    """The third thermal model and the support of examples/own-parts."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        build = cls.folder / "build"
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        call("cmake", "-S", EXAMPLE, "-B", build, f"-DCMAKE_PREFIX_PATH={cls.prefix}", *launcher)
        call("cmake", "--build", build, "--parallel", "2")
        cls.own, cls.module = build / "own-parts", build / "own-parts.so"
        cls.case = cls.prefix / "share/rotordrop/examples/own-parts/own-parts.toml"
        cls.fine = cls.folder / "fine.toml"
        cls.fine.write_text(f'base = "{cls.case}"\n[output]\ninterval = "5 us"\n')
        cls.printed = call(cls.own, cls.fine, cls.folder / "out", "wall")
        cls.run_ = Results(cls.folder / "out")
        cls.addClassCleanup(cls.run_.close)
        cls.snubber = cls.run_.bearing("SNUBBER")
        cls.parameters = {"K": 1.1e9, "n": 10 / 9, "lambda": 0.08, "mu": 0.1, "m": 2.0, "k": 2e7, "c": 4e3, "gap": 300e-6, "r": 0.06}

    @unittest.skipIf("clang++" in CACHE, "no variables are shared by this compiler")
    def test_a_module_keeps_its_inline_variables_to_itself(self):
        """GCC would make each of them one for all modules of a process that have one of its name."""
        flags = [path.read_text() for path in (self.folder / "build").rglob("flags.make")]
        self.assertGreater(len(flags), 0)
        for one in flags:
            self.assertIn("-fno-gnu-unique", one)

    def test_a_version_that_does_not_fit_is_refused(self):
        project = self.folder / "newer"
        project.mkdir()
        (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(newer LANGUAGES C CXX)\nfind_package(rotordrop 7.0 REQUIRED)\n")
        self.assertIn("requested version", call("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}", code=1))

    def test_every_joule_is_found(self):
        residual = float(re.search(r"energy \[J\]: .* residual (\S+)", self.printed)[1])
        # As the reference cases: the integrator's tolerance leaves some 1e-6 of 330 J.
        self.assertLess(abs(residual), 1e-4)
        for model in ("lumped", "wall"):
            heat = float(re.search(rf"model {model}: .* residual (\S+)", self.printed)[1])
            self.assertLess(abs(heat), 1e-6, f"{model}: roundoff")
        self.assertGreater(self.run_.series("/energy/wall_heat_stored").values[-1], 200)

    def test_the_snubber_pushes_as_hunt_and_crossley_say(self):
        p = self.parameters
        orbit, bush, force = self.snubber["orbit"], self.snubber["bush_position"], self.snubber["normal_force"]
        e = orbit.values - bush.values
        delta = np.hypot(*e.T) - p["gap"]
        self.assertGreater((delta > 0).sum(), 100, "it is touched")
        self.assertTrue(np.all(force.values[delta <= 0] == 0))
        rate = np.gradient(delta, force.time)
        inside = np.convolve(delta > 0, np.ones(3), "same") == 3  # where differences of neighbours are the rate
        expected = np.maximum(p["K"] * np.maximum(delta, 0) ** p["n"] * (1 + 1.5 * p["lambda"] * rate), 0)
        # Differences over 10 us of a force that rises and falls within 1 ms.
        np.testing.assert_allclose(force.values[inside], expected[inside], rtol=3e-3, atol=3e-3 * force.values.max())

    def test_the_bush_brakes_the_rotor_and_nothing_else(self):
        p = self.parameters
        normal, friction = self.snubber["normal_force"], self.snubber["friction_force"]
        # Sliding at 95 m/s against a regularisation of 0.05 m/s: full friction.
        np.testing.assert_allclose(friction.values, p["mu"] * normal.values, rtol=1e-5, atol=1e-9)
        spin = self.run_.series("/rotor/spin_speed")
        heat = self.run_.series("/ledger/SNUBBER/bush_friction_heat").values[-1]
        power = friction.values * spin.values * p["r"]
        # The centres' own motion, some 0.3 m/s of 95, and trapezoids over 5 us.
        self.assertAlmostEqual(np.trapezoid(power, spin.time) if hasattr(np, "trapezoid") else np.trapz(power, spin.time), heat, delta=5e-3 * heat)
        self.assertGreater(heat, 1)

    def test_the_bush_moves_as_its_mass_and_mount_say(self):
        p = self.parameters
        orbit, bush = self.snubber["orbit"].values, self.snubber["bush_position"].values
        normal, friction, t = self.snubber["normal_force"].values, self.snubber["friction_force"].values, self.snubber["normal_force"].time
        e = orbit - bush
        n = e / np.maximum(np.hypot(*e.T), 1e-12)[:, None]
        force = normal[:, None] * n + friction[:, None] * np.column_stack([-n[:, 1], n[:, 0]])
        x, v, h = np.zeros(2), np.zeros(2), t[1] - t[0]
        moved = [x]
        for k in range(len(t) - 1):  # implicit midpoint
            f = 0.5 * (force[k] + force[k + 1])
            a = (f - p["k"] * (x + 0.5 * h * v) - p["c"] * v) / (p["m"] + 0.5 * h * p["c"] + 0.25 * h * h * p["k"])
            x, v = x + h * v + 0.5 * h * h * a, v + h * a
            moved.append(x)
        moved = np.array(moved)
        self.assertGreater(abs(bush).max(), 1e-6)
        np.testing.assert_allclose(moved, bush, atol=5e-3 * abs(bush).max())

    def wall_again(self, name):
        """Bore, mean and shaft of a ring by 160 even shells and implicit Euler steps, from the recorded heat."""
        resolved = self.run_.parameters["bearings"][name]
        size = lambda text: float(text.split()[0]) * 1e-3  # noqa: E731
        a, b = (0.5 * size(d) for d in resolved["inner_ring_diameters"])
        width, mass = size(resolved["width"]), float(resolved["ring_mass"].split()[0])
        steel = self.run_.parameters["materials"]["steel"]
        k, c, rho = steel["k"], steel["c"], steel["rho"]
        n = 160
        radii = np.linspace(a, b, n + 1)
        middle = 0.5 * (radii[1:] + radii[:-1])
        around = 2 * math.pi * k * width
        journal = 0.035 - 250e-6
        shaft = rho * c * math.pi * journal**2 * size(resolved.get("shaft_lump_length", resolved["width"]))
        capacity = np.concatenate([[shaft], mass * c * (radii[1:] ** 2 - radii[:-1] ** 2) / (b * b - a * a)])
        half = math.log(middle[0] / a) / around
        link = np.concatenate([[1 / (1 / (4 * math.pi * k * width) + half)], around / np.log(middle[1:] / middle[:-1])])
        flows = np.zeros((n + 1, n + 1))
        for j, g in enumerate(link):
            flows[j, j] -= g
            flows[j, j + 1] += g
            flows[j + 1, j + 1] -= g
            flows[j + 1, j] += g
        heat = {key: self.run_.series(f"/ledger/{name}/{key}").values for key in ("rub_heat", "rub_heat_into_ring", "inner_heat")}
        t = self.run_.series(f"/ledger/{name}/rub_heat").time
        h = t[1] - t[0]
        step = np.linalg.inv(np.diag(capacity) - h * flows)
        T, bores, means = np.zeros(n + 1), [0.0], [0.0]
        for i in range(1, len(t)):
            gained = capacity * T
            into_ring = heat["rub_heat_into_ring"][i] - heat["rub_heat_into_ring"][i - 1]
            gained[0] += heat["rub_heat"][i] - heat["rub_heat"][i - 1] - into_ring
            gained[1] += into_ring
            gained[-1] += heat["inner_heat"][i] - heat["inner_heat"][i - 1]
            T = step @ gained
            bores.append(T[1] + half * (into_ring / h + link[0] * (T[0] - T[1])))
            means.append(capacity[1:] @ T[1:] / capacity[1:].sum())
        return t, np.array(bores), np.array(means), T[0]

    def test_the_wall_conducts_as_a_finer_one_does(self):
        for name in ("TB1", "TB2"):
            with self.subTest(name):
                t, bore, mean, shaft = self.wall_again(name)
                found = self.run_.temperatures(name, "wall")
                bore_found = found["bore"].values - AMBIENT
                # 16 uneven shells against 160 even ones, steps of 5 us, and the outside left out.
                self.assertAlmostEqual(bore_found.max(), bore.max(), delta=0.02 * bore.max())
                self.assertLess(abs(bore_found - bore).max(), 0.05 * bore.max())
                self.assertAlmostEqual(found["inner_ring"].values[-1] - AMBIENT, mean[-1], delta=5e-3 * mean[-1])
                self.assertAlmostEqual(found["shaft"].values[-1] - AMBIENT, shaft, delta=5e-3 * shaft)
                self.assertGreater(bore.max(), 3 * mean.max(), "what the lumped circuit cannot show")

    def test_growth_is_that_of_the_model_that_drives(self):
        felt, wall, lumped = (self.run_.series(path).values for path in ("/bearings/TB1/expansion", "/growth/wall/TB1", "/growth/lumped/TB1"))
        np.testing.assert_allclose(felt, wall, atol=1e-15)
        self.assertGreater(abs(wall - lumped).max(), 1e-9)
        mean = self.run_.series("/wall/TB1/inner_ring").values - AMBIENT
        np.testing.assert_allclose(wall[:, 1], 11.8e-6 * 0.035 * mean, rtol=1e-9, atol=1e-18)
        call(self.own, self.case, self.folder / "lumped", "lumped")
        with Results(self.folder / "lumped") as other:
            np.testing.assert_allclose(other.series("/bearings/TB1/expansion").values, other.series("/growth/lumped/TB1").values, atol=1e-15)

    def test_its_report_shows_both_parts_and_results_are_not_overwritten(self):
        page = (self.folder / "out/report.html").read_text()
        self.assertIn("SNUBBER is a support defined by another program at the rotor's node 16.", page)
        self.assertIn("own-parts.toml:11: source: (est.) 50 um more than the touchdown bearings'", page)
        data = page_data(page)
        lines = {chart["id"]: [line["name"] for line in chart["lines"]] for chart in data["charts"]}
        self.assertIn("SNUBBER", lines["displacement-y"])
        self.assertIn("SNUBBER", lines["friction-force"])
        self.assertEqual(len(lines["whirl"]), 2)
        before = (self.folder / "out/summary.json").read_bytes()
        self.assertIn("the directory holds results already", call(self.own, self.case, self.folder / "out", code=2))
        self.assertEqual((self.folder / "out/summary.json").read_bytes(), before)

    def run_module(self, name, *settings, case=None):
        """Runs a case with the module by the installed program."""
        directory = self.folder / name
        if not directory.exists():
            words = [word for setting in settings for word in ("--set", setting)]
            said = call(self.program, "run", case or self.case, "-o", directory, "--set", f'run.parts=["{self.module}"]', *words)
            (directory / "said.txt").write_text(said)
        return directory

    def test_as_a_module_it_is_the_same_drop(self):
        directory = self.run_module("module", "thermal.driver=wall", case=self.fine)
        with Results(directory) as run:
            for path in ("/bearings/SNUBBER/normal_force", "/wall/TB1/bore", "/bearings/TB1/expansion", "/energy/wall_heat_stored"):
                # The same machine code or nearly so: roundoff.
                expected = self.run_.series(path).values
                np.testing.assert_allclose(run.series(path).values, expected, rtol=1e-9, atol=1e-9 * abs(expected).max(), err_msg=path)

    def test_the_installed_program_shows_the_foreign_thermal_model_like_its_own(self):
        directory = self.run_module("module", "thermal.driver=wall", case=self.fine)
        said = (directory / "said.txt").read_text()
        self.assertIn("thermal growth fed back: ring walls", said)
        self.assertRegex(said, r"balls \(\d+\.\d degC\); ring walls \d+\.\d\d K inner ring")
        self.assertRegex(said, r"ring walls residual \S+ J")
        summary = json.loads((directory / "summary.json").read_text())
        with Results(directory) as run:
            rise = run.series("/wall/TB1/inner_ring").values[-1] - AMBIENT
            self.assertAlmostEqual(summary["bearings"]["TB1"]["wall"]["temperature_rise_end"]["inner_ring"], rise, delta=1e-9)
        self.assertIn("wall_heat_residual", summary["energy"])

        comparison = json.loads((directory / "comparison.json").read_text())
        pair = comparison["bearings"]["TB1"]
        self.assertEqual((pair["models"], comparison["wall_from"]), (["lumped", "wall"], str(directory)))
        self.assertEqual(set(pair["temperatures"]), {"shaft", "inner_ring"}, "what both have")
        end = pair["temperatures"]["inner_ring"]["at"][-1]
        self.assertAlmostEqual(end["wall"] - AMBIENT, rise, delta=1e-9)
        self.assertAlmostEqual(end["difference"], end["wall"] - end["lumped"], delta=1e-9)
        self.assertIn("of those of the ring walls", comparison["in_short"][0])

        for command in (("report", directory, "-o", directory / "page.html"), ("compare", directory, "-o", directory / "again.json", "--quiet")):
            call(self.program, *command)
        self.assertEqual(json.loads((directory / "again.json").read_text())["bearings"], comparison["bearings"], "from the files as from memory")
        page = (directory / "page.html").read_text()
        self.assertIn("Thermal models: lumped thermal circuit and ring walls. The clearances follow the ring walls.", page)
        data = page_data(page)
        lines = {chart["id"]: [line["name"] for line in chart["lines"]] for chart in data["charts"]}
        for chart in ("temperature-TB1", "growth-TB1"):
            self.assertTrue(any(name.endswith("(walls)") for name in lines[chart]), lines[chart])

    def test_friction_heat_of_the_snubber_warms_a_node_of_the_circuit(self):
        node = 'thermal.node=[{name="bush", capacity="100 J/K"}]'
        directory = self.run_module("heated", node, "bearings.SNUBBER.heats=bush")
        with Results(directory) as run:
            given = run.series("/ledger/SNUBBER/heat_into_port").values[-1]
            self.assertGreater(given, 0.5, "J")
            # Half of the friction heat; all of it stays in a node without resistors. Roundoff of 293 K.
            self.assertAlmostEqual(given, 0.5 * run.series("/ledger/SNUBBER/bush_friction_heat").values[-1], delta=1e-9 * given)
            self.assertAlmostEqual(run.series("/thermal/bush").values[-1] - AMBIENT, given / 100, delta=1e-10)
            self.assertLess(abs(run.series("/energy/heat_residual").values[-1]), 1e-6, "J, roundoff")
        done = call(self.program, "check", self.case, "--set", f'run.parts=["{self.module}"]', "--set", "bearings.SNUBBER.heats=TB1/shat", code=2)
        self.assertIn('bearings.SNUBBER heats "TB1/shat"', done)
        self.assertIn('Did you mean "TB1/shaft"?', done)

    def test_keys_of_a_module_are_listed(self):
        environment = {key: value for key, value in os.environ.items() if not key.startswith("ROTORDROP_")}
        environment["ROTORDROP_PARTS"] = str(self.module)
        said = subprocess.run([str(self.program), "defaults"], capture_output=True, text=True, env=environment, check=True).stdout
        self.assertIn("[thermal.wall]", said)
        self.assertIn("shells = 16", said)

    def test_faults_of_its_keys_are_explained(self):
        wrong = self.folder / "wrong.toml"
        wrong.write_text(f'base = "{self.case}"\n[bearings.SNUBBER]\nstifness = "1e7 N/m"\ngap = "-1 um"\n')
        done = call(self.own, wrong, self.folder / "nothing", code=2)
        self.assertIn('Did you mean "stiffness"?', done)
        self.assertIn("gap = -1 um", done)
        self.assertFalse((self.folder / "nothing").exists())
        self.assertIn("snubber", call(self.program, "check", self.case, code=2), "the program itself has no such kind")


@unittest.skipUnless(CACHE, "the program lies in no build folder")
@unittest.skipUnless(shutil.which("ninja"), "without ninja")
class SourceFolder(unittest.TestCase):
    def test_it_may_have_any_name(self):
        folder = tempfile.TemporaryDirectory(prefix="rotor's drop ")
        self.addCleanup(folder.cleanup)
        source = pathlib.Path(folder.name) / "it's here"
        shutil.copytree(SOURCE, source, ignore=lambda path, _: {"build", "out", ".git"} if pathlib.Path(path) == SOURCE else set())
        call("cmake", "-S", source, "-B", source / "build", "-G", "Ninja", "-DROTORDROP_FE=OFF", "-DROTORDROP_BENCHMARKS=OFF")
        commands = call("ninja", "-C", source / "build", "-t", "commands", "all").splitlines()
        self.assertGreater(len(commands), 300)
        broken = [command for command in commands if subprocess.run(["sh", "-n"], input=command, text=True, capture_output=True).returncode != 0]
        self.assertEqual(broken, [])


if __name__ == "__main__":
    unittest.main()

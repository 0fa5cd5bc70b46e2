"""Modules with parts of others: what is said when one cannot be loaded. That they work is tested with examples/own-parts in test_install."""

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

sys.path.insert(0, __file__.rpartition("/")[0])
from compiled_module import CAN_COMPILE, OTHER_HEADERS, compile_module  # noqa: E402
from program import HAS_MESH_ROOM, ProgramTest, call  # noqa: E402


@unittest.skipUnless(shutil.which("cc"), "no compiler")
class Modules(ProgramTest):
    def module(self, name, text):
        """A shared object from C."""
        source = self.folder / f"{name}.c"
        source.write_text(text)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", str(self.folder / f"{name}.so"), str(source)], check=True)
        return f"{name}.so"

    def refused(self, *parts):
        names = ", ".join(f'"{part}"' for part in parts)
        case = self.folder / "case.toml"
        case.write_text(f'base = "reference.toml"\n[run]\nparts = [{names}]\n')
        done = call("check", case, cwd="/")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("case.toml:3:", done.stderr, "it says where")
        return done.stderr

    def test_a_missing_file(self):
        text = self.refused("nothing.so")
        self.assertIn('run.parts: there is no file "nothing.so".', text)
        self.assertIn(str(self.folder / "nothing.so"), text)

    def test_a_file_that_is_no_shared_object(self):
        (self.folder / "text.so").write_text("not a library\n")
        self.assertIn("cannot be loaded", self.refused("text.so"))

    def test_a_library_that_is_no_module(self):
        text = self.refused(self.module("other", "int nothing(void) { return 0; }\n"))
        self.assertIn("is not a module of parts", text)
        self.assertIn("docs/how-to/extending.md", text)

    def test_a_module_of_another_version_is_not_called(self):
        name = self.module("old", 'const char *rotordrop_parts_interface(void) { return "rotordrop 0.0.1"; }\nvoid rotordrop_add_parts(void *registry) { *(volatile int *)0 = 0; }\n')
        text = self.refused(name)
        self.assertIn("was built for another version of the program", text)
        self.assertIn("rotordrop 0.0.1", text)

    def test_symbols_that_nobody_has(self):
        self.assertIn("nobody_has_this", self.refused(self.module("lost", "void nobody_has_this(void);\nvoid f(void) { nobody_has_this(); }\n")))

    def test_what_the_environment_names_is_checked_too(self):
        environment = dict(os.environ, ROTORDROP_PARTS="/nowhere/parts.so")
        from program import PROGRAM

        done = subprocess.run([PROGRAM, "defaults"], capture_output=True, text=True, env=environment)
        self.assertEqual(done.returncode, 2)
        self.assertIn("ROTORDROP_PARTS: there is no module /nowhere/parts.so", done.stderr)

    def test_a_list_is_wanted(self):
        done = call("check", self.folder / "reference.toml", "--set", 'run.parts="snubber.so"')
        self.assertEqual(done.returncode, 2)
        self.assertIn("run.parts must be a list of files", done.stderr)

    def test_a_module_that_is_not_whole_is_not_loaded(self):
        name = self.module("cut", "char filling[100000] = {1};\n")
        file = self.folder / name
        whole = file.read_bytes()
        for size in (len(whole) - 1, 50000, 200, 20):
            with self.subTest(size):
                file.write_bytes(whole[:size])
                self.assertIn("is not whole", self.refused(name))


@unittest.skipUnless(CAN_COMPILE, "no compiler, or no libraries beside the program")
class OwnModules(ProgramTest):
    """A module with a soft ring around the shaft (own_module.cpp), compiled in some ways."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.modules = tempfile.TemporaryDirectory(prefix="rotordrop-test-")
        cls.addClassCleanup(cls.modules.cleanup)
        compile_module(f"{cls.modules.name}/ring.so")
        compile_module(f"{cls.modules.name}/old.so", OTHER_HEADERS, '-DTYPE="old-ring"')

    def case(self, *names, more=""):
        for name in names:
            shutil.copy(f"{self.modules.name}/{name}.so", self.folder)
        listed = ", ".join(f'"{name}.so"' for name in names)
        return self.write("case.toml", f'base = "reference.toml"\n[run]\nparts = [{listed}]\nend_time = "12 ms"\n{more}')

    RING = '[bearings.R]\ntype = "ring"\nnode = 16\nstiffness = 1e6\ngap = "100 um"\n'

    def test_a_module_for_other_headers_is_refused_behind_any_other(self):
        for names in (("old",), ("ring", "old"), ("old", "ring")):
            with self.subTest(names):
                done = self.call("check", self.case(*names))
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn("old.so was built for another version of the program", done.stderr)
        self.succeed("check", self.case("ring"))

    def test_a_support_that_reports_ball_forces_has_a_summary(self):
        """By hand: a rotor that does not spin falls from the line through the hanging rings of TB1 and TB2, in sqrt(2 fall / g). The ring R takes its force without friction, keeps no impulse, and has no whirl."""
        self.succeed("run", self.case("ring", more=self.RING), "-o", "out", "--set", "run.initial_speed=0")
        ring = self.summary()["bearings"]["R"]
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            start = file["bearings/R/orbit"][0, 0]
        self.assertTrue(-10e-6 < start < -8e-6, "TB1's ring hangs by 19 um at some 400 of 800 mm from R")
        self.assertAlmostEqual(ring["first_contact_time"], math.sqrt(2 * (100e-6 + start) / 9.81), delta=2e-6)
        self.assertGreater(ring["peak_contact_force"], 0)
        self.assertEqual(ring["friction_heat"], 0)
        self.assertIsNone(ring["mean_contact_force_end"])
        self.assertNotIn("whirl", ring)
        self.assertIn("whirl", self.summary()["bearings"]["TB1"])
        self.succeed("report", "out")

    @unittest.skipUnless(HAS_MESH_ROOM, "built without finite elements")
    def test_a_circuit_is_calibrated_beside_heat_of_an_own_support(self):
        """What the case adds to the circuit is not fitted: the factors are those of the case without it."""
        plate = '[[thermal.node]]\nname = "plate"\ncapacity = "100 J/K"\n'
        factors = []
        for name, more in (("with", self.RING + 'heats = "plate"\n' + plate), ("without", "")):
            self.succeed("calibrate", self.case("ring", more=more), "--until", "10ms", "-o", f"{name}/fit.toml")
            factors.append(re.findall(r"^\w+ = [\d.]+", (self.folder / name / "fit.toml").read_text(), re.MULTILINE))
        self.assertEqual(len(factors[0]), 8)
        self.assertEqual(*factors)

    def test_own_supports_are_named_where_modes_leave_them_out(self):
        case = self.case("ring", more=self.RING)
        for command in ("modes", "critical-speeds"):
            with self.subTest(command):
                self.assertEqual(json.loads(self.succeed(command, case, "--json").stdout)["left_out"], ["R"])
                self.assertIn("Left out: R.", self.succeed(command, case).stdout)
                self.assertNotIn("left_out", json.loads(self.succeed(command, "reference.toml", "--json").stdout))
        on_springs = json.loads(self.succeed("critical-speeds", case, "--json", "--stiffness", "1e7 N/m").stdout)
        self.assertIn("R", on_springs["stations"])
        self.assertNotIn("left_out", on_springs)


if __name__ == "__main__":
    unittest.main()

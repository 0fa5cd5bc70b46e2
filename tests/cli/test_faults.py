"""Short forms of the scripts of tests/faults: they find nothing here, and must be able to find something."""

import copy
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, SOURCE  # noqa: E402
from test_scripts import load_script  # noqa: E402


class Faults(unittest.TestCase):
    def call(self, script, *arguments):
        done = subprocess.run([sys.executable, SOURCE / f"tests/faults/{script}.py", PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_killed_runs_end_as_unbroken_ones(self):
        said = self.call("kills", 6, 5)
        self.assertRegex(said, r"\d+ runs, [678] kills, seed 5")

    def test_killed_studies_end_as_unbroken_ones(self):
        self.assertIn("6 kills, seed 5: the same bits", self.call("study_kills", 6, 5, 16))

    def test_random_machines_have_the_properties(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("4 machines, 4 of them touched, 9 properties each: 0 failures", self.call("properties", 4, 5, "--save", folder))


class ThePropertiesCanFail(unittest.TestCase):
    """Each property notices a machine that was changed in secret, or a program that is wrong."""

    def setUp(self):
        self.properties = load_script(SOURCE / "tests/faults/properties.py")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = self.properties.Program(PROGRAM, pathlib.Path(folder.name))
        self.machine = self.properties.random_machine(random.Random("5 0"))
        self.summary = self.program.drop(self.machine)

    def test_symmetries(self):
        p = self.properties
        real = self.program.drop
        for property_ in (p.mirror_image, p.turned_by_a_ball, p.order_and_names, p.units):
            first = iter([True])
            # The second machine that is dropped has a thousandth more friction.
            def wrong(machine, is_first=first, turned=property_ is p.turned_by_a_ball, **isa):
                if turned and next(is_first, False):
                    return real(machine)
                text = machine.get("text") or p.case_text(machine)
                return real({**machine, "text": text.replace(f"friction_coefficient = {machine['friction']!r}", f"friction_coefficient = {1.001 * machine['friction']!r}")}, **isa)
            self.program.drop = wrong
            with self.assertRaises(AssertionError, msg=property_.__name__):
                property_(self.program, self.machine, self.summary)
            self.program.drop = real

    def test_balances(self):
        real = self.program.drop
        for key in ("residual", "heat_residual"):
            def wrong(machine, key=key):
                summary = real(machine)
                summary["energy"][key] += 1e-5 * (summary["energy"]["dissipated"] + 1)
                return summary
            self.program.drop = wrong
            with self.assertRaises(AssertionError):
                self.properties.energy_closes(self.program, self.machine, self.summary)

    def test_momentum(self):
        real = self.program.drop
        def wrong(machine):
            summary = real(machine)
            summary["rotor"]["polar_inertia"] *= 1.05
            return summary
        self.program.drop = wrong
        with self.assertRaises(AssertionError):
            self.properties.spin_momentum(self.program, self.machine, self.summary)

    def test_lanes(self):
        real = self.program.drop
        # The drop alone is another by a thousandth of its speed: that of the lane beside it.
        self.program.drop = lambda machine, **isa: real({**machine, "speed": 1.001 * machine["speed"]}, **isa)
        with self.assertRaises(AssertionError):
            self.properties.side_by_side(self.program, self.machine, None)
        self.program.drop = real
        # What does not run in lanes is no test of them.
        text = self.properties.case_text
        self.properties.case_text = lambda m: text(m).replace('type = "touchdown"', 'type = "touchdown"\nring_motion = "free"\nring_diametral_inertia = 1e-3')
        with self.assertRaisesRegex(AssertionError, "one by one"):
            self.properties.side_by_side(self.program, self.machine, None)

    def test_restarts(self):
        self.properties.restart_anywhere(self.program, self.machine, self.summary)
        other = copy.deepcopy(self.summary)
        other["bearings"]["DE"]["friction_heat"] *= 1 + 1e-15
        with self.assertRaises(AssertionError):
            self.properties.restart_anywhere(self.program, self.machine, other)

    def test_even_heating(self):
        machine = self.properties.random_machine(random.Random("5 3"))
        i = 0
        while not any(bearing.get("preload") for bearing in machine["bearings"].values()):
            i += 1
            machine = self.properties.random_machine(random.Random(f"5 {i}"))
        self.properties.even_heating(self.program, machine, None)
        text = self.properties.case_text
        self.properties.case_text = lambda m: text(m).replace("ball_rise = 50.0", "ball_rise = 55.0")
        with self.assertRaises(AssertionError):
            self.properties.even_heating(self.program, machine, None)


if __name__ == "__main__":
    unittest.main()

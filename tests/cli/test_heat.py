"""`rotordrop heat`: faults of a case, results, and what a program without the finite-element room says.

ROTORDROP_PROGRAM is the program under test. What needs the room is skipped where its module is not beside the program.
"""

import pathlib
import sys
import unittest

import h5py

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, PROGRAM, ProgramTest, content_of  # noqa: E402

EXAMPLE = PARAMS / "heat/ring-in-housing.toml"
HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()

DISC = """
output_times = ["1 ms", 0.01]
[[section.rectangle]]
name = "disc"
x = [0, "10 mm"]
r = [0, "20 mm"]
material = "steel"
[[flux]]
boundary = "disc.outer"
times = [0]
values = [1e5]
[[probe]]
name = "rim"
boundary = "disc.outer"
"""


class FaultyCases(ProgramTest):
    """Faults are found before the room is needed."""

    def fault(self, text, *options):
        done = self.call("heat", self.write("disc.toml", text), "-o", "out", *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse((self.folder / "out").exists())
        return done.stderr

    def test_a_mistyped_boundary_is_named_with_the_right_one(self):
        message = self.fault(DISC.replace('"disc.outer"\ntimes', '"disc.otuer"\ntimes'))
        self.assertIn("disc.toml:9:12", message)
        self.assertIn('Did you mean "disc.outer"?', message)

    def test_times_and_values_must_be_as_many(self):
        self.assertIn("1 times and 2 values", self.fault(DISC.replace("[1e5]", "[1e5, 0]")))

    def test_an_unknown_material_is_named(self):
        self.assertIn('Did you mean "steel"?', self.fault(DISC.replace('"steel"', '"stele"')))

    def test_the_axis_takes_no_flux(self):
        self.assertIn("the axis, which has no area", self.fault(DISC.replace('"disc.outer"\ntimes', '"disc.inner"\ntimes')))

    def test_a_probe_must_lie_in_a_body(self):
        self.assertIn("lies in no body", self.fault(DISC + '[[probe]]\nname = "far"\nx = 0\nr = "21 mm"\n'))

    def test_a_probe_is_a_point_or_a_boundary(self):
        self.assertIn("needs either x and r, or boundary", self.fault(DISC + '[[probe]]\nname = "half"\nx = 0\n'))

    def test_bodies_do_not_overlap(self):
        self.assertIn("lies partly inside", self.fault(DISC + '[[section.rectangle]]\nname = "b"\nx = [0, 1]\nr = ["19 mm", "30 mm"]\nmaterial = "steel"\n'))

    def test_an_interface_joins_boundaries_that_lie_on_each_other(self):
        other = '[[section.rectangle]]\nname = "b"\nx = [0, 1]\nr = ["21 mm", "30 mm"]\nmaterial = "steel"\n'
        self.assertIn("do not lie on each other", self.fault(DISC + other + '[[interface]]\nbetween = ["disc.outer", "b.inner"]\nresistance = 1e-4\n'))
        self.assertIn("do not face each other", self.fault(DISC + other + '[[interface]]\nbetween = ["disc.outer", "b.outer"]\nresistance = 1e-4\n'))

    def test_flux_needs_a_free_part(self):
        other = '[[section.rectangle]]\nname = "b"\nx = [0, 1]\nr = ["20 mm", "30 mm"]\nmaterial = "steel"\n'
        self.assertIn("covered by interfaces", self.fault(DISC + other + '[[interface]]\nbetween = ["disc.outer", "b.inner"]\nresistance = 1e-4\n'))

    def test_it_must_end_sometime(self):
        self.assertIn("how long to compute", self.fault(DISC.replace('output_times = ["1 ms", 0.01]', "")))


@unittest.skipIf(HAS_ROOM, "built with the finite-element room")
class WithoutTheRoom(ProgramTest):
    def test_the_message_says_how_to_get_it(self):
        done = self.call("heat", EXAMPLE, "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("built without the finite-element room", done.stderr)
        self.assertIn("install-dependencies --fe", done.stderr)
        self.assertFalse((self.folder / "out").exists())


@unittest.skipUnless(HAS_ROOM, "built without the finite-element room")
class WithTheRoom(ProgramTest):
    def test_the_example_runs_and_its_energy_closes(self):
        self.succeed("heat", EXAMPLE, "-o", "out")
        summary = self.summary()
        times = [1e-4, 5e-4, 1e-3, 2e-3, 3e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.3]
        self.assertEqual(set(summary["probes"]), {"bore", "mid-ring", "ring-at-fit", "housing-at-fit"})
        for probe in summary["probes"].values():
            self.assertEqual(probe["time"], times)
            self.assertEqual(len(probe["temperature"]), len(times))
        energy = summary["energy"]
        self.assertLess(abs(energy["residual"]), 1e-10 * energy["input"])
        self.assertEqual(energy["residual"], energy["input"] - energy["stored"] - energy["lost"])
        self.assertGreater(summary["steps"], 10)
        self.assertGreater(summary["unknowns"], 500)
        self.assertGreater(summary["cpu_time"], 0)
        with h5py.File(self.folder / "out/results.h5", "r") as results:
            self.assertEqual(list(results["/time"]), times)
            self.assertEqual(list(results["/probes/bore"]), summary["probes"]["bore"]["temperature"])
            self.assertEqual(results["/probes/bore"].attrs["units"], "K")

    def test_the_resolved_case_runs_to_the_same_numbers(self):
        self.succeed("heat", EXAMPLE, "-o", "out")
        self.succeed("heat", "out/parameters.toml", "-o", "again")
        self.assertEqual(self.summary()["probes"], self.summary("again")["probes"])

    def test_results_are_not_replaced_unasked(self):
        case = self.write("disc.toml", DISC)
        self.succeed("heat", case, "-o", "out", "--quiet")
        before = content_of(self.folder / "out")
        done = self.call("heat", case, "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--force", done.stderr)
        self.assertEqual(content_of(self.folder / "out"), before)
        self.succeed("heat", case, "-o", "out", "--force", "--set", "fe.cells=4")
        self.assertNotEqual(content_of(self.folder / "out"), before)

    def test_a_start_off_ambient_and_an_end_time_are_taken(self):
        case = self.write("disc.toml", DISC + '[run]\nambient = "300 K"\ninitial_temperature = "350 K"\nend_time = "20 ms"\n')
        self.succeed("heat", case, "-o", "out", "--set", "flux=[]")
        rim = self.summary()["probes"]["rim"]
        self.assertEqual(rim["time"], [1e-3, 0.01, 0.02])
        for temperature in rim["temperature"]:
            self.assertAlmostEqual(temperature, 350.0, places=9)


if __name__ == "__main__":
    unittest.main()

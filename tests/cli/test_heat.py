"""`rotordrop heat`: faults of a case, results, and what a program without the finite-element room says.

ROTORDROP_PROGRAM is the program under test. What needs the room is skipped where its module is not beside the program.
"""

import json
import math
import pathlib
import sys
import tomllib
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

    def test_a_flux_says_in_one_way_what_flows(self):
        steps = "times = [0]\nvalues = [1e5]\n"
        self.assertIn("does not say what flows", self.fault(DISC.replace(steps, "")))
        self.assertIn("in several ways", self.fault(DISC.replace(steps, steps + 'pulse = { height = 1, width = 1 }\n')))
        self.assertIn("belongs to a recorded heat", self.fault(DISC.replace(steps, steps + "share = 0.5\n")))
        self.assertIn("needs times and values", self.fault(DISC.replace(steps, "times = [0]\n")))

    def test_pulses_do_not_overlap_and_several_need_a_period(self):
        steps = "times = [0]\nvalues = [1e5]\n"
        self.assertIn("needs a period", self.fault(DISC.replace(steps, "pulse = { height = 1, width = 1, count = 2 }\n")))
        self.assertIn("shorter than its width", self.fault(DISC.replace(steps, "pulse = { height = 1, width = 1, period = 0.5, count = 2 }\n")))

    def test_a_fixed_boundary_takes_no_flux_nor_convection_and_is_fixed_once(self):
        fixed = '[[fixed]]\nboundary = "disc.{}"\ntemperature = "30 degC"\n'
        message = self.fault(DISC + fixed.format("outer") + fixed.format("left") + fixed.format("left") + fixed.format("right")
                             + '[[convection]]\nboundary = "disc.right"\ncoefficient = 5\n')
        self.assertIn("fixed#1: \"disc.outer\" has a flux, too", message)
        self.assertIn("fixed#3: \"disc.left\" has a fixed temperature already", message)
        self.assertIn("fixed#4: \"disc.right\" has convection, too", message)
        self.assertNotIn("fixed#2", message)
        self.assertIn("the axis", self.fault(DISC + fixed.format("inner")))


RECORDED = """
output_times = [1e-3]
run.end_time = "10 ms"
[[section.rectangle]]
name = "ring"
x = [0, "20 mm"]
r = ["35 mm", "40 mm"]
material = "steel"
[[flux]]
boundary = "ring.inner"
recorded = "drop/results.h5"
bearing = "TB1"
heat = "rub"
share = 0.66
[[probe]]
name = "bore"
boundary = "ring.inner"
"""


class RecordedHeat(ProgramTest):
    """Heat from the ledger of an earlier drop."""

    def setUp(self):
        super().setUp()
        self.run_case(self.case(""), output="drop")

    def fault(self, old, new):
        done = self.call("check", self.write("ring.toml", RECORDED.replace(old, new)))
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr

    def test_faults_name_what_is_there(self):
        self.assertIn('Did you mean "TB1"?  Known: TB1, TB2.', self.fault('"TB1"', '"TB"'))
        self.assertIn("ring.toml:12:11", self.fault('"TB1"', '"TB"'))
        self.assertIn("there is no such file", self.fault("results.h5", "result.h5"))
        self.assertIn("cannot be read as an HDF5 file", self.fault("results.h5", "summary.json"))
        self.assertIn('Did you mean "rub"?', self.fault('"rub"', '"rubb"'))
        self.assertIn("needs heat beside it", self.fault('heat = "rub"', ""))
        self.assertIn("out of range", self.fault("0.66", "1.2"))

    def test_results_without_a_ledger_are_refused(self):
        with h5py.File(self.folder / "other.h5", "w") as other:
            other["/time"] = [0.0, 1.0]
        self.assertIn("holds no rub heat", self.fault("drop/results.h5", "other.h5"))

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element room")
    def test_every_joule_arrives(self):
        case = self.write("ring.toml", RECORDED)
        with h5py.File(self.folder / "drop/results.h5", "r") as drop:
            given = 0.66 * (drop["/ledger/TB1/rub_heat"][-1] - drop["/ledger/TB1/rub_heat"][0])
        self.assertGreater(given, 1.0)
        for output, options in (("all", []), ("coarse", ["--set", "flux=[{boundary = 'ring.inner', recorded = 'drop/results.h5', bearing = 'TB1', heat = 'rub', share = 0.66, interval = '1 ms'}]"])):
            self.succeed("heat", case, "-o", output, *options)
            energy = self.summary(output)["energy"]
            self.assertLess(abs(energy["input"] / given - 1), 1e-12, output)
            self.assertLess(abs(energy["residual"]), 1e-10 * given, output)
        self.assertLess(self.summary("coarse")["steps"], self.summary("all")["steps"])

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element room")
    def test_the_resolved_case_runs_from_anywhere(self):
        self.succeed("heat", self.write("ring.toml", RECORDED), "-o", "out")
        self.succeed("heat", "out/parameters.toml", "-o", "again")
        self.assertEqual(self.summary()["probes"], self.summary("again")["probes"])


class HeatDeclarations(ProgramTest):
    def test_check_knows_a_case_of_heat(self):
        done = self.succeed("check", EXAMPLE)
        self.assertIn("bodies: ring, housing", done.stdout)
        self.assertIn("no faults. Run it with `rotordrop heat`", done.stdout)
        done = self.call("check", self.write("disc.toml", DISC.replace('"steel"', '"stele"')))
        self.assertEqual(done.returncode, 2)
        self.assertIn('Did you mean "steel"?', done.stderr)
        self.assertIn("case reference", self.succeed("check", "reference.toml").stdout)

    def test_defaults_of_heat_are_a_toml_file(self):
        text = self.succeed("defaults", "--heat").stdout
        self.assertEqual(tomllib.loads(text)["fe"]["degree"], 2)
        for key in ("pulse", "recorded", "fixed", "output_times"):
            self.assertIn(key, text)
        self.assertNotIn("rotor", tomllib.loads(text))
        self.assertIn("rotor", tomllib.loads(self.succeed("defaults").stdout))

    def test_schema_of_heat_has_every_key_of_the_example(self):
        schema = json.loads(self.succeed("schema", "--heat").stdout)
        for key in tomllib.loads(EXAMPLE.read_text()):
            self.assertIn(key, schema["properties"])
        self.assertNotIn("rotor", schema["properties"])

    def test_help_lists_heat(self):
        self.assertRegex(self.succeed("--help").stdout, r"\n  heat ")


@unittest.skipIf(HAS_ROOM, "built with the finite-element room")
class WithoutTheRoom(ProgramTest):
    def test_the_message_says_how_to_get_it(self):
        done = self.call("heat", EXAMPLE, "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("built without the finite-element room", done.stderr)
        self.assertIn("install-dependencies", done.stderr)
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

    def test_pulses_bring_their_heat(self):
        pulses = 'pulse = { height = 1e5, width = "1 ms", period = "3 ms", start = "1 ms", count = 3 }\n'
        case = DISC.replace("times = [0]\nvalues = [1e5]\n", pulses)
        self.succeed("heat", self.write("disc.toml", case), "-o", "out")
        self.assertAlmostEqual(self.summary()["energy"]["input"], 3 * 1e5 * 1e-3 * 2 * math.pi * 0.02 * 0.01, delta=1e-12)
        self.succeed("heat", self.write("steps.toml", case.replace(pulses, 'times = ["1 ms", "2 ms", "4 ms", "5 ms", "7 ms", "8 ms"]\nvalues = [1e5, 0, 1e5, 0, 1e5, 0]\n')), "-o", "steps")
        for a, b in zip(self.summary()["probes"]["rim"]["temperature"], self.summary("steps")["probes"]["rim"]["temperature"]):
            self.assertAlmostEqual(a, b, delta=1e-9)

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

"""`rotordrop heat`: faults of a case, results, and what a program without the finite-element room says.

ROTORDROP_PROGRAM is the program under test. What needs the room is skipped where its module is not beside the program.
"""

import json
import math
import os
import pathlib
import subprocess
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

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_degrees_celsius_taken_for_kelvins_are_told(self):
        held = DISC.split("[[flux]]")[0] + '[[fixed]]\nboundary = "disc.outer"\ntemperature = 60\n'
        for text, words in ((held, "temperature = 60 K is unusual"), (DISC + '[[displacement]]\nname = "u"\nboundary = "disc.outer"\n[elastic]\nstrain_free_temperature = 20\n', "strain_free_temperature = 20 K is unusual")):
            self.assertIn(words, self.succeed("heat", self.write("cold.toml", text), "-o", "out", "--force").stderr)

    def test_times_and_values_must_be_as_many(self):
        self.assertIn("1 times and 2 values", self.fault(DISC.replace("[1e5]", "[1e5, 0]")))

    def test_an_unknown_material_is_named(self):
        self.assertIn('Did you mean "steel"?', self.fault(DISC.replace('"steel"', '"stele"')))

    def test_the_axis_takes_no_flux(self):
        self.assertIn("the axis, which has no area", self.fault(DISC.replace('"disc.outer"\ntimes', '"disc.inner"\ntimes')))

    def test_a_probe_must_lie_in_a_body(self):
        self.assertIn("is not inside any body", self.fault(DISC + '[[probe]]\nname = "far"\nx = 0\nr = "21 mm"\n'))

    def test_a_probe_is_a_point_or_a_boundary(self):
        self.assertIn("needs either x and r, or boundary", self.fault(DISC + '[[probe]]\nname = "half"\nx = 0\n'))

    def test_names_are_such_as_results_can_have(self):
        for table in ('[[probe]]\nx = 0\nr = "15 mm"\n', '[[displacement]]\nx = 0\nr = "15 mm"\n', '[[fit]]\nbetween = ["disc.outer", "disc.inner"]\n'):
            for name in ("", ".", "a/b"):
                with self.subTest(table=table, name=name):
                    self.assertIn(f'name = "{name}" is empty, only a dot, or has a slash in it', self.fault(f'{DISC}{table}name = "{name}"\n'))

    def test_bodies_do_not_overlap(self):
        self.assertIn("lies partly inside", self.fault(DISC + '[[section.rectangle]]\nname = "b"\nx = [0, 1]\nr = ["19 mm", "30 mm"]\nmaterial = "steel"\n'))

    def test_an_interface_joins_boundaries_that_lie_on_each_other(self):
        other = '[[section.rectangle]]\nname = "b"\nx = [0, 1]\nr = ["21 mm", "30 mm"]\nmaterial = "steel"\n'
        self.assertIn("do not lie on each other", self.fault(DISC + other + '[[interface]]\nbetween = ["disc.outer", "b.inner"]\nresistance = 1e-4\n'))
        self.assertIn("do not face each other", self.fault(DISC + other + '[[interface]]\nbetween = ["disc.outer", "b.outer"]\nresistance = 1e-4\n'))

    def test_two_boundaries_are_joined_once(self):
        """Two resistances side by side would be half of each."""
        case = DISC + '[[section.rectangle]]\nname = "b"\nx = ["10 mm", "20 mm"]\nr = [0, "20 mm"]\nmaterial = "steel"\n'
        for again in ('"disc.right", "b.left"', '"b.left", "disc.right"'):
            joined = "".join(f"[[interface]]\nbetween = [{pair}]\nresistance = 1e-4\n" for pair in ('"disc.right", "b.left"', again))
            self.assertIn("interface#2: ", message := self.fault(case + joined))
            self.assertIn("are joined already", message)

    def test_flux_needs_a_free_part(self):
        other = '[[section.rectangle]]\nname = "b"\nx = [0, 1]\nr = ["20 mm", "30 mm"]\nmaterial = "steel"\n'
        self.assertIn("covered by interfaces", self.fault(DISC + other + '[[interface]]\nbetween = ["disc.outer", "b.inner"]\nresistance = 1e-4\n'))

    def test_it_must_end_sometime(self):
        self.assertIn("how long to compute", self.fault(DISC.replace('output_times = ["1 ms", 0.01]', "")))

    def test_a_flux_says_in_one_way_what_flows(self):
        steps = "times = [0]\nvalues = [1e5]\n"
        self.assertIn("does not define a flux", self.fault(DISC.replace(steps, "")))
        self.assertIn("in more than one way", self.fault(DISC.replace(steps, steps + 'pulse = { height = 1, width = 1 }\n')))
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


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
class NothingToDo(ProgramTest):
    def test_far_above_room_temperature_takes_few_factorisations(self):
        # At 900 K the last place of a temperature is 1e-13 K. Where Newton's iteration asks for less, every step is refused and factorised anew.
        tables = '[materials.m]\nrho = 7800\nk_table = [["293 K", 46], ["473 K", 42], ["673 K", 36]]\nc_table = [["293 K", 460], ["473 K", 520], ["673 K", 600]]\n'
        bodies = "".join(f'[[section.rectangle]]\nname = "{name}"\nx = {x}\nr = {r}\nmaterial = "m"\n' for name, x, r in (("disc", [0, 0.5], [0, 2.4]), ("rod", [2, 16], [0, 0.0005])))
        self.succeed("heat", self.write("warm.toml", "output_times = [7000]\nrun.ambient = 900\n" + tables + bodies), "-o", "out")
        summary = self.summary()
        self.assertTrue(summary["completed"])
        self.assertLess(summary["rejected_steps"], 10)
        self.assertLess(summary["factorisations"], 500)


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
class SteadyInTheEnd(ProgramTest):
    """Runs that go on long after their steady state."""

    def test_free_convection_keeps_its_long_steps(self):
        # Rounding of flows that cancel is more than Newton's tolerance in long steps. All heat leaves by h = 23 dT^0.25: dT = (Q/(23 A))^0.8.
        text = "output_times = [2e6]\nrun.ambient = 293\n"
        for name, k, inner, outer in (("a", 15, 0.01, 0.02), ("b", 200, 0.02, 0.025), ("c", 0.2, 0.025, 0.04)):
            text += f'[materials.{name}]\nrho = 2000\nk = {k}\nc = 500\n[[section.rectangle]]\nname = "{name}"\nx = [0, 0.03]\nr = [{inner}, {outer}]\nmaterial = "{name}"\n'
        for pair, resistance in (('"a.outer", "b.inner"', 1e-4), ('"c.inner", "b.outer"', 5e-4)):
            text += f"[[interface]]\nbetween = [{pair}]\nresistance = {resistance}\n"
        text += '[[flux]]\nboundary = "a.inner"\ntimes = [0]\nvalues = [5e3]\n[[convection]]\nboundary = "c.outer"\ncoefficient = 23\nexponent = 0.25\nambient = 310\n'
        text += '[[probe]]\nname = "outside"\nboundary = "c.outer"\n'
        self.succeed("heat", self.write("long.toml", text), "-o", "out")
        summary = self.summary()
        rise = (5e3 * 0.01 / 0.04 / 23) ** 0.8
        self.assertAlmostEqual(summary["probes"]["outside"]["temperature"][-1], 310 + rise, delta=1e-5 * rise)  # what the tolerance of 1e-6 leaves
        self.assertLess(summary["rejected_steps"], 20)
        self.assertLess(summary["steps"], 400)

    def test_the_first_step_may_be_far_below_the_end(self):
        # Heat through a thin ring: q r_i/(h r_o) above ambient outside in the end.
        text = '[materials.alu]\nrho = 2700\nk = 200\nc = 900\n' + DISC.replace('["1 ms", 0.01]', '["2.5e6 s"]').replace('"steel"', '"alu"').replace('[0, "20 mm"]', '["35 mm", "40 mm"]')
        text = "output_times" + text.split("output_times")[1] + text.split("output_times")[0]
        text = text.replace("disc.outer", "disc.inner") + '[[convection]]\nboundary = "disc.outer"\ncoefficient = 600\n[[probe]]\nname = "outside"\nboundary = "disc.outer"\n'
        self.succeed("heat", self.write("thin.toml", text), "-o", "out")
        rise = 1e5 * 35 / (600 * 40)
        self.assertAlmostEqual(self.summary()["probes"]["outside"]["temperature"][-1], 293.15 + rise, delta=1e-5 * rise)


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

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
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

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_the_resolved_case_runs_from_anywhere(self):
        self.succeed("heat", self.write("ring.toml", RECORDED), "-o", "out")
        self.succeed("heat", "out/parameters.toml", "-o", "again")
        self.assertEqual(self.summary()["probes"], self.summary("again")["probes"])


BEARING = """
[heat]
bearing = "TB1"
output_times = ["1 ms", "5 ms", "10 ms"]
"""
STEADY = '[[heat.source]]\nport = "rub-into-ring"\ntimes = [0]\nvalues = [1e4]\n'


class BearingFaults(ProgramTest):
    """[heat] of a drop's case: faults are found before anything is written."""

    def fault(self, text, *options):
        done = self.call("heat", self.case(text), "-o", "out", *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse((self.folder / "out").exists())
        return done.stderr

    def test_a_drop_without_heat_is_told_what_it_needs(self):
        message = self.fault("")
        self.assertIn("without a [heat] table", message)
        self.assertIn("docs/how-to/heat.md", message)

    def test_the_bearing_is_known(self):
        self.assertIn('Did you mean "TB1"?  Known: TB1, TB2.', self.fault(BEARING.replace("TB1", "TB") + STEADY))
        self.assertIn("which one is heated?", self.fault(BEARING.replace('bearing = "TB1"', "") + STEADY))

    def test_something_heats_it_for_some_time(self):
        self.assertIn('missing key "source" in [heat]', self.fault(BEARING))
        self.assertIn("how long to compute", self.fault(BEARING.replace('output_times = ["1 ms", "5 ms", "10 ms"]', "") + STEADY))
        self.assertIn("must increase", self.fault(BEARING.replace('"5 ms"', '"0.5 ms"') + STEADY))
        self.assertIn("beyond heat.end_time", self.fault(BEARING + 'end_time = "9 ms"\n' + STEADY))

    def test_a_port_is_one_of_those_there_are(self):
        message = self.fault(BEARING + STEADY.replace("rub-into-ring", "rub-into-rig"))
        self.assertIn('Did you mean "rub-into-ring"?', message)
        self.assertIn("drop.toml:8:8", message)

    def test_a_source_says_in_one_way_what_flows(self):
        steps = "times = [0]\nvalues = [1e4]\n"
        for old, new, words in (
                (steps, "", "does not define the heat"),
                (steps, steps + "pulse = { height = 1, width = 1 }\n", "in more than one way"),
                (steps, "times = [0]\n", "needs times and values"),
                ("[1e4]", "[1e4, 0]", "1 times and 2 values"),
                (steps, "times = [1, 0]\nvalues = [1, 1]\n", "times must increase"),
                (steps, steps + 'interval = "1 ms"\n', "belongs to a recorded heat"),
                (steps, steps + "share = 0.5\n", "divides rub heat"),
                (steps, 'pulse = { height = 1, width = 1 }\ninterpolation = "linear"\n', "belongs to times and values"),
                ('"rub-into-ring"', '"all"', "is for heat that a drop recorded"),
                (steps, "pulse = { height = 1, width = 1, count = 2 }\n", "needs a period")):
            with self.subTest(words):
                self.assertIn(words, self.fault(BEARING + STEADY.replace(old, new)))

    def test_speeds_cannot_share_where_nothing_moves(self):
        rub = STEADY.replace("rub-into-ring", "rub")
        self.assertIn("needs a share", self.fault(BEARING + rub, "--set", "thermal.heat_share=jaeger"))

    def test_a_recorded_drop_is_there_and_has_the_bearing(self):
        source = '[[heat.source]]\nport = "all"\nrecorded = "drop/results.h5"\n'
        self.assertIn("there is no such file", self.fault(BEARING + source))
        self.succeed("run", "reference.toml", "-o", "drop", "--set", "run.end_time=1 ms")
        self.assertIn('no such bearing in', self.fault(BEARING + source + 'bearing = "TB3"\n'))

    def test_probes_are_nodes_of_a_model_that_runs(self):
        probe = '[[heat.probe]]\nname = "p"\n'
        self.assertIn('Did you mean "inner_ring"?', self.fault(BEARING + STEADY + probe + 'node = "iner_ring"\n'))
        self.assertIn("does not run", self.fault(BEARING + STEADY + probe + 'node = "ball"\nmodel = "fe"\n'))
        self.assertIn("need the finite elements", self.fault(BEARING + STEADY + probe + "x = 0\nr = 0.036\n"))
        self.assertIn("needs either node, or boundary, or x and r", self.fault(BEARING + STEADY + probe))
        self.assertIn("the circuit has nodes only", self.fault(BEARING + STEADY + probe + 'boundary = "inner_ring.inner"\nmodel = "lumped"\n'))
        self.assertIn("is taken", self.fault(BEARING + STEADY + 2 * (probe + 'node = "ball"\n')))

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_probes_of_the_section_lie_in_it(self):
        probe = '[[heat.probe]]\nname = "p"\n'
        case = BEARING + 'models = ["lumped", "fe"]\n' + STEADY + probe
        self.assertIn("is not inside any body", self.fault(case + 'x = 0\nr = "20 mm"\n'))
        self.assertIn("lies outside housing", self.fault(case + 'x = 0\nr = "36 mm"\nbody = "housing"\n'))
        self.assertIn('Did you mean "inner_ring.strip_1"?', self.fault(case + 'boundary = "inner_ring.strip"\n'))
        self.assertIn("both models have", self.fault(case + 'node = "inner_ring"\n'))


class HeatOfABearing(ProgramTest):
    """Its circuit and its section under heat that is given."""

    def heat(self, text, *options, output="out"):
        self.succeed("heat", self.case(text), "-o", output, *options)
        return self.summary(output)

    def assert_closed(self, summary, within=1e-10):
        for name, energy in summary["energy"].items():
            self.assertLess(abs(energy["residual"]), within * energy["input"], name)
            self.assertGreater(energy["stored"], 0, name)

    def test_what_a_material_does_not_stand_is_told(self):
        probes = self.heat(BEARING + STEADY)["probes"]
        hottest = {name: max(probe["temperature"]) for name, probe in probes.items()}
        limit = hottest["lumped.inner_contact"] - 0.01
        summary = self.heat(f"materials.steel.temperature_limit = {limit!r}\n" + BEARING + STEADY, "--force")
        too_hot = {name.removeprefix("lumped.").replace("_", " ") for name, T in hottest.items() if T > limit and name != "lumped.shaft"}
        self.assertIn("inner contact", too_hot)
        warnings = [w for w in summary["warnings"] if w["code"] == "temperature"]
        self.assertEqual({w["part"].split(" (")[0] for w in warnings}, too_hot)
        for w in warnings:
            self.assertEqual((w["place"], w["limit"]), ("TB1", limit))
            self.assertAlmostEqual(w["worst"], hottest["lumped." + w["part"].split(" (")[0].replace(" ", "_")], delta=1e-9)
        above = max(hottest.values()) + 0.01
        self.assertEqual(self.heat(f"materials.steel.temperature_limit = {above!r}\n" + BEARING + STEADY, "--force")["warnings"], [])

    def test_limits_of_the_drop_are_said_not_to_be_assessed(self):
        note = "the case's [limits] are those of a drop (rotordrop run): none of them is assessed here"
        for limits, is_said in (("", False), ('[limits]\n"bearings.*.peak_contact_force" = { max = "1 N" }\n', True)):
            case = self.case(limits + BEARING + STEADY)
            for command in (["check", case], ["heat", case, "-o", "out", "--force"]):
                self.assertEqual(note in self.succeed(*command).stdout, is_said, command)

    def test_a_stated_conductance_is_the_heated_bearings_alone_and_as_stated(self):
        """TB1's ring, joined to the heated TB2 by a resistor, passes heat on through its own balls: the ratio of its rings' rises is its own."""
        text = '''
[heat]
bearing = "TB2"
output_times = ["1e6 s"]
[[thermal.resistor]]
between = ["TB1/inner_ring", "TB2/inner_ring"]
resistance = "0.1 K/W"
[[heat.source]]
port = "rub-into-ring"
times = [0]
values = ["100 W"]
'''
        rises = {}
        for name, extra in (("R5", ""), ("stated", 'ball_conductance = "1000 W/K"\n'), ("factor", 'ball_conductance = "1000 W/K"\n')):
            factor = "[bearings.TB2.circuit]\nball = 0.1\n" if name == "factor" else ""
            probes = self.heat(factor + text.replace("[heat]\n", "[heat]\n" + extra), output=name)["probes"]
            rises[name] = {node: probes["lumped." + node]["temperature"][-1] - 293.15 for node in ("TB1.inner_ring", "TB1.outer_ring", "inner_ring", "outer_ring")}
        of_own = [rise["TB1.outer_ring"] / rise["TB1.inner_ring"] for rise in (rises["R5"], rises["stated"])]
        self.assertAlmostEqual(of_own[1], of_own[0], delta=0.1 * of_own[0], msg="the housing's convection rises with its temperature")
        self.assertGreater(rises["stated"]["outer_ring"] / rises["stated"]["inner_ring"], 1.5 * rises["R5"]["outer_ring"] / rises["R5"]["inner_ring"])
        self.assertEqual(rises["factor"], rises["stated"], "the calibration's factor is on what is computed")

    def test_recorded_heat_gives_the_drops_own_circuit(self):
        """Within a row of 50 us the heat is spread evenly: heat of a row, at most a fiftieth of all, moves by less than 50 us, and conduction changes a node
        by 50 us over the circuit's time constants, 5 s and more. That is 2e-7 of the largest rise."""
        self.run_case(self.case(""), output="drop", run__end_time="60 ms")
        times = [5e-3, 12e-3, 30e-3, 60e-3]
        nodes = ["shaft", "inner_ring", "ball", "outer_ring", "housing"]
        probes = "".join(f'[[heat.probe]]\nname = "{n}"\nnode = "{n}"\n' for n in nodes)
        for bearing in ("TB1", "TB2"):
            summary = self.heat(f'[heat]\nbearing = "{bearing}"\noutput_times = {times}\n[[heat.source]]\nport = "all"\nrecorded = "drop/results.h5"\n' + probes, output=bearing)
            with h5py.File(self.folder / "drop/results.h5", "r") as results:
                rows = [int(abs(results["/time"][:] - t).argmin()) for t in times]
                for row, t in zip(rows, times):
                    self.assertAlmostEqual(results["/time"][row], t, delta=1e-12)
                largest = max(results[f"/thermal/{bearing}/{n}"][-1] for n in nodes) - 293.15
                self.assertGreater(largest, 0.1)
                for n in nodes:
                    for row, T in zip(rows, summary["probes"][n]["temperature"]):
                        self.assertAlmostEqual(T, results[f"/thermal/{bearing}/{n}"][row], delta=2e-7 * largest, msg=f"{bearing} {n}")
                growth = results[f"/growth/lumped/{bearing}"][rows[-1]]
                for name, value in zip(("shaft", "bore", "inner_race", "outer_race", "ball_radius", "inner_width", "outer_width", "row_difference"), growth):
                    self.assertAlmostEqual(summary["growth"]["lumped"][name][-1], value, delta=1e-6 * max(abs(growth)))
                given = sum(results[f"/ledger/{bearing}/{heat}_heat"][-1] for heat in ("rub", "inner", "outer"))
                self.assertAlmostEqual(summary["energy"]["lumped"]["input"], given, delta=1e-12 * given)
            self.assert_closed(summary)

    def test_the_share_of_a_recorded_rub_may_be_another(self):
        self.run_case(self.case(""), output="drop")
        source = '[[heat.source]]\nport = "{}"\nrecorded = "drop/results.h5"\n'
        with h5py.File(self.folder / "drop/results.h5", "r") as results:
            rub, into_ring = (results[f"/ledger/TB1/{name}"][-1] for name in ("rub_heat", "rub_heat_into_ring"))
        own = self.heat(BEARING + source.format("rub"), output="own")["heat"]
        other = self.heat(BEARING + source.format("rub") + "share = 0.25\n", output="other")["heat"]
        shaft = self.heat(BEARING + source.format("rub-into-shaft"), output="shaft")["heat"]
        self.assertAlmostEqual(own["rub_into_ring"], into_ring, delta=1e-12 * rub)
        self.assertAlmostEqual(own["rub_into_shaft"], rub - into_ring, delta=1e-12 * rub)
        self.assertAlmostEqual(other["rub_into_ring"], 0.25 * rub, delta=1e-12 * rub)
        self.assertAlmostEqual(other["rub_into_shaft"], 0.75 * rub, delta=1e-12 * rub)
        self.assertEqual(shaft["rub_into_ring"], 0)
        self.assertAlmostEqual(shaft["rub_into_shaft"], rub - into_ring, delta=1e-12 * rub)
        self.assertEqual(other["inner"], 0)

    def test_pulses_bring_their_joules_divided_by_the_share(self):
        pulses = '[[heat.source]]\nport = "rub"\npulse = { height = "10 kW", width = "1 ms", period = "3 ms", count = 3 }\n'
        heat = self.heat(BEARING + pulses)["heat"]
        self.assertAlmostEqual(heat["rub_into_ring"], 0.66 * 30, delta=1e-11)
        self.assertAlmostEqual(heat["rub_into_shaft"], 0.34 * 30, delta=1e-11)

    def test_rotor_and_ring_touch_while_rub_heat_flows(self):
        """R2 + R3 = 0.06 K/W join shaft and ring while they touch, R2 + R3 and 1.6 K/W of air afterwards: of a ring that is 1 K warmer the shaft takes a
        twentieth of what it takes by the permanent link."""
        case = '[heat]\nbearing = "TB1"\noutput_times = ["1 ms", "2 ms", "0.1 s"]\n' + STEADY.replace("times = [0]\nvalues = [1e4]", 'pulse = { height = "100 kW", width = "2 ms" }')
        always, touching = (self.heat(case, "--set", f"thermal.shaft_ring_link={link}", output=link)["probes"]["lumped.shaft"]["temperature"] for link in ("permanent", "in-contact"))
        self.assertGreater(always[0], 293.15)
        self.assertAlmostEqual(always[1], touching[1], delta=1e-9)
        later = [T[2] - T[1] for T in (always, touching)]
        self.assertLess(later[1], 0.1 * later[0])
        self.assertGreater(later[1], 0)

    def test_without_probes_every_node_is_reported(self):
        summary = self.heat(BEARING + STEADY)
        self.assertEqual(set(summary["probes"]), {f"lumped.{n}" for n in ("shaft", "inner_ring", "inner_contact", "ball", "outer_contact", "outer_ring", "housing")})
        self.assertEqual(summary["probes"]["lumped.ball"]["time"], [1e-3, 5e-3, 1e-2])
        with h5py.File(self.folder / "out/results.h5", "r") as results:
            self.assertEqual(list(results["/probes/lumped.ball"]), summary["probes"]["lumped.ball"]["temperature"])
            self.assertEqual(list(results["/growth/lumped"][:, 1]), summary["growth"]["lumped"]["bore"])

    def test_the_resolved_case_runs_to_the_same_numbers_from_anywhere(self):
        self.run_case(self.case(""), output="drop")
        case = BEARING + '[[heat.source]]\nport = "all"\nrecorded = "drop/results.h5"\n' + STEADY
        first = self.heat(case)
        self.succeed("heat", "out/parameters.toml", "-o", "again")
        self.assertEqual(first["probes"], self.summary("again")["probes"])

    def test_a_drop_takes_no_notice_of_heat(self):
        with_heat, without = self.run_case(self.case(BEARING + STEADY)), self.run_case(self.case("", "plain.toml"), output="plain")
        self.assertEqual(with_heat["bearings"], without["bearings"])

    def test_check_builds_the_models(self):
        done = self.succeed("check", self.case(BEARING + STEADY))
        self.assertIn("bearing TB1: models lumped; 100 J", done.stdout)
        self.assertEqual(self.call("check", self.case(BEARING.replace("TB1", "TB") + STEADY)).returncode, 2)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_recorded_heat_gives_the_drops_own_finite_elements(self):
        """The same modes on heat that is spread evenly within rows of 50 us. Bodies exchange heat through their surfaces, the bore with the shaft at ten
        times the mean's rise, so a mean differs by ten times what the circuit's does; the surfaces themselves follow within a row and are not compared."""
        both = 'thermal.models = ["lumped", "fe"]\n'
        self.run_case(self.case(both), output="drop", run__end_time="30 ms")
        nodes = ["inner_ring", "outer_ring", "housing", "ball", "shaft"]
        summary = self.heat(both + '[heat]\nbearing = "TB1"\noutput_times = ["15 ms", "30 ms"]\n[[heat.source]]\nport = "all"\nrecorded = "drop/results.h5"\n'
                            + "".join(f'[[heat.probe]]\nname = "{n}"\nmodel = "fe"\nnode = "{n}"\n' for n in nodes))
        with h5py.File(self.folder / "drop/results.h5", "r") as results:
            largest = results["/fe/TB1/inner_ring"][-1] - 293.15
            self.assertGreater(largest, 0.1)
            for t, at in ((15e-3, 0), (30e-3, 1)):
                row = int(abs(results["/time"][:] - t).argmin())
                for n in nodes:
                    self.assertAlmostEqual(summary["probes"][n]["temperature"][at], results[f"/fe/TB1/{n}"][row], delta=2e-6 * largest, msg=n)
                growth = results["/growth/fe/TB1"][row]
                for name, value in zip(("shaft", "bore", "inner_race", "outer_race", "ball_radius", "inner_width", "outer_width", "row_difference"), growth):
                    self.assertAlmostEqual(summary["growth"]["fe"][name][at], value, delta=4e-6 * max(abs(growth)))
        self.assert_closed(summary)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_the_bore_follows_the_half_space_while_its_layer_is_thin(self):
        """Flux q into the bore of radius a from t = 0, depth without end: rise = 2 q/k sqrt(D t/pi) - q D t/(2 a k), D = k/(rho c); the third term
        is below 1e-4 of it at 1 ms. The link R2 to the shaft, which stays cold, takes rise/R2: a correction of -q_1 D^0.5/k c pi t/2/pi^0.5, where c is
        rise/t^0.5 and q_1 = 1/(R2 area)."""
        k, rho, c, a, width, watts = 70.0, 7800.0, 510.0, 35e-3, 20e-3, 1e4
        D, area, R2 = k / (rho * c), 2 * math.pi * a * width, 1 / (4 * math.pi * k * width)
        case = 'thermal.models = ["fe"]\nthermal.fe.section = "plain"\n' + BEARING.replace('"5 ms", "10 ms"', '"2 ms"') + STEADY + '[[heat.probe]]\nname = "bore"\nboundary = "inner_ring.inner"\n[[heat.probe]]\nname = "bore point"\nx = 0\nr = "35 mm"\n'
        for coupling, tolerance in (("reduced", 5e-3), ("windowed", 2e-3)):
            summary = self.heat(case, "--set", f"thermal.fe.coupling={coupling}", output=coupling)
            for t, T, T_point in zip((1e-3, 2e-3), summary["probes"]["bore"]["temperature"], summary["probes"]["bore point"]["temperature"]):
                slope = 2 * watts / area / k * math.sqrt(D / math.pi)
                rise = slope * math.sqrt(t) - watts / area * D * t / (2 * a * k) - slope * math.sqrt(D / math.pi) / k / (R2 * area) * math.pi * t / 2
                self.assertAlmostEqual((T - 293.15) / rise, 1, delta=tolerance, msg=f"{coupling} at {t} s")
                self.assertAlmostEqual((T_point - 293.15) / rise, 1, delta=tolerance, msg=f"{coupling} at {t} s")
            self.assert_closed(summary)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_modes_and_mesh_agree(self):
        """Heat into a race that is twenty times a drop's: modes within 0.2 %. Means of bodies agree but for the steps' tolerance; surfaces to what modes
        leave out. The mesh carries eq. 16 with the local rise, the modes with the mean, but the housing is hardly warm yet."""
        case = BEARING.replace('"10 ms"', '"50 ms"') + 'models = ["fe"]\n[[heat.source]]\nport = "rub"\ntimes = [0, 2e-3]\nvalues = [1e4, 0]\n[[heat.source]]\nport = "inner"\ninterpolation = "linear"\ntimes = [0, 0.05]\nvalues = [0, 2e3]\n'
        reduced, mesh = (self.heat(case, "--set", f"thermal.fe.coupling={coupling}", "--set", "thermal.fe.response_tolerance=2e-3", output=coupling) for coupling in ("reduced", "windowed"))
        self.assertEqual(set(reduced["probes"]), set(mesh["probes"]))
        for summary in (reduced, mesh):
            self.assertAlmostEqual(summary["energy"]["fe"]["input"], 20 + 50, delta=1e-10)
            self.assert_closed(summary)
        self.assertEqual(set(reduced["models"]["fe"]["response_error"]), {"bore", "shaft", "inner_raceway", "outer_raceway"})
        self.assertGreater(mesh["models"]["fe"]["factorisations"], 1)
        largest = max(probe["temperature"][-1] for probe in mesh["probes"].values()) - 293.15
        for name, probe in mesh["probes"].items():
            is_mean = name.split(".")[1] in ("inner_ring", "outer_ring", "housing", "ball", "shaft")
            for a, b in zip(reduced["probes"][name]["temperature"][1:], probe["temperature"][1:]):
                self.assertAlmostEqual(a, b, delta=(1e-6 if is_mean else 1e-3) * largest, msg=name)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_no_temperature_depends_on_heat_that_comes_later(self):
        """A watt for 5 s, and ten kilowatts after that or not: all that was before has the same bits. The time tolerance is of the mean rise so far, here 1e-6 of
        5 J over some kJ/K; a run with a thousandth of it differs by a few of those."""
        case = '[heat]\nbearing = "TB1"\nmodels = ["lumped", "fe"]\noutput_times = [1, 5]\n[[heat.source]]\nport = "inner"\ntimes = [0]\nvalues = [1]\n[[heat.source]]\nport = "rub-into-ring"\ntimes = [6, 6.5]\nvalues = [1e4, 0]\n'
        before, beyond, fine = (self.heat(case, *options, output=name) for name, options in (
            ("before", []), ("beyond", ["--set", "heat.end_time=7 s"]), ("fine", ["--set", "heat.time_tolerance=1e-9"])))
        for name, probe in before["probes"].items():
            self.assertEqual(probe["temperature"], beyond["probes"][name]["temperature"][:2], name)
            mean = before["energy"]["fe"]["stored"] / 2000  # K: of 2 kJ/K and more
            self.assertAlmostEqual(probe["temperature"][1], fine["probes"][name]["temperature"][1], delta=2e-5 * mean, msg=name)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_the_circuit_meets_the_finite_elements_under_steady_heat(self):
        """Both have the same resistances and capacities in other words: after 100 s of 20 W into both races the means differ by the few per cent that
        one temperature a body costs."""
        case = '[heat]\nbearing = "TB1"\nmodels = ["lumped", "fe"]\nend_time = "100 s"\n' + "".join(f'[[heat.source]]\nport = "{port}"\ntimes = [0]\nvalues = [20]\n' for port in ("inner", "outer"))
        summary = self.heat(case, "--set", "thermal.fe.coupling=windowed")
        self.assert_closed(summary)
        self.assertEqual(summary["energy"]["lumped"]["input"], summary["energy"]["fe"]["input"])
        for node in ("inner_ring", "outer_ring", "housing"):
            lumped, fe = (summary["probes"][f"{model}.{node}"]["temperature"][-1] - 293.15 for model in ("lumped", "fe"))
            self.assertGreater(fe, 0.5)
            self.assertAlmostEqual(lumped / fe, 1, delta=0.1, msg=node)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_a_plain_section_is_the_one_written_by_hand(self):
        """Outer ring and housing of TB1 as rectangles with fit, eq. 16 and tables of k and c, written down here; balls that conduct next to nothing to
        them. Only meshes and steps differ."""
        steel = 'k_table = [["293 K", 46], ["323 K", 30]]\nc_table = [["293 K", 460], ["323 K", 700]]\n'
        bearing = self.heat('thermal.models = ["fe"]\nthermal.contact_half_width = "1e-9 m"\n[thermal.fe]\nsection = "plain"\ncoupling = "windowed"\n[materials.steel]\n' + steel
                            + '[heat]\nbearing = "TB1"\noutput_times = ["50 ms", "2 s", "20 s"]\n[[heat.source]]\nport = "outer"\ntimes = [0, 10]\nvalues = [2e3, 0]\n'
                            + '[[heat.probe]]\nname = "race"\nboundary = "outer_ring.inner"\n[[heat.probe]]\nname = "fit"\nx = 0\nr = "55 mm"\nbody = "outer_ring"\n[[heat.probe]]\nname = "outside"\nboundary = "housing.outer"\n[[heat.probe]]\nname = "end"\nx = "12.5 mm"\nr = "55 mm"\n')
        area, fit = math.pi * 97.2e-3 * 20e-3, math.pi * 110e-3 * 20e-3
        # The bearing's plain section has no finer cells at the fit's ends; nor has this one, so that the two differ by little.
        self.succeed("heat", self.write("by-hand.toml", f"""
output_times = ["50 ms", "2 s", "20 s"]
fe.end_grading = 1
[materials.mine]
rho = 7800
{steel}
[[section.rectangle]]
name = "ring"
x = ["-10 mm", "10 mm"]
r = ["48.6 mm", "55 mm"]
material = "mine"
[[section.rectangle]]
name = "housing"
x = ["-12.5 mm", "12.5 mm"]
r = ["55 mm", "65 mm"]
material = "mine"
[[interface]]
between = ["ring.outer", "housing.inner"]
resistance = {0.005 * fit}
[[flux]]
boundary = "ring.inner"
times = [0, 10]
values = [{2e3 / area}, 0]
[[convection]]
boundary = "housing.outer"
coefficient = 23
exponent = 0.25
[[probe]]
name = "race"
boundary = "ring.inner"
[[probe]]
name = "fit"
x = 0
r = "55 mm"
[[probe]]
name = "outside"
boundary = "housing.outer"
[[probe]]
name = "end"
x = "12.5 mm"
r = "55 mm"
body = "housing"
"""), "-o", "hand")
        by_hand = self.summary("hand")
        self.assertGreater(by_hand["probes"]["race"]["temperature"][-1], 293.15 + 5)
        self.assertGreater(by_hand["energy"]["lost"], 0.005 * by_hand["energy"]["input"])
        for name, probe in by_hand["probes"].items():
            for mine, theirs in zip(bearing["probes"][name]["temperature"], probe["temperature"]):
                self.assertAlmostEqual(mine, theirs, delta=1e-4 * (max(probe["temperature"]) - 293.15), msg=name)
        self.assertAlmostEqual(bearing["energy"]["fe"]["lost"] / by_hand["energy"]["lost"], 1, delta=1e-4)
        self.assert_closed(bearing)

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_the_example_runs(self):
        self.succeed("heat", PARAMS / "heat/bearing.toml", "-o", "out")
        summary = self.summary()
        self.assertEqual(set(summary["energy"]), {"lumped", "fe"})
        self.assert_closed(summary)
        probes = {name: probe["temperature"] for name, probe in summary["probes"].items()}
        self.assertGreater(probes["bore surface"][1], probes["2 mm under the bore"][1] + 1)
        self.assertGreater(summary["growth"]["fe"]["inner_race"][-1], 0)


class HeatDeclarations(ProgramTest):
    def test_check_knows_a_case_of_heat(self):
        done = self.succeed("check", EXAMPLE)
        self.assertIn("bodies: ring, housing", done.stdout)
        self.assertIn("no errors found. Run it with `rotordrop heat`", done.stdout)
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


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
class KeptMatrices(ProgramTest):
    """A section that was assembled before is stepped without the finite elements, to the same last bit."""

    def heat(self, text, output, cache="cache", *options):
        """Whether the finite elements were loaded, and the temperatures of the rim."""
        cache = cache if cache == "off" else str(self.folder / cache)
        done = subprocess.run([PROGRAM, "heat", self.write("disc.toml", text), "-o", output, "--quiet", *options], cwd=self.folder, env={**os.environ, "ROTORDROP_CACHE": cache, "LD_DEBUG": "files"}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        summary = json.loads((self.folder / output / "summary.json").read_text())
        self.assertLess(abs(summary["energy"]["residual"]), 1e-9 * summary["energy"]["input"])
        return "rotordrop_fe.so" in done.stderr, summary["probes"]["rim"]["temperature"]

    def test_only_a_new_section_needs_the_finite_elements(self):
        is_loaded, first = self.heat(DISC, "first")
        self.assertTrue(is_loaded)
        is_loaded, second = self.heat(DISC, "second")
        self.assertFalse(is_loaded)
        self.assertEqual(second, first)
        is_loaded, without = self.heat(DISC, "without", "off")
        self.assertTrue(is_loaded)
        self.assertEqual(without, first)
        is_loaded, stronger = self.heat(DISC.replace("[1e5]", "[2e5]"), "stronger")
        self.assertFalse(is_loaded, "a flux is not of the section")
        for two, one in zip(stronger, first):
            self.assertAlmostEqual(two - 293.15, 2 * (one - 293.15), delta=1e-9)
        self.assertTrue(self.heat(DISC.replace("20 mm", "21 mm"), "larger")[0])

    def test_a_field_is_written_of_what_was_stepped(self):
        fields = DISC.replace("output_times", 'field_times = ["1 ms", "10 ms"]\noutput_times')
        self.heat(fields, "first")
        self.assertTrue(self.heat(fields, "second")[0], "deal.II writes it")
        files = sorted(path.relative_to(self.folder / "first") for path in (self.folder / "first/fields").rglob("*.vtu"))
        self.assertGreater(len(files), 1)
        for file in files:
            self.assertEqual((self.folder / "first" / file).read_bytes(), (self.folder / "second" / file).read_bytes())
        self.assertNotEqual(*((self.folder / "second" / file).read_bytes() for file in (files[0], files[-1])))

    def test_properties_over_temperature_are_stepped_by_the_finite_elements(self):
        text = DISC.replace('"steel"', '"own"') + '[materials.own]\nrho = 7800\nk_table = [[293, 46], [600, 36]]\nc = 460\nE = "210 GPa"\nnu = 0.3\nalpha = 1.1e-5\n'
        self.assertTrue(self.heat(text, "first")[0])
        self.assertTrue(self.heat(text, "second")[0])


@unittest.skipIf(HAS_ROOM, "built with the finite-element room")
class WithoutTheRoom(ProgramTest):
    def test_the_message_says_how_to_get_it(self):
        done = self.call("heat", EXAMPLE, "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("built without the finite-element module", done.stderr)
        self.assertIn("install-dependencies", done.stderr)
        self.assertFalse((self.folder / "out").exists())


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
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

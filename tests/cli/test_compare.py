"""`rotordrop compare`: the lumped circuit against the finite elements, and one run against another.

ROTORDROP_PROGRAM is the program under test. What needs the finite-element room is skipped where its module is not beside the program.
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys
import tomllib
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, SOURCE, ProgramTest, content_of, settings  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
NODES = ["shaft", "inner_ring", "ball", "outer_ring", "housing"]
GROWTH = ["shaft", "bore", "inner_race", "outer_race", "ball_radius", "inner_width", "outer_width", "row_difference"]
# The first contact lasts from 7.4 to 10.6 ms. Plain rectangles: the quickest section.


def si(value):
    """A bare number, or one whose unit is SI already."""
    return float(str(value).split()[0])


def short_case(test, name, models, end="15 ms", **keys):
    extra = "".join(f"{key.replace('__', '.')} = {value}\n" for key, value in keys.items())
    return test.write(name, f'base = "reference.toml"\nthermal.fe.section = "plain"\nrun.end_time = "{end}"\nthermal.models = {json.dumps(models)}\n{extra}')


class Lumped(ProgramTest):
    """Two runs of the circuit alone: no room needed."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        maker = cls("run_both")
        ProgramTest.setUp(maker)
        cls.maker = maker
        maker.succeed("run", short_case(maker, "a.toml", ["lumped"]), "-o", "a")
        maker.succeed("run", short_case(maker, "b.toml", ["lumped"], contact__friction_coefficient=0.2), "-o", "b")

    @classmethod
    def tearDownClass(cls):
        cls.maker.doCleanups()
        super().tearDownClass()

    def run_both(self):
        pass

    def setUp(self):
        super().setUp()
        for name in ("a", "b"):
            shutil.copytree(self.maker.folder / name, self.folder / name)

    def refused(self, *arguments):
        before = content_of(self.folder)
        done = self.call("compare", *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(content_of(self.folder), before)
        return done.stderr

    def test_one_run_is_compared_with_another(self):
        text = self.succeed("compare", "a", "--against", "b").stdout
        self.assertIn("Growth driver lumped in this run, lumped in the other", text)
        report = json.loads((self.folder / "a/comparison.json").read_text())
        self.assertEqual(report["run"]["driver"], "lumped")
        self.assertIsNone(report["fe_from"])
        with h5py.File(self.folder / "a/results.h5") as a, h5py.File(self.folder / "b/results.h5") as b:
            for name in ("TB1", "TB2"):
                runs = report["bearings"][name]["runs"]
                for key, file in (("this", a), ("against", b)):
                    force = file[f"/bearings/{name}/contact_force"][:]
                    self.assertEqual(runs["forces"][key]["peak_contact_force"], force.max())
                    self.assertEqual(runs["forces"][key]["impulse"], file[f"/ledger/{name}/contact_impulse"][-1])
                for node in NODES:
                    difference = b[f"/thermal/{name}/{node}"][:] - a[f"/thermal/{name}/{node}"][:]
                    found = runs["temperatures"]["lumped"][node]
                    self.assertEqual(found["largest_difference"], difference[numpy.argmax(abs(difference))])
                    self.assertEqual(found["at"][-1]["difference"], difference[-1])
                # Twice the friction: nearly twice the heat while the ring is slow.
                self.assertGreater(runs["forces"]["against"]["rub_heat"], 1.5 * runs["forces"]["this"]["rub_heat"])
                self.assertEqual(report["bearings"][name]["bore"]["mean_from"], "half space")
                self.assertNotIn("temperatures", report["bearings"][name])

    def test_runs_of_other_lengths_are_compared_over_the_time_that_both_have(self):
        # The same drop, cut within its first impact (7.4 to 10.6 ms): up to there nothing differs.
        self.succeed("run", short_case(self, "short.toml", ["lumped"], end="9 ms"), "-o", "short")
        for this, other in (("a", "short"), ("short", "a")):
            text = self.succeed("compare", this, "--against", other).stdout
            self.assertIn("compared until 9 ms, the end of the shorter one", text)
            report = json.loads((self.folder / this / "comparison.json").read_text())
            with h5py.File(self.folder / "a/results.h5") as file:
                within = file["/time"][:] <= 9e-3 + 1e-12
                for name in ("TB1", "TB2"):
                    runs = report["bearings"][name]["runs"]
                    self.assertAlmostEqual(runs["until"], 9e-3, delta=1e-12)
                    self.assertEqual(sorted(round(end, 9) for end in runs["ends"].values()), [9e-3, 15e-3])
                    for forces in runs["forces"].values():
                        self.assertAlmostEqual(forces["peak_contact_force"], file[f"/bearings/{name}/contact_force"][within].max(), delta=1e-2)
                        for key, path in (("impulse", "contact_impulse"), ("rub_heat", "rub_heat")):
                            total = file[f"/ledger/{name}/{path}"][within][-1]
                            self.assertAlmostEqual(forces[key], total, delta=1e-6 * total, msg="the last step of the shorter run ends at its end")
                    self.assertAlmostEqual(runs["forces"]["this"]["first_impact_peak"], runs["forces"]["against"]["first_impact_peak"], delta=1e-2)
        self.assertNotIn("the shorter one", self.succeed("compare", "a", "--against", "b").stdout)

    def test_a_run_against_itself_differs_by_nothing(self):
        self.succeed("compare", "a", "--against", "a")
        report = json.loads((self.folder / "a/comparison.json").read_text())
        for bearing in report["bearings"].values():
            for found in [bearing["runs"]["air_gap"], *bearing["runs"]["expansion"].values(), *bearing["runs"]["temperatures"]["lumped"].values()]:
                self.assertEqual((found["largest_difference"], found["beyond_from"], found["time_beyond"]), (0, None, 0))

    def test_results_that_lack_surfaces_count_as_zero_there(self):
        """Growth was radial once (five surfaces), then alike in all rows (seven): comparison, preload and a recorded driver read such results as if those were zero."""
        for n in (5, 7):
            for name in ("old", "zero"):
                shutil.rmtree(self.folder / name, ignore_errors=True)
                shutil.copytree(self.folder / "b", self.folder / name)
                with h5py.File(self.folder / name / "results.h5", "a") as file:
                    for path in [f"/bearings/{bearing}/expansion" for bearing in ("TB1", "TB2")]:
                        values, attributes = file[path][:], dict(file[path].attrs)
                        values[:, n:] = 0
                        del file[path]
                        dataset = file.create_dataset(path, data=values[:, :n] if name == "old" else values)
                        for key, value in attributes.items():
                            dataset.attrs[key] = value
            reports, histories, drops = [], [], []
            for name in ("old", "zero"):
                self.succeed("compare", "a", "--against", name, "-o", "c.json", "--force")
                reports.append(json.loads((self.folder / "c.json").read_text())["bearings"]["TB1"]["runs"]["expansion"])
                self.succeed("preload", "reference.toml", "--bearing", "TB2", "--results", name, "-o", f"p-{name}", "--force", *settings(preload__growth_by_speed="none"))
                histories.append(json.loads((self.folder / f"p-{name}/preload.json").read_text())["bearings"]["TB2"]["history"])
                self.succeed("run", short_case(self, f"{name}.toml", ["lumped"], thermal__driver='"recorded"', thermal__recorded=json.dumps(f"{name}/results.h5")), "-o", f"d-{name}", "--force")
                with h5py.File(self.folder / f"d-{name}/results.h5") as file:
                    drops.append(file["/bearings/TB2/expansion"][:])
            self.assertEqual(list(reports[0]), GROWTH)
            self.assertEqual(reports[0], reports[1])
            self.assertEqual(histories[0]["preload"], histories[1]["preload"])
            numpy.testing.assert_array_equal(drops[0], drops[1])

    def test_one_model_alone_has_nothing_to_be_compared_with(self):
        message = self.refused("a")
        self.assertIn("no finite elements to compare with", message)
        self.assertIn("--against", message)

    def test_directories_that_hold_no_run_are_named(self):
        self.assertIn("nowhere: there is no such directory", self.refused("nowhere"))
        self.assertIn("nowhere: there is no such directory", self.refused("a", "--against", "nowhere"))
        (self.folder / "empty").mkdir()
        self.assertIn("empty: the directory does not contain results.h5", self.refused("empty"))
        self.assertIn("this is not a directory", self.refused("a/results.h5"))
        (self.folder / "a/parameters.toml").unlink()
        self.assertIn("a: the directory does not contain parameters.toml", self.refused("a", "--against", "b"))

    def test_a_file_that_is_no_result_is_named(self):
        (self.folder / "b/results.h5").write_text("no HDF5")
        self.assertIn("b/results.h5", self.refused("a", "--against", "b"))

    def test_bearings_of_other_names_cannot_be_compared(self):
        names = (self.folder / "reference.toml").read_text().replace("bearings.TB1", "bearings.X1").replace("bearings.TB2", "bearings.X2")
        self.write("other.toml", names)
        self.succeed("run", "other.toml", "-o", "c", *settings(run__end_time="1 ms"))
        self.assertIn("no touchdown bearing there has the same name as one in a", self.refused("a", "--against", "c"))

    def test_options_are_checked(self):
        for option, value, says in (("--tolerance", "5 um", "--tolerance"), ("--tolerance", "0 %", "not a percentage above zero"), ("--floor", "1 mm", "--floor"), ("--growth-tolerance", "-1 um", "above zero"),
                                    ("--times", "10 mm", "--times"), ("--band-length", "0", "--band-length"), ("-o", "report.h5", "the report is JSON")):
            with self.subTest(option=option, value=value):
                words = [f"{option}={value}"] if option.startswith("--") else [option, value]
                self.assertIn(says, self.refused("a", "--against", "b", *words))

    def test_bare_numbers_that_are_unusual_are_told_with_what_may_be_meant(self):
        for option, value, says in (("--growth-tolerance", "0.1", '0.1 m is unusual: it is most often between 1e-10 and 5e-06 m.|If um is meant, write "0.1 um".'),
                                    ("--band-length", "5.9", '5.9 m is unusual|If mm is meant, write "5.9 mm".'), ("--band-length", "5.9 m", "5.9 m is unusual|Check the number and its unit."),
                                    ("--floor", "50", "50 K is unusual"), ("--tolerance", "0.05", '0.05 K|"5 %"'), ("--tolerance", "5", '"5 K"|"5 %"')):
            with self.subTest(option=option, value=value):
                message = self.succeed("compare", "a", "--against", "b", "--quiet", option, value).stderr
                self.assertTrue(message.startswith(f"warning: {option}: "), message)
                for words in says.split("|"):
                    self.assertIn(words, message)
        for option, value in (("--growth-tolerance", "1e-7"), ("--band-length", "0.003"), ("--floor", "0.01"), ("--tolerance", "5 %"), ("--tolerance", "2 mK")):
            self.assertEqual(self.succeed("compare", "a", "--against", "b", "--quiet", option, value).stderr, "")

    def test_a_mistyped_option_is_named_with_the_right_one(self):
        message = self.refused("a", "--agianst", "b")
        self.assertIn("Did you mean --against?", message)

    def test_only_its_own_report_is_replaced_without_force(self):
        self.succeed("compare", "a", "--against", "b", "--quiet")
        first = (self.folder / "a/comparison.json").read_text()
        self.assertEqual(self.succeed("compare", "a", "--against", "b", "--quiet").stdout, "")
        self.assertEqual((self.folder / "a/comparison.json").read_text(), first)
        self.write("report.json", "mine")
        self.assertIn("report.json: the file already exists", self.refused("a", "--against", "b", "-o", "report.json"))
        self.succeed("compare", "a", "--against", "b", "-o", "report.json", "--force")
        self.assertEqual((self.folder / "report.json").read_text(), first)
        self.succeed("compare", "a", "--against", "b", "-o", "new/deep/report.json")
        self.assertTrue((self.folder / "new/deep/report.h5").is_file())

    def test_a_band_is_not_shorter_than_what_surfaces_are_rough(self):
        message = self.refused("a", "--against", "b", "--band-length", "1 nm")
        self.assertIn("--band-length: 1 nm is out of range: it must be 1 um at least", message)

    def test_force_replaces_neither_what_is_read_nor_what_was_not_named(self):
        for name in ("io", "other"):
            shutil.copytree(self.folder / "b", self.folder / name)
        self.write("mine.h5", "mine")
        before = content_of(self.folder)
        for output, says in (("io/results.json", "io/results.h5"), ("io/summary.json", "io/summary.json"), ("io/parameters.toml", "io/parameters.toml"),
                             ("a/results.json", "a/results.h5"), ("other/results.json", "other/results.h5"), ("mine.json", "mine.h5")):
            with self.subTest(output):
                self.assertIn(says, self.refused("a", "--against", "io", "-o", output, "--force"))
        self.assertEqual(content_of(self.folder), before)

    def test_a_new_run_removes_the_old_comparison(self):
        self.succeed("compare", "a", "--against", "b", "--quiet")
        self.succeed("run", self.case(""), "-o", "a", "--force", *settings(run__end_time="1 ms"))
        self.assertEqual(sorted(content_of(self.folder / "a")), ["parameters.toml", "results.h5", "summary.json"])


@unittest.skipUnless(HAS_ROOM, "the finite-element room is not built")
class LumpedAndFiniteElements(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        maker = cls("run_both")
        ProgramTest.setUp(maker)
        cls.maker = maker
        cls.screen = maker.succeed("run", short_case(maker, "both.toml", ["lumped", "fe"]), "-o", "both").stdout
        cls.out = maker.folder / "both"
        cls.report = json.loads((cls.out / "comparison.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.maker.doCleanups()
        super().tearDownClass()

    def run_both(self):
        pass

    def bearings(self):
        with h5py.File(self.out / "results.h5") as results, h5py.File(self.out / "comparison.h5") as series:
            for name in ("TB1", "TB2"):
                yield name, self.report["bearings"][name], results, series

    def test_a_run_of_both_models_is_compared_at_its_end(self):
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), ["comparison.h5", "comparison.json", "parameters.toml", "results.h5", "summary.json"])
        for name in ("TB1", "TB2"):
            text = " ".join(line for line in self.report["in_short"] if line.startswith(name + ": "))
            for words in ("5 % of the rise at the time (at least 0.01 K)", "Beyond the tolerance from", "Local bore temperature"):
                self.assertIn(words, text)
        for line in self.report["in_short"]:
            self.assertIn(line, self.screen)

    def test_the_command_gives_the_same_report(self):
        done = self.call("compare", self.out, "-o", "again.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        again = json.loads((self.folder / "again.json").read_text())
        self.assertEqual(again["bearings"], self.report["bearings"])

    def test_differences_are_finite_elements_less_circuit(self):
        for name, b, results, _ in self.bearings():
            times = results["/time"][:]
            rise = max(numpy.abs(results[f"/{model}/{name}/{node}"][:] - 293.15).max() for model in ("thermal", "fe") for node in NODES)
            self.assertAlmostEqual(b["largest_rise"], rise, delta=1e-12)
            pairs = [(b["temperatures"][node], results[f"/thermal/{name}/{node}"][:], results[f"/fe/{name}/{node}"][:], (0.01, 0.05)) for node in NODES]
            for column, kind in enumerate(("mean", "lowest", "highest")):
                pairs.append((b["surfaces"]["bore"][kind], results[f"/thermal/{name}/inner_ring"][:], results[f"/fe/{name}/bore"][:, column], (0.01, 0.05)))
                pairs.append((b["surfaces"]["inner_raceway"][kind], results[f"/thermal/{name}/inner_contact"][:], results[f"/fe/{name}/inner_raceway"][:, column], (0.01, 0.05)))
            for column, surface in enumerate(GROWTH):
                pairs.append((b["growth"][surface], results[f"/growth/lumped/{name}"][:, column], results[f"/fe/{name}/elastic_growth"][:, column], (1e-7, 0)))
            for found, lumped, fe, (floor, part) in pairs:
                difference = fe - lumped
                allowed = numpy.maximum(floor, part * numpy.maximum(abs(lumped - 293.15), abs(fe - 293.15)))
                worst = numpy.argmax(abs(difference))
                self.assertEqual(found["largest_difference"], difference[worst])
                self.assertEqual(found["largest_difference_time"], times[worst])
                self.assertEqual((found["tolerance"], found["tolerance_part"]), (floor, part))
                self.assertEqual(found["beyond_from"] is None, bool((abs(difference) <= allowed).all()))
                self.assertEqual(found["within_from"] is None, bool(abs(difference[-1]) > allowed[-1]))
                if found["beyond_from"] is not None:
                    first = numpy.argmax(abs(difference) > allowed)
                    self.assertTrue(times[max(first - 1, 0)] <= found["beyond_from"] <= times[first])
                for entry in found["by_time"]:
                    until = times <= entry["until"]
                    self.assertAlmostEqual(entry["usage"], (abs(difference) / allowed)[until].max(), delta=1e-9 * max(entry["usage"], 1))
                self.assertEqual([entry["until"] for entry in found["by_time"]], [1e-3, 3e-3, 10e-3, times[-1]])
                for instant in found["at"]:
                    i = numpy.argmin(abs(times - instant["time"]))
                    self.assertAlmostEqual(instant["difference"], difference[i], delta=1e-9)
                    self.assertAlmostEqual(instant["fe"] - instant["lumped"], instant["difference"], delta=1e-12)

    def test_air_gap_and_ball_play_follow_from_growth(self):
        for name, b, results, _ in self.bearings():
            growth = {"lumped": results[f"/growth/lumped/{name}"][:], "fe": results[f"/fe/{name}/elastic_growth"][:]}
            self.assertEqual(b["growth_by"], "elasticity")
            last = b["clearances"]["air_gap"]["at"][-1]
            # The circuit drives: its air gap is the one that the drop felt.
            self.assertAlmostEqual(last["lumped"], results[f"/bearings/{name}/clearance"][-1], delta=1e-13)
            self.assertAlmostEqual(last["difference"], numpy.dot(growth["fe"][-1] - growth["lumped"][-1], [-1, 1, 0, 0, 0, 0, 0, 0]), delta=1e-15)
            lean = {"TB1": 1, "TB2": math.cos(math.radians(25))}[name]
            # Contact points lie at x_row -+ s (d/2) sin phi, s = +1 in the row at +x of an X pair, and move by x/W of their ring's widths; the
            # rows' mean of s x_row is 8 mm for TB2.
            side, half, apart, width = {"TB1": (0, 0, 0, 20e-3), "TB2": (math.sin(math.radians(25)), 4.7625e-3 * math.sin(math.radians(25)), 8e-3, 32e-3)}[name]
            approach = [0, 0, lean, -lean, 2, side * (apart - half) / width, -side * (apart + half) / width, 0]
            for model in ("lumped", "fe"):
                self.assertAlmostEqual(b["ball_approach"]["at"][-1][model], numpy.dot(growth[model][-1], approach), delta=1e-15)
            self.assertAlmostEqual(b["clearances"]["ball_play_change"]["at"][-1]["fe"], -numpy.dot(growth["fe"][-1], approach), delta=1e-15)

    def test_no_verdict_on_growth_goes_beyond_what_elasticity_allows(self):
        """With growth by formula, which the finite elements' means feed too, the verdict is that of elasticity."""
        for name, b, results, _ in self.bearings():
            off = numpy.abs(results[f"/growth/lumped/{name}"][:] - results[f"/fe/{name}/elastic_growth"][:]) > 1e-7
            ends = [surface for column, surface in enumerate(GROWTH) if not off[:, column].any()]
            self.assertEqual([surface for surface in GROWTH if b["growth"][surface]["beyond_from"] is None], ends)
            short = next(line for line in self.report["in_short"] if line.startswith(name + ": In short"))
            growth = short.split("its growth, judged by elasticity")[1].split("its clearances")[0]
            self.assertEqual("to the end of the run" in growth, not off.any(), short)
            verdict = " ".join(line for line in self.report["verdict"] if line.startswith(name + ": Growth"))
            self.assertIn("judged by elasticity", verdict)

    def test_preload_at_rest_is_told_for_both_models(self):
        for name, b, results, _ in self.bearings():
            self.assertEqual(len(b["effect"]), {"TB1": 0, "TB2": 3}[name])
            for entry in b["effect"]:
                for model in ("lumped", "fe"):
                    self.assertTrue(200 < entry[model]["preload"] < 800, entry)
                    self.assertGreater(entry[model]["largest_ball_load"], 25)

    def test_the_first_impact_is_the_recorded_one(self):
        for name, b, results, _ in self.bearings():
            times, penetration = results["/time"][:], results[f"/bearings/{name}/penetration"][:]
            start = numpy.argmax(penetration > 0)
            end = start + numpy.argmax(penetration[start:] <= 0)
            self.assertTrue(times[start - 1] <= b["first_contact_time"] <= times[start])
            self.assertTrue(times[end - 1] <= b["first_contact_end"] <= times[end])
            peak = b["bore"]["at"][0]
            self.assertEqual(peak["instant"], "first impact's peak")
            self.assertEqual(results[f"/bearings/{name}/contact_force"][:][numpy.argmin(abs(times - peak["time"]))], b["forces"]["first_impact_peak"])

    def test_the_ring_turns_by_the_integral_of_its_speed(self):
        for name, b, results, series in self.bearings():
            times, speed = results["/time"][:], results[f"/bearings/{name}/ring_speed"][:]
            turns = numpy.concatenate([[0], numpy.cumsum(0.5 * (speed[1:] + speed[:-1]) * numpy.diff(times))]) / (2 * math.pi)
            first = series[f"/bore/{name}/ring_turns"][:]
            self.assertAlmostEqual(first[-1], turns[-1], delta=1e-9)
            impact = b["bore"]["first_impact"]
            at = numpy.interp([b["first_contact_time"], b["first_contact_end"]], times, 2 * math.pi * turns)
            self.assertAlmostEqual(impact["ring_angle"], at[1] - at[0], delta=1e-9)

    def test_the_arc_is_what_the_contact_sweeps_of_the_ring(self):
        for name, b, results, series in self.bearings():
            times = results["/time"][:]
            way = results[f"/bearings/{name}/orbit"][:] - results[f"/bearings/{name}/ring_position"][:]
            angle = numpy.unwrap(numpy.arctan2(way[:, 1], way[:, 0]))
            speed = results[f"/bearings/{name}/ring_speed"][:]
            turned = numpy.concatenate([[0], numpy.cumsum(0.5 * (speed[1:] + speed[:-1]) * numpy.diff(times))])
            place = angle - turned
            # Rows at whose end heat was given; the contact's place on the ring from the first to the last of them.
            rubbed = numpy.diff(results[f"/ledger/{name}/rub_heat_into_ring"][:])
            rows = 1 + numpy.nonzero((rubbed > 1e-9 * rubbed.max()) & (times[1:] <= b["first_contact_end"]))[0]
            expected = numpy.abs(numpy.diff(place[rows])).sum() * 0.035
            self.assertAlmostEqual(b["bore"]["first_impact"]["arc"], expected, delta=1e-9)
            self.assertTrue(1e-3 < expected < 10e-3, expected)

    def test_local_temperatures_are_the_mean_and_what_the_swept_arc_has_over_it(self):
        for name, b, results, series in self.bearings():
            local, mean, flash = (series[f"/bore/{name}/{key}"][:] for key in ("local", "mean", "flash"))
            numpy.testing.assert_allclose(mean, results[f"/fe/{name}/bore"][:, 0], rtol=0, atol=1e-9)
            self.assertTrue((local >= mean - 1e-9).all())
            touching = numpy.isfinite(flash)
            self.assertTrue((flash[touching] <= local[touching] + 1e-9).all())
            self.assertEqual(touching.any(), True)
            self.assertFalse(touching[series[f"/bore/{name}/time"][:] < 7e-3].any())
            excess = local - series[f"/bore/{name}/inner_ring"][:]
            self.assertAlmostEqual(b["bore"]["largest_local_over_node"]["value"], excess.max(), delta=1e-9)
            # The same heat as one Jaeger band of even heat and speed: a pulse that peaks in its middle is hotter than its mean by less than half.
            impact = b["bore"]["first_impact"]
            self.assertTrue(impact["steady_band_rise"] < impact["largest_local_rise"] < 1.6 * impact["steady_band_rise"], impact)
            before, after = numpy.interp([b["first_contact_time"], b["first_contact_end"]], results["/time"][:], results[f"/ledger/{name}/rub_heat_into_ring"][:])
            self.assertAlmostEqual(impact["heat_into_ring"], after - before, delta=1e-9)

    def test_the_hottest_place_is_that_of_heat_summed_over_the_swept_arc(self):
        """The half space under what passed over each place, by the plain sum of sqrt(t - s); the spot stands still for each row's interval."""
        parameters = tomllib.loads((self.out / "parameters.toml").read_text())
        for name, b, results, series in self.bearings():
            bearing = parameters["bearings"][name]
            steel = parameters["materials"][bearing["ring"]]
            k, capacity = si(steel["k"]), si(steel["rho"]) * si(steel["c"])
            half, radius, width = b["bore"]["half_width"], 0.035, b["bore"]["axial_width"]
            times, heat = results["/time"][:], results[f"/ledger/{name}/rub_heat_into_ring"][:]
            way = results[f"/bearings/{name}/orbit"][:] - results[f"/bearings/{name}/ring_position"][:]
            speed = results[f"/bearings/{name}/ring_speed"][:]
            turned = numpy.concatenate([[0], numpy.cumsum(0.5 * (speed[1:] + speed[:-1]) * numpy.diff(times))])
            place = numpy.unwrap(numpy.arctan2(way[:, 1], way[:, 0])) - turned
            cells = (numpy.arange(7200) + 0.5) * 2 * math.pi / 7200
            for t in (8.5e-3, 9.5e-3, 11.5e-3):
                last = numpy.argmin(abs(times - t))
                rise = numpy.zeros_like(cells)
                for i in range(1, last + 1):
                    flux = (heat[i] - heat[i - 1]) / (times[i] - times[i - 1]) / (2 * half * width)
                    if flux <= 0:
                        continue
                    middle = 0.5 * (place[i - 1] + place[i])
                    distance = numpy.abs((cells - middle + math.pi) % (2 * math.pi) - math.pi) * radius
                    kernel = 2 * (math.sqrt(times[last] - times[i - 1]) - math.sqrt(max(times[last] - times[i], 0)))
                    rise[distance < half] += flux * kernel / math.sqrt(math.pi * k * capacity)
                found = (series[f"/bore/{name}/local"][:] - series[f"/bore/{name}/mean"][:])[last]
                # The spot moves 0.1 of its half width in a row at most, and matters to the hottest place only with its ends.
                self.assertAlmostEqual(found / (rise.max() - rise.mean()), 1, delta=0.02)

    def test_figures_are_drawn(self):
        shutil.copytree(self.out, self.folder / "both")
        done = subprocess.run([sys.executable, SOURCE / "examples/plot_comparison.py", "both", "--against", "both", "--dpi", "50"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        names = {path.stem for path in (self.folder / "both/figures").iterdir()}
        self.assertEqual(names, {"comparison_temperatures", "comparison_impact", "comparison_growth", "comparison_forces"})
        self.assertNotIn("not in the files", done.stdout)
        (self.folder / "both/comparison.json").unlink()
        done = subprocess.run([sys.executable, SOURCE / "examples/plot_comparison.py", "both"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("rotordrop compare", done.stderr)

    def test_a_series_that_is_no_number_is_named(self):
        shutil.copytree(self.out, self.folder / "broken")
        with h5py.File(self.folder / "broken/results.h5", "r+") as file:
            file["/fe/TB2/housing"][200:] = math.nan
        done = self.call("compare", "broken")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"/fe/TB2/housing is not a number at t = 10 ms")

    def test_a_narrower_band_is_hotter(self):
        self.assertEqual(self.call("compare", self.out, "--band-length", "3 mm", "-o", "narrow.json").returncode, 0)
        narrow = json.loads((self.folder / "narrow.json").read_text())
        for name, b, _, _ in self.bearings():
            found = narrow["bearings"][name]["bore"]
            self.assertAlmostEqual(found["half_width"], 1.5e-3, delta=1e-15)
            self.assertGreater(found["largest_local_over_node"]["value"], b["bore"]["largest_local_over_node"]["value"])

    def test_tolerances_and_instants_are_those_asked_for(self):
        done = self.call("compare", self.out, "--tolerance", "2 mK", "--growth-tolerance", "1 nm", "--times", "9 ms,12 ms, 1 s", "-o", "fine.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line for line in done.stderr.splitlines() if "--times" in line], ["warning: --times: 1000 ms lies beyond the end at 15 ms and is left out."])
        fine = json.loads((self.folder / "fine.json").read_text())
        for b in fine["bearings"].values():
            ring = b["temperatures"]["inner_ring"]
            self.assertEqual((ring["tolerance"], ring["tolerance_part"]), (0.002, 0))
            self.assertEqual([entry["instant"] for entry in ring["at"]], ["first impact's peak", "9 ms", "12 ms", "end"])
            self.assertEqual(b["growth"]["bore"]["tolerance"], 1e-9)

    def test_what_is_said_of_the_beginning_does_not_depend_on_the_end(self):
        """The tolerance is of the rise at the time. Steps of both runs are the same but for the last; modes are chosen for the run's length, and each choice is good to 0.5 %: two
        of them may differ by 1 %."""
        short = {}
        for end in ("0.3 s", "3 s", "10 s"):
            name = end.replace(" ", "")
            self.maker.succeed("run", short_case(self.maker, name + ".toml", ["lumped", "fe"], end=end, output__interval='"0.5 ms"'), "-o", name, "--quiet")
            report = json.loads((self.maker.folder / name / "comparison.json").read_text())
            for bearing, b in report["bearings"].items():
                for group in ("temperatures", "growth", "clearances"):
                    for key, found in b[group].items():
                        from_start = found["beyond_from"] if found["beyond_from"] is not None and found["beyond_from"] < 0.29 else None
                        worst = {entry["until"]: entry["usage"] for entry in found["by_time"] if entry["until"] <= 0.1}
                        first = short.setdefault((bearing, group, key), (from_start, worst))
                        with self.subTest(bearing=bearing, group=group, key=key, end=end):
                            self.assertEqual(from_start is None, first[0] is None)
                            if from_start is not None:
                                self.assertAlmostEqual(from_start / first[0], 1, delta=1e-2)
                            self.assertEqual(list(worst), list(first[1]))
                            for until, usage in worst.items():
                                self.assertAlmostEqual(usage, first[1][until], delta=1e-2 * first[1][until] + 1e-4)
        self.assertTrue(any(first for first, _ in short.values()), "nothing left its tolerance: the test would see nothing")

    def test_reasons_are_temperatures_at_the_time_of_leaving(self):
        for name, b, results, _ in self.bearings():
            times = results["/time"][:]
            self.assertEqual(set(b["reasons"]), {node for node, d in b["temperatures"].items() if d["beyond_from"] is not None})
            for node, reason in b["reasons"].items():
                t = b["temperatures"][node]["beyond_from"]
                at = lambda path, column=None: numpy.interp(t, times, results[path][:] if column is None else results[path][:, column])
                if node in ("shaft", "inner_ring"):
                    self.assertAlmostEqual(reason["bore_over_ring"], at(f"/fe/{name}/bore", 0) - at(f"/fe/{name}/inner_ring"), delta=1e-9)
                if node in b["lumping"]:
                    self.assertEqual(reason["biot"], b["lumping"][node]["biot"])

    def test_fourier_numbers_follow_from_lengths_and_times(self):
        for name, b, _, _ in self.bearings():
            ring = b["lumping"]["inner_ring"]
            self.assertAlmostEqual(ring["length"], {"TB1": 0.0045, "TB2": 0.004}[name], delta=2e-3)
            for entry in ring["at"]:
                self.assertAlmostEqual(entry["fourier"], ring["diffusivity"] * entry["time_since_contact"] / ring["length"] ** 2, delta=1e-12)
                self.assertAlmostEqual(entry["depth"] ** 2, ring["diffusivity"] * entry["time_since_contact"], delta=1e-15)

    def test_a_run_of_finite_elements_takes_the_circuit_from_another(self):
        self.maker.succeed("run", short_case(self.maker, "fe.toml", ["fe"]), "-o", "fe")
        done = self.maker.call("compare", "fe")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no lumped thermal circuit to compare with", done.stderr)
        self.maker.succeed("compare", "fe", "--against", "both", "-o", "mixed.json")
        mixed = json.loads((self.maker.folder / "mixed.json").read_text())
        self.assertEqual((mixed["fe_from"], mixed["lumped_from"], mixed["run"]["driver"], mixed["against"]["driver"]), ("fe", "both", "fe", "lumped"))
        for b in mixed["bearings"].values():
            self.assertIn("temperatures", b)
            self.assertEqual(list(b["runs"]["temperatures"]), ["fe"])
            # Each with its own growth, the drops stay together in the first 15 ms: to a thousandth of the force.
            forces = b["runs"]["forces"]
            self.assertAlmostEqual(forces["against"]["peak_contact_force"] / forces["this"]["peak_contact_force"], 1, delta=1e-3)

    def test_windows_are_compared_at_their_ends(self):
        case = short_case(self.maker, "windows.toml", ["lumped", "fe"], end="9 ms", thermal__fe__coupling='"windowed"')
        self.maker.succeed("run", case, "-o", "windows")
        report = json.loads((self.maker.folder / "windows/comparison.json").read_text())
        with h5py.File(self.maker.folder / "windows/results.h5") as results:
            for name, b in report["bearings"].items():
                times = results["/windows/time"][:]
                lumped = numpy.interp(times, results["/time"][:], results[f"/thermal/{name}/inner_ring"][:])
                for found, fe in ((b["temperatures"]["inner_ring"], results[f"/windows/{name}/inner_ring"][:]), (b["surfaces"]["bore"]["mean"], results[f"/windows/{name}/bore"][:, 0])):
                    self.assertAlmostEqual(found["largest_difference"], (fe - lumped)[numpy.argmax(abs(fe - lumped))], delta=1e-9)
                    self.assertIn(found["largest_difference_time"], times)


if __name__ == "__main__":
    unittest.main()

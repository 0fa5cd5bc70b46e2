"""`rotordrop report`: one HTML page of a run, opened in a headless browser where one is installed.

The browser is Debian's chromium, driven through chromium-driver by the WebDriver protocol (`./install-dependencies --tests`).
"""

import base64
import hashlib
import json
import math
import pathlib
import re
import shutil
import signal
import sys
import time
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from browser import BROWSER, DRIVER, Browser  # noqa: E402
from program import PARAMS, PROGRAM, SOURCE, ProgramTest, content_of, page_data, settings, start  # noqa: E402

sys.path.insert(0, str(SOURCE / "examples"))
from rotordrop_results import RISE, Results, read_vtu  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
LARGEST = 5_000_000  # bytes of a page


def numbers_of(text, kind):
    """Numbers that the page has as base64, the lowest byte first."""
    return numpy.frombuffer(base64.b64decode(text), kind).astype(float)


def unpacked(packed):
    return packed["low"] + (packed["high"] - packed["low"]) * numbers_of(packed["levels"], "<u2") / 65535


def data_of(page):
    """What the page's script draws from, packed lines as lists."""
    data = page_data(page)
    for chart in data["charts"]:
        for line in chart["lines"]:
            if "levels" in line:
                line.update(x=numbers_of(data["axes"][line["axis"]], "<f4").tolist(), y=unpacked(line).tolist())
    return data


class SharedRun(ProgramTest):
    """Tests that look at one run, made once: the reference case's first 15 ms."""

    models = ["lumped"]

    @classmethod
    def text(cls):
        """The case, beside which the files of params lie."""
        return f'''base = "reference.toml"
thermal.fe.section = "plain"
run.end_time = "15 ms"  # as long as it takes
bearings.drag_viscosity = "16e-6 m2/s" # warm air
thermal.models = {json.dumps(cls.models)}
{'thermal.fe.field_times = ["3 ms", "8.3 ms", "8.6 ms", "12 ms", "15 ms"]' if "fe" in cls.models else ""}
'''

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        maker = cls("make")
        ProgramTest.setUp(maker)
        cls.maker = maker
        for case in PARAMS.glob("*.toml"):
            shutil.copy(case, maker.folder)
        maker.write("drop.toml", cls.text())
        maker.succeed("run", "drop.toml", "-o", "out")
        cls.screen = maker.succeed("report", "out").stdout
        cls.out = maker.folder / "out"
        cls.page = (cls.out / "report.html").read_text()
        cls.data = data_of(cls.page)
        cls.charts = {chart["id"]: chart for chart in cls.data["charts"]}

    @classmethod
    def tearDownClass(cls):
        cls.maker.doCleanups()
        super().tearDownClass()

    def make(self):
        pass


class Page(SharedRun):
    def test_it_says_where_it_is(self):
        self.assertEqual(self.screen, "report of drop in out/report.html\n")
        self.assertLess(len(self.page.encode()), LARGEST)

    def test_it_points_to_nothing_outside_itself(self):
        without_data = re.sub(r'<script type="application/json".*?</script>', "", self.page, flags=re.S)
        self.assertEqual(set(re.findall(r'https?://[^"\']*', without_data)), {"http://www.w3.org/2000/svg"}, "a name, not an address that is asked for")
        self.assertNotRegex(without_data, r"@(TITLE|CSS|JS|DATA)@|\bsrc=|@import|url\((?!#)")

    def test_peaks_survive_with_their_times(self):
        with h5py.File(self.out / "results.h5") as results:
            times = results["/time"][:]
            for i, name in enumerate(("TB1", "TB2")):
                force = results[f"/bearings/{name}/contact_force"][:]
                line = self.charts["contact-force"]["lines"][i]
                self.assertEqual(line["name"], name)
                k = int(numpy.argmax(line["y"]))
                self.assertAlmostEqual(line["y"][k], force.max() / 1e3, delta=1e-4 * force.max() / 1e3, msg="kN, five digits")
                self.assertAlmostEqual(line["x"][k], 1e3 * times[numpy.argmax(force)], delta=1e-4, msg="ms")

    def test_units_are_those_of_the_axes(self):
        with h5py.File(self.out / "results.h5") as results:
            last = {"displacement-y": 1e6 * results["/bearings/TB1/orbit"][-1, 0], "speeds": results["/rotor/spin_speed"][-1] * 30 / math.pi, "rub-heat": 1e-3 * results["/bearings/TB1/rub_heat_rate"][-1],
                    "temperature-TB1": results["/thermal/TB1/shaft"][-1] - 293.15, "growth-TB1": 1e6 * results["/growth/lumped/TB1"][-1, 0], "clearance": 1e6 * results["/bearings/TB1/clearance"][-1],
                    "energy": results["/energy/dissipated"][-1]}
        for name, value in last.items():
            with self.subTest(name):
                self.assertAlmostEqual(self.charts[name]["lines"][0]["y"][-1], value, delta=1e-4 * abs(value) + 1e-12)
        for chart in self.charts.values():
            self.assertTrue(chart["x"]["unit"] and chart["y"]["unit"], chart["id"])

    def test_numbers_are_those_of_the_summary(self):
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual(self.data["numbers"]["bearings"], ["TB1", "TB2"])
        rows = {row["name"]: row for row in self.data["numbers"]["rows"]}
        for i, name in enumerate(("TB1", "TB2")):
            bearing = summary["bearings"][name]
            self.assertAlmostEqual(float(rows["peak contact force in the bore (0-peak)"]["values"][i]), bearing["peak_contact_force"] / 1e3, delta=1e-3)
            self.assertEqual(rows["end of spin-up (ring within 1 % of rotor surface speed)"]["values"][i], "—")

    def test_a_mean_over_50_ms_is_not_one_of_a_shorter_run(self):
        names = [row["name"] for row in self.data["numbers"]["rows"] if row["name"].startswith("mean contact force")]
        self.assertEqual(names, ["mean contact force in the bore, whole run"], "of 15 ms")

    def test_one_thermal_model_leaves_out_the_other(self):
        self.assertNotIn("comparison", self.data)
        self.assertNotIn("surfaces-TB1", self.charts)
        self.assertFalse([line for line in self.charts["temperature-TB1"]["lines"] if "FE" in line["name"]])

    def test_it_knows_where_it_comes_from(self):
        facts = dict(self.data["provenance"]["facts"])
        for name in ("results.h5", "parameters.toml"):
            self.assertEqual(facts[f"SHA-256 of {name}"], hashlib.sha256((self.out / name).read_bytes()).hexdigest())
        given = {row[0]: row[1:] for row in self.data["provenance"]["given"]}
        self.assertEqual(given["run.end_time"][0], "15 ms")
        self.assertEqual(given["run.end_time"][2], "drop.toml:3: as long as it takes")
        lines = (self.maker.folder / "reference.toml").read_text().splitlines()
        for name, start in (("bearings.TB1.support.K_y", "support = "), ("rotor.geometry", "geometry = ")):
            number = next(i for i, line in enumerate(lines) if line.startswith(start))
            comment = lines[number].partition("# ")[2]
            self.assertTrue(comment.startswith("source: "))
            self.assertEqual(given[name][2], f"reference.toml:{number + 1}: {comment}")
        self.assertEqual(given["bearings.TB1.drag_viscosity"][2], "[bearings], drop.toml:4: warm air", "of all bearings")
        self.assertRegex(given["materials.steel.k"][2], "^reference.toml:" if "[materials" in (self.maker.folder / "reference.toml").read_text() else "^the program: Neisi")
        self.assertEqual(given["bearings.TB1.support.K_y"][0], "2.7e+09 N/m", "a bare number is SI, and says so")
        self.assertNotIn("bearings.TB1.drag_regularisation", given, "2.0 rad/s is the default, 2 rad/s")
        self.assertIn("spin", given["bearings.TB1.ring_spin_inertia"][3].lower())
        self.assertNotIn("rotor.initial_offset", given, "at its default")

    def test_a_run_from_recorded_parameters_knows_the_first_origins(self):
        """parameters.toml reads back to itself, comments and defaults included; results without recorded origins have those of its comments."""
        shutil.copy(self.out / "parameters.toml", self.folder / "drop.toml")
        self.succeed("run", "drop.toml", "-o", "again")
        self.assertEqual((self.folder / "again/parameters.toml").read_text(), (self.out / "parameters.toml").read_text())
        shutil.copytree(self.out, self.folder / "old")
        with h5py.File(self.folder / "old/results.h5", "a") as file:
            del file["given"]
        for name in ("again", "old"):
            self.succeed("report", name, "-o", f"{name}.html")
            provenance = data_of((self.folder / f"{name}.html").read_text())["provenance"]
            self.assertEqual(provenance["given"], self.data["provenance"]["given"], name)
            self.assertEqual(provenance["n_defaults"], self.data["provenance"]["n_defaults"], name)

    def test_sound_runs_have_no_warnings(self):
        states = {check["name"]: check["state"] for check in self.data["checks"]}
        self.assertNotIn("warning", states.values())
        # 0.66 of the heat into one spot of the ring goes beyond 423 K, the consistent share does not: neither good nor a warning.
        self.assertEqual({name for name, state in states.items() if state != "ok"}, {f"{name}: local temperature where rotor and bore rub" for name in ("TB1", "TB2")})
        self.assertEqual({state for state in states.values() if state != "ok"}, {"uncertain"})


def rises(picture, levels):
    """Rises [K] of a picture's levels: 1 to 255 over the square root."""
    return picture["low"] + (picture["high"] - picture["low"]) * ((levels.astype(float) - 1) / 254) ** 2


@unittest.skipUnless(HAS_ROOM, "the finite-element room is not built")
class Fields(SharedRun):
    """Pictures of the section, against the files that ParaView gets, read by the reader in Python."""

    models = ["lumped", "fe"]

    def test_instants_are_the_peak_of_the_first_impact_the_middle_and_the_end(self):
        with h5py.File(self.out / "results.h5") as results:
            times = results["/time"][:]
            for bearing in self.data["fields"]:
                peak = 1e3 * times[numpy.argmax(results[f"/bearings/{bearing['name']}/contact_force"][:])]
                kept = [0, 3, 8.3, 8.6, 12, 15]
                nearest = [min(kept, key=lambda t: abs(t - wanted)) for wanted in (peak, 7.5, 15)]
                with self.subTest(bearing["name"]):
                    numpy.testing.assert_allclose([p["time"] for p in bearing["pictures"]], sorted(set(nearest)), atol=1e-6)
                    text = json.dumps([p["next_to"] for p in bearing["pictures"]])
                    for words in ("first impact's peak", "middle (7.5 ms)", "end (15 ms)"):
                        self.assertIn(words, text)
        self.assertLess(len(self.page.encode()), LARGEST)

    def test_points_show_the_field_of_their_file(self):
        with Results(self.out) as run:
            for bearing in self.data["fields"]:
                files = {round(1e3 * t, 6): file for t, file in run.fields(bearing["name"])}
                for picture in bearing["pictures"]:
                    field = read_vtu(files[round(picture["time"], 6)])
                    rise, points, quads = field["data"][RISE], 1e3 * field["points"][:, :2], field["quads"]
                    self.assertAlmostEqual(picture["low"], rise.min(), delta=1e-4)
                    self.assertAlmostEqual(picture["high"], rise.max(), delta=1e-4)
                    levels = numpy.frombuffer(base64.b64decode(picture["levels"]), numpy.uint8).reshape(bearing["rows"], bearing["columns"])
                    (x0, x1), (r0, r1) = bearing["x"], bearing["r"]
                    middle = points[quads].mean(axis=1)
                    column = ((middle[:, 0] - x0) / (x1 - x0) * bearing["columns"]).astype(int)
                    row = ((r1 - middle[:, 1]) / (r1 - r0) * bearing["rows"]).astype(int)
                    # Cells that hold the whole point of the picture, whose value is then between their corners' but for rounding to a level.
                    pitch = (x1 - x0) / bearing["columns"]
                    large = numpy.ptp(points[quads], axis=1).min(axis=1) > 2.5 * pitch
                    self.assertGreater(large.sum(), 50)
                    level = levels[row, column][large]
                    self.assertTrue((level > 0).all())
                    low, high = (rises(picture, numpy.maximum(level.astype(float) + shift, 1)) for shift in (-0.6, 0.6))
                    corners = rise[quads][large]
                    self.assertTrue((low <= corners.max(axis=1) + 1e-4).all() and (high >= corners.min(axis=1) - 1e-4).all())

    def test_edges_are_the_bodies_outlines(self):
        # Plain sections: rectangles, whose outlines and common lines follow from the case.
        for bearing in self.data["fields"]:
            edges = numpy.array(bearing["edges"]).reshape(-1, 2, 2)
            lengths = numpy.abs(edges[:, 1] - edges[:, 0])
            self.assertLess(lengths.min(axis=1).max(), 2e-3, "along x or r; numbers are rounded to a thousandth of a millimetre")
            radii = {round(float(r), 1) for r in edges[lengths[:, 1] < 1e-3][:, 0, 1]}
            expected = {"TB1": {35.0, 39.0, 48.6, 55.0, 65.0}, "TB2": {35.0, 39.0, 46.0, 50.0, 60.0}}[bearing["name"]]
            self.assertEqual(radii, expected)

    def test_a_damaged_file_is_named(self):
        copy = self.folder / "out"
        shutil.copytree(self.out, copy)
        (copy / "report.html").unlink()
        for path in (copy / "fields").glob("TB2-*.vtu"):
            text = path.read_text()
            path.write_text(text[: len(text) // 2])
        done = self.call("report", "out")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("out/fields/TB2-", done.stderr)
        self.assertIn("this is not a rotordrop field", done.stderr)
        self.assertFalse((copy / "report.html").exists())


class Trouble(SharedRun):
    def setUp(self):
        super().setUp()
        shutil.copytree(self.maker.folder / "out", self.folder / "out")
        (self.folder / "out/report.html").unlink()

    def refused(self, *arguments):
        before = content_of(self.folder)
        done = self.call("report", *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(content_of(self.folder), before)
        return done.stderr

    def report(self, *arguments):
        self.succeed("report", "out", *arguments)
        data = data_of((self.folder / "out/report.html").read_text())
        return data, {check["name"]: check for check in data["checks"]}

    def test_directories_without_a_run_are_named(self):
        self.assertIn("nowhere: there is no such directory", self.refused("nowhere"))
        (self.folder / "empty").mkdir()
        self.assertIn("empty: the directory does not contain results.h5", self.refused("empty"))
        (self.folder / "out/parameters.toml").unlink()
        self.assertIn("out: the directory does not contain parameters.toml", self.refused("out"))

    def test_files_that_are_no_results_are_named(self):
        (self.folder / "out/summary.json").write_text("{")
        self.assertIn("out/summary.json: the file is not valid JSON", self.refused("out"))
        (self.folder / "out/results.h5").write_text("no HDF5")
        self.assertIn("out/results.h5", self.refused("out"))

    def test_a_file_is_replaced_only_with_force(self):
        self.write("mine.html", "mine")
        self.assertIn("mine.html: the file already exists", self.refused("out", "-o", "mine.html"))
        self.succeed("report", "out", "-o", "mine.html", "--force")
        self.assertEqual((self.folder / "mine.html").read_text(), self.page)
        self.assertEqual(self.succeed("report", "out", "-o", "new/deep/page.html", "--quiet").stdout, "")
        self.assertTrue((self.folder / "new/deep/page.html").is_file())

    def test_a_new_run_removes_the_old_page(self):
        self.report()
        self.succeed("run", self.case(""), "-o", "out", "--force", *settings(run__end_time="1 ms"))
        self.assertFalse((self.folder / "out/report.html").exists())

    def test_without_a_summary_it_says_so(self):
        (self.folder / "out/summary.json").unlink()
        data, checks = self.report()
        self.assertEqual(checks["complete"]["state"], "warning")
        self.assertIn("no summary.json", checks["complete"]["text"])
        self.assertEqual(len(data["charts"]), len(self.data["charts"]))

    def edit(self, name, change):
        path = self.folder / "out" / name
        content = json.loads(path.read_text())
        change(content)
        path.write_text(json.dumps(content))

    def test_backward_whirl_is_warned_of(self):
        def whirl(summary):
            summary["bearings"]["TB1"]["whirl"].update(direction="backward", largest_backward_speed=2 * math.pi * 120, backward_whirl_share=0.5, full_rub="yes")

        self.edit("summary.json", whirl)
        check = self.report()[1]["TB1: backward whirl"]
        self.assertEqual(check["state"], "warning")
        self.assertIn("up to 120 Hz, during 50 % of the contact time; full rub", check["text"])

    def test_skidding_is_warned_of(self):
        checks = self.report()[1]
        self.assertEqual([checks[name]["state"] for name in ("TB1: skidding", "TB2: skidding", "TB2: gyroscopic pivoting of balls")], ["ok"] * 3)
        self.assertNotIn("TB1: gyroscopic pivoting of balls", checks, "a deep-groove ball has no gyroscopic moment here")

        def skid(summary):
            summary["bearings"]["TB1"]["skid"].update(time_beyond=0.004, longest_beyond=0.003, speed_change=1000, speed_change_beyond=60)
            summary["bearings"]["TB2"]["gyroscopic"].update(largest_demand=1.5, time_beyond=0.002)

        self.edit("summary.json", skid)
        checks = self.report("--force")[1]
        self.assertEqual(checks["TB1: skidding"]["state"], "warning")
        self.assertIn("for 4 ms in total (longest stretch 3 ms) friction at the raceways cannot keep all rows rolling; 6 % of", checks["TB1: skidding"]["text"])
        self.assertEqual(checks["TB2: gyroscopic pivoting of balls"]["state"], "warning")
        self.assertIn("up to 1.5 times", checks["TB2: gyroscopic pivoting of balls"]["text"])
        self.edit("summary.json", lambda summary: summary["bearings"]["TB1"].pop("skid"))
        self.assertEqual(self.report("--force")[1]["TB1: skidding"]["state"], "unknown")

    def test_lost_energy_is_warned_of(self):
        self.edit("summary.json", lambda summary: summary["energy"].update(residual=0.01 * summary["energy"]["dissipated"]))
        self.assertEqual(self.report()[1]["mechanical energy"]["state"], "warning")

    def test_a_closed_gap_is_warned_of(self):
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            results["/bearings/TB2/clearance"][-3] = -1e-6
        checks = self.report()[1]
        self.assertEqual((checks["TB1: air gap"]["state"], checks["TB2: air gap"]["state"]), ("ok", "warning"))
        self.assertIn("CLOSED", checks["TB2: air gap"]["text"])

    def test_hot_rings_are_warned_of(self):
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            results["/thermal/TB1/inner_ring"][-3] = 500.0
        self.assertEqual(self.report()[1]["TB1: mean temperature of rings and balls"]["state"], "warning")

    def test_local_temperature_is_checked_against_its_bounds(self):
        name = "TB1: local temperature where rotor and bore rub"
        for low, rise, high, state, words in ((20, 60, 100, "ok", "below the 423 K"), (60, 120, 400, "uncertain", "below, but the upper bound is above, the 423 K"), (60, 200, 400, "warning", "above the 423 K")):
            def change(summary):
                summary["bearings"]["TB1"]["local"].update(bore_rise=rise, bore_rise_low=low, bore_rise_high=high)

            self.edit("summary.json", change)
            check = self.report("--force")[1][name]
            self.assertEqual(check["state"], state)
            self.assertIn(words, check["text"])
        self.edit("summary.json", lambda summary: summary["bearings"]["TB1"].pop("local"))
        check = self.report("--force")[1][name]
        self.assertEqual(check["state"], "unknown")
        self.assertIn("not assessed", check["text"])

    def test_wear_beyond_its_limit_is_warned_of(self):
        self.assertEqual(self.report()[1]["TB2: wear"]["state"], "ok")
        self.edit("summary.json", lambda summary: summary["bearings"]["TB2"]["wear"].update(drops_until_limit=0.5))
        self.assertEqual(self.report("--force")[1]["TB2: wear"]["state"], "warning")

    def test_overload_is_warned_of(self):
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            results["/bearings/TB1/bearing_force"][-3, 0] = 40e3  # C0 is 31 kN
        check = self.report()[1]["TB1: static load rating"]
        self.assertEqual(check["state"], "warning")
        self.assertIn("largest radial load of the recorded samples 40 kN", check["text"], "peaks between them are not in it")

    def test_contact_pressure_is_that_of_the_worst_row(self):
        """Of every step, as summary.json has it, not of the recorded rows; these where there is no summary."""
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            results["/bearings/TB2/contact_pressure"][-3, 1] = 4.3e9
        self.edit("summary.json", lambda summary: summary["bearings"]["TB2"].update(largest_contact_pressure=5e9, rows=[{**row, "largest_contact_pressure": p} for row, p in zip(summary["bearings"]["TB2"]["rows"], (1e9, 5e9))]))
        data, checks = self.report()
        check = checks["TB2: contact pressure"]
        self.assertEqual(check["state"], "warning")
        self.assertIn("largest 5 GPa, in row 2; limit 4.2 GPa", check["text"])
        lines = {line["name"]: line for chart in data["charts"] if chart["id"] == "pressures" for line in chart["lines"]}
        self.assertEqual(list(lines), ["TB1 row 1", "TB2 row 1", "TB2 row 2"])
        self.assertAlmostEqual(max(lines["TB2 row 2"]["y"]), 4.3, delta=1e-3, msg="GPa")
        (self.folder / "out/summary.json").unlink()
        check = self.report("--force")[1]["TB2: contact pressure"]
        self.assertEqual(check["state"], "warning")
        self.assertIn("largest 4.3 GPa, in row 2, in the recorded samples", check["text"])

    def test_the_slider_begins_at_the_largest_force_of_all_bearings(self):
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            times = results["/time"][:]
            results["/bearings/TB1/contact_force"][50] = 6e4
            results["/bearings/TB2/contact_force"][70] = 7e4
            shoulder = results.create_dataset("/bearings/TB1/shoulder_force", data=numpy.zeros(len(times)))
            shoulder.attrs.update(dict(results["/bearings/TB1/contact_force"].attrs))
        self.assertAlmostEqual(self.report()[0]["animation"]["start"], 1e3 * times[70], delta=1e-9, msg="ms")
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            results["/bearings/TB1/shoulder_force"][90] = -8e4
        self.assertAlmostEqual(self.report("--force")[0]["animation"]["start"], 1e3 * times[90], delta=1e-9, msg="a shoulder, along -x")

    def test_ball_loads_stand_at_their_times(self):
        """However rows are spaced: times squared, and one loaded sample."""
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            loads = results["/bearings/TB2/ball_loads"]
            times = results[loads.attrs["time"]]
            end = times[-1]
            times[:] = times[:] ** 2 / end
            loads[:] = 0.0
            k = len(times) // 2
            loads[k, 3] = 100.0
            expected = times[k] / end
        picture = {bearing["name"]: bearing for bearing in self.report()[0]["ball_loads"]}["TB2"]
        row = picture["loads"][3]
        loaded = [i for i, load in enumerate(row) if load]
        self.assertEqual(loaded[0], int(expected * len(row)), "a quarter of the drop, not half of it")
        self.assertTrue(picture["is_held"])
        # Between rows far apart the load is that of the row before, not the largest one of the interval before.
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            loads = results["/bearings/TB2/ball_loads"]
            times = results[loads.attrs["time"]]
            n = len(times)
            times[:] = numpy.append(numpy.linspace(0.0, 0.1 * end, n - 1), end)
            loads[:] = 0.0
            loads[n - 3, 3] = 100.0
            loads[n - 2, 3] = 20.0
            loads[n - 1, 3] = 60.0
        row = {bearing["name"]: bearing for bearing in self.report("--force")[0]["ball_loads"]}["TB2"]["loads"][3]
        self.assertEqual(row, [0] * (n // 10) + [100] + [20] * (n - 2 - n // 10) + [60])
        self.assertFalse([b["is_held"] for b in self.data["ball_loads"] if b["is_held"]], "even rows")

    def test_texts_cannot_break_the_page(self):
        with h5py.File(self.folder / "out/results.h5", "r+") as results:
            results.attrs["case"] = "</script><b>&"
        self.report()
        page = (self.folder / "out/report.html").read_text()
        self.assertIn("<title>Drop &lt;/script&gt;&lt;b&gt;&amp;</title>", page)
        self.assertEqual(page.count("</script>"), 2)


class OtherRuns(ProgramTest):
    def report(self):
        self.succeed("report", "out")
        return data_of((self.folder / "out/report.html").read_text())

    def test_a_run_on_linear_supports_alone_has_its_own_figures(self):
        supports = "".join(f'[bearings.{name}]\ntype = "linear"\nnode = {node}\nstiffness = [[1e7, 0], [0, 1e7]]\ndamping = [[1e3, 0], [0, 1e3]]\n' for name, node in (("A", 2), ("B", 28)))
        self.write("linear.toml", f'[run]\nend_time = "10 ms"\ninitial_speed = "3000 rpm"\n[rotor]\ngeometry = "neisi2019-rotor.json"\n{supports}')
        self.run_case("linear.toml")
        data = self.report()
        charts = {chart["id"]: [line["name"] for line in chart["lines"]] for chart in data["charts"]}
        self.assertEqual(charts["support-force"], ["A y", "B y", "A z", "B z"])
        self.assertIn("energy", charts)
        self.assertNotIn("contact-force", charts)
        self.assertNotIn("heat-given", charts, "linear supports have no raceways, and nothing rubs")
        self.assertEqual(data["animation"]["bearings"], [])
        self.assertIn("on linear supports", data["words"][0])

    def test_a_rotor_on_magnets_alone_is_on_no_linear_supports(self):
        magnets = "".join(f'[bearings.{name}]\ntype = "magnet"\nnode = {node}\nstiffness = [[1e7, 0], [0, 1e7]]\ndamping = [[2e4, 0], [0, 2e4]]\nrelease_time = ["100 s", "100 s"]\n' for name, node in (("A", 6), ("B", 25)))
        self.write("magnets.toml", f'[run]\nend_time = "10 ms"\ninitial_speed = "3000 rpm"\n[rotor]\ngeometry = "neisi2019-rotor.json"\n{magnets}')
        self.run_case("magnets.toml")
        self.assertIn("spins at 3000 rpm on magnets. ", self.report()["words"][0])

    def test_the_campbell_diagram_has_the_critical_speeds(self):
        supports = "".join(f'[bearings.{name}]\ntype = "linear"\nnode = {node}\nstiffness = [[2e7, 0], [0, 3e7]]\ndamping = [[1e3, 0], [0, 1e3]]\n' for name, node in (("A", 2), ("B", 28)))
        self.write("linear.toml", f'[run]\nend_time = "10 ms"\ninitial_speed = "8000 rpm"\n[rotor]\ngeometry = "neisi2019-rotor.json"\n{supports}')
        self.run_case("linear.toml")
        charts = {chart["id"]: chart for chart in self.report()["charts"]}
        critical = json.loads(self.succeed("critical-speeds", "linear.toml", "--json", "--map", "1e6 N/m, 1e9 N/m").stdout)
        points = charts["campbell"]["points"]
        self.assertEqual(len(points), len(critical["critical_speeds"]))
        self.assertGreaterEqual(len(points), 4)
        for point, one in zip(points, critical["critical_speeds"]):
            self.assertAlmostEqual(point["x"], one["speed"] * 30 / math.pi, delta=1e-3 * point["x"], msg="rpm")
            self.assertAlmostEqual(point["y"], one["frequency"], delta=1e-3 * point["y"], msg="Hz")
            self.assertIn(one["whirl"], point["text"])
            # It lies on a line of the diagram.
            nearest = min(abs(numpy.interp(point["x"], line["x"], line["y"]) - point["y"]) for line in charts["campbell"]["lines"] if line["name"] != "spin frequency" and line["x"][0] <= point["x"] <= line["x"][-1])
            self.assertLess(nearest, 0.01 * point["y"])
        # The page shows the value of the nearest point, so that the spin frequency needs as many points as a mode.
        spin = next(line for line in charts["campbell"]["lines"] if line["name"] == "spin frequency")
        self.assertLess(max(numpy.diff(spin["x"])), 300, "rpm")
        numpy.testing.assert_allclose(spin["y"], numpy.array(spin["x"]) / 60, rtol=1e-5, atol=1e-9)
        # The map: at a stiffness that both have.
        for line, speeds in zip(charts["critical-speed-map"]["lines"], zip(*[at["speeds"][:2] for at in critical["map"]])):
            for at, speed in zip(critical["map"], speeds):
                x = math.log10(at["stiffness"])
                if line["x"][0] <= x <= line["x"][-1]:
                    self.assertAlmostEqual(numpy.interp(x, line["x"], line["y"]), speed * 30 / math.pi, delta=0.01 * speed * 30 / math.pi)

    def test_modes_and_campbell_diagram_are_those_of_the_sense_of_spin(self):
        """Mirrored at the x-y plane the rotor spins the other way, and K_yz and K_zy change their signs."""
        def report(speed, K):
            supports = "".join(f'[bearings.{name}]\ntype = "linear"\nnode = {node}\nstiffness = [[2e7, {K}], [{-K}, 2e7]]\ndamping = [[4e3, 0], [0, 4e3]]\n' for name, node in (("A", 2), ("B", 28)))
            self.write("films.toml", f'[run]\nend_time = "1 ms"\ninitial_speed = "{speed} rpm"\n[rotor]\ngeometry = "neisi2019-rotor.json"\n{supports}')
            self.run_case("films.toml", "--force")
            return self.report()
        there, back, other = report(8000, 4e6), report(-8000, -4e6), report(-8000, 4e6)
        modes = lambda data: [(one["whirl"], one["damping_ratio"]) for one in data["modes"]["modes"]]  # noqa: E731
        points = lambda data: [(point["x"], point["text"]) for chart in data["charts"] if chart["id"] == "campbell" for point in chart["points"]]  # noqa: E731
        for (a, damping_a), (b, damping_b) in zip(modes(there), modes(back)):
            self.assertEqual(a, b)
            self.assertAlmostEqual(damping_a, damping_b, places=7)
        # The coupling drives forward whirl of positive spin, and backward whirl of negative spin.
        self.assertEqual([whirl for whirl, damping in modes(there) if damping < 0][:1], ["forward"])
        self.assertEqual([whirl for whirl, damping in modes(other) if damping < 0][:1], ["backward"])
        self.assertEqual([text for _, text in points(there)], [text for _, text in points(back)])
        self.assertNotEqual([text for _, text in points(there)], [text for _, text in points(other)])
        self.assertEqual((there["modes"]["speed"], round(back["modes"]["speed"], 6)), (8000, -8000))

    def test_a_rigid_rotor_has_no_modes_and_a_side_view_of_its_own(self):
        self.succeed("run", self.case('rotor.model = "rigid"\n'), "-o", "out", "--quiet")
        data = self.report()
        self.assertEqual((data["modes"], data["bending"], data["machine"]["is_rigid"]), (None, None, True))
        self.assertEqual(len(data["machine"]["elements"]), 30)
        self.assertFalse([chart for chart in data["charts"] if chart["id"] in ("campbell", "critical-speed-map")])
        with h5py.File(self.folder / "out/results.h5") as results:
            self.assertNotIn("modal_y", results["/rotor"])

    def test_up_and_vertical_follow_gravity(self):
        """Along -y as in the reference case; -z; along the axis, as of a vertical rotor."""
        for gravity, y, z, titles in (("9.81", "y (up)", "z", ("Vertical displacement of the rotor", "Horizontal displacement of the rotor")), ("[0, 0, -9.81]", "y", "z (up)", ("Horizontal displacement of the rotor", "Vertical displacement of the rotor")),
                                      ("[0, 9.81, 0]", "y (down)", "z", ("Vertical displacement of the rotor", "Horizontal displacement of the rotor")), ("[-9.81, 0, 0]", "y", "z", ("Displacement along y of the rotor", "Displacement along z of the rotor"))):
            with self.subTest(gravity):
                self.succeed("run", self.case(f"run.gravity = {gravity}\n"), "-o", "out", "--force", "--quiet", *settings(run__end_time="2 ms"))
                data = self.report()
                charts = {chart["id"]: chart for chart in data["charts"]}
                self.assertEqual(data["directions"], {"y": y, "z": z})
                self.assertEqual([charts[f"displacement-{axis}"]["y"]["label"] for axis in "yz"], [y, z])
                self.assertEqual(tuple(charts[f"displacement-{axis}"]["title"] for axis in "yz"), titles)
                rows = [row["name"] for row in data["numbers"]["rows"] if "displacement" in row["name"]]
                self.assertEqual(rows, [title.lower().replace(" of the rotor", ", peak-to-peak") for title in titles])

    def test_rows_too_far_apart_have_no_spectra_but_the_interval_that_would_do(self):
        for name in ("neisi2019-settling.toml", "neisi2019.toml"):
            shutil.copy(SOURCE / "params" / name, self.folder)
        self.write("coarse.toml", 'base = "neisi2019-settling.toml"\nrun.end_time = "200 ms"\n')

        def report(interval):
            self.succeed("run", "coarse.toml", "-o", "out", "--force", "--quiet", *settings(output__longest_interval=interval))
            return self.report()

        coarse = report("5 ms")
        self.assertEqual(coarse["waterfalls"], [])
        self.assertFalse([chart for chart in coarse["charts"] if chart["section"] == "Spectra"])
        fine = report(re.search(r'output.longest_interval = "(\d+ us)"', coarse["spectra_note"])[1])
        self.assertNotIn("spectra_note", fine)
        with h5py.File(self.folder / "out/results.h5") as results:
            apart = numpy.diff(results["/time"][:]).max()
        note = next(chart["note"] for chart in fine["charts"] if chart["id"] == "spectrum-force-TB1")
        self.assertIn(f"Rows are up to {apart * 1e6:.3g} µs apart", note)
        self.assertIn(f"motion faster than {0.5 / apart:.4g} Hz would fold back", note)
        self.assertNotIn("left out", note)

    def test_waves_and_tilts_are_told_though_not_drawn(self):
        for name in ("neisi2019-thrust.toml", "neisi2019-settling.toml", "neisi2019.toml"):
            shutil.copy(SOURCE / "params" / name, self.folder)
        self.write("wavy.toml", 'base = "neisi2019-thrust.toml"\nrun.end_time = "2 ms"\n[[bearings.TB1.waviness]]\nsurface = "bore"\norder = 3\namplitude = "20 um"\n[[bearings.TB1.waviness]]\nsurface = "inner"\norder = 12\namplitude = "2 um"\n')
        self.succeed("run", "wavy.toml", "-o", "out", "--quiet")
        data = self.report()
        self.assertIn("Waves around TB1, number and amplitude: 3 of 20 µm in the bore, 12 of 2 µm on the inner raceway.", data["words"])
        self.assertEqual(data["animation"]["not_drawn"], ["waves of the surfaces", "tilts of rotor and rings"])

    def test_a_long_title_is_cut_between_letters(self):
        """Whatever the number of bytes before: a letter of two bytes is shown whole or not at all."""
        for shift in ("", "x"):
            title = shift + "ü" * 60
            self.succeed("run", self.case(f'title = "{title}"\n'), "-o", "out", "--force", "--quiet", *settings(run__end_time="1 ms"))
            value = {row[0]: row[1] for row in self.report()["provenance"]["given"]}["title"]
            self.assertRegex(value, f'^"?{shift}ü+ … \\(in parameters.toml\\)$')

    def test_a_title_of_several_lines_is_refused(self):
        done = self.call("check", self.case('title = "one\\ntwo"\n'))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"drop.toml:3:\d+: title has a line break")
        screen = self.succeed("run", self.case('title = "Compressor 7"\n'), "-o", "out").stdout
        self.assertIn("case drop: Compressor 7\n", screen)
        self.assertRegex(screen, r"mean temperature rise \S+ K inner ring \(\S+ degC\)")

    def test_assumptions_say_which_motion_was_computed(self):
        for name in ("neisi2019-thrust.toml", "neisi2019-settling.toml"):
            shutil.copy(SOURCE / "params" / name, self.folder)
        shutil.copy(SOURCE / "params/neisi2019.toml", self.folder)
        for name, axial, ring in (("thrust", "with rigid axial motion", "moves radially and along its axis, tilts and spins"), ("settling", "without axial motion", "moves radially and spins")):
            self.succeed("run", f"neisi2019-{name}.toml", "-o", "out", "--force", "--quiet", *settings(run__end_time="2 ms"))
            (self.folder / "out/report.html").unlink(missing_ok=True)
            text = " ".join(self.report()["assumptions"])
            self.assertIn(axial, text)
            self.assertIn(f"TB2: the inner ring {ring};", text)

    def test_an_interrupted_run_says_so(self):
        case = self.case("output.checkpoint_interval = 0.05\n")
        process = start("run", case, "-o", "out", "--quiet", *settings(run__end_time="100 s"), cwd=self.folder)
        try:
            for _ in range(600):
                if (self.folder / "out/checkpoints").is_dir():
                    break
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
        finally:
            process.kill()
        self.assertEqual(process.returncode, 130)
        data = self.report()
        check = {check["name"]: check for check in data["checks"]}["complete"]
        self.assertEqual(check["state"], "warning")
        self.assertRegex(check["text"], r"INTERRUPTED at [0-9.]+ m?s of 100 s")
        # What was computed, not what the case asks for.
        with h5py.File(self.folder / "out/results.h5") as results:
            last = results["/time"][-1]
        number, unit = re.search(r"The simulation covers ([0-9.]+) (m?s) at", data["words"][0]).groups()
        self.assertAlmostEqual(float(number) * {"ms": 1e-3, "s": 1}[unit], last, delta=1e-5 * last)

    def test_sustained_backward_whirl_is_on_the_screen_and_in_the_report(self):
        # Rough surfaces drive the rotor around the bore: the impacts give it more than the speed that a full rub takes.
        case = self.case("contact.friction_coefficient = 0.6\n")
        screen = self.succeed("run", case, "-o", "out", *settings(run__end_time="60 ms")).stdout
        whirl = self.summary()["bearings"]["TB1"]["whirl"]
        self.assertEqual((whirl["direction"], whirl["full_rub"]), ("backward", "yes"))
        self.assertGreater(whirl["largest_backward_speed"], whirl["full_rub_condition"]["speed_at_bottom"])
        self.assertRegex(screen, r"TB1: sustained backward whirl, up to [0-9.]+ Hz, during [0-9.]+ % of the contact time; full rub")
        self.assertGreaterEqual(whirl["start"], self.summary()["bearings"]["TB1"]["first_contact_time"])
        # The angle of the recorded orbit says the same.
        with h5py.File(self.folder / "out/results.h5") as results:
            y, z = results["/bearings/TB1/orbit"][:].T
            times = results["/time"][:]
        angle = numpy.unwrap(numpy.arctan2(z, y))
        end = numpy.searchsorted(times, whirl["end"])
        began = numpy.searchsorted(times, whirl["start"])
        self.assertAlmostEqual((angle[began] - angle[end]) / (2 * math.pi), whirl["turns"], delta=0.01)
        self.assertTrue([check for check in self.report()["checks"] if check["name"] == "TB1: backward whirl" and check["state"] == "warning"])

    def test_a_settling_drop_has_no_whirl_and_no_line_on_it(self):
        screen = self.succeed("run", self.case(""), "-o", "out", *settings(run__end_time="30 ms")).stdout
        self.assertNotIn("whirl", screen)
        self.assertEqual(self.summary()["bearings"]["TB1"]["whirl"]["direction"], "none")


class InABrowser(SharedRun):
    """The page of the shared run, opened."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.browser = Browser()
        cls.browser.open(cls.out / "report.html")
        cls.requests = cls.browser.requests()
        cls.messages = cls.browser.log("browser")

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        super().tearDownClass()


@unittest.skipUnless(DRIVER and BROWSER, "chromium and chromium-driver are not installed (./install-dependencies --tests)")
class InTheBrowser(InABrowser):
    models = ["lumped", "fe"] if HAS_ROOM else ["lumped"]

    def test_it_is_drawn_without_a_complaint(self):
        self.assertEqual(self.browser.run("return document.getElementById('page').dataset.ready"), "yes")
        self.assertEqual([m["message"] for m in self.messages], [])

    def test_ticks_of_a_narrow_range_have_the_digits_that_part_them(self):
        for low, high in ((0, 10), (15200.1, 15200.9), (1.23e6, 1.2309e6), (1.001e-3, 1.009e-3), (0, 5e-5), (100, 100.0005), (-0.3, 0.3), (1e7, 5e7)):
            with self.subTest((low, high)):
                made = self.browser.run("return ticks(arguments[0], arguments[1], 5)", low, high)
                self.assertGreaterEqual(len(made), 3)
                self.assertEqual(len({tick["text"] for tick in made}), len(made))
                for tick in made:
                    self.assertAlmostEqual(float(tick["text"]), tick["value"], delta=1e-3 * (high - low))

    def test_micro_has_its_letter_behind_numbers_too(self):
        texts = {"um": "µm", "3.362 um": "3.362 µm", "≤ 25 um": "≤ 25 µm", "uJ": "µJ", "N m": "N m", "rpm": "rpm", "vacuum": "vacuum"}
        self.assertEqual(self.browser.run("return arguments[0].map(unit)", list(texts)), list(texts.values()))

    def test_nothing_is_asked_of_anyone(self):
        self.assertEqual([url for url in self.requests if not url.startswith("data:")], [(self.out / "report.html").resolve().as_uri()])

    def test_a_fault_would_have_been_seen(self):
        # The two tests above rest on the browser's logs: a page with both faults must fill them.
        bad = self.maker.folder / "bad.html"
        bad.write_text('<script>no_such_function()</script><img src="missing.png">')
        try:
            self.browser.open(bad)
            self.assertTrue(any(url.endswith("missing.png") for url in self.browser.requests()))
            self.assertTrue(any("no_such_function" in m["message"] for m in self.browser.log("browser")))
        finally:
            self.browser.open(self.out / "report.html")

    def test_every_figure_shows_its_lines(self):
        figures = self.browser.run("""
            return [...document.querySelectorAll("figure:not(.map):not(.field):not(.machine)")].map((figure) => ({
              name: figure.id || figure.textContent,
              lines: [...figure.querySelectorAll("path.series")].map((path) => path.getAttribute("d")),
              box: figure.querySelector("svg[role]").getBoundingClientRect().toJSON(),
              view: figure.querySelector("svg[role]").viewBox.baseVal.width, left: figure.querySelector("svg[role]").viewBox.baseVal.x,
              labels: [...figure.querySelectorAll(".x-label, .y-label")].map((text) => text.textContent)}))""")
        drawn = {figure["name"] for figure in figures}
        self.assertLessEqual({"figure-" + name for name in self.charts}, drawn)
        self.assertLessEqual({"figure-orbit-TB1", "figure-orbit-TB2"}, drawn)
        for figure in figures:
            with self.subTest(figure["name"]):
                self.assertGreater(min(figure["box"]["width"], figure["box"]["height"]), 200, "px")
                self.assertTrue(figure["lines"])
                for d in figure["lines"]:
                    numbers = [float(word) for word in re.findall(r"[^ML ]+", d)]
                    self.assertGreater(len(numbers), 3)
                    self.assertTrue(all(map(math.isfinite, numbers)))
                    self.assertTrue(all(-1 <= x - figure["left"] <= figure["view"] + 1 for x in numbers[::2]), "inside its frame")
                for label in figure["labels"]:
                    self.assertRegex(label, r" \[.+\]$", "an axis has a unit")
        self.assertEqual(len(figures), len(self.charts) + 6, "two drops, two orbits, centre line and bending")

    @unittest.skipUnless(HAS_ROOM, "the finite-element room is not built")
    def test_fields_are_pictures_with_units(self):
        figures = self.browser.run("""
            return Promise.all([...document.querySelectorAll("figure.field")].map(async (figure) => {
              const source = new Image(), canvas = document.createElement("canvas");
              source.src = figure.querySelector("image").getAttribute("href");
              await source.decode();
              [canvas.width, canvas.height] = [source.width, source.height];
              const context = canvas.getContext("2d");
              context.drawImage(source, 0, 0);
              const pixels = context.getImageData(0, 0, source.width, source.height).data;
              let lightest = 255, darkest = 255, nothing = 0;
              for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3]) darkest = Math.min(darkest, pixels[i + 1]); else ++nothing;
              return {size: [source.width, source.height], darkest, nothing: nothing / (pixels.length / 4), edges: figure.querySelector("path.edges").getAttribute("d").length,
                      labels: [...figure.querySelectorAll(".x-label, .y-label, .bar-label")].map((text) => text.textContent), caption: figure.textContent,
                      bar: [...figure.querySelectorAll("text[text-anchor=start]")].map((text) => +text.textContent), box: figure.querySelector("svg").getBoundingClientRect().toJSON()}
            }))""")
        pictures = [(bearing, picture) for bearing in self.data["fields"] for picture in bearing["pictures"]]
        self.assertEqual(len(figures), len(pictures))
        self.assertGreaterEqual(len(figures), 4, "two bearings; two instants may share a field")
        for figure, (bearing, picture) in zip(figures, pictures):
            with self.subTest(bearing["name"], time=picture["time"]):
                self.assertEqual(figure["size"], [bearing["columns"], bearing["rows"]])
                self.assertEqual(figure["labels"], ["x [mm]", "r [mm]", "temperature rise [K]"])
                self.assertIn(picture["next_to"][0], figure["caption"])
                self.assertGreater(min(figure["box"]["width"], figure["box"]["height"]), 150, "px")
                self.assertGreater(figure["edges"], 100)
                self.assertLess(figure["nothing"], 0.7)
                self.assertGreater(figure["nothing"], 0.05, "between the rings")
                self.assertLess(figure["darkest"], 80, "its warmest point is dark; the very warmest may be thinner than a point")
                self.assertGreaterEqual(len(figure["bar"]), 2)
                self.assertTrue(all(picture["low"] - 1e-9 <= value <= picture["high"] + 1e-9 for value in figure["bar"]), figure["bar"])

    @unittest.skipUnless(HAS_ROOM, "the finite-element room is not built")
    def test_hovering_over_a_field_shows_the_rise_there(self):
        bearing = self.data["fields"][0]
        picture = bearing["pictures"][-1]
        selector = f"figure.field:nth-of-type({len(bearing['pictures'])}) image"
        box = self.box(selector)
        self.browser.point(("move", box["x"] + box["width"] / 2, box["y"] + box["height"] - 2))
        tip = self.browser.run("const tip = document.getElementById('tip'); return tip.hidden ? null : tip.innerText")
        x, r, rise = map(float, re.fullmatch(r"x (\S+) mm, r (\S+) mm: (\S+) K", tip).groups())
        levels = numpy.frombuffer(base64.b64decode(picture["levels"]), numpy.uint8).reshape(bearing["rows"], bearing["columns"])
        (x0, x1), (r0, r1) = bearing["x"], bearing["r"]
        column, row = int((x - x0) / (x1 - x0) * bearing["columns"]), int((r1 - r) / (r1 - r0) * bearing["rows"])
        values = rises(picture, levels[max(row - 2, 0):row + 3, max(column - 2, 0):column + 3])
        self.assertTrue(values.min() - 0.01 <= rise <= values.max() + 0.01, (tip, values.min(), values.max()))
        self.assertGreater(rise, 0.5, "the bore is warm")

    def test_every_ball_has_its_row_in_the_picture(self):
        with h5py.File(self.out / "results.h5") as results:
            for name in ("TB1", "TB2"):
                loads = results[f"/bearings/{name}/ball_loads"][:]
                width, height, dark = self.browser.run("""
                    const image = document.querySelector(`#figure-balls-${arguments[0]} image`), canvas = document.createElement("canvas");
                    const source = new Image();
                    source.src = image.getAttribute("href");
                    return source.decode().then(() => {
                      [canvas.width, canvas.height] = [source.width, source.height];
                      const context = canvas.getContext("2d");
                      context.drawImage(source, 0, 0);
                      const pixels = context.getImageData(0, 0, source.width, source.height).data;
                      let darkest = 0;
                      for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 2] < pixels[4 * darkest + 2]) darkest = i / 4;
                      return [source.width, source.height, [Math.floor(darkest / source.width), darkest % source.width]];
                    })""", name)
                self.assertEqual((width, height), loads.shape, "short enough to have a column for every row of the file")
                time, ball = numpy.unravel_index(numpy.argmax(loads), loads.shape)
                self.assertEqual(dark, [ball, time])

    def box(self, selector):
        return self.browser.run("const e = document.querySelector(arguments[0]); e.scrollIntoView({block: 'center'}); return e.getBoundingClientRect().toJSON()", selector)

    def test_hovering_shows_the_values_there(self):
        box = self.box("#figure-contact-force .plot")
        line = self.charts["contact-force"]["lines"][0]
        peak = max(range(len(line["y"])), key=line["y"].__getitem__)
        at = line["x"][peak] / line["x"][-1]
        self.browser.point(("move", box["x"] + at * box["width"], box["y"] + box["height"] / 2))
        tip = self.browser.run("const tip = document.getElementById('tip'); return tip.hidden ? null : tip.innerText")
        self.assertRegex(tip, r"time [0-9.]+ ms")
        force = float(re.search(r"TB1: ([0-9.]+) kN", tip)[1])
        self.assertAlmostEqual(force, line["y"][peak], delta=0.05 * line["y"][peak], msg="a pixel beside the peak at most")

    def test_dragging_zooms_and_a_double_click_goes_back(self):
        extent = "return [...document.querySelectorAll('#figure-contact-force svg[role] text')].map((t) => t.textContent).join(' ')"
        before = self.browser.run(extent)
        box = self.box("#figure-contact-force .plot")
        y = box["y"] + box["height"] / 2
        self.browser.point(("move", box["x"] + 0.45 * box["width"], y), ("down",), ("move", box["x"] + 0.6 * box["width"], y), ("up",))
        zoomed = self.browser.run(extent)
        self.assertNotEqual(zoomed, before)
        self.assertFalse(self.browser.run("return document.querySelector('#figure-contact-force button').hidden"))
        self.browser.point(("down",), ("up",), ("down",), ("up",))
        self.assertEqual(self.browser.run(extent), before)

    def test_the_slider_moves_the_rotor_to_where_it_was(self):
        place = """const slider = document.getElementById("time"); slider.value = arguments[0]; slider.dispatchEvent(new Event("input"));
                   return [document.querySelector("g.rotor").getAttribute("transform"), document.getElementById("instant").textContent]"""
        bearing = self.data["animation"]["bearings"][0]
        for i in (0, len(bearing["time"]) // 2, len(bearing["time"]) - 1):
            transform, instant = self.browser.run(place, i)
            z, y = map(float, re.search(r"translate\(([-0-9.]+) ([-0-9.]+)\)", transform).groups())
            scale = 46 / bearing["gap"]  # px per um
            self.assertAlmostEqual(z, scale * bearing["z"][i], delta=0.01)
            self.assertAlmostEqual(y, -scale * bearing["y"][i], delta=0.01, msg="up is up")
            self.assertAlmostEqual(float(instant.split()[2]), bearing["time"][i], delta=1e-3)

    def test_a_name_hides_its_line(self):
        count = "return document.querySelectorAll('#figure-contact-force path.series').length"
        click = "document.querySelector('#figure-contact-force .legend label').click();"
        self.assertEqual(self.browser.run(click + count), 1)
        self.assertEqual(self.browser.run(click + count), 2)

    def test_the_numbers_of_many_bearings_scroll_in_a_box_of_their_own(self):
        page = (self.out / "report.html").read_text()
        mark = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)
        data = json.loads(mark[1])
        numbers, copies = data["numbers"], 12
        numbers["bearings"] = [f"touchdown_bearing_of_the_drive_end_{k}_{name}" for k in range(copies) for name in numbers["bearings"]]
        for row in numbers["rows"]:
            row["values"] = row["values"] * copies
        many = pathlib.Path(self.out).parent / "many.html"
        many.write_text(page[:mark.start(1)] + json.dumps(data).replace("</", "<\\/") + page[mark.end(1):])
        try:
            self.browser.open(many)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 1366)
            box, whole = self.browser.run("const e = document.querySelector('.wide'); return [e.clientWidth, e.scrollWidth]")
            self.assertGreater(whole, box)
        finally:
            self.browser.open(self.out / "report.html")

    def test_it_fits_a_laptop_and_a_sheet_of_paper(self):
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 1366)
        printed = base64.b64decode(self.browser.call("POST", "/print", {"page": {"width": 21, "height": 29.7}, "shrinkToFit": False, "background": True}))
        self.assertTrue(printed.startswith(b"%PDF"))
        # Chromium writes a page as one object: a report of few bearings is some ten pages.
        self.assertLess(len(re.findall(rb"/Type\s*/Page\b", printed)), 20)

    @unittest.skipUnless(HAS_ROOM, "the finite-element room is not built")
    def test_both_thermal_models_are_shown(self):
        lines = self.charts["temperature-TB1"]["lines"]
        self.assertEqual({line["name"].rpartition(" ")[2] for line in lines}, {"(lumped)", "(FE)"})
        self.assertEqual(len(self.charts["surfaces-TB1"]["bands"]), len(self.charts["surfaces-TB1"]["lines"]))
        for band in self.charts["surfaces-TB1"]["bands"]:
            self.assertLessEqual(min(band["low"]["y"]), max(band["high"]["y"]))
        comparison = json.loads((self.out / "comparison.json").read_text())
        text = self.browser.run("return document.getElementById('page').textContent")
        for sentence in comparison["in_short"] + comparison["verdict"]:
            self.assertIn(sentence, text)


class Samples(SharedRun):
    """Runs with more rows than a figure has points."""

    @classmethod
    def text(cls):
        return 'base = "neisi2019-settling.toml"\nrun.end_time = "80 ms"\n'

    def test_figures_have_every_sample(self):
        with h5py.File(self.out / "results.h5") as results:
            times = results["/time"][:]
            self.assertGreater(len(times), 1002, "more than a figure needs")
            for chart, line, values in (("contact-force", 0, results["/bearings/TB1/contact_force"][:] / 1e3), ("displacement-z", 1, 1e6 * results["/bearings/TB2/orbit"][:, 1]), ("residuals", 0, 1e6 * results["/energy/residual"][:])):
                with self.subTest(chart):
                    found = self.charts[chart]["lines"][line]
                    numpy.testing.assert_allclose(found["x"], 1e3 * times, atol=1e-5)
                    numpy.testing.assert_allclose(found["y"], values, atol=numpy.ptp(values) / 65535)

    def test_lines_beyond_two_megabytes_are_thinned_and_say_so(self):
        self.succeed("run", "reference.toml", "-o", "long", "--quiet", *settings(run__end_time="80 ms", output__interval="2 us"))
        self.succeed("report", "long")
        page = (self.folder / "long/report.html").read_text()
        self.assertLess(len(page), LARGEST)
        lines = [line for chart in data_of(page)["charts"] if chart["x"]["label"] == "time" for line in chart["lines"]]
        whole, thinned = [line for line in lines if "axis" in line], [line for line in lines if "span" in line]
        self.assertGreater(len(whole), 5, "the first figures")
        self.assertGreater(len(thinned), 5)
        for line in thinned:
            self.assertAlmostEqual(line["span"], 80 / 500, delta=1e-3, msg="ms")
            self.assertLessEqual(len(line["x"]), 1002)
        self.assertLessEqual(sum(len(line["x"]) for line in whole), 750_000)


def centred(rows):
    return rows - rows.mean(axis=0)


@unittest.skipUnless(DRIVER and BROWSER, "chromium and chromium-driver are not installed (./install-dependencies --tests)")
class Pictures(InABrowser):
    """Pictures of the machine against its case, on a machine that has every part: ribbons under the outer rings, magnets, probes, unbalances; and a linear support."""

    @classmethod
    def text(cls):
        return """base = "neisi2019-ribbon.toml"
title = "Compressor 7, second rotor"
note = "Ribbons as delivered.\\nAsk before use."
run.end_time = "15 ms"
limits."bearings.*.peak_contact_force".max = "4 kN"
limits."bearings.TB1.friction_heat".max = "200 J"
limits."bearings.TB2.largest_ball_force".max = "1 N"

[bearings.L1]
type = "linear"
node = 16
stiffness = [["1e4 N/m", 0], [0, "1e4 N/m"]]
damping = [["10 N s/m", 0], [0, "10 N s/m"]]
"""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.geometry = json.loads((PARAMS / "neisi2019-rotor.json").read_text())
        cls.x = {node["id"]: 1e3 * node["x"] for node in cls.geometry["nodes"]}  # mm

    def test_limits_that_are_exceeded_stand_at_the_top(self):
        head, kinds = self.browser.run("const alert = document.querySelector('.alert'); return [alert.textContent, [...alert.classList]]")
        self.assertIn("Rejected: a limit is exceeded in this drop. bearings.TB2.largest_ball_force", head)
        self.assertNotIn("No warnings", head)
        self.assertEqual(kinds, ["alert"], "not green")

    def parts(self, selector):
        """Boxes of parts of the side view, in its units (which are pixels at 1366)."""
        return self.browser.run("return [...document.querySelectorAll('#figure-machine ' + arguments[0])].map((e) => { const b = e.getBBox(); return [b.x, b.y, b.width, b.height]; })", selector)

    def test_nothing_is_complained_of_or_asked_for(self):
        self.assertEqual([m["message"] for m in self.messages], [])
        self.assertEqual([url for url in self.requests if not url.startswith("data:")], [(self.out / "report.html").resolve().as_uri()])
        self.assertEqual(self.browser.run("return document.getElementById('page').dataset.ready"), "yes")

    def test_title_and_note_are_those_of_the_case(self):
        self.assertEqual(self.browser.run("return document.querySelector('h1').textContent"), "Compressor 7, second rotor")
        self.assertEqual(self.browser.run("return document.querySelector('.user-note').innerText"), "Ribbons as delivered.\nAsk before use.")
        self.assertIn("Case drop", self.browser.run("return document.querySelector('.case-name').textContent"))
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual((summary["title"], summary["note"]), ("Compressor 7, second rotor", "Ribbons as delivered.\nAsk before use."))

    def scale(self):
        """Pixels per millimetre and where x = 0 lies, from the dimension chain's own numbers: ends of the shaft."""
        boxes = self.parts("rect.element")
        first, last = self.geometry["elements"][0], self.geometry["elements"][-1]
        length = self.x[last["n2"]] - self.x[first["n1"]]
        pixels = (boxes[-1][0] + boxes[-1][2] - boxes[0][0]) / length
        return pixels, boxes[0][0] - pixels * self.x[first["n1"]]

    def test_the_shaft_has_the_steps_of_the_case_to_a_pixel(self):
        boxes, (pixels, zero) = self.parts("rect.element"), self.scale()
        self.assertEqual(len(boxes), len(self.geometry["elements"]), "solid: a box each")
        self.assertGreater(pixels, 1, "wide enough to be a drawing")
        middle = boxes[0][1] + boxes[0][3] / 2
        for box, element in zip(boxes, self.geometry["elements"]):
            self.assertAlmostEqual(box[0], zero + pixels * self.x[element["n1"]], delta=0.5)
            self.assertAlmostEqual(box[0] + box[2], zero + pixels * self.x[element["n2"]], delta=0.5)
            self.assertAlmostEqual(box[3], pixels * 1e3 * element["od"], delta=0.5, msg="diameters have the scale of lengths")
            self.assertAlmostEqual(box[1] + box[3] / 2, middle, delta=0.01)
        self.assertGreater(len({round(box[3]) for box in boxes}), 1, "steps are seen")

    def test_parts_stand_at_their_nodes(self):
        pixels, zero = self.scale()
        centre = lambda box: (box[0] + box[2] / 2 - zero) / pixels  # noqa: E731
        for selector, nodes in (("rect.outer-ring", [2, 2, 28, 28]), ("rect.inner-ring", [2, 2, 28, 28]), ("path.magnet", [7, 7, 25, 25]), ("path.probe", [7, 25]), ("path.linear", [16]), ("circle.unbalance", [5, 16])):
            with self.subTest(selector):
                found = sorted(map(centre, self.parts(selector)))
                self.assertEqual(len(found), len(nodes))
                for x, node in zip(found, sorted(nodes)):
                    self.assertAlmostEqual(x, self.x[node], delta=1 / pixels + (2 if selector == "path.linear" else 0), msg="a pixel")
        balls = self.parts("ellipse.ball")
        self.assertEqual(len(balls), 2 * (1 + 2), "rows of TB1 and TB2, above and below")
        middle = self.parts("rect.element")[0]
        for box, (ball, pitch) in zip(balls[:2], ((11.906, 90), (11.906, 90))):
            self.assertAlmostEqual(box[3], pixels * ball, delta=1)
            self.assertAlmostEqual(abs(box[1] + box[3] / 2 - middle[1] - middle[3] / 2), pixels * pitch / 2, delta=1)
        cg = self.browser.run("return document.querySelector('#figure-machine g.centre-of-gravity').transform.baseVal.consolidate().matrix.e")
        body = json.loads((self.out / "summary.json").read_text())["rotor"]
        self.assertAlmostEqual((cg - zero) / pixels, 1e3 * body["centre_of_gravity"], delta=1 / pixels)

    def test_dimensions_are_the_distances(self):
        places = sorted({self.x[1], self.x[2], self.x[7], self.x[16], self.x[25], self.x[28], self.x[31]})
        texts = [float(text) for text in self.browser.run("return [...document.querySelectorAll('#figure-machine .chain')].map((t) => t.textContent)")]
        distances = [b - a for a, b in zip(places, places[1:])]
        self.assertGreaterEqual(len(texts), 4, "room for most of them")
        left = list(distances)
        for text in texts:
            nearest = min(left, key=lambda d: abs(d - text))
            self.assertAlmostEqual(nearest, text, delta=1e-3 * nearest)
            left.remove(nearest)
        self.assertAlmostEqual(float(self.browser.run("return document.querySelector('#figure-machine .length').textContent")), self.x[31] - self.x[1], delta=0.01)

    def test_the_drawing_and_its_names_stay_in_their_frame_and_apart(self):
        for figure in ("machine", "modes"):
            view, boxes = self.browser.run("""const svg = document.querySelector("#figure-" + arguments[0] + " svg"), v = svg.viewBox.baseVal;
                return [[v.width, v.height], [...svg.querySelectorAll("rect, path, circle, ellipse, text:not([transform])")].filter((e) => !e.closest("g[transform]")).map((e) => { const b = e.getBBox(); return [b.x, b.y, b.x + b.width, b.y + b.height, e.outerHTML]; })]""", figure)
            self.assertGreater(len(boxes), 10)
            for x0, y0, x1, y1, what in boxes:
                self.assertTrue(-1 <= x0 and x1 <= view[0] + 1 and -1 <= y0 and y1 <= view[1] + 1, what)
        names = self.browser.run("return [...document.querySelectorAll('#figure-machine .part-name')].map((e) => { const b = e.getBBox(); return [b.x, b.y, b.x + b.width, b.y + b.height, e.textContent]; })")
        self.assertEqual({name[4] for name in names}, {"TB1", "TB2", "M1", "M2", "L1", "magnet_A", "magnet_B"})
        for i, a in enumerate(names):
            for b in names[:i]:
                self.assertTrue(a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1], (a[4], b[4]))

    def test_mode_shapes_are_those_of_the_whole_model(self):
        self.succeed("modes", self.maker.folder / "drop.toml", "--speeds", "15200 rpm", "--shapes", "modes.h5")
        shown = self.data["modes"]["modes"]
        self.assertEqual(len(shown), 6)
        with h5py.File(self.folder / "modes.h5") as modes:
            group = modes["speed_0"]
            for k, mode in enumerate(shown):
                self.assertAlmostEqual(mode["frequency"], group["frequency"][k], delta=2e-3 * group["frequency"][k])
                y = group["shape_y_real"][k] + 1j * group["shape_y_imaginary"][k]
                z = group["shape_z_real"][k] + 1j * group["shape_z_imaginary"][k]
                plane = y if abs(y).max() >= abs(z).max() else z
                top = plane[numpy.argmax(abs(plane))]
                numpy.testing.assert_allclose(mode["shape"], (plane / top).real, atol=0.02)
        drawn = self.browser.run("return [...document.querySelectorAll('#figure-modes path.mode')].map((p) => p.getAttribute('d'))")
        pixels, zero = self.scale()
        for d, mode in zip(drawn, shown):
            points = numpy.array([float(word) for word in re.findall(r"[^ML ]+", d)]).reshape(-1, 2)
            numpy.testing.assert_allclose((points[:, 0] - zero) / pixels, list(self.x.values()), atol=0.1, err_msg="under the side view")
            self.assertAlmostEqual(numpy.ptp(points[:, 1]), 26 * numpy.ptp(mode["shape"]), delta=0.2)

    def test_bending_and_rigid_motion_give_the_recorded_orbits(self):
        bending = self.data["bending"]
        time = numbers_of(bending["time"], "<f4")
        with h5py.File(self.out / "results.h5") as results:
            times = 1e3 * results["/time"][:]
            rows = [int(numpy.argmin(abs(times - t))) for t in time]
            for path, node in (("/bearings/TB1/orbit", 2), ("/bearings/TB2/orbit", 28), ("/probes/magnet_A/position", 7)):
                for column, plane in enumerate("yz"):
                    displacement = sum(shape[node - 1] * unpacked(q) for shape, q in zip(bending["shapes"], bending[plane]))
                    numpy.testing.assert_allclose(displacement, 1e6 * results[path][rows, column], atol=0.05, err_msg=f"{path} {plane}, um")
            numpy.testing.assert_allclose(unpacked(bending["y"][0]), 1e6 * results["/rotor/modal_y"][rows, 0], atol=0.01)
        self.assertEqual(bending["frequencies"][:2], [0, 0])
        self.assertAlmostEqual(bending["frequencies"][2], 673.5, delta=0.5, msg="Hz, the rotor file's first bending frequency")

    def test_the_centre_line_follows_the_slider(self):
        draw = """const slider = document.getElementById("time"); slider.value = arguments[0]; slider.dispatchEvent(new Event("input"));
                  const figure = (id) => [...document.querySelectorAll(`#figure-${id} path.series`)].map((p) => p.getAttribute("d"));
                  return [figure("centre-line"), figure("bending")]"""
        animation, seen = self.data["animation"], []
        for i in (0, 160, len(animation["bearings"][0]["time"]) - 1):
            lines, _ = self.browser.run(draw, i)
            points = [numpy.array([float(word) for word in re.findall(r"[^ML ]+", d)]).reshape(-1, 2) for d in lines]
            self.assertEqual([len(p) for p in points], [31, 31], "a point at each node")
            # Two bearings' recorded orbits give the scale; the other two values then follow.
            (tb1, tb2) = animation["bearings"]
            y, z = points[0][:, 1], points[1][:, 1]
            seen.append(((tb1["y"][i], y[1]), (tb2["y"][i], y[27]), (tb1["z"][i], z[1]), (tb2["z"][i], z[27])))
        pairs = numpy.array(seen).reshape(-1, 2)
        slope, offset = numpy.polyfit(pairs[:, 0], pairs[:, 1], 1)
        self.assertLess(slope, 0, "up is up")
        self.assertLess(abs(pairs[:, 1] - slope * pairs[:, 0] - offset).max(), 0.5, "px")
        self.assertGreater(numpy.ptp(pairs[:, 1]), 50, "px")

    def test_rotor_and_rings_are_never_cut_off(self):
        boxes = self.browser.run("""const slider = document.getElementById("time"), found = [];
            for (let i = 0; i <= +slider.max; i += 3) {
              slider.value = i; slider.dispatchEvent(new Event("input"));
              for (const figure of document.querySelectorAll("figure.drop")) {
                const svg = figure.querySelector("svg"), frame = svg.getBoundingClientRect();
                for (const part of svg.querySelectorAll("g.rotor circle, g:not(.rotor) > circle")) {  // turned boxes would be too large
                  const m = part.getScreenCTM(), r = +part.getAttribute("r") * Math.hypot(m.a, m.b);
                  found.push([m.e - r - frame.left, m.f - r - frame.top, frame.right - m.e - r, frame.bottom - m.f - r]);
                }
                for (const part of svg.querySelectorAll("svg > path:not(.axis):not(.series)")) { const b = part.getBoundingClientRect(); found.push([b.left - frame.left, b.top - frame.top, frame.right - b.right, frame.bottom - b.bottom]); }
              }
            }
            return [Math.min(...found.map((f) => Math.min(...f))), found.length]""")
        self.assertGreater(boxes[1], 100)
        self.assertGreaterEqual(boxes[0], 0, "px to the nearest edge")

    def test_both_pictures_have_one_air_gap(self):
        gaps = self.browser.run("""return ["TB1", "TB2"].map((name) => {
            const orbit = document.querySelector(`#figure-orbit-${name} circle.gap`), view = orbit.ownerSVGElement.viewBox.baseVal;
            return [+orbit.getAttribute("r"), +orbit.getAttribute("cy"), view.height]; })""")
        self.assertAlmostEqual(gaps[0][0], gaps[1][0], delta=0.01, msg="equal gaps are equal circles")
        with h5py.File(self.out / "results.h5") as results:
            rest = [1e6 * results[f"/bearings/{name}/ring_position"][0] for name in ("TB1", "TB2")]
        drops = self.browser.run("return [...document.querySelectorAll('figure.drop circle.gap')].slice(0, 2).map((c) => [+c.getAttribute('r'), +c.getAttribute('cx'), +c.getAttribute('cy')])")
        for (radius, cx, cy), (y, z) in zip(drops, rest):
            self.assertAlmostEqual(radius, 46, delta=0.01)
            self.assertAlmostEqual(cx, 46 / 250 * z, delta=0.01)
            self.assertAlmostEqual(cy, -46 / 250 * y, delta=0.01)
        scale = gaps[0][0] / 250  # px per um in the orbits
        self.assertAlmostEqual(gaps[0][1] - gaps[1][1], -scale * (rest[0][0] - rest[1][0]), delta=0.05, msg="each around its ring")
        self.assertGreater(abs(rest[0][0] - rest[1][0]), 5, "um: the rings hang differently")

    def levels(self, chart):
        """Limits that a figure shows, and levels that its lines of limits stand at, by its own axis."""
        return self.browser.run("""const figure = document.querySelector("#figure-" + arguments[0]), ticks = [...figure.querySelectorAll('text[text-anchor=end]:not(.limit)')].map((t) => [+t.getAttribute("y") - 4, +t.textContent]);
            const [[y0, v0], [y1, v1]] = [ticks[0], ticks[ticks.length - 1]];
            return [...figure.querySelectorAll("path.limit")].map((p) => v0 + (+/M\\S+ (\\S+)h/.exec(p.getAttribute("d"))[1] - y0) / (y1 - y0) * (v1 - v0))""", chart)

    def test_limits_stand_at_their_values(self):
        with h5py.File(self.out / "results.h5") as results:
            rest = [1e6 * results[f"/bearings/{name}/ring_position"][0, 0] for name in ("TB1", "TB2")]
        for chart, expected in (("displacement-y", [rest[0] - 250, rest[0] + 250, rest[1] - 250, rest[1] + 250]), ("contact-force", [4, 4]), ("heat-given", [200]), ("clearance", [0]), ("ring-position", [-150, 150, -150, 150]),
                                ("probe-position", [-400, 400] * 4), ("bearing-force", [-31, 31, -62, 62]), ("temperature-TB1", [130])):
            with self.subTest(chart):
                limits = [limit["value"] for limit in self.charts[chart]["limits"]]
                if chart == "bearing-force":
                    self.assertEqual(limits[:2], [-31, 31], "C0 of TB1, kN")
                else:
                    numpy.testing.assert_allclose(sorted(limits), sorted(expected), atol=1e-3)
                found = self.levels(chart)
                self.assertEqual(len(found), len(limits), "each has its line")
                numpy.testing.assert_allclose(sorted(found), sorted(limits), atol=0.01 * max(abs(v) for v in limits) + 1e-3)
        names = self.browser.run("return [...document.querySelectorAll('#figure-contact-force text.limit, #figure-contact-force .beyond:not([hidden])')].map((t) => t.textContent).join('; ')")
        self.assertIn("TB1: peak_contact_force at most", names)
        beyond = self.browser.run("return document.querySelector('#figure-temperature-TB1 .beyond').textContent")
        self.assertEqual(beyond, "Beyond this figure: temperature_limit of steel (130 K).")

    def test_temperatures_have_degrees_celsius(self):
        label, ticks = self.browser.run("""const figure = document.querySelector("#figure-temperature-TB1");
            return [figure.querySelector(".second-label").textContent, [...figure.querySelectorAll("text.second")].map((t) => [+t.getAttribute("y") - 4, +t.textContent])]""")
        self.assertEqual(label, "temperature [°C]")
        kelvin = self.browser.run("""return [...document.querySelectorAll("#figure-temperature-TB1 text[text-anchor=end]:not(.limit)")].map((t) => [+t.getAttribute("y") - 4, +t.textContent])""")
        slope, zero = numpy.polyfit([y for y, _ in kelvin], [v for _, v in kelvin], 1)
        for y, celsius in ticks:
            self.assertAlmostEqual(celsius, slope * y + zero + 20, delta=0.02, msg="ambient is 20 °C")
        self.assertGreaterEqual(len(ticks), 2)
        rows = {row["name"]: row["values"][0] for row in self.data["numbers"]["rows"]}
        rise, celsius = re.fullmatch(r"(\S+) \((\S+) °C\)", rows["inner-ring temperature rise at end, lumped"]).groups()
        self.assertAlmostEqual(float(celsius), 20 + float(rise), delta=0.01)
        self.assertIn("293.15 K (20 °C)", " ".join(self.data["words"]))

    def test_spectra_are_those_of_numpy(self):
        with h5py.File(self.out / "results.h5") as results:
            orbit, force = 1e6 * results["/bearings/TB2/orbit"][:], results["/bearings/TB2/contact_force"][:]
        n, length, interval = len(force), 128, 50e-6
        window = 0.5 - 0.5 * numpy.cos(2 * numpy.pi * numpy.arange(length) / length)
        segments = (n - length) // (length // 8) + 1
        starts = [(n - length) * i // (segments - 1) for i in range(segments)]
        for name, signal, sides in (("orbit-TB2", orbit[:, 0] + 1j * orbit[:, 1], 1), ("force-TB2", force, 2)):
            spectra = [sides * abs(numpy.fft.fft(window * centred(signal[k:k + length]), 4 * length)) / window.sum() for k in starts]
            frequency = numpy.fft.fftfreq(4 * length, interval)
            chart = self.charts["spectrum-" + name]
            at = [int(numpy.argmin(abs(frequency - f))) for f in chart["lines"][0]["x"]]
            numpy.testing.assert_allclose(frequency[at], chart["lines"][0]["x"], rtol=1e-4)
            for line, expected in zip(chart["lines"], (numpy.max(spectra, axis=0), numpy.sqrt(numpy.mean(numpy.square(spectra), axis=0)))):
                expected = expected[at]
                if sides == 2:
                    expected[numpy.array(line["x"]) == 0] /= 2
                found = 10 ** numpy.array(line["y"], float)
                shown = numpy.isfinite(found)
                numpy.testing.assert_allclose(found[shown], expected[shown], rtol=1e-3)
                self.assertTrue((expected[~shown] < 1.001e-3 * expected.max()).all(), "three decades")
                self.assertGreater(shown.sum(), 20)
            fall = next(fall for fall in self.data["waterfalls"] if fall["id"] == "waterfall-" + name)
            self.assertAlmostEqual(fall["largest"], numpy.max(spectra, axis=0)[at].max(), delta=1e-3 * fall["largest"])
            levels = numbers_of(fall["levels"], "u1").reshape(len(fall["times"]), fall["columns"])
            expected = 255 * numpy.clip(1 + numpy.log10(numpy.maximum(numpy.array(spectra)[:, at], 1e-300) / fall["largest"]) / 3, 0, 1)
            away = numpy.array(chart["lines"][0]["x"]) != 0
            numpy.testing.assert_allclose(levels[:, away], expected[:, away], atol=1.01)

    def test_waterfalls_are_pictures_of_their_amplitudes(self):
        self.assertEqual(len(self.data["waterfalls"]), self.browser.run("return document.querySelectorAll('figure.waterfall').length"))
        self.assertGreaterEqual(len(self.data["waterfalls"]), 5, "orbits of both bearings and probes, forces")
        for fall in self.data["waterfalls"]:
            size, dark, box = self.browser.run("""
                const image = document.querySelector("#figure-" + arguments[0] + " image"), canvas = document.createElement("canvas"), source = new Image();
                source.src = image.getAttribute("href");
                return source.decode().then(() => {
                  [canvas.width, canvas.height] = [source.width, source.height];
                  const context = canvas.getContext("2d");
                  context.drawImage(source, 0, 0);
                  const pixels = context.getImageData(0, 0, source.width, source.height).data;
                  let darkest = 0;
                  for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 2] < pixels[4 * darkest + 2]) darkest = i / 4;
                  return [[source.width, source.height], [Math.floor(darkest / source.width), darkest % source.width], image.getBoundingClientRect().toJSON()];
                })""", fall["id"])
            self.assertEqual(size, [fall["columns"], len(fall["times"])])
            levels = numbers_of(fall["levels"], "u1").reshape(len(fall["times"]), fall["columns"])
            self.assertEqual(levels[len(fall["times"]) - 1 - dark[0], dark[1]], 255, "time runs upwards; the darkest point is the largest amplitude")
            self.assertGreater(min(box["width"], box["height"]), 150)

    def drag(self, figure, low, high):
        box = self.browser.run("const e = document.querySelector(arguments[0] + ' .plot'); e.scrollIntoView({block: 'center'}); return e.getBoundingClientRect().toJSON()", figure)
        y = box["y"] + box["height"] / 2
        self.browser.point(("move", box["x"] + low * box["width"], y), ("down",), ("move", box["x"] + high * box["width"], y), ("up",))
        return box

    def test_a_zoomed_figure_shows_every_sample_and_says_so(self):
        self.drag("#figure-contact-force", 0.5, 0.6)
        try:
            samples, state, ends = self.browser.run("""const figure = document.querySelector("#figure-contact-force");
                return [figure.querySelectorAll("circle.sample").length, figure.querySelector(".state-of-zoom").textContent, [...figure.querySelectorAll("text[text-anchor=middle]:not(.x-label):not(.y-label)")].map((t) => +t.textContent)]""")
            self.assertEqual(state, "Shown: every recorded sample.")
            # 1.5 ms of rows every 50 us, for two bearings, and one or two beyond each side.
            self.assertTrue(2 * 30 <= samples <= 2 * 36, samples)
            self.assertGreaterEqual(min(ends), 7)
            self.assertLessEqual(max(ends), 9.1)
        finally:
            self.browser.run("document.querySelector('#figure-contact-force button').click()")
        self.assertTrue(self.browser.run("return document.querySelector('#figure-contact-force .state-of-zoom').hidden"))

    def test_playback_runs_at_the_chosen_speed(self):
        paces = self.browser.run("return [...document.querySelectorAll('#pace option')].map((o) => o.textContent)")
        self.assertIn("1 s shows 3 ms", paces)
        self.assertIn("real time", paces)
        start = """const slider = document.getElementById("time"), pace = document.getElementById("pace");
                   slider.value = 0; slider.dispatchEvent(new Event("input")); pace.value = arguments[0]; document.getElementById("play").click();
                   return new Promise((done) => { const began = performance.now(); setTimeout(() => { document.getElementById("play").click(); done([performance.now() - began, +slider.value, document.getElementById("play").textContent]); }, 900); })"""
        times = self.data["animation"]["bearings"][0]["time"]
        for pace in (1, 10):
            elapsed, frame, text = self.browser.run(start, pace)
            self.assertEqual(text, "play", "stopped again")
            self.assertAlmostEqual(times[frame], pace * elapsed / 1000, delta=0.35 * pace + 0.06, msg="ms of the drop")

    def test_it_fits_a_telephone_and_a_sheet_of_paper(self):
        try:
            self.browser.call("POST", "/goog/cdp/execute", {"cmd": "Emulation.setDeviceMetricsOverride", "params": {"width": 420, "height": 900, "deviceScaleFactor": 1, "mobile": False}})
            self.browser.open(self.out / "report.html")
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 420)
            self.assertEqual([m["message"] for m in self.browser.log("browser")], [])
            small = self.browser.run("""return [...document.querySelectorAll("figure svg[role] text")].filter((t) => t.textContent && t.getBoundingClientRect().width > 0)
                .map((t) => [parseFloat(getComputedStyle(t).fontSize) * t.ownerSVGElement.getBoundingClientRect().width / t.ownerSVGElement.viewBox.baseVal.width, t.textContent]).filter(([size]) => size < 8.5)""")
            self.assertEqual(small, [], "letters that are too small to read")
        finally:
            self.browser.call("POST", "/goog/cdp/execute", {"cmd": "Emulation.clearDeviceMetricsOverride", "params": {}})
            self.browser.open(self.out / "report.html")
        printed = base64.b64decode(self.browser.call("POST", "/print", {"page": {"width": 21, "height": 29.7}, "shrinkToFit": False, "background": True}))
        self.assertTrue(printed.startswith(b"%PDF"))
        self.assertLess(len(re.findall(rb"/Type\s*/Page\b", printed)), 24)


if __name__ == "__main__":
    unittest.main()

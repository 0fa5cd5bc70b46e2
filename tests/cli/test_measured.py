"""Measured series: rotordrop compare --measured, and [fit] of a real drop from a noisy, filtered, delayed measurement of it."""

import json
import math
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from browser import BROWSER, DRIVER, Browser  # noqa: E402
from program import ProgramTest, page_data  # noqa: E402

BANDWIDTH, DELAY, NOISE = 3e3, 0.05e-3, 1e-6  # Hz, s, m
FRICTION, STIFFNESS = 0.17, 1.3e9


def sensor(times, values, at):
    """First-order low-pass by small backward Euler steps (scipy-free, other than the program's exact solution), then a delay."""
    fine = numpy.arange(times[0], times[-1], 1e-6)
    x = numpy.interp(fine, times, values)
    y, tau = numpy.empty_like(x), 1 / (2 * math.pi * BANDWIDTH)
    y[0] = x[0]
    for i in range(1, len(x)):
        y[i] = (y[i - 1] + 1e-6 / tau * x[i]) / (1 + 1e-6 / tau)
    return numpy.interp(at - DELAY, fine, y)


class Measured(ProgramTest):
    def setUp(self):
        super().setUp()
        # Rows every 10 us: between rows 50 us apart an impact would differ by more than the noise.
        self.case('output.interval = "10 us"\n')
        self.run_case("drop.toml", output="truth", contact__friction_coefficient=FRICTION, bearings__TB1__contact_stiffness=STIFFNESS, bearings__TB2__contact_stiffness=STIFFNESS)
        with h5py.File(self.folder / "truth/results.h5") as h5:
            times, orbit = h5["/time"][:], h5["/bearings/TB1/orbit"][:]
        at = numpy.arange(0.2e-3, 9.9e-3, 0.02e-3)
        self.rng = numpy.random.default_rng(11)
        columns = [1e3 * at] + [1e6 * (sensor(times, orbit[:, k], at) + NOISE * self.rng.standard_normal(len(at))) for k in (0, 1)]
        self.at, self.n = at, len(at)
        numpy.savetxt(self.folder / "measured.csv", numpy.transpose(columns), delimiter=",", header="time [ms],/bearings/TB1/orbit[0] [um],/bearings/TB1/orbit[1] [um]", comments="")
        keys = f'bandwidth = "{BANDWIDTH} Hz"\ndelay = "{DELAY} s"\ndeviation = {1e6 * NOISE}\n'
        self.tables = "".join(f'[[NAME]]\nfile = "measured.csv"\nseries = "/bearings/TB1/orbit"\ncomponent = {k}\nvalue = "/bearings/TB1/orbit[{k}]"\n{keys}' for k in (0, 1))

    def test_a_drop_beside_a_measurement_of_itself_differs_by_the_noise(self):
        self.write("measured.toml", self.tables.replace("NAME", "measured"))
        told = self.succeed("compare", "truth", "--measured", "measured.toml").stdout
        self.assertIn("variance explained", told)
        report = json.loads((self.folder / "truth/measured.json").read_text())["measured"]
        for one in report:
            # The rms of n numbers is known to 1 / sqrt(2 n) = 3 %; what lies between rows adds some.
            self.assertAlmostEqual(one["rms"] / NOISE, 1, delta=0.15)
            self.assertEqual((one["n"], one["unit"]), (self.n, "m"))
        self.assertIn("Measured and computed", (self.folder / "truth/measured.html").read_text())
        # Without its sensor the same drop differs by more.
        self.succeed("compare", "truth", "--measured", "measured.csv", "-o", "plain.json")
        plain = json.loads((self.folder / "plain.json").read_text())["measured"]
        self.assertGreater(plain[0]["rms"], 2 * report[0]["rms"])

    def test_the_page_draws_all_that_was_computed(self):
        """Also where nothing was measured; without a sensor as it is recorded."""
        header, *rows = (self.folder / "measured.csv").read_text().splitlines()
        self.write("few.csv", "\n".join([header, *rows[100:250:50]]) + "\n")
        self.succeed("compare", "truth", "--measured", "few.csv")
        figure = page_data((self.folder / "truth/measured.html").read_text())["overlay"][0]
        with h5py.File(self.folder / "truth/results.h5") as h5:
            times, orbit = h5["/time"][:], h5["/bearings/TB1/orbit"][:, 0]
        drawn = figure["curves"][0]
        self.assertEqual(len(figure["measured"]["times"]), 3)
        self.assertAlmostEqual(drawn["times"][0], times[0], delta=1e-9, msg="s")
        self.assertAlmostEqual(drawn["times"][-1], times[-1], delta=1e-9, msg="s")
        numpy.testing.assert_allclose(drawn["values"], numpy.interp(drawn["times"], times, orbit), rtol=1e-4, atol=1e-9)

    def test_neither_numbers_nor_page_replace_files_unasked(self):
        for name in ("mine.json", "mine.html"):
            self.write(name, "mine")
            done = self.call("compare", "truth", "--measured", "measured.csv", "-o", "mine.json")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(f"{name}: the file already exists", done.stderr)
            self.assertEqual((self.folder / name).read_text(), "mine")
            (self.folder / name).unlink()
        self.assertFalse((self.folder / "mine.json").exists())

    def test_units_in_brackets_count_with_and_without_a_blank(self):
        text = (self.folder / "measured.csv").read_text()
        found = []
        for header in ("time [ms],/bearings/TB1/orbit[0] [um],/bearings/TB1/orbit[1] [um]", "time[ms],/bearings/TB1/orbit[0][um],/bearings/TB1/orbit[1] (um)", "time (ms),/bearings/TB1/orbit (um),/bearings/TB1/orbit[1](um)"):
            self.write("m.csv", header + text[text.index("\n"):])
            self.succeed("compare", "truth", "--measured", "m.csv", "-o", "m.json", "--force")
            found.append(json.loads((self.folder / "m.json").read_text())["measured"])
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])
        # By the name, or all of what stands there; a number or a word that is no unit is part of the name.
        self.write("m.csv", "t[ms],y[um],z[0],w (filtered),v[mum],u[W/(m K)]\n" + "".join(f"{t},100,1e-4,1e-4,1,1\n" for t in (1, 2, 3)))
        table = '[[measured]]\nfile = "m.csv"\nseries = "/bearings/TB1/orbit"\nvalue = '
        rms = set()
        for name in ("y", "y[um]", "z[0]", "w (filtered)"):
            self.write("m.toml", f'{table}"{name}"\n')
            self.succeed("compare", "truth", "--measured", "m.toml", "-o", "m.json", "--force")
            rms.add(round(json.loads((self.folder / "m.json").read_text())["measured"][0]["rms"], 12))
        self.assertEqual(len(rms), 1)
        self.write("m.toml", f'{table}"v"\n')
        done = self.call("compare", "truth", "--measured", "m.toml", "-o", "m.json", "--force")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('"mum" is no unit of a series', done.stderr)

    def test_every_unit_of_the_results_is_one_of_measured_values(self):
        series = {}

        def visit(path, item):
            if isinstance(item, h5py.Dataset) and "time" in item.attrs:
                series.setdefault(item.attrs["units"], "/" + path)

        with h5py.File(self.folder / "truth/results.h5") as h5:
            h5.visititems(visit)
        self.assertTrue({"N", "N m", "N s", "J", "W", "K", "rad/s"} <= set(series), series)
        for unit, path in series.items():
            self.write("m.csv", f"time [ms],{path}[0] [{unit}]\n1,1\n2,2\n3,3\n")
            self.succeed("compare", "truth", "--measured", "m.csv", "-o", "m.json", "--force")
            self.assertEqual(json.loads((self.folder / "m.json").read_text())["measured"][0]["unit"], unit)

    def test_times_are_no_series(self):
        for series in ("/time", "/detail/time"):
            self.write("m.csv", f"t [ms],{series} [ms]\n1,1\n2,2\n3,3\n")
            done = self.call("compare", "truth", "--measured", "m.csv", "-o", "m.json")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(f'measured.series = "{series}" holds the times of other series', done.stderr)
            self.write("s.toml", f'case = "drop.toml"\n[vary]\ncontact.friction_coefficient = [0.1, 0.2]\n[design]\nkind = "grid"\n[keep]\nseries = ["{series}"]\n')
            done = self.call("study", "s.toml", "-o", "s")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, rf"s\.toml:7:\d+: keep\.series: {series} holds the times of other series")
        # What a part of one's own calls so lies deeper, and is a series like others; these results have none.
        self.write("m.csv", "t [ms],/bearings/TB1/valve/time [ms]\n1,1\n2,2\n3,3\n")
        done = self.call("compare", "truth", "--measured", "m.csv", "-o", "m.json")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertNotIn("holds the times", done.stderr)

    def test_the_noise_is_a_number_in_the_values_unit_or_a_quantity(self):
        found = []
        for deviation in ("0.8", '"0.8"', '"0.8 um"', '"0.0008 mm"', "0.9"):
            self.write("m.toml", self.tables.replace("NAME", "measured").replace(f"deviation = {1e6 * NOISE}", f"deviation = {deviation}"))
            self.succeed("compare", "truth", "--measured", "m.toml", "-o", "m.json", "--force")
            found.append(json.loads((self.folder / "m.json").read_text())["measured"][0]["deviation"])
        for number in found[:4]:
            self.assertAlmostEqual(number, 0.8e-6, delta=1e-18)
        self.assertAlmostEqual(found[4], 0.9e-6, delta=1e-18)
        for deviation, says in (('"0.8 N"', "0.8 N is a force; measured.deviation needs a length"), ("0", "measured.deviation = 0 is out of range: it must be > 0"), ("inf", "measured.deviation = inf is out of range"), ("nan", "out of range"), ('"-1 um"', "must be > 0"), ("true", "it must be a number or a quantity")):
            self.write("m.toml", self.tables.replace("NAME", "measured").replace(f"deviation = {1e6 * NOISE}", f"deviation = {deviation}"))
            done = self.call("compare", "truth", "--measured", "m.toml", "-o", "m.json", "--force")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, r"m\.toml:\d+:\d+: ")
            self.assertIn(says, done.stderr)

    def test_values_after_the_end_of_the_drop_are_left_out_and_counted(self):
        # The drop ends at 10 ms; afterwards its orbit was a metre away.
        later = "".join(f"{t},1e6,1e6\n" for t in (10.5, 11, 11.5))
        self.write("long.csv", (self.folder / "measured.csv").read_text() + later)
        told = self.succeed("compare", "truth", "--measured", "long.csv", "-o", "long.json").stdout
        self.succeed("compare", "truth", "--measured", "measured.csv", "-o", "short.json")
        long, short = (json.loads((self.folder / name).read_text())["measured"] for name in ("long.json", "short.json"))
        self.assertEqual([one.pop("after_end") for one in long + short], [3, 3, 0, 0])
        for one in long + short:
            del one["file"]
        self.assertEqual(long, short)
        self.assertIn(f"{self.n} values (3 after the end of the drop left out)", told)
        self.write("late.csv", "time [ms],/bearings/TB1/orbit[0] [um]\n" + "".join(f"{t},1\n" for t in (11, 12, 13)))
        done = self.call("compare", "truth", "--measured", "late.csv", "-o", "late.json")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("none of the 3 values of /bearings/TB1/orbit[0]", done.stderr)

    def test_a_fit_leaves_out_what_was_measured_after_the_end(self):
        study = 'case = "drop.toml"\n[vary]\ncontact.friction_coefficient = { range = [0.05, 0.4] }\n[fit]\nevaluations = 5\n[[fit.measured]]\nfile = "long.csv"\nseries = "/bearings/TB1/orbit"\ntime_unit = "ms"\nunit = "um"\n'
        table = "".join(f"{t},{y}\n" for t, y in ((1, 0), (5, -9), (8, -200), (9, -230)))
        self.write("f.toml", study)
        self.write("long.csv", table)
        self.succeed("study", "f.toml", "-o", "short")
        self.write("long.csv", table + "10.5,900\n11,900\n")
        done = self.succeed("study", "f.toml", "-o", "long")
        self.assertIn("f.toml:6:1: values of /bearings/TB1/orbit[0] in long.csv after the end of the drop, 0.01 s, are left out: 2 of 6", done.stderr)
        self.assertIn("4 values (2 after the end of the drop left out)", done.stdout)
        long, short = (json.loads((self.folder / name / "study.json").read_text())["fit"] for name in ("long", "short"))
        self.assertEqual([one["measured"][0].pop("after_end") for one in (long, short)], [2, 0])
        self.assertEqual(long, short)
        self.succeed("study", "report", "long")
        self.assertEqual(page_data((self.folder / "long/report.html").read_text())["fit"]["measured"][0]["after_end"], 2)
        self.write("long.csv", "10.5,1\n11,1\n12,1\n")
        done = self.call("study", "f.toml", "-o", "none")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("none of the 3 values", done.stderr)

    def test_an_empty_cell_at_the_end_is_no_number(self):
        self.write("m.csv", "time [ms],/bearings/TB1/orbit[0] [um]\n1,1\n2,\n3,1\n4,1\n")
        told = self.succeed("compare", "truth", "--measured", "m.csv", "-o", "m.json").stdout
        self.assertEqual(json.loads((self.folder / "m.json").read_text())["measured"][0]["n"], 3)
        self.assertIn("the measured values do not vary", told)
        self.assertNotIn("nan", told)

    def test_datasets_of_hdf5_have_the_unit_of_their_attribute(self):
        with h5py.File(self.folder / "m.h5", "w") as h5:
            for name, values, unit in (("t", [1, 2, 3], "ms"), ("y", [100, 100, 100], "um"), ("si", [1e-4, 1e-4, 1e-4], None)):
                h5[name] = values if unit is None else numpy.array(values, dtype=float)
                if unit:
                    h5[name].attrs["units"] = unit
        found = []
        for name in ("y", "si"):
            self.write("m.toml", f'[[measured]]\nfile = "m.h5"\nseries = "/bearings/TB1/orbit"\ntime = "t"\nvalue = "{name}"\n')
            self.succeed("compare", "truth", "--measured", "m.toml", "-o", "m.json", "--force")
            found.append(json.loads((self.folder / "m.json").read_text())["measured"][0])
        self.assertEqual(found[0]["n"], 3)
        self.assertAlmostEqual(found[0]["rms"], found[1]["rms"], delta=1e-12)

    def test_what_cannot_be_compared_is_told(self):
        self.write("bad.csv", "time,/bearings/TB1/orbitt[0] [um]\n0,1\n1e-3,2\n2e-3,3\n")
        self.assertIn('Did you mean "/bearings/TB1/orbit"', self.call("compare", "truth", "--measured", "bad.csv").stderr)
        self.write("bad.csv", "time,/bearings/TB1/orbit[0] [N]\n0,1\n1e-3,2\n2e-3,3\n")
        self.assertIn("is in m, but the measured values are in N", self.call("compare", "truth", "--measured", "bad.csv").stderr)
        self.write("bad.csv", "time,/bearings/TB1/orbit[2] [um]\n0,1\n1e-3,2\n2e-3,3\n")
        self.assertIn("bad.csv: component 2: /bearings/TB1/orbit has 2 columns.\n       Columns count from 0.", self.call("compare", "truth", "--measured", "bad.csv").stderr)
        self.write("bad.csv", "time,y\n0,1\n")
        done = self.call("compare", "truth", "--measured", "bad.csv")
        self.assertEqual(done.returncode, 2)
        self.assertIn("names no series", done.stderr)

    def test_a_fit_finds_the_friction_and_stiffness_of_a_drop(self):
        study = f"""
case = "drop.toml"
[vary]
contact.friction_coefficient = {{ range = [0.05, 0.4], reference = 0.3 }}
stiffness = {{ keys = ["bearings.TB1.contact_stiffness", "bearings.TB2.contact_stiffness"], range = [0.5e9, 4e9], scale = "log", reference = 1e9 }}
[keep]
results = ["bearings.*.peak_contact_force"]
[fit]
evaluations = 60
"""
        self.write("f.toml", study + self.tables.replace("NAME", "fit.measured"))
        told = self.succeed("study", "f.toml", "-o", "out").stdout
        self.assertIn("Fitted values", told)
        fit = json.loads((self.folder / "out/study.json").read_text())["fit"]
        for name, truth in (("contact.friction_coefficient", FRICTION), ("stiffness", STIFFNESS)):
            p = fit["parameters"][name]
            # One noise: an interval misses once in twenty; three times its half width practically never.
            self.assertLess(abs(p["value"] - truth), 3 * max(p["high"] - p["value"], p["value"] - p["low"]), (name, p))
            self.assertLess(p["high"] - p["low"], 0.2 * truth, (name, p))
        for one in fit["measured"]:
            self.assertAlmostEqual(one["rms"] / NOISE, 1, delta=0.15)
        with h5py.File(self.folder / "out/study.h5") as h5:
            self.assertEqual(h5[f"/series/{fit['point']}/measured/1"].shape, (self.n,))
        self.succeed("study", "f.toml", "-o", "alone", "--jobs", "1")
        self.assertEqual((self.folder / "alone/study.h5").read_bytes(), (self.folder / "out/study.h5").read_bytes())
        (self.folder / "measured.csv").unlink()  # the directory keeps what it needs
        self.succeed("study", "report", "out")
        if DRIVER and BROWSER:
            browser = Browser()
            self.addCleanup(browser.close)
            browser.open(self.folder / "out/report.html")
            self.assertEqual(browser.run("return document.getElementById('page').dataset.ready"), "yes")
            self.assertEqual([m["message"] for m in browser.log("browser")], [])
            self.assertEqual(browser.run("return document.querySelectorAll('#fit svg .curve').length"), 4)


if __name__ == "__main__":
    unittest.main()

"""Warnings of a run: in the summary, on the screen, in the report, and fatal by choice."""

import pathlib
import re
import shutil
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, SOURCE, ProgramTest, page_data, settings  # noqa: E402

# Rotor and bores as soft as rubber: the rotor dips deeper than half its gap of 250 um.
SOFT = settings(bearings__TB1__contact_stiffness="5e6", bearings__TB2__contact_stiffness="5e6", run__end_time="20 ms")


class Warnings(ProgramTest):
    def warnings(self, directory):
        return {(w["code"], w["place"], w["part"]): w for w in self.summary(directory)["warnings"]}

    def test_codes_are_those_of_the_document(self):
        done = self.call("check", "reference.toml", "--set", 'run.fatal_warnings=["energy-residul"]')
        self.assertEqual(done.returncode, 2)
        self.assertIn('Did you mean "energy-residual"?', done.stderr)
        known = set(re.sub(r"\s+", " ", done.stderr).partition("Known: ")[2].strip().rstrip(".").split(", ")) - {"all"}
        text = (SOURCE / "docs/reference/warnings.md").read_text()
        self.assertEqual(set(re.findall(r"^\| `([a-z-]+)` \| (?:in time|at the end) \|", text, re.M)), known)
        self.assertGreater(len(known), 15)

    def test_a_soft_contact_is_too_deep_as_the_series_has_it(self):
        screen = self.succeed("run", "reference.toml", "-o", "soft", *SOFT, *settings(output__interval="2 us")).stdout
        found = self.warnings("soft")
        with h5py.File(self.folder / "soft/results.h5") as file:
            for name in ("TB1", "TB2"):
                depth = file[f"bearings/{name}/penetration"][()]
                w = found["penetration", name, ""]
                self.assertEqual(w["limit"], 125e-6)
                self.assertEqual(w["unit"], "m")
                self.assertAlmostEqual(w["worst"], depth.max(), delta=1e-3 * depth.max(), msg="steps lie beside the records")
                above = depth > 125e-6
                self.assertEqual(w["count"], int(numpy.count_nonzero(above[1:] & ~above[:-1])))
                self.assertAlmostEqual(w["first_time"], file["time"][int(numpy.argmax(above))], delta=50e-6)
                self.assertRegex(screen, rf"warning: {name}: rotor and bore overlap by up to [0-9.]+ um at [0-9.]+ ms, more than half the air gap .*\[penetration\]")
        self.assertEqual(self.summary("soft")["run"]["warnings"], len(found))
        self.assertIn(f"{len(found)} warnings (docs/reference/warnings.md):", screen)
        self.succeed("report", "soft")
        page = (self.folder / "soft/report.html").read_text()
        data = page_data(page)
        self.assertEqual([check["state"] for check in data["checks"] if check["name"] == "penetration"], ["warning", "warning"])

    def test_lost_energy_does_not_stay_silent(self):
        # What is lost follows from the summary's own balance: a tolerance of 1e-2 without a bound on the step loses more than 0.1 % of what is moved, one of 1e-6 does not.
        for tolerance, is_lossy in (("1e-2", True), ("1e-6", False)):
            name = tolerance
            self.succeed("run", "reference.toml", "-o", name, *settings(integration__method="tsitouras", integration__tolerance=tolerance, integration__step="1 ms", run__end_time="20 ms"))
            e = self.summary(name)["energy"]
            lost = abs(e["residual"]) / (e["dissipated"] + sum(abs(e[key]) for key in ("growth_work", "prescribed_work", "unbalance_work", "drive_work")))
            self.assertEqual(lost > 1e-3, is_lossy, "the case is to be one or the other")
            found = self.warnings(name).get(("energy-residual", "", ""))
            self.assertEqual(found is not None, is_lossy)
            if found:
                self.assertGreaterEqual(found["worst"], lost * (1 - 1e-9), "the end is one of the rows looked at")

    def test_a_fatal_warning_ends_the_run_with_its_state_saved(self):
        done = self.call("run", "reference.toml", "-o", "out", *SOFT, "--set", 'run.fatal_warnings=["penetration"]')
        self.assertEqual(done.returncode, 1, done.stderr)
        time = float(re.search(r"run\.fatal_warnings: penetration of TB[12] at t = ([0-9.]+) ms", done.stderr)[1])
        self.assertRegex(done.stderr, "The last good state, at t = .* ms, is saved in out/failed")
        self.assertTrue(list((self.folder / "out/failed").glob("*.h5")))
        self.succeed("run", "reference.toml", "-o", "calm", *SOFT)
        first = min(w["first_time"] for (code, _, _), w in self.warnings("calm").items() if code == "penetration")
        self.assertAlmostEqual(time, first * 1e3, delta=1e-3)

    def test_what_shows_only_at_the_end_is_fatal_there(self):
        worn = settings(contact__wear_depth_limit="1e-15 m", run__end_time="12 ms")
        self.succeed("run", "reference.toml", "-o", "calm", *worn)
        self.assertIn(("wear", "TB1", "bore"), self.warnings("calm"))
        done = self.call("run", "reference.toml", "-o", "out", *worn, "--set", 'run.fatal_warnings=["wear"]')
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"the run is complete, but run\.fatal_warnings makes it fail:\n +TB1: the bore wears by .* \[wear\]")
        self.assertTrue(self.summary("out")["run"]["completed"])
        again = self.call("run", "reference.toml", "-o", "out", "--resume", *worn, "--set", 'run.fatal_warnings=["wear"]')
        self.assertEqual(again.returncode, 1, "a run that failed does not turn good by --resume")
        self.assertIn("[wear]", again.stderr)

    def test_a_part_too_hot_for_its_material(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(materials__steel__temperature_limit="293.2 K", run__end_time="12 ms"))
        found = self.warnings("out")
        with h5py.File(self.folder / "out/results.h5") as file:
            rise = file["thermal/TB1/inner_ring"][()]
            self.assertAlmostEqual(found["temperature", "TB1", "inner ring (lumped)"]["worst"], rise.max(), delta=1e-9)
        self.assertNotIn(("temperature", "TB1", "ball (lumped)"), found, "Si3N4 stands more")
        self.assertIn(("local-temperature", "TB1", "bore"), found)

    def test_rows_too_far_apart_for_what_is_taken_from_them(self):
        """What every second row changes is what rows twice as far apart change: the run with these is the known answer."""
        rises = {}
        for interval, is_coarse in ((0.2e-3, False), (1e-3, True), (2e-3, True)):
            summary = self.run_case("reference.toml", "--force", run__end_time="12 ms", output__interval=interval)
            told = {w["place"]: (w["worst"], w["limit"]) for w in summary["warnings"] if w["code"] == "coarse-rows"}
            rises[interval] = {name: b["local"]["bore_rise"] for name, b in summary["bearings"].items()}
            self.assertEqual(sorted(told), ["TB1", "TB2"] if is_coarse else [])
            if interval == 1e-3:
                at_1_ms = told
        for name, (worst, limit) in at_1_ms.items():
            self.assertEqual(limit, 0.05)
            self.assertGreaterEqual(worst, 0.99 * abs(rises[2e-3][name] / rises[1e-3][name] - 1), name)

    def test_chatter_shorter_than_rows_does_not_make_them_coarse(self):
        """A light ring on a stiff contact chatters through its first impact in contacts of some 50 us."""
        shutil.copytree(PARAMS / "own-machine", self.folder / "own")
        rises = []
        for interval in (50e-6, 5e-6):
            summary = self.run_case("own/drop.toml", "--force", run__end_time="20 ms", output__interval=interval)
            first = [b["first_contact_end"] - b["first_contact_time"] for b in summary["bearings"].values()]
            self.assertLess(max(first), 10 * 50e-6, "the first contact has fewer than ten rows of 50 us")
            self.assertNotIn("coarse-rows", [w["code"] for w in summary["warnings"]])
            rises.append([b["local"]["bore_rise"] for b in summary["bearings"].values()])
        for coarse, fine in zip(*rises):
            self.assertAlmostEqual(coarse, fine, delta=0.05 * fine, msg="K")

    def test_a_run_that_ends_before_the_rotor_touches_is_told(self):
        # By free fall it bridges the gap after sqrt(2 250 um / 9.81 m/s2) = 7.14 ms.
        for end, is_told in (("6.9 ms", True), ("7.5 ms", False)):
            screen = self.succeed("run", "reference.toml", "-o", end, *settings(run__end_time=end)).stdout
            self.assertEqual(("no-contact", "", "") in self.warnings(end), is_told, end)
            self.assertEqual("the run ends at 6.9 ms, before the rotor touches a touchdown bearing" in screen, is_told)
        self.assertAlmostEqual(self.warnings("6.9 ms")["no-contact", "", ""]["worst"], 6.9e-3, delta=1e-15)

    def test_a_sound_run_is_silent(self):
        screen = self.succeed("run", self.case(""), "-o", "out").stdout
        self.assertEqual(self.summary()["warnings"], [])
        self.assertEqual(self.summary()["run"]["warnings"], 0)
        self.assertNotIn("warning", screen)


if __name__ == "__main__":
    unittest.main()

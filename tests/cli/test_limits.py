"""Limits of one's own: accepted, rejected or not assessed, in the summary, on the screen, in the report and as an exit code."""

import json
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest, page_data, settings  # noqa: E402

PEAK, CATCH_UP, HEAT = "bearings.TB1.peak_contact_force", "bearings.TB1.catch_up_time", "bearings.TB1.friction_heat"


class Limits(ProgramTest):
    def limited(self, text, name="drop.toml"):
        return self.case("[limits]\n" + text, name)

    def entry(self, key, directory="out"):
        found = [limit for limit in self.summary(directory)["limits"] if limit["key"] == key]
        self.assertEqual(len(found), 1, key)
        return found[0]

    def test_a_drop_that_touches_nothing_is_not_assessed(self):
        case = self.limited(f'{PEAK}.max = "9 kN"\n')
        done = self.call("run", case, "-o", "out", "--accept", *settings(run__end_time="3 ms"))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIsNone(self.entry(PEAK)["accepted"])
        self.assertIsNone(self.summary()["accepted"])
        self.assertEqual(self.call("run", case, "-o", "fell", "--accept", *settings(run__end_time="20 ms")).returncode, 0)

    def test_usage_is_the_ratio_of_value_and_limit(self):
        # Dotted and quoted names, an upper and a lower limit, units of the user's own.
        case = self.limited(f'{PEAK}.max = "9 kN"\n"{HEAT}" = {{ max = "1 J", min = "0.001 J" }}\nrotor.mass.min = "100 kg"\n')
        screen = self.succeed("run", case, "-o", "out").stdout
        summary = self.summary()
        bearing = summary["bearings"]["TB1"]
        peak = self.entry(PEAK)
        self.assertEqual((peak["limit"], peak["unit"], peak["kind"]), (9e3, "N", "max"))
        self.assertAlmostEqual(peak["usage"], bearing["peak_contact_force"] / 9e3, delta=1e-12)
        self.assertIs(peak["accepted"], bearing["peak_contact_force"] <= 9e3)
        self.assertIs(peak["accepted"], True, "4.9 kN in this drop")
        self.assertAlmostEqual(self.entry("rotor.mass")["usage"], 100 / summary["rotor"]["mass"], delta=1e-12)
        upper, lower = [limit for limit in summary["limits"] if limit["key"] == HEAT]
        self.assertEqual((upper["kind"], lower["kind"]), ("max", "min"))
        self.assertEqual(upper["accepted"], bearing["friction_heat"] <= 1)
        self.assertEqual(lower["accepted"], bearing["friction_heat"] >= 0.001)
        self.assertEqual(summary["accepted"], all(limit["accepted"] for limit in summary["limits"]))
        self.assertRegex(screen, rf"accepted +{100 * peak['usage']:.3g} %  bearings\.TB1\.peak_contact_force = [0-9.]+ kN, at most 9 kN")

    def test_what_is_exceeded_is_rejected_and_told_first(self):
        case = self.limited(f'{PEAK}.max = "1 kN"\nrotor.mass.min = 1\n')
        done = self.succeed("run", case, "-o", "out")
        self.assertRegex(done.stdout, r"Limits: \d of \d met in this drop: REJECTED\n  REJECTED +\d+ %  bearings\.TB1\.peak_contact_force")
        self.assertIs(self.entry(PEAK)["accepted"], False)
        self.assertGreater(self.entry(PEAK)["usage"], 1)
        self.assertIs(self.summary()["accepted"], False)
        self.succeed("report", "out")
        page = (self.folder / "out/report.html").read_text()
        data = page_data(page)
        self.assertEqual(data["acceptance"]["state"], "warning")
        self.assertEqual([row["state"] for row in data["acceptance"]["rows"]], ["warning", "ok"])
        self.assertLess(list(data).index("acceptance"), list(data).index("numbers"), "first")

    def test_the_exit_code_follows_only_if_asked(self):
        bad, good = self.limited(f'{PEAK}.max = "1 kN"\n'), self.limited(f'{PEAK}.max = "50 kN"\n', "good.toml")
        self.succeed("run", bad, "-o", "a")
        self.assertEqual(self.call("run", bad, "-o", "b", "--accept").returncode, 3)
        self.succeed("run", good, "-o", "c", "--accept")
        done = self.call("run", self.case("", "none.toml"), "-o", "d", "--accept")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the case has no [limits]", done.stderr)

    def test_what_did_not_happen_is_not_accepted(self):
        case = self.limited(f'{CATCH_UP}.max = "1 s"\n')
        done = self.call("run", case, "-o", "out", "--accept")
        self.assertEqual(done.returncode, 3, "the ring has no time to catch up")
        limit = self.entry(CATCH_UP)
        self.assertEqual((limit["value"], limit["usage"], limit["accepted"]), (None, None, None))
        self.assertIsNone(self.summary()["accepted"])
        self.assertRegex(done.stdout, r"not assessed +-  bearings\.TB1\.catch_up_time: no value, at most 1 s")

    def test_a_limit_on_nothing_is_found_before_the_run(self):
        for command in (("check",), ("run", "-o", "out")):
            done = self.call(command[0], self.limited('bearings.TB1.peak_contact_frce.max = "6 kN"\n"bearings.TB1.friction_heat" = { max = "6 K" }\n'), *command[1:])
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, r"drop\.toml:\d+:\d+: limits\.bearings\.TB1\.peak_contact_frce: no result is called so")
            self.assertIn('Did you mean "bearings.TB1.peak_contact_force"?', done.stderr)
            self.assertRegex(done.stderr, "limits.bearings.TB1.friction_heat.*energy")
        self.assertFalse((self.folder / "out").exists())
        done = self.call("check", self.limited("rotor.mass.maximum = 1\n"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("Known: max, min", done.stderr)

    def test_a_star_stands_for_every_bearing_and_the_resolved_case_keeps_limits(self):
        self.succeed("run", self.limited('"bearings.*.peak_contact_force" = { max = "50 kN" }\n'), "-o", "out")
        self.assertEqual([limit["key"] for limit in self.summary()["limits"]], ["bearings.TB1.peak_contact_force", "bearings.TB2.peak_contact_force"])
        self.succeed("run", "out/parameters.toml", "-o", "again")
        self.assertEqual(self.summary("again")["limits"], self.summary()["limits"])

    def test_a_study_takes_the_limits_of_its_case(self):
        self.limited(f'{PEAK}.max = "1 kN"\n{HEAT}.max = "1 kJ"\n')
        self.write("study.toml", f'case = "drop.toml"\n[vary]\n"contact.friction_coefficient" = [0.05, 0.1]\n[design]\nkind = "grid"\n[limits]\n"{PEAK}" = {{ max = "50 kN" }}\n')
        self.succeed("study", "study.toml", "-o", "s")
        limits = {limit["result"]: limit for limit in json.loads((self.folder / "s/study.json").read_text())["limits"]}
        self.assertEqual((limits[PEAK]["max"], limits[PEAK]["broken"]), (50e3, 0), "the study's own")
        self.assertEqual((limits[HEAT]["max"], limits[HEAT]["broken"], limits[HEAT]["n"]), (1e3, 0, 2), "the case's")


if __name__ == "__main__":
    unittest.main()

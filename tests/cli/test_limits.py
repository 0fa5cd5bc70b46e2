"""Limits of one's own: accepted, rejected or not assessed, in the summary, on the screen, in the report and as an exit code."""

import json
import re
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

    def test_a_run_that_ends_in_the_first_impact_is_not_assessed(self):
        # The rotor falls through 250 um in 7.14 ms; the impact lasts more than a millisecond. Half a millisecond later the force still rises.
        case = self.limited('"bearings.*.peak_contact_force" = { max = "4 kN" }\nbearings.TB1.damage.allowed_drops.min = 1\n')
        done = self.call("run", case, "-o", "out", "--accept", *settings(run__end_time="7.4 ms"))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        bearing = self.summary()["bearings"]["TB1"]
        self.assertEqual((bearing["ends_in_first_contact"], bearing["first_contact_end"]), (True, None))
        self.assertAlmostEqual(bearing["peak_contact_force_time"], 7.4e-3, delta=1e-9)
        why = "the run ends in the first contact with the bearing"
        self.assertEqual((self.entry(PEAK)["accepted"], self.entry(PEAK)["why"]), (None, why))
        self.assertIn(f"at most 4 kN; {why}", done.stdout)
        self.assertEqual((bearing["damage"]["assessed"], bearing["damage"]["why"], bearing["damage"]["allowed_drops"]), (False, why, None))
        self.assertIn(f"damage per drop: not assessed, {why}", done.stdout)
        self.assertIsNone(self.entry("bearings.TB1.damage.allowed_drops")["accepted"])
        # What breaks its bound already stays rejected; the report says why the other is open.
        done = self.succeed("run", case, "-o", "broken", *settings(run__end_time="7.4 ms"), "--set", f'limits."{PEAK}".max="10 N"')
        self.assertIs(self.entry(PEAK, "broken")["accepted"], False)
        self.succeed("report", "broken")
        rows = {row["key"]: row for row in page_data((self.folder / "broken/report.html").read_text())["acceptance"]["rows"]}
        self.assertEqual((rows[PEAK.replace("TB1", "TB2")]["state"], rows[PEAK.replace("TB1", "TB2")]["why"]), ("unknown", why))
        self.succeed("run", case, "-o", "whole", *settings(run__end_time="10 ms"))
        self.assertIs(self.entry(PEAK, "whole")["accepted"], self.summary("whole")["bearings"]["TB1"]["peak_contact_force"] <= 4e3)
        self.assertIs(self.summary("whole")["bearings"]["TB1"]["damage"]["assessed"], True)

    def test_limits_of_a_bearing_that_is_not_touched_are_not_met(self):
        # Tilted by 0.5 mrad the rotor reaches TB1 after half the way, TB2 after 1.4 times the way: 9 ms.
        case = self.limited('"bearings.*.peak_contact_force" = { max = "20 kN" }\n"bearings.*.static_safety" = { min = 1e-3 }\n')
        tilted = ("--set", 'rotor.initial_tilt=[0, "0.5 mrad"]', "--set", 'run.end_time="7 ms"')
        done = self.call("run", case, "-o", "out", "--accept", *tilted)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        why = "the rotor did not touch the bearing"
        for result in ("peak_contact_force", "static_safety"):
            self.assertIs(self.entry(f"bearings.TB1.{result}")["accepted"], True)
            self.assertEqual(self.entry(f"bearings.TB2.{result}")["accepted"], None)
        self.assertEqual(self.entry("bearings.TB2.peak_contact_force")["why"], why)
        self.assertIn(f"bearings.TB2.peak_contact_force = 0 N, at most 20 kN; {why}", done.stdout)
        # A study of the same drops says the same.
        self.write("study.toml", f'case = "{case}"\n[vary]\n"rotor.initial_tilt[1]" = {{ values = ["0.5 mrad", "-0.5 mrad"] }}\n[design]\nkind = "list"\n'
                   '[keep]\nresults = ["bearings.*.friction_heat"]\n')
        told = self.succeed("study", "study.toml", "-o", "s", "--set", 'run.end_time="7 ms"').stdout
        limits = {limit["result"]: limit for limit in json.loads((self.folder / "s/study.json").read_text())["limits"]}
        self.assertEqual((limits[PEAK]["n"], limits[PEAK]["undefined"]), (1, 1), "the other one of two drops")
        other = limits["bearings.TB2.peak_contact_force"]
        self.assertEqual((other["n"], other["broken"], other["undefined"], other["undefined_because"]), (1, 0, 1, {why: 1}))
        self.assertIn(f"bearings.TB2.peak_contact_force above 2e+04 N: 0 of 1 drops, 0 %; not assessed in 1 more: {why} (1)", told)
        self.succeed("study", "report", "s")

    def test_any_number_of_drops_is_allowed_where_no_limit_of_them_is_found(self):
        case = self.limited("bearings.TB1.damage.allowed_drops.min = 20\n")
        done = self.succeed("run", case, "-o", "out", "--accept", *settings(contact__wear_coefficient_bore=0, contact__wear_coefficient_rotor=0))
        self.assertIn("allowed drops: no limit found", done.stdout)
        self.assertRegex(done.stdout, r"accepted +-  bearings\.TB1\.damage\.allowed_drops: no limit found, at least 20")
        self.assertIsNone(self.entry("bearings.TB1.damage.allowed_drops")["value"])

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

    def test_a_rise_takes_no_unit_with_another_zero(self):
        rise = "bearings.TB1.local.bore_rise"
        for value, words in (("110 degC", '"90 K" for 110 degC at run.ambient = 20 degC, or "110 K"'), ("90 degF", "is a temperature rise, but")):
            done = self.call("run", self.limited(f'{rise}.max = "{value}"\n'), "-o", "out")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.folder / "out").exists())
        self.succeed("run", self.limited(f'{rise}.max = "110 K"\n'), "-o", "out")
        self.assertEqual(self.entry(rise)["limit"], 110)

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

    def test_a_bound_on_the_side_where_results_are_good_warns(self):
        for key, given, usual in (("bearings.*.static_safety", "max", "min"), ("bearings.TB1.damage.allowed_drops", "max", "min"), ("bearings.TB2.wear.drops_until_limit", "max", "min"), ("bearings.TB1.clearance.smallest", "max", "min"),
                                  (PEAK, "min", "max"), ("bearings.*.local.bore_rise", "min", "max"), ("bearings.TB1.temperature_rise_end.inner_ring", "min", "max"), ("run.warnings", "min", "max")):
            with self.subTest(key):
                case = self.limited(f'"{key}" = {{ {given} = 1.5 }}\n')
                for done in (self.succeed("check", case), self.succeed("run", case, "-o", "out", "--force", *settings(run__end_time="1 us"))):
                    said = " ".join(done.stderr.split())
                    self.assertRegex(said, rf"warning: drop\.toml:4:\d+: limits\.{re.escape(key)} has a {given} only: drops with {'larger' if given == 'max' else 'smaller'} values, the better ones, are rejected\. A limit on it is most often a {usual}: {usual} = \"1\.5\"")
                # The other bound alone, or a band, is meant.
                for bounds in (f"{usual} = 1.5", "min = 1, max = 1.5"):
                    self.assertNotIn("the better ones", self.succeed("check", self.limited(f'"{key}" = {{ {bounds} }}\n')).stderr, bounds)
        for key in ("bearings.TB1.damage.required_static_safety", "bearings.TB1.catch_up_time"):
            self.assertNotIn("the better ones", self.succeed("check", self.limited(f'"{key}" = {{ max = 1.5 }}\n')).stderr, key)
        self.case("")
        self.write("s.toml", f'case = "drop.toml"\n[vary]\ncontact.friction_coefficient = [0.1, 0.2]\n[design]\nkind = "grid"\n[limits]\n"{PEAK}" = {{ min = "5 kN" }}\n')
        self.assertRegex(self.succeed("study", "s.toml", "--dry-run").stderr, rf"warning: s\.toml:7:1: limits\.{re.escape(PEAK)} has a min only")

    def test_a_name_with_a_star_needs_quotes_in_a_setting(self):
        done = self.call("check", "reference.toml", "--set", "limits.bearings.*.static_safety.min=2")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('A name with * stands in quotes: limits."bearings.*.static_safety".min.', done.stderr)
        self.succeed("check", "reference.toml", "--set", 'limits."bearings.*.static_safety".min=2')

    def test_a_star_stands_for_every_bearing_and_the_resolved_case_keeps_limits(self):
        self.succeed("run", self.limited('"bearings.*.peak_contact_force" = { max = "50 kN" }\n'), "-o", "out")
        self.assertEqual([limit["key"] for limit in self.summary()["limits"]], ["bearings.TB1.peak_contact_force", "bearings.TB2.peak_contact_force"])
        self.succeed("run", "out/parameters.toml", "-o", "again")
        self.assertEqual(self.summary("again")["limits"], self.summary()["limits"])

    def allowed(self, *arguments):
        """Limits of a short run: (key, kind, limit)."""
        self.succeed("run", *arguments, "-o", "out", "--force", *settings(run__end_time="1 ms"))
        return [(limit["key"], limit["kind"], limit["limit"]) for limit in self.summary().get("limits", [])]

    def test_an_upper_layer_replaces_a_limit_in_any_spelling(self):
        other = PEAK.replace("TB1", "TB2")
        star = PEAK.replace("TB1", "*")
        dotted, quoted, of_any = f'{PEAK}.max = "{{}} kN"\n', f'"{PEAK}" = {{{{ max = "{{}} kN" }}}}\n', f'"{star}" = {{{{ max = "{{}} kN" }}}}\n'
        table = f'[limits.{PEAK}]\nmax = "{{}} kN"\n'
        for below in (dotted, quoted, table, of_any):
            self.limited(below.format(4) + ("" if below == table else 'rotor.mass.min = 1\n'), "base.toml")
            for above in (dotted, quoted, table, of_any):
                with self.subTest(below=below, above=above):
                    self.write("top.toml", 'base = "base.toml"\n[limits]\n' + above.format(20))
                    found = [(key, limit) for key, kind, limit in self.allowed("top.toml") if kind == "max"]
                    expected = {PEAK: 20e3}
                    if of_any in (below, above):
                        expected[other] = 20e3 if above == of_any else 4e3
                    self.assertEqual(sorted(found), sorted(expected.items()))
            # A setting is the topmost layer.
            for key in (PEAK, star):
                found = [limit for name, kind, limit in self.allowed("base.toml", "--set", f'limits."{key}".max="30 kN"') if name == PEAK]
                self.assertEqual(found, [30e3], (below, key))
        # Three layers: each goes before those below; the other bound of a result stays.
        self.limited(f'{PEAK} = {{ max = "1 kN", min = "10 N" }}\n', "a.toml")
        self.write("b.toml", f'base = "a.toml"\n[limits]\n"{PEAK}" = {{ max = "2 kN" }}\n')
        self.write("c.toml", f'base = "b.toml"\n[limits]\n{PEAK}.max = "3 kN"\n')
        self.assertEqual(self.allowed("c.toml"), [(PEAK, "max", 3e3), (PEAK, "min", 10)])
        self.write("d.toml", f'base = "c.toml"\n[limits]\n"{star}" = {{ max = "5 kN" }}\n')
        self.assertEqual(sorted(self.allowed("d.toml")), [(PEAK, "max", 5e3), (PEAK, "min", 10), (other, "max", 5e3)])
        self.succeed("run", "out/parameters.toml", "-o", "again")
        self.assertEqual(self.summary("again")["limits"], self.summary()["limits"])

    def test_a_result_named_itself_goes_before_a_star_of_the_same_layer(self):
        star = PEAK.replace("TB1", "*")
        case = self.limited(f'"{star}" = {{ max = "4 kN", min = "1 N" }}\n{PEAK}.max = "20 kN"\n')
        self.assertEqual(sorted(self.allowed(case)), [(PEAK, "max", 20e3), (PEAK, "min", 1), (PEAK.replace("TB1", "TB2"), "max", 4e3), (PEAK.replace("TB1", "TB2"), "min", 1)])

    def test_bounds_that_nothing_can_meet_and_bounds_given_twice_are_refused(self):
        for text, says in ((f'{PEAK} = {{ max = "5 kN", min = "6 kN" }}\n', r"drop\.toml:4:\d+: limits\.bearings\.TB1\.peak_contact_force: min = 6 kN is larger than max = 5 kN, so no drop meets both"),
                           (f'{PEAK}.max = "5 kN"\n"{PEAK}" = {{ max = "6 kN" }}\n', r"drop\.toml:5:\d+: limits\.bearings\.TB1\.peak_contact_force\.max is given twice\.\s+The other one is at drop\.toml:4")):
            with self.subTest(says):
                done = self.call("check", self.limited(text))
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertRegex(done.stderr, says)
        self.limited("")
        self.write("study.toml", f'case = "drop.toml"\n[vary]\n"contact.friction_coefficient" = [0.05]\n[design]\nkind = "grid"\n[limits]\n"{PEAK}" = {{ max = "5 kN", min = "6 kN" }}\n')
        done = self.call("study", "study.toml", "-o", "s")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no drop meets both", done.stderr)

    def test_a_study_replaces_only_the_bound_that_it_gives(self):
        self.limited(f'{PEAK} = {{ max = "1 kN" }}\n')
        self.write("study.toml", f'case = "drop.toml"\n[vary]\n"contact.friction_coefficient" = [0.05]\n[design]\nkind = "grid"\n[limits]\n"{PEAK}" = {{ min = "1 N" }}\n')
        self.succeed("study", "study.toml", "-o", "s")
        limits = [(limit.get("max"), limit.get("min")) for limit in json.loads((self.folder / "s/study.json").read_text())["limits"]]
        self.assertEqual(sorted(limits, key=str), sorted([(None, 1.0), (1e3, None)], key=str))

    def test_a_study_takes_the_limits_of_its_case(self):
        self.limited(f'{PEAK}.max = "1 kN"\n{HEAT}.max = "1 kJ"\n')
        self.write("study.toml", f'case = "drop.toml"\n[vary]\n"contact.friction_coefficient" = [0.05, 0.1]\n[design]\nkind = "grid"\n[limits]\n"{PEAK}" = {{ max = "50 kN" }}\n')
        self.succeed("study", "study.toml", "-o", "s")
        limits = {limit["result"]: limit for limit in json.loads((self.folder / "s/study.json").read_text())["limits"]}
        self.assertEqual((limits[PEAK]["max"], limits[PEAK]["broken"]), (50e3, 0), "the study's own")
        self.assertEqual((limits[HEAT]["max"], limits[HEAT]["broken"], limits[HEAT]["n"]), (1e3, 0, 2), "the case's")


if __name__ == "__main__":
    unittest.main()

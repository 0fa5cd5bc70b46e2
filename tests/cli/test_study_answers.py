"""What a study answers: the same from shards, nothing where nothing is known, intervals of independent drops only; names that it gives."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HAS_SURROGATES, ProgramTest, content_of, settings  # noqa: E402

VARY = """
case = "drop.toml"
[vary]
contact.friction_coefficient = { range = [0.1, 0.3] }
contact.air_gap = { range = ["200 um", "300 um"] }
"""
FORCE = '"bearings.TB1.peak_contact_force"'


class StudyAnswers(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case("")

    def study(self, text, output="out", *arguments):
        self.write("s.toml", text)
        done = self.succeed("study", "s.toml", "-o", output, *arguments)
        return done.stdout, self.answers(output)

    def answers(self, output):
        return json.loads((self.folder / output / "study.json").read_text())

    def refused(self, text, *words):
        self.write("s.toml", text)
        before = content_of(self.folder)
        done = self.call("study", "s.toml", "-o", "out")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(content_of(self.folder), before)

    def test_joined_shards_answer_as_the_whole_study(self):
        text = VARY + f'[design]\nsize = 20\n[limits]\n"bearings.*.peak_contact_force" = {{ max = "5.05 kN" }}\n'
        _, whole = self.study(text, "whole")
        for i in (1, 2):
            self.succeed("study", "s.toml", "-o", f"shard-{i}", "--shard", f"{i}/2")
        for kind in ([], ["--virtual"]):
            self.succeed("study", "join", "shard-1", "shard-2", "-o", "joined", "--force", *kind)
            joined = self.answers("joined")
            self.assertEqual(joined["limits"], whole["limits"])
        self.assertEqual([limit["max"] for limit in whole["limits"]], [5050.0, 5050.0])
        self.assertGreater(whole["limits"][0]["broken"], 0)

    def test_a_virtual_join_is_not_resumed(self):
        text = VARY + '[design]\nsize = 4\n[keep]\nseries = ["/bearings/TB1/orbit"]\n'
        for i in (1, 2):
            self.write("s.toml", text)
            self.succeed("study", "s.toml", "-o", f"shard-{i}", "--shard", f"{i}/2")
        for kind, code in ((["--virtual"], 2), ([], 0)):
            self.succeed("study", "join", "shard-1", "shard-2", "-o", "joined", "--force", *kind)
            before = content_of(self.folder / "joined")
            done = self.call("study", "s.toml", "-o", "joined", "--resume")
            self.assertEqual(done.returncode, code, done.stderr)
            if code:
                self.assertIn("joined with --virtual", done.stderr)
                self.assertEqual(content_of(self.folder / "joined"), before)

    def test_a_search_is_not_joined(self):
        self.study(VARY + f"[minimise]\nresult = {FORCE}\nevaluations = 2\n")
        table = (self.folder / "out/study.csv").read_text().splitlines()
        self.assertTrue(table[0].startswith("point,design_row,replicate,status,reason,search,evaluation,"))
        self.assertRegex(table[1], "^0,0,0,0,,0,0,")
        self.assertRegex(table[2], "^1,1,0,0,,0,1,")
        done = self.call("study", "join", "out", "-o", "joined")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nothing to join", done.stderr)
        self.assertFalse((self.folder / "joined").exists())

    def test_what_too_few_drops_tell_nothing_of_is_not_told(self):
        # Until 7 ms rotors reach the bearing over gaps of 200 to 240 um only: one block of Saltelli's is whole.
        first = VARY + '[limits]\n"bearings.TB1.first_contact_time" = { min = "6 ms" }\n'
        early = settings(run__end_time='"7 ms"')
        told, saltelli = self.study(first + '[design]\nkind = "saltelli"\nsize = 6\n', "saltelli", *early)
        self.assertEqual(saltelli["blocks_left_out"]["bearings.TB1.first_contact_time"], 5)
        self.assertFalse("bearings.TB1.first_contact_time" in saltelli["indices"])
        self.assertIn("0 of 5 drops", told)
        told, morris = self.study(first + '[design]\nkind = "morris"\nsize = 20\n', "morris", *early)
        gap = morris["morris"]["bearings.TB1.first_contact_time"]["contact.air_gap"]
        self.assertEqual((gap["n"], gap["mean"], gap["mean_magnitude"]["value"], gap["deviation"]), (0, None, None, None))
        self.assertIn("nothing known of contact.air_gap", told)
        self.succeed("study", "report", "morris")

    def test_intervals_count_no_replicates_and_no_grids(self):
        levels = VARY + f'damping = {{ keys = ["bearings.TB1.support.C_y"], values = [2e3, 8e3] }}\n[choose]\nparameter = "damping"\nresult = {FORCE}\nquantile = 0.5\n'
        told, alone = self.study(levels + "[design]\nsize = 24\n", "alone")
        self.assertTrue(all(level["low"] < level["quantile"] < level["high"] for level in alone["choose"]["levels"]))
        self.assertIn("95 % interval", told.partition("What matters")[0])
        for design in ("[design]\nsize = 24\n[replicates]\nn = 3\n", '[design]\nkind = "grid"\nlevels = 3\n'):
            told, found = self.study(levels + design, f"out-{len(design)}")
            self.assertTrue(all(level["low"] is None and level["high"] is None for level in found["choose"]["levels"]))
            self.assertNotIn("95 % interval", told.partition("What matters")[0])

    def test_the_mean_that_a_search_makes_smallest_has_the_interval_of_its_rows(self):
        search = VARY + f'[minimise]\nresult = {FORCE}\nover = ["contact.air_gap"]\nof = "mean"\nevaluations = 1\n[design]\nsize = 6\n'
        widths = []
        for n in (1, 10):
            _, found = self.study(search + f"[replicates]\nn = {n}\n", f"out-{n}")
            start = found["minimise"]["start"]
            widths.append(start["high"] - start["low"])
        # Starts 1 nm apart: peak forces of the first contact differ by 1e-5 of their scatter over friction.
        self.assertAlmostEqual(widths[1] / widths[0], 1.0, delta=1e-2)
        self.assertGreater(widths[0], 1.0)

    def test_resuming_with_another_bound_keeps_that_bound(self):
        text = VARY + f'[design]\nsize = 12\n[limits]\n{FORCE} = {{ max = "5.2 kN" }}\n'
        self.study(text)
        _, found = self.study(text.replace("5.2", "5.05"), "out", "--resume")
        self.assertEqual(found["limits"][0]["max"], 5050.0)
        self.assertIn("5.05 kN", (self.folder / "out/study.toml").read_text())

    def test_names_that_no_column_can_have_are_refused_before_the_first_drop(self):
        size = "[design]\nsize = 2\n"
        keys = 'keys = ["bearings.TB1.support.C_y"], values = [2e3, 8e3]'
        for name in ("status", "a/b", "contact.exponent", ".."):
            self.refused(VARY + f'"{name}" = {{ {keys} }}\n' + size, "s.toml:6:", f"vary.{name}: ", "Choose another name")
        for name in ("point", "a/b", ".", "contact.air_gap"):
            self.refused(VARY + size + f'[derived]\n"{name}" = {{ formula = "2 * bearings.TB1.peak_contact_force" }}\n', "s.toml:9:", f"derived.{name}: ")
        self.refused(VARY + size + '[keep]\nseries = ["/bearings/TB1/orbit", "/bearings/TB1/orbit"]\n', "s.toml:9:", "twice")
        pair = '[[correlation]]\nparameters = ["contact.friction_coefficient", "contact.air_gap"]\nrank = 0.5\n'
        self.refused(VARY + size + pair + pair, "two [[correlation]] are of contact.friction_coefficient and contact.air_gap")
        self.refused(VARY + size + '[derived]\na = { formula = "' + "-" * 50000 + '1" }\n', "more than 10000 characters")

    def test_a_key_that_is_also_a_result_has_a_column_of_each(self):
        self.study('case = "drop.toml"\n[vary]\nrun.ambient = [280, 300]\nrun.end_time = ["15 ms", "20 ms"]\n[design]\nkind = "list"\n', "out", "--set", 'run.until="5 ms"')
        header, *rows = [line.split(",") for line in (self.folder / "out/study.csv").read_text().splitlines()]
        self.assertEqual(len(set(header)), len(header))
        column = {name: [row[i] for row in rows] for i, name in enumerate(header)}
        for name, values, results in (("run.ambient", ["280", "300"], ["280", "300"]), ("run.end_time", ["0.015", "0.02"], ["0.005", "0.005"])):
            self.assertEqual(column[name], values)
            self.assertEqual(column[f"results/{name}"], results)

    def test_a_name_of_ones_own_for_several_keys_is_no_name_of_a_result(self):
        self.refused(VARY + 'energy.dissipated = { keys = ["bearings.TB1.support.C_y"], values = [2e3, 8e3] }\n[design]\nsize = 2\n', "vary.energy.dissipated: every drop has a result of this name")

    def test_drops_that_end_before_the_rotor_touches_anything_meet_no_limit(self):
        # Free fall through 250 um takes 7.1 ms, through 400 um 9.0 ms.
        text = ('case = "drop.toml"\n[vary]\ncontact.air_gap = { values = ["200 um", "250 um", "400 um", "500 um"] }\n'
                '[design]\nkind = "list"\n[keep]\nresults = ["bearings.TB1.friction_heat"]\n'
                f'[limits]\n{FORCE} = {{ max = "1 kN" }}\nbearings.TB1.peak_contact_force_time = {{ max = "1 s" }}\n')
        for lanes in ("true", "false"):
            told, answers = self.study(f"lanes = {lanes}\n" + text, lanes, "--set", 'run.end_time="9 ms"')
            self.assertIn("2 of 4 drops ended before the rotor touched anything", told)
            self.assertEqual(answers["without_contact"], 2)
            self.assertEqual([(one["n"], one["undefined"], one["broken"]) for one in answers["limits"]], [(2, 2, 2), (2, 2, 0)])
            self.succeed("study", "report", lanes)
            self.assertIn("2 of 4 drops ended before", (self.folder / lanes / "report.html").read_text())
        told, answers = self.study(text, "longer", "--set", 'run.end_time="20 ms"')
        self.assertNotIn("touched anything", told)
        self.assertEqual((answers["without_contact"], answers["limits"][0]["n"]), (0, 4))

    def test_a_level_with_drops_without_the_result_is_not_called_smallest(self):
        # Nothing touches within 8 ms behind 400 um; at 20 ms every gap is crossed.
        text = ('case = "drop.toml"\n[vary]\ncontact.air_gap = { values = ["200 um", "400 um"] }\n[design]\nkind = "grid"\n'
                '[choose]\nparameter = "contact.air_gap"\nresult = "bearings.TB1.first_contact_time"\nquantile = 0.5\n')
        told, answers = self.study(text, "out", "--set", 'run.end_time="8 ms"')
        near, far = answers["choose"]["levels"]
        self.assertEqual((near["n"], near["without_result"], far["n"], far["without_result"]), (1, 0, 0, 1))
        self.assertEqual(answers["choose"]["best"]["value"], near["value"])
        self.assertRegex(told, r"0\.0004 m: +none, 1 without this result")
        self.assertRegex(told, r"1 drops +<- smallest")
        far_only = text.replace('"200 um", "400 um"', '"400 um", "500 um"')
        told, answers = self.study(far_only, "none", "--set", 'run.end_time="8 ms"')
        self.assertIsNone(answers["choose"]["best"])
        self.assertIn("No level is called smallest", told)
        self.succeed("study", "report", "none")

    def test_failed_drops_are_told_beside_every_answer(self):
        self.case('[integration]\nmethod = "runge-kutta-4"\n')  # steps of 1 ms are far beyond its stability
        text = ('case = "drop.toml"\n[vary]\nintegration.step = ["5 us", "1 ms", "4 us"]\n[design]\nkind = "list"\n'
                f'[limits]\n{FORCE} = {{ max = "20 kN" }}\n[choose]\nparameter = "integration.step"\nresult = {FORCE}\nquantile = 0.5\n')
        told, answers = self.study(text, "out", "--set", 'run.end_time="20 ms"')
        self.assertIn("1 of 3 drops failed: quantiles, means, probabilities and indices are those of the other 2", told)
        self.assertIn("0 of 2 drops, 0 %; not assessed in 1 more: the drop failed (1)", told)
        self.assertRegex(told, r"0\.001 s: +none, 1 without this result \(1 failed\)")
        limit = answers["limits"][0]
        self.assertEqual((limit["n"], limit["undefined"], limit["undefined_because"]), (2, 1, {"the drop failed": 1}))
        self.assertEqual(answers["results"]["bearings.TB1.peak_contact_force"]["failed"], 1)
        self.succeed("study", "report", "out")
        self.assertIn("1 of 3 drops failed", (self.folder / "out/report.html").read_text())

    def test_a_level_that_is_never_drawn_is_listed(self):
        text = ('case = "drop.toml"\n[vary]\ncontact.air_gap = { values = ["200 um", "250 um", "300 um"], weights = [1, 1e-9, 1] }\n[design]\nsize = 4\n'
                '[choose]\nparameter = "contact.air_gap"\nresult = "bearings.TB1.first_contact_time"\nquantile = 0.5\n')
        told, answers = self.study(text)
        levels = answers["choose"]["levels"]
        self.assertEqual([(one["value"], one["n"], one.get("not_drawn", False)) for one in levels], [(2e-4, 2, False), (2.5e-4, 0, True), (3e-4, 2, False)])
        self.assertIs(answers["choose"]["all_drawn"], False)
        self.assertRegex(told, r"0\.00025 m: +none, 0 drops: not drawn")
        self.assertRegex(told, r"0\.0002 m: .*<- smallest of those drawn")
        self.succeed("study", "report", "out")

    def test_units_of_formulas_are_those_of_their_values(self):
        def derived(formula, unit, name="f"):
            return VARY + f'[design]\nsize = 4\n[derived]\n{name} = {{ formula = "{formula}", unit = "{unit}" }}\n'

        force = "bearings.TB1.peak_contact_force"
        for formula, unit, *words in ((f"1e-3 * {force}", "kN", "is not a unit of SI without a factor", 'write unit = "N"'), ("1e6 * bearings.TB1.friction_heat", "furlongs per", "not a unit that is known"),
                                      ("bearings.TB1.local.bore_rise", "degC", "counts from another zero", 'unit = "K"'), (f"max({force}, bearings.TB2.peak_contact_force)", "m", "but the formula gives N"),
                                      (f"{force} / bearings.TB2.peak_contact_force", "N", "a number without a unit"), (force, "rpm", "is not a unit of SI")):
            self.refused(derived(formula, unit), "derived.f", *words)
        self.refused(derived(force, "N", '"bearings.TB2.peak_contact_force"'), "every drop has a result of this name")
        for formula, unit in ((f"max({force}, bearings.TB2.peak_contact_force)", "N"), (f"{force} / 2", "newton"), (f"max({force}, 5000)", "J/m"), (f"{force} * bearings.TB1.first_contact_time", "N s"), (f"1e-3 * {force}", "1")):
            self.write("s.toml", derived(formula, unit))
            self.succeed("study", "s.toml", "--dry-run")

    def test_words_of_another_form_are_refused(self):
        for words, *told in (("range = [0.1, 0.3], mean = 0.2", "mean means nothing beside a range", "range, scale, levels, reference, keys"), ("range = [0.1, 0.3], weights = [1]", "weights means nothing beside a range"),
                             ('values = [0.1, 0.3], scale = "log"', "scale means nothing beside a list of values", "values, weights"), ('distribution = "normal", mean = 0.2, deviation = 0.01, mode = 0.2', 'mode means nothing beside a distribution "normal"', "mean, deviation"),
                             ('distribution = "uniform", lower = 0.1, upper = 0.2, mean = 0.1', "mean means nothing beside")):
            self.refused(f'case = "drop.toml"\n[vary]\ncontact.friction_coefficient = {{ {words} }}\n[design]\nsize = 4\n', *told)

    def test_settings_of_what_the_study_varies_are_refused(self):
        self.write("s.toml", VARY + "[design]\nsize = 2\n")
        for setting in ('contact.air_gap="100 um"', 'contact={air_gap="100 um"}', 'contact={exponent=1.1, air_gap="100 um"}', '"contact"."air_gap"="100 um"'):
            done = self.call("study", "s.toml", "--dry-run", "--set", setting)
            self.assertEqual(done.returncode, 2, setting)
            self.assertIn("the study varies contact.air_gap, so that this would be without effect", done.stderr)
        self.succeed("study", "s.toml", "--dry-run", "--set", "contact={exponent=1.1}")

    def test_advice_on_one_result_names_results(self):
        text = VARY + "[design]\nsize = 4\n"
        self.refused(text + '[surrogate]\nresults = "bearings.TB1.peak_contact_force"\n', "must be a list of texts", '["bearings.TB1.peak_contact_force"]')
        star = '"bearings.*.peak_contact_force"'
        surrogate = [f"[surrogate]\nresults = [{star}]\n"] if HAS_SURROGATES else []
        for table in (f"[choose]\nparameter = \"contact.air_gap\"\nresult = {star}\n", *surrogate):
            both = text.replace('range = ["200 um", "300 um"]', 'values = ["200 um", "300 um"]') if "choose" in table else text
            self.refused(both + table, "name one result", "It would be bearings.TB1.peak_contact_force,", "bearings.TB2.peak_contact_force; a formula")
        self.write("m.toml", VARY + f"[minimise]\nresult = {star}\n")
        self.assertIn("name one result", self.call("study", "m.toml", "-o", "m").stderr)

    def test_resuming_makes_the_page_again_and_replacing_removes_points_that_were_rerun(self):
        text = VARY + "[design]\nsize = 4\n[limits]\n" + FORCE + ' = { max = "5.0 kN" }\n'
        self.study(text)
        self.succeed("study", "report", "out")
        page = self.folder / "out/report.html"
        before = page.read_text()
        for name in ("study.h5", "study.csv", "study.json"):
            (self.folder / "out" / name).unlink()
        journal = self.folder / "out/study.journal"
        lines = journal.read_text().splitlines(keepends=True)
        journal.write_text("".join(lines[:-1]))
        told, _ = self.study(text.replace("5.0 kN", "5.5 kN"), "out", "--resume")
        self.assertIn("report.html is made again", told)
        self.assertNotEqual(page.read_text(), before)
        self.succeed("study", "rerun", "out", "--point", "1", "--quiet")
        self.succeed("study", "rerun", "out", "--point", "2", "--quiet")
        self.write("out/point-2/mine.txt", "mine")
        (self.folder / "out/point-7").mkdir()
        self.study(text.replace("300 um", "280 um"), "out", "--force")
        self.assertFalse((self.folder / "out/point-1").exists())
        self.assertEqual([path.name for path in (self.folder / "out/point-2").iterdir()], ["mine.txt"])
        self.assertTrue((self.folder / "out/point-7").is_dir(), "not one of the program's")
        self.assertFalse(page.exists())

    def test_the_number_of_a_point_is_asked_for_in_few_words(self):
        self.study(VARY + "[design]\nsize = 2\n")
        for point in ("-1", "1.5"):
            done = self.call("study", "rerun", "out", f"--point={point}")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertLess(len(done.stderr), 300)
            self.assertIn(point, done.stderr)

    def test_a_fit_says_on_what_nothing_depends(self):
        # Before the first touch at 7.4 ms no orbit depends on the friction at the bore.
        table = "".join(f"{t},{y}\n" for t, y in ((1, -5), (2, -20), (3, -44), (4, -78), (5, -123)))
        self.write("m.csv", table)
        told, answers = self.study('case = "drop.toml"\n[vary]\ncontact.friction_coefficient = { range = [0.05, 0.4] }\n[fit]\nevaluations = 5\n[[fit.measured]]\nfile = "m.csv"\n'
                                   'series = "/bearings/TB1/orbit"\ntime_unit = "ms"\nunit = "um"\n')
        fitted = answers["fit"]["parameters"]["contact.friction_coefficient"]
        self.assertIs(fitted["no_effect"], True)
        self.assertIsNone(fitted["low"])
        self.assertRegex(told, r"contact\.friction_coefficient = .*no measured value depends on it")
        self.succeed("study", "report", "out")

    def test_points_that_no_shard_has_run_are_not_drops_without_the_result(self):
        self.write("s.toml", 'case = "drop.toml"\n[vary]\ncontact.air_gap = { values = ["200 um", "250 um"] }\n[design]\nkind = "grid"\n'
                             '[choose]\nparameter = "contact.air_gap"\nresult = "bearings.TB1.first_contact_time"\nquantile = 0.5\n')
        self.succeed("study", "s.toml", "-o", "shard-1", "--shard", "1/2", "--quiet", "--set", 'run.end_time="20 ms"')
        joined = self.call("study", "join", "shard-1", "-o", "part")
        self.assertEqual(joined.returncode, 1)
        levels = json.loads((self.folder / "part/study.json").read_text())["choose"]["levels"]
        self.assertEqual(sorted((one["n"], one["without_result"], one["not_run"]) for one in levels), [(0, 0, 1), (1, 0, 0)])
        self.assertIn("none, 1 not run", joined.stdout)
        self.assertNotIn("without this result", joined.stdout)

    def test_a_formula_feeds_a_key_of_whole_numbers(self):
        self.write("s.toml", VARY + 'bearings.TB1.balls_per_row = { formula = "14 + 0 * contact.air_gap" }\n[design]\nsize = 2\n')
        self.succeed("study", "s.toml", "--dry-run")
        self.write("s.toml", VARY + 'bearings.TB1.balls_per_row = { formula = "14.5 + 0 * contact.air_gap" }\n[design]\nsize = 2\n')
        self.assertIn("must be an integer", self.call("study", "s.toml", "--dry-run").stderr)

    def test_the_reference_of_keys_that_differ_in_the_case_is_asked_for(self):
        self.case('bearings.TB1.air_gap = "250 um"\nbearings.TB2.air_gap = "300 um"\n')
        gaps = 'case = "drop.toml"\n[vary]\ngap = { keys = ["bearings.TB1.air_gap", "bearings.TB2.air_gap"], values = ["200 um", "220 um"]REFERENCE }\n[design]\nkind = "one-at-a-time"\n'
        self.refused(gaps.replace("REFERENCE", ""), "s.toml:3:", "reference = VALUE", "bearings.TB2.air_gap")
        _, found = self.study(gaps.replace("REFERENCE", ', reference = "210 um"'))
        self.assertEqual(found["done"], 3)

    def test_resuming_leaves_the_users_files(self):
        self.study(VARY + "[design]\nsize = 4\n")
        notes = pathlib.Path(self.folder / "out/rank-list.journal")
        notes.write_text("notes\n")
        self.succeed("study", "s.toml", "-o", "out", "--resume")
        self.assertEqual(notes.read_text(), "notes\n")


if __name__ == "__main__":
    unittest.main()

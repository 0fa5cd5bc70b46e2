"""The pieces of validation/run: verdicts on synthetic numbers, keys, statements, formulas, tables. tests/cli/test_validation.py runs it."""

import math
import pathlib
import sys
import tempfile
import tomllib
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "validation"))
from chapters import cases, documents, errata, figures, formulas, measures, page, runs, statements, verdicts, verification  # noqa: E402

PROGRAM = ROOT / "no program needed"
PLAN = cases.Plan(ROOT / "validation/cases.toml")
STATEMENTS = statements.read(ROOT / "validation/paper-figures.toml")
R, T, N, C = verdicts.VERDICTS


class VerdictOnANumber(unittest.TestCase):
    def verdict(self, reference, runs=(), width=0.1, fitted=(), paper=100.0):
        return verdicts.of_value(paper, reference, list(runs), width, fitted).verdict

    def test_in_the_band_whatever_the_unknowns_is_reproduced(self):
        self.assertEqual(self.verdict(105, [("a", 95), ("b", 140)]), R)

    def test_the_bands_edge_belongs_to_it(self):
        self.assertEqual(self.verdict(110.0), R)
        self.assertEqual(self.verdict(90.0), R)
        self.assertNotEqual(self.verdict(110.001), R)
        self.assertNotEqual(self.verdict(89.999), R)

    def test_a_band_below_zero_has_its_edges_too(self):
        self.assertEqual(self.verdict(-110.0, paper=-100.0), R)
        self.assertEqual(self.verdict(-120.0, paper=-100.0), T)
        self.assertEqual(self.verdict(100.0, paper=-100.0), C)

    def test_an_unknown_that_moves_it_out_of_the_factor_makes_it_undecidable(self):
        self.assertEqual(self.verdict(100, [("a", 149.9)]), R)
        self.assertEqual(self.verdict(100, [("a", 150.1)]), N)
        self.assertEqual(self.verdict(100, [("a", 66.0)]), N)

    def test_a_spread_that_reaches_the_band_is_undecidable_and_says_by_what(self):
        verdict = verdicts.of_value(100, 130, [("inertia", 108), ("damping", 135)], 0.1)
        self.assertEqual(verdict.verdict, N)
        self.assertIn("inertia", verdict.reason)
        self.assertNotIn("damping", verdict.reason)

    def test_a_band_between_two_runs_is_undecidable(self):
        self.assertEqual(self.verdict(130, [("a", 60)]), N)

    def test_right_magnitude_without_reaching_the_band_is_a_trend(self):
        self.assertEqual(self.verdict(140, [("a", 120), ("b", 145)]), T)

    def test_the_factors_edge_is_a_trend(self):
        self.assertEqual(self.verdict(150.0), T)
        self.assertEqual(self.verdict(150.001), C)

    def test_nothing_near_is_contradicted(self):
        self.assertEqual(self.verdict(20, [("a", 10), ("b", 60)]), C)

    def test_a_run_that_comes_near_keeps_it_from_being_contradicted(self):
        verdict = verdicts.of_value(100, 160, [("inertia", 149), ("damping", 170)], 0.1)
        self.assertEqual(verdict.verdict, N)
        self.assertIn("inertia", verdict.reason)
        self.assertNotIn("damping", verdict.reason)
        self.assertEqual(self.verdict(160, [("inertia", 151)]), C)

    def test_what_was_fitted_to_the_number_is_undecidable(self):
        runs = [("share", 130), ("other", 100)]
        self.assertEqual(self.verdict(100, runs), R)
        self.assertEqual(self.verdict(100, runs, fitted=("share",)), N)
        self.assertEqual(self.verdict(100, [("share", 105)], fitted=("share",)), R)  # met whatever the fitted one is

    def test_a_wide_band_counts_as_near(self):
        self.assertEqual(self.verdict(30, [("a", 170)], width=0.8), R)

    def test_a_band_that_reaches_zero_decides_nothing(self):
        self.assertEqual(self.verdict(100, width=1.0), N)
        self.assertEqual(self.verdict(1e4, width=1.0), N)
        self.assertEqual(self.verdict(100, width=0.99), R)


class VerdictOnAClaim(unittest.TestCase):
    def verdict(self, reference, holds, of, fitted=()):
        return verdicts.of_claim(reference, [("a", i < holds) for i in range(of)], fitted).verdict

    def test_every_verdict_is_reached(self):
        self.assertEqual(self.verdict(True, 9, 9), R)
        self.assertEqual(self.verdict(True, 8, 9), T)
        self.assertEqual(self.verdict(True, 5, 9), N)
        self.assertEqual(self.verdict(False, 5, 9), N)
        self.assertEqual(self.verdict(False, 0, 9), C)

    def test_two_thirds_are_enough(self):
        self.assertEqual(self.verdict(True, 6, 9), T)
        self.assertEqual(self.verdict(True, 599, 900), N)

    def test_one_run_that_meets_it_is_enough_not_to_be_contradicted_and_is_named(self):
        verdict = verdicts.of_claim(False, [("damping", False), ("inertia", True)])
        self.assertEqual(verdict.verdict, N)
        self.assertIn("inertia", verdict.reason)
        self.assertNotIn("damping", verdict.reason)

    def test_without_other_runs_the_reference_decides(self):
        self.assertEqual(self.verdict(True, 0, 0), R)
        self.assertEqual(self.verdict(False, 0, 0), C)

    def test_what_was_fitted_is_undecidable_where_it_matters(self):
        self.assertEqual(self.verdict(True, 8, 9, fitted=("a",)), N)
        self.assertEqual(self.verdict(True, 9, 9, fitted=("a",)), R)
        self.assertEqual(self.verdict(True, 8, 9, fitted=("b",)), T)

    def test_a_figure_has_counts_in_the_order_of_the_verdicts(self):
        self.assertEqual(list(verdicts.counts([C, R, N, R]).items()), [(R, 2), (N, 1), (C, 1)])
        self.assertEqual(page.counts({"counts": verdicts.counts([R, R, R, R, R, C])}), "5 reproduced, 1 contradicted")
        self.assertEqual(page.counts({"counts": verdicts.counts([R, R])}), "all 2 reproduced")
        self.assertEqual(page.counts({"counts": verdicts.counts([N])}), "1 not decidable")


class VerdictOnABound(unittest.TestCase):
    def test_what_is_below_does_not_exceed_however_near(self):
        self.assertEqual(verdicts.of_bound(5000, "above", 4999.0, [("a", 4998.0)]).verdict, C)
        self.assertEqual(verdicts.of_bound(5000, "above", 4999.0, [("a", 5001.0)]).verdict, N)
        self.assertEqual(verdicts.of_bound(5000, "above", 5001.0, [("a", 5002.0)]).verdict, R)
        self.assertEqual(verdicts.of_bound(5000, "above", 5000.0, []).verdict, C)
        self.assertEqual(verdicts.of_bound(5000, "below", 4999.0, [("a", 1.0)]).verdict, R)

    def test_what_was_fitted_is_undecidable_where_it_matters(self):
        self.assertEqual(verdicts.of_bound(1.0, "above", 2.0, [("a", 0.5)], fitted=("a",)).verdict, N)

    def test_the_rules_in_words_name_every_verdict(self):
        for words in verdicts.RULES.values():
            for verdict in verdicts.VERDICTS:
                self.assertIn(verdict, words)


class Keys(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "src").mkdir()
        (self.root / "src/a.cpp").write_text("one")
        (self.root / "rotor.json").write_text("{}")
        (self.root / "base.toml").write_text('[rotor]\ngeometry = "rotor.json"\n')
        (self.root / "case.toml").write_text('base = "base.toml"\n')

    def key(self, settings=None, kept=""):
        source = runs.hash_of_files([self.root / "src"], self.root)
        return runs.key_of(source, self.root / "case.toml", settings or {"a.b": 1, "c.d": "2 um"}, kept, self.root)

    def test_the_same_has_the_same_key(self):
        before = self.key({"a": 1, "b": 2})
        self.assertEqual(before, self.key({"b": 2, "a": 1}))

    def test_whatever_changes_a_number_changes_the_key(self):
        seen = {self.key(), self.key({"a.b": 2, "c.d": "2 um"}), self.key(kept="other measures")}
        for file in ("src/a.cpp", "base.toml", "case.toml", "rotor.json"):
            (self.root / file).write_text((self.root / file).read_text() + "\n")
            seen.add(self.key())
        (self.root / "src/a.cpp").rename(self.root / "src/b.cpp")
        seen.add(self.key())
        self.assertEqual(len(seen), 8)

    def test_what_is_done_is_not_done_again_but_what_was_interrupted_is(self):
        cache, calls = runs.Cache(self.root / "runs", PROGRAM, report=lambda line: None), []

        def make(folder):
            calls.append(folder)
            return {"number": 1}

        for _ in range(2):
            self.assertEqual(cache.keep("key", "name", make), (self.root / "runs/key", {"number": 1}))
        self.assertEqual(len(calls), 1)
        (self.root / "runs/key/done.json").unlink()
        (self.root / "runs/key/half").write_text("")
        cache.keep("key", "name", make)
        self.assertEqual(len(calls), 2)
        self.assertFalse((self.root / "runs/key/half").exists())


class Cases(unittest.TestCase):
    def test_the_six_cases_of_table_4_and_three_frictions_are_there(self):
        waves = sorted((c["waves"]["order"], c["waves"]["amplitude"]) for c in PLAN.conditions.values() if "waves" in c)
        self.assertEqual(waves, [(1, "1 um"), (2, "1 um"), (2, "4 um"), (3, "1 um"), (3, "2 um")])
        self.assertEqual({PLAN.cases[f"friction-{n}"].settings["contact.friction_coefficient"] for n in ("005", "015")}, {0.05, 0.15})

    def test_every_unknown_that_the_paper_leaves_open_is_changed(self):
        unknowns = {variant["unknown"] for variant in PLAN.variants.values()}
        self.assertLessEqual({"ends", "clearance", "preload", "ring inertia", "damping", "f2", "heat share", "ball material"}, unknowns)

    def test_a_variant_of_waves_changes_nothing_where_there_are_none(self):
        self.assertEqual(PLAN.of_condition("ideal", "waves-bore-turned"), "ideal")
        self.assertEqual(PLAN.of_condition("order1-1um", "waves-bore-turned"), "order1-1um+waves-bore-turned")
        self.assertIsNone(PLAN.of_condition("order1-1um", "share-half"))

    def test_faults_of_the_file_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "cases.toml"
            file.write_text('base = "x"\n[condition.ideal]\nsays = ""\nsett = {}\n')
            with self.assertRaisesRegex(ValueError, "sett"):
                cases.Plan(file)


class Statements(unittest.TestCase):
    def test_every_figure_of_the_paper_has_a_statement_with_claims_that_have_rules(self):
        self.assertEqual([s.figure for s in STATEMENTS], [*map(str, range(9, 20)), "text"])
        for claim in (c for s in STATEMENTS for c in s.claims):
            self.assertIn(claim.kind, verdicts.RULES)
            self.assertIn(claim.quantity, statements.QUANTITIES)
            self.assertTrue(claim.why)
            self.assertTrue(statements.QUANTITIES[claim.quantity].__doc__)

    def test_every_value_of_a_statement_is_a_claim(self):
        for table in tomllib.loads((ROOT / "validation/paper-figures.toml").read_text())["statement"]:
            numbers = [claim["paper"] for claim in table["claim"] if "paper" in claim]
            for name, value in table.get("value", {}).items():
                rise = value - 293.0  # temperatures are compared as rises over the housing's 293 K
                found = any(math.isclose(n, value) or math.isclose(n, rise, abs_tol=1e-6) for n in numbers) or name == "housing"
                self.assertTrue(found, f"figure {table['figure']}: {name} = {value}")

    def test_every_quantity_is_used(self):
        self.assertEqual(set(statements.QUANTITIES), {claim.quantity for s in STATEMENTS for claim in s.claims})

    def test_what_is_fitted_is_an_unknown_of_the_cases(self):
        unknowns = {variant["unknown"] for variant in PLAN.variants.values()}
        for claim in (c for s in STATEMENTS for c in s.claims):
            self.assertLessEqual(set(claim.fitted), unknowns, claim.id)

    def test_identifiers_are_unique(self):
        ids = [claim.id for s in STATEMENTS for claim in s.claims]
        self.assertEqual(len(ids), len(set(ids)))

    def judged(self, quantity, bearings, bearing="either", **more):
        """Verdict on synthetic measures {run: {bearing: {measure: value}}}."""
        claim = statements.Claim(id="x", says="", quantity=quantity, bearing=bearing, why="", **more)
        return statements.judge(claim, PLAN, {name: {"bearings": entry} for name, entry in bearings.items()})

    def test_spread_is_over_variants_and_the_bearing_that_is_not_named(self):
        def peaks(one, two):
            return {"TB1": {"peak_contact_force": one}, "TB2": {"peak_contact_force": two}}

        runs_ = {"ideal": peaks(5600.0, 4800.0), "ideal+damping-table": peaks(5500.0, 4700.0)}
        result = self.judged("first_peak", runs_, kind="value", paper=5000, width=0.15)
        self.assertEqual((result["ours"], result["lowest"], result["highest"]), (4800, 4700, 5600))
        self.assertEqual(result["by_unknown"], {"damping": [4700, 4800], statements.OTHER_BEARING: [4800, 5600], f"damping, {statements.OTHER_BEARING}": [4800, 5500]})
        self.assertEqual(result["verdict"], R)
        self.assertAlmostEqual(result["relative_difference"], -0.04)

    def test_the_first_peak_is_held_against_a_bound_not_a_band(self):
        claim = next(c for s in STATEMENTS for c in s.claims if c.id == "12.first-peak")
        self.assertEqual((claim.kind, claim.bound, claim.paper), ("bound", "above", 5000))
        runs_ = {"ideal": {"TB1": {"peak_contact_force": 5100.0}, "TB2": {"peak_contact_force": 4395.0}}}
        result = statements.judge(claim, PLAN, {name: {"bearings": entry} for name, entry in runs_.items()})
        self.assertEqual(result["verdict"], N)
        self.assertIn(statements.OTHER_BEARING, result["reason"])

    def test_a_force_of_zero_in_the_resonance_only_is_not_decidable(self):
        claim = next(c for s in STATEMENTS for c in s.claims if c.id == "12.order3-low")
        bearing = {f"contact_force_{span}": {"lowest": 0.0} for span in measures.SPANS} | {"contact_force_swinging_end": {"lowest": 306.0}}
        self.assertEqual(statements.judge(claim, PLAN, {"order3-1um": {"bearings": {"TB2": bearing}}})["verdict"], N)

    def test_what_the_case_was_made_to_have_decides_nothing(self):
        summary = {"rotor": {"mass": 109.7}}
        claim = next(c for s in STATEMENTS for c in s.claims if c.id == "text.mass")
        self.assertTrue(claim.by_construction)
        result = statements.judge(claim, PLAN, {"ideal": {"bearings": {}, "summary": summary}})
        self.assertEqual((result["verdict"], result["ours"]), (N, 109.7))

    def test_figure_17_is_about_watts(self):
        claims = [c for s in STATEMENTS for c in s.claims if c.id.startswith("17.waves")]
        quiet, loud = ({f"rub_rate_{span}": {"highest": v, "mean": v / 10} for span in measures.SPANS} | {"peak_friction_heat_rate": v} for v in (100.0, 101.0))
        for claim in claims:
            for wavy, verdict in ((loud, R), (quiet, C)):
                runs_ = {name: {"bearings": {"TB2": quiet if name == "ideal" else wavy}} for name in ("ideal", *statements.WAVY.values())}
                self.assertEqual(statements.judge(claim, PLAN, runs_)["verdict"], verdict, claim.id)

    def test_the_second_bounce_depends_on_a_fitted_damping(self):
        claim = next(c for s in STATEMENTS for c in s.claims if c.id == "9.apex")
        runs_ = {name: {"bearings": {"TB2": {"bounces": [-1e-4, apex]}}} for name, apex in (("friction-005", -165e-6), ("friction-005+damping-table", -189e-6))}
        self.assertEqual(statements.judge(claim, PLAN, runs_)["verdict"], N)

    def test_numbers_that_the_paper_gives_are_drawn_into_its_figures(self):
        source = (ROOT / "validation/chapters/figures.py").read_text()
        for claim in (c for s in STATEMENTS for c in s.claims if c.paper is not None and s.figure not in ("text",)):
            # Ratios and percentages are no point of a curve.
            if claim.unit not in ("", "%"):
                drawn = f'"{claim.id}"' in source or (claim.id in ("16.inner", "16.outer") and 'f"16.{race}"' in source)
                self.assertTrue(drawn, claim.id)

    def test_a_variant_of_waves_is_no_run_of_a_quantity_without_waves(self):
        result = self.judged("first_peak", {"ideal": {"TB2": {"peak_contact_force": 1.0}}}, bearing="TB2", kind="value", paper=1.0, width=0.1)
        self.assertEqual(result["runs"], [])

    def test_what_the_reference_does_not_have_is_undecidable(self):
        result = self.judged("catch_up_time", {}, kind="value", paper=0.2, width=0.1)
        self.assertEqual(result["verdict"], N)
        self.assertIsNone(result["ours"])


class Measures(unittest.TestCase):
    def test_bounces_are_the_apexes_between_contacts_only(self):
        time = np.arange(0, 1, 1e-3)
        y = np.sin(2 * np.pi * 5 * time)
        penetration = np.where(y > 0, -1.0, 1.0)
        penetration[0] = -1.0
        penetration[950] = -1.0  # chatter of one sample
        # Flights at 0 to 0.1 s (before the first contact, so no bounce), 0.2, 0.4, 0.6, 0.8 s.
        found = measures.bounces(time, y, penetration)
        self.assertEqual(len(found), 4)
        self.assertTrue(all(abs(apex - 1) < 1e-3 for apex in found))

    def test_spans_of_a_mask(self):
        self.assertEqual(measures.spans(np.array([1, 1, 0, 0, 1, 0, 1], bool)), [(0, 1), (4, 4), (6, 6)])
        self.assertEqual(measures.spans(np.zeros(3, bool)), [])


class Formulas(unittest.TestCase):
    """The second set of formulas, which the errata are computed with."""

    @classmethod
    def setUpClass(cls):
        parameters = tomllib.loads((ROOT / "params/neisi2019.toml").read_text())
        cls.bearing = {name: formulas.Bearing(parameters, name) for name in ("TB1", "TB2")}

    def test_two_equal_spheres_touch_as_hertz_says(self):
        # A ball between flat races would have k = 1: F = (4/3) E* sqrt(R) delta^1.5 with E* = E/(2 (1 - nu^2)); here grooves, so K_b is larger, but below ten times.
        ball = self.bearing["TB2"]
        E = 2e11 / (2 * (1 - 0.3**2))
        sphere_on_plane = 4 / 3 * E * math.sqrt(ball.d / 2)
        two_in_series = sphere_on_plane * 2**-1.5
        self.assertGreater(ball.K_b, two_in_series)
        self.assertLess(ball.K_b, 10 * two_in_series)

    def test_restitution_is_1_minus_lambda_v(self):
        # Hunt & Crossley: to first order in lambda v, whatever stiffness and mass.
        for speed in (0.05, 0.1):
            _, lowest, ratio = formulas.impact(1e9, lambda d, rate: 1.5 * 0.08 * 1e9 * max(d, 0) ** (10 / 9) * rate, 50.0, speed)
            self.assertAlmostEqual(ratio, 1 - 0.08 * speed, delta=2e-4)  # (lambda v)^2 = 6e-5, and 200 ns steps
            self.assertGreaterEqual(lowest, 0)

    def test_growth_of_an_evenly_warm_ring_is_alpha_r_t(self):
        self.assertAlmostEqual(formulas.annulus_growth(1e-5, 0.03, 0.04, 10, 10, 0.04), 1e-5 * 0.04 * 10, delta=1e-18)

    def test_balls_do_not_spin_outside_under_outer_race_control(self):
        pair = self.bearing["TB2"]
        inside, outside, _ = errata.spins(pair, pair.phi, 1500.0, False)
        self.assertAlmostEqual(outside, 0, delta=1e-9)
        self.assertAlmostEqual(inside + outside, 1500 * math.sin(pair.phi), delta=1e-9)

    def test_preload_grows_with_the_inner_ring_and_is_what_is_given_without(self):
        pair = self.bearing["TB2"]
        self.assertAlmostEqual(pair.preload_with(0), 290, delta=1e-6)
        self.assertGreater(pair.preload_with(1e-6), 290)

    def test_radial_growth_alone_changes_the_preload_of_an_evenly_warm_pair(self):
        # 50 K on rings and balls: raceways at 39 and 46 mm, balls of 9.525 mm. By hand: B_r and the balls grow by 11.8e-6 * 50 K of -7 mm and 9.525 mm.
        pair = self.bearing["TB2"]
        strain = 11.8e-6 * 50
        radial = pair.A * math.cos(pair.phi) - 7e-3 * strain
        axial = pair.A * math.sin(pair.phi) + pair.offset_of(290)
        by_hand = 23 * pair.K_b * (math.hypot(radial, axial) - pair.A + 9.525e-3 * strain) ** 1.5 * axial / math.hypot(radial, axial)
        self.assertAlmostEqual(pair.preload_with(-7e-3 * strain, 9.525e-3 / 2 * strain), by_hand, delta=1e-6)
        self.assertGreater(by_hand, 2.5 * 290)

    def test_growth_of_the_balls_radius_counts_twice(self):
        # The ball lies between two races: F = K (delta_0 + 2 eps)^1.5 in the direction that it had.
        pair, eps = self.bearing["TB2"], 0.5e-6
        delta = math.hypot(pair.A * math.cos(pair.phi), pair.A * math.sin(pair.phi) + pair.offset_of(pair.preload)) - pair.A
        self.assertAlmostEqual(pair.preload_with(0, eps) / 290, (1 + 2 * eps / delta) ** 1.5, delta=1e-9)

    def test_stiffness_of_a_row_is_symmetric_with_the_right_sign_only(self):
        self.assertLess(errata.asymmetry(self.bearing["TB2"], 1), 1e-4)  # central differences of 10 nm
        self.assertGreater(errata.asymmetry(self.bearing["TB2"], -1), 0.1)


class Verification(unittest.TestCase):
    def test_a_failed_test_is_seen_and_tables_are_kept(self):
        text = """<testsuite><testcase name="verification/A.Holds" time="0.5" status="run"><system-out>Running main() from gtest_main.cc
Note: Google Test filter = A.Holds
[ RUN      ] A.Holds
   h   error
 0.5   1e-3
[       OK ] A.Holds (0 ms)
</system-out></testcase><testcase name="verification/B.Fails" time="0.1" status="fail"><failure message=""/><system-out></system-out></testcase></testsuite>"""
        held, failed = verification.of_junit(text)
        self.assertEqual((held["name"], held["state"], held["printed"]), ("A.Holds", "passed", "   h   error\n 0.5   1e-3"))
        self.assertEqual((failed["state"], failed["group"]), ("failed", "B"))

    def test_a_program_that_is_not_installed_is_skipped_with_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            cache = runs.Cache(folder, PROGRAM)
            result = verification.other_program(cache, "heat_freefem.py", "Other", "surely-not-installed-program")
        self.assertIn("surely-not-installed-program", result["skipped"])

    def test_tables_between_markers_are_read(self):
        text = "<!-- steps: written by x -->\n| a | b |\n|---|---|\n| 1 | 2 |\n<!-- end of steps -->\n"
        self.assertEqual(verification.tables_between_markers(text), {"steps": [["a", "b"], ["1", "2"]]})

    def test_the_tables_of_convergence_are_found_in_the_document(self):
        self.assertEqual(set(verification.tables_between_markers((ROOT / "docs/theory/convergence.md").read_text())), {"steps", "starts", "modes", "spread"})


class Document(unittest.TestCase):
    TEXT = (ROOT / "docs/theory/validation.md").read_text()

    def rows(self):
        table = self.TEXT.split(documents.BEGIN)[1].split(documents.END)[0]
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]]

    def test_its_table_has_every_statement_and_claim_with_a_verdict(self):
        rows = self.rows()
        expected = [id_ for s in STATEMENTS for id_ in (f"**{s.id}**", *(c.id for c in s.claims))]
        self.assertEqual([row[0] for row in rows], expected)
        for row in rows:
            if not row[0].startswith("**"):
                self.assertIn(row[5], verdicts.VERDICTS)

    def test_a_figure_in_it_has_the_counts_of_its_claims(self):
        own, claims = None, []
        for row in [*self.rows(), ["**end**"]]:
            if row[0].startswith("**"):
                if own:
                    self.assertEqual(own, page.counts({"counts": verdicts.counts(claims)}))
                own, claims = row[-1], []
            else:
                claims.append(row[5])

    def test_the_errata_of_the_model_have_an_effect_each_from_a_run(self):
        text = (ROOT / "docs/theory/model.md").read_text()
        rows = [line.split(" | ") for line in text.split(documents.ERRATA_BEGIN)[1].split(documents.ERRATA_END)[0].splitlines()[2:]]
        without = {known["where"] for known in errata.WITHOUT_EFFECT}
        self.assertGreater(len(rows), len(without) + 12)
        for row in rows:
            where, effect = row[0].strip("| "), row[-1].strip("| ")
            self.assertEqual(bool(effect), where not in without, where)
            if effect:
                self.assertRegex(effect, r"\d", f"{where}: an effect is a number")

    def test_the_update_of_errata_writes_the_numbers_given(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "page.md"
            file.write_text(f"before\n{documents.ERRATA_BEGIN}stale\n{documents.ERRATA_END}\nafter\n")
            found = errata.entry("eq. 1", "|a|", "b", errata.RUN, "", [], f"{errata.shown(189.3)} times, {errata.shown(0.0123)} K, {errata.signed(-0.002)}")
            documents.update_errata(file, {"errata": [found]})
            text = file.read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("\nafter\n"))
        self.assertNotIn("stale", text)
        self.assertIn("| eq. 1 | \\|a\\| | b | 189 times, 0.012 K, -0.2 % |", text)

    def test_the_update_replaces_the_table_only(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "page.md"
            file.write_text(f"before\n{documents.BEGIN}stale\n{documents.END}\nafter\n")
            claim = {"id": "1.a", "says": "it", "rule": "holds", "ours": True, "runs": [{"ours": True}], "verdict": R}
            documents.update(file, {"statements": [{"id": "figure 1", "counts": {R: 1}, "claims": [claim]}]})
            text = file.read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("\nafter\n"))
        self.assertNotIn("stale", text)
        self.assertIn("| 1.a | it | states it | holds | holds in 1 of 1 runs | reproduced |", text)


if __name__ == "__main__":
    unittest.main()

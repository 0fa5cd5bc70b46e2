"""`rotordrop statics`: rest of the reference rotor, bearings by themselves, faulty requests."""

import json
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest  # noqa: E402


class Statics(ProgramTest):
    def rest(self, *options):
        return json.loads(self.succeed("statics", "reference.toml", "--json", *options).stdout)

    def bearing(self, *options):
        return self.rest("--bearing", "TB2", *options)["bearings"]["TB2"]

    def refuse(self, *options):
        result = self.call("statics", "reference.toml", *options)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        return result.stderr

    def test_the_shaft_rests_in_both_bores(self):
        shaft = self.rest()["shaft"]
        carried = [s["force_on_rotor"]["y"] for s in shaft["supports"].values()]
        self.assertAlmostEqual(sum(carried), shaft["weight"], delta=1e-5 * shaft["weight"])
        for support in shaft["supports"].values():
            self.assertLess(support["clearance"], 0)
            self.assertFalse(support["inner_ring"]["floating"])
        self.assertEqual(len(shaft["axis"]["x"]), len(shaft["axis"]["y"]))
        self.assertLess(shaft["search"]["residual"], 1e-8)

    def test_a_bearing_by_itself_carries_its_load(self):
        tb2 = self.bearing("--set", 'statics.force=["300 N", "-1000 N", 0]')
        axial = sum(row["axial_force"] for row in tb2["rows"])
        self.assertAlmostEqual(axial, -300, delta=1e-5)
        self.assertEqual(len(tb2["stiffness"]), 5)
        self.assertEqual(len(tb2["rows"][0]["balls"]), 23)
        worst = max(row["largest_pressure"] for row in tb2["rows"])
        self.assertAlmostEqual(min(row["static_safety"] for row in tb2["rows"]), (4.2e9 / worst) ** 3, places=6)

    def test_a_warm_inner_ring_raises_the_preload_and_a_spring_does_not(self):
        cold = self.bearing()
        warm = self.bearing("--set", "statics.inner_rise=5 K")
        sprung = self.bearing("--set", "statics.inner_rise=5 K", "--set", "statics.preload_by=spring")
        self.assertAlmostEqual(cold["preload"], 290, delta=1e-3)
        self.assertGreater(warm["preload"], 600)
        self.assertAlmostEqual(sprung["preload"], 290, delta=1e-3)
        self.assertAlmostEqual(warm["growth"]["inner_race"], 11.8e-6 * 39e-3 * 5, delta=1e-12)

    def test_uniform_heating_changes_no_preload_unless_growth_is_the_papers(self):
        for arrangement in ("X", "O"):
            for rise, allowed in ((-50, 1e-3), (50, 1e-3), (150, 4e-3)):  # at 150 K similarity itself says 1.003
                warm = [x for part in ("inner", "outer", "ball", "shaft") for x in ("--set", f"statics.{part}_rise={rise} K")]
                found = self.bearing("--set", "thermal.expansion=formula", "--set", f"bearings.TB2.arrangement={arrangement}", *warm)
                self.assertAlmostEqual(found["preload"], 290, delta=290 * allowed, msg=f"N, {arrangement}, {rise} K")
                self.assertAlmostEqual(found["growth"]["inner_width"], 11.8e-6 * 32e-3 * rise, delta=1e-12)
        papers = self.bearing(*(x for part in ("inner", "outer", "ball", "shaft") for x in ("--set", f"statics.{part}_rise=50 K")))
        self.assertAlmostEqual(papers["preload"], 783, delta=1)

    def test_fast_balls_press_on_the_outer_race(self):
        still = self.bearing("--set", "bearings.TB2.ball_model=inertial")
        fast = self.bearing("--set", "bearings.TB2.ball_model=inertial", "--set", "statics.speed=15200 rpm")
        ball = fast["rows"][1]["balls"][0]
        self.assertGreater(ball["inner"]["angle"], still["rows"][1]["balls"][0]["inner"]["angle"])
        self.assertLess(ball["outer"]["angle"], ball["inner"]["angle"])
        self.assertGreater(ball["centrifugal_force"], 50)
        self.assertAlmostEqual(still["preload"], 290, delta=1e-3)

    def test_a_ring_without_load_in_its_clearance_floats(self):
        loose = self.rest("--bearing", "TB1")["bearings"]["TB1"]
        self.assertTrue(loose["floating"])
        self.assertEqual(loose["free_directions"], 5)
        text = self.succeed("statics", "reference.toml", "--bearing", "TB1").stdout
        self.assertIn("floating", text)

    def test_the_table_says_what_carries_what(self):
        text = self.succeed("statics", "reference.toml").stdout
        for word in ("TB1 (node 2)", "TB2 (node 28)", "preload left", "stiffness: axial", "s0", "Residual"):
            self.assertIn(word, text)

    def test_faulty_requests_are_refused(self):
        self.assertRegex(self.refuse("--bearing", "TB3"), r'no touchdown bearing "TB3".*\n.*Did you mean')
        self.assertIn('statics.subject = "bearings"', self.refuse("--set", "statics.force=[1, 2, 3]"))
        self.assertIn("statics.loads.node = 99", self.refuse("--set", "statics.loads=[{ node = 99, force = [1, 2] }]"))
        self.assertIn("preload_by", self.refuse("--set", "statics.preload_stiffness=1e6"))
        self.assertIn('Did you mean "inner_rise"', self.refuse("--set", "statics.iner_rise=5 K"))


if __name__ == "__main__":
    unittest.main()

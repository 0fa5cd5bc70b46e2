"""`rotordrop statics`: rest of the reference rotor, bearings by themselves, faulty requests."""

import json
import math
import sys
import unittest

import h5py
import numpy

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

    def test_a_spring_presses_with_the_preload_where_it_was_mounted(self):
        clamped = self.bearing("--set", "statics.inner_rise=5 K")
        for stiffness in ("0", "1e6", "1e9"):
            spring = ["--set", "statics.preload_by=spring", "--set", f"statics.preload_stiffness={stiffness} N/m"]
            cold = self.bearing(*spring)
            self.assertAlmostEqual(cold["preload"], 290, delta=1e-6 * 290, msg=stiffness)  # the search leaves 1e-9 of it
            self.assertAlmostEqual(cold["displacement"]["x"], 0, delta=1e-10)
        # A spring of 1e14 N/m is a clamp: rows of 1e8 N/m move it by 1e-6 of what they yield themselves.
        stiff = self.bearing("--set", "statics.inner_rise=5 K", "--set", "statics.preload_by=spring", "--set", "statics.preload_stiffness=1e14 N/m")
        self.assertAlmostEqual(stiff["preload"], clamped["preload"], delta=1e-5 * clamped["preload"])

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

    def test_the_split_of_the_gyroscopic_moment_changes_the_preload_at_speed(self):
        # validation/ball_balance.py, which shares nothing with the program: 1513.8921 and 1292.9842 N.
        exact = ("--set", "bearings.TB2.ball_model=inertial", "--set", "statics.speed=15200 rpm", "--set", "bearings.TB2.elliptic_integrals=exact")
        self.assertAlmostEqual(self.bearing(*exact)["preload"], 1513.8921, delta=1e-3)
        equal = self.bearing(*exact, "--set", "bearings.TB2.gyroscopic_split=equal")
        self.assertAlmostEqual(equal["preload"], 1292.9842, delta=1e-3)
        ball = equal["rows"][1]["balls"][0]
        self.assertAlmostEqual(abs(ball["inner_traction"]) / (abs(ball["gyroscopic_moment"]) / 9.525e-3), 1, places=9)
        # Of the ring's axial load friction at the inner race carries 96 N, the normal loads 1197 N.
        normal = sum(b["inner"]["load"] * abs(math.sin(b["inner"]["angle"])) for b in equal["rows"][1]["balls"])
        self.assertAlmostEqual(normal, 1197.0832, delta=1e-3)

    def test_contact_ellipses_beyond_the_raceway_are_flagged(self):
        # The groove of 0.52 d about a centre at d_m/2 + 0.02 d cos 25 deg reaches the shoulder of 78 mm at 42.14 deg.
        d, phi = 9.525e-3, math.radians(25)
        radius, centre = 0.52 * d, 42.5e-3 + 0.02 * d * math.cos(phi)
        edge = math.acos((centre - 39e-3) / radius)
        self.assertAlmostEqual(math.degrees(edge), 42.14, delta=0.005)
        thrust = self.bearing("--set", 'statics.force=["14500 N", 0, 0]')
        loaded = max(thrust["rows"], key=lambda row: row["largest_ball_load"])
        inner = loaded["balls"][0]["inner"]
        margin = radius * math.sin(edge - abs(inner["angle"])) - inner["semi_major_axis"]
        self.assertLess(margin, 0, "m: the ellipse reaches over the edge")
        self.assertAlmostEqual(inner["edge_margin"], margin, delta=1e-12)
        self.assertAlmostEqual(inner["truncation"], -margin / (2 * inner["semi_major_axis"]), delta=1e-9)
        self.assertGreaterEqual(loaded["truncation"], inner["truncation"])
        self.assertTrue(loaded["pressure_is_void"])
        text = self.succeed("statics", "reference.toml", "--bearing", "TB2", "--set", 'statics.force=["14500 N", 0, 0]').stdout
        self.assertRegex(text, r"warning: contact ellipses of row [12] reach over the raceway's edge, by up to [0-9]+ % of their length: pressure and s0 are void")
        for row in self.bearing()["rows"]:
            self.assertEqual(row["truncation"], 0)
            self.assertFalse(row["pressure_is_void"])
            self.assertGreater(row["edge_margin"], 0.5e-3)

    def test_centrifugal_forces_that_the_model_leaves_out_are_said(self):
        fast = ("--set", "statics.speed=15200 rpm")
        d, d_m = 9.525e-3, 85e-3
        mass = 7800 * math.pi / 6 * d**3
        orbit = 15200 * math.pi / 30 * (1 - d / d_m * math.cos(math.radians(25))) / 2
        force = mass * d_m / 2 * orbit**2
        row = self.bearing(*fast)["rows"][0]
        self.assertAlmostEqual(row["centrifugal_over_load"], force / row["largest_ball_load"], delta=1e-9)
        self.assertTrue(row["neglects_centrifugal"])
        self.assertIn("warning: centrifugal forces are", self.succeed("statics", "reference.toml", "--bearing", "TB2", *fast).stdout)
        for quiet in (("--set", "statics.speed=1000 rpm"), (*fast, "--set", "bearings.TB2.ball_model=inertial"), (*fast, "--set", 'statics.force=["30 kN", 0, 0]')):
            with self.subTest(options=quiet):
                self.assertFalse(all(row["neglects_centrifugal"] for row in self.bearing(*quiet)["rows"]))
        self.assertFalse(any(row["neglects_centrifugal"] for row in self.bearing("--set", "statics.speed=1000 rpm")["rows"]))

    def test_a_ring_without_load_in_its_clearance_floats(self):
        loose = self.rest("--bearing", "TB1")["bearings"]["TB1"]
        self.assertTrue(loose["floating"])
        self.assertEqual(loose["free_directions"], 5)
        text = self.succeed("statics", "reference.toml", "--bearing", "TB1").stdout
        self.assertIn("floating", text)

    def test_the_table_says_what_carries_what(self):
        text = self.succeed("statics", "reference.toml").stdout
        for word in ("TB1 (node 2)", "TB2 (node 28)", "remaining preload", "stiffness: axial", "s0", "Residual"):
            self.assertIn(word, text)

    def test_weight_along_the_axis_is_said_to_be_left_out(self):
        upright = ("--set", "run.gravity=[-9.81, 0, 0]")
        shaft = json.loads(self.succeed("statics", "reference.toml", "--json", *upright).stdout)["shaft"]
        self.assertEqual(shaft["weight"], 0)
        self.assertAlmostEqual(shaft["axial_weight"], -9.81 * 109.7, delta=0.3, msg="N")
        self.assertRegex(shaft["note"], r"gravity's part along the axis, 1076\.\d+ N towards -x, is left out")
        self.assertIn("note: " + shaft["note"] + "\n", self.succeed("statics", "reference.toml", *upright).stdout)
        lying = json.loads(self.succeed("statics", "reference.toml", "--json").stdout)["shaft"]
        self.assertEqual(lying["axial_weight"], 0)
        self.assertNotIn("note", lying)

    def test_faulty_requests_are_refused(self):
        self.assertRegex(self.refuse("--bearing", "TB3"), r'no touchdown bearing "TB3".*\n.*Did you mean')
        self.assertIn('statics.subject = "bearings"', self.refuse("--set", "statics.force=[1, 2, 3]"))
        self.assertIn("statics.loads.node = 99", self.refuse("--set", "statics.loads=[{ node = 99, force = [1, 2] }]"))
        self.assertIn("preload_by", self.refuse("--set", "statics.preload_stiffness=1e6"))
        self.assertIn('Did you mean "inner_rise"', self.refuse("--set", "statics.iner_rise=5 K"))


class SettledDrop(ProgramTest):
    """A drop without friction and spin, strongly damped, comes to the rest that statics finds.

    The rocking of TB1, a single deep groove, still decays; TB2's moment is 1.18 N m, its tilt 2e-5 rad.
    """

    MORE = """
base = "reference.toml"
[run]
initial_speed = 0
end_time = "1.2 s"
gravity = [0, {gravity}]
[rotor]
model = "full"
mass_proportional_alpha = 400
unbalance = []
[contact]
friction_coefficient = 0
lambda = 5
[thermal]
growth = false
[bearings]
ring_motion = "{motion}"
ball_damping_beta = "5e-4 s"
[output]
interval = "10 ms"
"""

    def test_rings_rest_as_in_a_drop(self):
        for motion, gravity in (("free", "-9.81, 0"), ("free", "-7, 7"), ("translations", "-9.81, 0")):
            with self.subTest(motion=motion, gravity=gravity):
                case = self.write("drop.toml", self.MORE.format(motion=motion, gravity=gravity))
                rest = json.loads(self.succeed("statics", case, "--json").stdout)["shaft"]["supports"]
                self.run_case(case, output=f"{motion}{gravity[-1]}")
                with h5py.File(self.folder / f"{motion}{gravity[-1]}" / "results.h5") as file:
                    for name, support in rest.items():
                        bearing = file["bearings"][name]
                        force = math.hypot(*support["force_on_rotor"].values())
                        self.assertAlmostEqual(bearing["contact_force"][-1] / force, 1, delta=1e-5, msg=name)
                        largest = [row["largest_ball_load"] for row in support["inner_ring"]["rows"]]
                        for found, expected in zip(numpy.ravel(bearing["ball_force"][-1]), largest):
                            # A ring that only translates in the drop may tilt in statics.
                            self.assertAlmostEqual(found / expected, 1, delta=2e-5 if motion == "free" else 3e-4, msg=name)
                        if motion == "free" and name == "TB2":
                            moment = support["moment_on_rotor"]
                            for found, axis in zip(bearing["ring_moment"][-1], "yz"):
                                self.assertAlmostEqual(found, -moment[axis], delta=2e-5, msg=f"N m, {name}, {axis}")
                            for found, axis in zip(bearing["ring_tilt"][-1], "yz"):
                                self.assertAlmostEqual(found, support["inner_ring"]["tilt"][axis], delta=1e-9, msg=f"rad, {name}")


if __name__ == "__main__":
    unittest.main()

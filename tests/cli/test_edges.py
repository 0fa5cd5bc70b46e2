"""Edges of what a run computes: starts inside wavy bores, one bearing beside the centre of gravity, disturbed magnets, very fast and very small machines."""

import json
import re
import sys
import unittest

import h5py

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, page_data, settings  # noqa: E402

# A shaft of 400 mm on one bearing in its middle, node 3.
ONE = """
[run]
initial_speed = "12000 rpm"
end_time = "10 ms"
[rotor.geometry]
material = { E = 2e11, nu = 0.3, rho = 7800 }
nodes = [{ id = 1, x = 0.0 }, { id = 2, x = 0.1 }, { id = 3, x = 0.2 }, { id = 4, x = 0.3 }, { id = 5, x = 0.4 }]
elements = [NN]
[bearings.A]
type = "touchdown"
catalogue = "6014"
node = 3
contact_stiffness = 1.1e9
housing_diameters = ["110 mm", "130 mm"]
housing_length = "25 mm"
support = { mass = "20 kg", K_y = 5e8, K_z = 5e8, C_y = 3e3, C_z = 3e3 }
""".replace("NN", ", ".join(f"{{ id = {k}, n1 = {k}, n2 = {k + 1}, length = 0.1, od = 0.0695, id_ = 0.0 }}" for k in range(1, 5)))


class Edges(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("one.toml", ONE)

    def said(self, *arguments):
        done = self.call(*arguments)
        return done.returncode, re.sub(r"\s+", " ", done.stderr)

    def wave(self, order, amplitude, phase="90 deg"):
        return ["--set", f'bearings.A.waviness=[{{surface="bore", order={order}, amplitude="{amplitude}", phase="{phase}"}}]']

    def test_a_rotor_does_not_start_inside_a_wavy_bore(self):
        # A wave of order 1 with its crest towards +y (phase 90 deg): of the gap of 250 um 200 um are left there, less what the rotor grows (0.5 um).
        offset = ["--set", 'rotor.initial_offset=["210 um", 0]']
        self.assertEqual(self.said("check", "one.toml", *offset)[0], 0)
        self.assertEqual(self.said("check", "one.toml", *offset, *self.wave(1, "30 um"))[0], 0)
        self.assertEqual(self.said("check", "one.toml", *offset, *self.wave(1, "50 um", "-90 deg"))[0], 0, "the trough")
        for run in (offset + self.wave(1, "50 um"), self.wave(3, "260 um")):
            code, said = self.said("run", "one.toml", "-o", "no", *run)
            self.assertEqual(code, 2, said)
            found = re.search(r"the rotor starts ([0-9.]+) um inside the wavy bore of A", said)
            self.assertTrue(found, said)
            self.assertAlmostEqual(float(found[1]), 10, delta=1.5)

    def test_one_bearing_beside_the_centre_of_gravity_is_told(self):
        self.assertNotIn("tips over", self.said("check", "one.toml")[1])
        beside = settings(bearings__A__node=2)
        for command in (("check", "one.toml"), ("run", "one.toml", "-o", "out")):
            self.assertIn("bearings.A alone holds the rotor, 100 mm beside its centre of gravity: the rotor tips over", self.said(*command, *beside)[1])
        self.assertNotIn("tips over", self.said("check", "one.toml", *beside, *settings(run__gravity=0))[1])
        self.assertNotIn("tilt", [w["code"] for w in self.summary()["warnings"]], "10 ms are not enough")
        # A rod of length L on a bearing at a from its middle, beyond the gap: the tilt of a fall from rest, g a t^2 / (2 (L^2/12 + a^2)).
        done = self.succeed("run", "one.toml", "-o", "long", *beside, *settings(run__end_time="0.3 s"))
        (tilt,) = [w for w in self.summary("long")["warnings"] if w["code"] == "tilt"]
        self.assertEqual(tilt["limit"], 0.1)
        self.assertGreater(tilt["worst"], 0.3, "the far end falls by 120 mm at 300 mm from the bearing")
        self.assertRegex(done.stdout, r"the rotor ends tilted by [0-9.]+ rad .*sine and cosine are off by more than 0.5 % above 0.1 rad.*\[tilt\]")

    def test_a_disturbed_magnet_holds_with_its_springs_too(self):
        # F = F_0 - K x: F_0 balances the weight and its moment, x is the offset from the held place.
        K = [[2e6, 1e5], [-1e5, 3e6]]
        self.write("magnets.toml", f"""base = "{PARAMS}/neisi2019-settling.toml"
run = {{ end_time = "1 ms", gravity = [0, -8.0, 3.0] }}
rotor = {{ model = "rigid", unbalance = [], initial_offset = ["20 um", "-10 um"] }}
[bearings.M1]
type = "magnet"
node = 7
stiffness = {K}
damping = [["3e3 N s/m", 0], [0, "1e3 N s/m"]]
release_time = ["5 ms", "12 ms"]
[bearings.M2]
type = "magnet"
node = 25
stiffness = [["2e6 N/m", 0], [0, "2e6 N/m"]]
damping = [["1e3 N s/m", 0], [0, "1e3 N s/m"]]
release_time = ["30 ms", "30 ms"]
""")
        summary = self.run_case("magnets.toml")
        nodes = {n["id"]: n["x"] for n in json.loads((PARAMS / "neisi2019-rotor.json").read_text())["nodes"]}
        mass, x_cg = summary["rotor"]["mass"], summary["rotor"]["centre_of_gravity"]
        share = (nodes[25] - x_cg) / (nodes[25] - nodes[7])
        held = [mass * 8 * share, -mass * 3 * share]
        with h5py.File(self.folder / "out/results.h5") as results:
            force = results["bearings/M1/magnet_force"][0][1:]
        for i in range(2):
            self.assertAlmostEqual(force[i], held[i] - K[i][0] * 20e-6 + K[i][1] * 10e-6, delta=1e-6 * abs(held[i]))
        self.assertAlmostEqual(force[0], 432.7, delta=0.1)

    def test_micro_spindles_run_faster_than_20000_rad_per_s(self):
        code, said = self.said("check", "one.toml", *settings(run__initial_speed="250000 rpm"))
        self.assertEqual(code, 0, said)
        self.assertIn("initial_speed", said, "unusual")
        self.assertEqual(self.said("check", "one.toml", *settings(run__initial_speed="3e5 rad/s"))[0], 2)

    def test_the_rotor_under_a_bearing_has_the_limit_of_its_own_material(self):
        sleeve = ('materials.sleeve={E="2.1e11 Pa", nu=0.3, rho=7800, k=40, c=460, alpha=1.2e-5, temperature_limit="LIMIT"}', 'bearings.TB1.journal="sleeve"')
        for limit, is_above in (("400 degC", False), ("25 degC", True)):
            arguments = [part for one in sleeve for part in ("--set", one.replace("LIMIT", limit))]
            self.succeed("run", "reference.toml", "-o", "out", "--force", *arguments, *settings(run__end_time="20 ms", materials__steel__temperature_limit="900 degC"))
            local = [w for w in self.summary()["warnings"] if (w["code"], w["place"], w["part"]) == ("local-temperature", "TB1", "rotor")]
            self.assertEqual(len(local), is_above)
            self.succeed("report", "out", "--force")
            checks = {c["name"]: c for c in page_data((self.folder / "out/report.html").read_text())["checks"]}
            self.assertIn("of sleeve up to", checks["TB1: mean temperature of rings and balls and rotor"]["text"])
            check = checks["TB1: local temperature where rotor and bore rub"]
            self.assertIn(f"{'above' if is_above else 'below'} the {298 if is_above else 673} K of sleeve", check["text"])
            self.assertEqual(check["state"] == "warning", is_above, check["text"])

    def test_small_machines_are_told_with_their_digits(self):
        # A hundredth of the dimensions of the shaft and a soft contact: some newtons.
        small = ["--set", "run.gravity=0.02", "--set", "contact.air_gap=\"1 um\"", "--set", 'run.end_time="20 ms"', "--set", "bearings.A.contact_stiffness=1e6"]
        done = self.succeed("run", "one.toml", "-o", "out", *small)
        peak = self.summary()["bearings"]["A"]["peak_contact_force"]
        self.assertTrue(0 < peak < 100, peak)
        self.assertIn(f"peak contact force {peak:.3g} N, rub heat", done.stdout)
        self.assertNotIn("0.00 J", done.stdout)

    def test_the_apex_is_one_against_gravity(self):
        run = settings(run__end_time="30 ms", bearings__A__support__C_y=0)
        for gravity, is_known in (("[0, -9.81, 0]", True), ("[0, 9.81, 0]", False), ("[0, 0, -9.81]", False)):
            apex = self.run_case("one.toml", "--set", f"run.gravity={gravity}", *run, "--force")["bearings"]["A"]["first_bounce_apex"]
            self.assertEqual(apex is not None, is_known, gravity)

    def test_the_report_names_the_law_of_friction(self):
        for setting, words in (([], "friction follows Coulomb's law, smoothed below 0.05 m/s"),
                               (["contact.static_friction_coefficient=0.3"], "friction follows Stribeck's law, from 0.3 at rest to 0.1 over 0.5 m/s of slip, smoothed below 0.05 m/s"),
                               (['contact.friction_law="sticking"'], "friction follows Coulomb's law, and sticks before it slips, elastically with 1e+08 N/m"),
                               (['contact.friction_over_speed=[["0 m/s", 0.2], ["1 m/s", 0.1]]'], "friction follows a table over slip speed, smoothed below 0.05 m/s")):
            self.succeed("run", "one.toml", "-o", "out", "--force", *[part for one in setting for part in ("--set", one)])
            self.succeed("report", "out", "--force")
            data = page_data((self.folder / "out/report.html").read_text())
            self.assertTrue(any(words in text for text in data["assumptions"]), (words, data["assumptions"]))

    def test_a_bearing_without_load_has_no_ratio_of_ratings(self):
        self.succeed("run", "one.toml", "-o", "out", *settings(run__end_time="1 ms", run__gravity=0, bearings__A__C0="31 kN"))
        self.succeed("report", "out")
        checks = {c["name"]: c for c in page_data((self.folder / "out/report.html").read_text())["checks"]}
        self.assertIn("no load in the recorded samples", checks["A: static load rating"]["text"])


if __name__ == "__main__":
    unittest.main()

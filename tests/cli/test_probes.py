"""Probes: displacement and clearance at any node of the rotor, and contact there.

FREE FALL: a rigid rotor without spin and unbalance falls like a stone until it touches: at every node y(t) - y(0) = -g t^2 / 2.
IMPACT: under the centre of gravity a rigid rotor of mass m that falls by h onto a spring K without loss compresses it by delta with
  K delta^2 / 2 = m g (h + delta),   F = K delta = m g (1 + sqrt(1 + 2 K h / (m g))).
FRICTION: at the slip v = omega r, which hardly changes in one impact, the heat is mu v times the impulse of the normal force.
RECORDED: the clearance left is the probe's clearance less the distance of the recorded position from the part's axis.
"""

import json
import math
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest, page_data  # noqa: E402

RIGID = """[rotor]
model = "rigid"
unbalance = []
"""
# Node 15 lies 8 mm from the centre of gravity.
MASS, G, CENTRE_OF_GRAVITY, NODE_15, DIAMETRAL = 109.6997, 9.81, 0.4602, 0.452146, 4.55351


class Probes(ProgramTest):
    def run_probes(self, probes, more=RIGID, **keys):
        self.case(more + "[rotor.probes]\n" + probes)
        summary = self.run_case("drop.toml", **keys)
        return summary, h5py.File(self.folder / "out/results.h5")

    def test_every_node_of_a_rigid_rotor_falls_freely(self):
        summary, file = self.run_probes('a = { node = 1, clearance = "1 mm" }\nb = { node = 31, clearance = "1 mm" }', run__end_time="6 ms", run__initial_speed="0 rpm")
        with file:
            time = file["time"][:]
            for name in "ab":
                y = file[f"probes/{name}/position"][:, 0]
                fall = numpy.abs(y - y[0] + G * time**2 / 2)
                self.assertLess(fall.max(), 2e-10, "m, the error of the integration")
                self.assertGreater(y[0] - y[-1], 170e-6, "it fell")
                self.assertFalse(summary["probes"][name]["touches"])

    def test_the_clearance_left_is_that_of_the_recorded_position(self):
        summary, file = self.run_probes('magnet = { node = 12, clearance = "300 um", centre = ["-20 um", "15 um"] }', more="", run__end_time="40 ms")
        with file:
            y, z = file["probes/magnet/position"][:].T
            left = 300e-6 - numpy.hypot(y + 20e-6, z - 15e-6)
            self.assertLess(numpy.abs(left - file["probes/magnet/clearance"][:]).max(), 1e-18)
            probe = summary["probes"]["magnet"]
            self.assertLessEqual(probe["smallest_clearance"], left.min())
            self.assertAlmostEqual(probe["smallest_clearance"], left.min(), delta=0.5e-6, msg="m: steps lie between rows")
            self.assertAlmostEqual(probe["smallest_clearance_time"], file["time"][left.argmin()], delta=50e-6, msg="s: a row")
            self.assertEqual(probe["touches"], bool(left.min() < 0))

    def test_a_probe_without_contact_changes_nothing(self):
        without = self.run_case(self.case(""), output="without")
        with_probe = self.run_case(self.case('[rotor.probes]\nseal = { node = 9, clearance = "100 um" }'), output="with")
        self.assertEqual(without["bearings"], with_probe["bearings"])
        self.assertEqual(without["run"]["rhs_evaluations"], with_probe["run"]["rhs_evaluations"])
        self.assertTrue(with_probe["probes"]["seal"]["touches"])
        # 100 um of free fall of the middle, whose ring centres hang some micrometres low at the start.
        self.assertAlmostEqual(with_probe["probes"]["seal"]["first_touch_time"], math.sqrt(2 * 90e-6 / G), delta=0.3e-3)

    def test_the_force_of_an_impact_follows_from_its_energy(self):
        contact = 'contact = { stiffness = "2e8 N/m", lambda = 0, friction_coefficient = 0 }'
        summary, file = self.run_probes(f'stop = {{ node = 15, clearance = "100 um", {contact} }}', run__end_time="8 ms", run__initial_speed="0 rpm",
                                        output__interval="5 us")
        with file:
            h = 100e-6 + file["probes/stop/position"][0, 0]
        # Away from the centre of gravity by d the impact meets the mass m / (1 + m d^2 / Id).
        d = CENTRE_OF_GRAVITY - NODE_15
        mass = MASS / (1 + MASS * d**2 / DIAMETRAL)
        force = MASS * G * (1 + math.sqrt(1 + 2 * 2e8 * h / (mass * G)))
        probe = summary["probes"]["stop"]
        self.assertAlmostEqual(probe["contact"]["peak_contact_force"], force, delta=2e-3 * force, msg="N: largest at a step")
        self.assertEqual(probe["contact"]["damping"], 0)
        self.assertEqual(probe["contact"]["friction_heat"], 0)
        self.assertLess(abs(summary["energy"]["residual"]), 5e-5, "J of 0.15 J in the impact")
        self.assertAlmostEqual(-probe["smallest_clearance"], force / 2e8, delta=2e-3 * force / 2e8)

    def test_friction_and_damping_at_a_probe_are_accounted_for(self):
        summary, file = self.run_probes('stop = { node = 15, clearance = "100 um", contact = { stiffness = "2e8 N/m", friction_coefficient = 0.2, radius = "60 mm" } }',
                                        more="", run__end_time="8 ms")
        with file:
            impulse, heat = file["ledger/probes/stop/contact_impulse"][-1], file["ledger/probes/stop/contact_friction"][-1]
            speed = file["rotor/spin_speed"][0]
            self.assertGreater(impulse, 5, "N s: it touched and rebounded")
            self.assertAlmostEqual(heat, 0.2 * 0.06 * speed * impulse, delta=2e-3 * heat, msg="J: the centre's own speed is a thousandth of the surface's")
            self.assertAlmostEqual(file["probes/stop/friction_force"][:].min(), -0.2 * file["probes/stop/contact_force"][:].max(), delta=0.01)
            spin = 0.389998 * (speed - file["rotor/spin_speed"][-1])
            self.assertAlmostEqual(spin, 0.2 * 0.06 * impulse, delta=2e-3 * spin, msg="N m s: friction brakes the rotor")
        self.assertGreater(summary["probes"]["stop"]["contact"]["damping"], 0)
        self.assertLess(abs(summary["energy"]["residual"]), 1e-5)
        self.assertEqual(summary["energy"]["heat_residual"], summary["energy"]["heat_residual"])
        self.assertLess(abs(summary["energy"]["heat_residual"]), 1e-6, "the heat of a probe enters no bearing")

    def test_touching_is_said_on_the_screen_and_in_the_report(self):
        case = self.case('[rotor.probes]\nmagnet = { node = 6, clearance = "120 um" }\nfree = { node = 24, clearance = "900 um" }')
        done = self.call("run", case, "-o", "out", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"warning: .*drop\.toml:\d+:\d+: rotor\.probes\.magnet\.clearance leaves 120 um at node 6")
        self.assertNotIn("probes.free", done.stderr)
        done = self.call("run", case, "-o", "loud")
        self.assertRegex(done.stdout, r"magnet \(node 6\): the rotor TOUCHES at 4\.\d+ ms and goes on as if nothing were there")
        self.assertRegex(done.stdout, r"free \(node 24\): does not touch; smallest clearance \d+(\.\d+)? of 900 um")
        self.assertEqual(self.call("report", "out").returncode, 0)
        page = (self.folder / "out/report.html").read_text()
        data = page_data(page)
        self.assertIn("probe-clearance", page)
        checks = {check["name"]: check for check in data["checks"]}
        self.assertEqual(checks["magnet: clearance at the probe"]["state"], "warning")
        self.assertEqual(checks["free: clearance at the probe"]["state"], "ok")
        self.assertEqual([probe["name"] for probe in data["animation"]["probes"]], ["magnet", "free"])

    def test_strict_refuses_a_clearance_below_the_gap(self):
        case = self.case('[rotor.probes]\nmagnet = { node = 12, clearance = "250 um" }')
        done = self.call("check", case, "--strict")
        self.assertEqual(done.returncode, 2)
        self.assertIn("gaps of the touchdown bearings", done.stderr)
        # Beyond the bearings a straight rotor that lies slantwise in both gaps reaches further.
        self.assertEqual(self.call("check", self.case('[rotor.probes]\nend = { node = 12, clearance = "251 um" }'), "--strict").returncode, 0)
        self.assertEqual(self.call("check", self.case('[rotor.probes]\nend = { node = 31, clearance = "300 um" }'), "--strict").returncode, 2)

    def test_statics_tells_the_clearance_at_rest(self):
        case = self.case('[statics]\nsubject = "shaft"\n[rotor.probes]\nmagnet = { node = 12, clearance = "400 um" }')
        report = json.loads(self.call("statics", case, "--json").stdout)["shaft"]
        y, z = report["axis"]["y"][11], report["axis"]["z"][11]
        self.assertAlmostEqual(report["probes"]["magnet"]["clearance"], 400e-6 - math.hypot(y, z), delta=1e-15)


if __name__ == "__main__":
    unittest.main()

"""Coast-downs: windage, ends of a run by a condition, rows that become coarse, resuming.

WINDAGE ALONE. A rotor on linear supports without unbalance spins with Ip w' = -T(w), whatever else it does:
  T = c w:    w = w0 exp(-c t / Ip), at standstill (1 rad/s) after t = Ip/c ln(w0)
  T = k w^2:  w = w0 / (1 + k w0 t / Ip)
and the gas takes Ip (w0^2 - w^2) / 2.
"""

import math
import shutil
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, settings  # noqa: E402

LINEAR = """[run]
end_time = "2 s"
initial_speed = 1000
[rotor]
geometry = "neisi2019-rotor.json"
model = "rigid"
[rotor.windage]
torque = "200 N m"
speed = 1000
exponent = {exponent}
[integration]
step = "50 us"
[bearings.A]
type = "linear"
node = 2
stiffness = [["1e6 N/m", 0], [0, "1e6 N/m"]]
damping = [[20000, 0], [0, 20000]]
[bearings.B]
type = "linear"
node = 28
stiffness = [["1e6 N/m", 0], [0, "1e6 N/m"]]
damping = [[20000, 0], [0, 20000]]
"""
IP = 0.3899981437441726  # kg m2, of the rotor's file


class WindageAlone(ProgramTest):
    def test_quadratic_windage_is_a_hyperbola(self):
        self.write("spin.toml", LINEAR.format(exponent=2))
        summary = self.run_case("spin.toml", output__interval="1 ms")
        with h5py.File(self.folder / "out/results.h5") as file:
            t, w = file["time"][:], file["rotor/spin_speed"][:]
            k = 200 / 1000**2
            numpy.testing.assert_allclose(w, 1000 / (1 + k * 1000 * t / IP), rtol=2e-7)  # the tolerance 3e-7 of each step, damped by the flow
            taken = file["ledger/windage"][:]
            numpy.testing.assert_allclose(taken, IP * (1000**2 - w**2) / 2, rtol=1e-6, atol=1e-3)
        energy = summary["energy"]
        self.assertAlmostEqual(energy["windage"], IP * (1000**2 - summary["rotor_speed_end"] ** 2) / 2, delta=1e-6 * IP * 1000**2)
        self.assertLess(abs(energy["residual"]), 1e-6 * IP * 1000**2 / 2)
        self.assertEqual(energy["heat_deposited"], 0, "the gas warms no bearing")
        self.assertEqual((summary["run"]["until"], summary["run"]["ended_by"]), ("", "end_time"))

    def test_linear_windage_stands_still_when_the_exponential_says(self):
        self.write("spin.toml", LINEAR.format(exponent=1))
        done = self.succeed("run", "spin.toml", "-o", "out", *settings(rotor__windage__torque="2000 N m", run__until="standstill", output__interval="1 ms"))
        summary = self.summary()
        expected = IP / 2.0 * math.log(1000)  # c = 2 N m s
        end = summary["run"]["end_time"]
        self.assertGreaterEqual(end, expected * (1 - 1e-7))
        self.assertLess(end, expected + 51e-6, "the end of the step in which it happens")
        self.assertEqual(summary["run"]["ended_by"], "standstill")
        self.assertLess(summary["rotor_speed_end"], 1)
        self.assertTrue(summary["run"]["completed"])
        self.assertRegex(done.stdout, r'Ended by run\.until = "standstill" at t = 1\.34')
        with h5py.File(self.folder / "out/results.h5") as file:
            self.assertEqual(file["time"][-1], end, "the last row is the end")

    def test_an_end_that_does_not_come_is_told(self):
        self.write("spin.toml", LINEAR.format(exponent=2))
        # So strong a brake takes the rotor through standstill within a step of 50 us, by 25 rad/s.
        summary = self.run_case("spin.toml", output="stopped", run__until="standstill", rotor__windage__factor=0, rotor__torque="-2e5 N m", output__interval="1 ms")
        self.assertEqual(summary["run"]["ended_by"], "standstill")
        stop = 1000 * IP / 2e5
        self.assertGreaterEqual(summary["run"]["end_time"], stop - 1e-9)
        self.assertLess(summary["run"]["end_time"], stop + 51e-6)
        done = self.succeed("run", "spin.toml", "-o", "out", *settings(run__until="standstill", run__end_time="0.1 s"))
        self.assertIn('run.until = "standstill" was not met', done.stdout)
        self.assertEqual(self.summary()["run"]["ended_by"], "end_time")
        self.assertAlmostEqual(self.summary()["run"]["end_time"], 0.1)

    def test_windage_from_the_geometry_brakes(self):
        text = LINEAR.format(exponent=2).replace('torque = "200 N m"\nspeed = 1000\nexponent = 2\n', 'law = "geometry"\n')
        self.write("spin.toml", text)
        self.run_case("spin.toml", run__end_time="1 s", run__initial_speed="15200 rpm", output__interval="10 ms")
        with h5py.File(self.folder / "out/results.h5") as file:
            w, t = file["rotor/spin_speed"][:], file["time"][:]
        torque = -IP * (w[-1] - w[0]) / (t[-1] - t[0])
        # By hand: C = 0.00288 for the largest cylinder (Re = 1.09e6): 0.55 N m; 0.15 for those beside it; 2 x 0.074 for its faces; the rest less than 0.1
        self.assertGreater(torque, 0.7)
        self.assertLess(torque, 1.0)


class Ends(ProgramTest):
    def test_rings_at_speed(self):
        summary = self.run_case("reference.toml", run__until="rings at speed", run__end_time="0.5 s")
        self.assertEqual(summary["run"]["ended_by"], "rings at speed")
        with h5py.File(self.folder / "out/results.h5") as file:
            lags = [abs(file[f"bearings/{name}/spin_lag"][:]) for name in ("TB1", "TB2")]
            time = file["time"][:]
        late = numpy.maximum(*lags)
        self.assertLess(late[-1], 0.01)
        # The end is looked for at the ends of steps; rows within the last one, of 50 us at most, may be past it.
        self.assertGreaterEqual(late[time < time[-1] - 50e-6].min(), 0.01 * (1 - 1e-9), "at no step before")
        for bearing in summary["bearings"].values():
            self.assertLessEqual(bearing["catch_up_time"], summary["run"]["end_time"])

    def test_rings_of_a_rotor_that_does_not_spin_are_never_at_speed(self):
        shutil.copy(PARAMS / "neisi2019-settling.toml", self.folder / "settling.toml")
        shutil.copy(PARAMS / "neisi2019.toml", self.folder)
        done = self.succeed("run", "settling.toml", "-o", "out", *settings(run__initial_speed=0, run__until="rings at speed", run__end_time="60 ms"))
        self.assertEqual(done.stdout.count("no spin-up, as the rotor does not spin"), 2, done.stdout)
        summary = self.summary()
        self.assertEqual(summary["run"]["end_time"], 0.06, "what catches up is roundoff")
        for bearing in summary["bearings"].values():
            self.assertIsNone(bearing["catch_up_time"])
            self.assertLess(abs(bearing["ring_speed_end"]), 1e-9, "rad/s")
        self.assertNotIn("skidding", [warning["code"] for warning in summary["warnings"]])

    def test_no_contact(self):
        # Without gravity, pushed at 0.1 m/s against alpha = 200 1/s: it could go 500 um, meets the rings after 250 um with half the speed, and stops on the way back.
        push = settings(run__gravity=0, run__until="no contact", run__end_time="1 s", rotor__initial_velocity="[-0.1, 0]", contact__friction_coefficient=0)
        summary = self.run_case("reference.toml", *push, rotor__unbalance="[]", rotor__mass_proportional_alpha=200)
        self.assertEqual(summary["run"]["ended_by"], "no contact")
        with h5py.File(self.folder / "out/results.h5") as file:
            t, touching = file["time"][:], (file["bearings/TB1/penetration"][:] > 0) | (file["bearings/TB2/penetration"][:] > 0)
        self.assertTrue(touching.any())
        self.assertAlmostEqual(t[-1] - t[touching][-1], 0.1, delta=110e-6, msg="s; rows are 50 us apart, and the end is a step's")

    def test_no_contact_does_not_end_a_rotor_that_bounces_under_gravity(self):
        summary = self.run_case("reference.toml", run__until="no contact", run__end_time="0.2 s")
        self.assertEqual(summary["run"]["ended_by"], "end_time")

    def test_a_time(self):
        summary = self.run_case("reference.toml", run__until="5 ms")
        self.assertEqual((summary["run"]["ended_by"], summary["run"]["end_time"]), ("until", 0.005))
        same = self.run_case("reference.toml", output="same", run__end_time="5 ms")
        self.assertEqual(same["bearings"], summary["bearings"])

    def fails(self, text, *patterns):
        self.write("bad.toml", text if "base" in text else 'base = "reference.toml"\n' + text)
        done = self.call("check", "bad.toml")
        self.assertEqual(done.returncode, 2, done.stdout)
        for pattern in patterns:
            self.assertRegex(done.stderr, pattern)

    def test_bad_input_is_refused(self):
        self.fails('run.until = "standstil"\n', r"bad\.toml:2:13: run\.until", 'Did you mean "standstill"')
        self.fails('run.until = "-1 s"\n', r"run\.until")
        self.fails('run.until = "3 s"\n', "later than run.end_time", "Raise run.end_time")
        self.fails('run.until = "standstill"\nrun.initial_speed = 0\n', "already stands")
        self.fails('[rotor.windage]\ntorque = "1 N m"\n', "needs a torque and the speed", "geometry")
        self.fails('[rotor.windage]\nlaw = "geometry"\ntorque = "1 N m"\n', "belongs to law")
        self.fails('[rotor.windage]\nlaw = "quadratic"\n', r"rotor\.windage\.law", "power")
        self.fails('[output]\nchange = 2\n', r"output\.change")
        self.write("spin.toml", LINEAR.format(exponent=2) + "# end\n")
        done = self.call("check", "spin.toml", *settings(run__until="no contact"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("no touchdown bearing", done.stderr)

    def test_thrust_without_friction_is_warned_of(self):
        for law, is_told in (("radial", True), ("equivalent", False)):
            done = self.succeed("check", str(PARAMS / "neisi2019-thrust.toml"), *settings(bearings__load_law=law))
            self.assertEqual("thrust makes no friction" in done.stderr, is_told, law)

    def test_thrust_makes_friction(self):
        # One row carries 1500 N: P0 = 0.38 * 1500, P1 = 0.9 * 1500 cot 25 deg; 0.001 (570/31000)^0.33 2895 * 0.085 = 0.0658 N m, and what the other row's
        # rest of the preload adds. At rest along the axis, rolling at 3000 rpm.
        summary = self.run_case(str(PARAMS / "neisi2019-thrust.toml"), run__end_time="0.4 s", run__initial_speed="3000 rpm")
        with h5py.File(self.folder / "out/results.h5") as file:
            torque, rows = file["bearings/TB2/load_torque"][:], abs(file["bearings/TB2/row_axial_force"][:])
            radial = numpy.linalg.norm(file["bearings/TB2/bearing_force"][:], axis=1)
            late = file["time"][:] > 0.38
        self.assertGreater(torque[late].min(), 0.05, "N m")
        axial = rows[late].mean(axis=0)
        by_hand = sum(0.001 * (0.38 * F / 31e3) ** 0.33 * 0.9 * F / math.tan(math.radians(25)) * 0.085 for F in axial)
        self.assertAlmostEqual(torque[late].mean() / by_hand, 1, delta=0.15, msg=f"radial load {radial[late].mean()} N is left out by hand")
        self.assertGreater(summary["bearings"]["TB2"]["load_torque_peak"], 0.05)


COAST = settings(run__end_time="3 s", run__until="standstill", rotor__torque="-900 N m", bearings__load_law="equivalent", rotor__windage__law="geometry")


class CoastDown(ProgramTest):
    """The reference machine with a strong brake, so that 15200 rpm last for less than a second."""

    def setUp(self):
        super().setUp()
        self.write("settling.toml", 'base = "reference.toml"\n[rotor]\nmass_proportional_alpha = "30 1/s"\n')

    def test_to_standstill(self):
        summary = self.run_case("settling.toml", *COAST, output__longest_interval="5 ms")
        run, energy = summary["run"], summary["energy"]
        self.assertEqual(run["ended_by"], "standstill")
        self.assertLess(abs(summary["rotor_speed_end"]), 1)
        self.assertAlmostEqual(run["end_time"], IP * 1591.74 / 900, delta=0.002 * run["end_time"], msg="s: friction and windage help by a thousandth")
        self.assertGreater(energy["mechanical_initial"], 494e3)
        self.assertLess(abs(energy["residual"]), 1e-6 * 494e3)
        self.assertLess(abs(energy["heat_residual"]), 1e-6 * 494e3)
        braked = -energy["drive_work"]
        self.assertGreater(energy["windage"], 100)
        self.assertAlmostEqual(energy["mechanical_initial"] - energy["mechanical_final"], braked + energy["dissipated"] - energy["prescribed_work"]
                               - energy["growth_work"] - energy["unbalance_work"], delta=1e-6 * 494e3)
        with h5py.File(self.folder / "out/results.h5") as file:
            time, force = file["time"][:], file["bearings/TB1/contact_force"][:]
            steps = numpy.diff(time)
            self.assertGreater(steps.min(), 0)
            self.assertLessEqual(steps.max(), 5e-3 + 1e-9)
            self.assertLess(len(time), 0.8 * run["end_time"] / 50e-6, "coarse where nothing changes")
            self.assertEqual(len(force), len(time))
            # No peak is lost: the impacts' rows are as dense as before.
            self.assertAlmostEqual(force.max(), summary["bearings"]["TB1"]["peak_contact_force"], delta=0.01 * force.max())
            impact = (time > 7.2e-3) & (time < 10e-3)
            self.assertGreater(impact.sum(), 40)
            # A ledger is a sum: the same joules however coarse the rows.
            self.assertAlmostEqual(file["ledger/windage"][-1], energy["windage"], delta=1e-9 * energy["windage"])

    def test_a_file_of_sensible_size(self):
        # A steadily rolling rotor: rows by the longest interval, 20000 a run, not 60000 a second.
        case = settings(run__end_time="4 s", bearings__load_law="equivalent", output__longest_interval="20 ms")
        self.run_case("settling.toml", *case)
        with h5py.File(self.folder / "out/results.h5") as file:
            time = file["time"][:]
            late = time > 1
            self.assertLess(late.sum(), 1.2 * 3 / 20e-3 + 2, "rows in the last three seconds")
            self.assertLess((file["detail/time"][:] > 1).sum(), 1.2 * 3 / 0.4 + 3)
        self.assertLess((self.folder / "out/results.h5").stat().st_size, 30e6)

    def test_readers_take_uneven_rows(self):
        self.run_case("settling.toml", *COAST, output__longest_interval="5 ms")
        self.succeed("report", "out")
        self.assertTrue((self.folder / "out/report.html").is_file())

    def test_resumes_bit_for_bit(self):
        options = [*COAST, *settings(integration__method="runge-kutta-4", integration__step="2 us", output__longest_interval="5 ms", run__initial_speed="5000 rpm")]
        self.succeed("run", "settling.toml", "-o", "whole", *options)
        self.interrupt_run("settling.toml", *options)
        self.succeed("run", "settling.toml", "-o", "out", *options, "--resume")
        resumed, whole = self.summary("out"), self.summary("whole")
        for summary in (resumed, whole):
            for key in ("wall_time", "cpu_time", "rhs_evaluations"):
                del summary["run"][key]
        self.assertEqual(resumed, whole)
        with h5py.File(self.folder / "out/results.h5") as a, h5py.File(self.folder / "whole/results.h5") as b:
            for name in ("time", "detail/time", "bearings/TB1/contact_force", "bearings/TB2/orbit", "ledger/windage"):
                numpy.testing.assert_array_equal(a[name][:], b[name][:], name)


if __name__ == "__main__":
    unittest.main()

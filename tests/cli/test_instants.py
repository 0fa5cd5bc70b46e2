"""Known instants of a run: the release of a magnet, the points of torques and forces over time. Steps end there.

FALL: a rigid rotor whose magnets let go at t_r falls by g (t - t_r)^2 / 2.
PULSE: a torque that rises from 0 to T and falls back within w leaves the spin Ip w' = T w / 2, however short it is.
THRUST: the same of a force along the axis, with the mass.
"""

import shutil
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, settings  # noqa: E402

G, IP = 9.81, 0.3899981437441726  # kg m2, of the rotor's file
METHODS = ("tsitouras", "bogacki-shampine", "sofroniou-spaletta", "two-step-runge-kutta", "runge-kutta-4", "dormand-prince", "fehlberg-8", "adams")

HEAD = """[run]
initial_speed = "3000 rpm"
end_time = "12 ms"
[rotor]
geometry = "neisi2019-rotor.json"
model = "rigid"
{more}
[rotor.probes.A]
node = 2
clearance = "10 mm"
"""
MAGNET = """[bearings.M{node}]
type = "magnet"
node = {node}
stiffness = [["2e7 N/m", 0], [0, "2e7 N/m"]]
damping = [["1e4 N s/m", 0], [0, "1e4 N s/m"]]
release_time = ["{release}", "{release}"]
{more}
"""
LINEAR = """[bearings.L{node}]
type = "linear"
node = {node}
stiffness = [["2e7 N/m", 0], [0, "2e7 N/m"]]
damping = [["1e4 N s/m", 0], [0, "1e4 N s/m"]]
"""


def held_until(release, more=""):
    return "".join(MAGNET.format(node=node, release=release, more=more) for node in (7, 25))


class Instants(ProgramTest):
    def run_text(self, text, **keys):
        self.write("drop.toml", text)
        return self.run_case("drop.toml", "--force", **keys)

    def series(self, *names):
        with h5py.File(self.folder / "out/results.h5") as file:
            return [file[name][:] for name in names]

    def test_the_fall_begins_at_the_release_by_every_method(self):
        for method in METHODS:
            # Adams' method starts anew with order one, and errs by what the tolerance allows.
            allowed = 1e-9 if method == "adams" else 1e-13
            for release in (5e-3, 5.0175e-3, 5.06e-3):
                with self.subTest(method=method, release=release):
                    summary = self.run_text(HEAD.format(more="") + held_until(f"{release} s"), integration__method=method)
                    t, position = self.series("time", "probes/A/position")
                    fall = G / 2 * numpy.maximum(t - release, 0) ** 2
                    self.assertLess(numpy.abs(position[:, 0] + fall).max(), allowed, "m")
                    self.assertEqual([w["code"] for w in summary["warnings"] if w["code"] == "step-collapse"], [])

    def test_magnets_may_let_go_one_after_the_other_at_any_tolerance(self):
        text = HEAD.format(more="") + MAGNET.format(node=7, release="8 ms", more='residual_time_constant = "2 ms"') + MAGNET.format(node=25, release="5 ms", more="")
        for method in METHODS:
            for tolerance in ("3e-10", "1e-12", "1e-13"):
                if method == "bogacki-shampine" and tolerance != "3e-10":
                    continue  # a million steps
                with self.subTest(method=method, tolerance=tolerance):
                    summary = self.run_text(text, integration__method=method, integration__tolerance=tolerance)
                    self.assertTrue(summary["run"]["completed"])
                    self.assertLess(abs(summary["energy"]["residual"]), 1e-6, "J")

    def test_releases_that_differ_by_rounding_are_one(self):
        for method in ("tsitouras", "runge-kutta-4", "adams", "dormand-prince"):
            with self.subTest(method=method):
                text = HEAD.format(more="") + MAGNET.format(node=7, release="0.005", more="") + MAGNET.format(node=25, release="0.0050000000000000010", more="")
                self.run_text(text.replace('"0.005"', "0.005").replace('"0.0050000000000000010"', "0.0050000000000000010"), integration__method=method)
                t, position = self.series("time", "probes/A/position")
                self.assertLess(numpy.abs(position[:, 0] + G / 2 * numpy.maximum(t - 5e-3, 0) ** 2).max(), 1e-9, "m")

    def test_a_pulse_of_torque_is_neither_missed_nor_misjudged(self):
        for method in METHODS:
            for width in (1e-3, 1e-4, 4e-5, 1e-5, 1e-6):
                with self.subTest(method=method, width=width):
                    start = 5.0321e-3
                    torque = [[0, 0.0], [start, 0.0], [start + width / 2, 100e-3 / width], [start + width, 0.0]]
                    summary = self.run_text(HEAD.format(more=f"torque = {torque}") + LINEAR.format(node=7) + LINEAR.format(node=25), integration__method=method)
                    gained = (summary["rotor_speed_end"] - 3000 * numpy.pi / 30) * summary["rotor"]["polar_inertia"]
                    self.assertAlmostEqual(gained, 0.05, delta=0.05 * (2e-4 if method == "adams" else 1e-9), msg="N m s")

    def test_a_pulse_along_the_axis_likewise(self):
        force = [[0, 0.0], [2.0e-3, 0.0], [2.01e-3, 5e4], [2.02e-3, 0.0]]
        keys = {"run__gravity": 0, "run__end_time": "5 ms", "rotor__mass_proportional_alpha": 0, "rotor__axial_force": force}
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-thrust.toml"):
            shutil.copy(PARAMS / name, self.folder)
        for method in METHODS:
            with self.subTest(method=method):
                summary = self.run_case("neisi2019-thrust.toml", "--force", **keys, integration__method=method)
                (x,) = self.series("bearings/TB2/axial_position")
                way = 0.5 * 5e4 * 2e-5 / summary["rotor"]["mass"] * (5e-3 - 2.01e-3)
                self.assertAlmostEqual(x[-1, 0] - x[0, 0], way, delta=(1e-3 if method == "adams" else 1e-9) * way, msg="m")

    def test_a_run_goes_on_over_a_release_as_if_it_had_not_been_interrupted(self):
        knots = [[round(0.0037 * k, 6), (-1) ** k * 30.0] for k in range(1, 130)]
        text = HEAD.format(more=f"torque = {knots}") + LINEAR.format(node=7) + LINEAR.format(node=25)
        text += "".join(MAGNET.format(node=node, release=release, more='residual_time_constant = "20 ms"') for node, release in ((3, "123.4567 ms"), (16, "0.25 s"), (28, "0.4000001 s")))
        self.write("drop.toml", text)
        options = ["drop.toml", *settings(run__end_time="0.5 s", integration__method="runge-kutta-4", integration__step="1.3 us")]
        self.succeed("run", *options, "-o", "whole")
        self.interrupt_run(*options)
        self.succeed("run", *options, "-o", "out", "--resume")
        with h5py.File(self.folder / "out/results.h5") as a, h5py.File(self.folder / "whole/results.h5") as b:
            for name in ("time", "rotor/spin_speed", "probes/A/position", "bearings/M16/magnet_force", "energy/dissipated"):
                numpy.testing.assert_array_equal(a[name][:], b[name][:], name)


if __name__ == "__main__":
    unittest.main()

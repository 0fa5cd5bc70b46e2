"""Rings that bend: load distribution at rest, drops with contact over an arc and at a point, faulty requests.

SOURCES: balls of TB1 under 5 kN at its bore by CalculiX (validation/ring_bending_calculix.py); equilibrium: the balls' loads times their azimuths' cosines
are the load. ENERGY: every joule of a drop is booked, the residual is that of the integration.
"""

import json
import math
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest, page_data  # noqa: E402


class RingBending(ProgramTest):
    def bearing(self, name, *options):
        text = self.succeed("statics", "reference.toml", "--json", "--bearing", name, "--set", "statics.subject=bearings", *options).stdout
        return json.loads(text)["bearings"][name]

    def test_a_bent_ring_presses_one_ball(self):
        load = ("--set", 'statics.force=[0, "5 kN", 0]')
        rigid = self.bearing("TB1", *load)
        bent = self.bearing("TB1", *load, "--set", "bearings.ring_bending=point")
        arc = self.bearing("TB1", *load, "--set", "bearings.ring_bending=arc")
        self.assertNotIn("bending", rigid)
        for report in (rigid, bent, arc):
            loads = report["rows"][0]["ball_loads"]
            self.assertEqual(len(loads), 14)
            self.assertAlmostEqual(sum(q * math.cos(2 * math.pi * k / 14) for k, q in enumerate(loads)), 5000, delta=1e-4)
        self.assertAlmostEqual(max(bent["rows"][0]["ball_loads"]), 3299, delta=0.03 * 3299, msg="N: CalculiX")
        self.assertLess(arc["rows"][0]["largest_ball_load"], bent["rows"][0]["largest_ball_load"])
        self.assertGreater(arc["rows"][0]["largest_ball_load"], 1.3 * rigid["rows"][0]["largest_ball_load"])
        self.assertLess(arc["rows"][0]["static_safety"], rigid["rows"][0]["static_safety"])
        self.assertLess(arc["stiffness"][1][1], rigid["stiffness"][1][1])
        self.assertEqual([h["n"] for h in arc["bending"]["inner"]], list(range(2, 13)))
        self.assertAlmostEqual(arc["bending"]["inner"][0]["frequency"], 2616.86, delta=0.01 * 2616.86, msg="Hz: CalculiX")

    def test_the_load_between_two_balls_is_shared(self):
        load = ("--set", 'statics.force=[0, "5 kN", 0]', "--set", "bearings.ring_bending=arc", "--set", "bearings.TB1.cage_phase=0.5")
        loads = self.bearing("TB1", *load)["rows"][0]["ball_loads"]
        self.assertAlmostEqual(loads[0], loads[-1], delta=1e-4)
        self.assertEqual(max(loads), max(loads[0], loads[-1]))

    def test_the_shaft_rests_in_bent_rings(self):
        text = self.succeed("statics", "reference.toml", "--json", "--set", "bearings.ring_bending=arc").stdout
        shaft = json.loads(text)["shaft"]
        self.assertAlmostEqual(sum(s["force_on_rotor"]["y"] for s in shaft["supports"].values()), shaft["weight"], delta=1e-5 * shaft["weight"])
        self.assertGreater(shaft["supports"]["TB1"]["inner_ring"]["bending"]["largest_outwards"], 0)

    def drop(self, model, **keys):
        return self.run_case("reference.toml", output=model, bearings__ring_bending=model, run__end_time="12 ms", output__interval="50 us", **keys)

    def test_a_drop_books_every_joule(self):
        rigid = self.drop("none")
        for model in ("point", "arc"):
            with self.subTest(model=model):
                bent = self.drop(model)
                # The integration's own error, with growth on (thermal.growth is true): rigid rings leave as much.
                self.assertLess(abs(bent["energy"]["residual"]), 1e-5, "J")
                with h5py.File(self.folder / model / "results.h5") as file:
                    for name in ("TB1", "TB2"):
                        self.assertGreater(file[f"ledger/{name}/ring_bending_damping"][-1], 0)
                        shape = file[f"bearings/{name}/inner_ring_shape"]
                        self.assertEqual(shape.shape[1], 22)
                        self.assertEqual(list(shape.attrs["columns"])[:2], ["cos 2", "sin 2"])
                        self.assertGreater(numpy.abs(shape[:]).max(), 1e-6, "m")
                        self.assertLess(numpy.abs(shape[:]).max(), 1e-4, "m")
                for name in ("TB1", "TB2"):
                    ball = bent["bearings"][name]["largest_ball_force"] / rigid["bearings"][name]["largest_ball_force"]
                    self.assertGreater(ball, 1.2, "the ring is pressed at one spot")
        with h5py.File(self.folder / "none/results.h5") as file:
            self.assertNotIn("inner_ring_shape", file["bearings/TB1"])
            self.assertNotIn("ring_bending_damping", file["ledger/TB1"])

    def test_a_drop_with_sticking_friction_books_every_joule(self):
        sliding = self.drop("arc")
        sticking = self.run_case("reference.toml", output="sticking", bearings__ring_bending="arc", contact__friction_law="sticking", run__end_time="12 ms", output__interval="50 us")
        # The integration's own error, as with the regularised law.
        self.assertLess(abs(sticking["energy"]["residual"]), 1e-5, "J")
        for name in ("TB1", "TB2"):
            # In sliding both laws have the same force: rings are spun up alike. Impact loads follow the same normal law.
            self.assertAlmostEqual(sticking["bearings"][name]["peak_contact_force"], sliding["bearings"][name]["peak_contact_force"], delta=0.05 * sliding["bearings"][name]["peak_contact_force"], msg="N")

    def test_the_outer_ring_bends_on_its_bedding(self):
        summary = self.drop("arc", bearings__TB1__outer_ring_bedding="1e13 N/m3")
        self.assertLess(abs(summary["energy"]["residual"]), 1e-5, "J")
        with h5py.File(self.folder / "arc/results.h5") as file:
            outer = numpy.abs(file["bearings/TB1/outer_ring_shape"][:]).max()
            self.assertGreater(outer, 1e-8, "m")
            self.assertLess(outer, numpy.abs(file["bearings/TB1/inner_ring_shape"][:]).max())
            self.assertNotIn("outer_ring_shape", file["bearings/TB2"])

    def test_the_report_draws_the_bent_ring(self):
        self.drop("arc")
        self.succeed("report", "arc")
        page = (self.folder / "arc/report.html").read_text()
        data = page_data(page)
        for bearing in data["animation"]["bearings"]:
            shape = bearing["shape"]
            self.assertEqual(len(shape["coefficients"]), 22)
            with h5py.File(self.folder / "arc/results.h5") as file:
                recorded = file[f"bearings/{bearing['name']}/inner_ring_shape"][:, 0] * 1e6
                time = file["detail/time"][:] * 1e3
            shown = numpy.interp(shape["time"], time, recorded)
            numpy.testing.assert_allclose(shape["coefficients"][0], shown, rtol=0, atol=0.02, err_msg="um")

    def refuse(self, text, *says):
        path = self.case(text)
        result = self.call("check", path)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for pattern in says:
            self.assertRegex(result.stderr, pattern)

    def test_faulty_requests_are_refused(self):
        self.refuse("[bearings.TB1]\nring_harmonics = 1\n", r"drop.toml:4:\d+", r"ring_harmonics", r"2.*40|at least 2")
        self.refuse('[bearings.TB1]\nring_bending = "ark"\n', r"drop.toml:4:\d+", 'Did you mean "arc"')
        self.refuse('[bearings.TB1]\nring_bending = "arc"\nring_bending_damping = -0.1\n', r"drop.toml:5:\d+", "ring_bending_damping")
        self.refuse('[bearings.TB1]\nouter_ring_bedding = "1e13 N/m3"\n', r"drop.toml:4:\d+", "outer_ring_bedding", 'ring_bending = "none"')
        self.refuse('[bearings.TB1]\nring_bending = "point"\nouter_ring_bedding = "-1e13 N/m3"\n', r"drop.toml:5:\d+", "outer_ring_bedding")
        self.refuse('[bearings.TB1]\nring_bending = "arc"\nconformity = [0.6, 0.52]\nball_diameter = "20 mm"\n', r"drop.toml:\d+:\d+", "wall", "inner ring")


if __name__ == "__main__":
    unittest.main()

"""docs/circuit_trust.py: how it judges for how long the circuit can be trusted.

Even heating by T of one material makes every growth alpha T times its length, and a ball's two contact points lie a ball's diameter apart along the normal:
races approach balls by -alpha T d, balls grow by +alpha T d, and nothing is left.
"""

import math
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from test_scripts import ROOT, load_script  # noqa: E402

try:
    TRUST = load_script(ROOT / "docs/circuit_trust.py")
except ImportError as error:
    TRUST, MISSING = None, str(error)

ALPHA_T = 11.8e-6 * 20
#: bearing: angle [rad], ball and pitch diameter, width of the rings [m]
BEARINGS = {"TB1": (0.0, 11.906e-3, 90e-3, 20e-3), "TB2": (math.radians(25), 9.525e-3, 85e-3, 32e-3)}


@unittest.skipUnless(TRUST, "docs/circuit_trust.py cannot be imported")
class Judgement(unittest.TestCase):
    def growth(self, bearing, inner=1.0, outer=1.0, ball=1.0):
        """Growth of evenly warm parts, each with its own part of ALPHA_T."""
        phi, d, d_m, width = BEARINGS[bearing]
        return {"inner_race": [inner * ALPHA_T * (d_m - d * math.cos(phi)) / 2], "outer_race": [outer * ALPHA_T * (d_m + d * math.cos(phi)) / 2], "ball_radius": [ball * ALPHA_T * d / 2],
                "inner_width": [inner * ALPHA_T * width], "outer_width": [outer * ALPHA_T * width]}

    def test_even_heating_brings_races_no_nearer_to_the_balls(self):
        for bearing in BEARINGS:
            self.assertLess(abs(TRUST.approach(self.growth(bearing), bearing)[0]), 1e-15, "m: roundoff")

    def test_each_part_approaches_by_its_own_displacement_along_the_normal(self):
        """Contact points of the pair's rows, X: inner ones at x = 8 mm - (d/2) sin phi from the middle, r = d_m/2 - (d/2) cos phi."""
        for bearing, (phi, d, d_m, _) in BEARINGS.items():
            row = 0.0 if bearing == "TB1" else 8e-3
            x, r = row - d / 2 * math.sin(phi), d_m / 2 - d / 2 * math.cos(phi)
            self.assertAlmostEqual(TRUST.approach(self.growth(bearing, outer=0, ball=0), bearing)[0], ALPHA_T * (r * math.cos(phi) + x * math.sin(phi)), delta=1e-15)
            self.assertAlmostEqual(TRUST.approach(self.growth(bearing, inner=0, outer=0), bearing)[0], ALPHA_T * d, delta=1e-15)

    def test_it_names_the_first_time_beyond_five_per_cent(self):
        times = TRUST.TIMES
        error = 0.0 * times
        self.assertTrue(math.isinf(TRUST.first_beyond(error)))
        error[7], error[9] = -0.051, 0.3
        self.assertEqual(TRUST.first_beyond(error), times[7])
        self.assertEqual(TRUST.first_beyond(0.049 + 0.0 * times), math.inf)

    def test_differences_are_parts_of_the_larger_rise_and_of_the_floor(self):
        numpy = TRUST.np
        found = TRUST.relative(numpy.array([2.0, 1.0, 0.002]), numpy.array([1.0, 2.0, 0.001]))
        for value, expected in zip(found, (0.5, -0.5, 0.001 / TRUST.FLOOR)):
            self.assertAlmostEqual(value, expected, delta=1e-12)

    def test_times_are_told_in_their_unit(self):
        self.assertEqual([TRUST.text_of(t) for t in (1.04e-3, 0.5, 31.6, math.inf)], ["1.04 ms", "500 ms", "31.6 s", "1000 s"])


if __name__ == "__main__":
    unittest.main()

"""bearings.NAME.cage = "free": balls that slip, in drops."""

import unittest

import h5py

from tests.cli.program import ProgramTest


class FreeCage(ProgramTest):
    def drop(self, output, **keys):
        summary = self.run_case("reference.toml", output=output, run__end_time="40 ms", **keys)
        return summary, h5py.File(self.folder / output / "results.h5")

    def test_balls_lag_behind_a_ring_that_spins_up_and_energy_closes(self):
        largest = {}
        for traction in ("0.07", "0.002"):
            summary, file = self.drop(f"free-{traction}", bearings__cage="free", bearings__race_traction=traction)
            self.assertLess(abs(summary["energy"]["residual"]), 1e-5, "J")
            self.assertLess(abs(summary["energy"]["heat_residual"]), 1e-9 * summary["energy"]["heat_deposited"])
            for name in ("TB1", "TB2"):
                cage, rolling = file[f"bearings/{name}/cage_speed"][:].T
                self.assertGreater(rolling[-1], 50, "rad/s: the ring turns")
                largest[name, traction] = (rolling - cage).max()
                self.assertGreater(file[f"ledger/{name}/ball_slip_heat"][-1], 0.01, "J")
        for name in ("TB1", "TB2"):
            # skid_demand: loaded balls of this drop need half of what a friction coefficient of 0.1 gives, at most.
            self.assertLess(largest[name, "0.07"], 5, "rad/s: balls roll")
            self.assertGreater(largest[name, "0.002"], 50, "rad/s: balls that are hardly driven")
            self.assertIsNone(summary["bearings"][name]["spin_up"], "an account of balls that roll")

    def test_strong_traction_is_rolling(self):
        # The cage's contact torque acts on the cage instead of being prescribed, which leaves small differences.
        free, file = self.drop("strong", bearings__cage="free", bearings__race_traction="3", bearings__race_traction_slip="0.05 m/s")
        rolling, reference = self.drop("rolling")
        cage, follows = file["bearings/TB2/cage_speed"][-1]
        self.assertAlmostEqual(cage, follows, delta=0.01 * follows)
        ring, expected = file["bearings/TB2/ring_speed"][-1], reference["bearings/TB2/ring_speed"][-1]
        self.assertAlmostEqual(ring, expected, delta=0.02 * expected, msg="rad/s")
        self.assertNotEqual(ring, expected)
        del free, rolling

    def test_what_does_not_go_together_is_refused(self):
        for settings, words in ((("bearings.cage=free", "bearings.ball_model=inertial"), "ball_model"), (("bearings.TB1.cage=free", "bearings.TB1.cage_inertia=1 kg m2"), "ring_spin_inertia"),
                                (("bearings.TB1.cage=fre",), "\"rolling\", \"free\""), (("bearings.TB1.race_traction=-1",), "race_traction")):
            result = self.call("check", "reference.toml", *[word for setting in settings for word in ("--set", setting)])
            self.assertEqual(result.returncode, 2, settings)
            self.assertIn(words, result.stderr)


if __name__ == "__main__":
    unittest.main()

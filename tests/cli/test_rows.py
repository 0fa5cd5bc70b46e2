"""Rows of balls that carry different loads under thrust: their friction, their strips in the finite elements, their growth.

THRUST of 1500 N towards +x is carried by the row that leans to +x (row 2 of an X pair, which opens towards its middle); the other row loses most of its load, and with it
its friction torque z (P0/C0)^y P1 d_m and its contacts' conductance.
"""

import pathlib
import shutil
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, PROGRAM, ProgramTest, settings  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
BOTH = {"thermal__models": '["lumped", "fe"]', "run__end_time": "0.12 s"}


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class RowsUnderThrust(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-thrust.toml"):
            shutil.copy(PARAMS / name, self.folder)

    def drop(self, name, **keys):
        summary = self.run_case("neisi2019-thrust.toml", output=name, **{**BOTH, **keys})
        file = h5py.File(self.folder / name / "results.h5")
        self.addCleanup(file.close)
        return summary, file

    def test_each_rows_friction_heats_its_own_strips(self):
        # Balls that conduct nothing by rolling: what a strip shows is its own friction.
        summary, file = self.drop("out", thermal__contact_conduction="fixed")
        ledger = file["ledger/TB2"]
        rows = numpy.array([[ledger[f"row_{row}_{race}_heat"][-1] for race in ("inner", "outer")] for row in (1, 2)])
        for race, name in enumerate(("inner_heat", "outer_heat")):
            self.assertAlmostEqual(rows[:, race].sum() / ledger[name][-1], 1, delta=1e-12, msg="the rows' joules are the bearing's")
        # By the law from the recorded loads: z = 0.001, y = 0.33, C0 = 31 kN of one row (neisi2019.toml), X0 = 0.5, Y0 = 0.38; half the drag for each row.
        time, spin = file["time"][:], file["bearings/TB2/ring_speed"][:]
        self.assertGreater(rows[1].sum(), 1.15 * rows[0].sum(), "J: the drag is the same in both")
        load_torque, drag = file["bearings/TB2/load_torque"][:], file["bearings/TB2/drag_torque"][:]
        difference = numpy.trapezoid if hasattr(numpy, "trapezoid") else numpy.trapz
        drag_heat = difference(drag * numpy.tanh(spin / 2) * spin, time)
        load_heat = difference(load_torque * numpy.tanh(spin / 2) * spin, time)
        self.assertAlmostEqual((rows.sum() - drag_heat) / load_heat, 1, delta=0.02, msg="recorded every 50 us")
        loads = rows.sum(axis=1) - drag_heat / 2
        self.assertGreater(loads[1], 2 * loads[0])
        at = lambda path: file[f"fe/TB2/{path}"][:, 0] - 293.15
        for race in ("inner", "outer"):
            first, second, whole = at(f"{race}_raceway_row_1"), at(f"{race}_raceway_row_2"), at(f"{race}_raceway")
            self.assertGreater(second[-1], first[-1])
            numpy.testing.assert_allclose(whole, (first + second) / 2, rtol=0, atol=1e-9, err_msg="strips of equal area")
        for model in ("heat_residual", "fe_heat_residual"):
            self.assertLess(abs(summary["energy"][model]), 1e-10 * summary["energy"]["heat_deposited"], "J: what either model stores and loses is what both were given, but for the rounding of 293 K in every step")

    def test_rows_under_the_same_load_are_equally_warm(self):
        _, file = self.drop("even", rotor__axial_force='[["0 ms", "0 N"]]', bearings__row_phase="0", contact__friction_coefficient="0", run__end_time="20 ms", run__initial_speed="0 rpm")
        for race in ("inner", "outer"):
            first, second = (file[f"fe/TB2/{race}_raceway_row_{row}"][:, 0] for row in (1, 2))
            numpy.testing.assert_allclose(first, second, rtol=0, atol=1e-9)

    def test_modes_and_windows_agree_row_by_row(self):
        reduced, modes = self.drop("modes", thermal__contact_conduction="rolling")
        windowed, windows = self.drop("windows", thermal__contact_conduction="rolling", thermal__fe__coupling="windowed")
        times = windows["windows/time"][:] if "windows/time" in windows else windows["windows"]["time"][:]
        for race in ("inner", "outer"):
            for row in (1, 2):
                name = f"TB2/{race}_raceway_row_{row}"
                by_windows = windows[f"windows/{name}"][:, 0] - 293.15
                by_modes = numpy.interp(times, modes["time"][:], modes[f"fe/{name}"][:, 0]) - 293.15
                self.assertLess(abs(by_windows - by_modes)[-1], 0.03 * by_modes[-1], name)
        total = sum(windowed["bearings"][name][key] for name in ("TB1", "TB2") for key in ("friction_heat", "inner_heat", "outer_heat"))
        self.assertAlmostEqual(windowed["windows"]["heat_input"] / total, 1, delta=1e-10, msg="J: rows included")
        self.assertLess(abs(windowed["windows"]["heat_residual"]), 1e-9 * total)
        del reduced

    def test_row_growth_is_that_of_the_raceways_and_larger_where_the_load_is(self):
        _, file = self.drop("growth", thermal__contact_conduction="fixed")
        rows, growth = file["fe/TB2/row_growth"][:], file["fe/TB2/elastic_growth"][:]
        # Radial: the rows' mean is the raceways' growth. Axial: half their difference follows the rings' widths, at the contact points' distances.
        numpy.testing.assert_allclose(rows[:, [0, 2]].mean(axis=1), growth[:, 2] - growth[:, 3], rtol=0, atol=1e-15)
        half, side = 8e-3, 4.7625e-3 * numpy.sin(numpy.radians(25))
        spread = ((half - side) * growth[:, 5] - (half + side) * growth[:, 6]) / 32e-3
        numpy.testing.assert_allclose((rows[:, 3] - rows[:, 1]) / 2, spread, rtol=1e-3, atol=1e-13, err_msg="strips lie at their mean position, not at the nominal contact")
        numpy.testing.assert_allclose(rows[:, 2] - rows[:, 0], growth[:, 7], rtol=0, atol=1e-15, err_msg="the eighth surface, fed back where elasticity drives")
        self.assertGreater(abs(rows[-1, 2] - rows[-1, 0]), 1e-12)
        strips = [file[f"fe/TB2/inner_raceway_row_{row}"][-1, 0] for row in (1, 2)]
        self.assertEqual(rows[-1, 2] > rows[-1, 0], strips[1] > strips[0], "the warmer strip's row grows more")

    def test_rings_that_only_translate_have_no_rows_apart(self):
        self.run_case("reference.toml", output="locked", thermal__models='["lumped", "fe"]', run__end_time="1 ms")
        with h5py.File(self.folder / "locked/results.h5") as file:
            self.assertFalse([name for name in file["ledger/TB2"] if name.startswith("row_")])
            self.assertFalse([name for name in file["fe/TB2"] if "_row_" in name])


if __name__ == "__main__":
    unittest.main()

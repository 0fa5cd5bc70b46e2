"""examples/rotordrop_results.py and the tour that uses it, against the files as h5py and json read them."""

import inspect
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, SOURCE, ProgramTest  # noqa: E402

sys.path.insert(0, str(SOURCE / "examples"))
import rotordrop_results  # noqa: E402
from rotordrop_results import RISE, TEMPERATURE, Results, Series, read_vtu  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
TOUR = SOURCE / "examples/read_results.py"


class Reader(ProgramTest):
    """12 ms of the reference case, made once."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        maker = cls("make")
        ProgramTest.setUp(maker)
        cls.maker = maker
        more = 'thermal.models = ["lumped", "fe"]\nthermal.fe.section = "plain"\nthermal.fe.field_times = ["10 ms"]\n' if HAS_ROOM else ""
        maker.write("drop.toml", 'base = "reference.toml"\nrun.end_time = "12 ms"\n' + more)
        maker.succeed("run", "drop.toml", "-o", "out", "--quiet")
        cls.out = maker.folder / "out"
        cls.run_ = Results(cls.out)
        cls.file = h5py.File(cls.out / "results.h5")

    @classmethod
    def tearDownClass(cls):
        cls.run_.close()
        cls.file.close()
        cls.maker.doCleanups()
        super().tearDownClass()

    def make(self):
        pass

    def test_series_have_time_values_unit_and_columns(self):
        orbit = self.run_.bearing("TB1")["orbit"]
        np.testing.assert_array_equal(orbit.values, self.file["/bearings/TB1/orbit"][:])
        np.testing.assert_array_equal(orbit.time, self.file["/time"][:])
        self.assertEqual((orbit.unit, orbit.columns, orbit.path), ("m", ("y", "z"), "/bearings/TB1/orbit"))
        self.assertIn("rotor", orbit.meaning)
        np.testing.assert_array_equal(orbit.column("z").values, self.file["/bearings/TB1/orbit"][:, 1])
        loads = self.run_.bearing("TB1")["ball_loads"]
        self.assertEqual(loads.values.shape, (len(self.file["/detail/time"]), 14), "at times of their own")
        np.testing.assert_array_equal(loads.time, self.file["/detail/time"][:])

    def test_every_series_of_the_file_can_be_read(self):
        self.assertGreater(len(self.run_.paths), 80)
        for path in self.run_.paths:
            series = self.run_.series(path)
            self.assertEqual(len(series.time), len(series.values), path)
            self.assertTrue(series.unit, path)

    def test_integrals_and_interpolation(self):
        force = Series(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0, 4.0]), "N", (), "", "")
        self.assertEqual(force.integral(), 1.0 + 6.0)
        np.testing.assert_allclose(force.at([-1.0, 0.5, 2.0, 9.0]), [0.0, 1.0, 3.0, 4.0])
        pair = Series(force.time, np.array([[0.0, 1.0], [2.0, 1.0], [4.0, 1.0]]), "N", ("y", "z"), "", "")
        np.testing.assert_allclose(pair.integral(), [7.0, 3.0])
        np.testing.assert_allclose(pair.at(2.0), [3.0, 1.0])
        np.testing.assert_array_equal(force.between(0.5, 3.0).values, [2.0, 4.0])
        impulse = self.run_.series("/ledger/TB1/contact_impulse")
        # The ledger is exact; trapezoids over 50 us of an impact of 3 ms.
        self.assertAlmostEqual(self.run_.bearing("TB1")["contact_force"].integral(), impulse.values[-1], delta=0.01 * impulse.values[-1])

    def test_groups_list_what_they_have(self):
        group = self.run_.bearing("TB2")
        self.assertEqual(set(group), set(self.file["/bearings/TB2"]))
        self.assertIn("ring_speed", group)
        self.assertNotIn("snubber", group)
        self.assertEqual(self.run_.bearings, ["TB1", "TB2"])

    def test_summary_and_parameters(self):
        self.assertEqual(self.run_.summary, json.loads((self.out / "summary.json").read_text()))
        self.assertEqual(self.run_.parameters["contact"]["air_gap"], "250 um")

    def test_what_is_not_there_is_named(self):
        for action, words in ((lambda: self.run_.series("/bearings/TB1/contact_farce"), "there is no|has no /bearings/TB1/contact_farce; there is /bearings/TB1/"), (lambda: self.run_.bearing("TB3"), "known: TB1, TB2"),
                              (lambda: self.run_.bearing("TB1")["orbit"].column("x"), "known: y, z"), (lambda: self.run_.temperatures("TB1", "wall"), "no temperatures of TB1 by model 'wall'")):
            with self.assertRaisesRegex(KeyError, words):
                action()
        with self.assertRaisesRegex(FileNotFoundError, "results.h5"):
            Results(self.folder)

    def test_without_a_summary_it_is_none(self):
        shutil.copytree(self.out, self.folder / "copy")
        (self.folder / "copy/summary.json").unlink()
        with Results(self.folder / "copy") as run:
            self.assertIsNone(run.summary)
            self.assertEqual(len(run.series("/time").values), len(self.file["/time"]))

    @unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
    def test_fields_agree_with_the_surfaces_of_the_results(self):
        (start, first), (time, file) = self.run_.fields("TB1")
        self.assertEqual((start, time), (0.0, 0.01))
        field = read_vtu(file)
        bore = self.run_.temperatures("TB1", "fe")["bore"]
        self.assertEqual(bore.columns[:3], ("mean", "lowest", "highest"))
        on_bore = abs(field["points"][:, 1] - 0.035) < 1e-7
        # Recorded every 50 us, so at 10 ms too; the file has single precision.
        self.assertAlmostEqual(field["data"][TEMPERATURE][on_bore].max(), bore.column("highest").at(0.01), delta=1e-3)
        self.assertEqual(abs(read_vtu(first)["data"][RISE]).max(), 0)
        self.assertEqual(self.run_.fields("TB9"), [])

    def test_everything_public_is_explained(self):
        for name, item in [*vars(rotordrop_results).items(), *vars(Results).items(), *vars(Series).items()]:
            if not name.startswith("_") and (inspect.isfunction(item) or (inspect.isclass(item) and item.__module__ == "rotordrop_results")) and name != "close":
                self.assertTrue(inspect.getdoc(item), name)

    def test_the_tour_runs_and_its_numbers_are_the_files(self):
        copy = self.folder / "out"
        shutil.copytree(self.out, copy)
        done = subprocess.run([sys.executable, TOUR, copy], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        force = self.file["/bearings/TB1/contact_force"][:]
        self.assertIn(f"largest {force.max():.1f} N", done.stdout)
        self.assertIn(f"{self.file['/energy/dissipated'][-1]:.2f} J dissipated", done.stdout)
        summary = self.run_.summary["bearings"]["TB1"]
        begins, ends = (float(word) for word in done.stdout.split("first impact of TB1: ")[1].split(" ms")[0].split(" to "))
        self.assertAlmostEqual(begins, 1e3 * summary["first_contact_time"], delta=0.06, msg="rows are 0.05 ms apart")
        self.assertAlmostEqual(ends, 1e3 * summary["first_contact_end"], delta=0.06)
        for name in ("orbits", "speeds"):
            self.assertGreater((copy / f"figures/tour/{name}.png").stat().st_size, 5000)
        self.assertGreater(TOUR.read_text().count("\n# %% "), 6, "in steps")

    def test_the_lines_of_the_examples_readme_run(self):
        (block,) = re.findall(r"```python\n(.*?)```", (SOURCE / "examples/README.md").read_text(encoding="utf-8"), re.S)
        for case in ("neisi2019", "neisi2019-settling"):
            shutil.copytree(self.out, self.folder / "out" / case)
        environment = os.environ | {"PYTHONPATH": str(SOURCE / "examples"), "MPLBACKEND": "Agg"}
        done = subprocess.run([sys.executable, "-c", block], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "out/orbits.png").is_file())

    def test_the_tour_passes_over_supports_that_are_no_touchdown_bearings(self):
        magnet = 'bearings.A_magnet = { type = "magnet", node = 6, stiffness = [["1e7 N/m", 0], [0, "1e7 N/m"]], release_time = ["1 ms", "1 ms"] }\n'
        self.write("held.toml", 'base = "reference.toml"\nrun.end_time = "12 ms"\n' + magnet)
        self.succeed("run", "held.toml", "-o", "held", "--quiet")
        done = subprocess.run([sys.executable, TOUR, self.folder / "held"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("A_magnet", done.stdout)
        self.assertRegex(done.stdout, r"first impact of TB1: \d+\.\d+ to")

    def test_the_tour_says_what_is_missing(self):
        done = subprocess.run([sys.executable, TOUR, self.folder / "nothing"], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("error: there is no", done.stderr)


if __name__ == "__main__":
    unittest.main()

"""Results as other programs read them: series in Octave, which stands for MATLAB's load, and fields in VTK, which ParaView is built on.

Skipped where octave-cli or vtk is not installed, and fields where the program has no finite elements."""

import importlib.util
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HEATED_DISC, PROGRAM, ProgramTest, start  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()

FIELDS = """
output_times = ["1 ms", "10 ms"]
field_times = ["1 ms", "10 ms"]
""" + HEATED_DISC


@unittest.skipUnless(shutil.which("octave-cli"), "octave-cli is not installed")
class Octave(ProgramTest):
    def octave(self, script):
        done = subprocess.run(["octave-cli", "--norc", "--no-window-system", "--eval", script], cwd=self.folder, capture_output=True, text=True, timeout=120)
        complaints = [line for line in done.stderr.splitlines() if "while preparing to exit" not in line]  # Octave's own, with any script
        self.assertEqual((done.returncode, complaints), (0, []))
        return done.stdout

    def test_it_loads_every_series_with_the_rows_reversed_as_matlab_has_them(self):
        self.run_case("reference.toml", run__end_time="10 ms")
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            names = []
            file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and name not in ("parameters", "given") else None)
            self.assertGreater(len(names), 50)
            # A name that is no identifier of Octave gets one: spin-up becomes spin_up.
            script = "s = load('out/results.h5'); function put(x), printf('%d %d', size(x)); printf(' %.17g', x); printf('\\n'); end\n"
            script += "".join(f"put(s.{name.replace('/', '.').replace('-', '_')});\n" for name in names) + "printf('%s', s.parameters);"
            rows = self.octave(script).split("\n", len(names))
            for name, row in zip(names, rows):
                here = np.array(file[name])
                size, values = row.split()[:2], np.array([float(word) for word in row.split()[2:]])
                # HDF5's last dimension varies fastest, Octave's and MATLAB's the first: [n, rows] comes as rows x n.
                expected = here.shape[::-1] if here.ndim == 2 else (here.size, 1)
                self.assertIn(tuple(map(int, size)), (expected, expected[::-1] if here.ndim == 1 else expected), name)
                np.testing.assert_array_equal(values, here.ravel(), err_msg=name)
            self.assertEqual(rows[-1].rstrip("\0"), (self.folder / "out/parameters.toml").read_text())

    def test_it_loads_a_run_that_goes_on_and_one_that_was_killed(self):
        # Every step takes long, so that the run is not over while Octave starts. Rows so far apart that the file stays below the 4 MB it begins with: once a
        # file grows beyond the length that it had when Octave opened it, Octave cannot read what was added, and says so.
        run = start("run", "reference.toml", "-o", "out", "--set", 'rotor.model="full"', "--set", "integration.tolerance=1e-11", "--set", "output.interval=0.5 ms", cwd=self.folder)
        try:
            file = self.folder / "out/results.h5"
            for _ in range(600):
                if file.is_file() and run.poll() is None:
                    with h5py.File(file, "r") as results:
                        if len(results["time"]) > 20:
                            break
                time.sleep(0.1)
            script = "s = load('out/results.h5'); printf('%d ', size(s.bearings.TB1.orbit), numel(s.time), numel(s.detail.time), size(s.bearings.TB1.ball_loads));"
            sizes = self.octave(script)
            self.assertIsNone(run.poll(), "it goes on")
        finally:
            run.kill()
            run.communicate()
        columns, rows, times, details, balls, loads = map(int, sizes.split())
        self.assertGreater(times, 20)
        self.assertEqual((columns, balls), (2, 14))
        self.assertLessEqual(abs(rows - times), 200, "written meanwhile")
        sizes = list(map(int, self.octave(script).split()))
        with h5py.File(self.folder / "out/results.h5", "r") as results:
            n, m = len(results["time"]), len(results["detail/time"])
        self.assertEqual(sizes, [2, n, n, m, 14, m])
        self.assertGreaterEqual(n, times)

    def test_shapes_do_not_depend_on_the_number_of_rows(self):
        self.run_case("reference.toml", run__end_time="10 us")
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            self.assertEqual(file["detail/time"].shape + (14,), file["bearings/TB1/ball_loads"].shape)
            self.assertEqual(file["time"].shape + (2,), file["bearings/TB1/orbit"].shape)


@unittest.skipUnless(importlib.util.find_spec("vtk"), "vtk is not installed")
@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class Vtk(ProgramTest):
    def test_it_opens_the_fields_and_finds_the_mesh_and_the_temperatures(self):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy

        self.write("heat.toml", FIELDS)
        self.succeed("heat", "heat.toml", "-o", "out")
        files = sorted((self.folder / "out").rglob("*.vtu"))
        self.assertGreaterEqual(len(files), 2)
        highest = []
        for path in files:
            reader = vtk.vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(path))
            reader.Update()
            grid = reader.GetOutput()
            self.assertGreater(grid.GetNumberOfCells(), 0)
            x_min, x_max, r_min, r_max, _, _ = grid.GetBounds()
            np.testing.assert_allclose([x_min, x_max, r_min, r_max], [0, 0.01, 0.01, 0.02], atol=1e-9)  # coordinates are stored as single precision
            arrays = [grid.GetPointData().GetArrayName(k) for k in range(grid.GetPointData().GetNumberOfArrays())]
            name = next(name for name in arrays if "temperature" in name.lower())
            temperature = vtk_to_numpy(grid.GetPointData().GetArray(name))
            self.assertEqual(len(temperature), grid.GetNumberOfPoints())
            highest.append(temperature.max())
        # The rim of a half-space under 1 MW/m2 rises by 2 q sqrt(t / (pi k rho c)), k 70, rho c 7800 * 510: 2.1 K after 1 ms, 6.8 K after 10 ms.
        rise = [2e6 * (t / (np.pi * 70 * 7800 * 510)) ** 0.5 for t in (1e-3, 1e-2)]
        start = 293.15
        self.assertLess(abs(max(highest) - start - rise[1]), 0.1 * rise[1])  # the disc is no half-space: 3 mm of penetration in 10 mm


if __name__ == "__main__":
    unittest.main()

"""examples/in-memory: two drops in two threads, from text to numbers. It must find what `rotordrop run` finds, and write no file."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from program import PROGRAM, SOURCE  # noqa: E402

EXAMPLE = pathlib.Path(PROGRAM).parent / "example_in_memory"
CASE = """base = "{params}/neisi2019-settling.toml"
[run]
end_time = "20 ms"
initial_speed = "{speed}"
[thermal]
models = ["lumped", "fe"]
[thermal.fe]
section = "plain"
degree = 1
refinement = 0.5
"""
LINE = re.compile(r"(\d+ rpm): peak force ([\d.]+) N at ([\d.]+) ms, largest of (\d+) rows ([\d.]+) N; "
                  r"inner ring (\S+) K and bore (\S+) nm apart; energy residual (\S+) J")


@unittest.skipUnless(EXAMPLE.exists(), "built without finite elements")
class InMemory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.empty = pathlib.Path(cls.folder.name) / "empty"
        cls.empty.mkdir()
        cls.environment = dict(os.environ, ROTORDROP_CACHE="off", HOME=str(cls.empty), TMPDIR=str(cls.empty))
        cls.run_of_example = subprocess.run([EXAMPLE, SOURCE / "params"], cwd=cls.empty, env=cls.environment, capture_output=True, text=True, timeout=300)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_writes_no_file(self):
        self.assertEqual(self.run_of_example.returncode, 0, self.run_of_example.stderr)
        self.assertEqual(list(self.empty.rglob("*")), [])

    def test_both_threads_find_what_a_run_into_a_folder_finds(self):
        lines = [LINE.fullmatch(line) for line in self.run_of_example.stdout.splitlines()]
        self.assertEqual([line and line[1] for line in lines], ["15200 rpm", "7600 rpm"], self.run_of_example.stdout)
        for line in lines:
            case = pathlib.Path(self.folder.name) / f"drop-{line[1][:-4]}.toml"
            case.write_text(CASE.format(params=SOURCE / "params", speed=line[1]), encoding="utf-8")
            results = case.with_suffix("")
            subprocess.run([PROGRAM, "run", case, "-o", results, "--quiet"], env=self.environment, check=True, capture_output=True, timeout=300)
            summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
            tb1 = summary["bearings"]["TB1"]
            self.assertEqual(line[2], f"{tb1['peak_contact_force']:.6f}", "to every digit that it prints")
            self.assertEqual(line[3], f"{tb1['peak_contact_force_time'] * 1e3:.4f}")
            with h5py.File(results / "results.h5") as file:
                self.assertEqual(int(line[4]), len(file["/time"]))
                self.assertEqual(line[5], f"{file['/bearings/TB1/contact_force'][:].max():.6f}")
                rise = file["/fe/TB1/inner_ring"][:] - file["/thermal/TB1/inner_ring"][:]
                growth = file["/growth/fe/TB1"][:, 1] - file["/growth/lumped/TB1"][:, 1]
            # Six digits are printed.
            self.assertAlmostEqual(float(line[6]) / rise[np.abs(rise).argmax()], 1, delta=1e-5)
            self.assertAlmostEqual(float(line[7]) * 1e-9 / growth[np.abs(growth).argmax()], 1, delta=1e-5)
            self.assertLess(abs(float(line[8])), 1e-3 * summary["energy"]["dissipated"])

    def test_bad_text_is_told_with_its_line(self):
        result = subprocess.run([EXAMPLE, self.empty], cwd=self.empty, env=self.environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertIn("case.toml:1:", result.stderr)
        self.assertIn("neisi2019-settling.toml", result.stderr)


if __name__ == "__main__":
    unittest.main()

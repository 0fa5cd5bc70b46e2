"""Key scalars of the settling reference case, each with a tolerance of its own and the reason for it (settling-case.json).

The expected values are those of an independent program with a step of 1.25 us, not of this one. The rotor settles without chaos, so that the two can agree far better
than the 2e-3 of test_reference_cases.py: whatever moves a result of this case by more than the error of time integration is found here.
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("ROTORDROP_PROGRAM", str(ROOT / "build/release/rotordrop"))
EXPECTED = json.loads((ROOT / "tests/regression/settling-case.json").read_text(encoding="utf-8"))


class SettlingCase(unittest.TestCase):
    def test_key_scalars_stay_where_they_are(self):
        with tempfile.TemporaryDirectory() as scratch:
            subprocess.run([PROGRAM, "run", str(ROOT / EXPECTED["case"]), "-o", scratch, "--quiet"], check=True)
            summary = json.loads((pathlib.Path(scratch) / "summary.json").read_text())
        self.assertGreater(len(EXPECTED["scalars"]), 10)
        for scalar in EXPECTED["scalars"]:
            value = summary
            for key in scalar["scalar"].split("."):
                value = value[key]
            with self.subTest(scalar["scalar"]):
                self.assertTrue(scalar["reason"])
                self.assertAlmostEqual(value, scalar["expected"], delta=scalar["tolerance"], msg=f"{scalar['unit']}; {scalar['reason']}")


if __name__ == "__main__":
    unittest.main()

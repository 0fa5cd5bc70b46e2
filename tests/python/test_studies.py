"""Studies from Python: the same bits as the program, ended by an exception and resumed, faults of their points."""

import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from package import SETTLING, PackageTest, rd  # noqa: E402
from program import call  # noqa: E402

STUDY = """
lanes = false
case = "{case}"
[vary]
contact.friction_coefficient = {{ range = [0.05, 0.3] }}
[design]
kind = "latin-hypercube"
size = {n}
[limits]
"bearings.*.peak_contact_force" = {{ max = "5 kN" }}
"""


class Studies(PackageTest):
    def write(self, n=6):
        file = self.folder / "s.toml"
        file.write_text(STUDY.format(case=SETTLING, n=n))
        return file

    def bytes_of(self, name):
        return [(self.folder / name / file).read_bytes() for file in ("study.h5", "study.csv")]

    def test_the_same_bits_as_the_program(self):
        file = self.write()
        done = call("study", file, "-o", self.folder / "program", "--quiet", "--set", "run.end_time=10 ms")
        self.assertEqual(done.returncode, 0, done.stderr)
        seen = []
        result = rd.study(file, self.folder / "python", {"run.end_time": "10 ms"}, jobs=2, progress=seen.append)
        self.assertEqual(self.bytes_of("python"), self.bytes_of("program"))
        self.assertEqual((seen[-1].done, seen[-1].total), (6, 6))
        self.assertEqual(len(result.table), 6)
        self.assertTrue((result.table["status"] == 0).all())
        self.assertTrue(result.table["contact.friction_coefficient"].between(0.05, 0.3).all())
        # A single drop of the study, from Python.
        point = result.table.iloc[3]
        drop = rd.Case(SETTLING, {"run.end_time": "10 ms", "contact.friction_coefficient": point["contact.friction_coefficient"]}).run(keep=[])
        self.assertEqual(drop.summary["bearings"]["TB1"]["peak_contact_force"], point["bearings.TB1.peak_contact_force"])
        again = rd.read_study(self.folder / "python")
        self.assertEqual(again.summary, result.summary)
        self.assertIn("<html", result.report().read_text(encoding="utf-8"))

    def test_an_exception_of_the_caller_ends_it_and_it_is_resumed(self):
        file, overrides = self.write(40), {"run.end_time": "0.1 s"}

        def stop(progress):
            if progress.done > 0:
                raise InterruptedError("enough")

        with self.assertRaisesRegex(InterruptedError, "enough"):
            rd.study(file, self.folder / "out", overrides, jobs=1, progress=stop)
        self.assertFalse((self.folder / "out/study.json").exists())
        with self.assertRaises(FileNotFoundError):
            rd.read_study(self.folder / "out")
        first = []
        result = rd.study(file, self.folder / "out", overrides, resume=True, progress=first.append)
        self.assertGreater(first[0].done, 0)
        self.assertEqual(len(result.table), 40)

    def test_faults(self):
        file = self.write()
        with self.assertRaises(rd.InputError) as caught:
            rd.study(file, self.folder / "out", {"contact.air_gpa": 1e-4})
        self.assertIn("air_gap", str(caught.exception))
        file.write_text(file.read_text().replace("0.3]", "30]"))
        with self.assertRaises(rd.InputError) as caught:
            rd.study(file, self.folder / "out")
        self.assertIn("no valid case", str(caught.exception))


if __name__ == "__main__":
    unittest.main()

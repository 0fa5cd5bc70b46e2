"""Studies from Python: the same bits as the program, ended by an exception and resumed, faults of their points."""

import shutil
import signal
import subprocess
import sys
import time
import unittest
import warnings

import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from package import PACKAGE, PARAMS, SETTLING, PackageTest, rd  # noqa: E402
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
                rd.StudyResult(self.folder / "out").report()
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
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        self.assertEqual(result.report().read_text(encoding="utf-8"), page, "it shows the complete study")

    def test_faults(self):
        file = self.write()
        with self.assertRaises(rd.InputError) as caught:
            rd.study(file, self.folder / "out", {"contact.air_gpa": 1e-4})
        self.assertIn("air_gap", str(caught.exception))
        file.write_text(file.read_text().replace("0.3]", "30]"))
        with self.assertRaises(rd.InputError) as caught:
            rd.study(file, self.folder / "out")
        self.assertIn("no valid case", str(caught.exception))
        for arguments, words in (({"jobs": 1.5}, "jobs: must be a whole number and is 1.5"), ({"jobs": -1}, "jobs: must be at least 0"), ({"overrides": {"run.until": None}}, "overrides: run.until is None")):
            with self.assertRaisesRegex(rd.InputError, words):
                rd.study(file, self.folder / "never", **arguments)
        with self.assertRaisesRegex(rd.InputError, "directory: is empty"):
            rd.study(file, "")
        for damaged in ("", '{"program": "rotordr', "[]", "{}"):
            (self.folder / "study.json").write_text(damaged)
            with self.subTest(damaged), self.assertRaisesRegex(rd.InputError, "study.json: this is not what the program wrote"):
                rd.read_study(self.folder)

    def test_overrides_are_what_a_case_takes(self):
        file = self.write(2)
        own = self.folder / "grüße 😀.json"
        shutil.copy(PARAMS / "neisi2019-rotor.json", own)
        overrides = {
            "title": "a \\ and 😀",
            "run": {"end_time": "8 ms"},
            "rotor": {"geometry": own, "unbalance": [{"node": 5, "me": 1e-6}]},
            "contact.exponent": numpy.float64(10 / 9),
        }
        result = rd.study(file, self.folder / "out", overrides)
        self.assertEqual(result.summary["done"], 2)
        self.assertIn("a \\\\ and 😀", (self.folder / "out/case.toml").read_text(encoding="utf-8"))

    def test_what_is_varied_is_not_overridden_as_well(self):
        with self.assertRaisesRegex(rd.InputError, "the study varies contact.friction_coefficient"):
            rd.study(self.write(2), self.folder / "out", {"contact.friction_coefficient": 0.2})

    def test_a_warning_that_is_an_error_comes_before_the_drops(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", rd.CaseWarning)
            with self.assertRaisesRegex(rd.CaseWarning, "run.ambient"):
                rd.study(self.write(2), self.folder / "out", {"run.ambient": "700 K"}, progress=lambda _: self.fail("it ran"))
        self.assertFalse((self.folder / "out").exists())

    def test_what_points_have_that_is_unusual_is_warned_of_before_the_drops(self):
        file = self.write(2)
        file.write_text(file.read_text().replace("[design]", "run.ambient = [70, 300]\n[design]"))
        with warnings.catch_warnings():
            warnings.simplefilter("error", rd.CaseWarning)
            with self.assertRaisesRegex(rd.CaseWarning, r"run\.ambient: 1 of 2 points: run\.ambient = 70 K is unusual"):
                rd.study(file, self.folder / "out", progress=lambda _: self.fail("it ran"))
        self.assertFalse((self.folder / "out").exists())
        with self.assertWarnsRegex(rd.CaseWarning, "1 of 2 points"):
            rd.study(file, self.folder / "out", {"run.end_time": "2 ms"})

    def test_what_the_case_has_that_is_unusual_is_warned_of_and_notes_are_kept(self):
        file = self.write(2)
        file.write_text(file.read_text().replace("lanes = false", "lanes = true"))
        with self.assertWarnsRegex(rd.CaseWarning, "run.ambient"):
            result = rd.study(file, self.folder / "out", {"run.end_time": "2 ms", "run.ambient": "700 K", "integration.method": "dormand-prince"})
        self.assertRegex(" ".join(result.notes), "lanes = true, but these drops run one by one")
        self.assertEqual(rd.read_study(self.folder / "out").notes, ())

    def test_a_page_of_the_users_is_left_alone(self):
        result = rd.study(self.write(2), self.folder / "out", {"run.end_time": "2 ms"})
        page = self.folder / "out/report.html"
        page.write_text("my notes")
        with self.assertRaisesRegex(rd.InputError, "no page of the program"):
            result.report()
        drop = rd.Case(SETTLING, {"run.end_time": "2 ms"}).run(self.folder / "drop")
        with self.assertRaisesRegex(rd.InputError, "no page of the program"):
            drop.report(page)
        self.assertEqual(page.read_text(), "my notes")
        page.unlink()
        result.report()
        result.report()

    def test_ctrl_c_ends_the_checking_of_points(self):
        file = self.write(200000)
        script = f"import sys; sys.path.insert(0, {str(PACKAGE)!r}); import rotordrop as rd; print('on', flush=True); rd.study({str(file)!r}, {str(self.folder / 'out')!r})"
        running = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(running.stdout.readline(), "on\n")
        time.sleep(1)  # checking all takes a minute and more
        running.send_signal(signal.SIGINT)
        _, told = running.communicate(timeout=30)
        self.assertIn("KeyboardInterrupt", told)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()

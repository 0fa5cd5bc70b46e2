"""Surrogates of a study on the command line: what is shown and stopped while they are made, and what the report takes of them."""

import json
import os
import pathlib
import pty
import re
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HAS_SURROGATES, PROGRAM, ProgramTest, page_data  # noqa: E402

STUDY = """
case = "reference.toml"
[vary]
contact.friction_coefficient = { range = [0.05, 0.3] }
contact.air_gap = { range = ["200 um", "300 um"] }
[design]
kind = "latin-hypercube"
size = 200
[surrogate]
results = ["bearings.TB1.first_contact_time"]
kind = "kriging"
folds = 20
"""
ARGUMENTS = ("study", "study.toml", "-o", "out", "--set", "run.end_time=8 ms")


@unittest.skipUnless(HAS_SURROGATES, "built without OpenTURNS")
class Surrogates(ProgramTest):
    def on_a_terminal_until(self, pattern, sign):
        """Sends a signal when the moving line has matched; the exit code and all that was shown."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen([PROGRAM, *ARGUMENTS], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs)
        self.addCleanup(process.kill)
        os.close(theirs)
        shown = ""
        is_sent = False
        while True:
            try:
                piece = os.read(ours, 65536)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            shown += piece.decode()
            if not is_sent and re.search(pattern, shown):
                process.send_signal(sign)
                is_sent = True
        os.close(ours)
        self.assertTrue(is_sent, shown)
        return process.wait(), shown

    def test_their_making_is_shown_stopped_and_resumed(self):
        self.write("study.toml", STUDY)
        code, shown = self.on_a_terminal_until(r"surrogate 1 of 1, bearings\.TB1\.first_contact_time: validation 2 of 20", signal.SIGINT)
        self.assertEqual(code, 130, shown)
        self.assertIn("200 of 200 drops, 0 failed  |  surrogate 1 of 1, bearings.TB1.first_contact_time: all points", shown)
        self.assertNotIn("validation 20 of 20", shown)
        self.assertIn("interrupted after 200 drops", shown)
        for file in ("study.json", "study.h5", "study.csv"):
            self.assertFalse((self.folder / "out" / file).exists(), file)
        journal = self.folder / "out/study.journal"
        before = journal.read_bytes()
        self.succeed(*ARGUMENTS, "--resume")
        self.assertEqual(journal.read_bytes(), before, "no drop was computed again")
        surrogate = json.loads((self.folder / "out/study.json").read_text())["surrogate"]["results"]["bearings.TB1.first_contact_time"]
        # A free fall over the air gap, sqrt(2 gap / g), which one parameter tells.
        self.assertGreater(surrogate["q2"], 0.999)

    def test_the_report_takes_them_from_the_studys_answers(self):
        self.write("study.toml", STUDY.replace("200\n", "40\n"))
        self.succeed(*ARGUMENTS)
        answers = pathlib.Path(self.folder / "out/study.json")
        text = answers.read_text()
        told = json.loads(text)["surrogate"]["results"]["bearings.TB1.first_contact_time"]["q2"]
        answers.write_text(text.replace(f'"q2": {told}', '"q2": 0.125'))
        self.succeed("study", "report", "out")
        page = page_data((self.folder / "out/report.html").read_text())
        self.assertEqual(page["surrogate"]["results"]["bearings.TB1.first_contact_time"]["q2"], 0.125)
        # Answers of other drops are none of this report's.
        answers.write_text(answers.read_text().replace('"done": 40', '"done": 39'))
        self.succeed("study", "report", "out", "--force")
        page = page_data((self.folder / "out/report.html").read_text())
        self.assertAlmostEqual(page["surrogate"]["results"]["bearings.TB1.first_contact_time"]["q2"], told, delta=1e-9)


if __name__ == "__main__":
    unittest.main()

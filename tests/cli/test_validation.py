"""validation/run: its cases against the program, and a short study from end to end.

ROTORDROP_PROGRAM is the program under test."""

import base64
import html.parser
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, SOURCE as ROOT  # noqa: E402

sys.path.insert(0, str(ROOT / "validation"))
from chapters import cases, figures, statements, verdicts  # noqa: E402

PLAN = cases.Plan(ROOT / "validation/cases.toml")
STATEMENTS = statements.read(ROOT / "validation/paper-figures.toml")


class Cases(unittest.TestCase):
    def test_every_case_is_a_case_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            # A case that sets nothing new to a value not seen before tells nothing new.
            seen = set()
            for case in PLAN.cases.values():
                new = {(k, json.dumps(v)) for k, v in case.settings.items()} - seen
                if not new:
                    continue
                seen |= new
                file = pathlib.Path(folder) / "case.toml"
                file.write_text(cases.case_text(ROOT / PLAN.base, case.settings))
                done = subprocess.run([PROGRAM, "check", file], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{case.name}: {done.stderr}")


class Links(html.parser.HTMLParser):
    """Collects what a page would load, its links and its identifiers."""

    def __init__(self):
        super().__init__()
        self.sources, self.links, self.ids, self.tags = [], [], set(), set()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.add(tag)
        self.sources += [attributes[k] for k in ("src", "srcset", "data", "poster") if k in attributes]
        self.links += [attributes["href"]] if "href" in attributes else []
        self.ids |= {attributes["id"]} if "id" in attributes else set()


class EndToEnd(unittest.TestCase):
    """validation/run on a short study: six cases and one variant, until 12 ms."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="rotordrop-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        text = (ROOT / "validation/cases.toml").read_text()
        head = text.split("[variant.")[0]
        kept = text[text.index("[variant.preload-high]"):text.index("[variant.inertia-low]")]
        others = text[text.index("[variant.letter-"):]
        needed = '[variant.damping-table]\nunknown = "damping"\nsays = "no damping"\nset = { "rotor.mass_proportional_alpha" = 0 }\n[variant.conductivity]\nunknown = "conductivity of steel"\nsays = "44"\nset = { "materials.steel.k" = 44 }\n'
        (cls.folder / "cases.toml").write_text(head.replace('base = "params/neisi2019-settling.toml"', f'base = "{cls.folder}/short.toml"') + kept + needed + others)
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-rotor.json"):
            shutil.copy(ROOT / "params" / name, cls.folder)
        (cls.folder / "short.toml").write_text('base = "neisi2019-settling.toml"\nrun.end_time = "12 ms"\n')
        cls.done = cls.run_it("--only", "paper")
        cls.out = cls.folder / "out"

    @classmethod
    def run_it(cls, *arguments):
        command = [sys.executable, ROOT / "validation/run", "--program", PROGRAM, "--cases", cls.folder / "cases.toml", "-o", cls.folder / "out", *arguments]
        return subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=100)

    def test_it_ends_well_and_says_what_it_did(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertRegex(self.done.stdout, r"computed  ideal\b")
        self.assertIn("Report:", self.done.stdout)

    def test_every_claim_has_its_number_and_verdict(self):
        data = json.loads((self.out / "validation.json").read_text())
        self.assertEqual([s["figure"] for s in data["statements"]], [s.figure for s in STATEMENTS])
        for ours, theirs in zip(data["statements"], STATEMENTS):
            self.assertEqual([c["id"] for c in ours["claims"]], [c.id for c in theirs.claims])
            for claim in ours["claims"]:
                self.assertIn(claim["verdict"], verdicts.VERDICTS)
                self.assertTrue(claim["reason"])
        # Falls 250 um and hits at 8.7 ms: the peak belongs to these 12 ms, whatever else is cut off.
        peak = next(c for s in data["statements"] for c in s["claims"] if c["id"] == "12.first-peak")
        summaries = [json.loads(f.read_text()) for f in self.out.glob("runs/*/run/summary.json")]
        self.assertIn(peak["ours"], [s["bearings"]["TB2"]["peak_contact_force"] for s in summaries])

    def test_the_page_has_every_figure_and_needs_no_network(self):
        text = (self.out / "report.html").read_text()
        reader = Links()
        reader.feed(text)
        for figure in figures.FIGURES:
            self.assertIn(f"picture-{figure}", reader.ids)
        self.assertEqual(len(reader.sources), len(figures.FIGURES))
        for source in reader.sources:
            self.assertTrue(source.startswith("data:image/png;base64,"), source[:60])
            picture = matplotlib.image.imread(io.BytesIO(base64.b64decode(source.partition(",")[2])))[..., :3]
            # Axes, grid and text are grey; the curves are not. The shortest, an orbit's straight fall, has 89 coloured points.
            self.assertGreater((numpy.ptp(picture, axis=2) > 0.2).sum(), 50)
        for link in reader.links:
            self.assertTrue(link.startswith("#") and link[1:] in reader.ids, link)
        self.assertFalse(reader.tags & {"script", "link", "iframe"})
        self.assertNotRegex(re.sub(r"base64,[^\"]*", "", text), r"https?:|url\(|@import")

    def test_a_second_time_nothing_is_computed(self):
        before = json.loads((self.out / "validation.json").read_text())
        done = self.run_it("--only", "paper")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("0 computed", done.stdout)
        self.assertEqual(before["statements"], json.loads((self.out / "validation.json").read_text())["statements"])


class Options(unittest.TestCase):
    def call(self, *arguments):
        return subprocess.run([sys.executable, str(ROOT / "validation/run"), *arguments], capture_output=True, text=True)

    def test_an_unknown_chapter_is_refused_with_what_there_is(self):
        done = self.call("--only", "99", "--program", str(PROGRAM))
        self.assertEqual(done.returncode, 2)
        self.assertIn("verification", done.stderr)

    def test_documents_need_the_whole_report(self):
        self.assertEqual(self.call("--only", "12", "--update-docs").returncode, 2)


if __name__ == "__main__":
    unittest.main()

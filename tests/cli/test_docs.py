"""The documents as HTML: they build, every link leads somewhere, nothing of the program is missing. And the examples of docs/how-to/extending.md run."""

import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from browser import BROWSER, DRIVER, Browser  # noqa: E402
from program import PARAMS, PROGRAM, SOURCE, ProgramTest, call  # noqa: E402

BUILD = SOURCE / "docs/build.py"


class Links(html.parser.HTMLParser):
    """What a page has and what it points to."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.external, self.text = set(), [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "id" in attributes:
            self.anchors.add(attributes["id"])
        for key in ("href", "src"):
            if value := attributes.get(key):
                is_loaded = tag in ("img", "script", "link")
                (self.external if re.match(r"(https?:)?//", value) and is_loaded else self.links).append(value)

    def handle_data(self, data):
        self.text.append(data)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = tempfile.TemporaryDirectory(prefix="rotordrop-docs-")
        cls.output = pathlib.Path(cls.folder.name) / "html"
        done = subprocess.run([sys.executable, BUILD, "--program", PROGRAM, "--output", cls.output], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.pages = {path.name: path.read_text(encoding="utf-8") for path in cls.output.glob("*.html")}
        cls.parsed = {name: Links(text) for name, text in cls.pages.items()}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()
        super().tearDownClass()

    def test_every_document_is_a_page(self):
        self.assertGreaterEqual(len(self.pages), len(list((SOURCE / "docs").rglob("*.md"))) + 3)
        self.assertIn("User guide", self.pages["guide.html"])

    def test_internal_links_lead_somewhere(self):
        n_checked = 0
        for name, page in self.parsed.items():
            self.assertEqual(page.external, [], f"{name} asks the network")
            for link in page.links:
                if re.match(r"(https?|data|mailto):", link):
                    continue
                path, _, anchor = link.partition("#")
                target = self.output / (path or name)
                with self.subTest(page=name, link=link):
                    self.assertTrue(target.is_file())
                    if anchor and target.suffix == ".html":
                        self.assertIn(anchor, self.parsed[target.name].anchors)
                n_checked += 1
        self.assertGreater(n_checked, 500)

    def keys_of_defaults(self, *flags):
        keys, table = set(), ""
        for line in call("defaults", *flags).stdout.splitlines():
            if header := re.fullmatch(r"#?\[+([A-Za-z_.]+)\]+(\s*#.*)?", line):
                table = header[1] + "."
            elif key := re.match(r"#?([A-Za-z_0-9]+) = ", line):
                keys.add(table + key[1])
        return keys

    def test_every_parameter_is_in_the_reference(self):
        for flags, page in (((), "parameter-reference.html"), (("--heat",), "heat-parameter-reference.html"), (("--study",), "study-parameter-reference.html")):
            keys = self.keys_of_defaults(*flags)
            self.assertGreater(len(keys), 15)
            for key in sorted(keys):
                with self.subTest(page=page, parameter=key):
                    self.assertIn(key, self.parsed[page].anchors)

    def test_the_reference_has_units_defaults_and_sources(self):
        for one, schema in (("run.end_time", "0.3 s"), ("run.ambient", "293.15 K")):
            row = re.search(rf'<tr id="{one}">.*?</tr>', self.pages["parameter-reference.html"], re.S)[0]
            self.assertIn(f"<code>{schema}</code>", row)
            self.assertIn("Source: ", row)
        self.assertRegex(re.search(r'<tr id="run.end_time">.*?</tr>', self.pages["parameter-reference.html"], re.S)[0], r"<td>[^<]*&gt; 0[^<]*</td>")

    def test_every_command_is_in_the_guide(self):
        names = re.findall(r"^  ([a-z-]+)\s{2,}", call("--help").stdout.split("Subcommands:")[1], re.M)
        self.assertGreater(len(names), 8)
        text = "".join(self.parsed["guide.html"].text)
        for name in names:
            with self.subTest(command=name):
                self.assertIn(name, self.parsed["commands.html"].anchors)
                self.assertRegex(text, rf"rotordrop {name}\b")

    def test_tables_and_lists_were_understood(self):
        for name, page in self.parsed.items():
            if name == "changelog.html":
                continue
            without_code = re.sub(r"<(pre|code)[ >].*?</\1>", "", self.pages[name].split("<main>")[1], flags=re.S)
            with self.subTest(page=name):
                self.assertNotRegex(without_code, r"\|---|\n\| |<p>- |\n- |\*\*|```")

    def test_a_dead_link_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "sources"
            for name in ("docs", "params", "examples"):
                shutil.copytree(SOURCE / name, copy / name)
            for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE"):
                shutil.copy(SOURCE / name, copy)
            with open(copy / "docs/tutorials/guide.md", "a", encoding="utf-8") as guide:
                guide.write("\n[one](nowhere.md), [two](../theory/model.md#no-such-heading)\n")
            (copy / "docs/unlisted.md").write_text("# Unlisted\n")
            done = subprocess.run([sys.executable, copy / "docs/build.py", "--program", PROGRAM, "--output", copy / "html"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("nowhere.md: no such file", done.stderr)
            self.assertIn("model.md#no-such-heading: no such heading", done.stderr)
            self.assertIn("docs/unlisted.md is in no group", done.stderr)
            self.assertIn("docs/README.md has no link to docs/unlisted.md", done.stderr)

    def test_a_folder_with_something_else_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "mine.txt").write_text("mine")
            done = subprocess.run([sys.executable, BUILD, "--program", PROGRAM, "--output", folder], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertTrue((pathlib.Path(folder) / "mine.txt").is_file())


@unittest.skipUnless(DRIVER and BROWSER, "chromium and chromium-driver are not installed (./install-dependencies --tests)")
class SiteInTheBrowser(Site):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def found(self, words):
        return self.browser.run("""const field = document.getElementById("search"); field.value = arguments[0]; field.dispatchEvent(new Event("input"));
                                   return [...document.querySelectorAll("#found a")].map((link) => [link.textContent, link.getAttribute("href")])""", words)

    def test_pages_open_without_a_complaint_or_a_request(self):
        for name in sorted(self.pages):
            with self.subTest(page=name):
                self.browser.open(self.output / name)
                self.assertEqual([m["message"] for m in self.browser.log("browser")], [])
                self.assertEqual([url for url in self.browser.requests() if not url.startswith(("file:", "data:"))], [])
                self.assertTrue(self.browser.run("return [...document.images].every((image) => image.naturalWidth > 0)"))
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 1366)

    def test_searching_finds_parameters_and_words(self):
        self.browser.open(self.output / "index.html")
        self.assertIn(["contact.air_gap", "parameter-reference.html#contact.air_gap"], self.found("air_gap")[:2])
        self.assertIn(["bearings.NAME.f2", "parameter-reference.html#bearings.NAME.f2"], self.found("f2"))
        self.assertTrue(any(href.startswith("model.html") for _, href in self.found("hunt crossley")))
        self.assertEqual(self.found("no-such-word-anywhere"), [])
        self.assertEqual(self.browser.run("return document.getElementById('found').textContent"), "nothing found")
        for _, href in self.found("waviness"):
            path, _, anchor = href.partition("#")
            self.assertTrue(not anchor or anchor in self.parsed[path].anchors, href)


class Extending(ProgramTest):
    """The examples of docs/how-to/extending.md, as they stand."""

    @staticmethod
    def blocks():
        text = (SOURCE / "docs/how-to/extending.md").read_text(encoding="utf-8")
        return {re.match(r"# example: (.*)\n", block)[1]: block for block in re.findall(r"```toml\n(.*?)```", text, re.S)}

    def run_block(self, name, end_time="12 ms"):
        self.write("case.toml", self.blocks()[name])
        self.succeed("run", "case.toml", "-o", "out", "--force", "--set", f"run.end_time={end_time}")
        return tomllib.loads((self.folder / "out/parameters.toml").read_text())

    def test_the_guide_runs_as_it_stands(self):
        blocks = [block for block in re.findall(r"```sh\n(.*?)```", (SOURCE / "docs/tutorials/guide.md").read_text(encoding="utf-8"), re.S) if "my-drop" in block]
        self.assertEqual(len(blocks), 2)
        (self.folder / "build/release").mkdir(parents=True)
        (self.folder / "build/release/rotordrop").symlink_to(PROGRAM)
        for block in blocks:
            done = subprocess.run(["bash", "-euc", block], cwd=self.folder, capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "my-drop/results/report.html").is_file())
        for mu in ("0.05", "0.10", "0.15"):
            self.assertTrue((self.folder / f"my-drop/mu-{mu}/summary.json").is_file())

    def test_the_first_example_of_parameters_is_a_case(self):
        text = (SOURCE / "docs/how-to/parameters.md").read_text(encoding="utf-8")
        self.write("neisi2019.toml", (self.folder / "reference.toml").read_text())
        self.succeed("check", self.write("case.toml", re.search(r"```toml\n(base.*?)```", text, re.S)[1]))

    def test_the_verdicts_of_the_tutorial_and_of_limits_are_those_of_the_program(self):
        verdict = r"^ +(accepted|REJECTED|not assessed) +(\S+) (?:%|) +(bearings\S+)(?: = |: )([\d.]+|no value)(.*)$"
        tutorial, limits = (re.search(r"    Limits: .*?\n\n", (SOURCE / "docs" / page).read_text(encoding="utf-8"), re.S)[0] for page in ("tutorials/own-machine.md", "how-to/limits.md"))
        self.succeed("new", "mine", "--own")
        shutil.copy(PARAMS / "neisi2019-settling.toml", self.folder)
        shutil.copy(PARAMS / "neisi2019.toml", self.folder)
        self.write("limits.toml", 'base = "neisi2019-settling.toml"\nrun.end_time = "50 ms"\n[limits]\nbearings.TB2.peak_contact_force.max = "4 kN"\nbearings.TB1.peak_contact_force.max = "20 kN"\n'
                                  'bearings.TB1.catch_up_time.max = "0.1 s"\n')
        for text, case in ((tutorial, "mine/drop.toml"), (limits, "limits.toml")):
            said = self.succeed("run", case, "-o", "out", "--force").stdout
            self.assertIn(text.strip().splitlines()[0], said)
            told, found = (re.findall(verdict, one, re.M) for one in (text, said))
            self.assertEqual(len(told), len(text.strip().splitlines()) - 1)
            for a, b in zip(told, found, strict=True):
                self.assertEqual((a[0], a[2]), (b[0], b[2]))
                if a[3] != "no value":
                    self.assertLess(abs(float(a[3]) / float(b[3]) - 1), 5e-3, f"{a}: of another processor they differ by less")

    def test_all_examples_are_run(self):
        self.assertEqual(set(self.blocks()), {"material", "catalogue file bearings/6211-hybrid.toml", "bearing", "thermal node"})

    def test_a_material(self):
        parameters = self.run_block("material")
        self.assertEqual(parameters["materials"]["M50"]["rho"], 7970)
        self.assertEqual({parameters["bearings"][name]["ring"] for name in ("TB1", "TB2")}, {"M50"})
        self.assertIn("from case.toml:8: source: data sheet", (self.folder / "out/parameters.toml").read_text())

    def test_a_bearing_from_a_catalogue_of_ones_own(self):
        (self.folder / "bearings").mkdir()
        name = "catalogue file bearings/6211-hybrid.toml"
        (self.folder / name.split()[-1]).write_text(self.blocks()[name])
        parameters = self.run_block("bearing")
        self.assertEqual(parameters["bearings"]["TB1"]["balls_per_row"], 10)
        self.assertEqual(parameters["bearings"]["TB2"]["balls_per_row"], 23)

    def test_a_thermal_node(self):
        import h5py

        self.run_block("thermal node", "0.15 s")
        with h5py.File(self.folder / "out/results.h5") as results:
            plate = results["/thermal/bedplate"][:]
            heat = results["/energy/heat_residual"][:]
        self.assertEqual(plate[0], 293.15)
        self.assertGreater(plate[-1], plate[0], "heat has reached it")
        # 600 J in all; without the plate 1e-8 of them are not accounted for.
        self.assertLess(abs(heat).max(), 1e-5)


if __name__ == "__main__":
    unittest.main()

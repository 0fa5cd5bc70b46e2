"""Scripts, and what the documents say of the program: figures of a fresh result, commands, parameters, datasets, files.

ROTORDROP_PROGRAM is the program under test.
"""

import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("ROTORDROP_PROGRAM", ROOT / "build/release/rotordrop")).resolve()
DOCUMENTS = [ROOT / "README.md", ROOT / "examples/README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
FIGURES = {"overview", "orbits", "displacements", "contact_forces", "speeds", "torques", "heat_rates", "temperatures", "energy"}


def call(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=300, **options)
    if done.returncode:
        raise AssertionError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def plot(directory, **options):
    return call(sys.executable, ROOT / "examples/plot_drop.py", directory, **options)


def code_blocks(document, language):
    return re.findall(rf"^```{language}\n(.*?)^```", document.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def load_script(path):
    if str(path.parent) not in sys.path:
        sys.path.append(str(path.parent))  # as if it were called: its neighbours can be imported
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class WithAResult(unittest.TestCase):
    """10 ms of the settling case: up to the first impact."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.result = cls.folder / "out/neisi2019-settling"
        call(PROGRAM, "run", ROOT / "params/neisi2019-settling.toml", "-o", cls.result, "--set", 'run.end_time="10 ms"', "--quiet")


class StudyPlot(unittest.TestCase):
    """docs/plot_study.py draws one study; what it cannot draw is told in a line."""

    def test_a_study_that_it_cannot_draw_is_refused_in_words(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            steps = [("study.h5 is missing", lambda: h5py.File(folder / "study.h5", "w").close()),
                     ("study.json is missing", lambda: (folder / "study.json").write_text('{"done": 2}')),
                     ("chooses no best level by [choose]", lambda: (folder / "study.json").write_text('{"choose": {"best": {"value": 1}, "levels": []}}')),
                     ("has no column /parameters/damping", lambda: None)]
            for reason, next_step in steps:
                done = subprocess.run([sys.executable, ROOT / "docs/plot_study.py", folder, "-o", folder / "figure.png"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, r"\Aerror: [^\n]*" + re.escape(reason) + r"[^\n]*\n\Z")
                next_step()


    def test_the_best_level_is_compared_with_another_one(self):
        script = load_script(ROOT / "docs/plot_study.py")
        for best, levels in ((1e3, [1e3, 1e6]), (1e6, [1e6, 1e3]), (1e5, [1e5, 1e3])):
            self.assertEqual(script.compared_levels([1e3, 1e5, 1e6], best), levels)


class FieldPlot(unittest.TestCase):
    def test_a_body_of_two_cells_has_no_line_within(self):
        """Two cells of 2 x 1 mm beside each other, each in two parts: the lower one's upper edge is curved, as beside a raceway, the upper one's lower edge straight."""
        script = load_script(ROOT / "examples/plot_field.py")
        cells = [[(0, 0), (1, 0), (1, 1.02), (0, 1)], [(1, 0), (2, 0), (2, 1), (1, 1.02)], [(0, 1), (1, 1), (1, 2), (0, 2)], [(1, 1), (2, 1), (2, 2), (1, 2)]]
        points = script.np.array([(1e-3 * x, 1e-3 * r, 0) for cell in cells for x, r in cell])
        field = {"points": points, "quads": script.np.arange(16).reshape(4, 4), "data": {"body": script.np.zeros(16)}}
        lines = script.outline(field)
        self.assertEqual(len(lines), 8, "2 on each side of the square")
        self.assertAlmostEqual(script.np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1).sum(), 8, delta=1e-6, msg="mm")
        # Two bodies that touch keep the line between them.
        field["data"]["body"][8:] = 1
        self.assertEqual(len(script.outline(field)), 12)


class Plots(WithAResult):
    def test_every_figure_is_drawn(self):
        self.assertNotIn("not in the file", plot(self.result))
        figures = {path.stem: path for path in (self.result / "figures").glob("*.png")}
        self.assertEqual(set(figures), FIGURES)
        for path in figures.values():
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG", path)
            self.assertGreater(path.stat().st_size, 10_000, path)

    def test_a_rotor_with_a_linear_support_and_no_summary_is_drawn_too(self):
        settings = {"bearings.TB2": '{ type = "linear", node = 28, stiffness = [[1e8, 0.0], [0.0, 1e8]] }', "run.end_time": '"2 ms"'}
        case = self.folder / "linear.toml"
        text = (ROOT / "params/neisi2019.toml").read_text(encoding="utf-8").replace('"neisi2019-rotor.json"', f"'{ROOT}/params/neisi2019-rotor.json'")
        text = re.sub(r"\[bearings\.TB2\].*?(?=^\[materials\])", "", text, flags=re.MULTILINE | re.DOTALL)
        case.write_text(text, encoding="utf-8")
        result = self.folder / "linear"
        call(PROGRAM, "run", case, "-o", result, "--quiet", *(part for key, value in settings.items() for part in ("--set", f"{key}={value}")))
        (result / "summary.json").unlink()
        self.assertNotIn("not in the file", plot(result))
        self.assertTrue((result / "figures/overview.png").is_file())

    def test_equal_air_gaps_are_equal_circles(self):
        script = load_script(ROOT / "examples/plot_drop.py")
        case = script.Case(script.Results(self.result / "results.h5"), {})
        figure, axes = script.plt.subplots(1, 2)
        for panel, bearing in zip(axes, ("TB1", "TB2")):
            script.orbit_panel(case, panel, bearing)
            gap = next(line for line in panel.lines if line.get_label() == "air gap")
            self.assertAlmostEqual(max(gap.get_xdata()) - min(gap.get_xdata()), 500, delta=0.5, msg="um")
        spans = [panel.get_xlim()[1] - panel.get_xlim()[0] for panel in axes]
        self.assertAlmostEqual(spans[0], spans[1], delta=1e-9 * spans[0])
        self.assertAlmostEqual(spans[0], axes[0].get_ylim()[1] - axes[0].get_ylim()[0], delta=1e-9 * spans[0])
        script.plt.close(figure)

    def test_axes_are_called_by_the_direction_of_gravity(self):
        script = load_script(ROOT / "examples/plot_drop.py")
        for gravity, words in (("9.81", (", upwards", ", horizontal")), ('"9.81 m/s2"', (", upwards", ", horizontal")), ("[0, 0, -9.81]", (", horizontal", ", upwards")), ("[0, 9.81, 0]", (", downwards", ", horizontal")), ("[-9.81, 0, 0]", ("", "")), ("[0, -5, -5]", ("", "")), ("0", ("", ""))):
            found = script.gravity_of(f"[run]\ngravity = {gravity}\n")
            self.assertEqual(tuple(script.axis_words(found, axis) for axis in (1, 2)), words, gravity)
        self.assertEqual(script.Case(script.Results(self.result / "results.h5"), {}).axis_label(1), "y, upwards [µm]")

    def test_with_shoulders_the_contact_force_is_that_in_the_bore(self):
        script = load_script(ROOT / "examples/plot_drop.py")
        case = script.Case(script.Results(self.result / "results.h5"), {})
        titles = lambda: [panel.get_title() or panel.get_title(loc="left") for panel in script.contact_forces(case).axes]  # noqa: E731
        self.assertEqual(titles(), [f"{name}: force between rotor and inner ring" for name in ("TB1", "TB2")])
        get = case.results.get
        case.results.get = lambda name, quiet=False: (get("/time"), script.np.array([0.0, -3.0])) if name == "/bearings/TB2/shoulder_force" else get(name, quiet)
        self.assertEqual(titles(), ["TB1: force between rotor and inner ring", "TB2: force between rotor and inner ring, in the bore"])

    @unittest.skipUnless((PROGRAM.parent / "rotordrop_fe.so").exists(), "built without finite elements")
    def test_the_finite_elements_are_drawn_beside_the_circuit(self):
        script = load_script(ROOT / "examples/plot_drop.py")
        result = self.folder / "both"
        for models in (["lumped", "fe"], ["fe"]):
            call(PROGRAM, "run", ROOT / "params/neisi2019-settling.toml", "-o", result, "--force", "--quiet", "--set", 'run.end_time="9 ms"', "--set", f"thermal.models={json.dumps(models)}")
            case = script.Case(script.Results(result / "results.h5"), {})
            figure = script.temperatures(case)
            for panel in figure.axes:
                lines = {style: [line for line in panel.lines if line.get_linestyle() == style] for style in ("-", "--")}
                # Three nodes on the left, four on the right.
                n = 3 if panel is figure.axes[0] or panel is figure.axes[2] else 4
                self.assertEqual(len(lines["-"]), n if "lumped" in models else 0)
                self.assertEqual(len(lines["--"]), n)
                self.assertEqual(len(panel.get_legend().get_texts()), n)
                for line in panel.lines:
                    self.assertEqual(line.get_ydata()[0], 0)
            self.assertEqual(case.results.missing, [])

    def test_a_folder_without_results_is_named(self):
        done = subprocess.run([sys.executable, ROOT / "examples/plot_drop.py", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no", done.stderr)


class Scripts(unittest.TestCase):
    def test_scripts_are_executable_and_stop_at_the_first_fault(self):
        for name in ("run", "test", "install-dependencies", ".ci/run"):
            with self.subTest(name):
                self.assertTrue(os.access(ROOT / name, os.X_OK))
                self.assertIn("set -euo pipefail", (ROOT / name).read_text(encoding="utf-8"))
                call("bash", "-n", ROOT / name)


class Documents(WithAResult):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.keys = cls.keys_of_defaults(call(PROGRAM, "defaults"))
        cls.keys_of_heat = cls.keys_of_defaults(call(PROGRAM, "defaults", "--heat"))
        cls.tables_of_studies = {key.split(".")[0] for key in cls.keys_of_defaults(call(PROGRAM, "defaults", "--study"))}

    @staticmethod
    def keys_of_defaults(text):
        """Full names of all parameters and tables, from headers and keys, commented or not."""
        keys, table = set(), ""
        for line in text.splitlines():
            if header := re.fullmatch(r"#?\[+([A-Za-z_.]+)\]+(\s*#.*)?", line):
                table = header[1] + "."
                keys.add(header[1])
            elif key := re.match(r"#?([A-Za-z_0-9]+) = ", line):
                keys.add(table + key[1])
        return keys

    def known(self, path):
        parts = path.split(".")
        if parts[0] in ("bearings", "materials") and len(parts) > 1:
            path = ".".join([parts[0], "NAME", *parts[2:]])
        if parts[:2] == ["rotor", "probes"] and len(parts) > 2:
            path = ".".join(["rotor", "probes", "NAME", *parts[3:]])
        if parts[:1] == ["bearings"] and len(parts) == 2:
            return True  # a key that holds for all bearings, or a bearing
        if parts[:2] == ["thermal", "wall"] or parts[2:3] == ["wall"]:
            return True  # the thermal model of examples/own-parts, which registers its own keys
        if parts[:2] == ["rotor", "geometry"]:
            return True  # one parameter, whose inline tables test_the_rotor_of_the_documents_is_accepted reads
        return path in self.keys

    def test_defaults_are_understood(self):
        for key in ("run.end_time", "rotor.unbalance.me", "bearings.NAME.support.K_y", "thermal.node.name", "output.interval"):
            self.assertIn(key, self.keys)

    def test_parameters_named_in_documents_exist(self):
        sections = {key.split(".")[0] for key in self.keys}
        n_found = 0
        for document in DOCUMENTS:
            text = document.read_text(encoding="utf-8")
            quoted = re.findall(r"`([^`\n]+)`", text) + re.findall(r"--set ([a-z_.]+)=", text)
            for words in quoted:
                for path in re.findall(r"(?<![\w./])([a-z]+(?:\.[A-Za-z_0-9]+)+)(?![\w/])", words):
                    if path.split(".")[0] in sections and not path.endswith((".toml", ".json", ".h5", ".py", ".md")) and not self.is_summary_key(path) and not self.is_series(path):
                        n_found += 1
                        with self.subTest(document=document.name, parameter=path):
                            self.assertTrue(self.known(path), path)
        self.assertGreater(n_found, 15)

    def is_series(self, path):
        """A dataset as the Python package calls it."""
        with h5py.File(self.result / "results.h5", "r") as file:
            return path.replace(".", "/").replace("NAME", "TB1") in file

    def is_summary_key(self, path):
        node = json.loads((self.result / "summary.json").read_text(encoding="utf-8"))
        for part in path.replace("NAME", "TB1").split("."):
            if part == "NODE":
                return True
            if not isinstance(node, dict) or part not in node:
                return False
            node = node[part]
        return True

    def test_parameters_in_examples_of_cases_exist(self):
        def leaves(tree, path=""):
            for key, value in tree.items():
                if isinstance(value, dict):
                    yield from leaves(value, f"{path}{key}.")
                else:
                    yield path + key

        n_found = 0
        for document in DOCUMENTS:
            for block in code_blocks(document, "toml"):
                tables = tomllib.loads(block)
                if tables.keys() & {"design", "surrogate", "minimise", "vary"}:  # a study, which gives names of its own to what it varies and derives
                    self.assertEqual(set(tables) - self.tables_of_studies, set())
                    continue
                for path in leaves(tables, "bearings.NAME." if block.startswith("# example: catalogue file") else ""):
                    if path == "base":
                        continue
                    n_found += 1
                    with self.subTest(document=document.name, parameter=path):
                        self.assertTrue(self.known(path) or path in self.keys_of_heat, path)
        self.assertGreater(n_found, 5)

    def test_the_rotor_of_the_documents_is_accepted(self):
        """The inline geometry of docs/how-to/parameters.md, on two linear supports."""
        (block,) = [b for b in code_blocks(ROOT / "docs/how-to/parameters.md", "toml") if "[rotor.geometry]" in b]
        case = self.folder / "inline-rotor.toml"
        support = 'type = "linear"\nnode = {}\nstiffness = [[1e8, 0.0], [0.0, 1e8]]\n'
        case.write_text('[run]\ninitial_speed = "1000 rpm"\n' + block + "".join(f"[bearings.B{node}]\n{support.format(node)}" for node in (1, 3)), encoding="utf-8")
        self.assertIn("rotor: 5.8361 kg", call(PROGRAM, "check", case))
        misspelt = self.folder / "misspelt-rotor.toml"
        misspelt.write_text(case.read_text(encoding="utf-8").replace("mass_points", "mass_point"), encoding="utf-8")
        done = subprocess.run([PROGRAM, "check", misspelt], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn('Did you mean "mass_points"?', done.stderr)

    def test_files_that_documents_link_to_exist(self):
        for document in DOCUMENTS:
            without_code = re.sub(r"^```.*?^```", "", document.read_text(encoding="utf-8"), flags=re.M | re.S)
            for target in re.findall(r"\]\(([^)#]+)", without_code):
                with self.subTest(document=document.name, target=target):
                    self.assertTrue((document.parent / target).exists())

    def test_files_that_documents_name_exist(self):
        pattern = r"(?<![\w./-])((?:docs|examples|params|src|tests|validation|benchmarks)/[\w./-]*[\w]|install-dependencies)"
        for document in DOCUMENTS:
            for name in re.findall(pattern, document.read_text(encoding="utf-8")):
                with self.subTest(document=document.name, file=name):
                    self.assertTrue((ROOT / name).exists())

    def test_documents_that_sources_name_exist(self):
        """Comments, messages and scripts name a document by its path from the source folder."""
        n_named = 0
        for folder in ("src", "params", "tests", "examples", "validation", "docs", "meshes", "benchmarks"):
            for file in (ROOT / folder).rglob("*"):
                if file.suffix not in (".h", ".cpp", ".py", ".toml", ".md", ".js", ".txt", ".geo"):
                    continue
                for name in re.findall(r"(?<![\w./-])docs/[\w/-]+\.md", file.read_text(encoding="utf-8")):
                    if name == "docs/unlisted.md":  # made by test_docs
                        continue
                    n_named += 1
                    with self.subTest(file=str(file.relative_to(ROOT)), document=name):
                        self.assertTrue((ROOT / name).is_file())
        self.assertGreater(n_named, 100)

    def test_commands_of_the_readme_run(self):
        """The block that starts a case, as it stands, in a folder that looks like the source folder."""
        block = next(b for b in code_blocks(ROOT / "README.md", "sh") if "rotordrop new" in b)
        inline = re.findall(r"`(build/release/rotordrop [^`]+)`", (ROOT / "README.md").read_text(encoding="utf-8"))
        (self.folder / "build/release").mkdir(parents=True)
        (self.folder / "build/release/rotordrop").symlink_to(PROGRAM)
        (self.folder / "examples").symlink_to(ROOT / "examples")
        call("bash", "-euc", block + "\n".join(inline), cwd=self.folder)
        self.assertTrue((self.folder / "my-drop/results/figures/overview.png").is_file())
        self.assertTrue((self.folder / "my-drop/slow/summary.json").is_file())

    def test_python_of_the_readme_runs(self):
        (block,) = [b for b in code_blocks(ROOT / "README.md", "python") if "import h5py" in b]  # the other one: tests/python/test_examples.py
        printed = call(sys.executable, "-c", block, cwd=self.folder).split()
        self.assertEqual(printed[1], "N")
        self.assertGreaterEqual(float(printed[2]), float(printed[0]))

    def test_the_table_of_datasets_is_that_of_the_result_file(self):
        listing = load_script(ROOT / "docs/list_datasets.py")
        with h5py.File(self.result / "results.h5", "r") as file:
            self.assertEqual(listing.documented(), listing.table(file), "update it: /usr/bin/python3 docs/list_datasets.py RESULTS.h5 --update")

    def test_datasets_named_in_the_readme_exist(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        with h5py.File(self.result / "results.h5", "r") as file:
            for path in re.findall(r"[`'\"](/(?:time|bearings|rotor|thermal|energy|detail)[\w/]*)", text):
                with self.subTest(path):
                    self.assertIn(path.replace("NAME", "TB1").rstrip("/"), file)

    def test_every_key_of_the_summary_is_documented(self):
        text = (ROOT / "docs/reference/results.md").read_text(encoding="utf-8").split("## summary.json")[1]

        def check(tree, path):
            for key, value in tree.items():
                if path == ["bearings"] or path[-1:] == ["temperature_rise_end"] or path == ["energy"]:
                    pass  # names of bearings and nodes; balances stand with their datasets
                else:
                    with self.subTest(".".join([*path, key])):
                        self.assertRegex(text, rf"[`.]{key}\b")
                if isinstance(value, dict):
                    check(value, [*path, key])

        check(json.loads((self.result / "summary.json").read_text(encoding="utf-8")), [])


if __name__ == "__main__":
    unittest.main()

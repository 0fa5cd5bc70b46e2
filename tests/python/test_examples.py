"""What is shown runs: the examples of docs/how-to/python.md and the README in their order, and every notebook of examples/notebooks."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from package import HAS_FE, PACKAGE, SOURCE  # noqa: E402

NOTEBOOKS = sorted((SOURCE / "examples/notebooks").glob("*.ipynb"))
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(PACKAGE), "MPLBACKEND": "agg"}

# Runs the cells of a notebook one after the other in one place, as a kernel would.
PLAIN = """
import json, sys
import matplotlib
matplotlib.use("agg")
place = {}
for cell in json.load(open(sys.argv[1], encoding="utf-8"))["cells"]:
    if cell["cell_type"] == "code":
        exec(compile("".join(cell["source"]), cell["id"], "exec"), place)
"""


def examples(document):
    """Code of the Python examples of a document: those that begin with "# example", or import the package."""
    blocks = re.findall(r"^```python\n(.*?)^```", (SOURCE / document).read_text(encoding="utf-8"), re.M | re.S)
    return [block for block in blocks if block.startswith("# example") or "import rotordrop as rd" in block]


class Documents(unittest.TestCase):
    def run_code(self, code):
        with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
            file.write(code)
            file.flush()
            done = subprocess.run([sys.executable, file.name], cwd=SOURCE, capture_output=True, text=True, env=ENVIRONMENT, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])
        return done.stdout

    def test_the_how_to_page(self):
        blocks = examples("docs/how-to/python.md")
        self.assertGreaterEqual(len(blocks), 5)
        if not HAS_FE:
            blocks = [block for block in blocks if '"fe"' not in block]
        out = self.run_code("\n".join(blocks))
        self.assertIn("contact.air_gpa", out)
        self.assertIn("Did you mean", out)

    def test_the_readme(self):
        (block,) = examples("README.md")
        out = self.run_code(block)
        self.assertRegex(out, r"^\d{4}\.\d+ ")

    def test_the_readme_says_where_the_package_is(self):
        self.assertIn("export PYTHONPATH=$PWD/build/release/python", (SOURCE / "README.md").read_text(encoding="utf-8"))


class Notebooks(unittest.TestCase):
    maxDiff = None

    def test_there_is_a_gallery(self):
        self.assertGreaterEqual(len(NOTEBOOKS), 6)
        readme = (SOURCE / "examples/notebooks/README.md").read_text(encoding="utf-8")
        for file in NOTEBOOKS:
            self.assertIn(file.name, readme)

    def test_they_are_kept_without_results(self):
        for file in NOTEBOOKS:
            for cell in json.loads(file.read_text(encoding="utf-8"))["cells"]:
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), file.name)

    def execute(self, file):
        try:
            import nbclient
            import nbformat
        except ImportError:
            done = subprocess.run([sys.executable, "-c", PLAIN, file], capture_output=True, text=True, env=ENVIRONMENT, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr[-3000:])
            return
        notebook = nbformat.read(file, as_version=4)
        with tempfile.TemporaryDirectory() as folder:
            client = nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}})
            os.environ.update(ENVIRONMENT)
            client.execute()
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [], "a notebook leaves nothing behind")


def make_test(file):
    def test(self):
        source = file.read_text(encoding="utf-8")
        if not HAS_FE and '\\"fe\\"' in source:
            self.skipTest("built without finite elements")
        self.execute(file)

    return test


for one in NOTEBOOKS:
    setattr(Notebooks, "test_" + one.stem.replace("-", "_"), make_test(one))


if __name__ == "__main__":
    unittest.main()

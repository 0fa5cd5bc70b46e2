"""The libraries behind a module: listed from below, opened in that order, and no matter where the list is missing or wrong.

ROTORDROP_PROGRAM is the program under test, with its modules beside it. Skipped without finite elements.
"""

import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HEATED_DISC, PROGRAM, ProgramTest  # noqa: E402

BUILD = pathlib.Path(PROGRAM).parent
MODULES = [BUILD / name for name in ("rotordrop_fe.so", "rotordrop_mesh.so") if (BUILD / name).is_file()]
WITHOUT_CACHE = {**os.environ, "ROTORDROP_CACHE": "off"}  # a section that was met before needs no module
CASE = 'output_times = ["1 ms"]\n' + HEATED_DISC + '[[probe]]\nname = "rim"\nboundary = "disc.outer"\n'


def list_of(module):
    return module.with_name(module.name + ".libraries")


def needs_of(file):
    text = subprocess.run(["readelf", "-d", file], capture_output=True, text=True, check=True, env={**os.environ, "LC_ALL": "C"}).stdout
    return re.findall(r"\(NEEDED\).*\[(.*)\]", text)


def behind(module):
    """Files of the libraries behind an object."""
    return dict(re.findall(r"(\S+) => (/\S+)", subprocess.run(["ldd", module], capture_output=True, text=True, check=True).stdout))


def defined_by(file):
    text = subprocess.run(["nm", "-D", "--defined-only", file], capture_output=True, text=True, check=True).stdout
    return {symbol for symbol in re.findall(r"^\S+ [TDBR] (\S+)$", text, re.M) if "@" not in symbol} - {"__bss_start", "_edata", "_end", "_init", "_fini"}


@unittest.skipUnless(MODULES, "built without finite elements")
class ListsOfLibraries(ProgramTest):
    def test_each_library_stands_after_those_that_it_needs(self):
        for module in MODULES:
            names, found = list_of(module).read_text().split(), behind(module)
            self.assertGreater(len(names), 20)
            self.assertEqual(len(names), len(set(names)))
            place = {name: i for i, name in enumerate(names)}
            for name in names:
                for needed in needs_of(found[name]):
                    if needed in found:
                        self.assertLess(place[needed], place[name], f"{needed} below {name}")

    def test_functions_of_eigen_stay_a_modules_own(self):
        """gmsh has the same ones. Built for another alignment, as by -march=native or with sanitizers, it would free what the module's have allotted otherwise."""
        for module in MODULES:
            symbols = subprocess.run(["nm", "-D", "--defined-only", module], capture_output=True, text=True, check=True).stdout
            self.assertIn("rotordrop", symbols)
            self.assertNotIn("5Eigen", symbols, module)

    def test_libraries_that_define_the_same_are_left_to_the_module(self):
        """Two builds of Scotch, or of BLAS: opened by itself, one would find its own functions where all of them together find the other's."""
        for module in MODULES:
            found, libraries_of = behind(module), collections.defaultdict(set)
            for name, file in found.items():
                for symbol in defined_by(file):
                    libraries_of[symbol].add(name)
            shared = set().union(*(names for names in libraries_of.values() if len(names) > 1))
            self.assertTrue(shared)
            for name in list_of(module).read_text().split():
                self.assertNotIn(name, shared)

    def rise(self, modules, name):
        self.write("disc.toml", CASE)
        done = subprocess.run([PROGRAM, "heat", "disc.toml", "-o", name, "--quiet"], cwd=self.folder,
                              env={**WITHOUT_CACHE, "ROTORDROP_MODULES": str(modules)}, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / name / "summary.json").read_text())["probes"]["rim"]["temperature"]

    def test_results_do_not_depend_on_the_list(self):
        expected = self.rise(BUILD, "with")
        self.assertGreater(expected[0], 293.15 + 1)
        folder = self.folder / "modules"
        folder.mkdir()
        (folder / "rotordrop_fe.so").symlink_to(BUILD / "rotordrop_fe.so")
        self.assertEqual(self.rise(folder, "without"), expected)
        list_of(folder / "rotordrop_fe.so").write_text("libnot-there.so.1\n\nlibdeal.ii.so.0\nno library at all\n")
        self.assertEqual(self.rise(folder, "wrong"), expected)

    def test_libraries_are_opened_from_below(self):
        """As the loader tells it: what stands first in the list is opened before the module, which has it open then."""
        self.write("disc.toml", CASE)
        done = subprocess.run([PROGRAM, "heat", "disc.toml", "-o", "out", "--quiet"], cwd=self.folder, env={**WITHOUT_CACHE, "LD_DEBUG": "files"},
                              capture_output=True, text=True, timeout=120)
        opened = [pathlib.Path(file).name for file in re.findall(r"opening file=(\S+) \[0\]", done.stderr)]
        module = opened.index("rotordrop_fe.so")
        below = [name for name in list_of(BUILD / "rotordrop_fe.so").read_text().split() if name.startswith("libTK")]
        self.assertGreater(len(below), 20, "OpenCASCADE's")
        # What is in use already is not told again, and files have longer names than libraries.
        for name in below:
            told = [i for i, file in enumerate(opened) if file.startswith(name)]
            self.assertTrue(told and told[0] < module, name)


if __name__ == "__main__":
    unittest.main()

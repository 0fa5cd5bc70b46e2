"""The libraries behind a module: listed from below, opened in that order, and no matter where the list is missing or wrong.

ROTORDROP_PROGRAM is the program under test, with its modules beside it. Skipped without finite elements.
"""

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
CASE = 'output_times = ["1 ms"]\n' + HEATED_DISC + '[[probe]]\nname = "rim"\nboundary = "disc.outer"\n'


def list_of(module):
    return module.with_name(module.name + ".libraries")


def needs_of(file):
    text = subprocess.run(["readelf", "-d", file], capture_output=True, text=True, check=True, env={**os.environ, "LC_ALL": "C"}).stdout
    return re.findall(r"\(NEEDED\).*\[(.*)\]", text)


@unittest.skipUnless(MODULES, "built without finite elements")
class ListsOfLibraries(ProgramTest):
    def test_each_library_stands_after_those_that_it_needs(self):
        for module in MODULES:
            names = list_of(module).read_text().split()
            found = re.findall(r"(\S+) => (/\S+)", subprocess.run(["ldd", module], capture_output=True, text=True, check=True).stdout)
            self.assertEqual(sorted(names), sorted(name for name, _ in found))
            self.assertGreater(len(names), 20)
            place = {name: i for i, name in enumerate(names)}
            for name, file in found:
                for needed in needs_of(file):
                    if needed in place:
                        self.assertLess(place[needed], place[name], f"{needed} below {name}")

    def rise(self, modules, name):
        self.write("disc.toml", CASE)
        done = subprocess.run([PROGRAM, "heat", "disc.toml", "-o", name, "--quiet"], cwd=self.folder,
                              env={**os.environ, "ROTORDROP_MODULES": str(modules)}, capture_output=True, text=True, timeout=120)
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
        done = subprocess.run([PROGRAM, "heat", "disc.toml", "-o", "out", "--quiet"], cwd=self.folder, env={**os.environ, "LD_DEBUG": "files"},
                              capture_output=True, text=True, timeout=120)
        opened = re.findall(r"opening file=(\S+) \[0\]", done.stderr)
        at = {pathlib.Path(file).name: i for i, file in reversed(list(enumerate(opened)))}
        deal = next(name for name in list_of(BUILD / "rotordrop_fe.so").read_text().split() if name.startswith("libdeal.ii"))
        real = [name for name in at if name.startswith(deal.rsplit(".so", 1)[0])]
        self.assertTrue(real, done.stderr[-2000:])
        self.assertLess(at[real[0]], at["rotordrop_fe.so"])
        for needed in needs_of(next(file for file in opened if file.endswith(real[0]))):
            if needed in at:
                self.assertLess(at[needed], at[real[0]], needed)


if __name__ == "__main__":
    unittest.main()

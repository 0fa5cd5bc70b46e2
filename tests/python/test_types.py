"""Type hints: mypy finds no fault in the package, and the stub of its compiled part says what is there. Every public name has a docstring."""

import inspect
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from package import PACKAGE, SOURCE, rd  # noqa: E402

HAS_MYPY = shutil.which("mypy") is not None


class Types(unittest.TestCase):
    def call(self, *command):
        with tempfile.TemporaryDirectory() as cache:
            return subprocess.run([*command], capture_output=True, text=True, cwd=SOURCE, timeout=300,
                                  env={**os.environ, "MYPYPATH": str(PACKAGE), "PYTHONPATH": str(PACKAGE), "MYPY_CACHE_DIR": cache})

    @unittest.skipUnless(HAS_MYPY, "mypy is not installed: ./install-dependencies --tests")
    def test_the_package_is_typed(self):
        done = self.call("mypy", "--strict", "--ignore-missing-imports", "--package", "rotordrop")
        self.assertEqual(done.returncode, 0, done.stdout)

    @unittest.skipUnless(HAS_MYPY, "mypy is not installed: ./install-dependencies --tests")
    def test_the_stub_says_what_is_compiled(self):
        # Classes of pybind11 have a metaclass of their own, and a constructor that refuses every argument where there is none.
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as known:
            known.write("rotordrop\\._core\\.[A-Z][A-Za-z]*(\\.__init__)?\n")
            known.flush()
            done = self.call("stubtest", "rotordrop._core", "--ignore-missing-stub", "--ignore-positional-only", "--allowlist", known.name)
        self.assertEqual(done.returncode, 0, done.stdout)

    @unittest.skipUnless(HAS_MYPY, "mypy is not installed: ./install-dependencies --tests")
    def test_a_wrong_use_is_found(self):
        with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
            file.write('import rotordrop as rd\nresult: int = rd.Case("a.toml").run()\nrd.Case("a.toml").rum()\n')
            file.flush()
            done = self.call("mypy", "--strict", "--ignore-missing-imports", file.name)
        self.assertEqual(done.stdout.count("error:"), 2, done.stdout)

    def test_every_public_name_is_explained(self):
        for name in rd.__all__:
            value = getattr(rd, name)
            if inspect.isclass(value) or inspect.isfunction(value):
                self.assertTrue(inspect.getdoc(value), name)
            if inspect.isclass(value) and value.__module__.startswith("rotordrop."):
                for member, what in vars(value).items():
                    if not member.startswith("_") and (inspect.isfunction(what) or isinstance(what, property)) and value is not rd.Progress:
                        self.assertTrue(inspect.getdoc(what), f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()

"""What the tests of the Python package share: the package, cases, the program beside it."""

import os
import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PARAMS = SOURCE / "params"
PROGRAM = str(pathlib.Path(os.environ.get("ROTORDROP_PROGRAM", SOURCE / "build/release/rotordrop")).resolve())
PACKAGE = pathlib.Path(os.environ.get("ROTORDROP_PYTHON_PACKAGE", pathlib.Path(PROGRAM).parent / "python"))
HAS_FE = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
sys.path.insert(0, str(PACKAGE))
sys.path.insert(0, str(SOURCE / "tests/cli"))

import rotordrop as rd  # noqa: E402,F401

SETTLING = PARAMS / "neisi2019-settling.toml"
GRAVITY = 9.81  # as the cases have it [m/s2]


class PackageTest(unittest.TestCase):
    """A test with a folder of its own."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="rotordrop-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


def flat(value, path=""):
    """Numbers and texts of nested dictionaries and lists by their dotted names."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from flat(inner, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from flat(inner, f"{path}[{i}]")
    else:
        yield path, value

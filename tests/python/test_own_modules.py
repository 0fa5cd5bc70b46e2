"""Modules of parts in one process: what an earlier one left behind decides about none, and a file that changed is told."""

import os
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from package import SETTLING, PackageTest, rd  # noqa: E402
from compiled_module import CAN_COMPILE, OTHER_HEADERS, compile_module  # noqa: E402


@unittest.skipUnless(CAN_COMPILE, "no compiler, or no libraries beside the program")
class OwnModules(PackageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        modules = tempfile.TemporaryDirectory(prefix="rotordrop-test-")
        cls.addClassCleanup(modules.cleanup)
        cls.modules = pathlib.Path(modules.name)
        compile_module(cls.modules / "old.so", OTHER_HEADERS, '-DTYPE="old-ring"')
        compile_module(cls.modules / "half.so", '-DTYPE="ring"', "-DWITH_TAKEN_NAME")
        compile_module(cls.modules / "ring.so", '-DTYPE="ring"')

    def case(self, *files):
        return rd.Case(SETTLING, {"run.parts": [str(file) for file in files], "run.end_time": "1 ms"})

    def test_modules_in_one_process(self):
        """One test: what is loaded stays loaded."""
        old, half, ring = (self.modules / f"{name}.so" for name in ("old", "half", "ring"))
        with self.assertRaisesRegex(rd.InputError, "old.so was built for another version"):
            self.case(old)
        with self.assertRaisesRegex(rd.InputError, 'half.so cannot add its parts: a thermal model cannot be called "lumped"'):
            self.case(half)
        # After both it has its name, which the refused one would have taken.
        self.case(ring)
        with self.assertRaisesRegex(rd.InputError, "old.so was built for another version"):
            self.case(ring, old)
        self.case(ring)
        again = ring.with_name("again.so")
        shutil.copy(half, again)
        os.replace(again, ring)
        with self.assertRaisesRegex(rd.InputError, "ring.so has changed since this process loaded it"):
            self.case(ring)


if __name__ == "__main__":
    unittest.main()

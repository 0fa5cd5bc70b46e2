"""A module of parts from C++ (own_module.cpp), compiled against the sources and the libraries beside the program."""

import pathlib
import shutil
import subprocess

from program import BUILD, IS_SANITIZED, SOURCE

BASE = BUILD / "src/base/librotordrop_base.a"
CAN_COMPILE = shutil.which("g++") and BASE.is_file() and not IS_SANITIZED
# Another version of the compiler's ABI stands for other headers: it is part of what module and program must have in common.
OTHER_HEADERS = "-fabi-version=16"


def compile_module(file, *flags):
    """Flags: -DTYPE="ring" names the support; -DWITH_TAKEN_NAME adds a thermal model that is refused."""
    command = ["g++", "-std=c++20", "-O0", "-fPIC", "-shared", f"-I{SOURCE / 'src'}", "-isystem", "/usr/include/eigen3", "-DFMT_SHARED", *flags]
    subprocess.run([*command, "-o", str(file), str(SOURCE / "tests/cli/own_module.cpp"), str(BASE), "-lfmt", "-ludunits2"], check=True)
    return pathlib.Path(file)

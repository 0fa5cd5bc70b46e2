"""A wheel of the Python package, without network:

    /usr/bin/python3 -m pip wheel packaging/wheel --no-build-isolation --no-deps --no-index -w build/wheel

It builds the package in build/release (or ROTORDROP_BUILD) and packs it with the cases and, if they are there, the finite-element modules. External libraries
stay those of the system, so the wheel is for the Debian release on which it is made; with the finite-element modules it falls under the GPL.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("ROTORDROP_BUILD", ROOT / "build/release")).resolve()


class Package(build_py):
    """Takes the package as CMake has built it."""

    def run(self):
        if not (BUILD / "CMakeCache.txt").is_file():
            subprocess.run(["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DPython3_EXECUTABLE={sys.executable}", "-DROTORDROP_PYTHON=ON",
                            "-DROTORDROP_TESTS=OFF", "-DROTORDROP_BENCHMARKS=OFF"], check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "rotordrop_python"], check=True)
        target = pathlib.Path(self.build_lib) / "rotordrop"
        shutil.rmtree(target, ignore_errors=True)
        shutil.copytree(BUILD / "python/rotordrop", target, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copytree(ROOT / "params", target / "params")
        modules = [BUILD / name for name in ("rotordrop_fe.so", "rotordrop_fe.so.libraries", "rotordrop_mesh.so", "rotordrop_mesh.so.libraries") if (BUILD / name).is_file()]
        if modules:
            (target / "modules").mkdir()
        for module in modules:
            shutil.copy(module, target / "modules")


class Compiled(Distribution):
    """Its wheel is for one Python and one machine."""

    def has_ext_modules(self):
        return True


# Nothing is left among the sources.
scratch = BUILD / "wheel"
scratch.mkdir(parents=True, exist_ok=True)
version = re.search(r"project\(rotordrop VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
setup(version=version, packages=["rotordrop"], package_dir={"rotordrop": os.path.relpath(ROOT / "src/python/rotordrop", pathlib.Path(__file__).parent)},
      cmdclass={"build_py": Package}, distclass=Compiled, options={"build": {"build_base": str(scratch)}, "egg_info": {"egg_base": str(scratch)}})

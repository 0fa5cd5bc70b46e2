"""What the tests of the command line share: the program, cases in temporary folders, results."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PARAMS = SOURCE / "params"
PROGRAM = str(pathlib.Path(os.environ.get("ROTORDROP_PROGRAM", SOURCE / "build/release/rotordrop")).resolve())
BUILD = pathlib.Path(PROGRAM).parent
HAS_MESH_ROOM = (BUILD / "rotordrop_mesh.so").is_file()
HAS_SURROGATES = (BUILD / "rotordrop_surrogate.so").is_file()
CACHE = (BUILD / "CMakeCache.txt").read_text() if (BUILD / "CMakeCache.txt").is_file() else ""  # how the program was built
IS_SANITIZED = "ROTORDROP_SANITIZE:BOOL=ON" in CACHE


# A disc that is heated at its outside: a case of `rotordrop heat`; times come before it.
HEATED_DISC = """
[run]
ambient = "20 degC"
[[section.rectangle]]
name = "disc"
x = [0, "10 mm"]
r = ["10 mm", "20 mm"]
material = "steel"
[[flux]]
boundary = "disc.outer"
times = [0]
values = [1e6]
"""


def call(*arguments, cwd=None, timeout=600 if IS_SANITIZED else 120):
    """Runs the program to its end; returncode, stdout and stderr as text."""
    command = [PROGRAM, *map(str, arguments)]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=timeout, stdin=subprocess.DEVNULL)


def start(*arguments, cwd=None, stderr=subprocess.PIPE):
    """Starts the program; the caller waits for it."""
    return subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=stderr, text=True)


def settings(**keys):
    """settings(run__end_time="10 ms") is ["--set", "run.end_time=10 ms"]."""
    return [word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


def content_of(directory):
    """Every file of a folder with its bytes, and every folder."""
    directory = pathlib.Path(directory)
    return {str(path.relative_to(directory)): path.read_bytes() if path.is_file() else None for path in directory.rglob("*")}


def page_data(page):
    """What the script of a report draws from."""
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, in which the reference case lies as reference.toml."""

    maxDiff = None

    def setUp(self):
        self.assertTrue(pathlib.Path(PROGRAM).is_file(), f"there is no program {PROGRAM}; set ROTORDROP_PROGRAM")
        folder = tempfile.TemporaryDirectory(prefix="rotordrop-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copy(PARAMS / "neisi2019.toml", self.folder / "reference.toml")
        shutil.copy(PARAMS / "neisi2019-rotor.json", self.folder)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def case(self, text, name="drop.toml"):
        """A case of 10 ms that starts from the reference case."""
        return self.write(name, 'base = "reference.toml"\nrun.end_time = "10 ms"\n' + text)

    def call(self, *arguments, **options):
        return call(*arguments, cwd=self.folder, **options)

    def succeed(self, *arguments, **options):
        done = self.call(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def run_case(self, *arguments, output="out", **keys):
        """Runs a case to its end; the summary."""
        self.succeed("run", *arguments, "-o", output, *settings(**keys))
        return self.summary(output)

    def interrupt_run(self, *arguments, after=0.0):
        """Starts a run that writes into out, and interrupts it as Ctrl-C does, so many seconds after it has begun to write."""
        process = start("run", *arguments, "-o", "out", cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        while process.poll() is None and not (self.folder / "out/results.h5").exists():
            time.sleep(0.01)
        time.sleep(after)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, "it ended before it could be interrupted")

    def summary(self, output="out"):
        return json.loads((self.folder / output / "summary.json").read_text())

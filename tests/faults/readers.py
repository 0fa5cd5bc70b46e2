#!/usr/bin/python3
"""Plain readers of a live run, which is then killed: how often HDF5 opens the file, and whether the rows are whole.

    tests/faults/readers.py build/release/rotordrop 15
"""

import collections
import pathlib
import random
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

CASE = pathlib.Path(__file__).resolve().parents[2] / "params/neisi2019-settling.toml"
# 500 000 rows per second of simulated time, so that a reader meets many writes.
SETTINGS = ["--set", 'run.end_time="40 ms"', "--set", 'output.interval="2 us"', "--quiet"]


def read(path):
    """Rows of the file; raises if it cannot be opened or a series is not whole."""
    with h5py.File(path, "r") as file:
        times = file["time"][:]
        assert (numpy.diff(times) > 0).all(), "times do not rise"
        for name in ("bearings/TB1/contact_force", "bearings/TB2/orbit", "bearings/TB2/ball_force", "energy/residual"):
            values = file[name][: len(times)]
            assert len(values) == len(times) and not numpy.isnan(values).any(), f"{name} lacks rows"
    return len(times)


def attempt(path, kind, found):
    try:
        read(path)
        found[kind, "read"] += 1
    except (OSError, AssertionError) as error:
        found[kind, str(error).split(" (")[0][:60]] += 1


def main(program, n_kills):
    random.seed(1)
    found = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for kill in range(n_kills):
            path = pathlib.Path(scratch) / str(kill) / "results.h5"
            process = subprocess.Popen([program, "run", CASE, "-o", path.parent, *SETTINGS])
            end = time.monotonic() + random.uniform(0.05, 4)
            while time.monotonic() < end and process.poll() is None:
                if path.exists():
                    attempt(path, "live", found)
            process.kill()
            process.wait()
            if path.exists():
                attempt(path, "killed", found)
    for (kind, what), n in sorted(found.items()):
        print(f"{kind}: {what}: {n}")
    return 0 if all(what == "read" for kind, what in found if kind == "killed") else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2])))

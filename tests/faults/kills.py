#!/usr/bin/python3
"""Runs that are killed at random instants, also while they start and while they write, then resumed: every one ends with the bits of an unbroken
run; rows of windowed finite elements may differ by roundoff.

    tests/faults/kills.py build/release/rotordrop [KILLS] [SEED]

A run is killed up to three times before it may end. Most kills are SIGKILL, some SIGTERM or SIGINT, as by an impatient user. Steps are fixed, for
error control starts anew after a resume. Exit code 1 if a run is lost, differs, hangs or ends in an unexpected way.
"""

import collections
import json
import math
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

CASE = pathlib.Path(__file__).resolve().parents[2] / "params/neisi2019-settling.toml"
COMMON = {"integration.method": "runge-kutta-4", "integration.step": '"2 us"', "output.checkpoint_interval": '"0.03 s"', "output.detail_interval": '"0.1 ms"'}
KINDS = {
    "circuit": {"run.end_time": '"60 ms"'},
    "free rings": {"run.end_time": '"30 ms"', "bearings.TB1.ring_motion": '"free"', "bearings.TB2.ring_motion": '"free"'},
    "windowed finite elements": {"run.end_time": '"16 ms"', "thermal.models": '["lumped", "fe"]', "thermal.fe.coupling": '"windowed"'},
    "reduced finite elements": {"run.end_time": '"40 ms"', "thermal.models": '["lumped", "fe"]'},
}
EXPECTED_ENDS = {0, -signal.SIGKILL, 130, 143, -signal.SIGINT, -signal.SIGTERM}


def command(program, kind, folder):
    words = [program, "run", str(CASE), "-o", str(folder), "--quiet"]
    for key, value in {**COMMON, **KINDS[kind]}.items():
        words += ["--set", f"{key}={value}"]
    return words


def content(folder):
    """Every series of the results; the summary without times of the machine."""
    found = {}
    with h5py.File(folder / "results.h5") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu" else None)
    summary = json.loads((folder / "summary.json").read_text())
    for key in ("wall_time", "cpu_time", "rhs_evaluations"):
        summary["run"].pop(key)
    for key, value in summary.pop("windows", {}).items():
        if isinstance(value, (int, float)) and key != "cpu_time":
            found[f"windows/summary/{key}"] = numpy.array([float(value)])
    take_numbers("summary", summary, found)
    return found


def take_numbers(path, value, found):
    """What a summary holds, each under its own path: numbers to compare, the rest as text."""
    if isinstance(value, (dict, list)):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            take_numbers(f"{path}/{key}", item, found)
    else:
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        found[path] = numpy.array([float(value)]) if is_number else json.dumps(value)


def difference(a, b, of=None):
    """Nothing if the bits are the same, else the largest difference over the largest value, or over that of what they are differences of; infinity if
    there is no comparing."""
    if isinstance(a, str) or not isinstance(b, numpy.ndarray) or a.shape != b.shape:
        return None if isinstance(a, str) and isinstance(b, str) and a == b else math.inf
    return None if a.tobytes() == b.tobytes() else float(numpy.nanmax(numpy.abs(a - b)) / numpy.nanmax(numpy.abs(a if of is None else of)))


def differences(whole, resumed):
    """By name, of what is not the same; what only one of them holds counts as infinitely different."""
    found = {}
    for name in whole.keys() | resumed.keys():
        values = whole.get(name, "")
        size = difference(values, resumed.get(name), whole.get(minuend(name)))
        if size is not None:
            found[name] = size
    return found


def minuend(name):
    """What a small difference of large numbers is judged against, for their roundoff is that of the large ones; none for all else."""
    if name == "windows/summary/heat_residual":
        return "windows/summary/heat_stored"
    rise = re.fullmatch(r"summary/bearings/(\w+)/fe/surface_rise/(\w+)/\w+", name)
    return f"windows/{rise[1]}/{rise[2]}" if rise else None


def is_roundoff(name, size):
    """Rows at windows' ends lie within steps: ARKODE's interpolation in the first step after a resume differs by some 1e-12, and nothing else may. A
    window's error is the difference of two growths, a thousandth of them."""
    of_windows = name.startswith("windows/") or re.match(r"summary/bearings/\w+/fe/", name) is not None
    return of_windows and size < (1e-8 if "error" in name else 1e-11)


def run_killed(words, folder, length, rng):
    """Kills the run up to three times, then lets it end. Times killed, and its last exit code."""
    kills = 0
    for _ in range(rng.choice([1, 1, 2, 3])):
        process = subprocess.Popen(words + (["--resume"] if folder.exists() else []), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        # A third of the kills hits the start, where little time passes.
        time.sleep(rng.random() * (0.08 if rng.random() < 0.33 else length))
        process.send_signal(rng.choices([signal.SIGKILL, signal.SIGTERM, signal.SIGINT], [8, 1, 1])[0])
        error = process.communicate(timeout=60)[1]
        if process.returncode == 0:
            return kills, 0, error
        kills += 1
        if process.returncode not in EXPECTED_ENDS:
            return kills, process.returncode, error
    done = subprocess.run(words + (["--resume"] if folder.exists() else []), capture_output=True, text=True, timeout=120)
    return kills, done.returncode, done.stderr


def main(program, n_kills, seed):
    rng = random.Random(seed)
    found = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        kinds = list(KINDS)
        if not (pathlib.Path(program).parent / "rotordrop_fe.so").exists():
            kinds = kinds[:2]
        whole, length = {}, {}
        for kind in kinds:
            for _ in range(2):  # the second is as long as those that will be killed: sections are kept
                start = time.monotonic()
                subprocess.run(command(program, kind, scratch / kind) + ["--force"], check=True)
                length[kind] = time.monotonic() - start
            whole[kind] = content(scratch / kind)
        kills = runs = 0
        while kills < n_kills:
            kind, folder = kinds[runs % len(kinds)], scratch / f"run {runs}"
            runs += 1
            n, code, error = run_killed(command(program, kind, folder), folder, length[kind], rng)
            kills += n
            if code != 0:
                found[kind, "lost"] += 1
                print(f"{kind}, run {runs}: exit {code} after {n} kills\n{error}")
                continue
            resumed = content(folder)
            differing = differences(whole[kind], resumed)
            same_but_roundoff = not differing or kind == "windowed finite elements" and all(is_roundoff(name, size) for name, size in differing.items())
            found[kind, "the same bits" if not differing else "roundoff" if same_but_roundoff else "differs"] += 1
            if not same_but_roundoff:
                print(f"{kind}, run {runs}: after {n} kills these differ: {differing}")
    print(f"{runs} runs, {kills} kills, seed {seed}")
    for (kind, outcome), n in sorted(found.items()):
        print(f"{kind}: {outcome}: {n}")
    return 0 if all(outcome in ("the same bits", "roundoff") for _, outcome in found) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 200, int(sys.argv[3]) if len(sys.argv) > 3 else 1))

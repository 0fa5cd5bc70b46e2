#!/usr/bin/python3
"""Results that are cut off, filled with zeros or overwritten in places, then resumed and reported: no hang, no crash, no false end.

    tests/faults/damage.py build/release/rotordrop [COPIES]
"""

import collections
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

CASE = pathlib.Path(__file__).resolve().parents[2] / "params/neisi2019-settling.toml"
SETTINGS = ["--set", 'run.end_time="60 ms"', "--set", "integration.method=runge-kutta-4", "--set", 'integration.step="0.5 us"',
            "--set", 'output.checkpoint_interval="0.1 s"', "--quiet"]


def killed_run(program, folder):
    process = subprocess.Popen([program, "run", CASE, "-o", folder, *SETTINGS])
    while len(list(folder.glob("checkpoints/checkpoint-*.h5"))) < 3:
        assert process.poll() is None, "the run ended before it could be killed"
        time.sleep(0.02)
    process.kill()
    process.wait()


def damage(path, rng):
    """What was done to the file, in a word."""
    whole, used = path.stat().st_size, min(path.stat().st_size, path.stat().st_blocks * 512)
    kind = rng.choice(["cut off", "zero-filled", "overwritten"])
    with open(path, "r+b") as file:
        if kind == "overwritten":
            for _ in range(rng.choice([1, 20, 300])):
                file.seek(64 + int((used - 64) * rng.random() ** rng.choice([1, 4])))
                file.write(bytes([rng.randrange(256)]) * rng.choice([1, 8, 500]))
        else:
            file.truncate(int(used * rng.random()))
            if kind == "zero-filled":
                file.truncate(whole)
    return kind


def ended(command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=30)
    except subprocess.TimeoutExpired:
        return "hang"
    return done.returncode


def main(program, n_copies):
    rng = random.Random(1)
    found = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        sound, copy = pathlib.Path(scratch) / "sound", pathlib.Path(scratch) / "copy"
        killed_run(program, sound)
        for _ in range(n_copies):
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(sound, copy)
            kind = damage(copy / "results.h5", rng)
            found[kind, "report", ended([program, "report", copy, "--force"])] += 1
            found[kind, "resume", ended([program, "run", CASE, "-o", copy, "--resume", *SETTINGS])] += 1
    for (kind, command, code), n in sorted(found.items(), key=str):
        print(f"{kind}, {command}: exit {code}: {n}")
    return 0 if all(code in (0, 2) for _, _, code in found) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 60))

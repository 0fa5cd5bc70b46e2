#!/usr/bin/python3
"""Studies that are killed at random instants, then resumed with another number of workers or of ranks: every one ends with the bits of an unbroken
study. By turns the drops run in lanes and one by one. Some kills are followed by what a power cut may leave: a journal that has lost its last bytes, or holds wrong ones.

    tests/faults/study_kills.py build/release/rotordrop [KILLS] [SEED] [POINTS]

SIGKILL to every process at once. An instant lies anywhere between start and the time that the rest of the study would take. Exit code 1 if a study
differs, cannot go on, or hangs.
"""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CASE = pathlib.Path(__file__).resolve().parents[2] / "params/neisi2019-settling.toml"
STUDY = """
case = "CASE"
[vary]
contact.friction_coefficient = { range = [0.05, 0.3] }
damping = { keys = ["bearings.TB1.support.C_y", "bearings.TB2.support.C_y"], range = [1e3, 1e6], scale = "log" }
[design]
size = POINTS
[keep]
series = ["/bearings/TB1/contact_force"]
"""
FILES = ("study.h5", "study.csv")
METHODS = ("tsitouras", "dormand-prince")  # in lanes, and not


def below(process):
    """The process and all that it has started."""
    children = {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                children.setdefault(int((entry / "stat").read_text().rpartition(")")[2].split()[1]), []).append(int(entry.name))
            except OSError:
                pass
    found = [process]
    for pid in found:
        found += children.get(pid, [])
    return found


def kill(process):
    for pid in below(process.pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.communicate()


def damage(folder, rng):
    """What a power cut may leave of the journals' ends; the number of bytes behind the damage."""
    lost = 0
    for journal in sorted(folder.glob("*.journal")):
        content = journal.read_bytes()
        begin = content.find(b"\n") + 1
        if begin == 0 or len(content) - begin < 10:
            continue
        at = rng.randrange(max(begin, len(content) - 20000), len(content))
        kind = rng.choice(["cut", "zeros", "digit"])
        digits = [i for i in range(at, len(content)) if content[i - 1 : i] == b"." and content[i : i + 1].isdigit()]
        if kind == "digit" and digits:  # a number that is still one: only the check sum tells
            journal.write_bytes(content[: digits[0]] + str((int(content[digits[0] : digits[0] + 1]) + 5) % 10).encode() + content[digits[0] + 1 :])
        else:
            journal.write_bytes(content[:at] if kind == "cut" else content[:at] + bytes(len(content) - at))
        lost += len(content) - at
    return lost


def command(program, output, method, jobs, ranks):
    words = [program, "study", "s.toml", "-o", output, "--quiet", "--resume", "--set", 'run.end_time="20 ms"']
    words += ["--set", f'integration.method="{method}"']
    if ranks == 1:
        return words + ["--jobs", str(jobs)]
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] + words


def main(program, n_kills=20, seed=1, points=40):
    rng = random.Random(seed)
    program = str(pathlib.Path(program).resolve())
    has_ranks = shutil.which("mpirun") is not None and (pathlib.Path(program).parent / "rotordrop_mpi.so").is_file()
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "s.toml").write_text(STUDY.replace("CASE", str(CASE)).replace("POINTS", str(points)))
        length, whole = {}, {}
        for method in METHODS:
            start = time.monotonic()
            subprocess.run(command(program, method, method, 1, 1), cwd=scratch, check=True)
            length[method] = time.monotonic() - start
            whole[method] = {name: (scratch / method / name).read_bytes() for name in FILES}
        kills = studies = 0
        while kills < n_kills:
            method = METHODS[studies % len(METHODS)]
            studies += 1
            folder = scratch / "killed"
            shutil.rmtree(folder, ignore_errors=True)
            left, is_over = min(n_kills - kills, 5), False
            while not is_over:
                jobs, ranks = rng.randint(1, 3), 3 if has_ranks and rng.random() < 0.3 else 1
                words = command(program, "killed", method, jobs, ranks)
                process = subprocess.Popen(words, cwd=scratch, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                try:
                    error = process.communicate(timeout=rng.random() * length[method] if left > 0 else 20 * length[method] + 60)[1]
                    is_over = True
                except subprocess.TimeoutExpired:
                    kill(process)
                    if left == 0:
                        print(f"study {studies} hangs")
                        return 1
                    left -= 1
                    kills += 1
                    lost = damage(folder, rng) if folder.exists() and rng.random() < 0.7 else 0
                    rows = sum(journal.read_bytes().count(b'"point"') for journal in folder.glob("*.journal"))
                    print(f"kill {kills}: {method}, {ranks} ranks, {jobs if ranks == 1 else 1} workers, {rows} of {points} rows, {lost} bytes damaged")
            if process.returncode != 0:
                print(f"study {studies}: exit {process.returncode}\n{error}")
                return 1
            different = [name for name in FILES if (folder / name).read_bytes() != whole[method][name]]
            if different:
                print(f"study {studies}: {', '.join(different)} differ")
                return 1
    print(f"{studies} studies, {kills} kills, seed {seed}: the same bits")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:5])))

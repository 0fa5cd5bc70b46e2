#!/usr/bin/env python3
"""CPU of drops from Python beside the same drops by the program.

    /usr/bin/python3 benchmarks/python_drops.py [--drops 100] [--rounds 3] [--build build/release]

The same friction coefficients run as points of `rotordrop study --jobs 1` and in a loop over case.run(keep=[]) of one Python process, in turn; what counts is the CPU
of the whole process (user and system), start and reading of cases included. The least of the rounds is compared. A third column keeps all series.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

from child_cpu import with_cpu_of_children

ROOT = pathlib.Path(__file__).resolve().parents[1]
CASE = ROOT / "params/neisi2019-settling.toml"
LOOP = """
import sys
import rotordrop as rd
case, n, end, keep = sys.argv[1], int(sys.argv[2]), sys.argv[3], None if sys.argv[4] == "all" else []
for i in range(n):
    rd.Case(case, {"contact.friction_coefficient": 0.05 + 0.2 * i / n, "run.end_time": end}).run(keep=keep).summary["bearings"]["TB1"]["peak_contact_force"]
"""


def cpu_of(command, **options):
    """CPU of a process and its children [s]."""
    return with_cpu_of_children(lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL, **options))[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--drops", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--end-time", default="0.3 s", help="of each drop")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    a = parser.parse_args()
    environment = {**os.environ, "PYTHONPATH": str(a.build.resolve() / "python")}
    values = ", ".join(repr(0.05 + 0.2 * i / a.drops) for i in range(a.drops))
    least = {}
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder, "study.toml")
        study.write_text(f'case = "{CASE}"\n[vary]\ncontact.friction_coefficient = [{values}]\n[design]\nkind = "list"\n')
        commands = {
            "program": [a.build / "rotordrop", "study", study, "--jobs", "1", "--force", "--quiet", "-o", pathlib.Path(folder, "out"), "--set", f"run.end_time={a.end_time}"],
            "Python": [sys.executable, "-c", LOOP, CASE, str(a.drops), a.end_time, "none"],
            "Python, all series": [sys.executable, "-c", LOOP, CASE, str(a.drops), a.end_time, "all"],
        }
        for turn in range(a.rounds):
            for name, command in commands.items():
                cpu = cpu_of([str(word) for word in command], env=environment)
                least[name] = min(cpu, least.get(name, cpu))
                print(f"round {turn + 1}  {name:20} {cpu:8.2f} s", flush=True)
    for name, cpu in least.items():
        print(f"{name:20} {cpu:8.2f} s for {a.drops} drops  {100 * (cpu / least['program'] - 1):+6.2f} %")


if __name__ == "__main__":
    main()

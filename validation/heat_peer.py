"""Runs a case of `rotordrop heat` and compares its probes with those of another program: what heat_getdp.py and heat_freefem.py share."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib


def compare(case_file, solve, *, other, command, package, tolerance):
    """Prints both programs' probes side by side. Arguments of the script: [rotordrop [a file for the report as JSON]].

    solve(case, folder) returns {probe: rises over ambient at the output times [K]} and a sentence on the other program's size and cost.
    The exit code: 0 within `tolerance` of the largest rise or if the program is not installed, else 1.
    """
    program = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "build/release/rotordrop"
    if not shutil.which(command):
        print(f"skipped: {other} is not installed (apt-get install {package})")
        return 0
    case = tomllib.loads(case_file.read_text())
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        subprocess.run([program, "heat", case_file, "-o", folder / "out", "--quiet"], check=True)
        ours = json.loads((folder / "out/summary.json").read_text())
        theirs, cost = solve(case, folder)
    largest = max(max(rises) for rises in theirs.values())
    worst = 0.0
    print(f"  {'time [s]':8s}   {'probe':16s} {'rotordrop [K]':>14s}  {other + ' [K]':>14s}   difference/largest rise")
    for i, t in enumerate(case["output_times"]):
        for name, rises in theirs.items():
            mine = ours["probes"][name]["temperature"][i] - case["run"]["ambient"]
            difference = (mine - rises[i]) / largest
            worst = max(worst, abs(difference))
            print(f"  {t:8.4g}   {name:16s} {mine:14.6f}  {rises[i]:14.6f}   {difference:9.1e}")
    energy = ours["energy"]
    print(f"largest rise {largest:.3f} K; largest difference {worst:.1e} of it; {energy['lost'] / energy['input']:.1%} of {energy['input']:.4g} J lost by convection, residual {energy['residual']:.1e} J")
    print(f"rotordrop: {ours['unknowns']} unknowns, {ours['steps']} steps, {ours['cpu_time']:.2f} s of CPU; {other}: {cost}. The two are not set to the same accuracy.")
    if len(sys.argv) > 2:
        report = {"other": other, "largest_rise": largest, "largest_difference": worst * largest, "relative_difference": worst, "tolerance": tolerance,
                  "energy_residual": energy["residual"], "energy_input": energy["input"]}
        pathlib.Path(sys.argv[2]).write_text(json.dumps(report))
    return 0 if worst <= tolerance else 1

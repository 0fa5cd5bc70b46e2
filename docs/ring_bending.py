"""Rings that bend against rigid rings: the tables and the figure of docs/theory/ring-bending.md.

    /usr/bin/python3 docs/ring_bending.py build/release/rotordrop FOLDER

The settling reference case. First impact: 15 ms, with eight places of the balls (bearings.cage_phase) for rigid rings, contact over an arc and at a point.
Convergence: the same 15 ms over harmonics, frequency limit, tolerance and damping, against the finest of each. Cost: the whole drop. Writes
FOLDER/ring-bending.png and ring-bending.json, and prints the tables in Markdown.
"""

import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

PARAMS = pathlib.Path(__file__).resolve().parents[1] / "params"
MODELS = ("none", "arc", "point")
NAMES = {"none": "rigid", "arc": "bent, arc", "point": "bent, point"}
PHASES = [k / 8 for k in range(8)]
BEARINGS = ("TB1", "TB2")


class Runs:
    def __init__(self, program, folder):
        self.program, self.folder, self.count = program, folder, 0

    def __call__(self, **keys):
        """Summary of the settling case with settings KEY__PART=value."""
        settings = {key.replace("__", "."): value for key, value in keys.items()}
        self.count += 1
        output = self.folder / f"run{self.count}"
        words = [self.program, "run", str(PARAMS / "neisi2019-settling.toml"), "-o", str(output), "--force"]
        for key, value in settings.items():
            words += ["--set", f"{key}={json.dumps(value)}"]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{words}: {done.stderr}")
        return json.loads((output / "summary.json").read_text())


def first_impact(runs, model, **keys):
    return runs(run__end_time="15 ms", bearings__ring_bending=model, **keys)


def largest(summary, name):
    return summary["bearings"][name]["largest_ball_force"]


def spread(values):
    return f"{np.mean(values):.0f} ({min(values):.0f} to {max(values):.0f})"


def phases(runs):
    results = {model: [first_impact(runs, model, bearings__cage_phase=phase) for phase in PHASES] for model in MODELS}
    print("| | rigid | bent, arc | bent, point |\n|---|---|---|---|")
    for name in BEARINGS:
        rows = {
            "largest ball load [N]": lambda s: largest(s, name),
            "peak contact force [N]": lambda s: s["bearings"][name]["peak_contact_force"],
        }
        for text, value in rows.items():
            print(f"| {name}: {text} | " + " | ".join(spread([value(s) for s in results[m]]) for m in MODELS) + " |")
        safety = {m: [s["bearings"][name]["static_safety"] for s in results[m]] for m in MODELS}
        print(f"| {name}: static safety of the worst ball | " + " | ".join(f"{np.mean(safety[m]):.2f} ({min(safety[m]):.2f} to {max(safety[m]):.2f})" for m in MODELS) + " |")
    residual = max(abs(s["energy"]["residual"]) for all_of in results.values() for s in all_of)
    print(f"\nLargest energy residual of these runs: {residual:.1e} J")
    return results


def convergence(runs):
    def table(title, key, values, model, **more):
        summaries = [first_impact(runs, model, **{key: v}, **more) for v in values]
        print(f"\n| {title} ({NAMES[model]}) | " + " | ".join(f"{name} ball load [N] | {name} peak force [N]" for name in BEARINGS) + " |\n|---|---|---|---|---|")
        for value, s in zip(values, summaries):
            cells = " | ".join(f"{largest(s, n):.1f} | {s['bearings'][n]['peak_contact_force']:.1f}" for n in BEARINGS)
            print(f"| {value} | {cells} |")
        return [{n: largest(s, n) for n in BEARINGS} for s in summaries]

    for model in ("arc", "point"):
        table("harmonics to n =", "bearings__ring_harmonics", [4, 6, 8, 10, 12, 16, 20, 28], model)
    table("frequency limit", "bearings__ring_frequency_limit", ["5 kHz", "10 kHz", "20 kHz", "40 kHz", "80 kHz"], "arc")
    table("tolerance", "integration__tolerance", [1e-5, 1e-6, 3e-7, 1e-7, 1e-8], "arc")
    table("damping ratio", "bearings__ring_bending_damping", [0.0, 0.01, 0.02, 0.05], "arc")


def cost(runs):
    print("\n| whole drop of 0.3 s | CPU [s] | right-hand sides | energy residual [J] | friction heat TB1, TB2 [J] | largest ball load TB1, TB2 [N] |\n|---|---|---|---|---|---|")
    for model in MODELS:
        several = [runs(bearings__ring_bending=model) for _ in range(5)]
        s = min(several, key=lambda one: one["run"]["cpu_time"])
        heat = ", ".join(f"{s['bearings'][n]['friction_heat']:.1f}" for n in BEARINGS)
        balls = ", ".join(f"{largest(s, n):.0f}" for n in BEARINGS)
        print(f"| {NAMES[model]} | {s['run']['cpu_time']:.3f} | {s['run']['rhs_evaluations']} | {s['energy']['residual']:.1e} | {heat} | {balls} |")


def picture(results, path):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4))
    for axis, name in zip(axes, BEARINGS):
        for model, colour in zip(MODELS, ("#444444", "#2166ac", "#ef8a62")):
            axis.plot(PHASES, [largest(s, name) for s in results[model]], "o-", color=colour, label=NAMES[model])
        axis.set_title(name)
        axis.set_xlabel("place of the first ball at the start [ball spacings]")
        axis.set_ylim(bottom=0)
    axes[0].set_ylabel("largest ball load in 15 ms [N]")
    axes[1].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    program, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    runs = Runs(program, folder)
    results = phases(runs)
    picture(results, folder / "ring-bending.png")
    (folder / "ring-bending.json").write_text(json.dumps({m: [{n: largest(s, n) for n in BEARINGS} for s in r] for m, r in results.items()}, indent=1))
    convergence(runs)
    cost(runs)


if __name__ == "__main__":
    main()

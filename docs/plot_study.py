#!/usr/bin/env python3
"""Figure for the first study of docs/how-to/studies.md: peak force over support damping and friction, from the study of params/studies/support-damping.toml.

    rotordrop study params/studies/support-damping.toml -o out/support-damping
    /usr/bin/python3 docs/plot_study.py out/support-damping [-o docs/images/study.png]
"""

import argparse
import json
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLUMNS = "/parameters/damping", "/parameters/contact.friction_coefficient", "/results/peak_force"


def refusal(text):
    """Exit code of bad input, once its reason is told."""
    print(f"error: {text}", file=sys.stderr)
    return 2


def compared_levels(damping, best):
    """The best level, and another one: the smallest, or the largest if that is the best."""
    return [best] + [level for level in (min(damping), max(damping)) if level != best][:1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent / "images/study.png")
    arguments = parser.parse_args()
    files = [arguments.directory / name for name in ("study.h5", "study.json")]
    for file in files:
        if not file.is_file():
            sys.exit(refusal(f"{file} is missing; name the directory of a finished study."))
    choose = json.loads(files[1].read_text()).get("choose")
    if not choose or choose.get("best") is None:
        sys.exit(refusal(f"the study in {arguments.directory} chooses no best level by [choose]; this figure is that of params/studies/support-damping.toml."))
    with h5py.File(files[0]) as study:
        missing = [path for path in COLUMNS if path not in study]
        if missing:
            sys.exit(refusal(f"{files[0]} has no column {missing[0]}; this figure is that of params/studies/support-damping.toml."))
        damping, friction, force = (study[path][:] for path in COLUMNS)
    force *= 1e-3
    levels = [level for level in choose["levels"] if level.get("quantile") is not None]

    figure, axes = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained", sharey=True)
    points = axes[0].scatter(damping * 1e-3, force, c=friction, s=12, cmap="viridis")
    figure.colorbar(points, ax=axes[0], label="friction coefficient")
    x, quantile = [level["value"] * 1e-3 for level in levels], [level["quantile"] * 1e-3 for level in levels]
    low = [(level["quantile"] - (level["low"] if level["low"] is not None else level["quantile"])) * 1e-3 for level in levels]
    high = [((level["high"] if level["high"] is not None else level["quantile"]) - level["quantile"]) * 1e-3 for level in levels]
    axes[0].errorbar(x, quantile, yerr=[low, high], fmt="k_-", capsize=3, label=f"{100 * choose['quantile']:.0f} % quantile, 95 % interval")
    axes[0].set(xscale="log", xlabel="damping of each support [kN s/m]", ylabel="peak contact force [kN]")
    axes[0].legend(loc="upper left")
    for value, colour in zip(compared_levels(damping, choose["best"]["value"]), ("tab:blue", "tab:orange")):
        axes[1].plot(friction[damping == value], force[damping == value], ".", color=colour, label=f"{value * 1e-3:g} kN s/m")
    axes[1].set(xlabel="friction coefficient")
    axes[1].legend(loc="upper right")
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()

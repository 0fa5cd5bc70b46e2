#!/usr/bin/env python3
"""Draws the figures of a comparison: lumped circuit against finite elements, and one run against another.

    python3 examples/plot_comparison.py DIR [--against DIR2]

reads DIR/comparison.h5 (made by `rotordrop compare`, or at the end of a run with both models) and DIR/results.h5, and writes PNGs into
DIR/figures. With --against, contact forces of the other run are drawn too. What the files do not hold is left out, and named at the end.

Needs h5py and matplotlib (Debian: python3-h5py, python3-matplotlib). Exit codes: 0 done, 2 nothing to draw from.
"""

import argparse
import json
import pathlib
import sys

from plot_drop import (NODES, ROTOR_COLOUR, Case, Results, STYLE, draw_into, finished, legend, legend_above, nothing_drawn, np, plt, read_summary,
                       stack, stand_on_zero)

LUMPED_COLOUR, MEAN_COLOUR, LOCAL_COLOUR, FLASH_COLOUR = "#D55E00", "#0072B2", "#CC79A7", "#333333"
IMPACT_TIME = 5e-3  # s, of the zoom
GROWTH = {"shaft": (0, "#333333"), "bore": (1, "#D55E00"), "inner race": (2, "#0072B2"), "outer race": (3, "#009E73")}


class Comparison(Case):
    """A run with the comparison beside it, and perhaps another run."""

    def __init__(self, directory, against):
        super().__init__(Results(directory / "results.h5"), read_summary(directory / "summary.json"))
        self.report = json.loads((directory / "comparison.json").read_text(encoding="utf-8"))
        self.bores = Results(directory / "comparison.h5")
        self.against = Results(against / "results.h5") if against else None
        self.driver = self.report["run"]["driver"]

    @property
    def is_windowed(self):
        return "/windows/time" in self.results.file

    def fe(self, bearing, name):
        """Times and values of the finite elements; surfaces have the columns mean, lowest, highest."""
        return self.results.get(f"/{'windows' if self.is_windowed else 'fe'}/{bearing}/{name}")

    def growth(self, bearing, model):
        if model == "fe" and self.is_windowed:
            return self.results.get(f"/windows/{bearing}/growth")
        return self.results.get(f"/growth/{model}/{bearing}")

    def lumped(self, bearing, node):
        return self.results.get(f"/thermal/{bearing}/{node}")

    def ambient(self, bearing):
        series = self.lumped(bearing, "inner_ring") or self.fe(bearing, "inner_ring")
        return float(series[1].flat[0]) if series is not None else 0.0


def titled(case, axes, bearing, text):
    axes.set_title(f"{bearing}: {text}", color=case.colour[bearing])


def comparison_temperatures(case):
    """Node against mean of the finite elements, with what their surface has."""
    bearings = case.results.bearings
    figure, axes = plt.subplots(len(bearings), 2, figsize=(9.6, 3.0 * len(bearings) + 0.4), sharex=True, squeeze=False)
    drawn = False
    for row, bearing in zip(axes, bearings):
        ambient = case.ambient(bearing)
        bore, node, mean = case.fe(bearing, "bore"), case.lumped(bearing, "inner_ring"), case.fe(bearing, "inner_ring")
        if bore is not None:
            row[0].plot(case.scaled(bore[0]), bore[1][:, 0] - ambient, color=MEAN_COLOUR, alpha=0.55, linewidth=0.9, label="bore, circumferential mean (FE)")
            row[0].fill_between(case.scaled(bore[0]), bore[1][:, 1] - ambient, bore[1][:, 2] - ambient, color=MEAN_COLOUR, alpha=0.25, linewidth=0,
                                label="its range across the width")
        race = case.fe(bearing, "inner_raceway")
        if race is not None:
            row[0].plot(case.scaled(race[0]), race[1][:, 0] - ambient, color="#009E73", linewidth=0.9, label="inner raceway, circumferential mean (FE)")
        if mean is not None:
            row[0].plot(case.scaled(mean[0]), mean[1] - ambient, color=MEAN_COLOUR, label="inner ring, mean (FE)")
        if node is not None:
            row[0].plot(case.scaled(node[0]), node[1] - ambient, color=LUMPED_COLOUR, linestyle="--", label="inner ring (circuit)")
        titled(case, row[0], bearing, "inner ring")
        row[0].set_ylabel("temperature rise [K]")
        for name in ("shaft", "ball", "outer_ring", "housing"):
            label, colour = NODES[name]
            lumped, fe = case.lumped(bearing, name), case.fe(bearing, name)
            if fe is not None:
                row[1].plot(case.scaled(fe[0]), (fe[1] if fe[1].ndim == 1 else fe[1][:, 0]) - ambient, color=colour, label=f"{label}")
            if lumped is not None:
                row[1].plot(case.scaled(lumped[0]), lumped[1] - ambient, color=colour, linestyle="--")
            drawn |= fe is not None or lumped is not None
        titled(case, row[1], bearing, "other bodies; circuit dashed")
        for panel in row:
            case.time_axis(panel)
            if panel.lines:
                stand_on_zero(panel)
            else:
                nothing_drawn(panel)
    for panel in axes[0]:
        legend(panel, loc="best")
    for panel in axes[:-1].flat:
        panel.set_xlabel("")
    return finished(figure, drawn)


def comparison_impact(case):
    """The first milliseconds after the first contact."""
    bearings = [b for b in case.results.bearings if case.report["bearings"].get(b, {}).get("first_contact_time") is not None]
    if not bearings:
        return None
    figure, axes = plt.subplots(2, len(bearings), figsize=(4.9 * len(bearings), 6.0), squeeze=False, sharex="col")
    for column, bearing in zip(axes.T, bearings):
        start, ambient = case.report["bearings"][bearing]["first_contact_time"], case.ambient(bearing)
        lines = (("local", LOCAL_COLOUR, "-", "hottest point (moving band)"), ("flash", FLASH_COLOUR, ":", "under the contact"),
                 ("mean", MEAN_COLOUR, "-", "bore, circumferential mean (FE)"), ("inner_ring", LUMPED_COLOUR, "--", "inner ring (circuit)"))
        for name, colour, style, label in lines:
            series = case.bores.get(f"/bore/{bearing}/{name}")
            if series is None:
                continue
            zoom = (series[0] >= start - 0.2e-3) & (series[0] <= start + IMPACT_TIME)
            times, values = 1e3 * (series[0][zoom] - start), series[1][zoom] - ambient
            for panel in column if name in ("mean", "inner_ring") else column[:1]:
                panel.plot(times, values, color=colour, linestyle=style, label=label, linewidth=1.6 if name == "flash" else 1.2)
        titled(case, column[0], bearing, "bore during the first impact")
        column[1].set_title("means only", fontweight="normal")
        for panel in column:
            panel.set_ylabel("temperature rise [K]")
            panel.set_xlim(-0.2, 1e3 * IMPACT_TIME)
            stand_on_zero(panel)
        column[1].set_xlabel("time since first contact [ms]")
    for panel in axes[0]:
        panel.set_ylim(top=1.25 * panel.get_ylim()[1])  # room for the legend
    legend(axes[0, 0], loc="upper right", ncol=2, columnspacing=1.2)
    return figure


def comparison_growth(case):
    bearings = case.results.bearings
    figure, axes = stack(len(bearings), 2.8)
    drawn = False
    for panel, bearing in zip(axes, bearings):
        for model, style in (("fe", "-"), ("lumped", "--")):
            series = case.growth(bearing, model)
            if series is None:
                continue
            for label, (column, colour) in GROWTH.items():
                panel.plot(case.scaled(series[0]), 1e6 * series[1][:, column], color=colour, linestyle=style, label=label if model == "fe" else None)
            drawn = True
        titled(case, panel, bearing, "thermal growth; circuit dashed, finite elements solid")
        panel.set_ylabel("radial growth [µm]")
        case.time_axis(panel)
        legend(panel, loc="upper left")
    for panel in axes[:-1]:
        panel.set_xlabel("")
    return finished(figure, drawn)


def comparison_forces(case):
    """Contact forces of both runs, and what they differ by."""
    if case.against is None:
        return None
    bearings = case.results.bearings
    other = case.report.get("against", {}).get("driver", "other run")
    figure, axes = stack(2 * len(bearings), 1.9)
    drawn = False
    for k, bearing in enumerate(bearings):
        mine, theirs = case.results.get(f"/bearings/{bearing}/contact_force"), case.against.get(f"/bearings/{bearing}/contact_force")
        if mine is None or theirs is None:
            continue
        panel, difference = axes[2 * k : 2 * k + 2]
        panel.plot(case.scaled(mine[0]), 1e-3 * mine[1], color=case.colour[bearing], linewidth=0.9, label=f"driver {case.driver}")
        panel.plot(case.scaled(theirs[0]), 1e-3 * theirs[1], color=ROTOR_COLOUR, linewidth=0.9, linestyle=":", label=f"driver {other}")
        panel.set_ylabel("force [kN]")
        titled(case, panel, bearing, "contact force")
        stand_on_zero(panel)
        legend_above(panel, 2)
        difference.plot(case.scaled(mine[0]), np.interp(mine[0], *theirs) - mine[1], color=case.colour[bearing], linewidth=0.8)
        difference.set_ylabel("difference [N]")
        drawn = True
    for panel in axes:
        case.time_axis(panel)
    for panel in axes[:-1]:
        panel.set_xlabel("")
    return finished(figure, drawn)


FIGURES = [comparison_temperatures, comparison_impact, comparison_growth, comparison_forces]


def main():
    parser = argparse.ArgumentParser(description="Draws the figures of a comparison into DIR/figures.")
    parser.add_argument("directory", metavar="DIR", type=pathlib.Path, help="directory with results.h5, comparison.json and comparison.h5")
    parser.add_argument("--against", metavar="DIR2", type=pathlib.Path, help="directory of another run, for contact forces")
    parser.add_argument("--dpi", type=float, default=150, help="dots per inch of the pictures (default: 150)")
    arguments = parser.parse_args()
    directory, against = arguments.directory, arguments.against
    needed = [directory / name for name in ("results.h5", "comparison.json", "comparison.h5")] + ([against / "results.h5"] if against else [])
    for path in needed:
        if not path.is_file():
            advice = "Make it with `rotordrop compare DIR`." if path.stem == "comparison" else "Give the directory of a run's results."
            print(f"error: there is no {path}. {advice}", file=sys.stderr)
            return 2
    plt.rcParams.update(STYLE)
    try:
        case = Comparison(directory, against)
    except (OSError, ValueError) as error:
        print(f"error: the results cannot be read: {error}", file=sys.stderr)
        return 2
    written = [draw_into(directory / "figures", draw, case, arguments.dpi) for draw in FIGURES]
    written = [name for name in written if name]
    missing = case.results.missing + case.bores.missing
    if missing:
        print("not in the files: " + ", ".join(missing))
    if not written:
        print(f"error: {directory} holds nothing that could be drawn.", file=sys.stderr)
        return 2
    print(f"{directory / 'figures'}: {', '.join(written)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

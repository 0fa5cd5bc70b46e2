#!/usr/bin/env python3
"""Draws the figures of `rotordrop preload` into DIR/figures, one page per touchdown bearing and kind.

    python3 examples/plot_preload.py DIR

reads DIR/preload.h5 and DIR/preload.json. `running`: the way from cold, the balance of heat, operating points over speed; `maps`: preload, pressure and
stiffness over growth and over the rings' temperatures; `history`: over a drop, if there is one. What is not there is left out.

Needs h5py and matplotlib (Debian: python3-h5py, python3-matplotlib). Exit codes: 0 done, 2 nothing to draw from.
"""

import argparse
import json
import pathlib
import sys

import h5py
from plot_drop import STYLE, legend, np, plt

CELSIUS = 273.15
RPM = 30 / np.pi
COLOURS = ["#0072B2", "#009E73", "#D55E00", "#CC79A7", "#333333", "#E69F00", "#56B4E9"]
WORDS = {"stable": "stable", "runs-away": "runs away", "runs-away-on-the-way": "runs away on the way", "seized-from-the-start": "seized from the start",
         "undecided": "undecided"}


class Bearing:
    """One touchdown bearing in the file."""

    def __init__(self, file, report, name):
        self.file, self.report, self.name = file[name], report["bearings"][name], name
        self.running = self.report["running"]

    def get(self, path):
        return self.file[path][:] if path in self.file else None


def time_of(seconds):
    """Values, unit."""
    return (seconds / 3600, "h") if seconds[-1] > 7200 else (seconds / 60, "min") if seconds[-1] > 120 else (seconds, "s")


def way(bearing, temperatures, load):
    time = bearing.get("running/time")
    shown, unit = time_of(time)
    nodes = sorted(bearing.file[f"running/temperature/{bearing.name}"].items())
    fins = [node for name, node in nodes if name.startswith(("shaft_left", "shaft_right"))]
    for k, (name, node) in enumerate((name, node) for name, node in nodes if not name.startswith(("shaft_left", "shaft_right"))):
        temperatures.plot(shown, node[:] - CELSIUS, color=COLOURS[k % len(COLOURS)], label=name.replace("_", " "))
    for k, node in enumerate(fins):
        temperatures.plot(shown, node[:] - CELSIUS, color="#AAAAAA", linewidth=0.7, zorder=0, label=None if k else "shaft beside it")
    if time[-1] > 1000:  # seconds and hours in one picture
        for panel in (temperatures, load):
            panel.set_xscale("log")
            panel.set_xlim(shown[-1] * 1e-4, shown[-1])
    temperatures.set_ylabel("temperature [degC]")
    temperatures.set_xlabel(f"time [{unit}]")
    legend(temperatures, loc="best", fontsize=7)
    load.plot(shown, bearing.get("running/preload"), color=COLOURS[0])
    load.set_ylabel("preload [N]")
    load.set_xlabel(f"time [{unit}]")
    load.set_ylim(bottom=0)
    heat = load.twinx()
    heat.plot(shown, bearing.get("running/heat_rate"), color=COLOURS[2], linestyle="--")
    heat.set_ylabel("heat [W] (dashed)", color=COLOURS[2])
    heat.set_ylim(bottom=0)


def balance(bearing, panel):
    """Heat that friction makes over the heat in balance; operating points on the diagonal."""
    heat, made = bearing.get("balance/heat"), bearing.get("balance/made")
    points = bearing.running["operating_points"]
    top = 1.6 * max(p["heat"] for p in points) if points else max(heat[-1], np.nanmax(made))
    panel.plot(heat, made, color=COLOURS[2], label="made by friction in that state")
    panel.plot([0, top], [0, top], color="#888888", linewidth=0.8, label="given away")
    for p in points:
        filled = COLOURS[0] if p["stable"] else "white"
        panel.plot(p["heat"], p["heat"], "o", color=COLOURS[0], markerfacecolor=filled, zorder=5)
        panel.annotate(f"gain {p['loop_gain']:.2f}", (p["heat"], p["heat"]), textcoords="offset points", xytext=(7, -11), fontsize=8)
    panel.set_xlim(0, top)
    panel.set_ylim(0, top)
    panel.set_xlabel("heat of a steady state [W]")
    panel.set_ylabel("heat [W]")
    legend(panel, loc="upper left", fontsize=7)


def over_speed(bearing, panel):
    speed = bearing.get("operating_points/speed")
    if speed is None:
        panel.set_visible(False)
        return
    speed = speed * RPM
    preload, rate = bearing.get("operating_points/preload"), bearing.get("operating_points/growth_rate")
    for column in range(2):
        for stable in (True, False):
            values = np.where((rate[:, column] < 0) == stable, preload[:, column], np.nan)
            if np.isfinite(values).any():
                panel.plot(speed, values, color=COLOURS[0], linestyle="-" if stable else "--", marker=".", markersize=3, label="stable" if stable else "unstable")
    panel.axvline(bearing.running["speed"] * RPM, color="#888888", linewidth=0.8)
    critical = bearing.running["critical"].get("speed")
    if critical:
        panel.axvline(critical["value"] * RPM, color=COLOURS[2], linewidth=0.8, linestyle=":", label="critical")
    panel.set_xlabel("speed [rpm]")
    panel.set_ylabel("preload of operating points [N]")
    panel.set_ylim(bottom=0)
    legend(panel, loc="best", fontsize=7)


def running_page(bearing):
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 6.4))
    way(bearing, axes[0, 0], axes[0, 1])
    balance(bearing, axes[1, 0])
    over_speed(bearing, axes[1, 1])
    figure.suptitle(f"{bearing.name} at {bearing.running['speed'] * RPM:.0f} rpm: {WORDS[bearing.running['verdict']]}")
    return figure


def growth_curves(bearing, name, axes):
    x, speed = bearing.get(f"maps/{name}/{name}") * 1e6, bearing.get(f"maps/{name}/speed") * RPM
    for panel, (key, factor, label) in zip(axes, (("preload", 1, "preload [N]"), ("largest_pressure", 1e-9, "pressure [GPa]"),
                                                  ("axial_stiffness", 1e-6, "axial stiffness [N/um]"))):
        values = factor * bearing.get(f"maps/{name}/{key}").reshape(len(x), len(speed))
        for k, rpm in enumerate(speed):
            panel.plot(x, values[:, k], color=COLOURS[k % len(COLOURS)], label=f"{rpm:.0f} rpm")
        panel.set_xlabel(f"{name} [um]")
        panel.set_ylabel(label)
        panel.set_ylim(bottom=0)
    legend(axes[0], loc="best", fontsize=7)


def rise_maps(bearing, axes):
    x, y = bearing.get("maps/rise/inner_rise"), bearing.get("maps/rise/outer_rise")
    for panel, (key, factor, label) in zip(axes, (("preload", 1, "preload [N]"), ("largest_pressure", 1e-9, "pressure [GPa]"),
                                                  ("axial_stiffness", 1e-6, "axial stiffness [N/um]"))):
        values = np.ma.masked_invalid(factor * bearing.get(f"maps/rise/{key}").reshape(len(x), len(y))).T
        if values.count() == 0 or values.max() <= 0 or len(x) < 2 or len(y) < 2:
            panel.text(0.5, 0.5, "no ball is pressed", ha="center", transform=panel.transAxes)
            continue
        filled = panel.contourf(x, y, values, levels=12, cmap="viridis")
        panel.figure.colorbar(filled, ax=panel, label=label)
        panel.set_xlabel("rise of the inner ring [K]")
        panel.set_ylabel("rise of the outer ring [K]")


def maps_page(bearing):
    names = [name for name in ("growth", "interference") if f"maps/{name}" in bearing.file]
    has_rise = "maps/rise" in bearing.file
    n_rows = len(names) + has_rise
    if n_rows == 0:
        return None
    figure, axes = plt.subplots(n_rows, 3, figsize=(10.8, 3.0 * n_rows), squeeze=False)
    for row, name in zip(axes, names):
        growth_curves(bearing, name, row)
    if has_rise:
        rise_maps(bearing, axes[-1])
    figure.suptitle(f"{bearing.name}: maps of preload")
    return figure


def history_page(bearing):
    time = bearing.get("history/time")
    if time is None:
        return None
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 6.0), sharex=True)
    for panel, (key, factor, label) in zip(axes.flat, (("preload", 1, "preload [N]"), ("largest_ball_load", 1, "largest ball load [N]"),
                                                       ("largest_pressure", 1e-9, "largest pressure [GPa]"), ("radial_clearance", 1e6, "clearance [um]"))):
        panel.plot(1e3 * time, factor * bearing.get(f"history/{key}"), color=COLOURS[0], linewidth=0.9)
        panel.set_ylabel(label)
    for panel in axes[-1]:
        panel.set_xlabel("time [ms]")
    loaded = "under the recorded load" if bearing.report["history"]["under_load"] else "without load"
    figure.suptitle(f"{bearing.name} over {bearing.report['history']['results_of']}, {loaded}")
    return figure


PAGES = {"running": running_page, "maps": maps_page, "history": history_page}


def main():
    parser = argparse.ArgumentParser(description="Draws the figures of `rotordrop preload` into DIR/figures.")
    parser.add_argument("directory", metavar="DIR", type=pathlib.Path, help="directory with preload.h5 and preload.json")
    parser.add_argument("--dpi", type=float, default=150, help="dots per inch of the pictures (default: 150)")
    arguments = parser.parse_args()
    directory = arguments.directory
    for name in ("preload.h5", "preload.json"):
        if not (directory / name).is_file():
            print(f"error: there is no {directory / name}. Make it with `rotordrop preload CASE -o {directory}`.", file=sys.stderr)
            return 2
    plt.rcParams.update(STYLE)
    report = json.loads((directory / "preload.json").read_text(encoding="utf-8"))
    figures = directory / "figures"
    figures.mkdir(exist_ok=True)
    written = []
    with h5py.File(directory / "preload.h5", "r") as file:
        for name in report["bearings"]:
            bearing = Bearing(file, report, name)
            for page, draw in PAGES.items():
                figure = draw(bearing)
                if figure is None:
                    continue
                figure.savefig(figures / f"{name}-{page}.png", dpi=arguments.dpi)
                plt.close(figure)
                written.append(f"{name}-{page}.png")
    print(f"{figures}: {', '.join(written)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

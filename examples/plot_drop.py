#!/usr/bin/env python3
"""Draws the figures of a rotor drop.

    python3 examples/plot_drop.py DIR

reads DIR/results.h5 (and DIR/summary.json, if there is one) and writes PNGs into DIR/figures. It also works while the run goes
on and after it was killed. What the file does not hold is left out, and named at the end.

Needs h5py and matplotlib (Debian: python3-h5py, python3-matplotlib). Exit codes: 0 done, 2 nothing to draw from.
"""

import argparse
import json
import multiprocessing
import pathlib
import re
import sys
import tomllib

try:
    import h5py
    import matplotlib
    import numpy as np
except ImportError as error:
    sys.exit(f"error: {error}. Install python3-h5py and python3-matplotlib, or try /usr/bin/python3 (this is {sys.executable}).")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)
import matplotlib.ticker  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap, to_rgb  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

# Okabe & Ito: told apart by everyone.
BEARING_COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
ROTOR_COLOUR = "#333333"
GAP_STYLE = dict(color="#888888", linewidth=1.0, linestyle=(0, (5, 3)))
# From the shaft outwards.
NODES = {
    "shaft": ("shaft", "#333333"),
    "inner_ring": ("inner ring", "#D55E00"),
    "inner_contact": ("inner contact", "#E69F00"),
    "ball": ("balls", "#009E73"),
    "outer_contact": ("outer contact", "#56B4E9"),
    "outer_ring": ("outer ring", "#0072B2"),
    "housing": ("housing", "#CC79A7"),
}
ZOOM_END = 60e-3  # s
RPM = 60 / (2 * np.pi)

STYLE = {
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "grid.color": "#e6e6e6",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "xtick.major.width": 0.8,
    "ytick.major.width": 0.8,
    "figure.constrained_layout.use": True,
    "agg.path.chunksize": 20000,
}


class Results:
    """A result file; remembers what was asked for in vain."""

    def __init__(self, path):
        self.missing = []
        try:
            self.file = h5py.File(path, "r", swmr=True)  # also while it is being written, or after the run was killed
        except (OSError, ValueError):
            self.file = h5py.File(path, "r")

    def _names(self, group):
        node = self.file.get(group)
        # TB2 before TB10.
        return sorted(node, key=lambda name: [(word.isdigit(), int(word) if word.isdigit() else word) for word in re.split(r"(\d+)", name) if word]) if isinstance(node, h5py.Group) else []

    @property
    def bearings(self):
        """Touchdown bearings; linear supports have no contact."""
        return [name for name in self._names("/bearings") if f"/bearings/{name}/contact_force" in self.file]

    @property
    def thermal_models(self):
        return self._names("/thermal")

    @property
    def meshed(self):
        """Bearings whose section the finite elements follow."""
        return self._names("/fe") or [name for name in self._names("/windows") if isinstance(self.file[f"/windows/{name}"], h5py.Group)]

    def attribute(self, name, default=""):
        value = self.file.attrs.get(name, default)
        return value.decode() if isinstance(value, bytes) else str(value)

    def get(self, name, quiet=False):
        """Times [s] and values of a dataset, of equal length; None if it is missing, empty or never finite."""
        dataset = self.file.get(name)
        if isinstance(dataset, h5py.Dataset) and dataset.ndim in (1, 2):
            time_path = dataset.attrs.get("time", "/time")
            times = self.file.get(time_path.decode() if isinstance(time_path, bytes) else time_path)
            if isinstance(times, h5py.Dataset):
                n = min(len(times), len(dataset))  # in a file being written the times come last
                values = dataset[:n]
                if n > 1 and np.isfinite(values).any():
                    return times[:n], values
        if not quiet and name not in self.missing:
            self.missing.append(name)
        return None

    def parameters(self):
        text = self.file["/parameters"][()] if "/parameters" in self.file else ""
        return text.decode() if isinstance(text, bytes) else str(text)

    def end_time(self):
        times = self.file.get("/time")
        return float(times[-1]) if isinstance(times, h5py.Dataset) and len(times) else 1.0


def gravity_of(parameters):
    """run.gravity of a case along x, y, z [m/s^2]; of one number along -y. None if the text has none that can be read."""
    try:
        gravity = tomllib.loads(parameters)["run"]["gravity"]
        if isinstance(gravity, list):
            return [float(component) for component in gravity]
        return [0.0, -float(str(gravity).split()[0]), 0.0]
    except (KeyError, ValueError, IndexError):
        return None


def axis_words(gravity, axis):
    """", upwards" and the like of y (1) or z (2), where gravity acts along one of the two; otherwise nothing."""
    acting = [k for k in range(3) if gravity[k]] if gravity else []
    if acting == [axis]:
        return ", upwards" if gravity[axis] < 0 else ", downwards"
    return ", horizontal" if acting == [3 - axis] else ""


class Case:
    """A result file with what all its figures share: names, colours, the axis of time."""

    def __init__(self, results, summary):
        self.results = results
        self.gravity = gravity_of(results.parameters())
        self.name = results.attribute("case") or summary.get("case") or ""
        self.colour = {name: BEARING_COLOURS[i % len(BEARING_COLOURS)] for i, name in enumerate(results.bearings)}
        self.end = results.end_time()
        self.in_ms = self.end <= 2
        self.time_unit = "ms" if self.in_ms else "s"
        self._summary = summary

    def axis_label(self, axis):
        return f"{'xyz'[axis]}{axis_words(self.gravity, axis)} [µm]"

    def scaled(self, times):
        return times * (1e3 if self.in_ms else 1)

    def gap(self, bearing):
        """Air gap [m] at the start, or None."""
        clearance = self.results.get(f"/bearings/{bearing}/clearance", quiet=True)
        if clearance is not None and np.isfinite(clearance[1].flat[0]):
            return float(clearance[1].flat[0])
        bearings = self._summary.get("bearings")
        entry = bearings.get(bearing, {}) if isinstance(bearings, dict) else {}
        gap = entry.get("air_gap", self._summary.get("air_gap")) if isinstance(entry, dict) else None
        return float(gap) if isinstance(gap, (int, float)) else None

    def ring_at_rest(self, bearing):
        """y, z [m] of the inner ring's centre at the start: it hangs in its balls, the more the larger their clearance."""
        series = self.results.get(f"/bearings/{bearing}/ring_position", quiet=True)
        return series[1][0] if series is not None and series[1].ndim == 2 else np.zeros(2)

    def time_axis(self, axes):
        # Rounded up to three digits: 299.99 ms would lose the tick at 300.
        end = self.scaled(self.end)
        digit = 10.0 ** (np.floor(np.log10(end)) - 2) if end > 0 else 1.0
        axes.set_xlim(0, max(digit, digit * np.ceil(end / digit - 1e-6)))
        axes.set_xlabel(f"time [{self.time_unit}]")

    def line(self, axes, name, scale=1.0, column=None, **style):
        """Draws a dataset against time; False if it is missing."""
        series = self.results.get(name)
        if series is None:
            return False
        times, values = series
        axes.plot(self.scaled(times), scale * (values if column is None else values[:, column]), **style)
        return True


def legend(axes, **options):
    if axes.get_legend_handles_labels()[0]:
        axes.legend(**options)


def legend_above(axes, columns):
    """Beside the title; what does not fit into a row goes into further ones, above which the title stands."""
    in_row = min(columns, 6)
    legend(axes, loc="lower right", bbox_to_anchor=(1, 1), ncol=in_row, borderaxespad=0.2)
    rows = -(-columns // in_row)
    if rows > 1:
        axes.set_title(axes.get_title(loc="left"), pad=14 * rows + 2)


def stand_on_zero(axes):
    """Lets the vertical axis begin at 0 if nothing is below."""
    values = [line.get_ydata() for line in axes.lines if len(line.get_ydata())]
    low, high = min((np.nanmin(v) for v in values), default=0), max((np.nanmax(v) for v in values), default=0)
    if low >= -1e-6 * abs(high):  # roundoff is no value below 0
        axes.set_ylim(bottom=0)


def nothing_drawn(axes):
    axes.text(0.5, 0.5, "not recorded in this file", transform=axes.transAxes, ha="center", va="center", color="#999999")
    axes.grid(False)
    axes.set_xticks([])
    axes.set_yticks([])


def stack(n, height=2.3, width=7.2):
    """n panels over one axis of time."""
    figure, axes = plt.subplots(n, 1, figsize=(width, height * n + 0.5), sharex=True, squeeze=False)
    return figure, list(axes[:, 0])


# Panels: each draws into given axes and returns whether there was anything to draw. ------------------------------------------


def orbit_reach(case):
    """Half the side of every orbit's picture [um]: equal air gaps are equal circles."""
    reach = 0.0
    for bearing in case.results.bearings:
        series = case.results.get(f"/bearings/{bearing}/orbit", quiet=True)
        if series is not None:
            reach = max(reach, np.nanmax(np.abs(series[1] - case.ring_at_rest(bearing))), case.gap(bearing) or 0.0)
    return 1e6 * reach


def orbit_panel(case, axes, bearing, with_legend=True):
    axes.set_title(f"{bearing}: orbit of the rotor", color=case.colour[bearing])
    series = case.results.get(f"/bearings/{bearing}/orbit")
    if series is None:
        nothing_drawn(axes)
        return False
    _, values = series
    y, z = 1e6 * values[:, 0], 1e6 * values[:, 1]
    points = np.column_stack([z, y])
    # Early parts pale, late parts strong.
    colour = np.array(to_rgb(case.colour[bearing]))
    shades = LinearSegmentedColormap.from_list("shades", [0.30 * colour + 0.70, colour, 0.45 * colour])
    segments = np.stack([points[:-1], points[1:]], axis=1)
    axes.add_collection(LineCollection(segments, array=np.linspace(0, 1, len(segments)), cmap=shades, linewidths=0.6))
    axes.plot(*points[0], "o", color="white", markeredgecolor=ROTOR_COLOUR, markersize=5, label="start", zorder=5)
    axes.plot(*points[-1], "o", color=ROTOR_COLOUR, markersize=5, label="end", zorder=5)
    centre = 1e6 * case.ring_at_rest(bearing)[::-1]  # z, y
    reach = orbit_reach(case)
    gap = case.gap(bearing)
    if gap is not None:
        angle = np.linspace(0, 2 * np.pi, 361)
        axes.plot(centre[0] + 1e6 * gap * np.cos(angle), centre[1] + 1e6 * gap * np.sin(angle), label="air gap", **GAP_STYLE)
    axes.set_aspect("equal")
    axes.set_xlim(centre[0] - 1.08 * reach, centre[0] + 1.08 * reach)
    axes.set_ylim(centre[1] - 1.08 * reach, centre[1] + 1.08 * reach)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(matplotlib.ticker.MaxNLocator(7, symmetric=True, steps=[1, 2, 5, 10]))
    axes.set_xlabel(case.axis_label(2))
    axes.set_ylabel(case.axis_label(1))
    if with_legend:  # in the upper half of the circle: the rotor falls away from there
        legend(axes, loc="upper center", bbox_to_anchor=(0.5, 0.83), handlelength=1.6, labelspacing=0.3)
    return True


def in_the_bore(case, bearings):
    """For titles of the normal force in the bore: it leaves out what shoulders of the rotor press on the rings."""
    found = [case.results.get(f"/bearings/{bearing}/shoulder_force", quiet=True) for bearing in bearings]
    return ", in the bore" if any(series is not None and series[1].any() for series in found) else ""


def force_panel(case, axes, bearings, with_zoom=True):
    drawn = [b for b in bearings
             if case.line(axes, f"/bearings/{b}/contact_force", 1e-3, color=case.colour[b], label=b, linewidth=0.8, alpha=0.85)]
    axes.set_ylabel("contact force [kN]")
    case.time_axis(axes)
    axes.set_ylim(bottom=0)
    if not drawn:
        nothing_drawn(axes)
        return False
    if with_zoom and case.end > 2 * ZOOM_END:
        # Room for the inset above the bounces.
        axes.set_ylim(0, 1.08 * axes.get_ylim()[1])
        inset = axes.inset_axes([0.40, 0.44, 0.59, 0.52])
        for bearing in drawn:
            times, values = case.results.get(f"/bearings/{bearing}/contact_force")
            early = times <= ZOOM_END
            inset.plot(case.scaled(times[early]), 1e-3 * values[early], color=case.colour[bearing], linewidth=0.9, alpha=0.85)
        inset.set_xlim(0, case.scaled(ZOOM_END))
        inset.set_ylim(bottom=0)
        inset.tick_params(labelsize=7, length=2, pad=1.5)
        inset.set_facecolor("#fafafa")
        inset.set_title(f"first {case.scaled(ZOOM_END):g} {case.time_unit}", fontsize=7, fontweight="normal", loc="right", pad=2)
    return True


def speed_panel(case, axes, bearings):
    drawn = case.line(axes, "/rotor/spin_speed", RPM, color=ROTOR_COLOUR, linestyle="--", label="rotor")
    for bearing in bearings:
        drawn |= case.line(axes, f"/bearings/{bearing}/ring_speed", RPM, color=case.colour[bearing], label=f"{bearing} inner ring")
    axes.set_ylabel("speed [rpm]")
    case.time_axis(axes)
    stand_on_zero(axes)
    if not drawn:
        nothing_drawn(axes)
    legend(axes, loc="best")
    return drawn


def rub_heat_panel(case, axes, bearings):
    drawn = False
    for bearing in bearings:
        drawn |= case.line(axes, f"/bearings/{bearing}/rub_heat_rate", 1e-3, color=case.colour[bearing], label=bearing, linewidth=0.8,
                           alpha=0.85)
    axes.set_ylabel("rub heat rate [kW]")
    case.time_axis(axes)
    axes.set_ylim(bottom=0)
    if not drawn:
        nothing_drawn(axes)
    legend(axes, loc="upper right")
    return drawn


# What the finite elements have for a node of the circuit: a body's mean, or the mean over a surface.
MESHED_NODES = {"inner_contact": "inner_raceway", "outer_contact": "outer_raceway"}


def meshed(case, bearing, node):
    """Times [s] and temperature [K] of a node by the finite elements; None if they did not run."""
    for group in ("fe", "windows"):
        series = case.results.get(f"/{group}/{bearing}/{MESHED_NODES.get(node, node)}", quiet=True)
        if series is not None:
            times, values = series
            return times, values if values.ndim == 1 else values[:, 0]
    return None


def temperature_panel(case, axes, bearing, nodes):
    """Nodes of the circuit, and dashed what the finite elements have for them."""
    drawn = False
    for node in nodes:
        label, colour = NODES[node]
        for series, style in ((case.results.get(f"/thermal/{bearing}/{node}", quiet=bearing in case.results.meshed), "-"), (meshed(case, bearing, node), "--")):
            if series is None:
                continue
            times, values = series
            axes.plot(case.scaled(times), values - values[0], style, color=colour, label=label)
            label = None
            drawn = True
    case.time_axis(axes)
    stand_on_zero(axes)
    if not drawn:
        nothing_drawn(axes)
    legend(axes, loc="upper left")
    return drawn


def temperatures_in_short(case, axes):
    """Few nodes of all thermal models: colour tells the bearing, the line's style the node."""
    styles = {"inner_ring": "-", "shaft": "--", "ball": ":"}
    models, nodes = {}, {}
    for model in case.results.thermal_models:
        for node, style in styles.items():
            colour = case.colour.get(model, ROTOR_COLOUR)
            series = case.results.get(f"/thermal/{model}/{node}")
            if series is None:
                continue
            axes.plot(case.scaled(series[0]), series[1] - series[1][0], linestyle=style, color=colour)
            models[model] = Line2D([], [], color=colour, label=model)
            nodes[node] = Line2D([], [], color="#777777", linestyle=style, label=NODES[node][0])
    axes.set_title("Temperature")
    axes.set_ylabel("temperature rise [K]")
    case.time_axis(axes)
    if not models:
        nothing_drawn(axes)
        return False
    stand_on_zero(axes)
    axes.set_ylim(top=1.12 * axes.get_ylim()[1])
    first = axes.legend(handles=list(models.values()), loc="upper left")
    axes.add_artist(first)
    axes.legend(handles=[nodes[n] for n in styles if n in nodes], loc="upper left", bbox_to_anchor=(0.2, 1.0))
    return True


# Figures: each returns a figure, or None if there is nothing to draw. ---------------------------------------------------------


def finished(figure, drawn):
    if drawn:
        return figure
    plt.close(figure)
    return None


def orbits(case):
    bearings = case.results.bearings
    if not bearings:
        return None
    columns = min(len(bearings), 4)
    rows = -(-len(bearings) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.9 * columns, 4.3 * rows), squeeze=False)
    drawn = [orbit_panel(case, a, b) for a, b in zip(axes.flat, bearings)]
    for panel in axes.flat[len(bearings):]:
        panel.set_visible(False)
    figure.supxlabel("View along +x: positive spin is clockwise. Pale = early, dark = late.", fontsize=7.5, color="#777777")
    return finished(figure, any(drawn))


def displacements(case):
    bearings = case.results.bearings
    if not bearings:
        return None
    figure, axes = stack(2)
    drawn = False
    gap_label = "air gap, ring at rest"
    for column, (panel, label) in enumerate(zip(axes, (case.axis_label(1), case.axis_label(2)))):
        for bearing in bearings:
            drawn |= case.line(panel, f"/bearings/{bearing}/orbit", 1e6, column, color=case.colour[bearing], label=bearing,
                               linewidth=0.9)
        for bearing in bearings:
            gap = case.gap(bearing)
            for sign in (1, -1) if gap is not None else ():
                style = {**GAP_STYLE, "color": case.colour[bearing], "alpha": 0.6, "linewidth": 0.8}
                panel.axhline(1e6 * (case.ring_at_rest(bearing)[column] + sign * gap), label=gap_label, **style)
                gap_label = None
        panel.set_ylabel(label)
        case.time_axis(panel)
    axes[0].set_xlabel("")
    axes[0].set_title("Displacement of the rotor at the bearings")
    legend_above(axes[0], 1 + len(bearings))
    return finished(figure, drawn)


def contact_forces(case):
    bearings = case.results.bearings
    if not bearings:
        return None
    figure, axes = stack(len(bearings), 2.5)
    drawn = False
    for panel, bearing in zip(axes, bearings):
        drawn |= force_panel(case, panel, [bearing])
        panel.set_title(f"{bearing}: force between rotor and inner ring{in_the_bore(case, [bearing])}", color=case.colour[bearing])
    for panel in axes[:-1]:
        panel.set_xlabel("")
    return finished(figure, drawn)


def speeds(case):
    figure, (axes,) = stack(1, 3.2)
    drawn = speed_panel(case, axes, case.results.bearings)
    axes.set_title("Speed of the rotor and of the inner rings")
    return finished(figure, drawn)


def torques(case):
    bearings = case.results.bearings
    kinds = [("load_torque", "load", "-", 0.8), ("drag_torque", "drag", "--", 1.2), ("spin_torque", "spin", ":", 1.1)]
    if not bearings:
        return None
    figure, axes = stack(len(bearings))
    drawn = False
    for panel, bearing in zip(axes, bearings):
        for (kind, label, line, width), shade in zip(kinds, (1.0, 0.55, 0.55)):
            colour = shade * np.array(to_rgb(case.colour[bearing]))
            drawn |= case.line(panel, f"/bearings/{bearing}/{kind}", 1.0, color=colour, linestyle=line, label=label, linewidth=width)
        panel.set_title(f"{bearing}: friction torque in the bearing", color=case.colour[bearing])
        panel.set_ylabel("torque [N m]")
        case.time_axis(panel)
        stand_on_zero(panel)
        legend_above(panel, 3)
    for panel in axes[:-1]:
        panel.set_xlabel("")
    return finished(figure, drawn)


def heat_rates(case):
    bearings = case.results.bearings
    if not bearings:
        return None
    figure, axes = stack(1 + len(bearings))
    drawn = rub_heat_panel(case, axes[0], bearings)
    axes[0].set_title("Rub heat rate between rotor and inner ring")
    for panel, bearing in zip(axes[1:], bearings):
        for kind, style, shade in (("outer", "--", 0.5), ("inner", "-", 1.0)):
            drawn |= case.line(panel, f"/bearings/{bearing}/{kind}_heat_rate", 1.0, linestyle=style, linewidth=0.9,
                               color=shade * np.array(to_rgb(case.colour[bearing])), label=f"{kind} raceway")
        panel.set_title(f"{bearing}: bearing friction heat rate", color=case.colour[bearing])
        panel.set_ylabel("heat rate [W]")
        case.time_axis(panel)
        stand_on_zero(panel)
        legend_above(panel, 2)
    for panel in axes[:-1]:
        panel.set_xlabel("")
    return finished(figure, drawn)


def temperatures(case):
    models = sorted({*case.results.thermal_models, *case.results.meshed})
    if not models:
        return None
    figure, axes = plt.subplots(len(models), 2, figsize=(9.0, 2.7 * len(models) + 0.4), sharex=True, squeeze=False)
    drawn = False
    parts = (("shaft, inner_ring, inner_contact", "shaft and inner ring"), ("ball, outer_contact, outer_ring, housing", "balls, outer ring and housing"))
    for row, model in zip(axes, models):
        for panel, (nodes, title) in zip(row, parts):
            drawn |= temperature_panel(case, panel, model, nodes.split(", "))
            panel.set_title(f"{model}: {title}", color=case.colour.get(model, ROTOR_COLOUR))
        row[0].set_ylabel("temperature rise [K]")
    for panel in axes[:-1].flat:
        panel.set_xlabel("")
    if case.results.meshed and case.results.thermal_models:
        figure.suptitle("mean temperatures: circuit (lines) and finite elements (dashed)", fontsize=9, color="#555555")
    return finished(figure, drawn)


# Ledgers of a bearing that hold dissipated energy, from those that are large in most drops.
BEARING_LEDGERS = {
    "rub_heat": ("rub between rotor and ring", "#D55E00"),
    "inner_heat": ("inner raceways", "#E69F00"),
    "outer_heat": ("outer raceways", "#56B4E9"),
    "ball_damping": ("ball contact damping", "#009E73"),
    "contact_damping": ("contact damping, rotor and ring", "#CC79A7"),
    "support_damping": ("support damping", "#0072B2"),
}


def dissipation_by_kind(case):
    """Times [s], and {label: (energy [J], colour)}, all bearings together; what no ledger names is the rest."""
    total = case.results.get("/energy/dissipated")
    kinds, times = {}, None if total is None else total[0]

    def add(label, colour, series):
        nonlocal times
        times = series[0] if times is None else times
        energy = np.interp(times, *series)
        kinds[label] = (energy + kinds[label][0] if label in kinds else energy, colour)

    for ledger, (label, colour) in BEARING_LEDGERS.items():
        for bearing in case.results.bearings:
            series = case.results.get(f"/ledger/{bearing}/{ledger}", quiet=True)
            if series is not None:
                add(label, colour, series)
    series = case.results.get("/ledger/rotor_damping", quiet=True)
    if series is not None:
        add("damping of the rotor", "#333333", series)
    series = case.results.get("/ledger/windage", quiet=True)
    if series is not None:
        add("windage of the rotor", "#7f9fbf", series)
    if total is not None:
        rest = total[1] - sum(energy for energy, _ in kinds.values())
        if np.nanmax(np.abs(rest)) > 1e-6 * np.nanmax(np.abs(total[1])):
            kinds["other" if kinds else "all"] = (rest, "#999999")
    return times, kinds


def energy(case):
    figure, axes = stack(3)
    times, kinds = dissipation_by_kind(case)
    drawn = bool(kinds)
    if kinds:
        # Large ones below; what would be less than a line's width is left to the next panel.
        kinds = dict(sorted(kinds.items(), key=lambda item: -item[1][0][-1]))
        visible = {label: kind for label, kind in kinds.items() if abs(kind[0][-1]) > 0.004 * max(abs(k[0][-1]) for k in kinds.values())}
        axes[0].stackplot(case.scaled(times), *(energy for energy, _ in visible.values()), labels=visible,
                          colors=[colour for _, colour in visible.values()], linewidth=0)
        handles, labels = axes[0].get_legend_handles_labels()
        axes[0].legend(handles[::-1], labels[::-1], loc="upper left")
        for label, (values, colour) in kinds.items():
            axes[1].plot(case.scaled(times), np.where(values > 0, values, np.nan), color=colour, label=label)
        case.line(axes[1], "/energy/heat_lost", color="#777777", linestyle=":", label="heat lost to ambient")
        axes[1].set_yscale("log")
        largest = max(np.nanmax(values) for values, _ in kinds.values())
        if largest > 0:
            axes[1].set_ylim(1e-6 * largest, 3 * largest)
        legend(axes[1], loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7)
    else:
        nothing_drawn(axes[0])
        nothing_drawn(axes[1])
    axes[0].set_title("Energy dissipated, by kind")
    axes[1].set_title("The same by kind, logarithmic scale")
    for panel in axes[:2]:
        panel.set_ylabel("energy [J]")
        case.time_axis(panel)
        panel.set_xlabel("")

    balance = False
    for name, label, colour in (("residual", "mechanical", "#0072B2"), ("heat_residual", "heat", "#D55E00")):
        balance |= case.line(axes[2], f"/energy/{name}", 1.0, color=colour, label=label, linewidth=0.9)
    if not balance:
        nothing_drawn(axes[2])
    axes[2].set_title("Energy-balance residual")
    axes[2].set_ylabel("energy [J]")
    axes[2].ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
    case.time_axis(axes[2])
    legend_above(axes[2], 2)
    return finished(figure, drawn or balance)


def overview(case):
    bearings = case.results.bearings
    if not bearings:
        return None
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.8))
    if case.name:
        figure.suptitle(case.name, fontsize=12, fontweight="bold")
    drawn = orbit_panel(case, axes[0, 0], bearings[0])
    if len(bearings) > 1:
        drawn |= orbit_panel(case, axes[0, 1], bearings[1], with_legend=False)
    else:
        panel = axes[0, 1]
        drawn |= case.line(panel, f"/bearings/{bearings[0]}/orbit", 1e6, 0, color=case.colour[bearings[0]])
        panel.set_title("Displacement of the rotor along y")
        panel.set_ylabel(case.axis_label(1))
        case.time_axis(panel)
    drawn |= force_panel(case, axes[0, 2], bearings)
    axes[0, 2].set_title(f"Contact force between rotor and inner ring{in_the_bore(case, bearings)}")
    drawn |= speed_panel(case, axes[1, 0], bearings)
    axes[1, 0].set_title("Speed")
    drawn |= rub_heat_panel(case, axes[1, 1], bearings)
    axes[1, 1].set_title("Rub heat rate")
    drawn |= temperatures_in_short(case, axes[1, 2])
    return finished(figure, drawn)


FIGURES = [overview, orbits, displacements, contact_forces, speeds, torques, heat_rates, temperatures, energy]


def read_summary(path):
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
        return summary if isinstance(summary, dict) else {}
    except FileNotFoundError:
        return {}
    except (OSError, ValueError) as error:
        print(f"{path} was not used: {error}")
        return {}


def draw_into(folder, draw, case, dpi):
    """Draws one figure into a folder; the file's name, or None if there was nothing to draw."""
    figure = draw(case)
    if figure is None:
        return None
    folder.mkdir(exist_ok=True)
    # The layout once, then one drawing: savefig alone would draw twice.
    figure.get_layout_engine().execute(figure)
    figure.set_layout_engine("none")
    figure.savefig(folder / f"{draw.__name__}.png", dpi=dpi)
    plt.close(figure)
    return f"{draw.__name__}.png"


def draw_figures(directory, figures, dpi):
    """Draws into DIR/figures. Returns the names of the files written, and of what was asked for in vain."""
    plt.rcParams.update(STYLE)
    results = Results(directory / "results.h5")
    case = Case(results, read_summary(directory / "summary.json"))
    written = [draw_into(directory / "figures", draw, case, dpi) for draw in figures]
    return [name for name in written if name], results.missing


def draw_in_two_processes(directory, dpi):
    """As draw_figures() of all figures, in about half the time."""
    fork = multiprocessing.get_context("fork")
    receiver, sender = fork.Pipe(duplex=False)

    def draw_half():
        sender.send(draw_figures(directory, FIGURES[1::2], dpi))

    helper = fork.Process(target=draw_half)
    helper.start()
    sender.close()
    written, missing = draw_figures(directory, FIGURES[::2], dpi)
    try:
        more_written, more_missing = receiver.recv()
    except EOFError:
        raise RuntimeError("some figures could not be drawn, see above") from None
    finally:
        helper.join()
    names = [f"{draw.__name__}.png" for draw in FIGURES]
    return sorted(written + more_written, key=names.index), list(dict.fromkeys(missing + more_missing))


def main():
    parser = argparse.ArgumentParser(description="Draws the figures of a rotor drop into DIR/figures.")
    parser.add_argument("directory", metavar="DIR", type=pathlib.Path, help="directory with results.h5 and summary.json")
    parser.add_argument("--dpi", type=float, default=150, help="dots per inch of the pictures (default: 150)")
    arguments = parser.parse_args()

    path = arguments.directory / "results.h5"
    if not path.is_file():
        print(f"error: there is no {path}. Give the directory of a run's results.", file=sys.stderr)
        return 2
    try:
        Results(path).file.close()
    except (OSError, ValueError) as error:
        print(f"error: {path} cannot be read: {error}", file=sys.stderr)
        return 2
    written, missing = draw_in_two_processes(arguments.directory, arguments.dpi)
    if missing:
        print("not in the file, or still empty: " + ", ".join(missing))
    if not written:
        print(f"error: {path} holds nothing that could be drawn.", file=sys.stderr)
        return 2
    print(f"{arguments.directory / 'figures'}: {', '.join(written)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

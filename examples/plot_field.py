#!/usr/bin/env python3
"""Draws the temperature fields of a run as pictures.

    python3 examples/plot_field.py DIR [--name NAME] [--zoom X0 X1 R0 R1] [--rise] [--linear] [--contact-sheet-only]

DIR is the folder of a `rotordrop heat` or `rotordrop run` with fields (field_times or field_interval), or its folder fields. Writes, for each series
NAME.pvd, a PNG per time and a contact sheet of all of them, NAME-sheet.png, into DIR/figures/fields. All pictures of a series have one scale. The files
themselves open in ParaView; this script reads them without it (rotordrop_results.py).

Needs h5py, numpy and matplotlib (Debian: python3-h5py, python3-matplotlib). Exit codes: 0 done, 2 nothing to draw from.
"""

import argparse
import pathlib
import sys

try:
    import matplotlib
    import numpy as np
    from rotordrop_results import RISE, TEMPERATURE, read_series, read_vtu  # beside this file
except ImportError as error:
    sys.exit(f"error: {error}. Install python3-h5py and python3-matplotlib, or try /usr/bin/python3 (this is {sys.executable}).")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402


def are_within(lines, body):
    """Which lines [n, 2, 2] in mm are within a body [n]. Cells beside a curved surface are drawn with curved edges and their neighbours with straight ones: such a
    pair has one common end, and its middles are a bit apart. Roundoff may part both ends."""
    near, roundoff = 0.05, 1e-4  # of their length; mm
    middle, length = lines.mean(axis=1), np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
    within = np.zeros(len(lines), dtype=bool)
    for i, line in enumerate(lines):
        apart = np.linalg.norm(middle - middle[i], axis=1)
        candidates = np.flatnonzero((apart < np.maximum(roundoff, near * length[i])) & (body == body[i]))
        for k in candidates[candidates != i]:
            meets = np.linalg.norm(line[:, None] - lines[k][None], axis=2).min() < roundoff
            within[i] |= apart[k] < roundoff or meets
    return within


def outline(field):
    """Segments that belong to one cell alone, as lines [n, 2, 2] in mm: bodies' edges, since files have each cell's points on their own."""
    places = np.round(field["points"][:, :2] * 1e9).astype(np.int64)
    _, number = np.unique(places, axis=0, return_inverse=True)
    number = number.reshape(-1)
    body = field["data"]["body"]
    edges = {}
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        ends = number[field["quads"][:, [a, b]]]
        for (i, j), quad in zip(np.sort(ends, axis=1).tolist(), field["quads"][:, [a, b]].tolist()):
            edges.setdefault((i, j, float(body[quad[0]]) if len(body) == len(places) else 0.0), []).append(quad)
    alone = [(quads[0], key[2]) for key, quads in edges.items() if len(quads) == 1]
    lines = field["points"][np.array([ends for ends, _ in alone]), :2] * 1e3
    return lines[~are_within(lines, np.array([body for _, body in alone]))]


def draw(axes, field, values, norm, edges, zoom):
    x, r = 1e3 * field["points"][:, 0], 1e3 * field["points"][:, 1]
    quads = field["quads"]
    # Each quadrilateral as four triangles around its middle: no diagonal is preferred.
    n = len(x)
    middle = np.arange(n, n + len(quads))
    mean = lambda v: np.concatenate([v, v[quads].mean(axis=1)])  # noqa: E731
    triangles = np.concatenate([np.column_stack([quads[:, k], quads[:, (k + 1) % 4], middle]) for k in range(4)])
    picture = axes.tripcolor(Triangulation(mean(x), mean(r), triangles), mean(values), shading="gouraud", cmap="YlOrRd", norm=norm, rasterized=True)
    axes.add_collection(LineCollection(edges, colors="#555555", linewidths=0.6))
    axes.set_aspect("equal")
    if zoom:
        axes.set_xlim(zoom[:2])
        axes.set_ylim(zoom[2:])
    else:
        margin = 0.03 * max(np.ptp(x), np.ptp(r))
        axes.set_xlim(x.min() - margin, x.max() + margin)
        axes.set_ylim(r.min() - margin, r.max() + margin)
    axes.set_facecolor("#eeeeee")
    return picture


def add_colour_bar(figure, picture, axes, name):
    ticks = picture.norm.inverse(np.linspace(0.0, 1.0, 7))
    bar = figure.colorbar(picture, ax=axes, label=name, shrink=0.8, ticks=ticks)
    bar.ax.set_yticklabels([f"{tick + 0.0:.4g}" for tick in np.round(ticks, 2)])


def time_text(t):
    return "at the start" if t == 0 else f"t = {t * 1e3:.4g} ms" if t < 1 else f"t = {t:.4g} s"


def draw_series(pvd, target, arguments):
    series = read_series(pvd)
    if not series:
        print(f"{pvd} lists no field", file=sys.stderr)
        return 0
    name = RISE if arguments.rise else TEMPERATURE
    fields = [(t, read_vtu(file)) for t, file in series]
    lowest = min(f["data"][name].min() for _, f in fields)
    highest = max(f["data"][name].max() for _, f in fields)
    # What an impact heats is thin and hot, what it leaves wide and barely warm: a scale by the root shows both.
    norm = matplotlib.colors.PowerNorm(1.0 if arguments.linear else 0.4, lowest, max(highest, lowest + 1e-3))
    edges = outline(fields[0][1])
    target.mkdir(parents=True, exist_ok=True)
    if not arguments.contact_sheet_only:
        for i, (t, field) in enumerate(fields):
            figure, axes = plt.subplots(figsize=(7, 6), layout="constrained")
            picture = draw(axes, field, field["data"][name], norm, edges, arguments.zoom)
            values = np.round(field["data"][name], 2)
            axes.set_title(f"{pvd.stem}, {time_text(t)}: {values.min() + 0.0:.2f} to {values.max():.2f} K", fontsize=10)
            axes.set_xlabel("x [mm]")
            axes.set_ylabel("r [mm]")
            add_colour_bar(figure, picture, axes, name)
            figure.savefig(target / f"{pvd.stem}-{i:05d}.png", dpi=120)
            plt.close(figure)
    chosen = fields if len(fields) <= arguments.most else [fields[round(k * (len(fields) - 1) / (arguments.most - 1))] for k in range(arguments.most)]
    columns = min(4, len(chosen))
    rows = -(-len(chosen) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.2 * columns + 1, 3.0 * rows + 0.4), squeeze=False, sharex=True, sharey=True, layout="constrained")
    for axes, (t, field) in zip(grid.flat, chosen):
        picture = draw(axes, field, field["data"][name], norm, edges, arguments.zoom)
        axes.set_title(f"{time_text(t)}\nup to {field['data'][name].max():.2f} K", fontsize=8)
        axes.tick_params(labelsize=7)
    for axes in grid.flat[len(chosen) :]:
        axes.set_axis_off()
    figure.supxlabel("x [mm]", fontsize=9)
    figure.supylabel("r [mm]", fontsize=9)
    figure.suptitle(pvd.stem, fontsize=10)
    add_colour_bar(figure, picture, grid, name)
    figure.savefig(target / f"{pvd.stem}-sheet.png", dpi=120)
    plt.close(figure)
    return len(fields)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--name", help="only this series, such as TB1")
    parser.add_argument("--zoom", type=float, nargs=4, metavar=("X0", "X1", "R0", "R1"), help="part of the section [mm]")
    parser.add_argument("--rise", action="store_true", help="plot the rise above the initial temperature instead of the temperature")
    parser.add_argument("--linear", action="store_true", help="linear colour scale instead of the 0.4th power of the temperature above the coldest point")
    parser.add_argument("--contact-sheet-only", action="store_true", help="skip the individual pictures")
    parser.add_argument("--most", type=int, default=16, help="maximum number of pictures on the contact sheet (16)")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder for the pictures; DIR/figures/fields if left out")
    arguments = parser.parse_args()
    arguments.most = max(arguments.most, 2)
    folder = arguments.directory / "fields" if (arguments.directory / "fields").is_dir() else arguments.directory
    lists = sorted(folder.glob(f"{arguments.name or '*'}.pvd"))
    if not lists:
        print(f"error: no fields in {arguments.directory}. A case writes them with field_times or field_interval.", file=sys.stderr)
        return 2
    target = arguments.output or folder.parent / "figures/fields"
    for pvd in lists:
        n = draw_series(pvd, target, arguments)
        print(f"{pvd.stem}: {n} fields drawn into {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

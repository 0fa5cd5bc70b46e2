#!/usr/bin/env python3
"""Draws meshed sections: the whole one, the inner ring at its first row, and the strip there.

    build/release/rotordrop mesh params/neisi2019.toml -o out/mesh.msh
    /usr/bin/python3 docs/plot_mesh.py out/mesh-TB1.msh out/mesh-TB2.msh -o docs/images/mesh.png

Reads gmsh's ASCII formats 2.2 and 4.1 without gmsh.
"""

import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

BODY_COLOURS = {"inner_ring": "#c9dcee", "outer_ring": "#d9e8cf", "housing": "#e6e6e6", "shaft": "#f3e3c3"}
SIDE_COLOURS = {"strip": "#d62728", "raceway": "#ff9f1c", "inner": "#1f4e9c", "outer": "#1f4e9c", "left": "#8a8a8a", "right": "#8a8a8a"}
BORE_COLOUR = "#8e24aa"


def sections_of(text):
    """Sections of a file by name, each a list of lines."""
    sections, name = {}, None
    for line in text.splitlines():
        if line.startswith("$End"):
            name = None
        elif line.startswith("$"):
            name = line[1:].strip()
            sections[name] = []
        elif name:
            sections[name].append(line)
    return sections


def read_msh(path):
    """Vertices {number: (x, r)}, quadrilaterals [(body, vertices)], edges [(group, vertices)]."""
    sections = sections_of(pathlib.Path(path).read_text(encoding="utf-8"))
    names = {}
    for line in sections["PhysicalNames"][1:]:
        dimension, tag, name = line.split(maxsplit=2)
        names[int(dimension), int(tag)] = name.strip('"')
    if sections["MeshFormat"][0].startswith("2"):
        return read_2(sections, names)
    return read_4(sections, names)


def read_2(sections, names):
    vertices, cells, edges = {}, [], []
    for line in sections["Nodes"][1:]:
        number, x, r, _ = line.split()
        vertices[int(number)] = (float(x), float(r))
    for line in sections["Elements"][1:]:
        _, kind, n_tags, group, *rest = map(int, line.split())
        nodes = rest[n_tags - 1:]
        (cells if kind == 3 else edges).append((names[2 if kind == 3 else 1, group], nodes))
    return vertices, cells, edges


def read_4(sections, names):
    vertices, cells, edges = {}, [], []
    lines = iter(sections["Entities"])
    counts = list(map(int, next(lines).split()))
    group_of = {}
    for dimension, count in enumerate(counts):
        for _ in range(count):
            words = next(lines).split()
            first = 4 if dimension == 0 else 7
            if int(words[first]) > 0:
                group_of[dimension, int(words[0])] = int(words[first + 1])
    lines = iter(sections["Nodes"])
    for _ in range(int(next(lines).split()[0])):
        count = int(next(lines).split()[3])
        numbers = [int(next(lines)) for _ in range(count)]
        for number in numbers:
            x, r, _ = next(lines).split()
            vertices[number] = (float(x), float(r))
    lines = iter(sections["Elements"])
    for _ in range(int(next(lines).split()[0])):
        dimension, entity, kind, count = map(int, next(lines).split())
        for _ in range(count):
            nodes = list(map(int, next(lines).split()))[1:]
            if kind in (1, 3):
                (cells if kind == 3 else edges).append((names[dimension, group_of[dimension, entity]], nodes))
    return vertices, cells, edges


def in_mm(vertices, nodes):
    return [(1e3 * vertices[n][0], 1e3 * vertices[n][1]) for n in nodes]


def side_of(group):
    return group.split(".")[1].split("_")[0]


def colour_of(group):
    return BORE_COLOUR if group == "inner_ring.inner" else SIDE_COLOURS[side_of(group)]


def draw(axes, mesh, line_width, outline_width):
    vertices, cells, edges = mesh
    axes.add_collection(PolyCollection([in_mm(vertices, nodes) for _, nodes in cells], linewidths=line_width, edgecolors="#404040",
                                       facecolors=[BODY_COLOURS.get(body, "#f0d0d0") for body, _ in cells]))
    shown = sorted(edges, key=lambda edge: side_of(edge[0]) == "strip")  # strips on top
    axes.add_collection(LineCollection([in_mm(vertices, nodes) for _, nodes in shown], colors=[colour_of(group) for group, _ in shown],
                                       linewidths=outline_width, capstyle="round"))
    axes.set_aspect("equal")
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("r [mm]")


def draw_whole(axes, mesh, title):
    draw(axes, mesh, 0.25, 1.4)
    axes.autoscale_view()
    axes.set_title(title, loc="left", fontsize=10)
    vertices, cells, _ = mesh
    left, right = (1e3 * bound(x for x, _ in vertices.values()) for bound in (min, max))
    for body in sorted({body for body, _ in cells}):
        points = [p for name, nodes in cells if name == body for p in in_mm(vertices, nodes)]
        axes.text(right + 0.02 * (right - left), 0.5 * (min(p[1] for p in points) + max(p[1] for p in points)), body, va="center", fontsize=8)
    axes.set_xlim(left - 0.05 * (right - left), right + 0.28 * (right - left))


def points_of(mesh, beginning):
    vertices, _, edges = mesh
    return [p for group, nodes in edges if group.startswith(beginning) for p in in_mm(vertices, nodes)]


def draw_ring(axes, mesh):
    """The inner ring around its first strip, from the bore to the shoulder."""
    strip, ring = points_of(mesh, "inner_ring.strip_1"), points_of(mesh, "inner_ring.")
    draw(axes, mesh, 0.4, 2.0)
    centre = sum(p[0] for p in strip) / len(strip)
    low, high = min(p[1] for p in ring), max(p[1] for p in ring)
    margin = 0.06 * (high - low)
    axes.set_xlim(centre - 0.6 * (high - low), centre + 0.6 * (high - low))
    axes.set_ylim(low - margin, high + margin)
    axes.set_title("inner ring, row 1", loc="left", fontsize=10)


def draw_strip(axes, mesh):
    """The strip itself, where cells are thinnest."""
    strip = sorted(points_of(mesh, "inner_ring.strip_1"))
    x, r = strip[len(strip) // 2]
    draw(axes, mesh, 0.5, 2.6)
    half = 0.75 * (strip[-1][0] - strip[0][0])
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(r - 1.3 * half, r + 0.7 * half)
    axes.set_title("its strip", loc="left", fontsize=10)


def main():
    parser = argparse.ArgumentParser(description="Draws meshed sections.")
    parser.add_argument("meshes", nargs="+", help=".msh files")
    parser.add_argument("-o", "--output", default="mesh.png")
    arguments = parser.parse_args()
    meshes = [(pathlib.Path(path), read_msh(path)) for path in arguments.meshes]
    figure, rows = plt.subplots(len(meshes), 3, figsize=(15, 4.6 * len(meshes)), squeeze=False, width_ratios=[1.55, 1, 1])
    for (path, mesh), (whole, ring, strip) in zip(meshes, rows):
        draw_whole(whole, mesh, f"{path.stem.rpartition('-')[2]}: {len(mesh[1])} cells")
        draw_ring(ring, mesh)
        draw_strip(strip, mesh)
    handles = [plt.Line2D([], [], color=colour, lw=2) for colour in (SIDE_COLOURS["strip"], SIDE_COLOURS["raceway"], BORE_COLOUR, SIDE_COLOURS["inner"], SIDE_COLOURS["left"])]
    figure.legend(handles, ["strip", "raceway", "bore (inner_ring.inner)", "other inner and outer sides", "left and right faces"],
                  loc="lower center", ncols=5, fontsize=9, frameon=False)
    figure.tight_layout(rect=(0, 0.035, 1, 1))
    figure.savefig(arguments.output, dpi=110)
    return 0


if __name__ == "__main__":
    sys.exit(main())

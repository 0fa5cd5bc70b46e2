#!/usr/bin/env python3
"""End flare of a short ring with a hot surface layer: our finite elements against CalculiX.

    /usr/bin/python3 validation/growth_calculix.py [TEST_PROGRAM]

TEST_PROGRAM is build/release/test_verification_fe unless given. A free ring, 35 to 41 mm, 16 mm long, is warmer by 100 K (1 - (r - a)/1 mm) in the first
millimetre beside its bore. CalculiX (package calculix-ccx) has its own mesh (CAX8, graded), assembly and solver. Both fields of temperature are exact in
both programs: piecewise linear with the kink on a line of the meshes. Prints both displacements at points of bore and outside, and the largest difference
over the largest displacement. CalculiX makes its axisymmetric elements wedges of 2 degrees: all its radial displacements here are smaller than ours by
5.1e-5, which is 1 - sin(1 deg)/(1 deg), and the axial ones are not. Exit codes: 0 agreement within 1e-4, or CalculiX is not installed (said); 1 disagreement.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
A, B, LENGTH, LAYER, RISE = 35e-3, 41e-3, 16e-3, 1e-3, 100.0
E, NU, ALPHA = 2.05e11, 0.3, 11.8e-6
POINTS = [0.0, 0.125, 0.25, 0.5]  # of the length
TOLERANCE = 1e-4


def graded(start, end, n, power):
    return [start + (end - start) * (i / n) ** power for i in range(n + 1)]


def calculix(refinement, folder):
    """Displacements {(radius, place): (axial, radial)} [m] of the half from x = 0 to the middle, which symmetry holds."""
    nr_layer, nr_rest, nx = 10 * refinement, 10 * refinement, 10 * refinement
    radius = graded(A, A + LAYER, nr_layer, 1.0) + graded(A + LAYER, B, nr_rest, 1.5)[1:]
    place = []
    for begin, end, n, power in ((0.0, 0.125, nx, 1.4), (0.125, 0.25, nx // 2, 1.0), (0.25, 0.5, nx // 2, 1.0)):
        place += graded(begin * LENGTH, end * LENGTH, n, power)[(1 if place else 0) :]
    halves = lambda points: [p for a, b in zip(points, points[1:]) for p in (a, (a + b) / 2)] + [points[-1]]
    R, X = halves(radius), halves(place)
    node = lambda i, j: 1 + i + len(R) * j
    exists = lambda i, j: not (i % 2 and j % 2)  # eight nodes: none in the middle
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{node(i, j)}, {r:.12e}, {x:.12e}, 0." for j, x in enumerate(X) for i, r in enumerate(R) if exists(i, j)]
    lines.append("*ELEMENT, TYPE=CAX8, ELSET=RING")
    count = 0
    for j in range(0, len(X) - 1, 2):
        for i in range(0, len(R) - 1, 2):
            count += 1
            corners = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
            middles = [(i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
            lines.append(f"{count}, " + ", ".join(str(node(*p)) for p in corners + middles))
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E!r}, {NU!r}", "*EXPANSION, ZERO=0.", f"{ALPHA!r}", "*SOLID SECTION, ELSET=RING, MATERIAL=STEEL"]
    lines += ["*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL, 0.", "*BOUNDARY"]
    lines += [f"{node(i, len(X) - 1)}, 2, 2, 0." for i in range(len(R))]
    lines += ["*STEP", "*STATIC", "*TEMPERATURE"]
    for j in range(len(X)):
        for i, r in enumerate(R):
            if exists(i, j):
                lines.append(f"{node(i, j)}, {RISE * max(0.0, 1 - (r - A) / LAYER):.12e}")
    lines += ["*NODE PRINT, NSET=ALL", "U", "*END STEP", ""]
    (folder / "ring.inp").write_text("\n".join(lines))
    done = subprocess.run(["ccx", "ring"], cwd=folder, capture_output=True, text=True)
    if done.returncode or "*ERROR" in done.stdout:
        raise SystemExit(f"CalculiX failed:\n{done.stdout[-3000:]}")
    u = {}
    for line in (folder / "ring.dat").read_text().splitlines():
        fields = line.split()
        if len(fields) == 4 and fields[0].isdigit():
            u[int(fields[0])] = (float(fields[2]), float(fields[1]))
    result = {}
    for name, i in (("bore", 0), ("outside", len(R) - 1)):
        for fraction in POINTS:
            j = min(range(len(X)), key=lambda k: abs(X[k] - fraction * LENGTH))
            result[name, fraction] = u[node(i, j)]
    return result, count


def ours(program):
    """What the test prints: side, place, axial and radial displacement [m]."""
    done = subprocess.run([program, "--gtest_filter=EndFlare.*"], capture_output=True, text=True)
    found = re.findall(r"flare: (\w+) (\S+) (\S+) (\S+)", done.stdout)
    if not found:
        raise SystemExit(f"{program} did not print its displacements:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return {(name, float(fraction)): (float(x), float(r)) for name, fraction, x, r in found}


def main():
    if not shutil.which("ccx"):
        print("skipped: CalculiX is not installed (apt-get install calculix-ccx)")
        return 0
    program = sys.argv[1] if len(sys.argv) > 1 else HERE.parent / "build/release/test_verification_fe"
    mine = ours(program)
    with tempfile.TemporaryDirectory() as folder:
        coarse, _ = calculix(2, pathlib.Path(folder))
        theirs, cells = calculix(4, pathlib.Path(folder))
    largest = max(abs(v) for u in theirs.values() for v in u)
    worst = own = 0.0
    print("  side     place    rotordrop: axial, radial [um]     CalculiX: axial, radial [um]")
    for key, u in theirs.items():
        worst = max(worst, *(abs(a - b) / largest for a, b in zip(u, mine[key])))
        own = max(own, *(abs(a - b) / largest for a, b in zip(u, coarse[key])))
        print(f"  {key[0]:8s} {key[1]:5.3f}    {mine[key][0] * 1e6:12.6f} {mine[key][1] * 1e6:12.6f}      {u[0] * 1e6:12.6f} {u[1] * 1e6:12.6f}")
    print(f"largest difference {worst:.1e} of the largest displacement; CalculiX with {cells} elements against a quarter of them: {own:.1e}")
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Bending of touchdown rings against CalculiX: natural frequencies, and a ring on Hertz balls under 5 kN at its bore.

    /usr/bin/python3 validation/ring_bending_calculix.py [PROGRAM]

PROGRAM is build/release/rotordrop unless given. CalculiX (package calculix-ccx) has its own three-dimensional mesh of the inner rings of TB1 and TB2 of
params/neisi2019.toml with their grooves, elements with 20 nodes, its assembly and solvers. Half the ring around and half of it along the axis are
meshed, which the symmetry of loads and sections allows; a spring of 1 N/m holds the ring where nothing else does.

Frequencies: modes of bending in the ring's plane with n = 2 to 6 waves around.
Ball loads: the radial displacement (mean over the section, by area) that a force at the bore and one at the groove make around the ring, each balanced
by a load that goes with cos(theta) around the bore, gives influence coefficients; 14 balls of TB1 on springs K (delta - clearance)^1.5 are then a system of
15 equations, the ring's rigid displacement among them. The program has them from `statics` with ring_bending = "point".

Prints both and the differences. Exit codes: 0 within 1 % (frequencies) and 3 % (largest ball load), or CalculiX is not installed (said); 1 otherwise.
"""

import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
E, NU, RHO = 2.0e11, 0.3, 7800.0
MM = 1e-3


class Ring:
    """Inner ring with a groove of the given radius about (x, centre) in the half x >= 0."""

    def __init__(self, bore, shoulder, width, grooves):
        self.bore, self.shoulder, self.width, self.grooves = bore, shoulder, width, grooves

    def outside(self, x):
        r = self.shoulder
        for at, centre, radius in self.grooves:
            for place in {at, -at}:
                squared = radius**2 - (x - place) ** 2
                if squared > 0:
                    r = min(r, centre - math.sqrt(squared))
        return r

    def lines(self, n):
        """Axial places from the middle plane to the face; a line at every edge and bottom of a groove."""
        half = self.width / 2
        edges = {0.0, half}
        for at, centre, radius in self.grooves:
            reach = math.sqrt(radius**2 - (centre - self.shoulder) ** 2)
            edges |= {x for x in (at - reach, at, at + reach) if 0 < x < half}
        edges = sorted(edges)
        lines = [0.0]
        for a, b in zip(edges, edges[1:]):
            k = max(1, math.ceil((b - a) / half * n - 1e-9))
            lines += [a + (b - a) * i / (2 * k) for i in range(1, 2 * k + 1)]
        return lines


def ball(diameter, pitch, angle, conformity=0.52):
    offset = (conformity - 0.5) * diameter
    return pitch / 2 + offset * math.cos(angle), offset * math.sin(angle), conformity * diameter


def rings():
    centre, _, radius = ball(11.906 * MM, 90 * MM, 0.0)
    yield "TB1", Ring(35 * MM, 82.9 / 2 * MM, 20 * MM, [(0.0, centre, radius)])
    centre, axial, radius = ball(9.525 * MM, 85 * MM, math.radians(25))
    # Rows at +-8 mm in X: the centres of the inner grooves lie outside the balls' planes.
    yield "TB2", Ring(35 * MM, 39 * MM, 32 * MM, [(8 * MM + axial, centre, radius)])


class Mesh:
    def __init__(self, ring, across, through, around):
        self.ring = ring
        self.x = ring.lines(across)
        self.nx, self.nr, self.nt = len(self.x), 2 * through + 1, 2 * around + 1
        self.exists = lambda i, j, k: (i % 2) + (j % 2) + (k % 2) <= 1
        self.number, self.place = {}, {}
        for k in range(self.nt):
            for i in range(self.nx):
                for j in range(self.nr):
                    if self.exists(i, j, k):
                        self.number[i, j, k] = len(self.number) + 1
                        self.place[i, j, k] = self.coordinates(i, j, k)

    def coordinates(self, i, j, k):
        low, high = self.ring.bore, self.ring.outside(self.x[i])
        r, t = low + (high - low) * j / (self.nr - 1), math.pi * k / (self.nt - 1)
        return self.x[i], r * math.cos(t), r * math.sin(t)

    def deck(self):
        lines = ["*NODE, NSET=ALL"]
        lines += [f"{n}, " + ", ".join(f"{c:.11e}" for c in self.place[key]) for key, n in self.number.items()]
        lines.append("*ELEMENT, TYPE=C3D20, ELSET=RING")
        count = 0
        for k in range(0, self.nt - 1, 2):
            for i in range(0, self.nx - 1, 2):
                for j in range(0, self.nr - 1, 2):
                    count += 1
                    corner = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
                    middle = [(i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
                    nodes = [self.number[p[0], p[1], k + dk] for dk, ps in ((0, corner), (2, corner), (0, middle), (2, middle), (1, corner)) for p in ps]
                    lines.append(f"{count}, " + ", ".join(map(str, nodes[:10])) + ",")
                    lines.append(", ".join(map(str, nodes[10:])))
        lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E!r}, {NU!r}", "*DENSITY", f"{RHO!r}", "*SOLID SECTION, ELSET=RING, MATERIAL=STEEL"]
        lines += ["*ELEMENT, TYPE=SPRING1, ELSET=HOLD", f"{count + 1}, {self.number[0, 0, 0]}", "*SPRING, ELSET=HOLD", "2", "1."]
        lines.append("*BOUNDARY")
        for (i, j, k), n in self.number.items():
            if i == 0:
                lines.append(f"{n}, 1, 1, 0.")
            if k in (0, self.nt - 1):
                lines.append(f"{n}, 3, 3, 0.")
        return lines


def run(name, lines):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / f"{name}.inp").write_text("\n".join(lines) + "\n")
        subprocess.run(["ccx", "-i", name], cwd=folder, check=True, capture_output=True)
        return (folder / f"{name}.dat").read_text()


def tables(text):
    """Blocks of `node x y z` of a .dat file."""
    blocks = []
    for block in re.split(r"\n\s*displacements.*\n", text)[1:]:
        rows = {}
        for line in block.splitlines():
            parts = line.split()
            if len(parts) == 4 and parts[0].isdigit():
                rows[int(parts[0])] = tuple(map(float, parts[1:]))
            elif rows and parts:
                break
        blocks.append(rows)
    return blocks


def frequencies(mesh, n_modes=26):
    lines = mesh.deck()
    bore = [mesh.number[0, 0, k] for k in range(0, mesh.nt)]
    lines += ["*NSET, NSET=BORE"] + [f"{n}," for n in bore]
    lines += ["*STEP", "*FREQUENCY", f"{n_modes}", "*NODE PRINT, NSET=BORE", "U", "*END STEP"]
    text = run("modes", lines)
    table = re.search(r"E I G E N V A L U E   O U T P U T(.*?)(P A R T|displacements)", text, re.S).group(1)
    hertz = [float(line.split()[3]) for line in table.splitlines() if re.match(r"\s+\d+\s+[-0-9.]+E", line)]
    found = {}
    for f, rows in zip(hertz, tables(text)):
        theta = np.array([math.pi * k / (mesh.nt - 1) for k in range(mesh.nt)])
        u = np.array([rows[n] for n in bore])
        radial = u[:, 1] * np.cos(theta) + u[:, 2] * np.sin(theta)
        weight = np.ones(mesh.nt)
        weight[[0, -1]] = 0.5
        parts = [abs((weight * radial * np.cos(n * theta)).sum()) for n in range(8)]
        n = int(np.argmax(parts))
        if n >= 2 and f > 1.0 and n not in found:
            found[n] = f
    return found


def influence(mesh, through_groove):
    """Mean radial displacement of the sections around the ring [m/N], under 1 N outwards at the bore or at the groove at theta = 0."""
    lines = mesh.deck()
    # Half of 1 N belongs to the meshed half along the axis, and of a load in the plane theta = 0 the same half again.
    loads = np.zeros((len(mesh.number) + 1, 3))

    def along(i_from, i_to, j, k, force):
        weights = {}
        for i in range(i_from, i_to, 2):
            length = mesh.x[i + 2] - mesh.x[i]
            for di, w in ((0, 1), (1, 4), (2, 1)):
                weights[i + di] = weights.get(i + di, 0.0) + w * length / 6
        total = sum(weights.values())
        for i, w in weights.items():
            _, y, z = mesh.coordinates(i, j, k)
            r = math.hypot(y, z)
            loads[mesh.number[i, j, k]] += np.array([0.0, y / r, z / r]) * force * w / total

    last = mesh.nx - 1
    if through_groove:
        end = max(i for i in range(0, mesh.nx, 2) if mesh.x[i] <= 2.2 * MM)
        along(0, end, mesh.nr - 1, 0, 0.25)
    else:
        along(0, last, 0, 0, 0.25)
    # Its resultant on the whole ring is 1 N along y: balanced by -cos(theta) / pi per angle at the bore.
    for k in range(0, mesh.nt, 2):
        share = (math.pi / (mesh.nt // 2)) * (0.5 if k in (0, mesh.nt - 1) else 1.0)
        along(0, last, 0, k, -0.5 * share * math.cos(math.pi * k / (mesh.nt - 1)) / math.pi)
    lines += ["*STEP", "*STATIC", "*CLOAD"]
    for n in range(1, len(loads)):
        for axis in (1, 2):
            if loads[n, axis]:
                lines.append(f"{n}, {axis + 1}, {loads[n, axis]:.12e}")
    lines += ["*NODE PRINT, NSET=ALL", "U", "*END STEP"]
    rows = tables(run("statics", lines))[-1]
    around = []
    for k in range(0, mesh.nt, 2):
        theta = math.pi * k / (mesh.nt - 1)
        total = area = 0.0
        for i in range(0, mesh.nx, 2):
            width = (mesh.x[min(i + 2, last)] - mesh.x[max(i - 2, 0)]) / 2
            for j in range(0, mesh.nr, 2):
                wall = mesh.ring.outside(mesh.x[i]) - mesh.ring.bore
                share = width * wall * (0.5 if j in (0, mesh.nr - 1) else 1.0)
                u = rows[mesh.number[i, j, k]]
                total += share * (u[1] * math.cos(theta) + u[2] * math.sin(theta))
                area += share
        around.append(total / area)
    around = np.array(around)
    # The rigid displacement, which the spring of 1 N/m leaves open, is an unknown of the balls' equations.
    theta = np.linspace(0.0, math.pi, len(around))
    weight = np.ones(len(around))
    weight[[0, -1]] = 0.5
    return around - 2 * (weight * around * np.cos(theta)).sum() / (len(around) - 1) * np.cos(theta)


def balls_on_ring(bore, groove, force, K, clearance, n_balls=14):
    """Ball loads [N] under a force at the bore towards the first ball."""
    place = lambda table, theta: float(np.interp(abs((theta + math.pi) % (2 * math.pi) - math.pi), np.linspace(0, math.pi, len(table)), table))
    azimuth = 2 * math.pi * np.arange(n_balls) / n_balls
    of_force = np.array([force * place(bore, t) for t in azimuth])
    of_balls = np.array([[-place(groove, t - s) for s in azimuth] for t in azimuth])
    unknown = np.full(n_balls + 1, 0.0)
    unknown[0] = 2 * clearance
    rigid = np.cos(azimuth)
    q = np.zeros(n_balls)
    y = 3 * clearance
    for step in range(400):
        delta = rigid * y + of_force + of_balls @ q - clearance
        load = K * np.maximum(delta, 0.0) ** 1.5
        stiff = np.diag(1.5 * K * np.sqrt(np.maximum(delta, 0.0)))
        residual = np.append(load - q, rigid @ q - force)
        J = np.block([[stiff @ of_balls - np.eye(n_balls), (stiff @ rigid)[:, None]], [rigid[None, :], np.zeros((1, 1))]])
        if np.abs(residual).max() < 1e-9 * force:
            break
        change = np.linalg.lstsq(J, -residual, rcond=None)[0]
        limit = min(1.0, 5e-6 / max(abs(change[-1]), 1e-30))
        q, y = q + limit * change[:-1], y + limit * change[-1]
    else:
        raise SystemExit("the balls' equations were not solved")
    return q


def program_report(program, bearing):
    case = f"base = {json.dumps(str(ROOT / 'params' / 'neisi2019.toml'))}\n[statics]\nsubject = \"bearings\"\nforce = [\"0 N\", \"5 kN\", \"0 N\"]\n"
    case += "[bearings.TB1]\nring_bending = \"point\"\n[bearings.TB2]\nring_bending = \"point\"\n"
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "bent.toml"
        path.write_text(case)
        text = subprocess.run([str(program), "statics", str(path), "--json"], check=True, capture_output=True, text=True).stdout
    return json.loads(text)["bearings"][bearing]


def main():
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing compared")
        return 0
    program = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/release/rotordrop"
    worst = {"frequency": 0.0, "load": 0.0}
    for name, ring in rings():
        mesh = Mesh(ring, 6, 2, 48)
        peer = frequencies(mesh)
        ours = program_report(program, name) if program.exists() else None
        print(f"{name}: {len(mesh.number)} nodes")
        for n in range(2, 7):
            line = f"  n = {n}: CalculiX {peer[n]:9.2f} Hz"
            if ours:
                f = next(h["frequency"] for h in ours["bending"]["inner"] if h["n"] == n)
                worst["frequency"] = max(worst["frequency"], abs(f / peer[n] - 1))
                line += f", rotordrop {f:9.2f} Hz, {100 * (f / peer[n] - 1):+.2f} %"
            print(line)
        if name == "TB1":
            bore, groove = influence(mesh, False), influence(mesh, True)
            K = ours["rows"][0]["ball_stiffness"] if ours else 1.3439e10
            loads = balls_on_ring(bore, groove, 5e3, K, 19e-6)
            rigid = balls_on_ring(0 * bore, 0 * groove, 5e3, K, 19e-6)
            print("  ball loads under 5 kN [N]: CalculiX " + " ".join(f"{q:.0f}" for q in loads[:8]))
            print("                        rigid ring " + " ".join(f"{q:.0f}" for q in rigid[:8]))
            if ours:
                own = ours["rows"][0]["ball_loads"]
                worst["load"] = abs(max(own) / max(loads) - 1)
                print("                         rotordrop " + " ".join(f"{q:.0f}" for q in own[:8]) + f"; largest {100 * (max(own) / max(loads) - 1):+.2f} %")
    print(f"largest difference: frequencies {100 * worst['frequency']:.2f} % (1 % allowed), largest ball load {100 * worst['load']:.2f} % (3 % allowed)")
    return 0 if worst["frequency"] < 0.01 and worst["load"] < 0.03 else 1


if __name__ == "__main__":
    sys.exit(main())

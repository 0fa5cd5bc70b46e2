#!/usr/bin/env python3
"""Heat conduction with properties over temperature, power-law convection (eq. 16) and a train of pulses: `rotordrop heat` against GetDP.

    /usr/bin/python3 validation/heat_getdp.py [PROGRAM [JSON]]

PROGRAM is build/release/rotordrop unless given, built with the finite-element room. GetDP (package getdp) solves heat_pulses.toml with a mesh made here
(triangles with six nodes), its own assembly, and the trapezoidal rule for the enthalpy with fixed steps, four backward Euler steps after each jump. Prints
both temperatures at every probe and time, and the largest difference over the largest rise. JSON is a file for the differences, if wanted. Exit codes: 0 agreement within 1e-4, or GetDP is not installed
(said); 1 disagreement.
"""

import pathlib
import subprocess
import sys
import time

from heat_peer import compare

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE / "heat_pulses.toml"
TOLERANCE = 1e-4
CELLS_X, CELLS_R = 5, 10
ITERATIONS = 3  # of each step: Newton's for the enthalpy, fixed-point for k


def mesh_file(body, path):
    """Rectangle of second-order triangles in Gmsh's format 2.2; X is the radius, Y the axis, as GetDP's axisymmetric Jacobians want it."""
    (x1, x2), (r1, r2) = body["x"], body["r"]
    nr, nx = 2 * CELLS_R, 2 * CELLS_X
    # Finer towards the bore, and towards the end that is cooled.
    grade = lambda s, power: s**power
    radius = [r1 + (r2 - r1) * grade(i / CELLS_R, 1.5) for i in range(CELLS_R + 1)]
    place = [x1 + (x2 - x1) * grade(i / CELLS_X, 1.3) for i in range(CELLS_X + 1)]
    halves = lambda points: [p for a, b in zip(points, points[1:]) for p in (a, (a + b) / 2)] + [points[-1]]
    radius, place = halves(radius), halves(place)
    node = lambda i, j: 1 + i + (nr + 1) * j
    lines, elements = [], []
    for j, x in enumerate(place):
        for i, r in enumerate(radius):
            lines.append(f"{node(i, j)} {r!r} {x!r} 0")
    add = lambda kind, region, nodes: elements.append(f"{len(elements) + 1} {kind} 2 {region} {region} {' '.join(map(str, nodes))}")
    for j in range(0, nx, 2):
        for i in range(0, nr, 2):
            a, b, c, d = node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i, j + 2)
            middle = node(i + 1, j + 1)
            add(9, 1, (a, b, c, node(i + 1, j), node(i + 2, j + 1), middle))
            add(9, 1, (a, c, d, middle, node(i + 1, j + 2), node(i, j + 1)))
    for j in range(0, nx, 2):
        add(8, 2, (node(0, j), node(0, j + 2), node(0, j + 1)))  # inner
        add(8, 3, (node(nr, j), node(nr, j + 2), node(nr, j + 1)))  # outer
    for i in range(0, nr, 2):
        add(8, 4, (node(i, 0), node(i + 2, 0), node(i + 1, 0)))  # left
    path.write_text("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(lines)), *lines, "$EndNodes", "$Elements", str(len(elements)), *elements, "$EndElements", ""]))
    return len(lines)


def table_functions(name, table):
    """A table as GetDP functions of temperature: the value, and its integral from the first point, both written out as sums over the intervals."""
    value, integral = [repr(float(table[0][1]))], [f"{float(table[0][1])!r}*($1 - {table[0][0]!r})"]
    for (a, va), (b, vb) in zip(table, table[1:]):
        slope = (vb - va) / (b - a)
        d = f"(($1 < {a!r}) ? 0. : (($1 > {b!r}) ? {b - a!r} : $1 - {a!r}))"
        beyond = f"(($1 > {b!r}) ? $1 - {b!r} : 0.)"
        value.append(f"({slope!r})*{d}")
        integral.append(f"({slope!r})*({d}*{d}/2 + {b - a!r}*{beyond})")
    return f"  {name}[] = {' + '.join(value)};\n  {name}Integral[] = {' + '.join(integral)};\n"


PROBLEM = """
Group {{ Ring = Region[1]; Bore = Region[2]; Film = Region[{{3, 4}}]; Whole = Region[{{1, 2, 3, 4}}]; }}
Function {{
{tables}
  loss[] = ($1 > {ambient!r}) ? {coefficient!r}*($1 - {ambient!r})^{power!r} : 0.;
  lossSlope[] = ($1 > {ambient!r}) ? {coefficient!r}*{power!r}*($1 - {ambient!r})^{exponent!r} : 0.;
  heating[] = $heating;
  now[] = $implicit;
  before[] = 1. - $implicit;
}}
Constraint {{ {{ Name Start; Type Init; Case {{ {{ Region Whole; Value {ambient!r}; }} }} }} }}
Jacobian {{
  {{ Name Volume; Case {{ {{ Region Whole; Jacobian VolAxi; }} }} }}
  {{ Name Surface; Case {{ {{ Region Whole; Jacobian SurAxi; }} }} }}
}}
Integration {{ {{ Name Points; Case {{ {{ Type Gauss; Case {{
  {{ GeoElement Triangle2; NumberOfPoints 12; }} {{ GeoElement Line2; NumberOfPoints 4; }} }} }} }} }} }}
FunctionSpace {{ {{ Name Space; Type Form0;
  BasisFunction {{ {{ Name n; NameOfCoef T; Function BF_Node; Support Whole; Entity NodesOf[Whole]; }} }}
  Constraint {{ {{ NameOfCoef T; EntityType NodesOf; NameOfConstraint Start; }} }} }} }}
Formulation {{ {{ Name Heat; Type FemEquation;
  Quantity {{ {{ Name T; Type Local; NameOfSpace Space; }} }}
  Equation {{
    Galerkin {{ [ {rho!r}*c[{{T}}]/$DTime*Dof{{T}}, {{T}} ]; In Ring; Jacobian Volume; Integration Points; }}
    Galerkin {{ [ {rho!r}*(cIntegral[{{T}}] - c[{{T}}]*{{T}} - cIntegral[{{T}}[1]])/$DTime, {{T}} ]; In Ring; Jacobian Volume; Integration Points; }}
    Galerkin {{ [ now[]*k[{{T}}]*Dof{{d T}}, {{d T}} ]; In Ring; Jacobian Volume; Integration Points; }}
    Galerkin {{ [ before[]*k[{{T}}[1]]*{{d T}}[1], {{d T}} ]; In Ring; Jacobian Volume; Integration Points; }}
    Galerkin {{ [ now[]*lossSlope[{{T}}]*Dof{{T}}, {{T}} ]; In Film; Jacobian Surface; Integration Points; }}
    Galerkin {{ [ now[]*(loss[{{T}}] - lossSlope[{{T}}]*{{T}}), {{T}} ]; In Film; Jacobian Surface; Integration Points; }}
    Galerkin {{ [ before[]*loss[{{T}}[1]], {{T}} ]; In Film; Jacobian Surface; Integration Points; }}
    Galerkin {{ [ -heating[], {{T}} ]; In Bore; Jacobian Surface; Integration Points; }}
  }} }} }}
Resolution {{ {{ Name March; System {{ {{ Name S; NameOfFormulation Heat; }} }}
  Operation {{
    InitSolution[S];
{operations}
  }} }} }}
PostProcessing {{ {{ Name Look; NameOfFormulation Heat; Quantity {{
  {{ Name T; Value {{ Term {{ [ {{T}} ]; In Ring; Jacobian Volume; }} }} }} }} }} }}
PostOperation {{ {{ Name Probes; NameOfPostProcessing Look; LastTimeStepOnly; Operation {{
{prints}
}} }} }}
"""


def stages(case):
    """(end, steps, implicit, flux, is_output): a few Euler steps after each jump, then trapezoidal ones that grow."""
    pulse, times = case["flux"][0]["pulse"], case["output_times"]
    starts = [i * pulse["period"] for i in range(pulse["count"])]
    jumps = [t for s in starts for t in (s, s + pulse["width"])]
    marks = sorted({*times, *jumps} - {0.0})
    now, result = 0.0, []
    for mark in marks:
        flux = pulse["height"] if any(s <= now < s + pulse["width"] - 1e-9 for s in starts) else 0.0
        span = mark - now
        parts = []
        if any(abs(now - j) < 1e-9 for j in jumps):
            parts = [(now + 1e-4, 4, 1.0), (now + 2e-3, 12, 0.5), (now + 0.05, 16, 0.5)]
        parts.append((mark, max(10, round(min(span / 0.025, 40 + span / 0.15))), 0.5))
        result += [(end, n, implicit, flux, end == mark and mark in times) for end, n, implicit in parts]
        now = mark
    return result


def getdp(case, folder):
    body, material, film = case["section"]["rectangle"][0], case["materials"]["ring-steel"], case["convection"][0]
    nodes = mesh_file(body, folder / "ring.msh")
    operations, now, n_steps = [], 0.0, 0
    for end, n, implicit, flux, is_output in stages(case):
        n_steps += n
        operations.append(f"    Evaluate[$implicit = {implicit!r}, $heating = {flux!r}];")
        step = (end - now) / n
        operations.append(f"    TimeLoopTheta[{now!r}, {end - 0.3 * step!r}, {step!r}, 1.] {{ {ITERATIONS * 'Generate[S]; Solve[S]; '}}}")
        if is_output:
            operations.append("    PostOperation[Probes];")
        now = end
    prints = "\n".join(f'  Print[ T, OnPoint {{{p["r"]!r}, {p["x"]!r}, 0}}, Format TimeTable, File >> "{p["name"]}.txt" ];' for p in case["probe"])
    text = PROBLEM.format(tables=table_functions("k", material["k_table"]) + table_functions("c", material["c_table"]), ambient=case["run"]["ambient"],
                          coefficient=float(film["coefficient"]), exponent=film["exponent"], power=1 + film["exponent"], rho=float(material["rho"]),
                          operations="\n".join(operations), prints=prints)
    (folder / "ring.pro").write_text(text)
    start = time.monotonic()
    done = subprocess.run(["getdp", "ring.pro", "-msh", "ring.msh", "-solve", "March", "-v", "2"], cwd=folder, capture_output=True, text=True)
    wall = time.monotonic() - start
    if done.returncode or "Error" in done.stdout + done.stderr:
        raise SystemExit(f"GetDP failed:\n{(done.stdout + done.stderr)[-3000:]}")
    values = {}
    for p in case["probe"]:
        rows = [line.split() for line in (folder / f"{p['name']}.txt").read_text().splitlines() if line.strip()]
        values[p["name"]] = [float(row[-1]) for row in rows]
        at = [float(row[1]) for row in rows]
        if len(at) != len(case["output_times"]) or any(abs(a - b) > 1e-6 * b for a, b in zip(at, case["output_times"])):
            raise SystemExit(f"GetDP reported at {at}, not at the output times")
    return values, nodes, n_steps, wall


def solve(case, folder):
    temperatures, nodes, n_steps, wall = getdp(case, folder)
    rises = {name: [T - case["run"]["ambient"] for T in values] for name, values in temperatures.items()}
    return rises, f"{nodes} unknowns, {n_steps} steps, {wall:.1f} s with start-up"


if __name__ == "__main__":
    sys.exit(compare(CASE, solve, other="GetDP", command="getdp", package="getdp", tolerance=TOLERANCE))

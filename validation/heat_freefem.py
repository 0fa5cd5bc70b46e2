#!/usr/bin/env python3
"""Heat conduction in two bodies with contact resistance: `rotordrop heat` against FreeFEM (package freefem++).

    /usr/bin/python3 validation/heat_freefem.py [PROGRAM [JSON]]

PROGRAM is build/release/rotordrop unless given, built with the finite-element room. FreeFEM solves the same problem with its own mesh (quadratic
triangles, graded), its own assembly and Alexander's SDIRK method of order 3 with fixed steps. Prints both temperatures at every probe and time, and the
largest difference over the largest rise; CPU times of both without start-up. JSON is a file for the differences, if wanted. Exit codes: 0 agreement within 1e-4, or FreeFEM is not installed (said);
1 disagreement.
"""

import pathlib
import subprocess
import sys

from heat_peer import compare

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE / "heat_two_bodies.toml"
TOLERANCE = 1e-4

SCRIPT = """
// Axisymmetric, coordinates x (axis) and y (radius); the factor 2 pi is left out on both sides.
real x1 = {x1}, x2 = {x2}, X1 = {X1}, X2 = {X2}, r1 = {r1}, r2 = {r2}, r3 = {r3};
int nx = {nx}, nX = {nX}, nr = {nr}, nR = {nR};
real grade = {grade}, gradeHousing = {gradeHousing};  // thinnest over mean cell, about grade/(exp(grade) - 1)
mesh ringMesh = square(nx, nr, [x1 + (x2 - x1)*x, r1 + (r2 - r1)*(exp(grade*y) - 1)/(exp(grade) - 1)]);
mesh housingMesh = square(nX, nR, [X1 + (X2 - X1)*x, r2 + (r3 - r2)*(exp(gradeHousing*y) - 1)/(exp(gradeHousing) - 1)]);
fespace V(ringMesh, P2);
fespace W(housingMesh, P2);
real C1 = {C1}, C2 = {C2}, k1 = {k1}, k2 = {k2}, g = 1/{resistance}, h = {h};

// Sides of square(): 1 inner, 2 right, 3 outer, 4 left.
varf capacity1(u, v) = int2d(ringMesh)(C1*y*u*v);
varf capacity2(u, v) = int2d(housingMesh)(C2*y*u*v);
varf conduction1(u, v) = int2d(ringMesh)(k1*y*(dx(u)*dx(v) + dy(u)*dy(v)));
varf conduction2(u, v) = int2d(housingMesh)(k2*y*(dx(u)*dx(v) + dy(u)*dy(v))) + int1d(housingMesh, 3)(h*y*u*v);
varf contact(u, v) = int1d(ringMesh, 3)(g*y*u*v);
varf heating(u, v) = int1d(ringMesh, 1)(y*v);
matrix M1 = capacity1(V, V), M2 = capacity2(W, W), A1 = conduction1(V, V), A2 = conduction2(W, W), G = contact(V, V);
matrix Trace = interpolate(V, W);  // the housing's trace at the ring's nodes; their lines coincide
matrix TraceT = Trace';
matrix GI = G*Trace;
matrix ItG = TraceT*G;
matrix ItGI = TraceT*GI;
matrix GIm = -1.*GI, ItGm = -1.*ItG;
matrix K1 = A1 + G, K2 = A2 + ItGI;
matrix M = [[M1, 0], [0, M2]];
matrix K = [[K1, GIm], [ItGm, K2]];
int n1 = V.ndof, n2 = W.ndof, n = n1 + n2;
real[int] f1 = heating(0, V);
real[int] f(n);
f = 0;
f(0:n1 - 1) = f1;

// Alexander (1977): three stages, L-stable, the last stage is the new state.
real a = 0.4358665215084590, tau = (1 + a)/2, b1 = -(6*a*a - 16*a + 1)/4, b2 = (6*a*a - 20*a + 5)/4;
real[int] T(n), k1v(n), k2v(n), k3v(n), rhs(n), U(n);
T = 0;
V t1;
W t2;
real[int] ends = [{ends}], steps = [{steps}], fluxes = [{fluxes}];
int[int] reported = [{reported}];
real now = 0, cpu = 0, last = 0;
matrix S;
for (int i = 0; i < ends.n; i++) {{
  real dt = (ends[i] - now)/steps[i], began = clock();
  if (abs(dt - last) > 1e-9*dt) {{
    S = a*dt*K;
    S = S + M;
    set(S, solver = {solver});
    last = dt;
  }}
  for (int j = 0; j < steps[i]; j++) {{
    // k: rates, M k = q f - K (T + dt sum a k)
    rhs = K*T; rhs = -rhs; rhs += fluxes[i]*f;
    k1v = S^-1*rhs;
    U = dt*(tau - a)*k1v; U += T;
    rhs = K*U; rhs = -rhs; rhs += fluxes[i]*f;
    k2v = S^-1*rhs;
    U = dt*b1*k1v; U += dt*b2*k2v; U += T;
    rhs = K*U; rhs = -rhs; rhs += fluxes[i]*f;
    k3v = S^-1*rhs;
    U += dt*a*k3v;
    T = U;
  }}
  cpu += clock() - began;
  now = ends[i];
  if (reported[i] == 0) continue;
  t1[] = T(0:n1 - 1);
  t2[] = T(n1:n - 1);
  cout.precision(15);
  real xm = (x1 + x2)/2;
  cout << "RISES " << now << " " << int1d(ringMesh, 1)(y*t1)/int1d(ringMesh, 1)(y) << " " << t1(xm, r1) << " " << t1(xm, r2) << " "
       << t2(xm, r2) << " " << int1d(housingMesh, 3)(y*t2)/int1d(housingMesh, 3)(y) << endl;
}}
cout << "CPU " << cpu << " UNKNOWNS " << n << endl;
"""
PROBES = ["bore", "bore-middle", "ring-at-fit", "housing-at-fit", "housing-outside"]


def stages(case):
    """(end, steps) between jumps and output times; each decade from 1 us after a jump has its own step."""
    times, jumps = case["output_times"], case["flux"][0]["times"]
    marks = {t for t in times} | {j + d for j in jumps for d in (1e-6, 1e-5, 1e-4, 3e-4)}
    return [(t, 30) for t in sorted(marks) if t <= times[-1]]


def freefem(case, folder, schedule=None, **settings):
    """Temperature rises {time: [probes]}, CPU seconds of stepping and factorisations, unknowns, steps."""
    ring, housing = case["section"]["rectangle"]
    materials = case["materials"]
    one, two = materials[ring["material"]], materials[housing["material"]]
    flux, times = case["flux"][0], case["output_times"]
    jumps = flux["times"]
    schedule = schedule or stages(case)
    marks = [end for end, _ in schedule]
    value = lambda t: [v for s, v in zip(jumps, flux["values"]) if s < t][-1]
    size = 0.0005
    numbers = dict(
        x1=ring["x"][0], x2=ring["x"][1], X1=housing["x"][0], X2=housing["x"][1], r1=ring["r"][0], r2=ring["r"][1], r3=housing["r"][1],
        nx=round((ring["x"][1] - ring["x"][0]) / size), nX=round((housing["x"][1] - housing["x"][0]) / size), nr=40, nR=24, grade=4.0, gradeHousing=2.0, solver="sparsesolver",
        C1=one["rho"] * one["c"], C2=two["rho"] * two["c"], k1=one["k"], k2=two["k"], resistance=case["interface"][0]["resistance"],
        h=case["convection"][0]["coefficient"], ends=", ".join(map(repr, marks)), steps=", ".join(f"{n}." for _, n in schedule),
        reported=", ".join(str(int(any(abs(t - m) < 1e-9 * t for t in times))) for m in marks), fluxes=", ".join(repr(float(value(t))) for t in marks))
    numbers.update(settings)
    script = folder / "two_bodies.edp"
    script.write_text(SCRIPT.format(**numbers))
    done = subprocess.run(["FreeFem++", "-nw", "-v", "0", script], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"FreeFEM failed:\n{done.stdout[-3000:]}{done.stderr}")
    rises = {}
    for line in done.stdout.splitlines():
        words = line.split()
        if words[:1] == ["RISES"]:
            rises[float(words[1])] = [float(w) for w in words[2:]]
        elif words[:1] == ["CPU"]:
            cpu, unknowns = float(words[1]), int(words[3])
    return {t: next(v for at, v in rises.items() if abs(at - t) < 1e-9 * max(t, 1e-3)) for t in times}, cpu, unknowns, sum(n for _, n in schedule)


def solve(case, folder):
    by_time, cpu, unknowns, n_steps = freefem(case, folder)
    rises = {name: [by_time[t][k] for t in case["output_times"]] for k, name in enumerate(PROBES)}
    return rises, f"{unknowns} unknowns, {n_steps} steps, {cpu:.2f} s"


if __name__ == "__main__":
    sys.exit(compare(CASE, solve, other="FreeFEM", command="FreeFem++", package="freefem++", tolerance=TOLERANCE))

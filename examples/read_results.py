#!/usr/bin/env python3
"""A tour of a run's results in steps, as a notebook: editors that know "# %%" run them one by one.

    python3 examples/read_results.py DIR      # all at once; pictures into DIR/figures/tour

DIR is a directory of `rotordrop run`, such as out/neisi2019-settling. Supports that are no touchdown bearings (springs, magnets) are passed over.
"""

# %% Open a run
import pathlib
import sys

import matplotlib
import numpy as np

if not hasattr(sys, "ps1"):
    matplotlib.use("Agg")  # without a window when it is run as a script
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from rotordrop_results import RISE, Results, read_vtu  # noqa: E402

directory = sys.argv[1] if len(sys.argv) > 1 else "out/neisi2019-settling"
try:
    run = Results(directory)
except FileNotFoundError as error:
    sys.exit(f"error: {error}")
pictures = run.directory / "figures" / "tour"
pictures.mkdir(parents=True, exist_ok=True)
print(f"{run.attributes['case']} by {run.attributes['program']}: {len(run.paths)} series, supports {', '.join(run.bearings)}")

touchdown = [name for name in run.bearings if "contact_force" in run.bearing(name)]
if not touchdown:
    sys.exit(f"error: {directory} has no touchdown bearing")

# %% One series: values, unit, meaning
name = touchdown[0]
force = run.bearing(name)["contact_force"]
print(f"{force.path}: {force.meaning} [{force.unit}], {len(force.values)} samples to {force.time[-1]:.4g} s, largest {force.values.max():.1f} {force.unit}")

# %% The first impact: when, how long, which impulse, which heat
penetration = run.bearing(name)["penetration"]
inside = penetration.values > 0
if inside.any():
    first = int(np.argmax(inside))
    last = first + int(np.argmin(inside[first:])) if not inside[first:].all() else len(inside) - 1
    start, end = penetration.time[[first, last]]
    heat = run.series(f"/ledger/{name}/rub_heat")
    print(f"first impact of {name}: {1e3 * start:.2f} to {1e3 * end:.2f} ms, peak {force.between(start, end).values.max():.0f} N, "
          f"impulse {force.between(start, end).integral():.3g} N s, heat {heat.at(end) - heat.at(start):.3g} J")

# %% Orbits of the rotor in its bearings
figure, axes = plt.subplots(1, len(touchdown), figsize=(5 * len(touchdown), 5), squeeze=False)
for axis, name in zip(axes[0], touchdown):
    orbit = run.bearing(name)["orbit"]
    axis.plot(1e6 * orbit.column("z").values, 1e6 * orbit.column("y").values, linewidth=0.6)
    axis.set(title=name, xlabel="z [um]", ylabel="y (up) [um]", aspect="equal")
figure.savefig(pictures / "orbits.png", dpi=110)

# %% Spin-up: rings against the rotor
figure, axis = plt.subplots(figsize=(7, 4))
to_rpm = 30 / np.pi
rotor = run.series("/rotor/spin_speed")
axis.plot(1e3 * rotor.time, to_rpm * rotor.values, "k--", label="rotor")
for name in touchdown:
    ring = run.bearing(name)["ring_speed"]
    axis.plot(1e3 * ring.time, to_rpm * ring.values, label=f"ring of {name}")
axis.set(xlabel="time [ms]", ylabel="spin speed [rpm]")
axis.legend()
figure.savefig(pictures / "speeds.png", dpi=110)

# %% Temperatures at the end, of every model that ran
for name in touchdown:
    for model in ("lumped", "fe"):
        try:
            nodes = run.temperatures(name, model)
        except KeyError:
            continue
        ambient = nodes["shaft"].values[0]  # at the start everything is as warm as the surroundings
        ends = {node: nodes[node].values[-1] - ambient for node in nodes if nodes[node].unit == "K" and nodes[node].values.ndim == 1}
        print(f"{name}, {model}: " + ", ".join(f"{node} {rise:+.2f} K" for node, rise in ends.items()))

# %% Energy: what was dissipated, and what is not accounted for
dissipated, residual = run.series("/energy/dissipated"), run.series("/energy/residual")
print(f"energy: {dissipated.values[-1]:.2f} J dissipated, residual at most {abs(residual.values).max():.1e} J")

# %% Temperature fields, if the run has some
for name in touchdown:
    for time, file in run.fields(name):
        rise = read_vtu(file)["data"][RISE]
        print(f"{name} at {1e3 * time:.2f} ms: rise {rise.min():.2f} to {rise.max():.2f} K")

# %% End
run.close()
print(f"pictures: {pictures}")

#!/usr/bin/env python3
"""Conductance of a rolling contact: the formula of src/laws/heat/rolling_conduction.h against a computation of the pass.

    /usr/bin/python3 validation/rolling_conduction.py            # makes validation/rolling_conduction.json, minutes
    /usr/bin/python3 validation/rolling_conduction.py --check    # a few entries of it again, on a coarser mesh

An elliptic spot (semi-axes a across, b along the motion) of one temperature moves at U over a half space, or between two half spaces of different
temperature that both pass it at U. Unknown is the heat flux over the spot. A flux 1 over a rectangle, switched on for ever in a medium that
passes at U, warms its surface at (x, y) by

    integral over t of (1 / (e sqrt(pi t))) X(x - U t) Y(y) dt,   X, Y = (erf((x - x_1)/sqrt(4 kappa t)) - erf((x - x_2)/sqrt(4 kappa t)))/2,

heat released a time t ago being U t downstream. The spot is covered with rectangles, finer towards its rim, the flux on each found by collocation at their
middles; the total over the temperature is the conductance. Nothing is assumed of a Peclet number. Shares no code with the program. Needs numpy and scipy.

Peclet number: U b / kappa of the (first) body. Lengths in b, conductances in k b of the first body.
"""

import argparse
import json
import pathlib

import numpy as np
from scipy.special import ellipk, erf

FILE = pathlib.Path(__file__).with_suffix(".json")
RATIOS, PECLETS = (1, 2, 4, 8, 15), (0.1, 0.3, 1, 3, 10, 30, 100, 1000)
# Second body: conductivity and diffusivity over the first's. Equal; silicon nitride balls on bearing steel (25/42, 1.13); an insulating and a sluggish one.
PAIRS = {"equal": (1.0, 1.0), "nitride on steel": (0.6, 1.13), "one tenth as conducting": (0.1, 1.0), "three times as diffusive": (1.0, 3.0)}


def rectangles(a, n_across, n_along):
    """Half the ellipse, y > 0: x_1, x_2, y_1, y_2 of each; bands have the area of their piece of the ellipse."""
    rim = a * np.sin(np.linspace(0, np.pi / 2, n_across + 1))
    along = -np.cos(np.linspace(0, np.pi, n_along + 1))
    area = lambda y: 0.5 * (y * np.sqrt(max(1 - (y / a) ** 2, 0)) + a * np.arcsin(min(y / a, 1)))
    cells = []
    for low, high in zip(rim[:-1], rim[1:]):
        half = (area(high) - area(low)) / (high - low)
        cells += [(half * p, half * q, low, high) for p, q in zip(along[:-1], along[1:])]
    return np.array(cells)


def influence(cells, a, U, k, kappa, n_times):
    """Rise at the middles per flux of each rectangle and its mirror image at y < 0."""
    x, y = (cells[:, 0] + cells[:, 1]) / 2, (cells[:, 2] + cells[:, 3]) / 2
    size = min((cells[:, 1] - cells[:, 0]).min(), (cells[:, 3] - cells[:, 2]).min())
    first = min(2.5e-4 * size**2 / kappa, 1e-2 * size / U)
    last = min(1e3 * max(a, 1) ** 2 / kappa, 60 * (1 + 1 / U) / U * 4 * max(a, 1) + 60 * kappa / U**2)
    log_time = np.linspace(np.log(first), np.log(last), n_times)
    weights = np.full(n_times, log_time[1] - log_time[0])
    weights[[0, -1]] /= 2
    e = k / np.sqrt(kappa)
    rise = np.eye(len(cells)) * 2 * np.sqrt(first / np.pi) / e  # until then only itself, as a half space that is heated evenly
    for t, weight in zip(np.exp(log_time), weights):
        spread = 1 / np.sqrt(4 * kappa * t)
        at = x[:, None] - U * t
        along = erf((at - cells[:, 0]) * spread) - erf((at - cells[:, 1]) * spread)
        across = erf((y[:, None] - cells[:, 2]) * spread) - erf((y[:, None] - cells[:, 3]) * spread)
        across += erf((y[:, None] + cells[:, 3]) * spread) - erf((y[:, None] + cells[:, 2]) * spread)
        rise += weight * np.sqrt(t / np.pi) / e * along * across / 4
    return rise


def computed(ratio, peclet, second=None, mesh=(7, 18, 100)):
    """Conductance of one spot, or with the second body of the pair: temperature difference 1 between the bodies far away."""
    cells = rectangles(ratio, *mesh[:2])
    rise = influence(cells, ratio, peclet, 1.0, 1.0, mesh[2])
    if second:
        rise = rise + influence(cells, ratio, peclet, *second, mesh[2])
    flux = np.linalg.solve(rise, np.ones(len(cells)))
    return float(2 * flux @ ((cells[:, 1] - cells[:, 0]) * (cells[:, 3] - cells[:, 2])))


def formula(ratio, peclet, second=None):
    def spot(k, kappa):
        at_rest = 2 * np.pi * k * ratio / ellipk(1 - 1 / ratio**2)
        rolling = 2.7895 * k / np.sqrt(kappa) * ratio * np.sqrt(peclet)
        return np.hypot(at_rest, rolling)

    g = spot(1.0, 1.0)
    return float(g if not second else 1 / (1 / g + 1 / spot(*second)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        for entry in json.loads(FILE.read_text())["spots"][::9]:
            again = computed(entry["ratio"], entry["peclet"], mesh=(5, 14, 80))
            print(f"a/b {entry['ratio']:3d}, U b/kappa {entry['peclet']:7.1f}: recorded {entry['computed']:.4f}, again {again:.4f}, formula {formula(entry['ratio'], entry['peclet']):.4f}")
        return
    spots = [{"ratio": r, "peclet": p, "computed": computed(r, p), "formula": formula(r, p)} for r in RATIOS for p in PECLETS]
    pairs = [{"pair": name, "conductivity": pair[0], "diffusivity": pair[1], "ratio": r, "peclet": p, "computed": computed(r, p, pair), "formula": formula(r, p, pair)}
             for name, pair in PAIRS.items() for r in (1, 8) for p in (0.1, 1, 3, 30, 1000)]
    error = lambda e: e["formula"] / e["computed"] - 1
    refined = {f"{r}, {p}": computed(r, p, mesh=(11, 28, 150)) / computed(r, p) - 1 for r, p in ((1, 3), (15, 1), (4, 100))}
    FILE.write_text(json.dumps({"note": "made by rolling_conduction.py: conductances in k b of the first body", "mesh": [7, 18, 100],
                                "change on a mesh 1.5 times as fine (a/b, U b/kappa)": refined, "spots": spots, "pairs": pairs}, indent=1) + "\n")
    for e in spots + pairs:
        print(f"{e.get('pair', 'one body'):26s} a/b {e['ratio']:3d}  U b/kappa {e['peclet']:7.1f}  computed {e['computed']:10.4f}  formula {e['formula']:10.4f}  {100 * error(e):+.2f} %")
    print(f"largest error {100 * max(abs(error(e)) for e in spots):.2f} % (one body), {100 * max(abs(error(e)) for e in pairs):.2f} % (pairs); refinement {refined}")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Growth of bore and inner raceway over a drop: by elasticity, by the volume mean, and by eqs. (26), (27) from surface temperatures.

    /usr/bin/python3 docs/plot_growth.py RESULTS.h5 -o docs/images/growth.png

RESULTS.h5 comes from a run with thermal.models = ["lumped", "fe"], driver = "fe" and expansion = "elastic", growth_by_speed = "closed-form". Draws the figure and prints the table of
docs/theory/growth.md. Elasticity and the two formulas see the same temperatures. The raceway is meant where the balls touch it, and in eq. (27) at the ring's
shoulder, as printed.
"""

import argparse
import re

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TIMES = [10e-3, 20e-3, 50e-3, 100e-3, 300e-3]


def diameters(parameters, bearing):
    table = parameters.partition(f"[bearings.{bearing}]")[2]
    found = re.search(r"inner_ring_diameters\s*=\s*\[([^\]]*)\]", table).group(1)
    return [float(re.search(r"[\d.e+-]+", part).group()) * (1e-3 if "mm" in part else 1.0) for part in found.split(",")]


def contact_radius(parameters, bearing):
    """Radius at which the balls touch the inner race [m]: d_m/2 - (d/2) cos phi."""
    table = parameters.partition(f"[bearings.{bearing}]")[2]

    def value(key):
        number, unit = re.search(rf"^{key}\s*=\s*\"?([\d.e+-]+)\s*(\w*)", table, re.MULTILINE).groups()
        return float(number) * {"mm": 1e-3, "deg": np.pi / 180}.get(unit, 1.0)

    return 0.5 * (value("pitch_diameter") - value("ball_diameter") * np.cos(value("contact_angle")))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("results")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--alpha", type=float, default=11.8e-6, help="expansion coefficient of the rings [1/K]")
    arguments = parser.parse_args()
    with h5py.File(arguments.results) as file:
        parameters = file["parameters"][()]
        parameters = parameters.decode() if isinstance(parameters, bytes) else str(parameters)
        t = file["time"][:]
        bearings = list(file["growth/fe"])
        figure, axes = plt.subplots(2, len(bearings), figsize=(10, 6.4), sharex=True, squeeze=False)
        print("| bearing, surface | t [ms] | elastic [um] | volume mean [um] | eqs. (26), (27) from surface temperatures [um] | centrifugal [um] |")
        print("|---|---|---|---|---|---|")
        for i, bearing in enumerate(bearings):
            a, b = (0.5 * d for d in diameters(parameters, bearing))
            ambient = file[f"fe/{bearing}/inner_ring"][0]
            mean = file[f"fe/{bearing}/inner_ring"][:] - ambient
            inside, outside = (file[f"fe/{bearing}/{name}"][:, 0] - ambient for name in ("bore", "inner_raceway"))
            elastic, total = file[f"growth/fe/{bearing}"][:], file[f"bearings/{bearing}/expansion"][:]
            race = contact_radius(parameters, bearing)
            for j, (name, r, at_contact, column) in enumerate((("bore", a, a, 1), ("inner raceway", b, race, 2))):
                by_mean = arguments.alpha * at_contact * mean
                printed = arguments.alpha * r / (3 * (a + b)) * (inside * (2 * a + b) + outside * (2 * b + a))
                spinning = total[:, column] - elastic[:, column]
                ax = axes[j, i]
                ax.plot(t * 1e3, printed * 1e6, color="0.7", lw=1, label="eqs. (26), (27), surface temperatures")
                ax.plot(t * 1e3, by_mean * 1e6, "--", color="tab:blue", label=r"$\alpha r$ times the volume mean")
                ax.plot(t * 1e3, elastic[:, column] * 1e6, color="tab:red", label="elastic")
                ax.plot(t * 1e3, total[:, column] * 1e6, ":", color="tab:red", label="elastic and centrifugal")
                ax.set_title(f"{bearing}, {name}", fontsize=10)
                ax.set_ylabel("growth [um]")
                for wanted in TIMES:
                    if wanted > t[-1] + 1e-9:
                        continue
                    k = min(int(np.searchsorted(t, wanted - 1e-9)), len(t) - 1)
                    print(f"| {bearing}, {name} | {wanted * 1e3:.0f} | {elastic[k, column] * 1e6:.3f} | {by_mean[k] * 1e6:.3f} | {printed[k] * 1e6:.3f} | {spinning[k] * 1e6:.3f} |")
        for ax in axes[-1]:
            ax.set_xlabel("t [ms]")
        axes[0, 0].legend(fontsize=8)
        figure.tight_layout()
        figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()

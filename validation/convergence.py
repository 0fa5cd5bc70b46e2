#!/usr/bin/env python3
"""How far results depend on the integration: steps and tolerances against a fine reference, full against modal rotor, and the spread of
slightly perturbed runs of the chaotic case.

    /usr/bin/python3 validation/convergence.py [--program build/release/rotordrop] [--work DIR] [--write DIR] [--only steps starts "fast modes" modes spread]

Writes the tables of docs/theory/convergence.md (between its markers) and docs/images/convergence.png. From other starts (--shifts, --first, --spacing) it
only prints them, unless --write names a folder.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEARINGS = ("TB1", "TB2")


class Runs:
    def __init__(self, program, work):
        self.program, self.work = program, pathlib.Path(work)
        self.references = {}  # by air gap [m] and what else the machine has

    def run(self, name, case, **settings):
        """Runs a case; settings are parameters with __ for the dot. Returns times, orbits [m] of all bearings, and the summary."""
        directory = self.work / name
        command = [self.program, "run", ROOT / "params" / f"{case}.toml", "-o", directory, "--force", "--quiet", "--set", "output.interval=1e-4"]
        for key, value in settings.items():
            command += ["--set", f"{key.replace('__', '.')}={value}"]
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{' '.join(str(c) for c in command)}\n{done.stderr}")
        with h5py.File(directory / "results.h5", "r") as f:
            orbit = np.hstack([f[f"/bearings/{b}/orbit"][:] for b in BEARINGS])
            return f["/time"][:], orbit, json.loads((directory / "summary.json").read_text())


def largest_distance(a, b, until=np.inf):
    """Largest distance of two orbits [um] up to a time, at equal instants."""
    n = min(len(a[0]), len(b[0]))
    assert np.allclose(a[0][:n], b[0][:n], atol=1e-9)
    here = a[0][:n] <= until + 1e-9
    return 1e6 * np.abs(a[1][:n][here] - b[1][:n][here]).max()


TOLERANCES = {
    "tsitouras": (1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-8),
    "bogacki-shampine": (1e-5, 3e-6, 1e-6, 3e-7),
    "sofroniou-spaletta": (1e-5, 3e-6, 2e-6, 1e-6, 3e-7),
    "two-step-runge-kutta": (1e-5, 3e-6, 2e-6, 1e-6, 3e-7, 1e-7),
    "dormand-prince": (1e-5, 1e-6, 3e-7, 1e-7, 1e-8),
    "fehlberg-8": (1e-5, 1e-6, 3e-7, 1e-7, 1e-8),
    "adams": (1e-5, 1e-6, 3e-7, 1e-7, 1e-8)}
SETTINGS = (
    [(f"runge-kutta-4, {s:g} us", dict(integration__method="runge-kutta-4", integration__step=s * 1e-6)) for s in (20, 10, 5, 2.5, 1)]
    + [(f"{m}, {t:g}", dict(integration__method=m, integration__tolerance=t)) for m, list_of in TOLERANCES.items() for t in list_of])


def air_gaps(shifts, first, spacing):
    """Where in a step a contact closes is chance. These starts, twelve for every shift [m], differ by their air gaps; each has a fine reference of its own."""
    return [first + shift + spacing * k for shift in shifts for k in range(12)]


FINE = dict(integration__method="runge-kutta-4", integration__step=0.5e-6)


def from_starts(runs, gaps, settings, **machine):
    """Errors of the orbits [um] and summaries from all starts, each against its own fine reference of the same machine."""
    errors, summaries = [], []
    for gap in gaps:
        start = (gap, *sorted(machine.items()))
        if start not in runs.references:
            runs.references[start] = runs.run("settling-fine", "neisi2019-settling", contact__air_gap=gap, **machine, **FINE)
        run = runs.run("settling", "neisi2019-settling", contact__air_gap=gap, **machine, **settings)
        errors.append(largest_distance(run, runs.references[start]))
        summaries.append(run[2])
    return np.array(errors), summaries


def study_of_steps(runs, lines, points, gaps):
    table = runs.run("table-fine", "neisi2019", run__end_time=0.02, **FINE)
    lines += [f"| method, step or tolerance | steps | right-hand sides | CPU [s] | settling, to 0.3 s: median, worst of {len(gaps)} starts [um] | table, to 20 ms [um] | energy residual, worst [J] |",
              "|---|---|---|---|---|---|---|"]
    for name, settings in SETTINGS:
        errors, summaries = from_starts(runs, gaps, settings)
        steps, evaluations = (int(np.median([s["run"][key] for s in summaries])) for key in ("steps", "rhs_evaluations"))
        cpu = np.median([s["run"]["cpu_time"] for s in summaries])
        residual = max((s["energy"]["residual"] for s in summaries), key=abs)
        early = largest_distance(runs.run("table", "neisi2019", run__end_time=0.02, **settings), table)
        points.append((name, evaluations, np.median(errors), max(errors)))
        lines.append(f"| {name} | {steps} | {evaluations} | {cpu:.3f} | {np.median(errors):.4f}, {max(errors):.4f} | {early:.5f} | {residual:.1e} |")
        print(lines[-1], flush=True)


WORTH_THEIR_COST = {"two-step-runge-kutta": (3e-6, 2.5e-6, 2e-6, 1.5e-6, 1e-6, 5e-7), "sofroniou-spaletta": (3e-6, 2e-6, 1e-6, 5e-7), "tsitouras": (1e-6, 3e-7, 1e-7), "dormand-prince": (3e-7,), "bogacki-shampine": (1e-6,), "adams": (1e-6,)}
ALLOWED = 0.2  # [um]


def study_of_starts(runs, lines, gaps):
    """Many starts: what a worst case of twelve is worth, and how many orbits stay near their references to the end."""
    lines += [f"| method, tolerance | right-hand sides | median [um] | root mean square [um] | worst [um], and of each twelve | within {ALLOWED} um, of {len(gaps)} | energy residual, worst [J] |",
              "|---|---|---|---|---|---|---|"]
    for method, tolerances in WORTH_THEIR_COST.items():
        for tolerance in tolerances:
            errors, summaries = from_starts(runs, gaps, dict(integration__method=method, integration__tolerance=tolerance))
            evaluations = int(np.median([s["run"]["rhs_evaluations"] for s in summaries]))
            residual = max((s["energy"]["residual"] for s in summaries), key=abs)
            twelves = ", ".join(f"{errors[i:i + 12].max():.3f}" for i in range(0, len(errors), 12))
            lines.append(f"| {method}, {tolerance:g} | {evaluations} | {np.median(errors):.3f} | {np.sqrt(np.mean(errors**2)):.3f} | {errors.max():.3f} ({twelves}) | {np.sum(errors <= ALLOWED)} | {residual:.1e} |")
            print(lines[-1], flush=True)


def study_of_modes(runs, lines):
    """Full rotor (all modes) against fewer, over the first contacts of the settling case."""
    lines += ["| rotor | flexible modes a plane | peak force TB1 [N] | peak force TB2 [N] | orbit against full, to 20 ms [um] | peak force against full |", "|---|---|---|---|---|---|"]
    def fixed(microseconds):
        return dict(integration__method="runge-kutta-4", integration__step=microseconds * 1e-6)

    short = dict(run__end_time=0.02)
    full = runs.run("full", "neisi2019-settling", rotor__model="full", **fixed(0.2), **short)
    variants = [("full", full)]
    for name, settings in [("modal, 50 kHz", dict(rotor__cut_off_frequency="50 kHz", **fixed(1))),
                           ("modal, 10 kHz", dict(rotor__cut_off_frequency="10 kHz")), ("modal, 4.5 kHz (reference)", {}),
                           ("modal, 2 kHz", dict(rotor__cut_off_frequency="2 kHz")), ("modal, 1 kHz", dict(rotor__cut_off_frequency="1 kHz")),
                           ("rigid", dict(rotor__model="rigid"))]:
        variants.append((name, runs.run("modes", "neisi2019-settling", **{**short, **settings})))
    reference = [full[2]["bearings"][b]["peak_contact_force"] for b in BEARINGS]
    for name, r in variants:
        peaks = [r[2]["bearings"][b]["peak_contact_force"] for b in BEARINGS]
        change = max(abs(p / q - 1) for p, q in zip(peaks, reference))
        lines.append(f"| {name} | {len(r[2]['rotor']['free_free_frequencies'])} | {peaks[0]:.1f} | {peaks[1]:.1f} | {largest_distance(r, full):.3f} | {100 * change:.2f} % |")
        print(lines[-1], flush=True)


def study_of_fast_modes(runs, lines, gaps):
    """The rotor with all its modes: fast ones by exponentials, and by steps that resolve them."""
    lines += [f"| method, tolerance | fast modes | steps | right-hand sides | CPU [s] | settling, to 0.3 s: median, root mean square, worst of {len(gaps)} starts [um] | energy residual, worst [J] |", "|---|---|---|---|---|---|---|"]
    for method, tolerance in (("two-step-runge-kutta", 3e-6), ("two-step-runge-kutta", 1e-6), ("two-step-runge-kutta", 3e-7), ("sofroniou-spaletta", 1e-6), ("tsitouras", 3e-7), ("bogacki-shampine", 1e-6)):
        for words, above in (("exponentials", "20 kHz"), ("resolved", "1 MHz")):
            settings = dict(integration__method=method, integration__tolerance=tolerance, integration__exponential_above=above)
            errors, summaries = from_starts(runs, gaps, settings, rotor__model="full")
            steps, evaluations, cpu = (np.median([s["run"][key] for s in summaries]) for key in ("steps", "rhs_evaluations", "cpu_time"))
            residual = max((s["energy"]["residual"] for s in summaries), key=abs)
            lines.append(f"| {method}, {tolerance:g} | {words} | {steps:.0f} | {evaluations:.0f} | {cpu:.3f} | {np.median(errors):.3f}, {np.sqrt(np.mean(errors**2)):.3f}, {errors.max():.3f} | {residual:.1e} |")
            print(lines[-1], flush=True)


def study_of_spread(runs, lines):
    """The table's damping lets the rotor bounce on, chaotically: runs that start nanometres apart tell what can be known at the end."""
    units = {"time": "s", "force": "N", "apex": "m", "heat": "J", "speed": "rad/s", "rate": "W"}
    def unit_of(key):
        return next(units[word] for word in reversed(key.split("_")) if word in units)
    results = [runs.run("spread", "neisi2019", rotor__initial_offset=f"[{k * 1e-9}, 0]")[2] for k in range(8)]
    lines += ["| \"table\" case, 8 runs | bearing | lowest | highest |", "|---|---|---|---|"]
    for key in ("first_contact_time", "peak_contact_force", "first_bounce_apex", "friction_heat", "catch_up_time", "ring_speed_end",
                "mean_contact_force_end", "inner_heat_rate_max", "outer_heat_rate_max"):
        for b in BEARINGS:
            values = [r["bearings"][b][key] for r in results]
            known = [v for v in values if v is not None]
            text = [f"{f(known):.6g}" if known else "never" for f in (min, max)]
            lines.append(f"| {key} [{unit_of(key)}] | {b} | {text[0]} | {text[1]}{' (some never)' if known and len(known) < len(values) else ''} |")
    for node in ("shaft", "inner_ring", "inner_contact", "ball", "outer_contact", "outer_ring", "housing"):
        for b in BEARINGS:
            values = [r["bearings"][b]["temperature_rise_end"][node] for r in results]
            lines.append(f"| temperature_rise_end.{node} [K] | {b} | {min(values):.5g} | {max(values):.5g} |")
    print("\n".join(lines), flush=True)


def draw(points, n_starts, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(8.0, 4.4))
    for method, marker in (("runge-kutta-4", "o"), ("tsitouras", "*"), ("bogacki-shampine", "v"), ("sofroniou-spaletta", "P"), ("two-step-runge-kutta", "X"), ("dormand-prince", "s"), ("fehlberg-8", "^"), ("adams", "d")):
        chosen = np.array([of[1:] for of in points if of[0].startswith(method)])
        line, = axes.loglog(chosen[:, 0], chosen[:, 2], marker=marker, label=method)
        axes.loglog(chosen[:, 0], chosen[:, 1], marker=marker, ls=":", lw=0.8, ms=3, color=line.get_color())
    axes.axhline(0.2, color="0.6", lw=1)
    axes.annotate("0.2 um", (axes.get_xlim()[1], 0.2), ha="right", va="bottom", color="0.4")
    axes.set_xlabel("right-hand sides for 0.3 s")
    axes.set_ylabel("largest error of the orbits [um]")
    axes.set_title(f"Settling case against 0.5 us Runge-Kutta: worst of {n_starts} starts, dotted their median", fontsize=10)
    axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.grid(alpha=0.3, which="both")
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/rotordrop"))
    parser.add_argument("--work", default=None)
    parser.add_argument("--write", type=pathlib.Path, help="folder of convergence.md (docs/theory; from other starts: none)")
    parser.add_argument("--images", default=str(ROOT / "docs/images"), help="folder of the figure")
    parser.add_argument("--shifts", type=float, nargs="+", help="of the air gaps of twelve starts each [m]; steps: 0, starts: 0 0.033e-6 0.067e-6")
    parser.add_argument("--first", type=float, default=250e-6, help="air gap of the first start [m]")
    parser.add_argument("--spacing", type=float, default=0.11e-6, help="of the air gaps [m]")
    names = ("steps", "starts", "fast modes", "modes", "spread")
    parser.add_argument("--only", nargs="+", choices=names, default=names, help="these tables")
    options = parser.parse_args()
    starts = ("shifts", "first", "spacing")
    if options.write is None and all(getattr(options, name) == parser.get_default(name) for name in starts):
        options.write = ROOT / "docs/theory"
    gaps = air_gaps(options.shifts or [0.0], options.first, options.spacing)
    many_gaps = air_gaps(options.shifts or [0.0, 0.033e-6, 0.067e-6], options.first, options.spacing)
    points, tables = [], {name: [] for name in names if name in options.only}
    with tempfile.TemporaryDirectory() as scratch:
        runs = Runs(options.program, options.work or scratch)
        studies = {"steps": lambda lines: study_of_steps(runs, lines, points, gaps), "starts": lambda lines: study_of_starts(runs, lines, many_gaps),
                   "fast modes": lambda lines: study_of_fast_modes(runs, lines, gaps),
                   "modes": lambda lines: study_of_modes(runs, lines), "spread": lambda lines: study_of_spread(runs, lines)}
        for name, lines in tables.items():
            studies[name](lines)
    if options.write is None:
        return  # what was printed is all
    images = pathlib.Path(options.images)
    images.mkdir(parents=True, exist_ok=True)
    page = options.write / "convergence.md"
    text = page.read_text()
    for name, lines in tables.items():
        begin, end = f"<!-- {name}: written by validation/convergence.py -->\n", f"<!-- end of {name} -->"
        head, rest = text.split(begin)
        text = head + begin + "\n".join(lines) + "\n" + end + rest.split(end, 1)[1]
    page.write_text(text)
    if points:
        draw(points, len(gaps), images / "convergence.png")


if __name__ == "__main__":
    main()

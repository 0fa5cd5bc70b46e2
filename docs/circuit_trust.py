"""For how long and for what the lumped circuit can be trusted: table and figure of docs/how-to/compare.md.

    /usr/bin/python3 docs/circuit_trust.py build/release/rotordrop FOLDER

Step heat of 100 W into each port of TB1 and TB2 of the reference case, cold at the start, from 1 ms to 1000 s: the circuit as published, with
spreading, with spreading and fin, and the last one calibrated, each against finite elements with the shaft as a fin; and the settling drop over 3 s,
the same four against the finite elements that got its heat. Writes FOLDER/circuit-trust.png and .json, and prints the tables in Markdown.
"""

import json
import pathlib
import subprocess
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

PARAMS = pathlib.Path(__file__).resolve().parents[1] / "params"
AMBIENT, WATTS, FLOOR = 293.15, 100.0, 0.01  # K, W, K
TIMES = np.logspace(-3, 3, 25)
PORTS = {"rub": "rub heat", "inner": "inner race", "outer": "outer race"}
NODES = ("shaft", "inner_ring", "ball", "outer_ring", "housing")
SURFACES = ("shaft", "bore", "inner_race", "outer_race", "ball_radius", "inner_width", "outer_width", "row_difference")
VARIANTS = {  # name: settings of the circuit
    "published": {"spreading": "none", "shaft": "lump"},
    "spreading": {"spreading": "strip", "shaft": "lump"},
    "spreading and fin": {"spreading": "strip", "shaft": "fin"},
    "calibrated": {"spreading": "strip", "shaft": "fin"},
}
DROP_TIMES = np.logspace(-2, np.log10(3), 30)  # s; the first contact comes after 7.4 ms
COLOURS = dict(zip(VARIANTS, ("#b2182b", "#ef8a62", "#2166ac", "#4d9221")))


def call(program, *words, cwd):
    done = subprocess.run([program, *map(str, words)], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def heat(program, folder, bearing, port, models, keys, base):
    """Temperatures [K over ambient] and growth of each model at TIMES."""
    out = folder / "heat"
    text = f'base = "{base}"\n[thermal]\nexpansion = "{"elastic" if "fe" in models else "formula"}"\nmodels = {json.dumps(["lumped", "fe"] if "fe" in models else models)}\n'
    text += "".join(f'{key} = "{value}"\n' for key, value in keys.items())
    text += 'fe.coupling = "windowed"\n' if "fe" in models else ""
    text += f'[heat]\nbearing = "{bearing}"\nmodels = {json.dumps(models)}\ntime_tolerance = 1e-5\noutput_times = {json.dumps(list(TIMES))}\n'
    text += f'[[heat.source]]\nport = "{port}"\ntimes = [0]\nvalues = ["{WATTS} W"]\n'
    (folder / "heat.toml").write_text(text)
    call(program, "heat", "heat.toml", "-o", out, "--quiet", "--force", cwd=folder)
    summary = json.loads((out / "summary.json").read_text())
    found = {}
    for model in models:
        rises = {node: np.array(summary["probes"][f"{model}.{node}"]["temperature"]) - AMBIENT for node in NODES}
        found[model] = {**rises, "growth": summary["growth"][model]}
    return found


def approach(growth, bearing):
    """Of the races to the balls along the nominal contact normal [m], mean of the rows."""
    phi, d, width, apart = {"TB1": (0.0, 11.906e-3, 20e-3, 0.0), "TB2": (np.radians(25), 9.525e-3, 32e-3, 8e-3)}[bearing]
    u = {key: np.array(growth[key]) for key in ("inner_race", "outer_race", "ball_radius", "inner_width", "outer_width")}
    side = np.sin(phi)
    return (np.cos(phi) * (u["inner_race"] - u["outer_race"]) + 2 * u["ball_radius"]
            + side / width * ((apart - d / 2 * side) * u["inner_width"] - (apart + d / 2 * side) * u["outer_width"]))


def relative(circuit, fe):
    """Difference over the larger rise, and over the floor where both are small."""
    return (circuit - fe) / np.maximum(np.maximum(abs(circuit), abs(fe)), FLOOR)


def first_beyond(error, part=0.05):
    beyond = np.nonzero(abs(error) > part)[0]
    return TIMES[beyond[0]] if len(beyond) else np.inf


def at_times(report, port, times, grid):
    """Errors of TB1 at some times, in Markdown."""
    nearest = [int(np.argmin(abs(np.log(grid / t)))) for t in times]
    lines = ["| " + port + " | circuit | " + " | ".join(f"{t:g} s" for t in times) + " |", "|---|---|" + "---|" * len(times)]
    for node in (*NODES, "approach"):
        for name in VARIANTS:
            found = report["TB1", port, name]
            values = 1e6 * found["approach"] if node == "approach" else 100 * found["errors"][node]
            lines.append(f"| {node} | {name} | " + " | ".join(f"{values[i]:+.2f} um" if node == "approach" else f"{values[i]:+.0f} %" for i in nearest) + " |")
    return "\n".join(lines)


def text_of(time):
    return "1000 s" if np.isinf(time) else f"{time * 1e3:.3g} ms" if time < 0.9995 else f"{time:.3g} s"


def steps(program, folder):
    report = {}
    for bearing in ("TB1", "TB2"):
        for port in PORTS:
            reference = str(PARAMS / "neisi2019-settling.toml")
            fe = heat(program, folder, bearing, port, ["fe"], {"spreading": "strip", "shaft": "fin"}, reference)["fe"]
            for name, keys in VARIANTS.items():
                base = "calibrated.toml" if name == "calibrated" else reference
                circuit = heat(program, folder, bearing, port, ["lumped"], keys, base)["lumped"]
                errors = {node: relative(circuit[node], fe[node]) for node in NODES}
                difference = approach(circuit["growth"], bearing) - approach(fe["growth"], bearing)
                report[bearing, port, name] = {"errors": errors, "approach": difference, "rise": {n: fe[n] for n in NODES}}
    return report


def drop_errors(program, folder):
    """Of the settling drop over 3 s as in steps(); in every drop the circuit drives, and the finite elements have the shaft as a fin."""
    report = {}
    for name, keys in VARIANTS.items():
        base = "calibrated.toml" if name == "calibrated" else PARAMS / "neisi2019-settling.toml"
        words = [w for key, value in keys.items() for w in ("--set", f"thermal.{key}={value}")]
        call(program, "run", base, "-o", "long", "--quiet", "--force", "--set", 'thermal.models=["lumped","fe"]' if keys["shaft"] == "fin" else 'thermal.models=["lumped"]',
             "--set", "thermal.expansion=formula", "--set", "run.end_time=3 s", *words, cwd=folder)
        with h5py.File(folder / "long/results.h5") as file:
            at = lambda path: np.array([np.interp(DROP_TIMES, file["time"][:], column) for column in np.atleast_2d(file[path][:].T)])
            for bearing in ("TB1", "TB2"):
                found = {node: at(f"thermal/{bearing}/{node}")[0] - AMBIENT for node in NODES}
                found["growth"] = dict(zip(SURFACES, at(f"growth/lumped/{bearing}")))
                report[bearing, name] = found
                if name == "spreading and fin":
                    fe = {node: at(f"fe/{bearing}/{node}")[0] - AMBIENT for node in NODES}
                    fe["growth"] = dict(zip(SURFACES, at(f"fe/{bearing}/elastic_growth")))
                    report[bearing, "fe"] = fe
    return {(bearing, "drop", name): {"errors": {node: relative(report[bearing, name][node], report[bearing, "fe"][node]) for node in NODES},
                                      "approach": approach(report[bearing, name]["growth"], bearing) - approach(report[bearing, "fe"]["growth"], bearing)}
            for name in VARIANTS for bearing in ("TB1", "TB2")}


def drop(program, folder):
    """By time, from comparison.json of the settling drop: worst usage of the tolerances."""
    report = {}
    for name, keys in {"published": {"spreading": "none", "shaft": "lump", "contact_conduction": "fixed"},
                       "spreading, fin, rolling": {"spreading": "strip", "shaft": "fin", "contact_conduction": "rolling"}}.items():
        words = [w for key, value in keys.items() for w in ("--set", f"thermal.{key}={value}")]
        out = folder / "drop"
        call(program, "run", PARAMS / "neisi2019-settling.toml", "-o", out, "--quiet", "--force", "--set", 'thermal.models=["lumped","fe"]', "--set", "thermal.expansion=formula",
             "--set", "thermal.growth_by_speed=closed-form", *words, cwd=folder)
        report[name] = json.loads((out / "comparison.json").read_text())["bearings"]
    return report


def table(report):
    lines = ["| heat into | quantity | " + " | ".join(VARIANTS) + " |", "|---|---|" + "---|" * len(VARIANTS)]
    for port, words in PORTS.items():
        for node in NODES:
            cells = []
            for name in VARIANTS:
                each = []
                for bearing in ("TB1", "TB2"):
                    error = report[bearing, port, name]["errors"][node]
                    worst = error[np.argmax(abs(error))]
                    each.append(f"{text_of(first_beyond(error))}, {100 * worst:+.0f} %")
                cells.append(" / ".join(each))
            lines.append(f"| {words} | {node.replace('_', ' ')} | " + " | ".join(cells) + " |")
        cells = []
        for name in VARIANTS:
            each = [report[bearing, port, name]["approach"] for bearing in ("TB1", "TB2")]
            cells.append(" / ".join(f"{TIMES[b[0]] * 1e3:.3g} ms, {e[np.argmax(abs(e))] * 1e6:+.2f} um" if len(b := np.nonzero(abs(e) > 1e-7)[0]) and TIMES[b[0]] < 1 else
                                    f"{text_of(TIMES[b[0]]) if len(b) else '1000 s'}, {e[np.argmax(abs(e))] * 1e6:+.2f} um" for e in each))
        lines.append(f"| {words} | approach of the races to the balls | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def figure(report, file):
    rows = {**PORTS, "drop": "settling drop"}
    plots, axes = plt.subplots(len(rows), len(NODES) + 1, figsize=(16, 10.5), sharex=True)
    for row, (port, words) in enumerate(rows.items()):
        times = DROP_TIMES if port == "drop" else TIMES
        for column, node in enumerate((*NODES, "approach")):
            axis = axes[row][column]
            for name, colour in COLOURS.items():
                for bearing, style in (("TB1", "-"), ("TB2", "--")):
                    found = report[bearing, port, name]
                    y = 1e6 * found["approach"] if node == "approach" else 100 * found["errors"][node]
                    axis.semilogx(times, y, style, color=colour, lw=1.2, label=f"{name}, {bearing}")
            limit = 0.1 if node == "approach" else 5
            axis.axhspan(-limit, limit, color="0.9", zorder=0)
            axis.set_yscale("symlog", linthresh=limit)
            axis.set_title(f"{words}: {node.replace('_', ' ')}" + (" [um]" if node == "approach" else " [%]"), fontsize=8)
            axis.tick_params(labelsize=7)
            if row == len(rows) - 1:
                axis.set_xlabel("time since heat, or the drop, began [s]", fontsize=8)
    handles, labels = axes[0][0].get_legend_handles_labels()
    plots.legend(handles, labels, loc="lower center", ncol=len(VARIANTS), fontsize=8, frameon=False)
    plots.tight_layout(rect=(0, 0.07, 1, 1))
    plots.savefig(file, dpi=80)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    fitted = [w for key, value in VARIANTS["calibrated"].items() for w in ("--set", f"thermal.{key}={value}")]
    if not (folder / "calibrated.toml").exists():
        (folder / "calibration.txt").write_text(call(program, "calibrate", PARAMS / "neisi2019-settling.toml", "-o", folder / "calibrated.toml", *fitted, cwd=folder))
    print((folder / "calibration.txt").read_text())
    report = steps(program, folder)
    print(table(report))
    report.update(drop_errors(program, folder))
    for port in PORTS:
        print(at_times(report, port, (1e-3, 1e-2, 0.1, 1, 10, 100, 1000), TIMES))
    print(at_times(report, "drop", (0.01, 0.03, 0.1, 0.3, 1, 3), DROP_TIMES))
    figure(report, folder / "circuit-trust.png")
    falls = drop(program, folder)
    (folder / "circuit-trust.json").write_text(json.dumps({"/".join(k): {"errors": {n: list(e) for n, e in v["errors"].items()}, "approach": list(v["approach"])} for k, v in report.items()}))
    for name, bearings in falls.items():
        for bearing, b in bearings.items():
            parts = [f"{key} {d['beyond_from'] * 1e3:.4g} ms" for group in ("temperatures", "growth", "clearances") for key, d in b[group].items() if d["beyond_from"] is not None]
            print(f"drop, {name}, {bearing}: beyond the tolerance from: {', '.join(parts) or 'never'}; ball approach {b['ball_approach']['beyond_from']}, largest {b['ball_approach']['largest_difference']}; effect {b['effect']}")


if __name__ == "__main__":
    main()

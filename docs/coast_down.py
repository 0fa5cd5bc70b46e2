#!/usr/bin/env python3
"""Runs the coast-down of the reference machine and puts its results into docs/how-to/coast-down.md.

    python3 docs/coast_down.py [--program build/release/rotordrop] [--output out/coast-down] [--only NAME ...] [--update]

One run for each line of VARIANTS, minutes each; results that are there already are read, not computed again. Without --update the tables are printed.
"""

import json
import math
import pathlib
import subprocess

import document_tables
import h5py

DOCUMENT = document_tables.ROOT / "docs/how-to/coast-down.md"
CASE = document_tables.ROOT / "params/neisi2019-coast-down.toml"
BEGIN, END = "<!-- results: made by docs/coast_down.py -->\n", "<!-- end of results -->\n"
BOTH = ("thermal.models=[\"lumped\", \"fe\"]",)
VARIANTS = {  # name: (what it is, settings)
    "circuit": ("growth by the circuit", ()),
    "elements": ("growth by finite elements", (*BOTH, "thermal.driver=fe")),
    "windage": ("no brake: windage and bearings only; growth by the circuit", ("rotor.torque=0 N m", "run.end_time=6000 s")),
}


def run(program, name, output):
    directory = output / name
    if not (directory / "summary.json").exists() or not json.loads((directory / "summary.json").read_text())["run"]["completed"]:
        settings = [word for setting in VARIANTS[name][1] for word in ("--set", setting)]
        subprocess.run([program, "run", CASE, "-o", directory, "--quiet", "--force", *settings], check=True)
    summary = json.loads((directory / "summary.json").read_text())
    with h5py.File(directory / "results.h5") as file:
        ambient = 293.15
        for bearing, b in summary["bearings"].items():
            b["largest_rises"] = {model: largest(file[f"{path}/{bearing}"], file["time"][:], ambient) for model, path in (("circuit", "thermal"), ("elements", "fe")) if f"{path}/{bearing}" in file}
    return summary, (directory / "results.h5").stat().st_size


def largest(group, time, ambient):
    """Largest mean temperature of a part over the run: rise, part, when."""
    values = {name: node[:] - ambient for name, node in group.items() if node.ndim == 1 and node.attrs.get("units") in ("K", b"K")}
    part = max(values, key=lambda name: values[name].max())
    return values[part].max(), part.replace("_", " "), time[values[part].argmax()]


def verdict(bearing):
    """What ends a bearing, by the limits of docs/how-to/preload.md: 4.2 GPa (ISO 76) and 150 degC; and how far it was from them."""
    rise = max(value for value, _, _ in bearing["largest_rises"].values())
    pressure = bearing["largest_contact_pressure"]
    good = pressure < 4.2e9 and rise < 130
    return "survives" if good else "fails"


def lines(results):
    rpm = 30 / math.pi
    runs = [(name, *results[name]) for name in VARIANTS if name in results]
    text = "| run | ended by | at [s] | speed left [rpm] | windage [kJ] | brake [kJ] | into bearings [kJ] | energy residual [J] | heat residual [J] | file [MB] |\n" + "|---" * 10 + "|\n"
    for name, s, size in runs:
        e = s["energy"]
        text += (f"| {VARIANTS[name][0]} | {s['run']['ended_by']} | {s['run']['end_time']:.1f} | {s['rotor_speed_end'] * rpm:.1f} | {e['windage'] / 1e3:.2f} | {-e['drive_work'] / 1e3:.2f} | "
                 f"{e['heat_deposited'] / 1e3:.2f} | {e['residual']:.1e} | {e['heat_residual']:.1e} | {size / 1e6:.0f} |\n")
    text += "\n| run | bearing | rub heat [kJ] | friction in it [kJ] | preload at start, largest, end [N] | largest pressure [GPa] | rises at the end, circuit [K] | by finite elements [K] | largest mean rise [K], circuit; finite elements | verdict |\n" + "|---" * 10 + "|\n"
    for name, s, _ in runs:
        for bearing, b in s["bearings"].items():
            preload = " / ".join(f"{b['preload'][key]:.0f}" for key in ("start", "largest", "end")) if "preload" in b else "-"
            rises = lambda values: ", ".join(f"{part.replace('_', ' ')} {values[part]:.1f}" for part in ("inner_ring", "ball", "outer_ring", "housing") if part in values) or "-"
            peaks = "; ".join(f"{rise:.1f} ({part}, {when:.0f} s)" for rise, part, when in b["largest_rises"].values())
            text += (f"| {VARIANTS[name][0]} | {bearing} | {b['friction_heat'] / 1e3:.2f} | {(b['inner_heat'] + b['outer_heat']) / 1e3:.2f} | {preload} | {b['largest_contact_pressure'] / 1e9:.2f} | "
                     f"{rises(b.get('temperature_rise_end', {}))} | {rises(b.get('fe', {}).get('temperature_rise_end', {}))} | {peaks} | {verdict(b)} |\n")
    return text


def main():
    options = document_tables.options(__doc__, "out/coast-down", VARIANTS, DOCUMENT)
    text = lines({name: run(options.program, name, options.output) for name in options.only})
    if not options.update:
        print(text)
        return
    document_tables.put_between(DOCUMENT, BEGIN, END, text)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Runs the cases of docs/how-to/preload.md with `rotordrop preload` and puts their results into its tables.

    python3 docs/preload_tables.py [--program build/release/rotordrop] [--output out/preload-tables] [--only NAME ...] [--update]

Results that are there already are read, not computed again. Without --update the tables are printed. The pair TB2 only.
"""

import json
import math
import pathlib
import subprocess

import document_tables

DOCUMENT = document_tables.ROOT / "docs/how-to/preload.md"
CASE = document_tables.ROOT / "params/neisi2019-preload.toml"
QUICK = ("preload.map.growth=[]", "preload.map.interference=[]", "preload.map.inner_rise=[]", "preload.critical_values=false")
LUMP, PUBLISHED = ("thermal.shaft=lump",), ("thermal.shaft=lump", "thermal.contact_conduction=fixed", "thermal.spreading=none")
FE = ("preload.model=fe", 'thermal.models=["lumped", "fe"]')


def at(rpm):
    return (f"preload.speed={rpm} rpm",)


SPEEDS = {f"speed-{rpm}": (f"{rpm:,} rpm".replace(",", " "), at(rpm)) for rpm in (2500, 6000, 12000, 15200, 19000, 20500, 22000, 24000)}
SPREAD = {
    "base": ("the case", ()),
    "shaft-lump": ("shaft a lump of the ring's width (as published)", LUMP),
    "h-shaft-5": ("h_shaft 5 instead of 50 W/(m2 K)", ("thermal.h_shaft=5 W/(m2 K)",)),
    "h-shaft-20": ("h_shaft 20", ("thermal.h_shaft=20 W/(m2 K)",)),
    "h-shaft-200": ("h_shaft 200", ("thermal.h_shaft=200 W/(m2 K)",)),
    "housing-half": ("convection of the housing x 0.5 (half its length)", ("bearings.TB2.housing_length=25 mm",)),
    "housing-double": ("x 2", ("bearings.TB2.housing_length=100 mm",)),
    "f2-0.1": ("f2 0.1 instead of 0.25", ("bearings.TB2.f2=0.1",)),
    "f2-0.5": ("f2 0.5", ("bearings.TB2.f2=0.5",)),
    "f2-1": ("f2 1", ("bearings.TB2.f2=1",)),
    "f2-2": ("f2 2", ("bearings.TB2.f2=2",)),
    "fixed": ("contacts with the published R5", ("thermal.contact_conduction=fixed",)),
    "oil": ("oil film of 0.1 um in the contacts", ("thermal.oil_film=0.1 um",)),
    "fit-0": ("fit in the housing 0 instead of 0.005 K/W", ("thermal.fit_resistance=0 K/W",)),
    "fit-0.02": ("fit 0.02 K/W", ("thermal.fit_resistance=0.02 K/W",)),
    "fit-0.05": ("fit 0.05 K/W", ("thermal.fit_resistance=0.05 K/W",)),
    "k-45": ("steel that conducts 45 instead of 70 W/(m K)", ("materials.steel.k=45",)),
    "inertial": ('balls with inertia (`ball_model = "inertial"`)', ("bearings.TB2.ball_model=inertial",)),
    "with-spin": ("heat of the spin moments added", ("bearings.TB2.internal_heat=with-spin",)),
    "no-speed-growth": ("no growth by speed", ("preload.growth_by_speed=none",)),
    "preload-100": ("100 N mounted", ("bearings.TB2.preload=100 N",)),
    "preload-600": ("600 N mounted", ("bearings.TB2.preload=600 N",)),
    "spring": ("290 N by a spring", ("statics.preload_by=spring",)),
    "O": ("O instead of X", ("bearings.TB2.arrangement=O",)),
}
MODELS = {
    "base": ("15 200 rpm, circuit", ()),
    "fe": ("15 200 rpm, finite elements, volume means", FE),
    "elastic": ("15 200 rpm, finite elements, elasticity", (*FE, "thermal.expansion=elastic")),
    "paper": ('15 200 rpm, circuit, the paper\'s growth (`"paper"`)', ("thermal.expansion=paper",)),
    "elastic-19000": ("19 000 rpm, finite elements, elasticity", (*FE, "thermal.expansion=elastic", *at(19000))),
    "elastic-17000": ("17 000 rpm, finite elements, elasticity", (*FE, "thermal.expansion=elastic", *at(17000))),
    "inertial-19000": ("19 000 rpm, circuit, balls with inertia", ("bearings.TB2.ball_model=inertial", *at(19000))),
    "inertial-17000": ("17 000 rpm, circuit, balls with inertia", ("bearings.TB2.ball_model=inertial", *at(17000))),
    "elastic-inertial": ("15 200 rpm, finite elements, elasticity, balls with inertia", (*FE, "thermal.expansion=elastic", "bearings.TB2.ball_model=inertial")),
    "inertial-12000": ("12 000 rpm, circuit, balls with inertia", ("bearings.TB2.ball_model=inertial", *at(12000))),
    "lump-6000": ("6000 rpm, shaft a lump, circuit", (*LUMP, *at(6000))),
    "lump-6000-fe": ("the same, finite elements, volume means", (*LUMP, *at(6000), *FE)),
    "lump-6000-elastic": ("the same, finite elements, elasticity", (*LUMP, *at(6000), *FE, "thermal.expansion=elastic")),
    "lump-6000-growth": ('the same, circuit, the paper\'s growth', (*LUMP, *at(6000), "thermal.expansion=paper")),
}
INSULATED = {
    "lump-6000": ("6000 rpm", (*LUMP, *at(6000))),
    "lump-12000": ("12 000 rpm", (*LUMP, *at(12000))),
    "lump-15200": ("15 200 rpm", (*LUMP, *at(15200))),
    "lump-6000-published": ("6000 rpm, R5 and raceways as published", (*PUBLISHED, *at(6000))),
    "lump-6000-paper": ("3000 rpm, R5 and raceways as published, the paper's growth", (*PUBLISHED, *at(3000), "thermal.expansion=paper")),
    "lump-12000-half": ("12 000 rpm, convection of the housing x 0.5", (*LUMP, *at(12000), "bearings.TB2.housing_length=25 mm")),
    "lump-12000-double": ("12 000 rpm, x 2", (*LUMP, *at(12000), "bearings.TB2.housing_length=100 mm")),
    "lump-12000-O": ("12 000 rpm, O", (*LUMP, *at(12000), "bearings.TB2.arrangement=O")),
    "lump-12000-oil": ("12 000 rpm, oil film of 0.1 um", (*LUMP, *at(12000), "thermal.oil_film=0.1 um")),
    "lump-12000-inertial": ("12 000 rpm, balls with inertia", (*LUMP, *at(12000), "bearings.TB2.ball_model=inertial")),
    "lump-12000-600": ("12 000 rpm, 600 N mounted", (*LUMP, *at(12000), "bearings.TB2.preload=600 N")),
    "lump-15200-spring": ("15 200 rpm, 290 N by a spring", (*LUMP, *at(15200), "statics.preload_by=spring")),
}
CRITICAL = {
    "critical": ("the case", ("preload.critical_values=true",)),
    "critical-lump": ("shaft a lump", ("preload.critical_values=true", *LUMP)),
    "critical-published": ("shaft, R5 and raceways as published", ("preload.critical_values=true", *PUBLISHED, *at(3000))),
}
TABLES = {"speeds": SPEEDS, "spread": SPREAD, "models": MODELS, "insulated": INSULATED, "critical": CRITICAL}


def run(program, name, settings, output):
    directory = output / name
    if not (directory / "preload.json").exists():
        words = [word for setting in (*QUICK, *settings) for word in ("--set", setting)]
        done = subprocess.run([program, "preload", CASE, "--bearing", "TB2", "-o", directory, "--quiet", "--force", *words], capture_output=True, text=True)
        if done.returncode:
            print(f"{name}: {done.stderr}", flush=True)
            return None
    return json.loads((directory / "preload.json").read_text())["bearings"]["TB2"]["running"]


def time_text(seconds):
    return f"{seconds:.1f} s" if seconds < 120 else f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def outcome(r):
    end = r["end"]
    if end["limit"] != "none":
        what = f"{'150 degC' if end['limit'] == 'temperature_limit' else '4.2 GPa'} after {time_text(end['time'])}"
        return what + (", though a stable state exists" if r["verdict"] == "runs-away-on-the-way" else "") if end["time"] > 0 else "beyond a limit when cold"
    return "settles" if r["verdict"] == "stable" else "settles (not confirmed by the criterion)" if end["settled"] else "not settled"


def line(words, r):
    if r is None:
        return f"| {words} | no result | | | | | |\n"
    end, stable = r["end"], [p for p in r["operating_points"] if p["stable"]]
    at = end.get("operating_point")
    point = r["operating_points"][at] if at is not None else stable[0] if stable else None
    highest = max(end["temperatures"].values()) - 273.15
    gain = f"{point['loop_gain']:.2f}" if point else "-"
    return (f"| {words} | {outcome(r)} | {r['cold']['preload']:.0f} | {end['largest_preload']:.0f} | {end['state']['preload']:.0f} | {end['state']['heat']:.0f} | {highest:.0f} | {gain} |\n")


HEAD = "| {} | outcome | preload cold [N] | largest [N] | at the end [N] | heat at the end [W] | hottest [degC] | loop gain |\n" + "|---" * 8 + "|\n"
FIRST = {"speeds": "speed", "spread": "changed at 15 200 rpm", "models": "model", "insulated": "shaft a lump"}


def table(kind, results):
    if kind != "critical":
        return HEAD.format(FIRST[kind]) + "".join(line(words, results[name]) for name, (words, _) in TABLES[kind].items() if name in results)
    text = "| circuit | at | speed | mounted preload | part of the cooling |\n" + "|---" * 5 + "|\n"
    for name, (words, _) in CRITICAL.items():
        r = results.get(name)
        if not r:
            continue

        def value(key, shown):
            c = r["critical"].get(key)
            return f"{shown(c['value'])} ({'loop' if c['by'] == 'loop gain' else 'limit'})" if c else "none within a factor of 64"

        rpm = 30 / math.pi
        text += (f"| {words} | {r['speed'] * rpm:.0f} rpm | {value('speed', lambda v: f'{v * rpm:.0f} rpm')} | {value('preload', lambda v: f'{v:.0f} N')} | "
                 f"{value('cooling', lambda v: f'{v:.3f}')} |\n")
    return text


def main():
    options = document_tables.options(__doc__, "out/preload-tables", TABLES, DOCUMENT)
    for kind in options.only:
        results = {name: run(options.program, name, settings, options.output) for name, (_, settings) in TABLES[kind].items()}
        text = table(kind, results)
        print(text, flush=True)
        if options.update:
            begin, end = f"<!-- {kind}: made by docs/preload_tables.py -->\n", f"<!-- end of {kind} -->\n"
            document_tables.put_between(DOCUMENT, begin, end, text)


if __name__ == "__main__":
    main()

"""Lumped circuit against finite elements, in the reference drop with each driver: what each sees, where the circuit can be trusted, and what calibration and reduction recover."""

import json
import os
import re

import h5py

from . import cases, figures, formulas, measures, runs

BOTH = {"thermal.models": ["lumped", "fe"]}
DRIVERS = {
    "lumped": ("circuit's growth drives", {"thermal.driver": "lumped"}),
    "fe": ("finite elements' growth drives", {"thermal.driver": "fe"}),
    "none": ("no growth fed back", {"thermal.driver": "none"}),
}
VARIANTS = {
    "windowed": ("all unknowns, windowed", {"thermal.driver": "fe", "thermal.fe.coupling": "windowed"}),
    "reduced-5": ("reduced within 5 %", {"thermal.driver": "fe", "thermal.fe.response_tolerance": 5e-2}),
    "fe": ("reduced within 0.5 % (reference)", {"thermal.driver": "fe"}),
    "reduced-02": ("reduced within 0.2 %", {"thermal.driver": "fe", "thermal.fe.response_tolerance": 2e-3}),
    "finer": ("reduced, cells halved", {"thermal.driver": "fe", "thermal.fe.refinement": 2}),
}
BODIES = ("shaft", "inner_ring", "ball", "outer_ring", "housing")
FITTED = re.compile(r"^(\w+): error of the circuit's responses, rms ([\d.]+) % -> ([\d.]+) %, largest ([\d.]+) % -> ([\d.]+) %", re.MULTILINE)


def is_available(program):
    return (program.parent / "rotordrop_fe.so").is_file() and (program.parent / "rotordrop_mesh.so").is_file()


def drop(cache, base, name, settings, keep_series=False, extra_key=""):
    """A drop with both models: measures, comparison, and the finite elements' part of the summary."""
    settings = {**BOTH, **settings}
    kept = runs.hash_of_files([measures.__file__, __file__]) + extra_key
    key = runs.key_of(cache.source, base, settings, kept, cache.root)

    def make(folder):
        (folder / "case.toml").write_text(cases.case_text(os.path.relpath(base, folder), settings))
        runs.check_call([cache.program, "run", folder / "case.toml", "-o", folder / "run", "--quiet"])
        result = measures.of_run(folder / "run")
        result["comparison"] = json.loads((folder / "run/comparison.json").read_text())
        if not keep_series:
            (folder / "run/results.h5").unlink()
        (folder / "run/comparison.h5").unlink()
        return result

    return cache.keep(key, f"models: {name}", make)


def calibrated(cache, base):
    """Parameter file with the circuits fitted to the finite elements, and the errors of the fit."""
    key = runs.key_of(cache.source, base, {"calibrate": "models"}, runs.hash_of_files([__file__]), cache.root)

    def make(folder):
        text = runs.check_call([cache.program, "calibrate", base, "-o", folder / "calibrated.toml"])
        found = FITTED.findall(text)
        if not found:
            raise runs.RunError("rotordrop calibrate printed no errors of the fit")
        return {name: dict(zip(("rms_before", "rms_after", "largest_before", "largest_after"), map(float, numbers))) for name, *numbers in found}

    folder, errors = cache.keep(key, "models: calibrate", make)
    return folder / "calibrated.toml", errors


def tasks(cache, base):
    def fitted():
        file, errors = calibrated(cache, base)
        folder, result = drop(cache, file, "calibrated", DRIVERS["lumped"][1])
        return folder, {**result, "fit": errors}

    entries = {name: settings for name, (_, settings) in {**DRIVERS, **VARIANTS}.items()}
    plain = {name: (lambda name=name, settings=settings: drop(cache, base, name, settings, keep_series=name == "lumped")) for name, settings in entries.items()}
    return {**plain, "calibrated": fitted}


def at_end(difference):
    return next(entry for entry in difference["at"] if entry["instant"] == "end")


def by_driver(results, bearing, pair):
    rows = []
    for name, (label, _) in DRIVERS.items():
        n, comparison = results[name]["bearings"][bearing], results[name]["comparison"]["bearings"][bearing]
        growth = n["expansion_end"]
        ring = at_end(comparison["temperatures"]["inner_ring"])
        row = {"driver": label, "peak_contact_force": n["peak_contact_force"], "first_impact_impulse": comparison["forces"]["first_impact_impulse"], "rub_heat": n["friction_heat"], "air_gap": n["clearance_end"],
               "inner_race_growth": growth["inner_race"], "ring_circuit": ring["lumped"], "ring_fe": ring["fe"], "most_loaded_ball": max(n["ball_force_end"]), "largest_ball_force": n["largest_ball_force"], "settled_force": n["contact_force_end"]["mean"]}
        if pair.preload > 0:
            row["preload"] = pair.preload_with(growth["inner_race"] - growth["outer_race"], growth["ball_radius"])
        rows.append(row)
    return rows


def trust(comparison):
    """Quantity by quantity: largest difference, from when beyond its tolerance, and whether it returns."""
    rows = []
    groups = [("mean temperature", comparison["temperatures"], "K"), ("growth", comparison["growth"], "m"), ("clearance", comparison["clearances"], "m")]
    for group, entries, unit in groups:
        for name, difference in entries.items():
            rows.append({"group": group, "what": name, "unit": unit, "one_lump_in_both": group == "mean temperature" and name in comparison["lumps_in_both"], **{k: difference[k] for k in ("tolerance", "largest_difference", "largest_difference_time", "beyond_from", "within_from")}})
    for name, surface in comparison["surfaces"].items():
        difference = surface["mean"]
        rows.append({"group": "surface, mean around", "what": name, "unit": "K", "one_lump_in_both": False, **{k: difference[k] for k in ("tolerance", "largest_difference", "largest_difference_time", "beyond_from", "within_from")}})
    return rows


def instants(comparison):
    rows = []
    for group, entries, unit in (("mean temperature", comparison["temperatures"], "K"), ("growth", comparison["growth"], "m"), ("clearance", comparison["clearances"], "m")):
        for name, difference in entries.items():
            rows.append({"group": group, "what": name, "unit": unit, "at": difference["at"]})
    return rows


def recovered(results):
    """What the reduced model keeps of the full one, and the calibrated circuit of the finite elements."""
    reduction, calibration = [], []
    full = results["windowed"]
    for name, (label, _) in VARIANTS.items():
        for bearing, n in results[name]["bearings"].items():
            fe, other = n["fe"]["temperature_rise_end"], full["bearings"][bearing]["fe"]["temperature_rise_end"]
            reduction.append({"model": label, "bearing": bearing, "unknowns": n["fe"].get("modes") or n["fe"]["unknowns"], "ring": fe["inner_ring"], "ring_difference": fe["inner_ring"] - other["inner_ring"],
                              "bore": n["fe"]["surface_rise"]["bore"]["mean_end"], "bore_highest": n["fe"]["surface_rise"]["bore"]["highest_mean"],
                              "growth_difference": n["expansion_end"]["inner_race"] - full["bearings"][bearing]["expansion_end"]["inner_race"], "cpu_time": results[name]["summary"]["run"]["cpu_time"]})
    for bearing in full["bearings"]:
        row = {"bearing": bearing, **results["calibrated"]["fit"][bearing]}
        for label, name in (("published", "lumped"), ("calibrated", "calibrated")):
            comparison = results[name]["comparison"]["bearings"][bearing]
            row[label] = {node: comparison["temperatures"][node]["largest_difference"] for node in BODIES}
            row[label]["air_gap"] = comparison["clearances"]["air_gap"]["largest_difference"]
        calibration.append(row)
    return reduction, calibration


def chapter(found):
    """`found`: {name: (folder, result)} of the tasks."""
    results = {name: result for name, (_, result) in found.items()}
    parameters = formulas.parameters_of(found["lumped"][0] / "run")
    main = results["lumped"]["comparison"]
    reduction, calibration = recovered(results)
    return {
        "by_driver": {name: by_driver(results, name, formulas.Bearing(parameters, name)) for name in main["bearings"]},
        "instants": {name: instants(comparison) for name, comparison in main["bearings"].items()},
        "trust": {name: trust(comparison) for name, comparison in main["bearings"].items()},
        "lumping": {name: {body: {k: numbers[k] for k in ("length", "biot", "evening_time")} for body, numbers in comparison["lumping"].items()} for name, comparison in main["bearings"].items()},
        "local": {name: {k: comparison["bore"][k] for k in ("largest_local_over_node", "wall_crossed_after")} for name, comparison in main["bearings"].items()},
        "in_short": main["in_short"],
        "verdict": main["verdict"],
        "reduction": reduction,
        "calibration": calibration,
    }


def draw(folder):
    """Mean temperatures and growth by both models."""
    plt = figures.plt
    pictures = {}
    with plt.rc_context(figures.STYLE), h5py.File(folder / "run/results.h5", "r") as file:
        time = file["/time"][:]
        for key, caption in (("temperatures", "Temperature rises above ambient: circuit's node, finite elements' mean over the same body, and the circumferential mean of the bore"), ("growth", "Growth by both models")):
            figure, axes = figures.panels(1, 2, height=3.0, sharey=True)
            for axis, bearing in zip(axes[0], ("TB1", "TB2")):
                if key == "temperatures":
                    for node, colour in (("inner_ring", figures.RED), ("shaft", figures.BLACK)):
                        for source, dashes, label in ((f"/thermal/{bearing}/{node}", "-", "circuit"), (f"/fe/{bearing}/{node}", "--", "finite elements")):
                            values = file[source][:]
                            axis.plot(time, values - values[0], color=colour, linestyle=dashes, label=f"{node.replace('_', ' ')}, {label}")
                    bore = file[f"/fe/{bearing}/bore"][:, 0]
                    axis.plot(time, bore - bore[0], color=figures.SKY, linewidth=0.7, label="bore, finite elements", zorder=1)
                else:
                    for column, (name, colour) in {0: ("shaft", figures.BLACK), 1: ("bore", figures.SKY), 2: ("inner race", figures.RED), 3: ("outer race", figures.BLUE)}.items():
                        for model, dashes in (("lumped", "-"), ("fe", "--")):
                            axis.plot(time, 1e6 * file[f"/growth/{model}/{bearing}"][:, column], color=colour, linestyle=dashes, label=f"{name}, {'circuit' if model == 'lumped' else 'finite elements'}")
                axis.set(title=bearing, xlabel="time [s]", xlim=(0, 0.3))
            axes[0][0].set_ylabel("rise [K]" if key == "temperatures" else "growth of the radius [µm]")
            if key == "growth":  # colours and dashes apart: eight entries would cover the curves
                lines = axes[0][0].get_lines()
                entries = [(line, line.get_label().split(",")[0]) for line in lines[::2]] + [(lines[0], "solid: circuit"), (lines[1], "dashed: finite elements")]
                axes[0][0].legend(*zip(*entries), loc="upper left", fontsize=7)
            else:
                axes[0][1].legend(loc="upper right", fontsize=7)
            pictures[key] = (caption, figures.picture(figure))
    return pictures

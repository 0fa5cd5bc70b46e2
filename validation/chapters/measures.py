"""Numbers of one run that statements are about, from summary.json and results.h5. SI; angles and signs as in docs/reference/results.md."""

import json

import h5py
import numpy as np

LATE = 50e-3  # s; "the end" of a run are its last 50 ms, as in summary.json
#: when the rotor swings in the ring without leaving it, as a part of the run it begins at. The paper does not say from when on it looked, and waves pass their resonances in this time.
SPANS = {"swinging": 1 / 2, "swinging_long": 1 / 3, "swinging_short": 2 / 3, "swinging_end": 5 / 6}
SHORTEST_FLIGHT = 1e-3  # s; shorter gaps between contacts are chatter, not bounces


def spans(mask):
    """First and last index of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], mask.astype(np.int8), [0]))))
    return list(zip(edges[::2], edges[1::2] - 1))


def bounces(time, y, penetration):
    """Highest y of each flight between two contacts [m], in order."""
    flights = spans(penetration <= 0)
    apexes = []
    for first, last in flights:
        before_first_contact, to_the_end = first == 0, last == len(time) - 1
        if not before_first_contact and not to_the_end and time[last] - time[first] > SHORTEST_FLIGHT:
            apexes.append(float(y[first:last + 1].max()))
    return apexes


def spread(values):
    return {"mean": float(np.mean(values)), "lowest": float(np.min(values)), "highest": float(np.max(values))}


def of_bearing(file, group, time, nodes):
    late = time >= time[-1] - LATE
    y, z = group["orbit"][:].T
    penetration, force = group["penetration"][:], group["contact_force"][:]
    touching = force > 0
    rub = group["rub_heat_rate"][:]
    resultant = np.hypot(*group["bearing_force"][:].T)
    load, drag, spin = group["load_torque"][:], group["drag_torque"][:], group["spin_torque"][:]
    contacts = spans(touching)
    after_first = np.arange(len(time)) > (contacts[0][1] if contacts else len(time))
    late_contact = late & touching
    swinging = time >= SPANS["swinging"] * time[-1]
    hardest = np.flatnonzero(swinging)[force[swinging].argmax()]
    return {
        "bounces": bounces(time, y, penetration),
        "deepest": float(-y.min()),
        "y_end": float(-y[late].mean()),
        "side": float(np.abs(z).max()),
        "side_in_contact": float(np.abs(z[touching]).max()) if touching.any() else 0.0,
        "z_end": spread(z[late]),
        "z_early_swing": float(np.ptp(z[time <= 0.1])),
        "z_late_swing": float(np.ptp(z[late])),
        "contact_force_end": spread(force[late]),
        "in_contact_end": float(late_contact.sum() / late.sum()),
        "bearing_force_end": spread(resultant[late]),
        **{f"{name}_force_{span}": spread(values[time >= begin * time[-1]]) for name, values in (("contact", force), ("bearing", resultant)) for span, begin in SPANS.items()},
        **{f"rub_rate_{span}": spread(rub[time >= begin * time[-1]]) for span, begin in SPANS.items()},
        "hardest_swing": {"time": float(time[hardest]), "ring_speed": float(group["ring_speed"][hardest])},
        # The two forces side by side: what the ring between them takes.
        "bearing_over_contact_swing": float(np.ptp(resultant[swinging]) / np.ptp(force[swinging])) if np.ptp(force[swinging]) > 0 else None,
        "load_torque_end": float(load[late].mean()),
        "drag_torque_end": float(drag[late].mean()),
        "friction_torque_end": float((load + drag)[late].mean()),
        "friction_torque_highest": float((load + drag)[after_first].max()) if after_first.any() else 0.0,
        "spin_torque_later": float(spin[after_first].max()) if after_first.any() else 0.0,
        "inner_heat_rate_end": spread(group["inner_heat_rate"][late]),
        "outer_heat_rate_end": spread(group["outer_heat_rate"][late]),
        "rub_in_flight": float(rub[~touching].max()) if (~touching).any() else 0.0,
        "rub_rate_last_third": float(rub[time >= 2 / 3 * time[-1]].mean()),
        "rub_rate_end": float(rub[late].mean()),
        "expansion_end": dict(zip(("shaft", "bore", "inner_race", "outer_race", "ball_radius"), map(float, group["expansion"][-1]))),
        "clearance_end": float(group["clearance"][-1]),
        "spin_lag_end": float(group["spin_lag"][-1]),
        "ball_force_end": [float(v) for v in np.atleast_2d(group["ball_force"][late].T).mean(axis=1)],
        "highest_rise": {n: float(file[f"{nodes}/{n}"][:].max() - file[f"{nodes}/{n}"][0]) for n in file[nodes]},
    }


def of_run(directory):
    """{"bearings": {NAME: measures and all of the summary's numbers}, "summary": the rest}."""
    summary = json.loads((directory / "summary.json").read_text())
    result = {"bearings": {}, "summary": {key: value for key, value in summary.items() if key != "bearings"}}
    with h5py.File(directory / "results.h5", "r") as file:
        time = file["/time"][:]
        for name, numbers in summary["bearings"].items():
            result["bearings"][name] = {**numbers, **of_bearing(file, file[f"/bearings/{name}"], time, f"/thermal/{name}")}
    return result

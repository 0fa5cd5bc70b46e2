"""Where the paper is contradicted: the argument, with our numbers."""

import math

from . import formulas

TABLE4 = ("ideal", "order1-1um", "order2-1um", "order3-1um", "order2-4um", "order3-2um")
PAPER_RISE = 8.0  # K, 4 um, second order
PAPER_BALL = 1.5  # K


def spin_up(measures, plan):
    """Rub heat of every wavy case against J omega^2/2 and the spin-up's own balance."""
    rows = []
    for condition in TABLE4:
        n = measures[condition]["bearings"]["TB2"]
        rows.append({"case": plan.conditions[condition]["says"], "rub_heat": n["friction_heat"], "slip_energy": n["spin_up"]["slip_energy"], "residual": n["spin_up"]["residual"], "ring_speed": n["ring_speed_end"],
                     "internal_heat": n["inner_heat"] + n["outer_heat"], "heat_rate_end": n["inner_heat_rate_end"]["mean"] + n["outer_heat_rate_end"]["mean"], "rise": n["temperature_rise_end"]["inner_ring"]})
    return rows


def force_row(plan, measures, name):
    """How the two forces swing from 0.15 s on, and at which frequency of the wave the contact force is highest."""
    n, order = measures[name]["bearings"]["TB2"], plan.conditions[name].get("waves", {}).get("order")
    hardest = n["hardest_swing"]
    return {"case": plan.conditions[name]["says"], "contact": n["contact_force_swinging"], "bearing": n["bearing_force_swinging"], "ratio": n["bearing_over_contact_swing"], "time": hardest["time"],
            "frequency": order * hardest["ring_speed"] / (2 * math.pi) if order else None}


def rub_row(plan, measures, name):
    """Rub heat rates of a case [W]: in the first impact, and while the rotor swings."""
    n = measures[name]["bearings"]["TB2"]
    return {"case": plan.conditions[name]["says"], "peak": n["peak_friction_heat_rate"], "highest": n["rub_rate_swinging"]["highest"], "mean": n["rub_rate_swinging"]["mean"], "late": n["rub_rate_swinging_end"]["highest"]}


def chapter(plan, measures, folders):
    parameters = formulas.parameters_of(folders["ideal"] / "run")
    pair = formulas.Bearing(parameters, "TB2")
    share = float(parameters["thermal"]["share_to_ring"])
    c = formulas.number(pair.ring["c"])
    rows = spin_up(measures, plan)
    ideal, wavy = rows[0], rows[4]
    spin_energy = 0.5 * pair.inertia * wavy["ring_speed"] ** 2
    capacity = pair.ring_mass * c
    needed = PAPER_RISE * capacity
    available = share * wavy["rub_heat"] + wavy["internal_heat"]
    n = measures["ideal"]["bearings"]["TB2"]
    balls = pair.rows * pair.Z * pair.ball_mass * formulas.number(pair.ball["c"])
    highest_ball = max(m["bearings"]["TB2"]["temperature_rise_end"]["ball"] for m in measures.values())
    internal = n["inner_heat"] + n["outer_heat"]
    printed = measures["ideal+letter-ball-speed"]["bearings"]["TB2"]
    internal_as_printed = printed["inner_heat"] + printed["outer_heat"]
    wettest = plan.conditions["order2-4um"]["says"]
    return {
        "spin_up": rows,
        "spin_energy": {"half_J_omega2": spin_energy, "inertia": pair.inertia, "speed": wavy["ring_speed"]},
        "ring": {"capacity": capacity, "paper_rise": PAPER_RISE, "heat_for_paper_rise": needed, "share": share, "heat_available": available, "all_heat": wavy["rub_heat"] + wavy["internal_heat"],
                 "rise_if_all_rub_heat_stayed": wavy["rub_heat"] / capacity, "largest_change_by_waves": max(abs(row["rise"] - ideal["rise"]) for row in rows), "case": wettest},
        "ball": {"capacity": balls, "paper_rise": PAPER_BALL, "heat_for_paper_rise": PAPER_BALL * balls, "internal_heat": internal, "rise_if_all_internal_heat_stayed": internal / balls, "rise": n["temperature_rise_end"]["ball"],
                 "internal_heat_as_printed": internal_as_printed, "rise_if_all_heat_as_printed_stayed": internal_as_printed / balls,
                 "highest_in_any_run": highest_ball},
        "third_after": measures["order3-1um"]["bearings"]["TB2"]["contact_force_swinging_end"],
        "rub_rates": [rub_row(plan, measures, name) for name in TABLE4],
        "forces": [force_row(plan, measures, name) for name in TABLE4],
        "sideways": {name: {"mean": measures["ideal"]["bearings"][name]["z_end"]["mean"], "lag": measures["ideal"]["bearings"][name]["spin_lag_end"]} for name in ("TB1", "TB2")},
    }

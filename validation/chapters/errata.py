"""What each misprint of the paper's equations and tables would do, computed: by a run where the program has a switch for it, otherwise from the formulas (chapters/formulas.py)."""

import math

from . import formulas

RUN, FORMULA = "run of the program", "computed from the formulas; the program has no such switch"


def entry(where, printed, right, how, effect, numbers, brief):
    """`brief`: the effect in one line, for the table in docs/theory/model.md, with its numbers from this run."""
    return {"where": where, "printed": printed, "right": right, "how": how, "effect": effect, "brief": brief, "numbers": [{"what": what, "value": value, "unit": unit} for what, value, unit in numbers]}


def shown(value, digits=2):
    """A number in a sentence."""
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e" in text and 1 <= abs(value) < 1e6 else text


def signed(relative):
    """A relative change in per cent."""
    return f"{100 * relative:+.2g} %"


#: what is printed otherwise, and moves no number here
WITHOUT_EFFECT = (
    {"where": "eq. 22", "printed": "right as printed, in N mm, cSt, rpm and mm", "right": "the same, converted in one place", "brief": ""},
    {"where": "table 3, diameters", "printed": "110 and 100 mm are outside diameters of the respective other bearing", "right": "catalogue diameters", "brief": ""},
    {"where": "text", "printed": "precision class \"PS4\"", "right": "P4S", "brief": ""},
)


def row_force(b, q, sign_of_first_tilt):
    """Generalised force of a row on its inner ring at q = (e_x, e_y, e_z, psi_y, psi_z), with the axial approach e_x psi_z cos b R - psi_y sin b R, or with the first tilt's sign as printed.

    Forces and moments by virtual work of the true kinematics, as any program would assemble them."""
    R = b.d_m / 2 + (b.f_in - 0.5) * b.d * math.cos(b.phi)
    total = [0.0] * 5
    offset = b.offset_of(b.preload)
    for j in range(b.Z):
        angle = 2 * math.pi * j / b.Z
        c, s = math.cos(angle), math.sin(angle)
        true = (1, 0, 0, s * R, -c * R)  # d e_t / d q: u = psi x r
        used = (1, 0, 0, sign_of_first_tilt * s * R, -c * R)
        e_r = q[1] * c + q[2] * s
        e_t = sum(u * v for u, v in zip(used, q))
        radial, axial = b.A * math.cos(b.phi) + e_r, b.A * math.sin(b.phi) + offset + e_t
        length = math.hypot(radial, axial)
        F = b.K_b * max(length - b.A, 0.0) ** 1.5
        for i, weight in enumerate((true[0] * axial, c * radial, s * radial, true[3] * axial, true[4] * axial)):
            total[i] -= F * weight / length
    return total


def asymmetry(b, sign):
    """Largest difference of the row's stiffness matrix from its transpose, over the largest entry, with tilts scaled by the arm; at a radial displacement of 5 um."""
    R = b.d_m / 2
    scale = (1, 1, 1, 1 / R, 1 / R)
    point, h = (0.0, 3e-6, 4e-6, 0.0, 0.0), 1e-8
    columns = []
    for i in range(5):
        ahead, behind = ([v + s * (h * scale[i] if k == i else 0) for k, v in enumerate(point)] for s in (1, -1))
        columns.append([(f - g) / (2 * h) * scale[k] for k, (f, g) in enumerate(zip(row_force(b, ahead, sign), row_force(b, behind, sign)))])
    largest = max(abs(v) for column in columns for v in column)
    return max(abs(columns[i][k] - columns[k][i]) for i in range(5) for k in range(5)) / largest


def spins(b, phi, omega_i, printed):
    k = formulas.kinematics(b, phi, phi, omega_i)
    theta, omega_b = k["theta"], k["omega_b"]
    if printed:
        omega_b = k["omega_co"] * (b.d_m + b.d * math.cos(phi)) / b.d
        return k["omega_ci"] * math.sin(phi) - omega_b * math.sin(phi - theta), k["omega_co"] * math.sin(phi) + omega_b * math.sin(phi - theta), omega_b
    return k["omega_ci"] * math.sin(phi) + omega_b * math.sin(phi - theta), k["omega_co"] * math.sin(phi) - omega_b * math.sin(phi - theta), omega_b


def of_impact(parameters, TB1, mass, speed):
    """Eq. 7 read as printed, and without clipping, against what Hunt and Crossley wrote: one body on one ring."""
    K, n, coefficient = TB1.contact_stiffness, 10 / 9, formulas.number(parameters["contact"]["lambda"].split(" ")[0])
    right = formulas.impact(K, lambda delta, rate: 1.5 * coefficient * K * delta**n * rate, mass, speed)
    first_touch = 1.5 * coefficient * K * speed**n * speed
    literal = formulas.impact(K, lambda delta, rate: 1.5 * coefficient * K * abs(rate) ** n * rate, mass, speed, clip=False)
    return right, literal, first_touch


def chapter(plan, measures, folders):
    """All errata with numbers. `folders`: of the runs that were kept, for their parameters."""
    parameters = formulas.parameters_of(folders["ideal"] / "run")
    b = {name: formulas.Bearing(parameters, name) for name in ("TB1", "TB2")}
    pair, reference = b["TB2"], measures["ideal"]["bearings"]
    contact = parameters["contact"]
    alpha = {name: formulas.number(bearing.ring["alpha"]) for name, bearing in b.items()}
    ambient = formulas.number(parameters["run"]["ambient"].split(" ")[0])
    half_mass = measures["ideal"]["summary"]["rotor"]["mass"] / 2
    fall_speed = math.sqrt(2 * 9.81 * formulas.number(contact["air_gap"]))
    omega = reference["TB1"]["ring_speed_end"]
    result = []

    printed, right = asymmetry(pair, -1), asymmetry(pair, 1)
    result.append(entry("eq. 2", "e_t = e_z - (psi_x sin b + psi_y cos b) R", "opposite signs of the two tilts (u = psi x r)", FORMULA,
                        "The stiffness matrix of a row is no longer symmetric: it would do work in a closed cycle of tilting. No effect in these runs, where inner rings do not tilt.",
                        [("asymmetry of a row's stiffness as printed, of its largest entry", printed, ""), ("as here", right, "")],
                        f"a row's stiffness matrix is unsymmetric by {shown(100 * printed)} % of its largest entry: work from nothing in a closed cycle of tilting"))

    ball_radius = pair.d / 2
    eps = formulas.number(pair.ball["alpha"]) * ball_radius * ambient
    result.append(entry("eqs. 5 and 25", "growth of the ball alpha r T with absolute T, added once to the approach", "alpha r (T - ambient), added twice (radius)", FORMULA,
                        "Balls at ambient temperature would already have grown, and preloaded the pair.",
                        [("growth of a cold ball's radius as printed", 1e6 * eps, "um"), ("preload of the pair", pair.preload, "N"), ("preload of the pair as printed, at ambient", pair.preload_with(0, eps / 2), "N")],
                        f"balls at ambient temperature grown by {shown(1e6 * eps)} um: the pair's {shown(pair.preload, 3)} N of preload become {shown(pair.preload_with(0, eps / 2) / 1e3)} kN"))

    right, literal, first_touch = of_impact(parameters, b["TB1"], half_mass, fall_speed)
    result.append(entry("eq. 7", "F = K delta^n + b (delta')^n (delta')^q; zero only where e_r <= c_r and F <= 0", "F = K delta^n (1 + 1.5 lambda delta'), zero where delta <= 0 or F <= 0", FORMULA,
                        "As printed the force jumps at first touch, and while the bodies part it pulls, unless clipped. Half the rotor's mass on TB1's contact, rigid and alone, at the speed of the fall.",
                        [("force at first touch as printed", first_touch, "N"), ("at first touch as here", 0.0, "N"), ("largest force as printed", literal[0], "N"), ("largest force as here", right[0], "N"), ("largest pull as printed", -literal[1], "N"),
                         ("speed after over before as printed", literal[2], ""), ("as here (closed form 1 - lambda v to first order: %.4f)" % (1 - 0.08 * fall_speed), right[2], "")],
                        f"a force of {shown(first_touch / 1e3)} kN at first touch instead of none, for half the rotor's mass alone on TB1's contact; without clipping it pulls with up to {shown(-literal[1] / 1e3)} kN"))

    for name in ("TB1", "TB2"):
        growth = reference[name]["expansion_end"]
        result.append(entry(f"eq. 8 ({name})", "delta = e_r - c_r + eps_in: a warm ring closes the gap", "it opens it: delta = e_r - (c_r + u_bore - u_shaft)", FORMULA + ", with the growth of the reference run",
                            "The gap would shrink where it widens.",
                            [("growth of the bore", 1e6 * growth["bore"], "um"), ("growth of the shaft", 1e6 * growth["shaft"], "um"), ("gap at the end as here", 1e6 * reference[name]["clearance_end"], "um"),
                             ("gap at the end as printed", 1e6 * (formulas.number(contact["air_gap"]) - growth["bore"]), "um")],
                            f"the gap at 0.3 s is {shown(1e6 * (reference[name]['clearance_end'] - formulas.number(contact['air_gap']) + growth['bore']))} um too small, of {shown(1e6 * formulas.number(contact['air_gap']), 3)} um"))

    load = reference["TB2"]["largest_ball_force"]
    delta = (load / pair.K_b) ** (2 / 3)
    result.append(entry("C_b", "C_b = (0.25 to 2.5)e-5 K_b, in N/m^1.5 s", "beta times the tangent stiffness, beta in seconds", FORMULA,
                        "Taken literally the damping has another unit and, in SI, another value.",
                        [("2.5e-5 K_b, read as N s/m", 2.5e-5 * pair.K_b, "N s/m"), ("2.5e-5 s times tangent stiffness at the largest ball load", 2.5e-5 * 1.5 * pair.K_b * math.sqrt(delta), "N s/m"),
                         ("literal over right", pair.K_b / (1.5 * pair.K_b * math.sqrt(delta)), "")],
                        f"{shown(1 / (1.5 * math.sqrt(delta)))} times the damping at the largest ball load"))

    standing, turning = (measures[name]["bearings"]["TB2"] for name in ("order2-4um+letter-waves-in-space", "order2-4um"))
    swing = {name: n["bearing_force_swinging"]["highest"] - n["bearing_force_swinging"]["lowest"] for name, n in (("turning", turning), ("standing", standing))}
    result.append(entry("eq. 12", "the inner race's wave in the same azimuth as the outer's: it would stand still", "it turns with the ring: m (b - theta_i)", RUN + ", second order, 4 um: the inner race's wave put on the standing race",
                        "The bore is wavy, too, and its waves turn in both runs.",
                        [("swing of the bearing force, waves turning", swing["turning"], "N"),
                         ("swing of the bearing force, race waves standing", swing["standing"], "N")],
                        f"the swing of the bearing force with 4 um of second order is {shown(swing['standing'] / 1e3, 3)} instead of {shown(swing['turning'] / 1e3, 3)} kN"))

    phi = pair.phi
    si, so, omega_b = spins(pair, phi, omega, False)
    si_p, so_p, omega_b_p = spins(pair, phi, omega, True)
    result.append(entry("eqs. 13 and 15", "omega_si = -omega_b sin(phi - theta) + ..., omega_so = +omega_b sin(phi - theta) + ...; omega_b without cos(phi - theta)", "the other signs, and the cosine", FORMULA + f", pair at {omega:.0f} rad/s, 25 degrees",
                        "Under outer-race control the ball must not spin outside, which eq. 14's angle assumes; as printed it would.",
                        [("omega_si as here", si, "rad/s"), ("omega_si as printed", si_p, "rad/s"), ("omega_so as here", so, "rad/s"), ("omega_so as printed", so_p, "rad/s"), ("omega_si + omega_so - omega_i sin phi as here", si + so - omega * math.sin(phi), "rad/s"),
                         ("omega_b as printed over as here", omega_b_p / omega_b, "")],
                        f"balls would spin at the outer race with {shown(so_p)} rad/s, against eq. 14's outer-race control; omega_si {shown(si_p)} instead of {shown(si)} rad/s"))

    printed = measures["ideal+letter-ball-speed"]["bearings"]["TB2"]
    heats = [n["inner_heat"] + n["outer_heat"] for n in (reference["TB2"], printed)]
    result.append(entry("eq. 24", "heat = sum of omega_b M", "M omega_i: the work that the ring loses", RUN + ' with internal_heat = "ball-speed"', "Heat would exceed the work done: energy from nothing.",
                        [("omega_b over omega_i, pair", omega_b / omega, ""), ("heat of both races until 0.3 s, TB2", heats[0], "J"), ("as printed", heats[1], "J"), ("balls' rise, TB2", reference["TB2"]["temperature_rise_end"]["ball"], "K"),
                         ("as printed", printed["temperature_rise_end"]["ball"], "K")], f"{shown(heats[1] / heats[0])} times the work done; balls of the pair {shown(printed['temperature_rise_end']['ball'])} instead of {shown(reference['TB2']['temperature_rise_end']['ball'])} K warmer at 0.3 s"))

    letter = measures["ideal+letter-equivalent-load"]["bearings"]["TB2"]
    result.append(entry("eq. 21", "P is the equivalent load of the bearing, without a formula", 'the radial resultant in the reference case; load_law = "equivalent" by choice', RUN + ' with load_law = "equivalent"', "The preload makes friction, too.",
                        [("load-dependent torque, mean of the last 50 ms, TB2, radial", reference["TB2"]["load_torque_end"], "N m"), ("equivalent", letter["load_torque_end"], "N m"), ("heat of both races until 0.3 s, TB2, radial", heats[0], "J"),
                         ("equivalent", letter["inner_heat"] + letter["outer_heat"], "J")], f"load torque of the pair at the end {shown(letter['load_torque_end'])} instead of {shown(reference['TB2']['load_torque_end'])} N m"))

    plane = measures["ideal+letter-plane-strain"]["bearings"]
    inner = pair.inner
    a, c = inner[0] / 2, inner[1] / 2
    result.append(entry("eqs. 26 and 27", "alpha (1 + nu) r/3 [...], without 1/(a + b)", "1/(a + b) restored; 1 + nu belongs to rings that cannot grow axially", RUN + " (1 + nu); the missing length from the formulas",
                        "As printed the growth has the unit of an area; in SI numbers it is another value. The factor 1 + nu acts on growth, and on temperatures only through the motion.",
                        [("growth of the inner race, TB2, as here", 1e6 * reference["TB2"]["expansion_end"]["inner_race"], "um"), ("with 1 + nu (run)", 1e6 * plane["TB2"]["expansion_end"]["inner_race"], "um"),
                         ("as printed, number in SI over the right one, without 1 + nu", a + c, ""), ("closed form of a ring 2.9 K warm throughout", 1e6 * formulas.annulus_growth(alpha["TB2"], a, c, 2.9, 2.9, c), "um"),
                         ("inner ring's rise, plane strain less free", plane["TB2"]["temperature_rise_end"]["inner_ring"] - reference["TB2"]["temperature_rise_end"]["inner_ring"], "K")],
                        f"a growth in m2, in SI numbers {shown(100 * (a + c))} % of the right one; 1 + nu alone adds {shown(100 * (plane['TB2']['expansion_end']['inner_race'] / reference['TB2']['expansion_end']['inner_race'] - 1))} %"))

    even = 50.0
    r_in, r_out = c, pair.outer[0] / 2
    growth_in, growth_out, growth_ball = (alpha["TB2"] * even * r for r in (r_in, r_out, pair.d / 2))
    evenly_warm = pair.preload_with(growth_in - growth_out, growth_ball)
    result.append(entry("eqs. 25 to 27, radial growth alone", "races grow by alpha r T at the radii of the rings' walls, radially only", "the contact points move along the contact normal, radially and axially (section 7 of the model): an evenly warm bearing of one material keeps its preload; the paper's by thermal.expansion = \"paper\"", "computed from the formulas, inner ring, outer ring and balls 50 K warmer",
                        "An evenly warm bearing would change its preload, and a run-away would be computed from that.",
                        [("preload of the pair, cold", pair.preload, "N"), ("evenly 50 K warmer, radial growth alone", evenly_warm, "N"), ("evenly 50 K warmer, by similarity (loads as squares of lengths times 1 + alpha T)", pair.preload * (1 + 2 * alpha["TB2"] * even), "N")],
                        f"under {shown(even)} K everywhere the pair's {shown(pair.preload, 3)} N become {shown(evenly_warm, 3)} N, where similarity has {shown(pair.preload * (1 + 2 * alpha['TB2'] * even), 4)} N"))

    growth = reference["TB2"]["expansion_end"]
    eps_t = growth["ball_radius"] + (growth["inner_race"] - growth["outer_race"]) / 2 * math.cos(phi)
    result.append(entry("eq. 28", "total interference, beside eqs. 3 to 5 that have the growth already", "not computed, as adding it would count growth twice", FORMULA, "Growth would be counted twice in the preload.",
                        [("eq. 28 at 0.3 s", 1e6 * eps_t, "um"), ("preload by the growth of 0.3 s, pair at rest", pair.preload_with(growth["inner_race"] - growth["outer_race"], growth["ball_radius"]), "N"),
                         ("with eq. 28 added once more", pair.preload_with(growth["inner_race"] - growth["outer_race"], growth["ball_radius"] + eps_t / 2), "N")],
                        f"counted twice, the pair's preload after 0.3 s is {shown(pair.preload_with(growth['inner_race'] - growth['outer_race'], growth['ball_radius'] + eps_t / 2), 3)} instead of {shown(pair.preload_with(growth['inner_race'] - growth['outer_race'], growth['ball_radius']), 3)} N"))

    static = measures["ideal+letter-static-friction"]["bearings"]
    result.append(entry("table 2", "static friction 0.05 below dynamic 0.1", "dynamic only; static at or above it is usual", RUN, "The static coefficient acts only near zero slip, so late in the spin-up.",
                        [("peak force, TB1, relative change", static["TB1"]["peak_contact_force"] / reference["TB1"]["peak_contact_force"] - 1, ""), ("rub heat, TB1, relative change", static["TB1"]["friction_heat"] / reference["TB1"]["friction_heat"] - 1, ""),
                         ("catch-up time, TB1, change", 1e3 * ((static["TB1"]["catch_up_time"] or math.nan) - (reference["TB1"]["catch_up_time"] or math.nan)), "ms")],
                        f"peak force of TB1 {signed(static['TB1']['peak_contact_force'] / reference['TB1']['peak_contact_force'] - 1)}, its rub heat {signed(static['TB1']['friction_heat'] / reference['TB1']['friction_heat'] - 1)}"))

    poisson, conductive = (measures[name]["bearings"] for name in ("ideal+letter-poisson", "ideal+conductivity"))
    result.append(entry("table 3, Poisson's ratios", "ceramic 0.30, steel 0.26", "exchanged: steel 0.30, ceramic 0.26", RUN, "Enters the balls' stiffness only.",
                        [("peak force, TB1, relative change", poisson["TB1"]["peak_contact_force"] / reference["TB1"]["peak_contact_force"] - 1, ""), ("peak force, TB2, relative change", poisson["TB2"]["peak_contact_force"] / reference["TB2"]["peak_contact_force"] - 1, "")],
                        f"peak forces {signed(poisson['TB1']['peak_contact_force'] / reference['TB1']['peak_contact_force'] - 1)} (TB1), {signed(poisson['TB2']['peak_contact_force'] / reference['TB2']['peak_contact_force'] - 1)} (TB2)"))
    result.append(entry("table 3, conductivity", "steel 70 W/(m K)", "42 to 46 for 100Cr6; the reference case keeps the paper's", RUN + " with 44", "Conduction out of the inner ring.",
                        [("inner ring's rise, TB2, at 70", reference["TB2"]["temperature_rise_end"]["inner_ring"], "K"), ("at 44", conductive["TB2"]["temperature_rise_end"]["inner_ring"], "K")],
                        f"inner ring of the pair {shown(reference['TB2']['temperature_rise_end']['inner_ring'], 3)} instead of {shown(conductive['TB2']['temperature_rise_end']['inner_ring'], 3)} K (at 44) warmer at 0.3 s"))

    spin = measures["ideal+letter-with-spin"]["bearings"]
    result.append(entry("eqs. 23 and 24", "spin moment's heat added to the friction torque's", "reported, added only by choice: the load term for angular contact contains it", RUN, "What the choice matters for heat and temperature.",
                        [("heat of both races until 0.3 s, TB2, without", reference["TB2"]["inner_heat"] + reference["TB2"]["outer_heat"], "J"), ("with", spin["TB2"]["inner_heat"] + spin["TB2"]["outer_heat"], "J"),
                         ("inner ring's rise, TB2, without", reference["TB2"]["temperature_rise_end"]["inner_ring"], "K"), ("with", spin["TB2"]["temperature_rise_end"]["inner_ring"], "K")],
                        f"{shown(spin['TB2']['inner_heat'] + spin['TB2']['outer_heat'], 3)} instead of {shown(heats[0], 3)} J in the pair until 0.3 s"))
    result += [known | {"how": "", "effect": "", "numbers": []} for known in WITHOUT_EFFECT]
    return result

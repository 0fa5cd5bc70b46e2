"""The paper's statements (paper-figures.toml) and what of our runs each is held against.

A quantity is a function of `run` and the bearing: run("order1-1um") are the measures of that condition with the variant in hand, None where there is no such run.
It returns a number (SI or as the claim's unit says), a bool, or None where it is not defined for the run."""

import dataclasses
import tomllib

from . import cases, verdicts
from . import measures as measuring

GAP = 250e-6
WAVY = {order: f"order{order}-1um" for order in (1, 2, 3)}
QUANTITIES = {}


def quantity(function):
    QUANTITIES[function.__name__] = function
    return function


SPANNED = set()  # quantities over a span of time that the paper leaves open


def spanned(function):
    SPANNED.add(function.__name__)
    return function


class Missing(Exception):
    """A run that a quantity needs does not exist for this variant."""


def of(run, condition, bearing):
    measures = run(condition)
    if measures is None:
        raise Missing(condition)
    return measures["bearings"][bearing]


def forces(run, condition, bearing, kind):
    """Mean, lowest and highest of the contact or bearing force over the span in hand."""
    return of(run, condition, bearing)[f"{kind}_force_{run.span}"]


def ratio(a, b):
    if not b:
        raise Missing("nothing to divide by")
    return a / b


def swing(numbers):
    return numbers["highest"] - numbers["lowest"]


# ---- Figure 9
FRICTION = ("friction-005", "ideal", "friction-015")


@quantity
def first_bounce_over_half_gap(run, bearing):
    """First bounce over half the gap with every friction coefficient"""
    apexes = [of(run, c, bearing)["first_bounce_apex"] for c in FRICTION]
    if None in apexes:
        raise Missing("first bounce")
    return min(apexes) + GAP > GAP / 2


@quantity
def second_bounce_apex_low_friction(run, bearing):
    """Highest y after the second contact, friction 0.05 [um]"""
    apexes = of(run, "friction-005", bearing)["bounces"]
    if len(apexes) < 2:
        raise Missing("second bounce")
    return 1e6 * apexes[1]


@quantity
def side_grows_with_friction(run, bearing):
    """Largest distance to the side while in contact grows from friction 0.05 over 0.10 to 0.15"""
    a, b, c = (of(run, condition, bearing)["side_in_contact"] for condition in FRICTION)
    return a < b < c


@quantity
def bounce_falls_with_friction(run, bearing):
    """Highest y after the second contact falls from friction 0.05 over 0.10 to 0.15"""
    apexes = [of(run, condition, bearing)["bounces"] for condition in FRICTION]
    if min(map(len, apexes)) < 2:
        raise Missing("second bounce")
    a, b, c = (each[1] for each in apexes)
    return a > b > c


# ---- Figure 10
@quantity
def first_hit_beyond_gap(run, bearing):
    """Largest downward displacement beyond 250 um"""
    return of(run, "ideal", bearing)["deepest"] > GAP


@quantity
def bounces_decay(run, bearing):
    """No later bounce is as high as the first, and there is none in the last 50 ms"""
    numbers = of(run, "ideal", bearing)
    apexes = numbers["bounces"]
    return all(apex < apexes[0] for apex in apexes[1:]) and numbers["in_contact_end"] == 1


@quantity
def end_beyond_gap(run, bearing):
    """Mean downward displacement of the last 50 ms, between 250 and 280 um"""
    return GAP < of(run, "ideal", bearing)["y_end"] < 1.12 * GAP


@quantity
def side_over_gap(run, bearing):
    """Largest displacement to the side over the gap, at most 0.9"""
    return of(run, "ideal", bearing)["side"] / GAP <= 0.9


@quantity
def side_swing_decays(run, bearing):
    """Swing to the side in the last 50 ms below half of that in the first 100 ms"""
    numbers = of(run, "ideal", bearing)
    return numbers["z_late_swing"] < 0.5 * numbers["z_early_swing"]


@quantity
def side_returns_to_zero(run, bearing):
    """Mean displacement to the side in the last 50 ms below 10 um"""
    return abs(of(run, "ideal", bearing)["z_end"]["mean"]) < 10e-6


# ---- Figure 11
@quantity
def catch_up_time(run, bearing):
    """When the bore's surface is first within 1 % of the rotor's [s]; 0.3 s and longer where it is not"""
    time = of(run, "ideal", bearing)["catch_up_time"]
    return 0.3 if time is None else time


@quantity
def TB1_faster(run, bearing):
    """The deep-groove bearing is ahead of the pair at the end, or catches up earlier"""
    one, two = (of(run, "ideal", name) for name in ("TB1", "TB2"))
    if one["catch_up_time"] and two["catch_up_time"]:
        return one["catch_up_time"] < two["catch_up_time"]
    return bool(one["catch_up_time"]) or (not two["catch_up_time"] and one["ring_speed_end"] > two["ring_speed_end"])


# ---- Figures 12 and 13
@quantity
def first_peak(run, bearing):
    """Largest contact force [N]"""
    return of(run, "ideal", bearing)["peak_contact_force"]


@quantity
def settled_force(run, bearing):
    """Mean contact force of the last 50 ms [N]"""
    return of(run, "ideal", bearing)["contact_force_end"]["mean"]


@spanned
@quantity
def order3_lowest_force(run, bearing):
    """Lowest contact force from 0.15 s on, third order, 1 um [N]"""
    return forces(run, WAVY[3], bearing, "contact")["lowest"]


@spanned
@quantity
def order3_highest_force(run, bearing):
    """Highest contact force from 0.15 s on, third order, 1 um [N]"""
    return forces(run, WAVY[3], bearing, "contact")["highest"]


@spanned
@quantity
def order3_swings_most(run, bearing):
    """Swing of the contact force from 0.15 s on largest for the third order"""
    swings = {order: swing(forces(run, name, bearing, "contact")) for order, name in WAVY.items()}
    return swings[3] > max(swings[1], swings[2])


@quantity
def waves_keep_contact_times(run, bearing):
    """Time of the second contact with 1 um waves within 2 ms of that without"""
    ideal = of(run, "ideal", bearing)["second_contact_time"]
    times = [of(run, name, bearing)["second_contact_time"] for name in WAVY.values()]
    if ideal is None or None in times:
        raise Missing("second contact")
    return all(abs(time - ideal) < 2e-3 for time in times)


@quantity
def order3_bearing_smooth(run, bearing):
    """Third order: the bearing force swings less than a quarter of what the contact force swings"""
    return of(run, WAVY[3], bearing)["bearing_over_contact_swing"] < 0.25


@spanned
@quantity
def orders12_bearing_vary(run, bearing):
    """Orders 1 and 2: the bearing force swings by more than half of its mean from 0.15 s on"""
    return all(swing(n) > 0.5 * n["mean"] for n in (forces(run, WAVY[o], bearing, "bearing") for o in (1, 2)))


@spanned
@quantity
def ideal_bearing_smooth(run, bearing):
    """Ideal surface: the bearing force swings less than half as much as with orders 1 and 2, from 0.15 s on"""
    return swing(forces(run, "ideal", bearing, "bearing")) < 0.5 * min(swing(forces(run, WAVY[o], bearing, "bearing")) for o in (1, 2))


@spanned
@quantity
def order3_bearing_least(run, bearing):
    """Third order: the bearing force swings less than with orders 1 and 2, from 0.15 s on"""
    return swing(forces(run, WAVY[3], bearing, "bearing")) < min(swing(forces(run, WAVY[o], bearing, "bearing")) for o in (1, 2))


# ---- Figures 14 and 15
@quantity
def load_torque_peak(run, bearing):
    """Largest load-dependent friction torque [N m]"""
    return of(run, "ideal", bearing)["load_torque_peak"]


@quantity
def drag_above_load(run, bearing):
    """At the end the velocity-dependent part is above the load-dependent part"""
    n = of(run, "ideal", bearing)
    return n["drag_torque_end"] > n["load_torque_end"]


@quantity
def waves_leave_friction_torque(run, bearing):
    """Mean friction torque of the last 50 ms with 1 um waves within 5 % of that without"""
    ideal = of(run, "ideal", bearing)["friction_torque_end"]
    return all(abs(ratio(of(run, name, bearing)["friction_torque_end"], ideal) - 1) < 0.05 for name in WAVY.values())


@quantity
def spin_torque_highest_first(run, bearing):
    """Spin torque of the most loaded ball after the first contact below that in it"""
    n = of(run, "ideal", bearing)
    return n["spin_torque_later"] < n["spin_torque_peak"]


# ---- Figure 16
@quantity
def outer_heat_rate(run, bearing):
    """Mean heat at the outer race in the last 50 ms [W]"""
    return of(run, "ideal", bearing)["outer_heat_rate_end"]["mean"]


@quantity
def inner_heat_rate(run, bearing):
    """Mean heat at the inner race in the last 50 ms [W]"""
    return of(run, "ideal", bearing)["inner_heat_rate_end"]["mean"]


@quantity
def outer_over_inner(run, bearing):
    """Heat of the outer over heat of the inner race, last 50 ms"""
    return ratio(outer_heat_rate(run, bearing), inner_heat_rate(run, bearing))


def increments(order):
    def increment(run, bearing):
        heat = [sum(of(run, c, bearing)[f"{race}_heat_rate_max"] for race in ("inner", "outer")) for c in (WAVY[order], "ideal")]
        return 100 * (ratio(*heat) - 1)

    increment.__name__ = f"heat_increment_max_order{order}"
    increment.__doc__ = f"Largest heat of both races with waves of order {order}, 1 um, above that without [%]"
    return quantity(increment)


for _order in (1, 2, 3):
    increments(_order)


@quantity
def waves_heat_more(run, bearing):
    """Largest heat of both races above that of the ideal surface for all three orders"""
    return all(QUANTITIES[f"heat_increment_max_order{order}"](run, bearing) > 0 for order in (1, 2, 3))


# ---- Figure 17
@quantity
def rub_peak(run, bearing):
    """Largest friction heat between rotor and ring [W]"""
    return of(run, "ideal", bearing)["peak_friction_heat_rate"]


@quantity
def no_rub_in_flight(run, bearing):
    """Friction heat between rotor and ring zero while they do not touch"""
    return of(run, "ideal", bearing)["rub_in_flight"] == 0


@quantity
def no_rub_after_200_ms(run, bearing):
    """Mean friction heat from 0.2 to 0.3 s below 1 % of the run's mean"""
    n, summary = of(run, "ideal", bearing), run("ideal")["summary"]
    return n["rub_rate_last_third"] < 0.01 * n["friction_heat"] / summary["run"]["end_time"]


def rub_rates(run, bearing, what):
    """Highest or mean rub heat rate of the ideal surface and of the three orders with 1 um, over the span in hand [W]."""
    return [of(run, name, bearing)[f"rub_rate_{run.span}"][what] for name in ("ideal", *WAVY.values())]


@spanned
@quantity
def waves_raise_rub_rate(run, bearing):
    """Highest rub heat rate from 0.15 s on with 1 um waves above that without, for each of the three orders"""
    ideal, *wavy = rub_rates(run, bearing, "highest")
    return min(wavy) > ideal


@spanned
@quantity
def waves_raise_mean_rub_rate(run, bearing):
    """Mean rub heat rate from 0.15 s on with 1 um waves above that without, for each of the three orders"""
    ideal, *wavy = rub_rates(run, bearing, "mean")
    return min(wavy) > ideal


@quantity
def waves_raise_rub_peak(run, bearing):
    """Largest rub heat rate (first impact) with 1 um waves above that without, for each of the three orders"""
    ideal, *wavy = (of(run, name, bearing)["peak_friction_heat_rate"] for name in ("ideal", *WAVY.values()))
    return min(wavy) > ideal


# ---- Figures 18 and 19
def rises(node):
    def rise(run, bearing):
        return of(run, "ideal", bearing)["temperature_rise_end"][node]

    rise.__name__, rise.__doc__ = f"rise_{node}", f"Rise of {node.replace('_', ' ')} at 0.3 s [K]"
    return quantity(rise)


for _node in ("inner_ring", "ball", "outer_ring"):
    rises(_node)


@quantity
def shaft_over_ring(run, bearing):
    """Rise of the shaft over the inner ring's at 0.3 s"""
    n = of(run, "ideal", bearing)["temperature_rise_end"]
    return ratio(n["shaft"], n["inner_ring"])


@quantity
def contact_slightly_above_ring(run, bearing):
    """Inner contact warmer than the inner ring, by less than a quarter of the ring's rise"""
    n = of(run, "ideal", bearing)["temperature_rise_end"]
    return 0 < n["inner_contact"] - n["inner_ring"] < 0.25 * n["inner_ring"]


@quantity
def housing_cold(run, bearing):
    """Rise of the housing at 0.3 s below 0.1 K"""
    return of(run, "ideal", bearing)["temperature_rise_end"]["housing"] < 0.1


@quantity
def extra_rise_1um(run, bearing):
    """Largest rise of the inner ring with 1 um waves of any order, above the ideal surface's [K]"""
    ideal = of(run, "ideal", bearing)["temperature_rise_end"]["inner_ring"]
    return max(of(run, name, bearing)["temperature_rise_end"]["inner_ring"] for name in WAVY.values()) - ideal


@quantity
def rise_4um(run, bearing):
    """Rise of the inner ring at 0.3 s, second order, 4 um [K]"""
    return of(run, "order2-4um", bearing)["temperature_rise_end"]["inner_ring"]


@quantity
def order1_warmest(run, bearing):
    """With 1 um waves of the first order the inner ring is at least 0.05 K warmer than with those of the second and third"""
    one, two, three = (of(run, WAVY[o], bearing)["temperature_rise_end"]["inner_ring"] for o in (1, 2, 3))
    return one > max(two, three) + 0.05


# ---- Text
def rotor(run):
    measures = run("ideal")
    if measures is None:
        raise Missing("ideal")
    return measures["summary"]["rotor"]


@quantity
def first_frequency(run, bearing):
    """Lowest free-free bending frequency [Hz]"""
    return rotor(run)["free_free_frequencies"][0]


@quantity
def mass(run, bearing):
    """Mass of the rotor [kg]"""
    return rotor(run)["mass"]


@quantity
def polar_inertia(run, bearing):
    """Polar moment of inertia [kg m2]"""
    return rotor(run)["polar_inertia"]


@quantity
def diametral_inertia(run, bearing):
    """Diametral moment of inertia [kg m2]"""
    return rotor(run)["diametral_inertia"]


# ---- Statements
@dataclasses.dataclass(frozen=True)
class Claim:
    id: str
    says: str
    quantity: str
    bearing: str  # the one that the paper means; "either" where it does not say: the pair, and the other bearing as one more unknown
    why: str  # this width, or this bound
    kind: str = "holds"
    paper: float = None
    unit: str = ""
    width: float = None
    fitted: tuple = ()
    bound: str = None  # "above" or "below": the paper bounds the number, without a band
    at: float = None  # where the paper's number stands along the figure's axis [s]; None where that is not said
    by_construction: bool = False  # the reference case was made to have this number
    hindsight: str = ""  # what of this band, bound or span was chosen or changed after our numbers were seen


@dataclasses.dataclass(frozen=True)
class Statement:
    figure: str
    says: str
    earlier_opinion: str
    claims: tuple

    @property
    def id(self):
        return f"figure {self.figure}" if self.figure != "text" else "text"


def read(path):
    """Statements of a file; faults name the claim."""
    result = []
    for table in tomllib.loads(path.read_text())["statement"]:
        claims = []
        for entry in table["claim"]:
            entry = {**entry, "fitted": tuple(entry.get("fitted", ()))}
            claim = Claim(**entry, kind="bound" if "bound" in entry else "value" if "paper" in entry else "holds")
            if claim.quantity not in QUANTITIES:
                raise ValueError(f"{path}: claim {claim.id}: there is no quantity {claim.quantity!r}")
            if claim.bearing not in ("TB1", "TB2", "either", "none"):
                raise ValueError(f"{path}: claim {claim.id}: bearing {claim.bearing!r} is none of TB1, TB2, either, none")
            if (claim.kind == "value") != (claim.width is not None):
                raise ValueError(f"{path}: claim {claim.id}: a number has a width, and only a number without a bound")
            if claim.kind == "bound" and (claim.bound not in verdicts.BOUNDS or claim.paper is None):
                raise ValueError(f"{path}: claim {claim.id}: a bound is one of {', '.join(verdicts.BOUNDS)}, of a number `paper`")
            claims.append(claim)
        result.append(Statement(table["figure"], table["says"], table["earlier_opinion"], tuple(claims)))
    return result


#: conditions that the statement of a figure is about; the others need all of table 4
CONDITIONS = {"9": FRICTION, "10": ("ideal",), "11": ("ideal",), "15": ("ideal",), "18": ("ideal",), "text": ("ideal",)}


def conditions_of(statement):
    return CONDITIONS.get(statement.figure, ("ideal", *WAVY.values(), "order2-4um", "order3-2um"))


OTHER_BEARING = "which bearing is meant"
OTHER_SPAN = "which span of time is meant"


def judge(claim, plan, measures):
    """Our number, its spread by unknown, and the verdict. `measures`: by name of the run."""
    function = QUANTITIES[claim.quantity]
    bearing = "TB2" if claim.bearing in ("either", "none") else claim.bearing

    def value_of(variant, name, span="swinging"):
        used = set()

        def run(condition):
            used.add(plan.of_condition(condition, variant))
            return measures.get(plan.of_condition(condition, variant))

        run.span = span
        try:
            value = function(run, name)
        except Missing:
            return None
        # A variant of the waves leaves what has no waves as it is: no run of its own.
        unchanged = variant != cases.REFERENCE and not any(plan.cases[n].variant == variant for n in used)
        return None if unchanged else value

    reference = value_of(cases.REFERENCE, bearing)
    if reference is None:
        return {"verdict": verdicts.NOT_DECIDABLE, "reason": "the reference run does not have it", "ours": None, "runs": [], "rule": claim.kind}
    runs = [(variant, plan.variants[variant]["unknown"], bearing, value_of(variant, bearing)) for variant in plan.variants]
    fitted = claim.fitted
    if claim.bearing == "either":
        runs.append((cases.REFERENCE, OTHER_BEARING, "TB1", value_of(cases.REFERENCE, "TB1")))
        runs += [(variant, f"{plan.variants[variant]['unknown']}, {OTHER_BEARING}", "TB1", value_of(variant, "TB1")) for variant in plan.variants]
        fitted += tuple(f"{unknown}, {OTHER_BEARING}" for unknown in fitted)
    if claim.quantity in SPANNED:
        runs += [(cases.REFERENCE, OTHER_SPAN, bearing, value_of(cases.REFERENCE, bearing, span)) for span in measuring.SPANS if span != "swinging"]
    runs = [{"variant": variant, "unknown": unknown, "bearing": name, "ours": value} for variant, unknown, name, value in runs if value is not None]
    pairs = [(run["unknown"], run["ours"]) for run in runs]
    result = {"ours": reference, "runs": runs, "rule": claim.kind}
    if claim.kind in ("value", "bound"):
        verdict = verdicts.of_value(claim.paper, reference, pairs, claim.width, fitted) if claim.kind == "value" else verdicts.of_bound(claim.paper, claim.bound, reference, pairs, fitted)
        values = [reference, *(value for _, value in pairs)]
        result |= {"lowest": min(values), "highest": max(values), "difference": reference - claim.paper, "relative_difference": reference / claim.paper - 1}
        by_unknown = {}
        for unknown, value in pairs:
            by_unknown.setdefault(unknown, []).append(value)
        result["by_unknown"] = {unknown: [min([reference, *found]), max([reference, *found])] for unknown, found in by_unknown.items()}
    else:
        verdict = verdicts.of_claim(bool(reference), [(unknown, bool(value)) for unknown, value in pairs], fitted)
    if claim.by_construction:
        verdict = verdicts.Verdict(verdicts.NOT_DECIDABLE, f"the reference case was made to have it, so that meeting it proves nothing ({verdict.reason})")
    return result | {"verdict": verdict.verdict, "reason": verdict.reason}

"""The rules by which numbers become verdicts. They see nothing but the paper's number, bound or claim and this program's."""

import dataclasses

REPRODUCED, IN_TREND, NOT_DECIDABLE, CONTRADICTED = "reproduced", "reproduced in trend", "not decidable", "contradicted"
#: in the order in which a figure's counts name them; a figure has counts and no verdict of its own
VERDICTS = (REPRODUCED, IN_TREND, NOT_DECIDABLE, CONTRADICTED)
MAGNITUDE = 1.5  # a number within this factor is of the paper's magnitude
MOST = 2 / 3  # of the runs

BOUNDS = {"above": lambda value, bound: value > bound, "below": lambda value, bound: value < bound}

RULES = {
    "value": f"""A number. The band is the paper's value and the claim's width on either side. The spread is lowest to highest over the reference and all runs in which one unknown is changed.
<ol><li><b>{REPRODUCED}</b>: the reference lies in the band, and no unknown moves our number out of a factor {MAGNITUDE} of the paper's;</li>
<li><b>{NOT_DECIDABLE}</b>: the spread reaches the band, or crosses it, but the first rule does not hold: what the paper does not say decides. Also, whenever the number was used to fit a parameter of the reference case and the spread
over that parameter is what reaches the band: to meet it proves nothing; likewise what the reference case was made to have. And where the band reaches zero, as that of a last digit;</li>
<li><b>{IN_TREND}</b>: the spread does not reach the band, but the reference is within a factor {MAGNITUDE} of the paper's;</li>
<li><b>{CONTRADICTED}</b>: neither the reference nor any run comes within a factor {MAGNITUDE}; where only a run with an unknown changed does, <b>{NOT_DECIDABLE}</b>.</li></ol>""",
    "holds": f"""A claim that a run meets or does not (an order, a sign, a bound with its number in the claim).
<ol><li><b>{REPRODUCED}</b>: it holds in the reference and in every run with an unknown changed;</li>
<li><b>{IN_TREND}</b>: it holds in the reference and in at least two thirds of these runs;</li>
<li><b>{CONTRADICTED}</b>: it fails in the reference and in every run;</li>
<li><b>{NOT_DECIDABLE}</b>: otherwise; also where it holds in the reference only thanks to a parameter that was fitted to this figure, because it fails in a run with another value of that parameter.</li></ol>""",
    "bound": f"""A number that the paper bounds ("exceeds 5000 N"). Each run is above the bound or not, however near; then the rules of a claim that holds or fails apply: <b>{REPRODUCED}</b>, <b>{IN_TREND}</b>, <b>{NOT_DECIDABLE}</b>,
<b>{CONTRADICTED}</b>.""",
}


@dataclasses.dataclass(frozen=True)
class Verdict:
    verdict: str
    reason: str


def counts(verdicts):
    """{verdict: how many}, without zeros, in the order of VERDICTS: what is said of a figure. One claim of six that fails does not contradict the other five."""
    return {verdict: verdicts.count(verdict) for verdict in VERDICTS if verdict in verdicts}


def unknowns_that(runs, test):
    return ", ".join(sorted({unknown for unknown, value in runs if test(value)}))


def of_value(paper, reference, runs, width, fitted=()):
    """Verdict on a number. `runs`: (unknown, value) of every run with one unknown changed; `width`: of the band, a part of the paper's value; `fitted`: unknowns that this number was used to fit."""
    low, high = sorted((paper * (1 - width), paper * (1 + width)))

    def in_band(value):
        return low <= value <= high

    def is_near(value):
        return in_band(value) or 1 / MAGNITUDE <= value / paper <= MAGNITUDE

    if width >= 1:
        return Verdict(NOT_DECIDABLE, "the band reaches zero: the paper's number is not known well enough to be met or missed")
    values = [reference, *(value for _, value in runs)]
    least, most = min(values), max(values)
    reaches = least <= high and most >= low
    if in_band(reference):
        away = unknowns_that(runs, lambda v: not is_near(v))
        moved_by_fit = any(unknown in fitted and not in_band(value) for unknown, value in runs)
        if fitted and moved_by_fit:
            return Verdict(NOT_DECIDABLE, f"met, but {fitted[0]} was fitted to it, and other values leave the band")
        if away:
            return Verdict(NOT_DECIDABLE, f"met by the reference, but {away} moves it out of a factor {MAGNITUDE}")
        return Verdict(REPRODUCED, "in the band, and near it for all values of the unknowns")
    if reaches:
        reached_by = unknowns_that(runs, in_band) or "several unknowns (the band lies between their runs)"
        return Verdict(NOT_DECIDABLE, f"the reference is outside the band, but the spread reaches it by: {reached_by}")
    if is_near(reference):
        return Verdict(IN_TREND, f"outside the band for all unknowns, but within a factor {MAGNITUDE}")
    if any(is_near(value) for _, value in runs):
        return Verdict(NOT_DECIDABLE, f"no run reaches the band, and the reference is not within a factor {MAGNITUDE}, but a run is: {unknowns_that(runs, is_near)}")
    return Verdict(CONTRADICTED, f"no run comes near: reference {reference / paper:.2g} times the paper's value")


def of_bound(paper, sense, reference, runs, fitted=()):
    """Verdict on a bound, sense "above" or "below" of the paper's number. `runs`: (unknown, value)."""
    def holds(value):
        return BOUNDS[sense](value, paper)

    return of_claim(holds(reference), [(unknown, holds(value)) for unknown, value in runs], fitted)


def of_claim(reference, runs, fitted=()):
    """Verdict on what holds or does not. `runs`: (unknown, bool) of every run with one unknown changed."""
    share = sum(holds for _, holds in runs) / len(runs) if runs else float(reference)
    count = f"holds in {sum(holds for _, holds in runs)} of {len(runs)} runs with an unknown changed"
    if reference:
        if any(unknown in fitted and not holds for unknown, holds in runs):
            return Verdict(NOT_DECIDABLE, f"holds in the reference, but not with another {fitted[0]}, which was fitted to this figure; {count}")
        if share == 1:
            return Verdict(REPRODUCED, "holds in every run")
        fails = unknowns_that(runs, lambda holds: not holds)
        return Verdict(IN_TREND if share >= MOST else NOT_DECIDABLE, f"{count}; fails with: {fails}")
    if share == 0:
        return Verdict(CONTRADICTED, "fails in every run")
    return Verdict(NOT_DECIDABLE, f"fails in the reference; {count}: with {unknowns_that(runs, bool)}")

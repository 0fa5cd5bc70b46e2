"""Thermal models of a drop beside each other, and one drop beside another."""

from __future__ import annotations

import typing
from collections.abc import Sequence

from . import _core
from .errors import refused, require, warn
from .result import Result
from .units import each_si, positive_si


def compare(
    drop: Result,
    against: Result | None = None,
    *,
    tolerance: str = "",
    floor: str = "",
    growth_tolerance: str = "",
    band_length: str = "",
    instants: Sequence[float | str] | float | str | None = None,
) -> dict[str, typing.Any]:
    """For how long the thermal models of a drop agree, as comparison.json has it (docs/how-to/compare.md).

    against            another drop; if `drop` has one thermal model only, the other one is taken from there
    tolerance          of temperatures: "5 %" of the rise (default) or "0.5 K"
    floor              smallest tolerance that is a part of the rise, default "10 mK"
    growth_tolerance   of growths and clearances, default "0.1 um"
    band_length        of the rub along the surface, instead of the case's
    instants           reported beside the first impact's peak and the end [s], default 10 ms. CaseWarning for those beyond the end

    "in_short" and "verdict" are sentences. InputError if there is nothing to compare, such as series that were not kept.
    """
    bounds = (
        _bound(tolerance, "tolerance", "'5 %' of the rise or '0.5 K'"),
        _bound(floor, "floor", "'10 mK'"),
        _bound(growth_tolerance, "growth_tolerance", "'0.1 um'"),
        _bound(band_length, "band_length", "'5 mm'"),
    )
    for name, one in (("drop", drop), ("against", against)):
        if name == "drop" or one is not None:
            require(name, one, Result, "a Result, such as rd.read(directory)")
    times = None if instants is None else [positive_si(one, "s", "instants") for one in each_si(instants, "s", "instants")]
    end = min(one.recorded.values("/time", False)[-1] for one in (drop, against) if one is not None)
    for time in times or ():
        if time > end:
            warn(f"instants: {time:g} s lies beyond the end at {end:g} s and is left out")
    return _core.compare(drop.recorded, None if against is None else against.recorded, *bounds, times)


def _bound(given: str, name: str, allowed: str) -> str:
    """A text, as given: a bare number could be a part, per cent or SI, also within a text."""
    if not isinstance(given, str):
        raise refused(name, f"must be a text with its unit, such as {allowed}, and is {given!r}")
    try:
        float(given)
    except ValueError:
        return given
    raise refused(name, f"must have its unit, such as {allowed}, and is {given!r}")

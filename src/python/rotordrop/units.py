"""Quantities with units, and the files that come with the program."""

from __future__ import annotations

import math
import numbers
import pathlib
import typing
from collections.abc import Iterable

from . import _core
from .errors import InputError, refused


def si(quantity: float | str, unit: str, name: str = "quantity") -> float:
    """A quantity as a number in a unit, most often of SI: `si("15200 rpm", "rad/s")` is 1591.74. A number, and a text without a unit, is in that unit already.

    unit    "m", "N", "rad/s", "K" ..., or another one, such as "mm": `si("5 m", "mm")` is 5000, `si(5, "mm")` is 5; what is given must have its dimension
    name    how an InputError calls it: one is raised for another dimension, for a unit that is not known or counts from another zero than 0 K (as degC does),
            and for what is not a finite number
    """
    if not _core.is_unit(unit):
        raise refused(name, f"the unit {unit!r} is not known; units are written as in 'N m', 'W/(m K)' or 'kg/m3'")
    if _counts_from_another_zero(unit):
        raise refused(name, f"the unit {unit!r} counts from another zero than 0 K: take 'K' and subtract, such as si('20 degC', 'K') - 273.15")
    value = _core.to_si(quantity, unit, name) if isinstance(quantity, str) else float(quantity)
    if not math.isfinite(value):
        raise refused(name, f"{value} is not a finite number")
    return value


def _counts_from_another_zero(unit: str) -> bool:
    try:
        return _core.to_si(f"0 {unit}", "K", "unit") != 0
    except InputError:  # it is no temperature
        return False


def positive_si(quantity: float | str, unit: str, name: str) -> float:
    """Likewise, of what must be larger than 0."""
    value = si(quantity, unit, name)
    if not value > 0:
        raise refused(name, f"must be larger than 0 and is {quantity}")
    return value


def each_si(quantities: float | str | Iterable[float | str], unit: str, name: str) -> list[float]:
    """Several quantities, or a single one, in an SI unit."""
    given = [quantities] if isinstance(quantities, (str, numbers.Real)) else quantities
    return [si(one, unit, name) for one in typing.cast(Iterable[float | str], given)]


def params_folder() -> pathlib.Path:
    """The folder with the cases that come with the program, such as "neisi2019-settling.toml"."""
    return pathlib.Path(_core.params_folder())

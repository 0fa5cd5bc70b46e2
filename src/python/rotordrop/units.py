"""Quantities with units, and the files that come with the program."""

from __future__ import annotations

import pathlib

from . import _core


def si(quantity: float | str, unit: str, name: str = "quantity") -> float:
    """A quantity in an SI unit: `si("15200 rpm", "rad/s")` is 1591.74; a number is one already.

    unit    "m", "N", "rad/s", "K" ...; what is given must have its dimension
    name    how an InputError calls it
    """
    return _core.to_si(quantity, unit, name) if isinstance(quantity, str) else float(quantity)


def params_folder() -> pathlib.Path:
    """The folder with the cases that come with the program, such as "neisi2019-settling.toml"."""
    return pathlib.Path(_core.params_folder())

"""What can be wrong: the input, with all its faults, or the numerics."""

from __future__ import annotations

import sys
import typing
import warnings


class Fault(typing.NamedTuple):
    """One thing that is wrong with the input, or unusual in it."""

    key: str
    """The parameter in question, such as "contact.air_gap"; empty where the input is not about one."""
    file: str
    """The file in which it stands; empty for what the calling program gave."""
    line: int
    """Counted from 1; 0 if there is no file."""
    column: int
    """Likewise."""
    message: str
    """What is wrong, what was given, what is allowed."""
    advice: str
    """What to do next, such as the name that is probably meant; may be empty."""


class Error(Exception):
    """Base of this package's exceptions."""


class InputError(Error, ValueError):
    """The input is wrong. The text of the exception shows all faults."""

    faults: tuple[Fault, ...]
    """All that are found, by file and line."""

    def __init__(self, text: str, faults: tuple[Fault, ...] = ()) -> None:
        super().__init__(text, faults)
        self.faults = faults

    def __str__(self) -> str:
        return str(self.args[0])


def refused(argument: str, message: str) -> InputError:
    """The error of one argument."""
    return InputError(f"error: {argument}: {message}", (Fault(argument, "", 0, 0, message, ""),))


class SolverError(Error, RuntimeError):
    """The numerics failed: the step size became too small, no equilibrium was found, a file cannot be written, a part of a module failed."""


class CaseWarning(UserWarning):
    """Something in a case is allowed but unusual, most often a slip. `warnings.simplefilter("error", CaseWarning)` refuses such cases."""


def warn_of(faults: typing.Iterable[Fault]) -> None:
    """Warns of what a case has that is unusual, at the line that called the package."""
    for fault in faults:
        warn(f"{fault.key}: {fault.message} {fault.advice}".strip())


def warn(text: str) -> None:
    """A CaseWarning at the line that called the package."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and str(frame.f_globals.get("__name__", "")).partition(".")[0] == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(text, CaseWarning, stacklevel=level)


def require(argument: str, value: object, kind: type, what: str) -> None:
    """TypeError for an argument of another kind. @param what  it must be, such as "a Result, such as rd.read(directory)" """
    if not isinstance(value, kind):
        raise TypeError(f"{argument} must be {what}, and is {value!r}")

"""What can be wrong: the input, with all its faults, or the numerics."""

from __future__ import annotations

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
    """Warns the caller's caller of what a case has that is unusual."""
    for fault in faults:
        warnings.warn(f"{fault.key}: {fault.message} {fault.advice}".strip(), CaseWarning, stacklevel=3)

"""Parts of a machine written in Python, for trying ideas. Each evaluation calls Python, so a drop takes ten to a hundred times as long; what proves itself is
rewritten in C++ (docs/how-to/extending.md)."""

from __future__ import annotations

import typing
from collections.abc import Mapping, Sequence

from . import _core

if typing.TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

SupportInput = _core.SupportInput
"""What a support sees: `time` [s]; `journal`, the rotor's motion at the support (`y`, `z` [m], `velocity_y`, `velocity_z` [m/s], `x`, tilts); `spin_angle` [rad], `spin_speed` [rad/s]."""

SupportResponse = _core.SupportResponse
"""What a support returns: `force_y`, `force_z`, `force_x` on the rotor [N], `moment_y`, `moment_z`, `torque` about +x [N m], `dissipation` [W], `prescribed_work` done on the
machine [W], `rates` of its states, `observed` numbers of its series."""


class Quantity(typing.NamedTuple):
    """A key of a part in a case."""

    unit: str = "1"
    """SI."""
    default: float | str | None = None
    """A number, or a text with a unit; None: the key must be given."""
    help: str = ""


class State(typing.NamedTuple):
    """An entry of the state vector that a part adds."""

    name: str
    unit: str
    scale: float
    """Typical size: the absolute tolerance is the relative one times this."""


class Series(typing.NamedTuple):
    """A quantity that a part reports: a dataset of the results."""

    name: str
    unit: str
    meaning: str
    columns: tuple[str, ...] = ()


class Support:
    """A support of the rotor written in Python. Derive from it, and make it known by `add_support`.

        @rd.add_support
        class Spring(rd.Support):
            type = "spring"
            parameters = {"stiffness": rd.Quantity("N/m")}

            def evaluate(self, seen, state):
                k, at = self.values["stiffness"], seen.journal
                return rd.SupportResponse(force_y=-k * at.y, force_z=-k * at.z)

            def energy(self, seen, state):
                return 0.5 * self.values["stiffness"] * (seen.journal.y**2 + seen.journal.z**2)

    Cases then say `type = "spring"`, `node = 3`, `stiffness = "1e6 N/m"` in a table of [bearings]; its series are below /bearings/NAME.
    It must book every watt: force times velocity is the rate of `energy` plus dissipation less prescribed work, or the energy residual of the run shows it.

    type         in cases
    parameters   keys in cases
    states       entries that it adds to the state vector
    series       what it reports, in the order of SupportResponse.observed
    """

    type: typing.ClassVar[str] = ""
    parameters: typing.ClassVar[Mapping[str, Quantity]] = {}
    states: Sequence[State] = ()
    series: Sequence[Series] = ()

    def __init__(self, name: str, values: Mapping[str, float]) -> None:
        """One for each machine. @param values  of the parameters [SI]"""
        self.name = name
        self.values = dict(values)

    def initial_state(self) -> Sequence[float]:
        """States in static equilibrium without the rotor; zeros unless overridden."""
        return [0.0] * len(self.states)

    def evaluate(self, seen: SupportInput, state: npt.NDArray[np.float64]) -> SupportResponse:
        """The force on the rotor and what else follows from motion and state. Pure: nothing may be kept from one call to the next."""
        raise NotImplementedError(f"{type(self).__name__}.evaluate")

    def energy(self, seen: SupportInput, state: npt.NDArray[np.float64]) -> float:
        """Kinetic, elastic and gravitational energy that it stores [J]."""
        raise NotImplementedError(f"{type(self).__name__}.energy")


S = typing.TypeVar("S", bound=type[Support])


def add_support(kind: S) -> S:
    """Lets cases name a class derived from Support by its `type`; usable as a decorator. Call it before such a case is read. A class may be replaced by one with the same parameters."""
    if not kind.type:
        raise ValueError(f"{kind.__name__} needs a `type`, by which cases name it")
    _core.add_support(kind.type, [(key, one.unit, one.default, one.help) for key, one in kind.parameters.items()], kind)
    return kind

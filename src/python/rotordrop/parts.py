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


Expansion = _core.Expansion
"""Growth of a bearing's surfaces [m], positive outwards: `shaft`, `bore`, `inner_race`, `outer_race`, `ball` (radius), `inner_width`, `outer_width`, `row_difference`."""

HeatInput = _core.HeatInput
"""Heat that a bearing releases [W]: `rub` of rotor and bore, `rub_into_ring` the part of it that enters the ring (the rest enters the rotor), `inner` and `outer` of the balls at
both races; the same by row in `rows` if finite elements run besides and rows may be loaded differently, else empty; `is_in_contact`; `rotor_surface_speed`, `ring_surface_speed` [m/s]; `balls`, what rolling balls conduct (`inner_to_ball`, `outer_to_ball`, `inner_to_outer` [W/K])."""

ThermalBearing = _core.ThermalBearing
"""What a thermal model is told about a touchdown bearing: `name`; materials `ring`, `ball`, `shaft` (`conductivity`, `heat_capacity`, `density`, `expansion`, `poisson_ratio`); dimensions [m];
`capacities` [J/K] and `resistances` [K/W] of the lumped circuit; `growth(shaft=, inner_ring=, outer_ring=, ball=)`, the Expansion when each part is evenly warmer by so much [K]."""


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

    def instants(self) -> Sequence[float]:
        """Known times at which what it returns jumps or bends [s]: steps end there. At such a time itself `evaluate` returns what holds after it."""
        return []

    def evaluate(self, seen: SupportInput, state: npt.NDArray[np.float64]) -> SupportResponse:
        """The force on the rotor and what else follows from motion and state. Pure: nothing may be kept from one call to the next."""
        raise NotImplementedError(f"{type(self).__name__}.evaluate")

    def energy(self, seen: SupportInput, state: npt.NDArray[np.float64]) -> float:
        """Kinetic, elastic and gravitational energy that it stores [J]."""
        raise NotImplementedError(f"{type(self).__name__}.energy")


class ThermalModel:
    """A thermal model of all touchdown bearings written in Python. Derive from it, and make it known by `add_thermal_model`.

        @rd.add_thermal_model
        class Rings(rd.ThermalModel):
            type = "rings"
            parameters = {"cooling": rd.Quantity("W/K", 0.0)}

            def __init__(self, bearings, ambient, values):
                super().__init__(bearings, ambient, values)
                self.states = [rd.State(f"{bearing.name}/inner_ring", "K", 1.0) for bearing in bearings]
                self.capacity = np.array([bearing.capacities["inner_ring"] for bearing in bearings])

            def rates(self, temperature, heat):
                lost = self.values["cooling"] * (temperature - self.ambient)
                into = np.array([one.rub + one.inner + one.outer for one in heat])
                return (into - lost) / self.capacity, lost.sum()

            def growth(self, temperature):
                return [bearing.growth(inner_ring=T - self.ambient) for bearing, T in zip(self.bearings, temperature)]

            def stored_energy(self, temperature):
                return float(self.capacity @ (temperature - self.ambient))

    Cases then say `thermal.models = ["lumped", "rings"]`, `[thermal.rings]` with its parameters, and `thermal.driver = "rings"` to feed its growth back; its series are below /rings/.
    It must book every joule: heat in is the rate of `stored_energy` plus the heat lost, or its residual in `summary["energy"]` shows it.

    type         in cases, summary and series: letters, digits, _ and -
    title        in sentences; "thermal model TYPE" unless given
    parameters   keys in cases, in the table [thermal.TYPE]
    states       temperatures, usually named "BEARING/PART"; absolute [K]
    series       what it reports, in the order of observe(); None: its states. "BEARING/inner_ring" joins figures, progress and comparison
    """

    type: typing.ClassVar[str] = ""
    title: typing.ClassVar[str] = ""
    parameters: typing.ClassVar[Mapping[str, Quantity]] = {}
    states: Sequence[State] = ()
    series: Sequence[Series] | None = None

    def __init__(self, bearings: Sequence[ThermalBearing], ambient: float, values: Mapping[str, float]) -> None:
        """One for each machine. @param bearings  touchdown bearings in the order of the case @param ambient  [K] @param values  of the parameters [SI]"""
        self.bearings = list(bearings)
        self.ambient = ambient
        self.values = dict(values)

    def initial_state(self) -> Sequence[float] | npt.NDArray[np.float64]:
        """Temperatures at the start [K]; ambient unless overridden."""
        return [self.ambient] * len(self.states)

    def rates(self, temperature: npt.NDArray[np.float64], heat: Sequence[HeatInput]) -> tuple[Sequence[float] | npt.NDArray[np.float64], float]:
        """Rates of the states [K/s] and the heat lost to ambient [W]. Pure: nothing may be kept from one call to the next. @param heat  of each bearing"""
        raise NotImplementedError(f"{type(self).__name__}.rates")

    def growth(self, temperature: npt.NDArray[np.float64]) -> Sequence[Expansion]:
        """Growth of each bearing over ambient; linear in the temperatures. Called when the machine is built, and not during a run."""
        raise NotImplementedError(f"{type(self).__name__}.growth")

    def stored_energy(self, temperature: npt.NDArray[np.float64]) -> float:
        """Heat stored since the start [J]."""
        raise NotImplementedError(f"{type(self).__name__}.stored_energy")

    def observe(self, temperature: npt.NDArray[np.float64], heat: Sequence[HeatInput]) -> Sequence[float] | npt.NDArray[np.float64]:
        """Numbers of the series, those with columns one after the other; the states unless overridden."""
        return temperature

    def reported(self) -> Sequence[Series]:
        """The series, or what stands for them if there are none."""
        if self.series is not None:
            return self.series
        return [Series(one.name.replace(" ", "_"), one.unit, f"{one.name}, by the thermal model {self.type}") for one in self.states]


S = typing.TypeVar("S", bound=type[Support])
M = typing.TypeVar("M", bound=type[ThermalModel])


def _keys(kind: type[Support] | type[ThermalModel], base: type) -> list[tuple[str, str, float | str | None, str]]:
    if not (isinstance(kind, type) and issubclass(kind, base)):
        raise TypeError(f"a class derived from rotordrop.{base.__name__} is needed, and {kind!r} is none")
    if not kind.type:
        raise ValueError(f"{kind.__name__} needs a `type`, by which cases name it")
    return [(key, one.unit, one.default, one.help) for key, one in kind.parameters.items()]


def add_support(kind: S) -> S:
    """Lets cases name a class derived from Support by its `type`; usable as a decorator. Call it before such a case is read. A class may be replaced by one with the same parameters."""
    keys = _keys(kind, Support)
    _core.add_support(kind.type, keys, kind)
    return kind


def add_thermal_model(kind: M) -> M:
    """Lets cases name a class derived from ThermalModel by its `type`; usable as a decorator. Call it before such a case is read. A class may be replaced by one with the same parameters."""
    keys = _keys(kind, ThermalModel)
    _core.add_thermal_model(kind.type, kind.title, keys, kind)
    return kind

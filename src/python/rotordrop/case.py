"""A case: what is dropped onto what. It runs, and answers what needs no run."""

from __future__ import annotations

import copy
import os
import pathlib
import sys
import tomllib
import typing
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence

from . import _core, modes, preload
from .errors import CaseWarning, Fault, refused, require, warn_of
from .result import Result
from .units import each_si, positive_si

if typing.TYPE_CHECKING:
    import xarray

Progress = _core.Progress
"""Progress of a run: `time`, `end_time` (simulated [s]), `wall_time`, `wall_time_left` [s], `rotor_speed` [rad/s], `largest_contact_force` [N],
`inner_ring_temperature` of the warmest inner ring [K] (NaN without a thermal model)."""


def _is_text(source: str) -> bool:
    return "\n" in source or ("=" in source and not source.endswith(".toml"))


def show_progress(progress: Progress) -> None:
    """A line on standard error that follows a run."""
    share = progress.time / progress.end_time if progress.end_time > 0 else 1.0
    print(
        f"\rt = {progress.time:.4f} s of {progress.end_time:g} s, {100 * share:.0f} %, about {progress.wall_time_left:.0f} s left ",
        end="\n" if share >= 1 else "",
        file=sys.stderr,
        flush=True,
    )


class Case:
    """A case, read, checked and completed.

        rd.Case("params/neisi2019-settling.toml", {"contact.friction_coefficient": 0.05, "run.initial_speed": "8000 rpm"})
        rd.Case('base = "params/neisi2019.toml"\\n[contact]\\nair_gap = "200 um"')
        rd.Case({"base": "params/neisi2019.toml", "contact": {"air_gap": 200e-6}})

    source      name of a file; or text in TOML (several lines, or one with "="); or a dictionary of tables
    overrides   parameters that go before those of the source, later ones before earlier ones: numbers (SI), texts with units, booleans, lists,
                and dictionaries, whose keys are set one by one. Keys name entries of lists, too: "rotor.unbalance[0].me"
    name        of a case from text or dictionary
    folder      where files are looked for that a text, a dictionary or overrides name, such as `base`; default: the working folder of that moment

    InputError, with all faults, if it is wrong. What is allowed but unusual is a CaseWarning, and listed in `warnings`.
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, typing.Any],
        overrides: Mapping[str, typing.Any] | None = None,
        *,
        name: str = "case",
        folder: str | os.PathLike[str] | None = None,
    ) -> None:
        require("overrides", overrides or {}, Mapping, "a dictionary, such as {'contact.air_gap': '250 um'}")
        self._read(source, [dict(overrides or {})], name, folder)
        warn_of(self.warnings)

    def _read(
        self,
        source: str | os.PathLike[str] | Mapping[str, typing.Any],
        layers: Sequence[dict[str, typing.Any]],
        name: str,
        folder: str | os.PathLike[str] | None,
    ) -> None:
        """layers   of overrides, later ones go before earlier ones"""
        self._name, self._folder = name, os.path.abspath(folder or ".")
        text: str | None = None
        tree: dict[str, typing.Any] | None = None
        file = pathlib.Path(folder or ".") / f"{name}.toml"
        if isinstance(source, Mapping):
            tree = dict(source)
        elif isinstance(source, str) and _is_text(source):
            text = source
        else:
            file = pathlib.Path(source)
        # What is read again later is what was given now, wherever the program is by then.
        again = source if tree is not None or text is not None else file.absolute()
        self._case = _core.read_case(file, text, tree, layers, self._folder)
        self._source, self._layers = copy.deepcopy(again), copy.deepcopy([layer for layer in layers if layer])

    def __repr__(self) -> str:
        supports = ", ".join(f"{name} ({kind})" for name, kind in self._case.bearings.items())
        return f"<rotordrop.Case {self.name}: {supports}>"

    def __reduce__(self) -> tuple[typing.Any, ...]:
        return _read_again, (self._source, self._layers, self._name, self._folder)

    @property
    def name(self) -> str:
        """The file's name without its ending, or the one that was given."""
        return self._case.name

    @property
    def text(self) -> str:
        """All parameters as TOML, with units and sources: what a run writes as parameters.toml."""
        return self._case.resolved

    @property
    def parameters(self) -> dict[str, typing.Any]:
        """All parameters as dictionaries; quantities are texts with units as given, or numbers (SI)."""
        return tomllib.loads(self._case.resolved)

    @property
    def bearings(self) -> tuple[str, ...]:
        """Names of the touchdown bearings."""
        return tuple(name for name, kind in self._case.bearings.items() if kind == "touchdown")

    @property
    def warnings(self) -> tuple[Fault, ...]:
        """What is allowed but unusual."""
        return self._case.warnings

    def with_overrides(self, overrides: Mapping[str, typing.Any]) -> Case:
        """The same case with further overrides, which go before its own; dictionaries leave what they do not set. Files are read again, as by pickle and copy."""
        own = [{key: value for key, value in layer.items() if not (key in overrides and _replaces(overrides[key], value))} for layer in self._layers]
        case = Case.__new__(Case)
        case._read(self._source, [*own, dict(overrides)], self._name, self._folder)
        warn_of(case.warnings)
        return case

    def run(
        self,
        directory: str | os.PathLike[str] | None = None,
        *,
        progress: Callable[[Progress], object] | bool | None = None,
        keep: Iterable[str] | str | None = None,
        force: bool = False,
        resume: bool = False,
    ) -> Result:
        """Runs the drop; other threads of Python run meanwhile. Ctrl-C ends it with KeyboardInterrupt.

        directory   where it writes what `rotordrop run` writes, with checkpoints, temperature fields and the comparison of its thermal models; without one it stays in memory
        progress    called about five times a second with a Progress; True: a line on standard error. What it raises ends the run
        keep        in memory: paths of the series to keep, such as "/bearings/TB1/contact_force", beside those that the summary needs;
                    without it all are kept; InputError for one that the drop does not have
        force       replaces results that are in the directory
        resume      continues an interrupted run in the directory

        SolverError if the integration fails, or if its thermal models cannot be compared.
        """
        told = show_progress if progress is True else progress or None
        if directory is None:
            if force or resume:
                raise ValueError("force and resume are about a directory, and none is given")
            if self._case.asks_for_second_opinion:
                warnings.warn("run.second_opinion: a run in memory gives none; give it a directory", CaseWarning, stacklevel=2)
            paths = [keep] if isinstance(keep, str) else None if keep is None else list(keep)
            for path in paths or ():
                require("keep", path, str, "paths of series, such as \"/bearings/TB1/contact_force\"")
            kept = None if paths is None else {"/" + path.lstrip("/").replace(".", "/") for path in paths}
            return Result(_core.run_in_memory(self._case, kept, told), self)
        if keep is not None:
            raise ValueError("a run in a directory keeps all series; leave out keep")
        if not os.fspath(directory):
            raise refused("directory", "is empty; give a name, or \".\" for the working folder")
        absolute = pathlib.Path(directory).absolute()
        return Result(_core.run_in_folder(self._case, absolute, force, resume, told), self, absolute)

    def modes(self, speeds: Sequence[float | str] | float | str | None = None, n_modes: int = 10) -> xarray.Dataset:
        """Natural modes of the rotor with the case's linear supports and magnets, or free-free if it has none.

        speeds   spin speeds: [rad/s], or texts such as "15200 rpm"; default: at rest and at the case's initial speed

        Dimensions `speed` [rad/s], `mode` (from 1), `node` (axial position [m]), `axis` ("y", "z"); `frequency` and `natural_frequency` [Hz],
        `damping_ratio`, `whirl` ("forward", "backward", "planar", "mixed"; "" where there are fewer modes), `shape` (complex, the largest amplitude is 1). Supports of your own (`add_support`, modules) take no part; `attrs["left_out"]` names them.
        """
        given = each_si([0.0, self._case.initial_speed] if speeds is None else speeds, "rad/s", "speeds")
        if n_modes < 0:
            raise refused("n_modes", f"must be at least 0 and is {n_modes}")
        return modes.dataset(self._case, given, n_modes)

    def critical_speeds(
        self,
        up_to: float | str | None = None,
        stiffness: float | str | None = None,
        stiffness_map: Sequence[float | str] | float | str = (),
    ) -> dict[str, typing.Any]:
        """Critical speeds of the rotor on linear supports, as `rotordrop critical-speeds --json` has them.

        up_to           largest speed [rad/s]; default: twice the case's initial speed
        stiffness       of isotropic springs at all stations instead of the case's linear supports [N/m]
        stiffness_map   stiffnesses of all stations for a critical-speed map [N/m]

        The rotor spins in the sense of the case's initial speed; forward whirl is with its spin, backward against it.
        "critical_speeds" is a list of {speed [rad/s], frequency [Hz], whirl, damping_ratio, separation}; "map" one of {stiffness, speeds}. Supports of your own (`add_support`, modules) take no part; "left_out" names them, if there are such.
        """
        limit = 2 * abs(self._case.initial_speed) if up_to is None else positive_si(up_to, "rad/s", "up_to")
        if not limit > 0:
            raise ValueError("the case's run.initial_speed is 0: give up_to, such as \"20000 rpm\"")
        spring = None if stiffness is None else positive_si(stiffness, "N/m", "stiffness")
        return _core.critical_speeds(self._case, limit, spring, [positive_si(one, "N/m", "stiffness_map") for one in each_si(stiffness_map, "N/m", "stiffness_map")])

    def statics(self, bearing: str | None = None) -> dict[str, typing.Any]:
        """Static equilibrium of the rotor or of its bearings, as `rotordrop statics --json` has it (docs/how-to/statics.md).

        bearing   only this touchdown bearing, by itself; default: what the case's [statics] names
        """
        return _core.statics(self._case, bearing or "")

    def preload(self, bearing: str | None = None, drop: Result | None = None) -> preload.Preload:
        """Thermal preload of touchdown bearings by themselves: steady running, maps, and over a drop (docs/how-to/preload.md).

        bearing   only this touchdown bearing; default: all
        drop      a result whose growth and ring speeds give the history

        A bearing without an equilibrium when cold has the verdict "failed" and a message in the report; its maps and the others are there.
        """
        if drop is not None:
            require("drop", drop, Result, "a Result, such as rd.read(directory)")
        report, tables = _core.preload(self._case, bearing or "", None if drop is None else drop.recorded)
        return preload.Preload(report, tables)


def _replaces(later: typing.Any, earlier: typing.Any) -> bool:
    """Whether an override leaves nothing of an earlier one by the same key. Dictionaries are laid over each other."""
    if not hasattr(later, "items"):
        return True
    return hasattr(earlier, "items") and all(key in later and _replaces(later[key], value) for key, value in earlier.items())


def _read_again(source: typing.Any, layers: list[dict[str, typing.Any]], name: str, folder: typing.Any) -> Case:
    case = Case.__new__(Case)
    case._read(source, layers, name, folder)
    return case

"""What a drop gives, from memory or from the directory of a run."""

from __future__ import annotations

import functools
import json
import math
import os
import pathlib
import typing
from collections.abc import Iterator, Mapping

from . import _core, errors, series

if typing.TYPE_CHECKING:
    import pandas
    import xarray

    from .case import Case


class Bearings(Mapping[str, "xarray.Dataset"]):
    """Series of each support by its name, as data sets: `result.bearings["TB1"].contact_force`."""

    def __init__(self, result: Result) -> None:
        self._result = result
        self._names = [path.split("/")[2] for path in result.recorded.datasets if path.startswith("/bearings/")]

    def __getitem__(self, name: str) -> xarray.Dataset:
        if name not in self._names:
            raise KeyError(f"there is no bearing {name!r}; known: {', '.join(self)}")
        return self._result.select(f"/bearings/{name}/")

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys(self._names))

    def __len__(self) -> int:
        return len(set(self._names))


class Result:
    """A drop: numbers in `summary`, series over time in `series`. All are SI, temperatures absolute [K].

    case        the Case that ran; None if it was read from a directory
    directory   where its files are; None if it ran in memory
    completed   it came to its end (else it was interrupted, goes on, was killed, or failed)
    notes       what the program said meanwhile
    """

    def __init__(self, run: _core.Drop | None, case: Case | None = None, directory: pathlib.Path | None = None) -> None:
        self.case = case
        self.directory = None if directory is None else directory.absolute()
        if run is not None:
            self.recorded: _core.RecordedDrop = run.recorded
            self._summary: dict[str, typing.Any] | None = run.summary
            self.notes = tuple(run.notes)
        else:
            assert self.directory is not None
            self.recorded = _core.open_results(self.directory)
            file = self.directory / "summary.json"
            self._summary = _read_summary(file) if file.is_file() else None
            self.notes = ()
        self.completed: bool = bool(run.completed if run is not None else self._summary and self._summary["run"].get("completed", True))

    def __repr__(self) -> str:
        where = f"in {self.directory}" if self.directory else "in memory"
        return f"<rotordrop.Result of {self.recorded.case_name or 'a case'} {where}: {len(self.recorded.datasets)} series{'' if self.completed else ', not completed'}>"

    def __reduce__(self) -> tuple[typing.Any, ...]:
        """Pickled is where the files are: they are read again. TypeError for a drop in memory."""
        if self.directory is None:
            raise TypeError(
                "a drop in memory cannot be pickled: return `result.summary` or `result.series` from a process, run the drop in a directory, case.run(directory), "
                "or run drops in threads, which do not wait for each other"
            )
        return _read_again, (self.directory, self.case, self.notes)

    @property
    def summary(self) -> dict[str, typing.Any]:
        """Scalars of the drop, as in summary.json (docs/reference/results.md): `summary["bearings"]["TB1"]["peak_contact_force"]` [N].

        Of an interrupted run: until there. FileNotFoundError for the directory of a run that goes on, was killed or has failed: it has none.
        """
        if self._summary is None:
            if self.directory is not None and (self.directory / "failed").is_dir():
                raise FileNotFoundError(f"{self.directory} holds no summary.json: the run failed. Its series until then are there, and its last state in the folder failed")
            raise FileNotFoundError(f"{self.directory} holds no summary.json: the run goes on, or was killed. Its series are there; `rotordrop run --resume` continues it")
        return self._summary

    @property
    def has_summary(self) -> bool:
        """Whether there is a summary: that of a run that goes on, was killed or has failed is missing."""
        return self._summary is not None

    @functools.cached_property
    def series(self) -> xarray.Dataset:
        """All series as one data set: `series["bearings.TB1.contact_force"]`, each with `units` and `long_name`.

        Names are paths of results.h5 with dots. What was recorded at other times has a time of its own: "time", "detail_time" (ball loads), "windows_time" (finite elements in
        windows). Second dimensions: "axis" ("y", "z"), "surface" (growths), "statistic" ("mean", "lowest", "highest"), "TB1.row", "TB1.ball".
        """
        return series.dataset(self.recorded, [path for path in self.recorded.datasets if self._is_series(path)])

    @property
    def bearings(self) -> Bearings:
        """Series of each support by its name, without prefixes: `bearings["TB1"].orbit.sel(axis="y")` [m]."""
        return Bearings(self)

    def select(self, prefix: str) -> xarray.Dataset:
        """Series below a path as a data set with names without it: `select("/thermal/TB1").inner_ring` [K]. KeyError if there is none."""
        start = series.path_of(prefix).rstrip("/") + "/"
        paths = [path for path in self.recorded.datasets if path.startswith(start) and self._is_series(path)]
        if not paths:
            raise KeyError(f"no series below {start}; there are {', '.join(sorted({path.split('/')[1] for path in self.recorded.datasets}))}")
        return series.dataset(self.recorded, paths, series.name_of(start) + ".", place=(start.split("/") + [""])[2])

    def __getitem__(self, name: str) -> xarray.DataArray:
        """One series: `result["bearings.TB1.contact_force"]`, or by its path in results.h5. KeyError, with similar names, if there is none."""
        path = series.path_of(name)
        series.table(self.recorded, path)  # says what there is
        if not self._is_series(path):
            raise KeyError(f"{name} is what series were recorded at: result.series.{series.time_dimension(path)}")
        return series.dataset(self.recorded, [path])[series.name_of(path)]

    def frame(self, *names: str, time: str = "time") -> pandas.DataFrame:
        """Series as a table over time [s]; a column for each number: "bearings.TB1.orbit.y".

        names   of series; without any, all that were recorded at `time` ("time", "detail_time", "windows_time")
        The units are in `frame.attrs["units"]`, by column.
        """
        import pandas

        chosen = self.series if not names else series.dataset(self.recorded, [series.path_of(name) for name in names])
        columns: dict[str, typing.Any] = {}
        units: dict[str, str] = {}
        for name, array in chosen.data_vars.items():
            if array.dims[0] != time:
                if names:
                    raise ValueError(f"{name} was recorded at other times: say time={array.dims[0]!r}")
                continue
            numbers = array.values.reshape(len(array), math.prod(array.shape[1:]))  # there may be no rows yet
            labels = [str(label) for label in array[array.dims[1]].values] if array.ndim > 1 else [""]
            for k, label in enumerate(labels):
                column = f"{name}.{label}" if label else str(name)
                columns[column] = numbers[:, k]
                units[column] = array.attrs["units"]
        frame = pandas.DataFrame(columns, index=pandas.Index(chosen[time].values, name=f"{time} [s]"))
        frame.attrs["units"] = units
        return frame

    @property
    def scalars(self) -> pandas.DataFrame:
        """All numbers of the summary as a table: `scalars.loc["bearings.TB1.peak_contact_force", "value"]`; columns value, unit, meaning (empty where they are not known)."""
        import pandas

        numbers = dict(_numbers(self.summary, ""))
        meanings = [_core.meaning_of(name) for name in numbers]
        return pandas.DataFrame(
            {"value": list(numbers.values()), "unit": [unit for unit, _ in meanings], "meaning": [meaning for _, meaning in meanings]},
            index=pandas.Index(numbers, name="name"),
        )

    @property
    def text(self) -> str:
        """The main results as a few lines, as `rotordrop run` prints them."""
        return _core.summary_text(json.dumps(_finite(self.summary)))

    def to_mat(self, file: str | os.PathLike[str]) -> None:
        """Writes everything into a file for MATLAB or Octave: `load FILE`, then `results.bearings.TB1.contact_force`.

        Series are columns, of several numbers [rows x numbers], as in Python; `units` has the units by the same names, `summary` the scalars, where there is a summary. Needs scipy.
        """
        from . import matlab

        matlab.write(self, file)

    def report(self, file: str | os.PathLike[str] | None = None) -> pathlib.Path:
        """Writes the run's HTML page, as `rotordrop report` does; it needs a result in a directory.

        file   default: report.html in the directory. InputError for one that is no page of the program: it is left alone
        """
        if self.directory is None:
            raise ValueError("a report needs the files of a run: case.run(directory)")
        path = pathlib.Path(file) if file is not None else self.directory / "report.html"
        _core.write_report(self.directory, path)
        return path

    def fields(self, bearing: str) -> list[tuple[float, pathlib.Path]]:
        """Temperature fields of a bearing by finite elements: pairs of time [s] and file (VTU), empty if none were asked for (thermal.fe.field_interval). For meshio, PyVista or ParaView."""
        import xml.etree.ElementTree

        if self.directory is None:
            return []
        pvd = self.directory / "fields" / f"{bearing}.pvd"
        if not pvd.is_file():
            return []
        sets = xml.etree.ElementTree.parse(pvd).getroot().iterfind("Collection/DataSet")
        return [(float(one.attrib["timestep"]), pvd.parent / one.attrib["file"]) for one in sets]

    def _is_series(self, path: str) -> bool:
        return not path.endswith("/time")


def read(directory: str | os.PathLike[str]) -> Result:
    """The result that `rotordrop run` or `case.run(directory)` wrote, also of a run that goes on or was killed. InputError if the directory holds none."""
    return Result(None, directory=pathlib.Path(directory))


def _read_again(directory: pathlib.Path, case: Case | None, notes: tuple[str, ...]) -> Result:
    result = Result(None, case, directory)
    result.notes = notes
    return result


def _read_summary(file: pathlib.Path) -> dict[str, typing.Any]:
    """InputError for a file that the program did not write."""
    try:
        summary = json.loads(file.read_text(encoding="utf-8"))
    except ValueError:
        summary = None
    if not isinstance(summary, dict) or not isinstance(summary.get("run"), dict):
        raise errors.InputError(f"error: {file}: this summary is not what the program wrote.\n       Remove the file, or run the case again.")
    return summary


def _finite(value: typing.Any) -> typing.Any:
    """The same with None for numbers that are none, as in summary.json."""
    if isinstance(value, dict):
        return {key: _finite(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _numbers(value: typing.Any, path: str) -> Iterator[tuple[str, float | bool]]:
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from _numbers(inner, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from _numbers(inner, f"{path}[{i}]")
    elif value is None:
        yield path, float("nan")
    elif isinstance(value, (bool, int, float)):
        yield path, value

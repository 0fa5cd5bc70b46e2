"""Series of a drop as data sets of xarray."""

from __future__ import annotations

import re
import typing

from . import _core
from .errors import require

if typing.TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    import xarray

SHARED = {("y", "z"): "axis", ("mean", "lowest", "highest"): "statistic"}
GROWTH = ("shaft", "bore")  # how the surfaces of growth begin
ROW, BALL = re.compile(r"row \d+"), re.compile(r"row \d+ ball \d+")


def name_of(path: str) -> str:
    """ "/bearings/TB1/contact_force" as a variable: "bearings.TB1.contact_force"."""
    return path.strip("/").replace("/", ".")


def path_of(name: str) -> str:
    """The path of a variable; a path stays what it is."""
    require("the name of a series", name, str, "a text such as \"bearings.TB1.contact_force\"")
    return name if name.startswith("/") else "/" + name.replace(".", "/")


def time_dimension(time_path: str) -> str:
    """ "/time" is "time", "/detail/time" is "detail_time"."""
    return time_path.strip("/").replace("/", "_")


def column_dimension(path: str, columns: tuple[str, ...], n_columns: int) -> str:
    """The second dimension: one of those that all bearings share, else the bearing's own rows or balls, else the series' own."""
    if shared := SHARED.get(columns):
        return shared
    if columns[:2] == GROWTH:
        return "surface"
    place = path.split("/")[2] if path.count("/") > 2 else ""
    if columns and place and all(ROW.fullmatch(column) for column in columns):
        return f"{place}.row"
    if columns and place and all(BALL.fullmatch(column) for column in columns):
        return f"{place}.ball"
    return f"{name_of(path)}.column"


def shared_columns(recorded: _core.RecordedDrop) -> dict[str, set[tuple[str, ...]]]:
    """Columns of all series by their second dimension: one that has several is shared by none, whichever series are asked for."""
    found: dict[str, set[tuple[str, ...]]] = {}
    for path in recorded.datasets:
        columns = tuple(recorded.meaning(path)[3])
        if columns:
            found.setdefault(column_dimension(path, columns, len(columns)), set()).add(columns)
    return found


class Table(typing.NamedTuple):
    """One series.

    values    [n], or [n, n_columns] if it has columns, also for a single one; of a drop in memory not a copy, and not to be written to
    """

    values: npt.NDArray[np.float64]
    unit: str
    meaning: str
    time_path: str
    columns: tuple[str, ...]


def table(recorded: _core.RecordedDrop, path: str) -> Table:
    """A series by its path. KeyError, with similar names, if there is none."""
    if path not in recorded.datasets:
        last = path.rsplit("/", 1)[-1]
        similar = [known for known in recorded.datasets if known.rsplit("/", 1)[-1] == last]
        raise KeyError(f"no series {path}" + (f"; there is {', '.join(similar[:8])}" if similar else ""))
    unit, meaning, time_path, columns = recorded.meaning(path)
    return Table(recorded.values(path, bool(columns)), unit, meaning, time_path, tuple(columns))


def dataset(recorded: _core.RecordedDrop, paths: list[str], prefix: str = "", place: str = "") -> xarray.Dataset:
    """Series as variables by their dotted names without a prefix. Series that were recorded at other times have a time of their own.

    place   bearing whose dimensions are called without its name: "row" instead of "TB1.row"
    """
    import numpy as np
    import xarray

    variables: dict[str, typing.Any] = {}
    coords: dict[str, typing.Any] = {}
    lengths: dict[str, int] = {}
    columns_by_dimension: dict[str, set[tuple[str, ...]]] | None = None
    names = {name_of(path).removeprefix(prefix) for path in paths}
    for path in paths:
        one = table(recorded, path)
        time = time_dimension(one.time_path)
        if time not in lengths:
            times = table(recorded, one.time_path)
            lengths[time] = len(times.values)
            coords[time] = (time, times.values, {"units": "s", "long_name": times.meaning or "time"})
        values = one.values[: lengths[time]]  # while a run goes on, values come before their times
        if len(values) < lengths[time]:
            values = np.concatenate([values, np.full((lengths[time] - len(values), *values.shape[1:]), np.nan)])
        dims: tuple[str, ...] = (time,)
        if values.ndim > 1:
            dimension = column_dimension(path, one.columns, values.shape[1])
            own = f"{name_of(path)}.column"
            if one.columns and dimension not in (own, *SHARED.values()):
                columns_by_dimension = columns_by_dimension or shared_columns(recorded)
                if len(columns_by_dimension[dimension]) > 1:
                    dimension = own
            if place and dimension.startswith(place + "."):
                dimension = dimension.removeprefix(place + ".")
            if dimension in names:  # a dimension cannot be called as a series
                dimension = own
            dims = (time, dimension)
            if one.columns:
                coords[dimension] = (dimension, list(one.columns))
        attributes = {"units": one.unit, "long_name": one.meaning, "path": path}
        variables[name_of(path).removeprefix(prefix)] = (dims, values, attributes)
    return xarray.Dataset(variables, coords)

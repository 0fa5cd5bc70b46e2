"""Thermal preload of touchdown bearings."""

from __future__ import annotations

import typing

if typing.TYPE_CHECKING:
    import xarray


class Preload:
    """Thermal preload of touchdown bearings by themselves.

    report   as preload.json: verdicts, operating points, corners of the maps (docs/how-to/preload.md), SI
    tables   data sets by name, such as "TB2.running" over `time` or "TB2.maps.growth" over `growth` and `speed`: what preload.h5 holds, with units
    """

    report: dict[str, typing.Any]
    tables: dict[str, xarray.Dataset]

    def __init__(self, report: dict[str, typing.Any], tables: list[dict[str, typing.Any]]) -> None:
        self.report = report
        folders: dict[str, list[dict[str, typing.Any]]] = {}
        for table in tables:
            folders.setdefault(table["axis"][0].rpartition("/")[0], []).append(table)
        self.tables = {folder.strip("/").replace("/", "."): _dataset(folder, group) for folder, group in folders.items()}

    def __repr__(self) -> str:
        return f"<rotordrop.Preload of {', '.join(self.report['bearings'])}: tables {', '.join(self.tables)}>"


def _dataset(folder: str, group: list[dict[str, typing.Any]]) -> xarray.Dataset:
    """The tables of one folder: one with values, and of a map another one that is the axis of its columns."""
    import xarray

    variables: dict[str, typing.Any] = {}
    coords: dict[str, typing.Any] = {}
    other_axes = []
    for table in group:
        path, unit, meaning, axis = table["axis"]
        axis_name = path.rpartition("/")[2]
        coords[axis_name] = (axis_name, axis, {"units": unit, "long_name": meaning})
        if not table["channels"]:
            other_axes.append((axis_name, len(axis)))
    for table in group:
        axis_name = table["axis"][0].rpartition("/")[2]
        for channel, unit, meaning, columns, values in table["channels"]:
            attributes = {"units": unit, "long_name": meaning}
            name = channel.removeprefix(folder + "/").replace("/", ".")
            if values.shape[1] == 1 and not columns:
                variables[name] = ((axis_name,), values[:, 0], attributes)
                continue
            second = next((other for other, n in other_axes if n == values.shape[1]), "column")
            variables[name] = ((axis_name, second), values, attributes)
            if second == "column" and columns:
                coords["column"] = (("column",), columns, {})
    return xarray.Dataset(variables, coords)

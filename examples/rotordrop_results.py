"""Reads what rotordrop writes: time series with units, summary, parameters, temperature fields.

    from rotordrop_results import Results

    run = Results("out/neisi2019-settling")
    force = run.bearing("TB1")["contact_force"]
    print(force.values.max(), force.unit)            # 5198.1 N
    print(run.summary["bearings"]["TB1"]["peak_contact_force"])

All numbers are SI, angles rad, temperatures absolute kelvin. Works while a run goes on, and after it was killed: what is there is read. Needs h5py and numpy (Debian: python3-h5py).
What each series means: docs/reference/results.md. Copy this file beside your own scripts, or put its folder on PYTHONPATH.
"""

import base64
import dataclasses
import functools
import json
import pathlib
import tomllib
import xml.etree.ElementTree
import zlib

import h5py
import numpy as np

TEMPERATURE, RISE = "temperature [K]", "temperature rise [K]"


@dataclasses.dataclass(frozen=True)
class Series:
    """One recorded quantity.

    time     [n] s, rising
    values   [n], or [n, n_columns] if it has columns, in `unit`
    unit     UDUNITS text of an SI unit: "N", "rad/s", "K"
    columns  names of the columns, such as ("y", "z"); empty if there are none
    meaning  what it is, in words
    path     its name in results.h5
    """

    time: np.ndarray
    values: np.ndarray
    unit: str
    columns: tuple
    meaning: str
    path: str

    def column(self, name):
        """One column as a Series. KeyError, with the known ones, if there is none of that name."""
        if name not in self.columns:
            raise KeyError(f"{self.path} has no column {name!r}; known: {', '.join(self.columns) or 'none'}")
        return dataclasses.replace(self, values=self.values[:, self.columns.index(name)], columns=())

    def at(self, time):
        """Value at a time [s] (or an array of them), on the straight line between samples; before the first sample the first value, after the last one the last."""
        if self.values.ndim == 1:
            return np.interp(time, self.time, self.values)
        return np.stack([np.interp(time, self.time, column) for column in self.values.T], axis=-1)

    def between(self, start, end):
        """The samples with start <= time <= end [s]."""
        chosen = (self.time >= start) & (self.time <= end)
        return dataclasses.replace(self, time=self.time[chosen], values=self.values[chosen])

    def integral(self):
        """Integral over time by trapezoids, [s] times the unit; one number, or one for each column. Impacts last milliseconds: for exact heats and impulses take the series of `/ledger`."""
        steps = np.diff(self.time)
        middle = 0.5 * (self.values[1:] + self.values[:-1])
        return np.tensordot(steps, middle, axes=(0, 0))[()]


class Group:
    """Series below one path of results.h5, by name: `group["contact_force"]`, `"orbit" in group`, `list(group)`."""

    def __init__(self, results, path):
        self._results, self.path = results, path.rstrip("/")

    def __getitem__(self, name):
        return self._results.series(f"{self.path}/{name}")

    def __contains__(self, name):
        return f"{self.path}/{name}" in self._results.paths

    def __iter__(self):
        start = self.path + "/"
        return (path[len(start):] for path in self._results.paths if path.startswith(start))


class Results:
    """The directory of a run.

    directory   where it is
    paths       names of all series, sorted: "/bearings/TB1/orbit"
    bearings    names of the supports, in the file's order
    attributes  of the run: "program", "git_revision", "case", "frame" …
    """

    def __init__(self, directory):
        """FileNotFoundError if there is no results.h5."""
        self.directory = pathlib.Path(directory)
        path = self.directory / "results.h5"
        if not path.is_file():
            raise FileNotFoundError(f"there is no {path}; give the directory into which `rotordrop run` wrote")
        try:
            self._file = h5py.File(path, "r", swmr=True)  # also while it is being written
        except (OSError, ValueError):
            self._file = h5py.File(path, "r")
        self.attributes = {key: value.decode() if isinstance(value, bytes) else value for key, value in self._file.attrs.items()}
        paths = []
        self._file.visititems(lambda name, item: paths.append("/" + name) if isinstance(item, h5py.Dataset) and "units" in item.attrs else None)
        self.paths = sorted(paths)
        self.bearings = list(self._file.get("bearings", {}))

    def close(self):
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def series(self, path):
        """The Series of that path. KeyError, with similar names, if there is none."""
        if path not in self.paths:
            last = path.rsplit("/", 1)[-1]
            similar = [known for known in self.paths if known.rsplit("/", 1)[-1] == last] or [known for known in self.paths if known.startswith(path.rsplit("/", 1)[0] + "/")]
            raise KeyError(f"{self.directory} has no {path}" + (f"; there is {', '.join(similar[:8])}" if similar else ""))
        dataset = self._file[path]
        text = lambda value: value.decode() if isinstance(value, bytes) else str(value)  # noqa: E731
        times = path if path.endswith("/time") else text(dataset.attrs.get("time", "/time"))
        values, time = dataset[()], self._file[times][()]
        n = min(len(values), len(time))  # while a run goes on, values come before their times
        columns = tuple(text(column) for column in dataset.attrs.get("columns", []))
        return Series(time[:n], values[:n], text(dataset.attrs["units"]), columns, text(dataset.attrs.get("long_name", "")), path)

    def bearing(self, name):
        """The Group of a support: orbit [n, 2] m, contact_force [n] N, ring_speed [n] rad/s …"""
        if name not in self.bearings:
            raise KeyError(f"there is no bearing {name!r}; known: {', '.join(self.bearings)}")
        return Group(self, "/bearings/" + name)

    def temperatures(self, bearing, model="lumped"):
        """The Group of a bearing's temperatures [n] K; of the finite elements ("fe") also surfaces, [n, 3]: mean, lowest, highest. KeyError if that model did not run."""
        path = "/thermal/" if model == "lumped" else "/windows/" if model == "fe" and "/windows/time" in self.paths else f"/{model}/"
        group = Group(self, path + bearing)
        if not any(group):
            raise KeyError(f"{self.directory} has no temperatures of {bearing} by model {model!r}")
        return group

    @functools.cached_property
    def summary(self):
        """summary.json as a dictionary (docs/reference/results.md); None while the run goes on or if it failed."""
        path = self.directory / "summary.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None

    @functools.cached_property
    def parameters(self):
        """The case as it was used, complete, as a dictionary of tables; quantities are texts with units as given, or SI numbers."""
        return tomllib.loads((self.directory / "parameters.toml").read_text(encoding="utf-8"))

    def fields(self, name):
        """Temperature fields of a bearing ("temperature" of `rotordrop heat`): a list of (time [s], file) in their order, empty if there are none. Read a file with read_vtu()."""
        path = self.directory / "fields" / (name + ".pvd")
        return read_series(path) if path.is_file() else []


# ------------------------------------------------------------------------------------------------------------------ fields

TYPES = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "UInt32": "<u4", "Int64": "<i8", "UInt64": "<u8", "UInt8": "u1", "Int8": "i1"}


def read_array(element):
    """Values of a DataArray: plain text, or base64 of blocks that zlib compressed (a head of 4-byte integers, then the blocks)."""
    text = "".join((element.text or "").split())
    kind = np.dtype(TYPES[element.get("type")])
    if element.get("format") == "ascii":
        values = np.array((element.text or "").split(), dtype=float).astype(kind)
    else:
        n_blocks = int.from_bytes(base64.b64decode(text[:8])[:4], "little")
        n_head = 4 * (3 + n_blocks)
        n_coded = 4 * -(-n_head // 3)
        sizes = np.frombuffer(base64.b64decode(text[:n_coded])[12:n_head], "<u4")
        packed, at, blocks = base64.b64decode(text[n_coded:]), 0, []
        for size in sizes:
            blocks.append(zlib.decompress(packed[at : at + size]))
            at += size
        values = np.frombuffer(b"".join(blocks), kind)
    n = int(element.get("NumberOfComponents", "1"))
    return values.reshape(-1, n) if n > 1 else values


def read_vtu(file):
    """A dictionary: "points" [n, 3] m (x along the axis, r, 0), "quads" [n_cells, 4] as indices of points, "data" by name: TEMPERATURE and RISE [n] K, "body"."""
    piece = xml.etree.ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
    cells = {a.get("Name"): read_array(a) for a in piece.iterfind("Cells/DataArray")}
    if not np.all(cells["types"] == 9):
        raise ValueError(f"{file} has cells that are no quadrilaterals")
    return {
        "points": read_array(piece.find("Points/DataArray")),
        "quads": cells["connectivity"].reshape(-1, 4),
        "data": {a.get("Name"): read_array(a) for part in ("PointData", "CellData") for a in piece.iterfind(f"{part}/DataArray")},
    }


def read_series(pvd):
    """Pairs of time [s] and file that a list of fields (.pvd) names."""
    pvd = pathlib.Path(pvd)
    root = xml.etree.ElementTree.parse(pvd).getroot()
    return [(float(e.get("timestep")), pvd.parent / e.get("file")) for e in root.iterfind("Collection/DataSet")]

"""Results for MATLAB and Octave."""

from __future__ import annotations

import collections
import math
import os
import re
import typing

from . import series

if typing.TYPE_CHECKING:
    from .result import Result


def field(name: str) -> str:
    """A name that MATLAB takes for a field: "spin-up_centres" is spin_up_centres."""
    word = re.sub(r"\W", "_", name)
    return word if word[0].isalpha() else "x" + word


class Fields(dict[str, str]):
    """Fields of a structure by their names, all different: of "A-B" and "A_B" the second one is A_B_2."""

    def __init__(self, taken: typing.Iterable[str] = ()) -> None:
        super().__init__()
        self._taken = set(taken)

    def __missing__(self, name: str) -> str:
        word = first = field(name)
        n = 1
        while word in self._taken:
            n += 1
            word = f"{first}_{n}"
        self._taken.add(word)
        self[name] = word
        return word


OWN = ("units", "columns", "summary")  # fields of the results beside those of their series


class Paths:
    """Fields of series by their paths, the same in every structure."""

    def __init__(self) -> None:
        self._fields = collections.defaultdict[str, Fields](Fields, {"": Fields(OWN)})

    def put(self, tree: dict[str, typing.Any], path: str, value: typing.Any) -> None:
        *above, last = self.words(path)
        for word in above:
            tree = tree.setdefault(word, {})
        tree[last] = value

    def words(self, path: str) -> list[str]:
        above, _, last = path.rpartition("/")
        return [*(self.words(above) if above else []), self._fields[above][last]]


def structure(value: typing.Any) -> typing.Any:
    """A part of the summary: no number is NaN, lists are cells."""
    import numpy as np

    if isinstance(value, dict):
        fields = Fields()
        return {fields[key]: structure(inner) for key, inner in value.items()}
    if isinstance(value, list):
        if value and all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in value):
            return np.array(value, dtype=float)
        cells = np.empty(len(value), dtype=object)
        for i, one in enumerate(value):
            cells[i] = structure(one)
        return cells
    return float("nan") if value is None else value


def write(result: Result, file: str | os.PathLike[str]) -> None:
    """What Result.to_mat() does."""
    import numpy as np

    try:
        import scipy.io
    except ImportError as error:
        raise ImportError("to_mat needs scipy (Debian: python3-scipy)") from error
    tree: dict[str, typing.Any] = {}
    units: dict[str, typing.Any] = {}
    columns: dict[str, typing.Any] = {}
    paths = Paths()
    for path in result.recorded.datasets:
        one = series.table(result.recorded, path)
        name = path.strip("/")
        paths.put(tree, name, one.values.reshape(len(one.values), math.prod(one.values.shape[1:])))
        paths.put(units, name, one.unit)
        if one.columns:
            paths.put(columns, name, np.array(one.columns, dtype=object))
    tree["units"], tree["columns"] = units, columns
    if result.has_summary:
        tree["summary"] = structure(result.summary)
    scipy.io.savemat(os.fspath(file), {"results": tree}, do_compression=True, long_field_names=True, oned_as="column")

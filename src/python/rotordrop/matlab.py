"""Results for MATLAB and Octave."""

from __future__ import annotations

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


def put(tree: dict[str, typing.Any], words: list[str], value: typing.Any) -> None:
    for word in words[:-1]:
        tree = tree.setdefault(field(word), {})
    tree[field(words[-1])] = value


def structure(value: typing.Any) -> typing.Any:
    """A part of the summary: no number is NaN, lists are cells."""
    import numpy as np

    if isinstance(value, dict):
        return {field(key): structure(inner) for key, inner in value.items()}
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
    for path in result.recorded.datasets:
        one = series.table(result.recorded, path)
        words = path.strip("/").split("/")
        put(tree, words, np.array(one.values).reshape(len(one.values), -1))
        put(units, words, one.unit)
        if one.columns:
            put(columns, words, np.array(one.columns, dtype=object))
    tree["units"], tree["columns"] = units, columns
    if result.completed:
        tree["summary"] = structure(result.summary)
    scipy.io.savemat(os.fspath(file), {"results": tree}, do_compression=True, long_field_names=True, oned_as="column")

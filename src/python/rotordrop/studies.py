"""Studies: many drops of one case."""

from __future__ import annotations

import functools
import json
import numbers
import os
import pathlib
import re
import typing
from collections.abc import Callable, Mapping

from . import _core
from .errors import InputError, SolverError, refused, warn_of

if typing.TYPE_CHECKING:
    import pandas

StudyProgress = _core.StudyProgress
"""Progress of a study: `done`, `failed`, `total` drops, `per_second`, `time_left` [s]; `making` names the surrogate that is made, once all drops are finished."""


def _toml(value: typing.Any) -> str:
    """A value as --set takes it."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(name)} = {_toml(one)}" for name, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(one) for one in value) + "]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)


def _settings(overrides: Mapping[str, typing.Any]) -> list[str]:
    """Overrides as words of --set."""
    for key, value in overrides.items():
        if value is None:
            raise refused("overrides", f"{key} is None; leave it out")
    return [f"{key}={_toml(value)}" for key, value in overrides.items()]


class StudyResult:
    """A study that has run.

    directory   where its files are
    notes       what the command would have said meanwhile, such as why drops do not run in lanes; empty for one that was read
    """

    def __init__(self, directory: pathlib.Path, notes: tuple[str, ...] = ()) -> None:
        self.directory = directory.absolute()
        self.notes = notes

    def __repr__(self) -> str:
        return f"<rotordrop.StudyResult in {self.directory}>"

    @functools.cached_property
    def summary(self) -> dict[str, typing.Any]:
        """What the points say together, as study.json: quantiles, probabilities, indices with their intervals (docs/how-to/studies.md)."""
        file = self.directory / "study.json"
        if not file.is_file():
            raise FileNotFoundError(f"{self.directory} holds no study.json: give the directory of a study that is complete")
        try:
            summary = json.loads(file.read_text(encoding="utf-8"))
        except ValueError:
            summary = None
        if not isinstance(summary, dict) or "program" not in summary:
            raise InputError(f"error: {file}: this is not what the program wrote.\n       Finish the study once more with resume=True, or run it again.")
        return typing.cast(dict[str, typing.Any], summary)

    @functools.cached_property
    def table(self) -> pandas.DataFrame:
        """All points, one in each row: status (0 done, 1 failed, 2 not run), parameters and results in SI; NaN: it has not happened."""
        import pandas

        return pandas.read_csv(self.directory / "study.csv", index_col="point", float_precision="round_trip")

    def report(self, file: str | os.PathLike[str] | None = None) -> pathlib.Path:
        """Writes the study's HTML page; default: report.html in its directory. InputError for a file that is no page of the program: it is left alone."""
        path = pathlib.Path(file) if file is not None else self.directory / "report.html"
        _core.write_study_report(self.directory, path)
        return path


def study(
    file: str | os.PathLike[str],
    directory: str | os.PathLike[str],
    overrides: Mapping[str, typing.Any] | None = None,
    *,
    jobs: int = 0,
    progress: Callable[[StudyProgress], object] | None = None,
    force: bool = False,
    resume: bool = False,
) -> StudyResult:
    """Runs a study, as `rotordrop study` does: in threads, without a folder for each drop.

    file        study file (docs/how-to/studies.md)
    directory   for study.h5, study.csv, study.json and the journal
    overrides   parameters of the case in every drop
    jobs        drops at the same time; 0: one per core
    progress    called five times a second with a StudyProgress; what it raises ends the study, and so does Ctrl-C: `resume=True` continues it
    force       replaces results that are in the directory

    What the case or one of its points has that is allowed but unusual is a CaseWarning, before the first drop. InputError for a wrong study, with the first points that are no valid cases. SolverError if it stopped after a failed drop, as on_failure = "stop" asks.
    """
    if not isinstance(jobs, numbers.Integral) or isinstance(jobs, bool):
        raise refused("jobs", f"must be a whole number and is {jobs!r}")
    if jobs < 0:
        raise refused("jobs", f"must be at least 0 and is {jobs}")
    if not os.fspath(directory):
        raise refused("directory", "is empty; give a name, or \".\" for the working folder")
    told = _core.run_study(pathlib.Path(file), _settings(overrides or {}), pathlib.Path(directory), jobs, force, resume, progress, warn_of)
    if not told["complete"]:
        raise SolverError(f"stopped after a failed drop, for on_failure = \"stop\"; its reason is in {pathlib.Path(directory) / 'study.journal'}")
    return StudyResult(pathlib.Path(directory), tuple(told["notes"]))


def read_study(directory: str | os.PathLike[str]) -> StudyResult:
    """The result of a complete study from its directory. InputError if its study.json is damaged."""
    result = StudyResult(pathlib.Path(directory))
    result.summary  # noqa: B018  says what is missing
    return result

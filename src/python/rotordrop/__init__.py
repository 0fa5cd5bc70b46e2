"""Drops of magnetically levitated rotors onto touchdown bearings, in memory.

    import rotordrop as rd

    case = rd.Case("params/neisi2019-settling.toml", {"contact.friction_coefficient": 0.05})
    result = case.run()
    print(result.summary["bearings"]["TB1"]["peak_contact_force"])     # [N]
    print(result.series["bearings.TB1.contact_force"].max())           # xarray, with its unit

All numbers are SI, angles are in rad, temperatures are absolute [K]. Where a case takes a number, a text with a unit does, too: "15200 rpm".
"""

from . import _files  # noqa: F401  first: where cases and modules are
from ._core import git_revision, version as __version__
from .case import Case, Progress
from .comparison import compare
from .errors import CaseWarning, Error, Fault, InputError, SolverError
from .parts import (
    Expansion,
    HeatInput,
    Quantity,
    Series,
    State,
    Support,
    SupportInput,
    SupportResponse,
    ThermalBearing,
    ThermalModel,
    add_support,
    add_thermal_model,
)
from .preload import Preload
from .result import Result, read
from .studies import StudyProgress, StudyResult, read_study, study
from .units import params_folder, si

__all__ = [
    "Case",
    "CaseWarning",
    "Error",
    "Expansion",
    "Fault",
    "HeatInput",
    "InputError",
    "Preload",
    "Progress",
    "Quantity",
    "Result",
    "Series",
    "SolverError",
    "State",
    "StudyProgress",
    "StudyResult",
    "Support",
    "SupportInput",
    "SupportResponse",
    "ThermalBearing",
    "ThermalModel",
    "__version__",
    "add_support",
    "add_thermal_model",
    "compare",
    "git_revision",
    "params_folder",
    "read",
    "read_study",
    "si",
    "study",
]

"""Tells the compiled part where the cases and the finite-element modules are: inside the package (a wheel), in the build folder, or as installed."""

import pathlib

from . import _core

_package = pathlib.Path(__file__).resolve().parent


def _first(*folders: pathlib.Path) -> str:
    """The first one that exists; empty if none does: then the program's own rule holds."""
    return next((str(folder) for folder in folders if folder.is_dir()), "")


def _set_folders() -> None:
    params = _first(_package / "params", *(folder / _core.relative_data / "params" for folder in _package.parents))
    build = _package.parent.parent  # BUILD/python/rotordrop
    modules = _first(_package / "modules", *(folder / _core.relative_modules for folder in _package.parents))
    if (build / "rotordrop_fe.so").is_file():
        modules, params = str(build), ""
    _core.set_program_folders(params, modules)


_set_folders()

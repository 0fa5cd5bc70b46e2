"""Natural modes as a data set."""

from __future__ import annotations

import typing

from . import _core

if typing.TYPE_CHECKING:
    import xarray


def dataset(case: _core.Case, speeds: list[float], n_modes: int) -> xarray.Dataset:
    """What Case.modes() returns. @param speeds [rad/s]"""
    import numpy as np
    import xarray

    found = _core.modes(case, speeds, n_modes)
    x = found["node_positions"]
    n = max((len(one["modes"]) for one in found["speeds"]), default=0)
    numbers = {name: np.full((len(speeds), n), np.nan) for name in ("frequency", "natural_frequency", "damping_ratio")}
    whirl = np.full((len(speeds), n), "", dtype="<U8")
    shape = np.full((len(speeds), n, 2, len(x)), np.nan, dtype=complex)
    for i, one in enumerate(found["speeds"]):
        for k, mode in enumerate(one["modes"]):
            for name, values in numbers.items():
                values[i, k] = mode[name]
            whirl[i, k] = mode["whirl"]
            shape[i, k] = mode["shape"]
    at = ("speed", "mode")
    return xarray.Dataset(
        {
            "frequency": (at, numbers["frequency"], {"units": "Hz", "long_name": "damped natural frequency"}),
            "natural_frequency": (at, numbers["natural_frequency"], {"units": "Hz", "long_name": "undamped natural frequency"}),
            "damping_ratio": (at, numbers["damping_ratio"], {"units": "1", "long_name": "damping ratio"}),
            "whirl": (at, whirl, {"long_name": "direction of whirl"}),
            "shape": ((*at, "axis", "node"), shape, {"units": "1", "long_name": "deflection; the largest amplitude is 1"}),
            "rigid_body_modes": ("speed", [one["rigid_body_modes"] for one in found["speeds"]], {"units": "1", "long_name": "motions without restoring force, not among the modes"}),
            "overdamped_modes": ("speed", [one["overdamped_modes"] for one in found["speeds"]], {"units": "1", "long_name": "motions that creep back without oscillation, not among the modes"}),
            "diverging_modes": ("speed", [one["diverging_modes"] for one in found["speeds"]], {"units": "1", "long_name": "motions that move away without oscillation, not among the modes"}),
            "divergence_rate": ("speed", [one["divergence_rate"] for one in found["speeds"]], {"units": "1/s", "long_name": "growth rate of the fastest diverging motion"}),
        },
        coords={
            "speed": ("speed", speeds, {"units": "rad/s", "long_name": "spin speed of the rotor"}),
            "mode": ("mode", np.arange(1, n + 1)),
            "axis": ("axis", ["y", "z"]),
            "node": ("node", x, {"units": "m", "long_name": "axial position of the nodes"}),
        },
        attrs={"supports": found["supports"], "left_out": found["left_out"]},
    )

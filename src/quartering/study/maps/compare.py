"""Two maps over the same conditions, side by side: how much more the second rolls, and where the verdict changes."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Final

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.stability.kind import Kind

AXES: Final = ("speed", "heading", "wave_length")
_BOTH = ("roll_peak", "exponent", "verdict", "status")


class Change(IntEnum):
    """What a condition becomes from the first map to the second."""

    NONE = 0
    UNSTABLE = 1
    STABLE = 2
    UNKNOWN = 3


def map_difference(maps: Sequence[xr.Dataset], labels: Sequence[str]) -> xr.Dataset:
    """Two maps of `polar` along ``ship``, with ``roll_difference`` [deg], second less first, and ``change`` (`Change`).

    Course instability of calm water counts as stable here: no wave makes it.
    """
    first, second = maps
    for name in (*AXES, "wave_height"):
        if not np.array_equal(first[name].values, second[name].values):
            raise InputError(f"the two maps differ in their {name}; compare maps over the same conditions")
    both = xr.concat([one[list(_BOTH)] for one in maps], xr.Variable("ship", list(labels)), combine_attrs="drop")
    bad = [(one["verdict"] > int(Kind.STABLE)) & (one["verdict"] != int(Kind.COURSE_IN_CALM_WATER)) for one in maps]
    unknown = (first["verdict"] == int(Kind.NO_ANSWER)) | (second["verdict"] == int(Kind.NO_ANSWER))
    change = xr.zeros_like(first["verdict"], dtype=np.int8)
    change = change.where(~(bad[1] & ~bad[0]), int(Change.UNSTABLE)).where(~(bad[0] & ~bad[1]), int(Change.STABLE))
    change = change.where(~unknown, int(Change.UNKNOWN))
    meanings = {"flag_values": np.array(list(Change), np.int8), "flag_meanings": "none unstable stable unknown"}
    more = {"units": "deg", "long_name": "largest roll over a cycle, second ship less first"}
    return both.assign(
        roll_difference=(second["roll_peak"] - first["roll_peak"]).drop_attrs().assign_attrs(more),
        change=change.drop_attrs().assign_attrs(meanings | {"units": "1", "long_name": "what the condition becomes"}),
    ).assign_attrs({key: first.attrs[key] for key in ("Conventions", "source", "steady_motion", "diffraction_form")})

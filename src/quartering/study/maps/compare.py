"""Two maps over the same conditions, side by side: how much more the second rolls, and where the verdict changes."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Final

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.stability.kind import Kind
from quartering.study.maps.query import capsizing

AXES: Final = ("speed", "heading", "wave_length")
_BOTH = ("roll_peak", "exponent", "verdict", "status")


class Change(IntEnum):
    """What a condition becomes from the first map to the second."""

    NONE = 0
    UNSTABLE = 1
    STABLE = 2
    UNKNOWN = 3


class OnlyOne(IntEnum):
    """Which of two ships alone capsizes on the way to its stable motion."""

    NEITHER = 0
    SECOND = 1
    FIRST = 2


def map_difference(maps: Sequence[xr.Dataset], labels: Sequence[str]) -> xr.Dataset:
    """Two maps of `polar` along ``ship``, with what differs.

    That is ``roll_difference`` [deg], second less first, ``change`` (`Change`) and ``only_one_capsizes`` (`OnlyOne`). Course
    instability of calm water counts as stable here: no wave makes it.
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
    lost = [capsizing(one) for one in maps]
    only = xr.zeros_like(first["verdict"], dtype=np.int8)
    only = only.where(~(lost[1] & ~lost[0]), int(OnlyOne.SECOND)).where(~(lost[0] & ~lost[1]), int(OnlyOne.FIRST))
    which = {"flag_values": np.array(list(OnlyOne), np.int8), "flag_meanings": "neither_or_both second first"}
    more = {"units": "deg", "long_name": "largest roll over a cycle, second ship less first"}
    return both.assign(
        roll_difference=(second["roll_peak"] - first["roll_peak"]).drop_attrs().assign_attrs(more),
        change=change.drop_attrs().assign_attrs(meanings | {"units": "1", "long_name": "what the condition becomes"}),
        only_one_capsizes=only.drop_attrs().assign_attrs(
            which | {"units": "1", "long_name": "which ship alone capsizes on the way to its stable motion"}
        ),
    ).assign_attrs({key: first.attrs[key] for key in ("Conventions", "source", "steady_motion", "diffraction_form")})

"""The paper's curves: response (Figs. 5-10), effect of loading (14-21), of coefficients (22)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.study.loadings import LOADING_AXES
from quartering.study.maps.polar import polar
from quartering.study.maps.sweep import sweep
from quartering.study.paper.conditions import FINE_HEADINGS, FROUDE, HEADINGS, RATIOS, speed_of, wave_of


def response_curves(
    ship: Ship, ratios: Sequence[float] = RATIOS, headings: ArrayLike = HEADINGS, froude: float = FROUDE
) -> xr.Dataset:
    """Response over heading for several wave lengths of one steepness.

    ratios (w,): wave lengths over the ship's
    headings (h,): [deg]
    Returns of `polar` at the one speed: (heading, wave_length)

    Source: [H71] Figs. 5-10.
    """
    waves = [wave_of(ship, ratio) for ratio in ratios]
    return polar(ship, waves, [speed_of(ship, froude)], headings).isel(speed=0)


def loading_curves(
    ship: Ship,
    name: str,
    values: Sequence[float],
    headings: ArrayLike = FINE_HEADINGS,
    froude: float = FROUDE,
    ratio: float = 1.0,
) -> xr.Dataset:
    """Response and stability over heading for several values of one loading quantity.

    name: "gm", "gyradius_roll" or "gyradius_yaw" (or another loading axis of `sweep`)
    values (l,): [m]
    headings (h,): [deg]
    ratio: wave length over ship length
    Returns of `sweep` in one wave: (loading, heading); coordinate ``name`` along loading

    Source: [H71] Figs. 14-21.
    """
    if name not in LOADING_AXES:
        raise InputError(f"{name!r} is not a loading quantity; allowed are {', '.join(LOADING_AXES)}")
    wave = wave_of(ship, ratio)
    axes: dict[str, Any] = {name: values}
    found = sweep(ship, speed_of(ship, froude), headings, wave.length, wave.height, **axes)
    return found.isel(speed=0, wave_length=0, wave_height=0)


def coefficient_curves(
    ship: Ship, names: Sequence[str], changes: ArrayLike, wave: Wave, speed: float, heading: float
) -> xr.Dataset:
    """Stability against the change of one coefficient at a time.

    names: coefficients, such as "K_ppp"
    changes (c,): of the coefficient [%]: -100 takes it away, 100 doubles it
    speed, heading: [m/s, deg]
    Returns results of `sweep` over (coefficient, change)

    The steady motion is found anew for each value.  Source: [H71] Fig. 22.
    """
    percent = np.atleast_1d(np.asarray(changes, dtype=float))
    parts = []
    for name in names:
        axes: dict[str, Any] = {name: 1.0 + percent / 100.0}
        found = sweep(ship, speed, heading, wave.length, wave.height, **axes)
        one = found.isel(speed=0, heading=0, wave_length=0, wave_height=0).drop_vars(name)
        parts.append(one.rename(loading="change").assign_coords(change=percent))
    joined = xr.concat(parts, xr.DataArray(list(names), dims="coefficient", name="coefficient"))
    joined["change"].attrs.update(units="%", long_name="change of the coefficient")
    return joined

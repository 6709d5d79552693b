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

    Parameters
    ----------
    ship : Ship
    ratios : (w,) float      wave lengths over the ship's
    headings : (h,) float    [deg]
    froude : float

    Returns
    -------
    xarray.Dataset           of `polar` at the one speed: (heading, wave_length)

    Notes
    -----
    Source: [H71] Figs. 5-10.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> response_curves(ship("wigley"), [1.0], [30.0, 60.0])["roll"].dims
    ('heading', 'wave_length')
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

    Parameters
    ----------
    ship : Ship
    name : str               "gm", "gyradius_roll" or "gyradius_yaw" (or another loading axis of `sweep`)
    values : (l,) float      [m]
    headings : (h,) float    [deg]
    froude : float
    ratio : float            wave length over ship length

    Returns
    -------
    xarray.Dataset           of `sweep` in one wave: (loading, heading); coordinate ``name`` along loading

    Raises
    ------
    InputError               not a loading quantity

    Notes
    -----
    Source: [H71] Figs. 14-21.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> loading_curves(ship("wigley"), "gm", [1.0, 1.4], [30.0, 60.0])["k2"].dims
    ('loading', 'heading')
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

    Parameters
    ----------
    ship : Ship
    names : sequence of str    coefficients, such as "K_ppp"
    changes : (c,) float       of the coefficient [%]: -100 takes it away, 100 doubles it
    wave : Wave
    speed, heading : float     [m/s, deg]

    Returns
    -------
    xarray.Dataset             results of `sweep` over (coefficient, change)

    Raises
    ------
    InputError                 what `sweep` refuses

    Notes
    -----
    The steady motion is found anew for each value.  Source: [H71] Fig. 22.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = coefficient_curves(ship("wigley"), ["K_p"], [-50.0, 0.0], Wave(100.0, 1.0), 5.0, 60.0)
    >>> bool(found["k2"][0, 0] > found["k2"][0, 1])    # less roll damping: K2 nearer to instability
    True
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

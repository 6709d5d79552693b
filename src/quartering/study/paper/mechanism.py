"""What makes roll unstable: the uncoupled ship, a table of changed coefficients taken so far, the smallest change that does."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.hull.righting.arm import fitted_to
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.loads.waves import Wave
from quartering.motion.equations.system import acceleration_form
from quartering.motion.equations.terms import term_table
from quartering.motion.of_ship import ShipSystem, nonlinear_terms, ship_system
from quartering.names import term
from quartering.stability.kind import Kind
from quartering.study.conditions import judged
from quartering.study.effects.vary import ACCURACY, refined_flips
from quartering.study.grid import Grid, axis, grid
from quartering.study.maps.sweep import evaluated

Floats = NDArray[np.float64]
FED_BY_SWAY_AND_YAW: Final = ("K_prr", "K_pvv", "K_vrr", "K_vpp", "K_vvv", "K_rpp", "K_rvv", "K_vpr", "K_rrr", "K_ppp")
"""The cubics of the roll equation: all that K2 is made of besides the linear damping."""

_STEP = 0.05
_ROUNDS = 24


def roll_alone(ship: Ship, wave: Wave, speed: float, heading: ArrayLike, *, harmonics: int = 1) -> xr.Dataset:
    """Roll and its stability with sway and yaw held: [H71]'s uncoupled roll.

    speed: [m/s]
    heading (h,): [deg]
    harmonics: of the steady motion
    Returns over ``heading``: ``roll`` [deg], ``exponent`` [1/s], the larger of the two of roll, ``verdict``

    The roll row of the equations alone, with its own inertia, K_p, K_ppp and the whole righting moment.  In the place of sway
    and yaw stand two motions that die out at the rate omega, so that they never decide.  Source: [H71] K2 of uncoupled roll.
    """
    headings = axis("heading", heading)
    many = np.ones(headings.size)
    at = ship_system(ship, wave.wavenumber * many, speed * many, headings)
    height = wave.height * many[:, None]
    found = judged(_uncoupled(at), height, harmonics, capsize_limit(ship).angle)
    names = {"roll": "deg", "n2": "rad/s", "exponent": "1/s", "verdict": "1"}
    return xr.Dataset(
        {name: ("heading", np.asarray(found[name]), {"units": unit}) for name, unit in names.items()},
        {"heading": headings},
    )


def _uncoupled(at: ShipSystem) -> ShipSystem:
    """The equations with the roll row alone."""
    c, omega = at.coefficients, np.abs(at.encounter_frequency)
    inertia = c.inertia * np.eye(3)
    linear = np.zeros((omega.size, 3, 4))
    linear[:, 0, 0], linear[:, 2, 3] = -omega * inertia[:, 0, 0], -omega * inertia[:, 2, 2]
    linear[:, 1, 2] = c.linear[:, 1, 1]
    own = {
        name: v for name, v in nonlinear_terms(c).items() if name[0] == "K" and set(term(name).factors) <= {"p", "phi"}
    }
    table = term_table(own)
    cos, sin = (np.einsum("nij,nj->ni", c.inertia, part) * [0.0, 1.0, 0.0] for part in (at.system.cos, at.system.sin))
    frequency = np.where(at.slow, np.nan, omega)
    system = acceleration_form(
        inertia, table, frequency, (cos, sin, 0.0), linear=linear + table.linear, restoring=c.righting
    )
    return replace(at, system=system)


class Onset(NamedTuple):
    """Where, as coefficients are changed further and further, a first motion becomes unstable.

    Parameters
    ----------
    strength : float    multiple of the change; NaN when no motion became unstable
    heading : float     of that motion [deg]
    kind : str          of the instability
    roll : float        its roll amplitude [deg]
    """

    strength: float
    heading: float
    kind: str
    roll: float


def onset(
    ship: Ship,
    change: Mapping[str, float],
    wave: Wave,
    speed: float,
    heading: ArrayLike,
    *,
    most: float = 10.0,
    harmonics: int = 5,
) -> Onset:
    """How many times a change of coefficients must be made until a motion at some heading is unstable.

    change: factor of each coefficient at strength 1; at strength s it is 1 + s (factor - 1)
    speed: [m/s]
    heading (h,): [deg]
    most: largest strength tried
    harmonics: of the steady motion

    Strengths are tried in steps of a fortieth of `most`, then refined.  Two kinds of motion do not count: those of a ship that
    is course-unstable in calm water, and those that roll beyond the fit of the righting arm, whose verdict is extrapolated.
    Source: [H71] Table I.
    """
    if not change or not most > 0:
        raise InputError("give at least one coefficient and its factor, and a largest strength above 0")
    one = grid(ship, speed, heading, wave.length, wave.height, harmonics=harmonics)
    fitted = fitted_to(ship)

    def at(strength: Floats) -> xr.Dataset:
        return _quietly(one, {name: 1 + strength * (factor - 1) for name, factor in change.items()})

    def anywhere(strength: Floats) -> NDArray[np.int8]:
        return np.asarray(_unstable(at(strength), fitted).any(axis=1), np.int8)

    strengths = np.linspace(0.0, most, 41)
    ds = at(strengths)
    unstable = _unstable(ds, fitted)
    if not unstable.any():
        return Onset(float("nan"), float("nan"), "stable", float("nan"))
    i = int(np.flatnonzero(unstable.any(axis=1))[0])
    if i > 0:
        ((refined, _, _),) = refined_flips(anywhere, strengths[i - 1 : i + 1], [0, 1])
        beyond = (strengths[1] - strengths[0]) * ACCURACY  # the middle of the last step is given: go past its end
        past = at(np.array([refined + beyond]))
        if _unstable(past, fitted).any():  # else a window narrower than the accuracy: the one of the steps is given
            strengths, i, ds, unstable = np.array([refined + beyond]), 0, past, _unstable(past, fitted)
    j = int(np.flatnonzero(unstable[i])[0])
    here = ds.isel(loading=i, heading=j)
    return Onset(float(strengths[i]), float(here["heading"]), Kind(int(here["verdict"])).label, float(here["roll"]))


def smallest_change(
    ship: Ship, wave: Wave, speed: float, heading: float, names: Sequence[str] = FED_BY_SWAY_AND_YAW
) -> dict[str, float]:
    """The smallest set of changes of coefficients that brings the roll of one motion to the edge of stability.

    speed: [m/s]
    heading: [deg]
    names: coefficients that may change
    Returns factor of each, those that change most first; empty when the search does not end

    Smallest: sum of (factor - 1)^2, so each change counts in multiples of the present value.  The growth rate of roll by first
    order, K2/(2 n2), is a smooth function g of the factors; each round goes from the origin along its gradient to the plane on
    which its linear expansion about the present point vanishes, x' = (grad g . x - g) grad g / |grad g|^2.  What first order
    finds is confirmed by Floquet multipliers elsewhere.  Source: [HL74], the search for the point of failure nearest to the
    mean.
    """
    one = grid(ship, speed, heading, wave.length, wave.height, harmonics=3)
    if not float(_growth(one, names, np.zeros((1, len(names))))[0]) < 0:
        raise InputError("the motion is unstable as it is, or there is none; there is nothing to look for")
    x = np.zeros(len(names))
    for i in range(_ROUNDS):
        g = _growth(one, names, x + _STEP * np.concatenate([[0 * x], np.eye(x.size), -np.eye(x.size)]))
        slope = (g[1 : x.size + 1] - g[x.size + 1 :]) / (2 * _STEP)
        if not np.isfinite(g).all() or not slope.any():
            return {}
        before, x = x, (slope @ x - g[0]) * slope / (slope @ slope)
        x = x if i < _ROUNDS // 3 else (x + before) / 2  # a boundary that bends makes whole steps swing to and fro
        if np.abs(x - before).max() < 1e-3 * np.abs(x).max():
            return {names[j]: float(1 + x[j]) for j in np.argsort(-np.abs(x))}
    return {}


def _growth(one: Grid, names: Sequence[str], changes: Floats) -> Floats:
    """Growth rate of roll K2/(2 n2) [1/s] with each set of relative changes (m, names)."""
    ds = _quietly(one, {name: 1 + changes[:, i] for i, name in enumerate(names)})
    return np.asarray(-ds["index"].values[:, 0])


def _quietly(one: Grid, columns: Mapping[str, Floats]) -> xr.Dataset:
    """Results over loading and heading; the search goes far from the ship asked about."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        ds = evaluated(replace(one, loadings=dict(columns)))
    return ds.isel(speed=0, wave_length=0, wave_height=0)


def _unstable(ds: xr.Dataset, fitted: float) -> NDArray[np.bool_]:
    """Motions the wave makes unstable, within the roll angles for which the righting arm is known."""
    kinds = ds["verdict"].values
    by_the_wave = (kinds > Kind.STABLE) & (kinds != Kind.COURSE_IN_CALM_WATER)
    return np.asarray(by_the_wave & (ds["roll_peak"].values <= fitted))

"""A ship that floats on a frozen wave: heave and trim at which it carries its weight without a pitching moment."""

from __future__ import annotations

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner, kernel
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.loads.wetted_hull.pressure import PIECES, Waves, WettedHull, direct_load, direct_loads, wetted_hull
from quartering.loads.wetted_hull.section_tables import (
    SectionTables,
    section_tables,
    table_load,
    table_loads,
    table_room,
)

HEAVE, TRIM = 1, 2
"""What a balance solves for: heave alone, or heave and trim; 0 solves for nothing."""
_ITERATIONS: Final = 30
_STEPS: Final = (0.3, 0.05)
"""Longest Newton steps: in heave, of the draught, and in trim [rad]."""
_TOLERANCE: Final = 1e-10


class FloatingHull(NamedTuple):
    """The wetted hull of a ship about its own G, with what it displaces.

    Parameters
    ----------
    hull : WettedHull     about G, which lies over the centre of buoyancy of these very polygons and GM below their metacentre
    volume : float        displaced in calm water [m3]
    x_g : float           G from midship, + forward [m]
    length, draught : float    of the ship [m]
    """

    hull: WettedHull
    volume: float
    x_g: float
    length: float
    draught: float


@lru_cache(maxsize=64)
def floating_hull(ship: Ship, pieces: int = PIECES) -> FloatingHull:
    """Wetted hull of a ship about its G.

    pieces: straight pieces, at least, of half a smooth section

    The polygons are those of `righting_arm`: upright in calm water the ship floats without trim, with its GM.
    """
    hull = wetted_hull(ship.hull, pieces)
    loads, jacobian = direct_loads(hull, np.zeros((1, 3)), Waves(*np.zeros((4, 1))))
    volume = -float(loads[0, 2])
    x_g, gm_at_plane = float(loads[0, 4]) / volume, -float(jacobian[0, 3, 1]) / volume
    about = hull.about(x_g, gm_at_plane - ship.loading.gm)
    return FloatingHull(about, volume, x_g, ship.hull.length, ship.hull.draught)


@lru_cache(maxsize=16)
def floating_tables(ship: Ship, wavenumber: float = 0.0) -> tuple[SectionTables, float]:
    """Tables of a ship's sections about the G at which they float without trim and have its GM, and their volume.

    wavenumber: of the pressure that decays with depth; 0: hydrostatic [1/m]
    Returns [m3]

    >>> from quartering.hull.file.read import ship
    >>> round(floating_tables(ship("box"))[1], 3)
    10000.0
    """
    tables = section_tables(ship.hull, wavenumber)
    loads, jacobian = table_loads(tables, np.zeros((1, 3)), Waves(*np.zeros((4, 1))))
    volume = -float(loads[0, 2])
    height = -float(jacobian[0, 3, 1]) / volume - ship.loading.gm
    return tables.about(float(loads[0, 4]) / volume, height), volume


class Balance(NamedTuple):
    """Balanced states of n conditions.

    Parameters
    ----------
    heave, pitch : (n,) float    of G, + down [m]; + bow up [rad]
    arm, slope : (n,) float      GZ = -K/W [m] and its derivative by heel, heave and trim following [m]
    found : (n,) bool            does it balance?
    """

    heave: Floats
    pitch: Floats
    arm: Floats
    slope: Floats
    found: NDArray[np.bool_]


def balanced(
    floats: FloatingHull,
    roll: Floats,
    waves: Waves,
    solved: int,
    start: Floats,
    smith: bool = False,
    tables: SectionTables | None = None,
) -> Balance:
    """Balance of a ship at given heel angles on frozen waves.

    roll (n,): heel, + starboard down [rad]
    waves: (n,)
    solved: `TRIM`, `HEAVE`, or 0 for none: heave and pitch are then those of ``start``
    start (n, 2): heave [m] and pitch [rad]; where something is solved for, of the first row, the others starting from
        the row before
    smith: the pressure of the wave decays with depth

    >>> from quartering.hull.file.read import ship
    >>> box, calm = floating_hull(ship("box")), Waves(*np.zeros((4, 1)))
    >>> round(float(balanced(box, np.zeros(1), calm, TRIM, np.zeros((1, 2))).slope[0]), 9)
    1.0
    """
    packed = np.array([np.broadcast_to(part, len(roll)) for part in waves]).T.copy()
    out = np.full((4, len(roll)), np.nan)
    found = np.zeros(len(roll), dtype=np.bool_)
    limits = (_STEPS[0] * floats.draught, _STEPS[1])
    scale = (_TOLERANCE * floats.volume, _TOLERANCE * floats.volume * floats.length)
    if tables is not None:
        _balance_by_table(*tables, floats.volume, roll, packed, solved, start, limits, scale, out, found)
        return Balance(out[0], out[1], out[2], out[3], found)
    _balance(*floats.hull, floats.volume, roll, packed, solved, start, limits, scale, smith, out, found)
    return Balance(out[0], out[1], out[2], out[3], found)


@kernel
def _balance(x, weight, points, y, z, z0, volume, roll, waves, solved, start, limits, scale, smith, out, found):  # type: ignore[no-untyped-def]
    """Balances by the pressure itself, each row from the one before it."""
    scratch = np.empty((7, max(y.shape[1], 8)))
    state, load, jacobian = np.zeros(3), np.empty(6), np.empty((6, 3))
    state[0], state[2] = start[0, 0], start[0, 1]
    for n in range(roll.size):
        _begin(n, roll, solved, start, state)
        for _ in range(_ITERATIONS):
            direct_load(x, weight, points, y, z, z0, state, waves[n], smith, False, scratch, load, jacobian)
            if _stepped(solved, volume, limits, scale, state, load, jacobian):
                break
        _end(n, solved, volume, scale, state, load, jacobian, out, found)
        if not found[n]:
            state[0], state[2] = start[0, 0], start[0, 1]


@kernel
def _balance_by_table(  # type: ignore[no-untyped-def]
    x, weight, z0, k, first, step, spline, volume, roll, waves, solved, start, limits, scale, out, found
):
    """Balances by tables of the sections, each row from the one before it."""
    room = table_room(x.size)
    state, load, jacobian = np.zeros(3), np.empty(6), np.empty((6, 4))
    state[0], state[2] = start[0, 0], start[0, 1]
    for n in range(roll.size):
        _begin(n, roll, solved, start, state)
        for _ in range(_ITERATIONS):
            table_load(x, weight, z0, k, first, step, spline, state, waves[n], room, load, jacobian)
            if _stepped(solved, volume, limits, scale, state, load, jacobian):
                break
        _end(n, solved, volume, scale, state, load, jacobian, out, found)
        if not found[n]:
            state[0], state[2] = start[0, 0], start[0, 1]


@inner
def _begin(n, roll, solved, start, state):  # type: ignore[no-untyped-def]
    """State a row starts from."""
    state[1] = roll[n]
    if solved == 0:
        state[0], state[2] = start[n, 0], start[n, 1]


@inner
def _balances(solved, volume, scale, load):  # type: ignore[no-untyped-def]
    """Does the ship carry its weight, without a pitching moment where trim is solved for?"""
    even = solved != 2 or abs(load[4]) <= scale[1]
    return solved == 0 or (abs(load[2] + volume) <= scale[0] and even)


@inner
def _stepped(solved, volume, limits, scale, state, load, jacobian):  # type: ignore[no-untyped-def]
    """One step of Newton's method for Z = -volume and M = 0; True when there is no more to be done."""
    if _balances(solved, volume, scale, load):
        return True
    f, g = load[2] + volume, load[4] if solved == 2 else 0.0
    zh, zt, mh, mt = jacobian[2, 0], jacobian[2, 2], jacobian[4, 0], jacobian[4, 2]
    if solved == 1:
        zt, mh, mt = 0.0, 0.0, -1.0
    det = zh * mt - zt * mh
    if not abs(det) > 0.0:
        return True
    dh, dt = -(f * mt - zt * g) / det, -(zh * g - mh * f) / det
    shorten = max(1.0, abs(dh) / limits[0], abs(dt) / limits[1])
    state[0] += dh / shorten
    state[2] += dt / shorten
    return not (abs(state[0]) < 100.0 * limits[0] and abs(state[2]) < 1.0)


@inner
def _end(n, solved, volume, scale, state, load, jacobian, out, found):  # type: ignore[no-untyped-def]
    """Heave, pitch, GZ and its slope of a row that balances."""
    found[n] = _balances(solved, volume, scale, load)
    if not found[n]:
        return
    slope = jacobian[3, 1]
    if solved == 1:
        slope -= jacobian[3, 0] * jacobian[2, 1] / jacobian[2, 0]
    elif solved == 2:
        zh, zt, mh, mt = jacobian[2, 0], jacobian[2, 2], jacobian[4, 0], jacobian[4, 2]
        det = zh * mt - zt * mh
        z_roll, m_roll = jacobian[2, 1], jacobian[4, 1]
        slope -= (jacobian[3, 0] * (z_roll * mt - zt * m_roll) + jacobian[3, 2] * (zh * m_roll - mh * z_roll)) / det
    out[0, n], out[1, n] = state[0], state[2]
    out[2, n], out[3, n] = -load[3] / volume, -slope / volume

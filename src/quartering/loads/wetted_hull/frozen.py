"""Loads on a ship that keeps its place on a wave and floats there in heave and trim, by the pressure itself."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.hull.ship import Ship
from quartering.loads.wetted_hull.floating import floating_hull
from quartering.loads.wetted_hull.pressure import Waves, direct_loads

Floats = NDArray[np.float64]

_ITERATIONS: Final = 25
_LONGEST: Final = (0.3, 0.05)
"""Longest Newton steps: in heave, of the draught, and in trim [rad]."""
_STEEPEST: Final = 1.0
"""Trim beyond which nothing is looked for [rad]."""
_TOLERANCE: Final = 1e-9
"""Of the weight, and of weight times length."""


class Frozen(NamedTuple):
    """A ship on n frozen waves.

    Parameters
    ----------
    heave, pitch : (n,) float    of G, + down [m]; + bow up [rad]
    load : (n, 6) float          X, Y, Z, K, M, N about G [N, N m]; Z without the weight
    slope : (n, 6, 3) float      by heave, roll and pitch
    found : (n,) bool            does it balance?
    """

    heave: Floats
    pitch: Floats
    load: Floats
    slope: Floats
    found: NDArray[np.bool_]


def frozen(ship: Ship, waves: Waves, roll: Floats | None = None, start: Floats | None = None) -> Frozen:
    """Heave and trim of a ship on frozen waves, and the loads there.

    waves (n,)
    roll (n,): held [rad]; None: upright
    start (n, 2): heave [m] and pitch [rad] to begin with; None: level

    With the lever of the surge force in pitch and the wave at the true place of a trimmed section: on a long wave the ship
    takes its slope.  Source: Newton's method for Z = weight and M = 0.

    >>> from quartering.hull.file.read import ship
    >>> long = Waves(np.array([1.0]), np.array([1e-3]), np.zeros(1), np.array([0.5 * np.pi]))
    >>> round(float(frozen(ship("wigley"), long).pitch[0] / 1e-3), 2)
    1.0
    """
    floats = floating_hull(ship)
    weight = ship.loading.density * GRAVITY
    n = len(waves.amplitude)
    state = np.zeros((n, 3))
    state[:, 1] = 0.0 if roll is None else roll
    if start is not None:
        state[:, [0, 2]] = start
    longest = np.array([_LONGEST[0] * floats.draught, _LONGEST[1]])
    scale = floats.volume * np.array([1.0, floats.length])
    for _ in range(_ITERATIONS):
        loads, jacobian = direct_loads(floats.hull, state, waves, "smith", exact=True)
        miss = np.stack([loads[:, 2] + floats.volume, loads[:, 4]], axis=1)
        found = np.asarray((np.abs(miss) < _TOLERANCE * scale).all(axis=1))
        if found.all():
            break
        matrix = jacobian[:, [2, 4]][:, :, [0, 2]]
        singular = np.abs(np.linalg.det(matrix)) < 1e-12 * scale.prod()
        matrix[singular] = -np.diag(scale)
        step = -np.linalg.solve(matrix, miss[:, :, None])[..., 0]
        step /= np.maximum(1.0, (np.abs(step) / longest).max(axis=1))[:, None]
        step[found] = 0.0
        state[:, [0, 2]] += step
        state[:, 2] = np.clip(state[:, 2], -_STEEPEST, _STEEPEST)
    return Frozen(state[:, 0].copy(), state[:, 2].copy(), weight * loads, weight * jacobian, found)


def along_following(ship: Ship, wavenumber: float, amplitude: float, positions: int) -> tuple[Floats, Frozen]:
    """A ship at equal steps of its way over a following wave: its places and the loads there.

    wavenumber, amplitude: k > 0 [1/m]; [m]
    positions: how many
    Returns place (n,): k xi, G from a trough the way the wave runs, from -pi on; below 0 the crest is behind [rad]
    """
    place = -np.pi + 2 * np.pi * np.arange(positions) / positions
    ones = np.ones(positions)
    waves = Waves(amplitude * ones, wavenumber * ones, 0 * ones, np.pi - place)
    share = float(np.sinc(wavenumber * ship.hull.length / (2 * np.pi)))  # a long wave carries the ship on its surface
    start = share * amplitude * np.stack([np.cos(place), wavenumber * np.sin(place)], axis=1)
    return place, frozen(ship, waves, start=start)

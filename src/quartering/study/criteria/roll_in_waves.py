"""Largest roll of a ship in regular head and following seas as long as the ship, over heights and speeds."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.hull.ship import Ship
from quartering.motion.steady_course.balance import doubled_harmonics, symmetric_harmonics
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.orbits import climbed
from quartering.stability.parametric import roll_growth
from quartering.study.six_modes.parametric_map import stable_rolls

Floats = NDArray[np.float64]

STEEPNESSES: Final = np.arange(11) / 100
"""Heights of the waves over their length."""
CAPSIZED: Final = 90.0
"""Roll [deg] where small roll grows and no stable motion was found, or heave and pitch have none: a convention."""
_ORDER, _LATERAL, _SAMPLES = 5, 3, 32
"""Harmonics of the encounter in heave and pitch, odd ones of half of it in roll, and samples: roll to about 1 %."""


@lru_cache(maxsize=32)
def largest_rolls(ship: Ship, speeds: tuple[float, ...], heading: float) -> Floats:
    """Largest stable roll [deg] over speeds [m/s] and `STEEPNESSES`, (n, 11), in waves as long as the ship.

    The largest of all stable motions of two periods counts, also where small roll decays beside it. Where the ship keeps pace
    with the wave there is no parametric roll: 0.
    """
    length = ship.hull.length
    amplitudes = STEEPNESSES[1:] * length / 2
    U = np.array(speeds)
    many = course(ship, 2 * math.pi / length, np.full(U.size, amplitudes[0]), U, np.full(U.size, heading))
    orbits = climbed(many, amplitudes, symmetric_harmonics(_ORDER, _SAMPLES))
    growth = roll_growth(orbits, 0.0).growth.reshape(U.size, -1)
    found = np.zeros((U.size, STEEPNESSES.size))
    basis = doubled_harmonics(_ORDER, _LATERAL, _SAMPLES)
    for i in np.flatnonzero(~many.slow):
        stable = stable_rolls(many.rows(np.array([i])), amplitudes, basis)
        unstable = np.where(np.isnan(growth[i]), True, growth[i] > 0)
        found[i, 1:] = np.where(unstable & (stable == 0.0), CAPSIZED, stable)
    return found

"""Largest roll of a ship in regular head and following seas as long as the ship, over heights."""

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


@lru_cache(maxsize=256)
def largest_rolls(ship: Ship, speed: float, heading: float) -> Floats:
    """Largest stable roll [deg] over `STEEPNESSES`, (11,), at a speed [m/s] in waves as long as the ship.

    The largest of all stable motions of two periods counts, also where small roll decays beside it. Where the ship keeps pace
    with the wave there is no parametric roll: 0. Speeds are taken one by one: near that pace a period has so many steps that
    others would have to wait for them.
    """
    length = ship.hull.length
    amplitudes = STEEPNESSES[1:] * length / 2
    one = course(ship, 2 * math.pi / length, amplitudes[:1], np.array([speed]), np.array([heading]))
    found = np.zeros(STEEPNESSES.size)
    if one.slow[0]:
        return found
    orbits = climbed(one, amplitudes, symmetric_harmonics(_ORDER, _SAMPLES))
    growth = roll_growth(orbits, 0.0).growth.ravel()
    stable = stable_rolls(one, amplitudes, doubled_harmonics(_ORDER, _LATERAL, _SAMPLES))
    unstable = np.where(np.isnan(growth), True, growth > 0)
    found[1:] = np.where(unstable & (stable == 0.0), CAPSIZED, stable)
    return found

"""Small free roll of a ship: its natural frequency, with the water that moves along."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from quartering.conventions import GRAVITY, InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.integrals import moment_matrix
from quartering.hydro.own_moments import ship_moments


def natural_roll_frequency(stiffness: float, inertia: Callable[[float], float], highest: float) -> float:
    """Frequency n2 of small free roll, with the inertia of the water taken at that same frequency.

    Parameters
    ----------
    stiffness : float           rho g V GM [N m]
    inertia : callable          inertia felt in roll [kg m2] of the frequency [rad/s]: 1/(M^-1)_22, sway and yaw free
    highest : float             upper bound of the root [rad/s]

    Returns
    -------
    float    n2, the root of n2^2 I(n2) = rho g V GM [rad/s]

    Raises
    ------
    InputError    stiffness not positive, or no root below the bound: the ship has no upright roll frequency

    Notes
    -----
    Source: [H71] equations (3) and (8): the omega_2 of small motion.  Valid: small angles, no damping.

    Examples
    --------
    >>> round(natural_roll_frequency(4.0, lambda frequency: 1.0, 10.0), 12)
    2.0
    """
    if not (stiffness > 0 and np.isfinite(stiffness)):
        raise InputError(f"roll stiffness {stiffness:g} N m must be positive; check GM")

    def excess(frequency: float) -> float:
        # The root of the ratio is nearly a straight line over the frequency: few steps reach its zero.
        return frequency * math.sqrt(max(inertia(frequency) / stiffness, 0.0)) - 1

    if not excess(highest) > 0:
        raise InputError(f"no natural roll frequency below {highest:g} rad/s; check the radius of gyration in roll")
    return float(brentq(excess, 0.0, highest, xtol=1e-14 * highest, rtol=1e-14))


class FreeRoll(NamedTuple):
    """Small free roll of a ship.

    Parameters
    ----------
    frequency : float    n2, sway and yaw free [rad/s]
    inertia : float      I_x + a44(n2) about G [kg m2]
    """

    frequency: float
    inertia: float


@lru_cache(maxsize=128)  # of one ship it is asked for every block of a map, and several times in each
def free_roll(ship: Ship) -> FreeRoll:
    """Natural roll frequency of a ship as loaded, and the inertia about G at that frequency.

    Parameters
    ----------
    ship : Ship

    Returns
    -------
    FreeRoll

    Raises
    ------
    InputError    no natural frequency in the range of the sections' table

    Notes
    -----
    n2^2 I(n2) = rho g V GM with I = 1/(M^-1)_22, sway and yaw free.  Source: [H71] equations (3) and (8).

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> roll = free_roll(ship("series60-cb60"))
    >>> 0.3 < roll.frequency < 1.0
    True
    """
    loading, floating = ship.loading, hydrostatics(ship)
    moments, z0 = ship_moments(ship), loading.kg - ship.hull.draught
    rigid = floating.mass * np.diag([1.0, loading.gyradius_roll**2, loading.gyradius_yaw**2])

    def total(frequency: float) -> Floats:
        return np.asarray(rigid + moment_matrix(moments.at(frequency).about(floating.lcb, z0).a))

    def felt_in_roll(frequency: float) -> float:
        return float(1 / np.linalg.inv(total(frequency))[1, 1])

    n2 = natural_roll_frequency(floating.mass * GRAVITY * loading.gm, felt_in_roll, 2 * moments.highest)
    return FreeRoll(n2, float(total(n2)[1, 1]))

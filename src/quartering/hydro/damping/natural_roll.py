"""Natural roll frequency with the added inertia at that frequency."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from quartering._machine.piecewise import zero
from quartering.conventions import GRAVITY, InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.source.of_ship import source_of
from quartering.option_checks import Refused


def natural_roll_frequency(stiffness: float, inertia: Callable[[float], float], highest: float) -> float:
    """Frequency n2 of small free roll, with the inertia of the water taken at that same frequency.

    stiffness: rho g V GM [N m]
    inertia: inertia felt in roll [kg m2] of the frequency [rad/s]: 1/(M^-1)_22, sway and yaw free
    highest: upper bound of the root [rad/s]
    Returns n2, the root of n2^2 I(n2) = rho g V GM [rad/s]

    Source: [H71] equations (3) and (8): the omega_2 of small motion.  Valid: small angles, no damping.
    """
    if not (stiffness > 0 and np.isfinite(stiffness)):
        raise InputError(f"roll stiffness {stiffness:g} N m must be positive; check GM")

    def excess(frequency: float) -> float:
        # The root of the ratio is nearly a straight line over the frequency: few steps reach its zero.
        return frequency * math.sqrt(max(inertia(frequency) / stiffness, 0.0)) - 1

    if not excess(highest) > 0:
        raise InputError(f"no natural roll frequency below {highest:g} rad/s; check the radius of gyration in roll")
    return zero(excess, 0.0, highest, xtol=1e-14 * highest, rtol=1e-14)


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

    n2^2 I(n2) = rho g V GM with I = 1/(M^-1)_22, sway and yaw free.  Source: [H71] equations (3) and (8).
    """
    loading, floating = ship.loading, hydrostatics(ship)
    source = source_of(ship)
    rigid = floating.mass * np.diag([1.0, loading.gyradius_roll**2, loading.gyradius_yaw**2])

    def total(frequency: float) -> Floats:
        return np.asarray(rigid + source.matrices(np.asarray(frequency))[0])

    def felt_in_roll(frequency: float) -> float:
        return float(1 / np.linalg.inv(total(frequency))[1, 1])

    n2 = natural_roll_frequency(floating.mass * GRAVITY * loading.gm, felt_in_roll, 2 * source.moments.highest)
    return FreeRoll(n2, float(total(n2)[1, 1]))


def gyradius_of_period(ship: Ship, period: float, where: str | None = None) -> float:
    """Radius of gyration in roll with which a ship rolls freely at a period.

    ship: whose own radius of gyration in roll plays no part
    period: natural roll period [s]
    where: ship or file named in the message
    Returns k_xx, without added mass [m]

    The inverse of `free_roll`.  With w = 2 pi / T, added mass A(w) and rigid mass diag(m, m k^2, m k_zz^2), sway and yaw free:
    w^2 / (M^-1)_22 = rho g V GM, and 1/(M^-1)_22 = M_22 - c^T S^-1 c with S the sway-yaw block and c the coupling, so
    m k^2 = rho g V GM / w^2 - A_22 + c^T S^-1 c: no iteration.  Source: [H71] equations (3) and (8).

    >>> from quartering.hull.file.read import ship
    >>> one = ship("series60-cb60")
    >>> own = gyradius_of_period(one, 2 * math.pi / free_roll(one).frequency)
    >>> abs(own / one.loading.gyradius_roll - 1) < 1e-9
    True
    """
    loading, floating = ship.loading, hydrostatics(ship)
    source, frequency = source_of(ship), 2.0 * math.pi / period
    name = ship.name if where is None else where
    if not frequency < 2 * source.moments.highest:
        shortest = math.pi / source.moments.highest
        raise Refused(
            "roll_period",
            f"roll_period = {period:g}; it is above {shortest:.3g} s for this hull; is the unit right?",
            name,
        )
    added = source.matrices(np.asarray(frequency))[0]
    total = np.asarray(floating.mass * np.diag([1.0, 0.0, loading.gyradius_yaw**2]) + added)
    across, along, others = total[1, [0, 2]], total[[0, 2], 1], total[np.ix_([0, 2], [0, 2])]
    felt = floating.mass * GRAVITY * loading.gm / frequency**2
    squared = (felt - total[1, 1] + across @ np.linalg.solve(others, along)) / floating.mass
    beam = ship.hull.beam
    if not 0.0 < squared <= (2.0 * beam) ** 2:
        radius = f"it asks for a radius of gyration of {math.sqrt(abs(squared)) / beam:.3g} B, at most 2 B"
        radius = radius if squared > 0 else "the water alone rolls slower, whatever the radius of gyration"
        usual = 2 * math.pi * math.sqrt(0.4**2 * beam**2 / (GRAVITY * loading.gm))
        raise Refused(
            "roll_period",
            f"roll_period = {period:g}; at GM = {loading.gm:.4g} m {radius}; try {usual:.3g} s",
            name,
        )
    return math.sqrt(squared)

"""Calm-water stability: exponents of the linear sway-roll-yaw motions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.coefficient_table import Coefficients
from quartering.hydro.coefficients import coefficients

_BY_ANGLE = ("Y_phi", "K_phi", "N_phi")


def state_matrix(c: Coefficients, condition: int = 0) -> Floats:
    """Matrix A of d/dt (v, phi, p, r) = A (v, phi, p, r) for small motions without waves.

    condition: which of its conditions
    Returns (4, 4): [SI and 1/s]

    Source: [H71] equations (2) and (3), linear part.
    """
    restoring = [c.terms[name].value[condition] for name in _BY_ANGLE]
    right = np.column_stack([c.linear[condition, :, 0], restoring, c.linear[condition, :, 1:]])
    accelerations = np.linalg.solve(c.inertia[condition], right)
    return np.vstack([accelerations[0], [0.0, 0.0, 1.0, 0.0], accelerations[1:]])


def calm_water_exponents(ship: Ship, speed: float) -> NDArray[np.complex128]:
    """Exponents of the four small motions of a ship in calm water.

    speed: U [m/s]
    Returns (4,): the two sway-yaw (course) roots, then the two roll roots [1/s]; a real part above zero is unstable

    Each root is taken with the water's coefficients at its own frequency: the course roots, which are slow, at
    omega -> 0 (no waves made); the roll roots at the natural roll frequency n2. In either system the roll pair is the
    pair nearest to +- i n2.
    Source: [H71] equation (3), linear part.  Valid: straight course, upright, no rudder.
    """
    n2 = coefficients(ship, 0.0, speed).roll_frequency
    c = coefficients(ship, [0.0, n2], speed)
    slow, at_n2 = (np.linalg.eigvals(state_matrix(c, k)).astype(np.complex128) for k in range(2))
    course = slow[np.argsort(_distance_from_roll(slow, n2))[2:]]
    roll = at_n2[np.argsort(_distance_from_roll(at_n2, n2))[:2]]
    in_order = [pair[np.argsort(-pair.real - 1e-12 * pair.imag)] for pair in (course, roll)]
    return np.concatenate(in_order)


def _distance_from_roll(exponents: NDArray[np.complex128], n2: float) -> Floats:
    """Distance of each exponent from the nearer of i n2 and -i n2."""
    distance: Floats = np.hypot(exponents.real, np.abs(exponents.imag) - n2)
    return distance

"""The water's coefficients of heave and pitch that an integration in time and a disturbance can hold.

A wave moves the ship at the encounter frequency, and harmonic balance takes the water's coefficients there. What is left of a
start, or of a disturbance, moves at the natural frequency of heave and pitch, wherever the wave is. With speed the coefficients
of a low frequency make that motion grow: B35 and B53 hold -U A33 and U A33, and A33 is large where the damping is small. In
following seas, where the encounter is slow, every ship would so pitch itself under in calm water, in a wave of any height.

Both therefore keep the coefficients of the encounter frequency only where free heave and pitch die out with them, at 5 % of
critical at least, and take those of the lowest frequency above at which they do. The force of the wave is changed by what the
coefficients of its own frequency would make of the linear motion, so that a low wave moves the ship as `vertical_motion` says:

    F' = F + [ -w^2 (M' - M) + i w (B' - B) ] eta .
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.motion.six_modes import vertical_motion, vertical_system
from quartering.motion.steady_course.course import Course

Phasors = NDArray[np.complex128]

LEAST: Final = 0.05
"""Fraction of critical with which free heave and pitch die out at the least [1]."""
_LOOKED_AT: Final = np.arange(0.05, 6.0, 0.05)
"""Frequencies looked at, times sqrt(L/g) [1]."""


def free_matrices(ship: Ship, omega: Floats, speed: Floats) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Mass with added mass, and damping, of heave and pitch with which free motion dies out.

    omega, speed (n,): modulus of the encounter frequency [rad/s]; U [m/s]
    Returns mass, damping (n, 2, 2); raised (n,): they are those of a higher frequency
    """
    mass, damping, fraction = _matrices(ship, omega, speed)
    raised = fraction < LEAST
    looked_at = _LOOKED_AT * np.sqrt(GRAVITY / ship.hull.length)
    for U in np.unique(speed[raised]):
        above = _matrices(ship, looked_at, np.full(looked_at.size, U))
        for i in np.flatnonzero(raised & (speed == U)):
            higher = looked_at > omega[i]
            damped = higher & (above[2] >= LEAST)
            best = int(damped.argmax()) if damped.any() else int(np.where(higher, above[2], -1.0).argmax())
            mass[i], damping[i] = above[0][best], above[1][best]
    return mass, damping, raised


def _vertical_matrices(ship: Ship, omega: Floats, speed: Floats) -> tuple[Floats, Floats, Floats]:
    """Mass and damping (n, 2, 2), stiffness (2, 2) of heave and pitch at encounter frequencies (n,) and speeds (n,)."""
    mass, damping, stiffness = vertical_system(ship, omega, speed, float(ship.value("gyradius_pitch")))
    return mass[:, 1:, 1:].copy(), damping[:, 1:, 1:].copy(), stiffness[1:, 1:]


def _matrices(ship: Ship, omega: Floats, speed: Floats) -> tuple[Floats, Floats, Floats]:
    """Mass and damping (n, 2, 2), and the least fraction of critical (n,) of their free motion."""
    mass, damping, stiffness = _vertical_matrices(ship, omega, speed)
    motion = np.zeros((omega.size, 4, 4))
    motion[:, :2, 2:] = np.eye(2)
    motion[:, 2:, :2] = -np.linalg.solve(mass, np.broadcast_to(stiffness, mass.shape))
    motion[:, 2:, 2:] = -np.linalg.solve(mass, damping)
    root = np.linalg.eigvals(motion)
    return mass, damping, np.asarray((-root.real / np.abs(root)).min(axis=1))


def free_course(one: Course) -> tuple[Floats, Floats, Phasors]:
    """Mass and damping (n, 2, 2) of heave and pitch for free motion, and the force (n, 5) of `Numbers` that goes with them."""
    n = one.numbers
    mass, damping, raised = free_matrices(one.ship, n.omega, one.speed)
    if not raised.any():
        return mass, damping, n.force
    k, heading = np.hypot(n.wave[:, 0], n.wave[:, 1]), np.degrees(np.arctan2(n.wave[:, 1], n.wave[:, 0]))
    return mass, damping, force_with(one.ship, (k, one.speed, heading, one.signed), n.force, (mass, damping))


def force_with(
    ship: Ship, waves: tuple[Floats, Floats, Floats, Floats], force: Phasors, held: tuple[Floats, Floats]
) -> Phasors:
    """The force (n, 5) of waves, as `Numbers` has it, with which other coefficients of heave and pitch give the linear motion.

    waves (n,): k [1/m], U [m/s], mu [deg], signed encounter frequency [rad/s]
    held (n or 1, 2, 2): mass and damping in place of those at the frequency of each wave
    """
    k, speed, heading, signed = waves
    mass, damping, _ = _vertical_matrices(ship, np.abs(signed), speed)
    motion = vertical_motion(ship, k, speed, heading, float(ship.value("gyradius_pitch")))[:, 1:]
    motion = np.nan_to_num(np.where(signed[:, None] < 0, motion.conj(), motion))
    w = np.abs(signed)[:, None, None]
    change = -(w**2) * (held[0] - mass) + 1j * w * (held[1] - damping)
    changed = force.copy()
    changed[:, :2] += np.einsum("nij,nj->ni", change, motion)
    return changed

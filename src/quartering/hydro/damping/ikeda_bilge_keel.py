"""Damping by bilge keels: the force on the keel, the pressure it makes on the hull, and its lift.

The keel stands on the bilge of the midship section, whose bilge is a quarter circle of radius R, and the section is taken
alike over the keel's length. In draughts: m1 = R/T, m2 = OG/T, m3 = 1 - m1 - m2, m4 = H0 - m1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.damping.ikeda import Particulars, Rolling
from quartering.hydro.damping.ikeda_eddy import bilge_radius


class BilgeKeel(NamedTuple):
    """The pair of bilge keels of a ship.

    Parameters
    ----------
    length, breadth : float    of one keel [m]
    """

    length: float
    breadth: float


class BilgeKeelDamping(NamedTuple):
    """Equivalent linear damping of a pair of bilge keels.

    Parameters
    ----------
    normal, pressure, lift : (n,) float    force on the keel, pressure on the hull, lift of the keel [N m s]
    """

    normal: Floats
    pressure: Floats
    lift: Floats

    @property
    def total(self) -> Floats:
        """Sum of the three [N m s]."""
        return self.normal + self.pressure + self.lift


def checked_keel(hull: Particulars, length: float, breadth: float) -> BilgeKeel:
    """Bilge keels, refused when their size cannot be right.

    length, breadth: of one keel [m]

    Source: [Ikeda78c] for the keel meant.

    >>> checked_keel(Particulars(175.0, 25.4, 9.5, 0.57, 0.97, 0.0), 44.0, 0.4)
    BilgeKeel(length=44.0, breadth=0.4)
    """
    if not (np.isfinite(length) and 0 < length <= hull.length):
        raise InputError(f"bilge keel length {length:g} m must lie above 0 and within the ship's {hull.length:g} m")
    if not (np.isfinite(breadth) and 0 < breadth <= hull.beam / 4):
        raise InputError(
            f"bilge keel breadth {breadth:g} m must lie above 0 and below a quarter of the beam; "
            f"try {0.015 * hull.beam:.2g} m, and give (length, breadth) in that order"
        )
    return BilgeKeel(length, breadth)


def bilge_keels(
    hull: Particulars, motion: Rolling, keel: BilgeKeel, *, radius: float | None = None
) -> BilgeKeelDamping:
    """Equivalent linear damping of a pair of bilge keels.

    radius: R of the midship bilge [m]; None: from the midship coefficient, `bilge_radius`

    Force: (8/(3 pi)) rho l^3 omega phi_a b f^2 C_D per metre, C_D = 22.5 b/(pi l phi_a f) + 2.4, f = 1 + 0.3
    exp(-160 (1 - C_M)), l from G to the bilge. Pressure: `hull_pressure_moment`. Lift: 2 L_BK l1/(phi_a omega),
    L_BK = (pi/2) rho alpha (U^2 + u^2) b^2, u = l1 phi_a omega, alpha = arctan(u/U), l1 = l + b/2; not per metre.
    The printed velocity factor of the force is f in some versions of the procedure and f^2 in others; force goes with the
    square of the velocity, so f^2 is used (they differ only for C_M above 0.97).
    Source: [Ikeda78c], [Himeno81] ch. 4, [ITTC11] 2.2.5.  Valid: b/B 0.01 to 0.06, keel not near the surface.
    """
    T, b = hull.draught, keel.breadth
    phi, omega, U = motion.amplitude, motion.frequency, motion.speed
    R = _midship_radius(hull) if radius is None else radius
    corner = (1 - np.sqrt(0.5)) * R
    l = float(np.hypot(hull.beam / 2 - corner, T - hull.og - corner))
    f = 1 + 0.3 * np.exp(-160 * max(1 - hull.midship, 0.0))
    suction = 22.5 * b / (np.pi * l * phi * f)
    normal = 8 / (3 * np.pi) * hull.density * l**3 * omega * phi * b * f**2 * (suction + 2.4)
    spread = 0.3 * np.pi * l * phi * f + 1.95 * b
    back, front = hull_pressure_moment(hull.beam / 2, T, hull.og, R, spread)
    moment = T**2 * (back * (suction + 1.2) + front * 1.2)
    pressure = 4 / (3 * np.pi) * hull.density * l**2 * omega * phi * f**2 * moment
    l1 = l + b / 2
    u = l1 * phi * omega
    wing = np.pi / 2 * hull.density * np.arctan2(u, U) * (U**2 + u**2) * b**2
    return BilgeKeelDamping(normal * keel.length, pressure * keel.length, 2 * wing * l1 / (phi * omega))


def _midship_radius(hull: Particulars) -> float:
    half = hull.beam / 2
    return float(bilge_radius(half, hull.draught, hull.midship * hull.beam * hull.draught))


def hull_pressure_moment(
    half_breadth: float, draught: float, og: float, radius: float, spread: Floats
) -> tuple[Floats, float]:
    """Levers of the pressure that a bilge keel makes on the hull, about G.

    half_breadth, draught: of the section [m]
    og: depth of G below the calm plane, + down [m]
    radius: R of the bilge [m]
    spread (n,): S0, length of the contour behind the keel under suction [m]
    Returns back (n,): A0: moment of unit suction over S0 behind the keel, per T^2 [1]; front: B0: moment of a pressure
        that falls from 1 at the keel to 0 at centre line and waterline, per T^2 [1]

    A0 = (m3 + m4) m8 - m7^2, B0 = m4^3/(3 (H0 - 0.215 m1)) + (1 - m1)^2 (2 m3 - m2)/(6 (1 - 0.215 m1)) + m1 (m3 m5 +
    m4 m6). The first term of B0 is the flat bottom, so m4; m2 is a misprint of the procedure, found by integrating the
    pressure over the bottom.
    Source: [Ikeda78c], [Himeno81] ch. 4, [ITTC11] 2.2.5 (corrected).
    """
    H0, m1, m2, s = half_breadth / draught, radius / draught, og / draught, spread / draught
    m3, m4 = 1 - m1 - m2, H0 - m1
    flat, side = H0 - 0.215 * m1, 1 - 0.215 * m1
    m5 = (0.414 * H0 + 0.0651 * m1**2 - (0.382 * H0 + 0.0106) * m1) / (flat * side)
    m6 = (0.414 * H0 + 0.0651 * m1**2 - (0.382 + 0.0106 * H0) * m1) / (flat * side)
    beyond = s > 0.25 * np.pi * m1
    m7 = np.where(beyond, s - 0.25 * np.pi * m1, 0.0)
    curved = np.sqrt(2.0) * m1 * (1 - np.cos(np.minimum(s / max(m1, 1e-12), np.pi / 4)))
    m8 = np.where(beyond, m7 + 0.414 * m1, curved)
    front = m4**3 / (3 * flat) + (1 - m1) ** 2 * (2 * m3 - m2) / (6 * side) + m1 * (m3 * m5 + m4 * m6)
    return (m3 + m4) * m8 - m7**2, float(front)

"""Damping by the eddies that a section sheds at its keel and bilges.

The pressure a vortex makes at the point of the contour that is farthest from the roll axis is measured; its decrease
toward the waterline and the keel is modelled. The velocity at that point is that about a Lewis form.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.section.lewis import LewisForms, lewis_forms

DEEPEST_AXIS = 0.8
"""Where a shallow section ends above G, the roll axis is taken at this share of its area coefficient times draught."""


def bilge_radius(half_breadth: ArrayLike, draught: ArrayLike, area: ArrayLike) -> Floats:
    """Radius of the bilge that gives a box of the same breadth and draught the section's area.

    half_breadth, draught (s,): [m]
    area (s,): both sides [m2]
    Returns (s,): R, at most the draught and the half breadth [m]

    R = 2 T sqrt(H0 (1 - sigma)/(4 - pi)), H0 = B/(2T), sigma = A/(B T).
    Source: [Ikeda78a], [ITTC11] 2.2.4.  Valid: round bilge; 0 for sections fuller than their box.
    """
    b, T, A = (np.asarray(q, dtype=float) for q in (half_breadth, draught, area))
    R = 2 * T * np.sqrt(b / T * np.maximum(1 - A / (2 * b * T), 0.0) / (4 - np.pi))
    return np.asarray(np.minimum(R, np.minimum(b, T)))


def eddy_coefficient(
    half_breadth: ArrayLike,
    draught: ArrayLike,
    area: ArrayLike,
    og: float = 0.0,
    *,
    radius: ArrayLike | None = None,
) -> Floats:
    """Eddy-making moment coefficient C_R of sections: moment = (1/2) rho T^4 C_R |p| p per metre.

    half_breadth, draught (s,): > 0 [m]
    area (s,): both sides [m2]
    og: depth of the roll axis G below the calm plane, + down [m]
    radius (s,): bilge radius [m]; None: `bilge_radius`
    Returns (s,): C_R [1]

    C_R = (r_max/T)^2 C_P ((1 - f1 R/T)(1 - OG/T - f1 R/T) + f2 (H0 - f1 R/T)^2),
    C_P = (0.87 exp(-g) - 4 exp(-0.187 g) + 3)/2, with g the ratio of the largest to the mean velocity about the Lewis
    form that has the section's shape below the level of the roll axis. A section that ends above G or just below it has
    no such form: there OG is held at 0.8 sigma T; such sections are small. Sections fuller than their box, as under a bulb,
    count as full as the box, with round corners.
    Source: [Ikeda78a] equations (10) to (15) and appendix; [ITTC11] 2.2.4.
    Valid: round bilges, 0.4 < sigma < 1, H0 from 0.5 to 1.25: 9 of 16 measured values within 15 %, 13 within 25 %, the
    smallest (sigma 0.9) underestimated fourfold. Between sigma 0.995 and 1 the velocity is multiplied by up to 5 for the
    sharp bilge, so that the third decimal of the area decides. Wide flat sterns are overestimated.
    """
    b, T, A = (np.atleast_1d(np.asarray(q, dtype=float)) for q in (half_breadth, draught, area))
    if not all((q > 0).all() and np.isfinite(q).all() for q in (b, T, A)):
        raise InputError("half breadth, draught and area of a section must be numbers above 0 to shed eddies")
    fullness, H0 = A / (2 * b * T), b / T
    sigma = np.minimum(fullness, 1.0)  # a bulb is fuller than its box, and f2 would grow without bound
    OG = np.minimum(og, DEEPEST_AXIS * sigma * T)
    R = bilge_radius(b, T, A) if radius is None else np.asarray(radius, dtype=float)
    r_max, velocity = _fastest_point(lewis_forms(b, T - OG, A - 2 * b * OG))
    f1 = 0.5 * (1 + np.tanh(20 * (sigma - 0.7)))
    f2 = 0.5 * (1 - np.cos(np.pi * sigma)) - 1.5 * (1 - np.exp(-5 * (1 - sigma))) * np.sin(np.pi * sigma) ** 2
    f3 = 1 + 4 * np.exp(-1.65e5 * (1 - fullness) ** 2)
    mean = 2 * np.sqrt((A / 2 - b * OG) / np.pi)
    gamma = f3 * velocity / mean
    C_P = 0.5 * (0.87 * np.exp(-gamma) - 4 * np.exp(-0.187 * gamma) + 3)
    side = (1 - f1 * R / T) * np.maximum(1 - OG / T - f1 * R / T, 0.0)
    return np.asarray((r_max / T) ** 2 * C_P * (side + f2 * (H0 - f1 * R / T) ** 2))


def _fastest_point(form: LewisForms) -> tuple[Floats, Floats]:
    """Largest distance from the axis to the contour [m], and the velocity there per unit roll rate [m]."""
    a1, a3 = form.a1, form.a3
    safe = np.where(np.abs(a3) > 1e-12, a3, 1e-12)
    bend = 0.5 * np.arccos(np.clip(a1 * (1 + a3) / (4 * safe), -1.0, 1.0))
    psi = np.stack([np.zeros_like(bend), bend])
    y = (1 + a1) * np.sin(psi) - a3 * np.sin(3 * psi)
    z = (1 - a1) * np.cos(psi) + a3 * np.cos(3 * psi)
    distance = form.scale * np.hypot(y, z)
    at_bend = distance[1] > distance[0]
    angle, r_max = np.where(at_bend, bend, 0.0), np.maximum(distance[0], distance[1])
    H = 1 + a1**2 + 9 * a3**2 + 2 * a1 * (1 - 3 * a3) * np.cos(2 * angle) - 6 * a3 * np.cos(4 * angle)
    a = -2 * a3 * np.cos(5 * angle) + a1 * (1 - a3) * np.cos(3 * angle)
    a = a + ((6 - 3 * a1) * a3**2 + (a1**2 - 3 * a1) * a3 + a1**2) * np.cos(angle)
    b = -2 * a3 * np.sin(5 * angle) + a1 * (1 - a3) * np.sin(3 * angle)
    b = b + ((6 + 3 * a1) * a3**2 + (3 * a1 + a1**2) * a3 + a1**2) * np.sin(angle)
    return r_max, r_max + 2 * form.scale / H * np.hypot(a, b)


def eddy_damping(
    half_breadth: ArrayLike,
    draught: ArrayLike,
    area: ArrayLike,
    og: float,
    rate: ArrayLike,
    density: float,
) -> Floats:
    """Equivalent linear eddy damping of sections, per metre and at rest.

    half_breadth, draught (s,): [m]
    area (s,): both sides [m2]
    og: depth of the roll axis G below the calm plane, + down [m]
    rate (n,): amplitude of the roll rate, omega phi_a [rad/s]
    density: rho [kg/m3]
    Returns (n, s): (4/(3 pi)) rho T^4 omega phi_a C_R [N s]; 0 for a section without breadth at the waterline

    Source: [Ikeda78a] equation (6), [ITTC11] 2.2.4.  Valid: as `eddy_coefficient`.
    """
    b, T, A = (np.atleast_1d(np.asarray(q, dtype=float)) for q in (half_breadth, draught, area))
    wet = (b > 0.02 * T) & (T > 0) & (A > 0)
    moment = np.zeros_like(b)
    moment[wet] = T[wet] ** 4 * eddy_coefficient(b[wet], T[wet], A[wet], og)
    return 4 / (3 * np.pi) * density * np.multiply.outer(np.atleast_1d(np.asarray(rate, dtype=float)), moment)

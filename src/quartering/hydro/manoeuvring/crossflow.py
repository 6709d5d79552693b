"""Cross-flow drag: the ten velocity cubics of sway, roll and yaw, estimated from the lines alone.

A section at x meets the water sideways at ``u = v + x r - h p``, h the depth of its drag centre below G, and feels
``-1/2 rho C_D T(x) |u| u`` per metre. With ``kappa u^3/u0`` in place of ``|u| u`` the cube has the ten monomials.
The drag coefficient 0.8 is assumed. Hoerner's curve for two-dimensional sections falls from 0.88 at half breadth over
draught 0.83 through 0.77 at 1.25 to 0.59 at 3; narrow deep sections and sharp bilges lie higher, up to 2.
Everything made here is an estimate and is labelled so.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY, InputError
from quartering.hull.lines.section import Floats

DRAG_COEFFICIENT = 0.8
"""Assumed cross-flow drag coefficient of a ship section [1]."""

VELOCITY_FRACTION = 0.03
"""Reference velocity u0 over sqrt(g L) when none is given [1]: 1 m/s for a ship of 120 m."""

ENERGY_CUBE = 32 / (9 * np.pi)
"""kappa of equal dissipation: a sinusoidal u of amplitude u0 loses the same energy to |u| u and to kappa u^3/u0."""


def reference_velocity(length: float) -> float:
    """Velocity u0 at which the drag law and its cubic substitute agree.

    length: L [m]
    Returns 0.03 sqrt(g L) [m/s]

    Source: [H71] (cubic in place of modulus terms); the fraction 0.03 is assumed: the sideways velocity of a ship that
    rolls 20 deg or drifts 5 deg in a seaway.
    """
    return float(VELOCITY_FRACTION * np.sqrt(GRAVITY * length))


def _drag_per_metre(
    section_draught: ArrayLike, drag_coefficient: ArrayLike, velocity_scale: float, density: float
) -> Floats:
    """Factor 1/2 rho C_D T of each section, after checking the numbers [kg/m2]."""
    draught, drag = np.asarray(section_draught, dtype=float), np.asarray(drag_coefficient, dtype=float)
    if not (velocity_scale > 0 and np.isfinite(velocity_scale)):
        raise InputError(f"velocity scale {velocity_scale:g} m/s must be positive; try 0.03 sqrt(g L)")
    if not (np.isfinite(drag).all() and (drag >= 0).all()):
        raise InputError(f"drag coefficient {drag_coefficient!r} must be a number >= 0; ships lie between 0.6 and 1.2")
    return 0.5 * density * drag * draught


def cross_flow_cubics(
    x: ArrayLike,
    weight: ArrayLike,
    section_draught: ArrayLike,
    lever: ArrayLike,
    drag_coefficient: ArrayLike,
    velocity_scale: float,
    density: float,
) -> Floats:
    """The ten cubic coefficients of sway, roll and yaw from cross-flow drag, about G.

    x (s,): section positions from G, + forward [m]
    weight (s,): quadrature weights along the ship [m]
    section_draught (s,): T(x) [m]
    lever (s,): h(x), depth of the drag centre below G, + down [m]
    drag_coefficient (...): C_D, one number or one per section [1]
    velocity_scale: u0 [m/s]
    density: rho [kg/m3]
    Returns (3, 10): rows Y, K, N of the right-hand side; columns in the order of CUBIC_MONOMIALS, SI

    (v + x r - h p)^3 has the factors (1, -h^3, x^3, 3h^2, 3x^2, -3h, -3hx^2, 3x, 3h^2 x, -6hx); Y takes their integral,
    K that of -h times them, N that of x times them, so that v Y + p K + r N <= 0 always.
    Source: [H71] equation (2) for the monomials; [Hoerner65] for the drag.  Valid: estimate; no lift, no free surface.
    """
    xs, h = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(lever, dtype=float))
    drag = _drag_per_metre(section_draught, drag_coefficient, velocity_scale, density)
    strength = -drag * ENERGY_CUBE / velocity_scale * np.asarray(weight, dtype=float)
    one = np.ones_like(xs)
    factors = np.stack(
        [one, -(h**3), xs**3, 3 * h**2, 3 * xs**2, -3 * h, -3 * h * xs**2, 3 * xs, 3 * h**2 * xs, -6 * h * xs]
    )
    rows: Floats = np.einsum("s,ks,ms->km", strength, np.stack([one, -h, xs]), factors)
    return rows

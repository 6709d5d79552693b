"""Strip theory: from section added mass and damping to the derivatives of the whole ship, in body axes.

A section moves with ``V2 = v + x r`` and ``V4 = p`` and feels ``f_i = -(i w - U d/dx)[c_i2 (v + x r) + c_i4 p]`` with
``c = a + b/(i w)``. Integrated over the length (aft end x_A), with the moments ``S_k = int x^k c dx``, this is

    damping-type derivatives = -( M[b] + U (J[a] + M[a at x_A]) )
    inertia-type derivatives = -( M[a] - U/w^2 (J[b] + M[b at x_A]) )

    M[c] = [[S0_22, S0_24, S1_22], [S0_24, S0_44, S1_24], [S1_22, S1_24, S2_22]],   J[c] = yaw row (S0_22, S0_24, S1_22)

At one section M[c at x_A] is M with ``S_k = x_A^k c(x_A)``. All coefficients are stored as the triple [22, 24, 44].
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY
from quartering.hull.lines.section import Floats
from quartering.hydro.strip.integrals import moment_matrix

FREQUENCY_FLOOR = 0.15
"""Below FREQUENCY_FLOOR sqrt(g/B) the U/w^2 terms stop growing: w is held there in their denominator."""


def _speed_terms(moments: Floats, aft: Floats | None) -> Floats:
    """Factor of U: the yaw row J[c], and the terms of the aft end when it carries area."""
    terms = np.zeros_like(moments)
    terms[..., 2, :] = moment_matrix(moments)[..., 0, :]
    return terms if aft is None else terms + moment_matrix(aft)


def derivatives_from_moments(
    a: Floats,
    b: Floats,
    speed: ArrayLike,
    frequency: ArrayLike,
    *,
    aft: tuple[Floats, Floats] | None = None,
    floor: float = 0.0,
) -> tuple[Floats, Floats]:
    """Damping- and inertia-type derivatives from the integrated section coefficients.

    a, b (..., 3, 3): moments of added mass and damping about the point wanted, at each condition
    speed (...): U [m/s]
    frequency (...): encounter frequency omega, >= 0 [rad/s]
    aft: x_A^k a(x_A) and x_A^k b(x_A) of a transom; None leaves those terms out
    floor: the U/omega^2 terms use max(omega, floor); infinity leaves them out [rad/s]
    Returns damping (..., 3, 3): Y_v, Y_p, Y_r; K_v, ..; N_v, .., without any rigid-body term; inertia (..., 3, 3):
        Y_vdot, Y_pdot,

    At omega = 0 without a floor the U/omega^2 terms are zero, because b goes to zero faster than omega^2.
    Source: [STF70] lateral coefficients, rewritten for body axes (v already contains -U psi).  Valid: slender ships.
    """
    u = np.asarray(speed, dtype=float)[..., None, None]
    w = np.maximum(np.asarray(frequency, dtype=float), floor)[..., None, None]
    per_square = np.where(w > 0, 1 / np.where(w > 0, w, 1.0) ** 2, 0.0)
    aft_a, aft_b = (None, None) if aft is None else aft
    damping = -(moment_matrix(b) + u * _speed_terms(a, aft_a))
    inertia = -(moment_matrix(a) - u * per_square * _speed_terms(b, aft_b))
    return damping, inertia


def frequency_floor(beam: float) -> float:
    """Frequency at which the U/omega^2 terms of strip theory stop growing.

    beam: B [m]
    Returns 0.15 sqrt(g/B) [rad/s]

    Source: [STF70] for the terms; the floor is assumed, low enough to leave wave-frequency motion alone.
    """
    return float(FREQUENCY_FLOOR * np.sqrt(GRAVITY / beam))

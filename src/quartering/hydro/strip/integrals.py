"""Integrals of section coefficients along the ship, and their move from the waterline to G.

Coefficients are the triple [22, 24, 44] of one section; integrals are stored as (power of x, triple).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quartering.hull.lines.section import Floats


def about_gravity_centre(coefficients: ArrayLike, z0: ArrayLike) -> Floats:
    """Move section coefficients from the waterline point O to G, which lies z0 above it.

    coefficients (..., 3): [22, 24, 44] of added mass or damping about O, per metre or integrated
    z0 (...): depth of the calm plane below G, KG - T [m]; -z0 moves back from G to O
    Returns (..., 3): [22, 24, 44] about G

    Roll about G moves O sideways by -z0 p, and K_G = K_O - z0 Y.
    Source: [STF70] section coefficients, moved rigidly.  Valid: any section, same frequency.
    """
    c = np.asarray(coefficients, dtype=float)
    z = np.asarray(z0, dtype=float)
    c22, c24, c44 = c[..., 0], c[..., 1], c[..., 2]
    return np.stack(np.broadcast_arrays(c22, c24 - z * c22, c44 - 2 * z * c24 + z**2 * c22), axis=-1)


def section_moments(x: ArrayLike, weight: ArrayLike, coefficients: ArrayLike) -> Floats:
    """Integrals of x^0, x^1, x^2 times the section coefficients over the length.

    x (s,): section positions [m]
    weight (s,): quadrature weights along the ship [m]
    coefficients (..., s, 3): [22, 24, 44] of each section, per metre
    Returns (..., 3, 3): first index the power of x, second [22, 24, 44]

    Source: [STF70], integrals over the length of the lateral coefficients.
    """
    xs = np.asarray(x, dtype=float)
    powers = np.asarray(weight, dtype=float) * xs ** np.arange(3)[:, None]
    moments: Floats = np.einsum("ks,...sp->...kp", powers, np.asarray(coefficients, dtype=float))
    return moments


def shifted_moments(moments: Floats, x_g: float, z0: float) -> Floats:
    """Moments about the waterline at the x-origin, moved to G at x_g and z0 above the waterline.

    moments (..., 3, 3): from `section_moments`, about O
    x_g: position of G on the x axis of the moments [m]
    z0: KG - T [m]
    Returns (..., 3, 3): the same integrals with x from G and [22, 24, 44] about G

    Source: [STF70] section coefficients, moved rigidly.
    """
    s0, s1, s2 = (moments[..., k, :] for k in range(3))
    in_x = np.stack([s0, s1 - x_g * s0, s2 - 2 * x_g * s1 + x_g**2 * s0], axis=-2)
    return about_gravity_centre(in_x, z0)


def moment_matrix(moments: Floats) -> Floats:
    """Symmetric sway-roll-yaw matrix M[c] of the integrated section coefficients.

    moments (..., 3, 3): from `section_moments`
    Returns (..., 3, 3): rows and columns sway, roll, yaw

    Source: [STF70] lateral coefficients at zero speed.
    """
    s0, s1, s2 = (moments[..., k, :] for k in range(3))
    entries = (
        s0[..., 0],
        s0[..., 1],
        s1[..., 0],
        s0[..., 1],
        s0[..., 2],
        s1[..., 1],
        s1[..., 0],
        s1[..., 1],
        s2[..., 0],
    )
    return np.stack(entries, axis=-1).reshape(*moments.shape[:-2], 3, 3)

"""Strip theory in all six modes: from section coefficients to matrices of the whole ship, about any point.

A section at x moves with (sway, heave, roll) velocities ``H(x) V``, V the six velocities of the ship, and feels
``f = -(i w - U d/dx)[c H V]`` with ``c = a + b/(i w)``. The ship feels ``int H' f dx``; integrated by parts (aft end A),

    F = -( i w int H' c H dx + U [int H_x' c H dx + (H' c H)_A] ) V,     H_x = dH/dx,

so with ``S(c) = int H' c H dx`` and ``J(c)`` the bracket: damping S(b) + U J(a), added mass S(a) - U/w^2 J(b).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quartering.hull.lines.section import Floats


def section_motion(x: ArrayLike, depth: float) -> Floats:
    """Sway, heave and roll velocity of sections from the six velocities of the ship: H(x).

    x (s,): section positions from the reference point, + forward [m]
    depth: of the calm plane below the reference point, + down [m]
    Returns (s, 3, 6): rows sway, heave and roll about the waterline point; columns surge .. yaw

    v + x r - depth p, w - x q, p.  Source: [STF70], rigid-body kinematics of a section.

    >>> section_motion([10.0], 2.0)[0].tolist()
    [[0.0, 1.0, 0.0, -2.0, 0.0, 10.0], [0.0, 0.0, 1.0, 0.0, -10.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]]
    """
    xs = np.atleast_1d(np.asarray(x, dtype=float))
    motion = np.zeros((xs.size, 3, 6))
    motion[:, 0, 1] = motion[:, 1, 2] = motion[:, 2, 3] = 1.0
    motion[:, 0, 3], motion[:, 0, 5], motion[:, 1, 4] = -depth, xs, -xs
    return motion


def section_matrix(lateral: ArrayLike, heave: ArrayLike) -> Floats:
    """Section coefficients as matrices of sway, heave and roll.

    lateral (..., 3): [22, 24, 44]
    heave (...): 33
    Returns (..., 3, 3): symmetric; heave couples with nothing

    Source: [STF70], port-starboard symmetric sections.
    """
    sides, up = np.asarray(lateral, dtype=float), np.asarray(heave, dtype=float)
    matrix = np.zeros((*up.shape, 3, 3))
    matrix[..., 0, 0], matrix[..., 2, 2], matrix[..., 1, 1] = sides[..., 0], sides[..., 2], up
    matrix[..., 0, 2] = matrix[..., 2, 0] = sides[..., 1]
    return matrix


def six_mode_matrices(
    x: ArrayLike,
    weight: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    speed: float,
    frequency: ArrayLike,
    *,
    depth: float = 0.0,
    x_aft: float | None = None,
    floor: float = 0.0,
) -> tuple[Floats, Floats]:
    """Added mass and damping of the ship in six modes from its sections, body axes.

    x (s,): section positions from the reference point, + forward [m]
    weight (s,): quadrature weights along the ship [m]
    a, b (f, s, 3, 3): section matrices in sway, heave, roll about the waterline point, per metre
    speed: U; a negative one is the reverse flow [m/s]
    frequency (f,): encounter frequency, any sign [rad/s]
    depth: of the calm plane below the reference point [m]
    x_aft: where the first section stands as a transom [m]; None leaves the aft terms out
    floor: the U/omega^2 terms use max(|omega|, floor); infinity leaves them out [rad/s]
    Returns added_mass, damping (f, 6, 6): surge row and column zero

    Both matrices belong to omega and to -omega alike: c(-w) is the conjugate of c(w).
    Source: [STF70] heave-pitch and lateral coefficients with transom terms, in body axes.  Valid: slender ships.
    """
    w = np.maximum(np.abs(np.atleast_1d(np.asarray(frequency, dtype=float))), floor)[:, None, None]
    per_square = np.where(w > 0, 1 / np.where(w > 0, w, 1.0) ** 2, 0.0)
    H, c = section_motion(x, depth), (np.asarray(a, dtype=float), np.asarray(b, dtype=float))
    along = np.zeros((3, 6))
    along[0, 5], along[1, 4] = 1.0, -1.0
    weighted = np.asarray(weight, dtype=float)[:, None, None] * H

    def integral(values: Floats) -> Floats:
        return np.asarray(np.einsum("ski,fskl,slj->fij", weighted, values, H))

    def speed_terms(values: Floats) -> Floats:
        terms = np.asarray(along.T @ np.einsum("fskl,slj->fkj", values, weighted))
        if x_aft is None:
            return terms
        end = section_motion([x_aft], depth)[0]
        return np.asarray(terms + end.T @ values[:, 0] @ end)

    added = integral(c[0]) - speed * per_square * speed_terms(c[1])
    return added, integral(c[1]) + speed * speed_terms(c[0])


def seakeeping_axes(added_mass: Floats, damping: Floats, speed: float, frequency: Floats) -> tuple[Floats, Floats]:
    """The same matrices for displacements in axes that move with the mean course.

    added_mass, damping (f, 6, 6): body axes
    speed: U [m/s]
    frequency (f,): not 0 where speed is not [rad/s]
    Returns added_mass, damping (f, 6, 6): A_ij, B_ij of the literature, axes y to starboard and z down

    v = d eta2/dt - U eta6 and w = d eta3/dt + U eta5, so A = A_body - U/w^2 B_body E, B = B_body + U A_body E with
    E = -1 at (sway, yaw), +1 at (heave, pitch).  Source: [STF70].
    """
    turn = np.zeros((6, 6))
    turn[1, 5], turn[2, 4] = -1.0, 1.0
    w = np.asarray(frequency, dtype=float)[:, None, None]
    per_square = speed / np.where(w == 0, np.inf, w) ** 2
    return added_mass - per_square * (damping @ turn), damping + speed * (added_mass @ turn)

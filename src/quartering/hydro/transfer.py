"""Moving a set of derivatives to another reference point.

A force set about O = (x, 0, z), given from G in body axes, is moved by ``V_O = T V_G`` with
``T = [[1, -z, x], [0, 1, 0], [0, 0, 1]]`` and ``F_G = T' F_O``; the virtual power stays what it was.
"""

from __future__ import annotations

from itertools import product
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import CUBIC_MONOMIALS
from quartering.hull.lines.section import Floats


def transfer_matrix(x: float, z: float) -> Floats:
    """Velocities at O from velocities at G.

    x, z: position of O from G, + forward and + down [m]
    Returns (3, 3): T of V_O = T V_G, in (v, p, r)

    Source: [Abkowitz64], rigid-body kinematics.
    """
    return np.array([[1.0, -z, x], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


def transfer(matrix: ArrayLike, x: float, z: float) -> Floats:
    """Move an inertia or a linear matrix from O to G.

    matrix (..., 3, 3): about O, rows Y, K, N, columns v, p, r (or accelerations); no rigid-body terms
    x, z: position of O from G, + forward and + down [m]; opposite signs move back
    Returns (..., 3, 3): T' matrix T, about G

    Source: [Abkowitz64], rigid-body kinematics.  Subtract m U from Y_r after the move, never before.
    """
    to_o = transfer_matrix(x, z)
    moved: Floats = to_o.T @ np.asarray(matrix, dtype=float) @ to_o
    return moved


_TRIPLES: Final = {
    triple: next(
        k for k, monomial in enumerate(CUBIC_MONOMIALS) if sorted(monomial) == sorted("vpr"[i] for i in triple)
    )
    for triple in product(range(3), repeat=3)
}
_SPREAD: Final = np.array([[float(column == k) for k in range(10)] for column in _TRIPLES.values()])
_SHARE: Final = _SPREAD / _SPREAD.sum(axis=0)


def cubic_tensor(cubic: ArrayLike) -> Floats:
    """Symmetric tensor of the ten velocity cubics.

    cubic (..., 10): complete coefficients in the order of CUBIC_MONOMIALS
    Returns (..., 3, 3, 3): t with cubic(V) = sum t_ijm V_i V_j V_m: each coefficient over its number of permutations

    Source: [H71] equation (4).
    """
    values = np.asarray(cubic, dtype=float)
    tensor: Floats = (values @ _SHARE.T).reshape(*values.shape[:-1], 3, 3, 3)
    return tensor


def transfer_cubic(cubic: ArrayLike, x: float, z: float) -> Floats:
    """Move the cubic coefficients of all three rows from O to G.

    cubic (3, 10): rows Y, K, N about O, columns in the order of CUBIC_MONOMIALS
    x, z: position of O from G, + forward and + down [m]; opposite signs move back
    Returns (3, 10): the same forces about G

    t_G[k,i,j,m] = T_lk t_O[l,a,b,c] T_ai T_bj T_cm.  Source: [Abkowitz64] expansion, rigid-body kinematics.
    """
    to_o = transfer_matrix(x, z)
    tensor = np.einsum("lk,labc,ai,bj,cm->kijm", to_o, cubic_tensor(cubic), to_o, to_o, to_o)
    moved: Floats = tensor.reshape(3, 27) @ _SPREAD
    return moved

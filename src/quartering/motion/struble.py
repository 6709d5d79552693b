"""The paper's modified Struble method: one harmonic in balance, the third (and any second) as a linear correction."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.compiled import kernel
from quartering.motion.balance import balance
from quartering.motion.basis import basis
from quartering.motion.dense import lu_factor, lu_solve
from quartering.motion.equations import Floats, System
from quartering.motion.harmonic import harmonic_balance
from quartering.motion.lockstep import add_linear_harmonics
from quartering.threads import in_threads


@kernel
def _correct(first, last, linear, coefficients, powers, modulus, mean, cos, sin, frequency,
             values, rates, factors, weights, known, u):  # fmt: skip
    """Fill the columns of ``u`` (n, 3, b) after the first `known` with their linear response, one condition after another."""
    nb = values.shape[0]
    size, free = 3 * nb, nb - known
    scratch = (np.empty((4, 8)), np.empty(4), np.empty(3), np.empty((3, 4)), np.empty((3, 3, nb)))
    residual, no_matrix, matrix = np.empty(size), np.empty((0, 0)), np.empty((size, size))
    block, right, pivots = np.empty((3 * free, 3 * free)), np.empty(3 * free), np.empty(3 * free, np.int64)
    tables = (values, rates, factors, weights)
    for i in range(first, last):
        system = (linear[i], coefficients[i], powers, modulus, mean[i], cos[i], sin[i], frequency[i])
        # Imbalance of the higher harmonics left by the fundamental, then the linear equations' own matrix.
        balance(system, tables, u[i], 1.0, residual, no_matrix, scratch)
        for k in range(3):
            for b in range(free):
                right[k * free + b] = -residual[k * nb + known + b]
        balance(system, tables, u[i], 0.0, residual, matrix, scratch)
        for k in range(3):
            for b in range(free):
                for j in range(3):
                    for c in range(free):
                        block[k * free + b, j * free + c] = matrix[k * nb + known + b, j * nb + known + c]
        if lu_factor(block, pivots) == 0:
            right[:] = np.nan
        else:
            lu_solve(block, pivots, right)
        for k in range(3):
            for b in range(free):
                u[i, k, known + b] = right[k * free + b]


def modified_struble(
    system: System, *, from_rest: bool = False, start: Floats | None = None
) -> tuple[Floats, tuple[int, ...], NDArray[np.int8], Floats]:
    """Periodic motions of a batch of conditions by the paper's method.

    Parameters
    ----------
    system : System      n conditions
    from_rest : bool     which motion where several exist, as in `harmonic_balance`
    start : (n, 3, b)    start of Newton's method for the fundamental, as in `harmonic_balance`

    Returns
    -------
    u : (n, 3, b) float        coefficients as from `harmonic_balance`, third harmonic included
    orders : tuple of int      (1, 3); (0, 1, 2, 3) when a steady force or an even term breaks the symmetry
    status : (n,) int8         `Status` of the fundamental
    residual : (n,) float      imbalance of the fundamental relative to the excitation

    Notes
    -----
    The six equations (A-11) for the fundamental are one-harmonic balance; (A-8) is one linear solve for the third harmonic,
    which does not act back on the fundamental: its error is of second order in the nonlinearity.
    Source: [H71] eqs. (A-3)-(A-11), [Struble62].

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "K_phiphiphi": 0.2, "N_r": -1.0}
    >>> u, orders, _, _ = modified_struble(Model(np.eye(3), terms, 0.8, (0, 0.1, 0), (0, 0, 0)).system)
    >>> orders, u.shape
    ((1, 3), (1, 3, 4))
    """
    low, orders = ((1,), (1, 3)) if system.symmetric else ((0, 1), (0, 1, 2, 3))
    fundamental, status, residual = harmonic_balance(system, low, start, from_rest=from_rest)
    known = fundamental.shape[2]
    table = basis(orders, system.degree, system.has_modulus)
    u = np.zeros((system.count, 3, table.factors.size))
    u[:, :, :known] = fundamental
    add = add_linear_harmonics if system.plain else _correct
    in_threads(add, system.count, *system.kernel_arrays(), *table.arrays, known, u)
    return u, orders, status, residual

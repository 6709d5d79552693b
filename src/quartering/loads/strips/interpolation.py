"""Four-point interpolation weights over the frequencies of a table, computed once."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.loads.waves import Floats


def frequency_weights(grid: ArrayLike, frequency: ArrayLike) -> tuple[NDArray[np.int64], Floats]:
    """First neighbour and cubic (four-point Lagrange) weights that interpolate a table at given frequencies.

    grid (f,): frequencies of the table, ascending [rad/s]
    frequency (n,): where to interpolate, >= 0 [rad/s]; beyond the table's ends its end values are used
    Returns first (n,): index of the first neighbour; weights (n, q): weights of grid points first .. first + q - 1, q =
        min(4, f); each row adds up to 1

    Source: [Abramowitz64] 25.2 (Lagrange).  Valid: exact for cubics; the end values stand for the limits of zero and
    infinite frequency, so the table must reach where its curves are flat.
    """
    nodes, omega = np.asarray(grid, dtype=float), np.atleast_1d(np.asarray(frequency, dtype=float))
    if nodes.ndim != 1 or nodes.size == 0 or not (np.diff(nodes) > 0).all():
        raise InputError(f"a table needs an ascending list of frequencies; given an array of shape {nodes.shape}")
    if not (np.isfinite(omega) & (omega >= 0)).all():
        raise InputError("a table is read at finite frequencies >= 0; fold negative encounter frequencies first")
    points = min(4, nodes.size)
    omega = np.clip(omega, nodes[0], nodes[-1])
    first = np.clip(np.searchsorted(nodes, omega, side="right") - points // 2, 0, nodes.size - points)
    near = nodes[first[:, None] + np.arange(points)]
    weights = np.ones_like(near)
    for i in range(points):
        for j in range(points):
            if i != j:
                weights[:, i] *= (omega - near[:, j]) / (near[:, i] - near[:, j])
    return first.astype(np.int64), weights


def interpolated(values: ArrayLike, first: NDArray[np.int64], weights: Floats) -> NDArray[np.complex128]:
    """Values of a table between its frequencies.

    values (f, ...): the table [any unit]
    from frequency_weights
    Returns (n, ...): one entry a frequency [the unit of values]

    Source: [Abramowitz64] 25.2 (Lagrange).  Valid: as frequency_weights.
    """
    table = np.asarray(values, dtype=complex)
    shape = (-1,) + (1,) * (table.ndim - 1)
    return sum(
        (weights[:, q].reshape(shape) * table[first + q] for q in range(weights.shape[1])),
        start=np.zeros((first.size, *table.shape[1:]), dtype=complex),
    )

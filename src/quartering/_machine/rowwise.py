"""Products row by row, for arrays whose rows are conditions: no row's digits depend on the rows beside it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import kernel
from quartering._machine.threads import in_threads


def rowwise(rows: NDArray[Any], matrix: NDArray[Any]) -> NDArray[Any]:
    """Each row times a matrix, every row by a product of its own.

    rows (n, k)
    matrix (k, m)
    Returns (n, m)

    ``rows @ matrix`` is one product for the library of linear algebra, which takes rows four or eight at a time and the rest
    otherwise: the last digit of a row then depends on how many rows there are, and where it stands among them. A condition's
    numbers may depend on nothing but the condition.
    """
    return np.asarray(np.matmul(rows[:, None, :], matrix)[:, 0])


def contracted(one: NDArray[Any], other: NDArray[Any]) -> NDArray[Any]:
    """Sum of products over the last axis, of few elements, in one order.

    one, other (..., j): that broadcast
    Returns (...)

    `numpy.einsum` goes through its axes in an order that it chooses by their lengths and strides, and so adds up one row alone
    in another way than many.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # a row without an answer is not finite, and says so itself
        total = one[..., 0] * other[..., 0]
        for j in range(1, one.shape[-1]):
            total = total + one[..., j] * other[..., j]
    return np.asarray(total)


def largest_of_rows(rows: NDArray[Any], matrix: NDArray[Any]) -> NDArray[np.float64]:
    """Largest modulus in each row times a matrix.

    rows (n, k)
    matrix (k, m)
    Returns (n,): NaN of a row that is not finite

    >>> largest_of_rows(np.array([[1.0, -2.0]]), np.eye(2)).tolist()
    [2.0]
    """
    given = (np.require(a, float, ("C", "W")) for a in (rows, matrix))
    out = np.empty(len(rows))
    in_threads(_largest, len(rows), *given, out)
    return out


@kernel
def _largest(first, last, rows, matrix, out):  # type: ignore[no-untyped-def]
    """`largest_of_rows` of rows first..last."""
    own = np.empty(matrix.shape[1])
    for i in range(first, last):
        own[:] = 0.0
        for k in range(matrix.shape[0]):
            for m in range(own.size):
                own[m] += rows[i, k] * matrix[k, m]
        largest = 0.0  # by hand: the compiler's own maximum loads its tables with the kernel
        for m in range(own.size):
            largest = max(largest, abs(own[m]))
        out[i] = np.nan if np.isnan(own[0]) else largest

"""Products row by row, for arrays whose rows are conditions: no row's digits depend on the rows beside it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


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

"""Products row by row, for arrays whose rows are conditions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def rowwise(rows: NDArray[Any], matrix: NDArray[Any]) -> NDArray[Any]:
    """Each row times a matrix, every row by a product of its own.

    Parameters
    ----------
    rows : (n, k) float or complex
    matrix : (k, m)

    Returns
    -------
    (n, m)

    Notes
    -----
    ``rows @ matrix`` is one product for the library of linear algebra, which takes rows four or eight at a time and the rest
    otherwise: the last digit of a row then depends on how many rows there are, and where it stands among them. A condition's
    numbers may depend on nothing but the condition.

    Examples
    --------
    >>> rowwise(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[1.0], [1.0]])).tolist()
    [[3.0], [7.0]]
    """
    return np.asarray(np.matmul(rows[:, None, :], matrix)[:, 0])

"""Small dense linear systems inside compiled kernels: LU with partial pivoting.

It stands here in two forms, as what can be done several at a time differs. Of one matrix (`lu_factor`) the rows are: motions of
many harmonics have hundreds of unknowns, and a branch followed through a fold a row and a column more. Of small matrices of
many conditions (`factor_batch`) those with the same row and column are, whatever each one pivots on. Either form with the
other's loops would work on one number at a time.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from quartering._machine.compiled import batch_kernel, inner
from quartering._machine.simd import every, load, size, store, where_less


@inner
def lu_factor(a, pivots):
    """Factor the square matrix ``a`` in place; returns the sign of its determinant, 0 when it is singular.

    Source: closed form (Gaussian elimination with partial pivoting).
    """
    n = a.shape[0]
    sign = 1
    for j in range(n):
        best, size = j, abs(a[j, j])
        for i in range(j + 1, n):
            if abs(a[i, j]) > size:
                best, size = i, abs(a[i, j])
        pivots[j] = best
        if not size > 0.0 or size > 1e300:
            return 0
        if best != j:
            sign = -sign
            for k in range(n):
                a[j, k], a[best, k] = a[best, k], a[j, k]
        if a[j, j] < 0.0:
            sign = -sign
        inverse = 1.0 / a[j, j]
        for i in range(j + 1, n):
            factor = a[i, j] * inverse
            a[i, j] = factor
            if factor != 0.0:
                for k in range(j + 1, n):
                    a[i, k] -= factor * a[j, k]
    return sign


@inner
def lu_solve(a, pivots, b):
    """Solve in place for one right-hand side ``b``, with ``a`` and ``pivots`` from `lu_factor`.

    Source: closed form (forward and back substitution).
    """
    n = a.shape[0]
    for j in range(n):
        if pivots[j] != j:
            b[j], b[pivots[j]] = b[pivots[j]], b[j]
    for j in range(n):
        for i in range(j + 1, n):
            b[i] -= a[i, j] * b[j]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]


@batch_kernel
def factor_batch(a, pivots, inverse, sign):
    """Factor the matrices ``a`` (m, m, W) in place; ``sign`` (W,) is that of each determinant, 0 where it is singular.

    ``pivots`` (m, W): rows taken, as numbers of the same kind.

    Source: closed form (Gaussian elimination with partial pivoting), conditions in a batch.
    """
    m, width = a.shape[0], a.shape[2]
    store(sign, (), every(1.0))
    for j in range(m):
        best, largest = every(float(j)), size(load(a, (j, j)))
        for i in range(j + 1, m):
            own = size(load(a, (i, j)))
            best, largest = where_less(largest, own, float(i), best), where_less(largest, own, own, largest)
        store(pivots, j, best)
        for l in range(width):
            row = int(pivots[j, l])
            if row != j:
                sign[l] = -sign[l]
                for k in range(m):
                    a[j, k, l], a[row, k, l] = a[row, k, l], a[j, k, l]
            if a[j, j, l] < 0.0:
                sign[l] = -sign[l]
            if not 0.0 < abs(a[j, j, l]) < 1e300:
                sign[l] = 0.0
                a[j, j, l] = 1.0
            inverse[j, l] = 1.0 / a[j, j, l]
        own = load(inverse, j)
        for i in range(j + 1, m):
            factor = load(a, (i, j)) * own
            store(a, (i, j), factor)
            for k in range(j + 1, m):
                store(a, (i, k), load(a, (i, k)) - factor * load(a, (j, k)))


@batch_kernel
def solve_batch(a, pivots, inverse, b):
    """Solve in place for right-hand sides minus ``b`` (m, W) with what `factor_batch` left.

    Source: closed form (forward and back substitution), conditions in a batch.
    """
    m, width = a.shape[0], a.shape[2]
    for j in range(m):
        for l in range(width):
            best = int(pivots[j, l])
            swapped = b[best, l]
            b[best, l] = b[j, l]
            b[j, l] = -swapped
    for i in range(1, m):
        own = load(b, i)
        for j in range(i):
            own -= load(a, (i, j)) * load(b, j)
        store(b, i, own)
    for i in range(m - 1, -1, -1):
        own = load(b, i)
        for k in range(i + 1, m):
            own -= load(a, (i, k)) * load(b, k)
        store(b, i, own * load(inverse, i))

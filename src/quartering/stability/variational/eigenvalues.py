"""Eigenvalues of many small real matrices: the double-shift QR algorithm, compiled.

LAPACK spends most of its time on a 4 x 4 matrix in being called.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.threads import in_threads
from quartering.motion.equations.system import Floats

_ROUNDING = 2.220446049250313e-16
_MOST = 60


@batch_kernel
def _balanced(a):
    """Scale rows and columns by powers of two until they weigh alike, in place; eigenvalues stay."""
    n = a.shape[0]
    for _ in range(10):
        settled = True
        for i in range(n):
            column, row = 0.0, 0.0
            for j in range(n):
                if j != i:
                    column += abs(a[j, i])
                    row += abs(a[i, j])
            if not (column > 0.0 and row > 0.0):
                continue
            factor, total = 1.0, column + row
            while column < 0.5 * row and factor < 1e150:
                factor *= 2.0
                column *= 4.0
            while column > 2.0 * row and factor > 1e-150:
                factor *= 0.5
                column *= 0.25
            if (column + row) / factor < 0.95 * total:
                settled = False
                for j in range(n):
                    a[i, j] /= factor
                for j in range(n):
                    a[j, i] *= factor
        if settled:
            break


@batch_kernel
def _hessenberg(a):
    """Reduce to upper Hessenberg form by elimination with pivoting, in place."""
    n = a.shape[0]
    for m in range(1, n - 1):
        pivot = m
        for i in range(m + 1, n):
            if abs(a[i, m - 1]) > abs(a[pivot, m - 1]):
                pivot = i
        if pivot != m:
            for j in range(m - 1, n):
                a[pivot, j], a[m, j] = a[m, j], a[pivot, j]
            for i in range(n):
                a[i, pivot], a[i, m] = a[i, m], a[i, pivot]
        if a[m, m - 1] == 0.0:
            continue
        for i in range(m + 1, n):
            factor = a[i, m - 1] / a[m, m - 1]
            if factor != 0.0:
                for j in range(m, n):
                    a[i, j] -= factor * a[m, j]
                for j in range(n):
                    a[j, m] += factor * a[j, i]
            a[i, m - 1] = 0.0


@batch_kernel
def _start_of_block(a, last, norm):
    """First row of the unreduced block that ends at row ``last``; the element beside it is set to zero."""
    row = last
    while row >= 1:
        size = abs(a[row - 1, row - 1]) + abs(a[row, row])
        if size == 0.0:
            size = norm
        if abs(a[row, row - 1]) <= _ROUNDING * size:
            a[row, row - 1] = 0.0
            break
        row -= 1
    return row


@batch_kernel
def _pair(a, last, shift, values):
    """The two eigenvalues of the block of rows ``last`` - 1 and ``last``."""
    x, y = a[last, last], a[last - 1, last - 1]
    product = a[last, last - 1] * a[last - 1, last]
    half = 0.5 * (y - x)
    square = half * half + product
    root = math.sqrt(abs(square))
    if square >= 0.0:
        far = half + math.copysign(root, half)
        values[last - 1] = x + shift + far
        values[last] = x + shift - product / far if far != 0.0 else x + shift
    else:
        values[last - 1] = complex(x + shift + half, root)
        values[last] = complex(x + shift + half, -root)


@batch_kernel
def _sweep(a, first, last, x, y, product):
    """One double-shift QR sweep over rows first..last, in place."""
    # Francis' step with the two shifts s1, s2 that are eigenvalues of the last 2 x 2 block, without complex numbers:
    #   (A - s1)(A - s2) e1 = (p, q, r, 0, ..),   s1 + s2 = x + y,   s1 s2 = x y - product .
    # It begins at the lowest row m where two small subdiagonals in turn already split the block off to rounding.
    m = last - 2
    p, q, r = 0.0, 0.0, 0.0
    while True:
        z = a[m, m]
        from_x, from_y = x - z, y - z
        p = (from_x * from_y - product) / a[m + 1, m] + a[m, m + 1]
        q = a[m + 1, m + 1] - z - from_x - from_y
        r = a[m + 2, m + 1]
        size = abs(p) + abs(q) + abs(r)
        p, q, r = p / size, q / size, r / size
        if m == first:
            break
        small = abs(a[m, m - 1]) * (abs(q) + abs(r))
        if small <= _ROUNDING * abs(p) * (abs(a[m - 1, m - 1]) + abs(z) + abs(a[m + 1, m + 1])):
            break
        m -= 1
    for i in range(m + 2, last + 1):
        a[i, i - 2] = 0.0
        if i > m + 2:
            a[i, i - 3] = 0.0
    # Householder's reflection I - (u, v, w)(1, q, r)^T of rows k, k+1, k+2 sends (p, q, r) to (-length, 0, 0). The first one
    # makes a bulge below the subdiagonal, the others chase it down to the corner: a similarity throughout.
    for k in range(m, last):
        three = k < last - 1
        size = 1.0
        if k > m:
            p, q = a[k, k - 1], a[k + 1, k - 1]
            r = a[k + 2, k - 1] if three else 0.0
            size = abs(p) + abs(q) + abs(r)
            if size == 0.0:
                continue
            p, q, r = p / size, q / size, r / size
        length = math.copysign(math.sqrt(p * p + q * q + r * r), p)
        if k > m:
            a[k, k - 1] = -length * size
        elif first != m:
            a[k, k - 1] = -a[k, k - 1]
        p += length
        u, v, w = p / length, q / length, r / length
        q, r = q / p, r / p
        for j in range(k, last + 1):
            along = a[k, j] + q * a[k + 1, j]
            if three:
                along += r * a[k + 2, j]
                a[k + 2, j] -= along * w
            a[k + 1, j] -= along * v
            a[k, j] -= along * u
        for i in range(first, min(last, k + 3) + 1):
            along = u * a[i, k] + v * a[i, k + 1]
            if three:
                along += w * a[i, k + 2]
                a[i, k + 2] -= along * r
            a[i, k + 1] -= along * q
            a[i, k] -= along


@batch_kernel
def _values(a, values):
    """Eigenvalues of one matrix, which is lost; False when the sweeps do not converge."""
    n = a.shape[0]
    _balanced(a)
    _hessenberg(a)
    norm = 0.0
    for i in range(n):
        for j in range(n):
            norm += abs(a[i, j])
    if not norm < 1e300:
        return False
    last, shift, sweeps = n - 1, 0.0, 0
    # The block first..last is the lowest one not yet split: one row is a real eigenvalue, two rows a pair, more take a
    # sweep, after which the last subdiagonal falls off quadratically.
    while last >= 0:
        first = _start_of_block(a, last, norm)
        if first == last:
            values[last] = a[last, last] + shift
            last, sweeps = last - 1, 0
            continue
        if first == last - 1:
            _pair(a, last, shift, values)
            last, sweeps = last - 2, 0
            continue
        if sweeps == _MOST:
            return False
        x, y = a[last, last], a[last - 1, last - 1]
        product = a[last, last - 1] * a[last - 1, last]
        if sweeps % 10 == 9:  # a shift out of the ordinary, where sweeps go round in a circle
            shift += x
            for i in range(last + 1):
                a[i, i] -= x
            size = abs(a[last, last - 1]) + abs(a[last - 1, last - 2])
            x = y = 0.75 * size
            product = -0.4375 * size * size
        _sweep(a, first, last, x, y, product)
        sweeps += 1
    return True


@kernel
def _all_values(first, last, matrices, values):
    """Eigenvalues (n, m) of matrices (n, m, m) first..last; NaN where they are not found."""
    m = matrices.shape[1]
    a = np.empty((m, m))
    for i in range(first, last):
        for j in range(m):
            for k in range(m):
                a[j, k] = matrices[i, j, k]
        if not _values(a, values[i]):
            for j in range(m):
                values[i, j] = complex(np.nan, np.nan)


def eigenvalues(matrices: Floats) -> NDArray[np.complex128]:
    """Eigenvalues of a batch of small real matrices, in no particular order.

    matrices (n, m, m)
    Returns (n, m): NaN where a matrix is not finite

    Source: [Francis61] double-shift QR with the deflation and exceptional shifts of EISPACK's HQR; a matrix on which its
    sweeps do not settle is left to LAPACK.
    """
    values = np.empty(matrices.shape[:2], complex)
    in_threads(_all_values, matrices.shape[0], np.require(matrices, float, ("C", "W")), values)
    lost = np.flatnonzero(np.isnan(values[:, 0]) & np.isfinite(matrices).all(axis=(1, 2)))
    if lost.size:
        values[lost] = np.linalg.eigvals(matrices[lost])
    return values

"""Eigenvalues of many small real matrices: the double-shift QR algorithm, compiled.

LAPACK spends most of its time on a 4 x 4 matrix in being called. Here eight of them go side by side: each sweep is one long
chain of square roots and divisions, and eight chains take no longer than one.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.simd import LANES, all_at_most, every, load, root, size, store, where_less
from quartering._machine.threads import in_threads
from quartering.motion.equations.system import Floats

_ROUNDING = 2.220446049250313e-16
_MOST = 60


@batch_kernel
def _balanced(a):
    """Scale rows and columns (m, m, W) by powers of two until they weigh alike, in place; eigenvalues stay."""
    n = a.shape[0]
    for _ in range(10):
        settled = True
        for i in range(n):
            column, row = every(0.0), every(0.0)
            for j in range(n):
                if j != i:
                    column += size(load(a, (j, i)))
                    row += size(load(a, (i, j)))
            factor, total = every(1.0), column + row
            both = where_less(0.0, column, row, 0.0)
            while True:
                light = where_less(column, 0.5 * both, where_less(factor, 1e150, 1.0, 0.0), 0.0)
                if all_at_most(light, 0.0):
                    break
                factor, column = factor * (1.0 + light), column * (1.0 + 3.0 * light)
            while True:
                heavy = where_less(2.0 * row, column, where_less(1e-150, factor, 1.0, 0.0), 0.0)
                heavy = where_less(0.0, both, heavy, 0.0)
                if all_at_most(heavy, 0.0):
                    break
                factor, column = factor * (1.0 - 0.5 * heavy), column * (1.0 - 0.75 * heavy)
            # where nothing is gained the factor is 1
            gains = where_less((column + row) / factor, 0.95 * total, 1.0, 0.0)
            if all_at_most(gains, 0.0):
                continue
            settled, factor = False, where_less(0.5, gains, factor, 1.0)
            for j in range(n):
                store(a, (i, j), load(a, (i, j)) / factor)
            for j in range(n):
                store(a, (j, i), load(a, (j, i)) * factor)
        if settled:
            break


@batch_kernel
def _hessenberg(a):
    """Reduce matrices (m, m, W) to upper Hessenberg form by elimination with pivoting, in place."""
    n = a.shape[0]
    for m in range(1, n - 1):
        pivot, largest = every(float(m)), size(load(a, (m, m - 1)))
        for i in range(m + 1, n):
            own = size(load(a, (i, m - 1)))
            pivot, largest = where_less(largest, own, float(i), pivot), where_less(largest, own, own, largest)
        for i in range(m + 1, n):
            here = where_less(i - 0.5, pivot, where_less(pivot, i + 0.5, 1.0, 0.0), 0.0)
            if all_at_most(here, 0.0):
                continue
            for j in range(m - 1, n):
                upper, lower = load(a, (m, j)), load(a, (i, j))
                store(a, (m, j), where_less(0.5, here, lower, upper))
                store(a, (i, j), where_less(0.5, here, upper, lower))
            for j in range(n):
                left, right = load(a, (j, m)), load(a, (j, i))
                store(a, (j, m), where_less(0.5, here, right, left))
                store(a, (j, i), where_less(0.5, here, left, right))
        below = load(a, (m, m - 1))
        divisor = where_less(0.0, size(below), below, 1.0)  # where the pivot is nil there is nothing to eliminate
        for i in range(m + 1, n):
            factor = load(a, (i, m - 1)) / divisor
            for j in range(m, n):
                store(a, (i, j), load(a, (i, j)) - factor * load(a, (m, j)))
            for j in range(n):
                store(a, (j, m), load(a, (j, m)) + factor * load(a, (j, i)))
            store(a, (i, m - 1), every(0.0))


@batch_kernel
def _start_of_block(a, last, norm, l):
    """First row of the unreduced block of lane ``l`` that ends at row ``last``; the element beside it is set to zero."""
    row = last
    while row >= 1:
        size = abs(a[row - 1, row - 1, l]) + abs(a[row, row, l])
        if size == 0.0:
            size = norm
        if abs(a[row, row - 1, l]) <= _ROUNDING * size:
            a[row, row - 1, l] = 0.0
            break
        row -= 1
    return row


@batch_kernel
def _pair(a, last, shift, l, values):
    """The two eigenvalues of the block of rows ``last`` - 1 and ``last``."""
    x, y = a[last, last, l], a[last - 1, last - 1, l]
    product = a[last, last - 1, l] * a[last - 1, last, l]
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
def _split_off(a, l, norm, block, shift, sweeps, values):
    """Take the eigenvalues that have fallen off in lane ``l``; leaves its next ``block`` (2, W): first row, last row.

    The block is the lowest one not yet split: one row is a real eigenvalue, two rows a pair, more take a sweep, after which
    the last subdiagonal falls off quadratically. False where the sweeps do not settle.
    """
    while block[1, l] >= 0:
        last = block[1, l]
        first = _start_of_block(a, last, norm, l)
        if last - first > 1:
            block[0, l] = first
            return sweeps[l] < _MOST
        if first == last:
            values[last] = a[last, last, l] + shift[l]
        else:
            _pair(a, last, shift[l], l, values)
        block[1, l], sweeps[l] = first - 1, 0
    return True


@batch_kernel
def _shifts(a, l, block, shift, sweeps, begin):
    """What the first reflection of lane ``l`` is made from, into ``begin`` (8, W): x, y and product of the shifts, elements.

    Francis' step has the two shifts s1, s2 that are eigenvalues of the last 2 x 2 block: s1 + s2 = x + y,
    s1 s2 = x y - product.
    """
    first, last = block[0, l], block[1, l]
    x, y = a[last, last, l], a[last - 1, last - 1, l]
    product = a[last, last - 1, l] * a[last - 1, last, l]
    if sweeps[l] % 10 == 9:  # a shift out of the ordinary, where sweeps go round in a circle
        shift[l] += x
        for i in range(last + 1):
            a[i, i, l] -= x
        size = abs(a[last, last - 1, l]) + abs(a[last - 1, last - 2, l])
        x = y = 0.75 * size
        product = -0.4375 * size * size
    sweeps[l] += 1
    begin[0, l], begin[1, l], begin[2, l] = x, y, product
    begin[3, l], begin[4, l] = a[first, first, l], a[first + 1, first, l]
    begin[5, l], begin[6, l], begin[7, l] = (
        a[first, first + 1, l], a[first + 1, first + 1, l], a[first + 2, first + 1, l],
    )  # fmt: skip


@batch_kernel
def _sweep(a, flags, begin):
    """One double-shift QR sweep of all lanes, in place, each over its own block.

    ``flags`` (3, n, W): 1 where a lane's sweep begins at row k, where it has a reflection of rows k, k + 1, and of a third
    """
    # Francis' step without complex numbers begins with (A - s1)(A - s2) e1 = (p, q, r, 0, ..).
    n = a.shape[0]
    z, below = load(begin, 3), load(begin, 4)
    from_x, from_y = load(begin, 0) - z, load(begin, 1) - z
    p0 = (from_x * from_y - load(begin, 2)) / below + load(begin, 5)
    q0, r0 = load(begin, 6) - z - from_x - from_y, load(begin, 7)
    # Householder's reflection I - (u, v, w)(1, q, r)^T of rows k, k+1, k+2 sends (p, q, r) to (-length, 0, 0). The first one
    # makes a bulge below the subdiagonal, the others chase it down to the corner: a similarity throughout, of the whole matrix.
    for k in range(n - 1):
        start, active, three = load(flags, (0, k)), load(flags, (1, k)), load(flags, (2, k))
        p, q, r = p0, q0, r0
        if k > 0:
            p, q = where_less(0.5, start, p0, load(a, (k, k - 1))), where_less(0.5, start, q0, load(a, (k + 1, k - 1)))
            if k + 2 < n:
                r = where_less(0.5, start, r0, load(a, (k + 2, k - 1)))
        r = where_less(0.5, three, r, 0.0)
        total = where_less(0.5, active, size(p) + size(q) + size(r), 0.0)
        whole = where_less(0.0, total, total, 1.0)
        p, q, r = where_less(0.0, total, p / whole, 1.0), q / whole, r / whole
        q, r = where_less(0.0, total, q, 0.0), where_less(0.0, total, r, 0.0)
        length = root(p * p + q * q + r * r)
        length = where_less(p, 0.0, -length, length)
        if k > 0:
            chased = where_less(0.5, start, load(a, (k, k - 1)), -length * whole)
            store(a, (k, k - 1), where_less(0.0, total, chased, load(a, (k, k - 1))))
            store(a, (k + 1, k - 1), every(0.0))
            if k + 2 < n:
                store(a, (k + 2, k - 1), every(0.0))
        p = p + length
        u, v, w = where_less(0.0, total, p / length, 0.0), q / length, r / length
        q, r = q / p, r / p
        for j in range(k, n):
            top, middle = load(a, (k, j)), load(a, (k + 1, j))
            along = top + q * middle
            if k + 2 < n:
                low = load(a, (k + 2, j))
                along = along + r * low
                store(a, (k + 2, j), low - along * w)
            store(a, (k + 1, j), middle - along * v)
            store(a, (k, j), top - along * u)
        for i in range(min(n, k + 4)):
            left, middle = load(a, (i, k)), load(a, (i, k + 1))
            along = u * left + v * middle
            if k + 2 < n:
                right = load(a, (i, k + 2))
                along = along + w * right
                store(a, (i, k + 2), right - along * r)
            store(a, (i, k + 1), middle - along * q)
            store(a, (i, k), left - along)


@batch_kernel
def _made_ready(matrices, begin, last, ready, norms):
    """Put the matrices (n, m, m) from ``begin`` on, balanced and reduced, into ``ready`` (m, m, W), and sums of moduli."""
    m = ready.shape[0]
    for l in range(LANES):
        matrix = matrices[min(begin + l, last - 1)]
        for j in range(m):
            for k in range(m):
                ready[j, k, l] = matrix[j, k]
    _balanced(ready)
    _hessenberg(ready)
    norm = every(0.0)
    for j in range(m):
        for k in range(m):
            norm += size(load(ready, (j, k)))
    store(norms, (), norm)


@kernel
def _all_values(first, last, matrices, values):
    """Eigenvalues (n, m) of matrices (n, m, m) first..last; NaN where they are not found."""
    m = matrices.shape[1]
    ready, norms, a = np.empty((m, m, LANES)), np.empty(LANES), np.zeros((m, m, LANES))
    norm, shift, sweeps = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES, np.int64)
    block, flags, begin = np.zeros((2, LANES), np.int64), np.zeros((3, m, LANES)), np.zeros((8, LANES))
    # As in Newton's method a lane takes the next matrix as soon as its own is done; eight at a time are made ready.
    held, ahead = np.full(LANES, -1), first
    while True:
        working = False
        store(begin, 4, every(1.0))
        for j in range(3):
            for k in range(m):
                store(flags, (j, k), every(0.0))
        for l in range(LANES):
            while True:
                if held[l] < 0:
                    if ahead >= last:
                        break
                    of = (ahead - first) % LANES
                    if of == 0:
                        _made_ready(matrices, ahead, last, ready, norms)
                    held[l], block[1, l], shift[l], sweeps[l], norm[l] = ahead, m - 1, 0.0, 0, norms[of]
                    for j in range(m):
                        for k in range(m):
                            a[j, k, l] = ready[j, k, of]
                    ahead += 1
                own = values[held[l]]
                settles = norm[l] < 1e300 and _split_off(a, l, norm[l], block, shift, sweeps, own)
                if settles and block[1, l] >= 0:
                    break
                if not settles:
                    own[:] = complex(np.nan, np.nan)
                held[l] = -1
            if held[l] >= 0:
                working = True
                _shifts(a, l, block, shift, sweeps, begin)
                flags[0, block[0, l], l] = 1.0
                for k in range(block[0, l], block[1, l]):
                    flags[1, k, l], flags[2, k, l] = 1.0, 1.0 if k < block[1, l] - 1 else 0.0
        if not working:
            break
        _sweep(a, flags, begin)


def eigenvalues(matrices: Floats) -> NDArray[np.complex128]:
    """Eigenvalues of a batch of small real matrices, in no particular order.

    matrices (n, m, m)
    Returns (n, m): NaN where a matrix is not finite

    Source: [Francis61] double-shift QR with the deflation and exceptional shifts of EISPACK's HQR; a matrix on which its
    sweeps do not settle is left to LAPACK.
    """
    values = np.empty(matrices.shape[:2], complex)
    in_threads(_all_values, matrices.shape[0], np.require(matrices, float, ("C", "W")), values)
    lost = np.flatnonzero(np.isnan(values[:, 0]))
    lost = lost[np.isfinite(matrices[lost]).all(axis=(1, 2))]
    if lost.size:
        values[lost] = np.linalg.eigvals(matrices[lost])
    return values

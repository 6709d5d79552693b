"""Products and exponentials of 4 x 4 matrices (4, 4, W), a vector of conditions at once."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

from quartering._machine.compiled import batch_kernel
from quartering._machine.simd import LANES, every, load, size, store, where_less

ROW: Final = LANES
"""Conditions at once."""


@batch_kernel
def product(a, b, out):
    """out = a b; ``out`` is neither of them."""
    for j in range(4):  # a column of b stays in registers for all rows of a
        b0, b1, b2, b3 = load(b, (0, j)), load(b, (1, j)), load(b, (2, j)), load(b, (3, j))
        for i in range(4):
            first = load(a, (i, 0)) * b0 + load(a, (i, 1)) * b1
            store(out, (i, j), first + load(a, (i, 2)) * b2 + load(a, (i, 3)) * b3)


@batch_kernel
def commutator(a, b, out):
    """out = a b - b a; ``out`` is neither of them."""
    product(a, b, out)
    for j in range(4):
        a0, a1, a2, a3 = load(a, (0, j)), load(a, (1, j)), load(a, (2, j)), load(a, (3, j))
        for i in range(4):
            first = load(out, (i, j)) - load(b, (i, 0)) * a0 - load(b, (i, 1)) * a1
            store(out, (i, j), first - load(b, (i, 2)) * a2 - load(b, (i, 3)) * a3)


@batch_kernel
def _halve(x, norm, halvings):
    """Halve each matrix until its norm is below 1/2; returns the largest number of ``halvings`` (W,)."""
    largest = every(0.0)
    for i in range(4):
        row = size(load(x, (i, 0))) + size(load(x, (i, 1))) + size(load(x, (i, 2))) + size(load(x, (i, 3)))
        largest = where_less(largest, row, row, largest)
    store(norm, (), largest)
    most = 0.0
    for l in range(ROW):
        halvings[l], scale = 0.0, 1.0
        while norm[l] * scale > 0.5 and halvings[l] < 60.0:
            scale *= 0.5
            halvings[l] += 1.0
        most = max(most, halvings[l])
        norm[l] = scale
    scale = load(norm, ())
    for i in range(4):
        for j in range(4):
            store(x, (i, j), load(x, (i, j)) * scale)
    return most


@batch_kernel
def exponential(x, square, cube, part, norm, halvings, out):
    """out = exp(x) by its series to x^8 after halving x, and squaring as often; x is lost.

    Source: closed form; below a norm of 1/2 what the series leaves out is below 6e-9.
    """
    most = int(_halve(x, norm, halvings))
    product(x, x, square)
    product(square, x, cube)
    for i in range(4):
        for j in range(4):
            one = 1.0 / 720.0 if i == j else 0.0
            store(part, (i, j), one + load(x, (i, j)) * (1.0 / 5040.0) + load(square, (i, j)) * (1.0 / 40320.0))
    product(cube, part, out)
    for i in range(4):
        for j in range(4):
            one = 1.0 / 6.0 if i == j else 0.0
            left = one + load(x, (i, j)) * (1.0 / 24.0) + load(square, (i, j)) * (1.0 / 120.0)
            store(part, (i, j), left + load(out, (i, j)))
    product(cube, part, out)
    for i in range(4):
        for j in range(4):
            one = 1.0 if i == j else 0.0
            store(out, (i, j), load(out, (i, j)) + (one + load(x, (i, j)) + 0.5 * load(square, (i, j))))
    wanted = load(halvings, ())
    for n in range(most):
        product(out, out, part)
        for i in range(4):
            for j in range(4):
                store(out, (i, j), where_less(float(n), wanted, load(part, (i, j)), load(out, (i, j))))

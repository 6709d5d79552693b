"""Products and exponentials of 4 x 4 matrices (4, 4, W), a batch of them."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from quartering._machine.compiled import batch_kernel

ROW = 32
"""Conditions of a batch: their matrices stay in the processor's fastest memory."""


@batch_kernel
def product(a, b, out):
    """out = a b."""
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                out[i, j, l] = (
                    a[i, 0, l] * b[0, j, l]
                    + a[i, 1, l] * b[1, j, l]
                    + a[i, 2, l] * b[2, j, l]
                    + a[i, 3, l] * b[3, j, l]
                )


@batch_kernel
def commutator(a, b, scratch, out):
    """out = a b - b a."""
    product(a, b, out)
    product(b, a, scratch)
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                out[i, j, l] -= scratch[i, j, l]


@batch_kernel
def _halve(x, norm, halvings):
    """Halve each matrix until its norm is below 1/2; returns the largest number of ``halvings`` (W,)."""
    for l in range(ROW):
        norm[l] = 0.0
    for i in range(4):
        for l in range(ROW):
            row = abs(x[i, 0, l]) + abs(x[i, 1, l]) + abs(x[i, 2, l]) + abs(x[i, 3, l])
            norm[l] = max(norm[l], row)
    most = 0
    for l in range(ROW):
        halvings[l], scale = 0, 1.0
        while norm[l] * scale > 0.5 and halvings[l] < 60:
            scale *= 0.5
            halvings[l] += 1
        most = max(most, halvings[l])
        norm[l] = scale
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                x[i, j, l] *= norm[l]
    return most


@batch_kernel
def exponential(x, square, cube, part, norm, halvings, out):
    """out = exp(x) by its series to x^8 after halving x, and squaring as often; x is lost.

    Source: closed form; below a norm of 1/2 what the series leaves out is below 6e-9.
    """
    most = _halve(x, norm, halvings)
    product(x, x, square)
    product(square, x, cube)
    for i in range(4):
        for j in range(4):
            one = 1.0 / 720.0 if i == j else 0.0
            for l in range(ROW):
                part[i, j, l] = one + x[i, j, l] * (1.0 / 5040.0) + square[i, j, l] * (1.0 / 40320.0)
    product(cube, part, out)
    for i in range(4):
        for j in range(4):
            one = 1.0 / 6.0 if i == j else 0.0
            for l in range(ROW):
                part[i, j, l] = out[i, j, l] + one + x[i, j, l] * (1.0 / 24.0) + square[i, j, l] * (1.0 / 120.0)
    product(cube, part, out)
    for i in range(4):
        for j in range(4):
            one = 1.0 if i == j else 0.0
            for l in range(ROW):
                out[i, j, l] += one + x[i, j, l] + 0.5 * square[i, j, l]
    for n in range(most):
        product(out, out, part)
        for i in range(4):
            for j in range(4):
                for l in range(ROW):
                    out[i, j, l] = part[i, j, l] if n < halvings[l] else out[i, j, l]

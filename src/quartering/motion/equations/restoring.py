"""The restoring moment from a table of cubics, and the piece of it that holds each roll angle: compiled kernels.

A piece is found without a search, and without a branch, which processors guess wrong where lanes roll differently: angles are
cut into equal cells, and a guide holds the piece that each cell begins in and the knot where the next one begins, of which a
cell holds one at most. A table with knots closer than that is searched, lane by lane.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from typing import Final

import numpy as np

from quartering._machine.compiled import batch_kernel
from quartering._machine.simd import load, pick, size, store, where_less

CELLS: Final = 128
"""Equal cells of the guide, of 0.75 degrees; beyond them is one more, without end."""
_A_RADIAN: Final = CELLS / math.radians(96.0)
_NEAR = 1e-9  # of a cell's end: rounding must not lead past a knot that stands there


@batch_kernel
def one_table(knots, cubics, of, one):
    """Have the conditions ``of`` (W,) of tables (n, b) and (n, b, 4) all that of condition ``one``?"""
    at, by = knots[one], cubics[one]
    for l in range(of.size):
        own_at, own = knots[of[l]], cubics[of[l]]
        for b in range(knots.shape[1] if of[l] != one else 0):
            if own_at[b] != at[b] or own[b, 0] != by[b, 0] or own[b, 1] != by[b, 1]:
                return False
            if own[b, 2] != by[b, 2] or own[b, 3] != by[b, 3]:
                return False
    return True


@batch_kernel
def lay_out(knots, cubics, table, guide):
    """One table (5, b), its knots (b,) in front of the cubics (b, 4), and ``guide`` (2, c): the piece that each cell begins in,
    and the angle at which the next one does. False where a cell holds more than one knot.
    """
    most, b, single = knots.size - 1, 0, True
    for i in range(most + 1):
        table[0, i] = knots[i]
        for j in range(4):
            table[1 + j, i] = cubics[i, j]
    for cell in range(CELLS + 1):
        begin, end = (1.0 - _NEAR) * cell / _A_RADIAN, (1.0 + _NEAR) * (cell + 1) / _A_RADIAN
        while b < most and begin > knots[b + 1]:
            b += 1
        guide[0, cell], guide[1, cell] = b, knots[b + 1] if b < most else np.inf
        single = single and not (b + 2 <= most and (cell == CELLS or knots[b + 2] < end))
    return single


@batch_kernel
def _piece(guide, far):
    """Which piece holds each angle ``far``, not below 0."""
    place = far * _A_RADIAN
    cell = where_less(place, float(CELLS), place, float(CELLS))
    piece = pick(guide[0], cell)
    return where_less(pick(guide[1], cell), far, piece + 1.0, piece)


@batch_kernel
def moment_of_table(table, guide, angle, out):
    """Moment (W,) at the roll angles, odd in them."""
    turned = load(angle, ())
    far = size(turned)
    piece = _piece(guide, far)
    x = far - pick(table[0], piece)
    a, b, c, d = pick(table[1], piece), pick(table[2], piece), pick(table[3], piece), pick(table[4], piece)
    moment = a + x * (b + x * (c + x * d))
    store(out, (), where_less(turned, 0.0, -moment, moment))


@batch_kernel
def slope_of_table(table, guide, angle, out):
    """Its derivative (W,) by the roll angle."""
    far = size(load(angle, ()))
    piece = _piece(guide, far)
    x = far - pick(table[0], piece)
    b, c, d = pick(table[2], piece), pick(table[3], piece), pick(table[4], piece)
    store(out, (), b + x * (2.0 * c + 3.0 * x * d))


@batch_kernel
def moment_of_tables(knots, cubics, angle, out):
    """`moment_of_table` where each lane has a table of its own."""
    most = knots.shape[0] - 1
    for l in range(angle.size):
        size, b = abs(angle[l]), 0
        while b < most and size > knots[b + 1, l]:
            b += 1
        x = size - knots[b, l]
        moment = cubics[b, 0, l] + x * (cubics[b, 1, l] + x * (cubics[b, 2, l] + x * cubics[b, 3, l]))
        out[l] = moment if angle[l] >= 0.0 else -moment


@batch_kernel
def slope_of_tables(knots, cubics, angle, out):
    """`slope_of_table` where each lane has a table of its own."""
    most = knots.shape[0] - 1
    for l in range(angle.size):
        size, b = abs(angle[l]), 0
        while b < most and size > knots[b + 1, l]:
            b += 1
        x = size - knots[b, l]
        out[l] = cubics[b, 1, l] + x * (2.0 * cubics[b, 2, l] + 3.0 * x * cubics[b, 3, l])

"""The restoring moment from a table of cubics, and the piece of it that holds each roll angle: compiled kernels.

A piece is found without a search: the angles up to the last knot are cut into equal cells, of which one multiplication tells
the number, and a guide holds the piece that each cell begins in. As cells are narrower than most pieces, at most a knot or two
are passed from there.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

from quartering._machine.compiled import batch_kernel

CELLS: Final = 64
"""Equal cells of the guide: narrower than the pieces of a ship's own curve, every 4 degrees to 88."""
_BEFORE = 1.0 - 1e-9  # of a cell's left end: rounding must not lead past a knot that stands there


@batch_kernel
def one_table(knots, cubics, of):
    """Have the conditions ``of`` (W,) of tables (n, b) and (n, b, 4) all the same one?"""
    different = 0
    for l in range(1, of.size):
        if of[l] != of[0]:
            for b in range(knots.shape[1]):
                different += knots[of[l], b] != knots[of[0], b]
                for j in range(4):
                    different += cubics[of[l], b, j] != cubics[of[0], b, j]
    return different == 0


@batch_kernel
def lay_out(knots, cubics, table, guide):
    """One table (b, 5), its knots (b,) in front of the cubics (b, 4), and the piece (c,) that each cell begins in."""
    most, b = knots.size - 1, 0
    for i in range(most + 1):
        table[i, 0] = knots[i]
        for j in range(4):
            table[i, 1 + j] = cubics[i, j]
    for cell in range(guide.size):
        begin = _BEFORE * cell * knots[most] / guide.size
        while b < most and begin > knots[b + 1]:
            b += 1
        guide[cell] = b


@batch_kernel
def moment_of_table(table, guide, angle, out):
    """Moment (W,) at the roll angles, odd in them."""
    most = table.shape[0] - 1
    cells = guide.size
    by = cells / table[most, 0] if most > 0 else 0.0
    for l in range(angle.size):
        size = abs(angle[l])
        place = size * by
        b = guide[int(place)] if place < cells else most
        while b < most and size > table[b + 1, 0]:
            b += 1
        x = size - table[b, 0]
        moment = table[b, 1] + x * (table[b, 2] + x * (table[b, 3] + x * table[b, 4]))
        out[l] = moment if angle[l] >= 0.0 else -moment


@batch_kernel
def slope_of_table(table, guide, angle, out):
    """Its derivative (W,) by the roll angle."""
    most = table.shape[0] - 1
    cells = guide.size
    by = cells / table[most, 0] if most > 0 else 0.0
    for l in range(angle.size):
        size = abs(angle[l])
        place = size * by
        b = guide[int(place)] if place < cells else most
        while b < most and size > table[b + 1, 0]:
            b += 1
        x = size - table[b, 0]
        out[l] = table[b, 2] + x * (2.0 * table[b, 3] + 3.0 * x * table[b, 4])


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

"""What the harmonics left out would do to roll, estimated for many motions at once without solving again.

The equations are written for a wider set of harmonics, in which the motion found leaves the force's next harmonics unbalanced.
Newton's first step from there is what they do to linear order: their own motion, and what it does back to the harmonics kept.
Where that is small it is the difference to the motion in the wider set but for its square; near a fold it is large, and so
is the difference.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np

from quartering._machine.compiled import kernel
from quartering._machine.rowwise import largest_of_rows
from quartering._machine.threads import in_threads
from quartering.motion.equations.rates import WIDTH, fill, gather, row_of_lanes
from quartering.motion.equations.system import Floats, System, kernel_arguments
from quartering.motion.steady.balance import balance, room_for_one
from quartering.motion.steady.dense import factor_batch, lu_factor, lu_solve, solve_batch
from quartering.motion.steady.harmonic import MOST_HARMONICS
from quartering.motion.steady.newton import balance_batch, derivative_batch, gather_motions, room_for_balance
from quartering.motion.steady.truncation import columns_of, widened

FEWEST_OF_ESTIMATE: Final = 24
"""Samples of a cycle: what they misjudge of |q| q, 6/24^3, is far below the share that calls for more harmonics."""
_STEP: Final = 2
_MOST_COLUMNS: Final = 40
_PHASES: Final = 24


@kernel
def _first_step(first, last, program, parts, tables, u, out):
    """Newton's first step in roll (n, b) from the motions (n, 3, b), conditions in a batch."""
    nb = tables[2].size
    size = 3 * nb
    lanes = row_of_lanes(parts, WIDTH)
    room = room_for_balance(program, lanes, tables)
    motion, step = np.zeros((3, nb, WIDTH)), np.zeros((size, WIDTH))
    matrix, pivots = np.zeros((size, size, WIDTH)), np.zeros((size, WIDTH))
    inverse, sign = np.zeros((size, WIDTH)), np.zeros(WIDTH)
    for begin in range(first, last, WIDTH):
        gather(begin, last, parts, lanes)
        gather_motions(begin, last, u, motion)
        derivative_batch(program, tables, lanes, motion, matrix, room)
        factor_batch(matrix, pivots, inverse, sign)
        balance_batch(program, tables, lanes, motion, step, room)
        solve_batch(matrix, pivots, inverse, step)
        for l in range(min(WIDTH, last - begin)):
            for b in range(nb):
                out[begin + l, b] = step[nb + b, l]


@kernel
def _first_step_with_autopilot(first, last, program, parts, tables, u, out):
    """As `_first_step`, one condition after another: an autopilot's state adds columns that a batch does not hold."""
    nb = tables[2].size
    size = 3 * nb
    room = room_for_one(program, parts, tables)
    residual, matrix, pivots = np.empty(size), np.empty((size, size)), np.empty(size, np.int64)
    for i in range(first, last):
        fill(i, 1.0, parts, room[0])
        balance((program, parts, i, 1.0), tables, u[i], residual, matrix, room)
        if lu_factor(matrix, pivots) == 0:
            continue
        lu_solve(matrix, pivots, residual)
        for b in range(nb):
            out[i, b] = -residual[nb + b]


def missed_roll(system: System, u: Floats, orders: tuple[int, ...]) -> Floats:
    """Estimate of what the next harmonics change of roll.

    system: n conditions
    u (n, 3, b): motions, as from `harmonic_balance`; NaN where there is none
    orders: harmonics of them
    Returns (n,): largest change of the roll angle over a cycle, as a share of the roll amplitude; NaN where there is no
        motion, and beyond the most harmonics that there are

    Newton's first step in a set with the next two harmonics.  Source: [Krack19].

    >>> from quartering.motion.equations.model import Model
    >>> from quartering.motion.steady.harmonic import harmonic_balance
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_phiphiphi": 0.1, "K_p": -0.1, "N_r": -1.0}
    >>> system = Model(np.eye(3), terms, 0.5, (0, 0.4, 0), (0, 0, 0)).system
    >>> missed_roll(system, harmonic_balance(system, (1,))[0], (1,)).round(3).tolist()
    [0.006]
    """
    top = max(orders) + _STEP
    wider = tuple(h for h in range(top + 1) if h in orders or h > max(orders)) if 0 in orders else (*orders, top)
    columns = columns_of(wider)
    out = np.full((system.count, len(columns)), np.nan)
    found = np.isfinite(u).all(axis=(1, 2)) & system.finite
    if top > MOST_HARMONICS or not found.any():
        return np.asarray(out[:, 0])
    table = system.basis(wider, fewest=FEWEST_OF_ESTIMATE)
    start = np.ascontiguousarray(widened(np.where(found[:, None, None], u, 0.0), orders, wider))
    batched = system.plain and len(columns) <= _MOST_COLUMNS
    in_threads(
        _first_step if batched else _first_step_with_autopilot,
        system.count,
        *kernel_arguments(system, table),
        start,
        out,
    )
    out[~found] = np.nan
    phases = 2 * np.pi * np.arange(_PHASES) / _PHASES
    over = np.array([np.sin(h * phases) if part == "sin" else np.cos(h * phases) for h, part in columns])
    first = columns.index((min(h for h in orders if h), "cos"))
    roll = np.hypot(start[:, 1, first], start[:, 1, first + 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(largest_of_rows(out, over) / roll)

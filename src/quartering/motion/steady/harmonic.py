"""Harmonic balance: periodic motions of many conditions through one compiled kernel."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner, kernel
from quartering._machine.threads import in_threads
from quartering.conventions import InputError
from quartering.motion.equations.basis import Basis
from quartering.motion.equations.batch import rows
from quartering.motion.equations.rates import WIDTH, fill
from quartering.motion.equations.system import FEWEST, Floats, System, kernel_arguments
from quartering.motion.status import Status
from quartering.motion.steady.balance import balance, copy_motion, newton, room_for_one
from quartering.motion.steady.follow import follow
from quartering.motion.steady.newton import (
    ALTERED,
    FOUND,
    FOUND_ALTERED,
    TO_FOLLOW,
    WAITING,
    imbalances,
    newton_batch,
)

MOST_HARMONICS: Final = 199
"""Highest harmonic taken: the work grows with its cube, 0.6 s a motion here; a righting spline needs 101 for 1e-8."""
_CONVERGED, _BY_FOLLOWING = int(Status.CONVERGED), int(Status.CONVERGED_BY_FOLLOWING)
_RUNAWAY = 1e9
_NO_MOTION, _SINGULAR, _NOT_FINITE = int(Status.NO_MOTION_FOUND), int(Status.SINGULAR), int(Status.NOT_FINITE)

_MOST_BATCHED = 40
"""Columns of a motion up to which a row of conditions is tried in a batch, be they many or one: beyond, their matrices would
fill the memory. The number of conditions must not decide: the two ways differ in the last digits."""


@inner
def _altered(before, after):
    """Does roll differ by more than a tenth of the lesser, in size or phase?"""
    old, new, apart = 0.0, 0.0, 0.0
    for b in range(before.shape[1]):
        old += before[1, b] ** 2
        new += after[1, b] ** 2
        apart += (after[1, b] - before[1, b]) ** 2
    return apart > ALTERED * min(old, new)


@kernel
def _solve(first, last, program, parts, tables, given_start, from_rest, u, waiting, status, error):
    """Periodic motions of the waiting ones of first..last; u (n, 3, b) holds the start when `given_start`, then the result."""
    nb = tables[2].size
    size = 3 * nb
    room = room_for_one(program, parts, tables)
    work = (np.empty(size), np.empty((0, 0)), np.empty((size, size)),
            np.empty(size, np.int64), np.empty((3, nb)), np.empty(size), np.empty(size),
            room)  # fmt: skip
    residual, no_matrix = work[0], work[1]
    linear_motion, kept = np.zeros((3, nb)), np.zeros((3, nb))
    for i in range(first, last):
        if waiting[i] == 0:
            continue
        one = (program, parts, i, 1.0)
        side = 0
        # Without the nonlinear terms (strength 0 in `fill`) one step of Newton's method gives the linear motion, and `side`,
        # the sign of the determinant there. A motion that has grown out of rest without a fold keeps that sign: where
        # it differs, or roll is not near the linear one, the branch is followed from rest instead.
        if not given_start:
            for k in range(3):
                for b in range(nb):
                    linear_motion[k, b] = 0.0
            fill(i, 0.0, parts, room[0])
            outcome, side = newton(one, tables, linear_motion, work)
            if outcome == 0:
                copy_motion(linear_motion, u[i])
        fill(i, 1.0, parts, room[0])
        if given_start:
            outcome, _ = newton(one, tables, u[i], work)
        elif outcome == 0:
            outcome, side_found = newton(one, tables, u[i], work)
            unlike = side_found != side or waiting[i] == TO_FOLLOW or _altered(linear_motion, u[i])
            elsewhere = outcome == 0 and from_rest and unlike
            if elsewhere:
                copy_motion(u[i], kept)
            if (outcome != 0 or elsewhere) and follow(one, tables, linear_motion, u[i], work):
                outcome, _ = newton(one, tables, u[i], work)
                status[i] = _BY_FOLLOWING
            elif elsewhere:
                copy_motion(kept, u[i])
        if outcome != 0:
            status[i] = _SINGULAR if outcome == 2 else _NO_MOTION
            continue
        balance(one, tables, u[i], residual, no_matrix, room)
        scale = 1e-300
        for k in range(3):
            scale = max(scale, abs(parts.cos[i, k]), abs(parts.sin[i, k]), abs(parts.mean[i, k]))
        for row in range(size):
            error[i] = max(error[i], abs(residual[row]) / scale)


def orders_for(system: System, harmonics: int) -> tuple[int, ...]:
    """Harmonics that a motion of a system can hold up to a given order.

    harmonics: highest harmonic wanted, 1, 3, 5, ..
    Returns odd ones alone when the system is symmetric; else the mean and all

    Source: [H71] eq. (3) is unchanged by (y, t) -> (-y, t + T/2), so a motion that continues from the linear one has odd
    harmonics only; a steady force or an even term breaks this.
    """
    checked_harmonics(harmonics)
    return tuple(range(1, harmonics + 1, 2)) if system.symmetric else tuple(range(harmonics + 1))


def checked_harmonics(harmonics: int) -> int:
    """A highest harmonic, refused when it is none.

    Returns the same

    >>> checked_harmonics(9)
    9
    """
    whole = isinstance(harmonics, int | np.integer) and not isinstance(harmonics, bool)
    if not whole or not 1 <= harmonics <= MOST_HARMONICS or harmonics % 2 == 0:
        raise InputError(
            f"harmonics={harmonics!r}: give an odd number, 1 (the paper's method), 3, 5, 7, .. up to {MOST_HARMONICS}; "
            "9 is plenty for most motions"
        )
    return harmonics


def harmonic_balance(
    system: System,
    orders: tuple[int, ...],
    start: Floats | None = None,
    *,
    from_rest: bool = False,
    with_residual: bool = True,
) -> tuple[Floats, NDArray[np.int8], Floats]:
    """Periodic motions of a batch of conditions by harmonic balance.

    system: n conditions
    orders: harmonics kept (see `orders_for`)
    start (n, 3, b): start of Newton's method; by default the linear solution
    from_rest: take the motion that raising the wave from nothing leads to: it is looked for wherever Newton's method
        ends beyond a fold, or at roll a tenth off the linear solution's
    with_residual: evaluate the balance once more at each motion, which of many takes a sixth of the time
    Returns u (n, 3, b): coefficients of sway [m], roll, yaw [rad]: cos and sin of each harmonic in turn; in front of
        them, when 0 is among the orders, mean sway velocity, heel and yaw rate; NaN where none found; status (n,):
        `Status`; residual (n,): largest imbalance relative to the excitation, NaN where not asked for

    Source: [H71] eqs. (A-10), (A-11) (one harmonic), [Krack19].  Several motions may exist: this is the one reached by
    damped Newton from the linear solution or, failing that, by raising the wave from nothing along the branch of
    motions, through its folds.
    """
    batched = system.plain and 2 * len(orders) <= _MOST_BATCHED
    return _solved(system, orders, start, from_rest, batched=batched, with_residual=with_residual)


def solve_with_care(
    system: System, orders: tuple[int, ...], start: Floats | None = None, *, from_rest: bool = False
) -> tuple[Floats, NDArray[np.int8], Floats]:
    """Periodic motions of a batch of conditions by damped steps and following alone, without the fast attempt.

    as in `harmonic_balance`
    Returns as from `harmonic_balance`, which is this but for speed

    Source: [Krack19].
    """
    return _solved(system, orders, start, from_rest, batched=False)


def quick_motions(system: System, orders: tuple[int, ...], start: Floats) -> tuple[Floats, NDArray[np.int8]]:
    """Periodic motions that Newton's full steps reach from many starts, of which some may fail.

    as in `harmonic_balance`
    start (n, 3, b): of Newton's method
    Returns as from `harmonic_balance`, without the damped steps; where it cannot solve in a batch, the same

    Source: [Krack19].
    """
    plain = system.plain and 2 * len(orders) <= _MOST_BATCHED
    return _solved(system, orders, start, False, batched=plain, careful=not plain, with_residual=False)[:2]


_SAME, _NEAR = 1e-3, 0.1
_SHARES = (1 / 3, 2 / 3)


def _reached_otherwise(system: System, table: Basis, u: Floats) -> NDArray[np.bool_]:
    """Conditions (n,) whose motion is not the one that the wave raised in thirds leads to.

    Where the linear motion is large, Newton's method may come from it to a motion that stands beside the one from rest, on the
    same side of folds and even of the linear motion's own roll. To go up in thirds is cheap in a batch, the last third only
    where the first two do not point at the motion; where that ends elsewhere, or loses the motion, the branch is to
    be followed.
    """
    v, before, lost = np.zeros_like(u), np.zeros_like(u), np.zeros(system.count, dtype=bool)
    for k, share in enumerate(_SHARES):
        start = 2 * v - before
        lost |= ~_raised(system, table, share, start, from_linear=k == 0)
        v, before = start, v
    ahead = 2 * v - before
    doubtful = np.flatnonzero(lost | _apart(ahead, u, _NEAR))
    if doubtful.size:
        last = ahead[doubtful]
        solved = _raised(rows(system, doubtful), table, 1.0, last, from_linear=False)
        lost[doubtful] |= ~solved | _apart(last, u[doubtful], _SAME)
    return lost


def _raised(system: System, table: Basis, share: float, start: Floats, *, from_linear: bool) -> NDArray[np.bool_]:
    """Solve in a share of the wave, in a batch and in place, and say where (n,) a motion was found."""
    waiting = np.full(system.count, WAITING, dtype=np.int8)
    given = kernel_arguments(system.raised(np.array([share])), table)
    in_threads(newton_batch, system.count, *given, not from_linear, False, start, waiting, smallest=WIDTH)
    return np.asarray(waiting == FOUND)


def _apart(v: Floats, u: Floats, share: float) -> NDArray[np.bool_]:
    """Where (n,) roll differs by more than a share of it."""
    return np.asarray(~(np.abs(v - u).max(axis=2) <= share * np.abs(u).max(axis=2))[:, 1])


def _solved(
    system: System,
    orders: tuple[int, ...],
    start: Floats | None,
    from_rest: bool,
    *,
    batched: bool,
    careful: bool = True,
    with_residual: bool = True,
) -> tuple[Floats, NDArray[np.int8], Floats]:
    """Solve what full steps in a batch find, if wanted, then with care what still waits; mark what has no motion."""
    table = system.basis(orders, fewest=FEWEST)
    u = np.zeros((system.count, 3, table.factors.size)) if start is None else np.array(start, dtype=float)
    finite, residual = system.finite, np.full(system.count, 0.0 if with_residual else np.nan)
    status, waiting = np.where(finite, _CONVERGED, _NOT_FINITE).astype(np.int8), finite.astype(np.int8)
    given = kernel_arguments(system, table)
    asked = (*given, start is not None, from_rest, u, waiting)
    if batched:
        in_threads(newton_batch, system.count, *asked, smallest=WIDTH)
        altered = np.flatnonzero(waiting == FOUND_ALTERED)
        waiting[altered] = FOUND
        if altered.size:
            waiting[altered[_reached_otherwise(rows(system, altered), table, u[altered])]] = TO_FOLLOW
        if with_residual:
            in_threads(imbalances, system.count, *given, u, waiting, residual, smallest=WIDTH)
    if not careful:
        status[waiting == WAITING] = _NO_MOTION
    elif waiting.any():
        in_threads(_solve, system.count, *asked, status, residual)
    with np.errstate(invalid="ignore"):
        status[np.abs(u).max(axis=(1, 2)) > _RUNAWAY] = _SINGULAR  # an undamped resonance, but for rounding
    failed = (status != _CONVERGED) & (status != _BY_FOLLOWING)
    u[failed], residual[failed] = np.nan, np.nan
    return u, status, residual

"""Carry a motion of few harmonics to many: Newton's method, perturbed starts, homotopy by arclength."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.motion.branches.arclength import Equations, corrected, follow
from quartering.motion.equations.batch import copies
from quartering.motion.equations.system import Floats, System
from quartering.motion.status import Status
from quartering.motion.steady.balance import BalanceEquations
from quartering.motion.steady.harmonic import harmonic_balance, quick_motions
from quartering.motion.steady.subharmonic import columns, rearranged

_BESIDE = (1.0, 1.01, 0.99, 1.03, 0.97)
_NEAR, _SAME, _ROUGHLY = 0.15, 1e-6, 1e-3
_POINTS, _BACK = 200, -0.05

# The arc. Let a be the coefficients of the few harmonics and b those of the others, R the residual of the balance equations,
# split alike, and L the derivative of R_b by b without any motion. Then
#
#     R_a(a, b) = 0,    (1 - s) L b + s R_b(a, b) = 0
#
# has at s = 0 the motion of few harmonics (b = 0), and at s = 1 the motion of many. Followed by arclength the arc passes its
# turns, where Newton's method between the two ends has nothing to hold on to. An arc that comes back to s = 0 ends at another
# motion of few harmonics: then no motion of many belongs to either, the two merge before the further harmonics are all there.


def carried(system: System, seeds: list[Floats], few: tuple[int, ...], many: tuple[int, ...]) -> list[Floats | None]:
    """Motions of many harmonics that belong to motions of few.

    system: one condition
    seeds: motions of the harmonics `few`
    few, many: harmonics, `few` among `many`
    Returns one for each seed; None where its arc does not reach all harmonics

    Newton's method from the seed, taken where it stays within 15 % of the seed and does not lead there from another; else from
    the seed times 1.01, 0.99, 1.03 and 0.97; else along the arc of the comment above.  Source: [Krack19].
    """
    if not seeds or few == many:
        return list(seeds)
    wide = rearranged(np.array(seeds), few, many)
    reached = _by_newton(system, wide, many, quick=True)
    lost = [i for i, one in enumerate(reached) if one is None]
    for i, one in zip(lost, _by_newton(system, wide[lost], many, quick=False), strict=True):
        reached[i] = one
    ends: list[Floats | None] = []
    merged: list[Floats] = []  # motions of few harmonics that an arc from another one came back to
    for seed, one in zip(wide, reached, strict=True):
        if one is not None and not _shared(one, reached):
            ends.append(one)
        elif any(same(seed, other, _ROUGHLY) for other in merged):
            ends.append(None)
        else:
            end, back = along_arc(system, seed, few, many)
            ends.append(end)
            merged += [] if back is None else [back]
    return ends


def _by_newton(system: System, wide: Floats, many: tuple[int, ...], *, quick: bool) -> list[Floats | None]:
    """What Newton's method, with full steps or with care, reaches near each start (n, 3, c) or the start times a little."""
    if not len(wide):
        return []
    starts = np.concatenate([factor * wide for factor in _BESIDE])
    solve = quick_motions if quick else harmonic_balance
    u, status = solve(copies(system, len(starts)), many, starts)[:2]
    reached: list[Floats | None] = []
    for i, seed in enumerate(wide):
        near = [u[j] for j in range(i, len(u), len(wide)) if Status(status[j]).ok and _near(u[j], seed)]
        reached.append(near[0] if near else None)
    return reached


def same(a: Floats, b: Floats, share: float = _SAME) -> bool:
    """Are two motions one, to what Newton's method leaves or another share of their size?"""
    return bool(_alike(a, b, share))


def distinct(motions: Floats) -> list[Floats]:
    """Those of the motions (n, 3, b) that are not the `same` as one before them."""
    alike = _alike(motions[:, None], motions, _SAME)
    kept: list[int] = []
    for i in range(len(motions)):
        if not alike[i, kept].any():
            kept.append(i)
    return [motions[i] for i in kept]


def _alike(a: Floats, b: Floats, share: float) -> NDArray[np.bool_]:
    """Which of motions (.., 3, b) that broadcast are one, mode by mode, to a share of the larger."""
    size = np.maximum(np.abs(a).max(axis=-1), np.abs(b).max(axis=-1)) + 1e-12
    return np.asarray((np.abs(a - b).max(axis=-1) < share * size + 1e-12).all(axis=-1))


def _shared(one: Floats, reached: list[Floats | None]) -> bool:
    """Did Newton's method lead from two seeds to the same motion? Then it says of neither where it belongs."""
    return sum(same(one, other) for other in reached if other is not None) > 1


def _near(u: Floats, seed: Floats) -> bool:
    """Is a motion within 15 % of the largest coefficient of roll?"""
    return bool(np.abs(u[1] - seed[1]).max() <= _NEAR * np.abs(seed[1]).max())


def along_arc(
    system: System, seed: Floats, few: tuple[int, ...], many: tuple[int, ...]
) -> tuple[Floats | None, Floats | None]:
    """The motion of many harmonics at the end of the arc from one of few, or the other one of few that it comes back to.

    system: one condition
    seed (3, c): coefficients of the harmonics `many`, zero but for `few`
    Returns (3, c), None where the arc does not get there; (3, c), None where it does not come back either

    Source: [Krack19] (homotopy, arclength continuation).
    """
    size = np.abs(seed).max(axis=1)
    scale = np.repeat(np.maximum(size, 1e-3 * size.max() + 1e-12), seed.shape[1])
    equations = _arc(system, seed.shape, scale, few, many)
    begin, along = np.append(seed.ravel() / scale, 0.0), np.zeros(seed.size + 1)
    along[-1] = 1.0
    path = follow(equations, begin, along, lambda p: _BACK < p[-1] < 1.0, points=_POINTS, may_close=False).points

    def crossing(level: float) -> Floats | None:
        share = (level - path[-2, -1]) / (path[-1, -1] - path[-2, -1])
        at = corrected(equations, path[-2] + share * (path[-1] - path[-2]), along)
        return None if at is None else (at[:-1] * scale).reshape(seed.shape)

    if len(path) >= 2 and path[-1, -1] >= 1.0:
        return crossing(1.0), None
    return None, crossing(0.0) if len(path) >= 3 and path[-1, -1] <= _BACK else None


def _arc(
    system: System, shape: tuple[int, ...], scale: Floats, few: tuple[int, ...], many: tuple[int, ...]
) -> Equations:
    """The equations of the arc, the derivative by s in the last column."""
    further = np.array([
        k * shape[1] + c for k in range(3) for h, where in columns(many).items() if h not in few
        for c in range(where.start, where.stop)
    ])  # fmt: skip
    balance = BalanceEquations(system, many)
    _, at_rest = balance.at(np.zeros(shape))
    plain = np.zeros_like(at_rest)
    plain[np.ix_(further, further)] = at_rest[np.ix_(further, further)]

    def equations(point: Floats) -> tuple[Floats, Floats]:
        x, s = point[:-1] * scale, point[-1]
        value, matrix = balance.at(x.reshape(shape))
        by_share = np.zeros(value.size)
        by_share[further] = value[further] - (plain @ x)[further]
        value[further] -= (1.0 - s) * by_share[further]
        matrix[further] = s * matrix[further] + (1.0 - s) * plain[further]
        return value, np.column_stack([matrix * scale, by_share])

    return equations

"""Isolas: closed branches found from motions at values between the limits."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from quartering.motion.branches.arclength import Path, corrected, tangent_at
from quartering.motion.branches.branch import Curve, follow_branch, within
from quartering.motion.branches.search import from_grid
from quartering.motion.equations.batch import copies
from quartering.motion.equations.system import Floats
from quartering.motion.status import Status
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.motion import roll_peaks
from quartering.motion.steady.subharmonic import rearranged

_VALUES = 17
_SAME = 1e-4
_STEEPEST = np.pi


def loops(
    curve: Curve, known: Floats, points: int = 2000, steepest: float = np.inf
) -> list[tuple[Curve, Path, list[int]]]:
    """Curves of motions that are not on a known one: loops, and branches that enter and leave through the limits.

    curve: whose equations are solved
    known (n, m + 1): points of the curve that is known
    points: of one loop, at the most
    steepest: roll past which no curve is begun or followed [rad]
    Returns each with its own scale and its folds; a loop is closed, the others run from limit to limit

    At 17 values of the parameter, one-harmonic motions are sought from a grid of roll amplitudes and phases (see
    `search`), given all harmonics, and followed both ways when no known curve passes through them.  Motions that roll
    more than 90 degrees are left out.  A loop narrower than a sixteenth of the limits may be missed.
    Source: [Krack19].
    """
    found: list[tuple[Curve, Path, list[int]]] = []
    for value in np.linspace(0.0, 1.0, _VALUES):
        for seed in _seeds(curve, float(value), steepest):
            size = np.repeat(np.abs(seed[:-1] * curve.scale).reshape(3, -1).max(axis=1), seed.size // 3)
            own = replace(curve, scale=np.maximum(curve.scale, size))
            begin = _rescaled(seed[None], curve, own)[0]
            others = [_rescaled(known, curve, own), *(_rescaled(path.points, of, own) for of, path, _ in found)]
            if not any(_passes(own, other, begin) for other in others):
                found.append((own, *_both_ways(own, begin, points, steepest)))
    return found


def _rescaled(points: Floats, old: Curve, new: Curve) -> Floats:
    """The same points (n, m + 1) in the scale of another curve."""
    return np.column_stack([points[:, :-1] * (old.scale / new.scale), points[:, -1]])


def _seeds(curve: Curve, value: float, steepest: float) -> list[Floats]:
    """Points of the curve at one value of the parameter."""
    system = curve.family(value)
    low, starts = from_grid(system)
    if not starts:
        return []
    u = rearranged(np.array(starts), low, curve.orders)
    u, status, _ = harmonic_balance(copies(system, len(u)), curve.orders, start=u)
    good = u[status == Status.CONVERGED]
    good = good[roll_peaks(good, curve.orders) <= min(steepest, _STEEPEST)]
    return [np.append(one.ravel() / curve.scale, value) for one in good]


def _passes(curve: Curve, path: Floats, seed: Floats) -> bool:
    """Does a known curve pass through a motion?"""
    for a, b in pairwise(path):
        if min(a[-1], b[-1]) - 1e-9 <= seed[-1] <= max(a[-1], b[-1]) + 1e-9 and a[-1] != b[-1]:
            near = a + (seed[-1] - a[-1]) / (b[-1] - a[-1]) * (b - a)
            if np.abs(near - seed).max() > 0.5:
                continue
            level = np.zeros(seed.size)
            level[-1] = 1.0
            there = corrected(curve.residual, near, level)
            if there is not None and np.abs(there - seed).max() < _SAME * max(1.0, float(np.abs(seed).max())):
                return True
    return False


def _both_ways(curve: Curve, seed: Floats, points: int, steepest: float) -> tuple[Path, list[int]]:
    """The curve through a motion: a closed loop, or both its halves joined."""
    level = np.zeros(seed.size)
    level[-1] = 1.0
    tangent = tangent_at(curve.residual, seed, level)
    path, folds = follow_branch(curve, seed, points, along=tangent, go_on=within(curve, steepest))
    if path.closed:
        return path, folds
    back, folds_back = follow_branch(curve, seed, points, along=-tangent, go_on=within(curve, steepest))
    before = len(back.points) - 1
    joined = np.concatenate([back.points[:0:-1], path.points])
    tangents = np.concatenate([-back.tangents[:0:-1], path.tangents])
    return Path(joined, tangents, False), sorted([before - i for i in folds_back] + [before + i for i in folds])

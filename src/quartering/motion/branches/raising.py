"""Branch over wave height from zero to far beyond the given height, and the motions at that height."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from quartering.motion.branches.arclength import Path
from quartering.motion.branches.branch import Curve, follow_branch
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.motion import roll_peaks

_POINTS = 600


class Raising(NamedTuple):
    """How far a branch over the wave's height is followed: times the wave's height, and roll [rad]."""

    highest: float = 20.0
    steepest: float = np.inf


def over_height(
    system: System, orders: tuple[int, ...], begin: Floats, size: Floats, how: Raising, *, height: float = 1.0
) -> list[Floats]:
    """Guesses of the motions at the wave's height that lie on the branch through a given one.

    system: one condition
    orders: harmonics
    begin (3, b): a motion, at `height`
    size (3,): of each mode, the branch's steps are a twentieth of it
    how: how far the branch is followed
    height: of the wave at `begin`, times its own: 0 without waves
    Returns between neighbouring points of the branch, for Newton's method

    Pseudo-arclength continuation both ways, through folds; to the wave reversed as well, whose motions are those half a period
    later where the equations are symmetric.  With one degree of freedom and one harmonic the force is a function of the
    amplitude, F^2 = A^2 ((N(A) - w^2)^2 + w^2 C(A)^2), so that every motion lies on the branch from rest; with more, loops
    apart from it may exist.  Source: [Krack19].
    """
    scale = np.repeat(np.maximum(size, 1e-3 * size.max() + 1e-12), begin.shape[1])
    curve = Curve(lambda share: system.raised(np.array([how.highest * share])), orders, scale)
    start = np.append(begin.ravel() / scale, height / how.highest)
    found: list[Floats] = []
    for side in (1.0,) if height == 0.0 else (1.0, -1.0):
        along = np.zeros(start.size)
        along[-1] = side
        path, _ = follow_branch(
            curve, start, _POINTS, (-1.0, 1.0), along=along,
            go_on=lambda point: bool(roll_peaks(*curve.motions(point[None]))[0] <= how.steepest),
        )  # fmt: skip
        found += _passing(curve, path, 1.0 / how.highest)
        if path.closed:
            break
    return found


def _passing(curve: Curve, path: Path, share: float) -> list[Floats]:
    """Motions where a path passes a value of its parameter."""
    found = []
    for a, b in pairwise(path.points):
        if (a[-1] - share) * (b[-1] - share) <= 0 and a[-1] != b[-1]:
            found.append(curve.coefficients(a + (share - a[-1]) / (b[-1] - a[-1]) * (b - a)))
    return found

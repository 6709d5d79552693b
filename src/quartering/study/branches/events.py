"""Detection and location of bifurcations along a branch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering._machine.piecewise import zero
from quartering.motion.branches.arclength import corrected
from quartering.motion.branches.branch import Curve
from quartering.motion.equations.system import Floats
from quartering.stability.assessment import Assessment, assess
from quartering.stability.variational.magnus import FINEST

SYMMETRY_BREAKING, PERIOD_DOUBLING = "symmetry-breaking", "period-doubling"
FOLD, NEIMARK_SACKER = "fold", "neimark-sacker"

_ACCURACY = 1e-9
_PLACE = 1e-13


def judged(curve: Curve, points: Floats, accuracy: float = _ACCURACY) -> Assessment:
    """Stability of points of a branch, as one batch.

    points (n, m + 1)
    accuracy: of the multipliers
    Returns multipliers over one period of the motion, which may be two of the wave

    Source: Floquet's theorem.
    """
    u, orders = curve.motions(points)
    return assess(curve.systems(points), u, orders, accuracy)


def with_events(curve: Curve, points: Floats, folds: list[int]) -> tuple[Floats, NDArray[np.str_]]:
    """The points of a branch with those between them where stability changes, and what happens at each.

    points (n, m + 1)
    folds: which of them are folds
    Returns points (k, m + 1); events (k,): "fold", "symmetry-breaking", "period-doubling", "neimark-sacker", or ""

    A change is a change of the number of multipliers outside the unit circle between two neighbours, located where the
    one that crosses has modulus 1.  Two changes between two neighbours are seen as their sum.  Source: [Krack19].
    """
    count = _unstable(judged(curve, points, FINEST))  # only where it changes does more matter
    found, names = [], []
    for i, point in enumerate(points):
        if i > 0 and count[i] != count[i - 1] and i not in folds and i - 1 not in folds:
            event = _located(curve, points[i - 1], point, int(min(count[i - 1], count[i])))
            name = _named(curve, event)
            if name != FOLD:  # the curve itself locates folds, and better than the multipliers of a truncated motion
                found.append(event)
                names.append(name)
        found.append(point)
        names.append(FOLD if i in folds else "")
    return np.array(found), np.array(names)


def _unstable(result: Assessment) -> NDArray[np.int64]:
    """Number of unstable multipliers at each point."""
    return np.asarray((np.abs(result.floquet.multipliers) > 1.0).sum(axis=1))


def _located(curve: Curve, a: Floats, b: Floats, which: int) -> Floats:
    """Point between two where the modulus of a multiplier, counted from the largest, passes through 1."""
    chord, reach = (b - a) / np.linalg.norm(b - a), float(np.linalg.norm(b - a))

    def at(length: float) -> Floats:
        guess = a + length * chord
        point = corrected(curve.residual, guess, chord)
        return guess if point is None else point

    def beyond(length: float) -> float:
        multipliers = judged(curve, at(length)[None]).floquet.multipliers[0]
        return float(np.log(np.sort(np.abs(multipliers[_may_change(multipliers)]))[::-1][which]))

    first, last = beyond(0.0), beyond(reach)
    if not first * last < 0:  # it passes within rounding of one of the two
        return a if abs(first) < abs(last) else b
    return at(zero(beyond, 0.0, reach, xtol=_PLACE))


def _may_change(multipliers: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Which multipliers are not that of a heading nobody holds, which is exactly 1 everywhere?"""
    return np.asarray(multipliers != 1.0)


def _named(curve: Curve, point: Floats) -> str:
    """What kind of change of stability a point is, from the multiplier nearest to the unit circle."""
    floquet = judged(curve, point[None]).floquet
    away = np.abs(np.abs(floquet.multipliers[0]) - 1.0)
    critical = int(np.argmin(np.where(_may_change(floquet.multipliers[0]), away, np.inf)))
    half, full = floquet.half[0, critical], floquet.multipliers[0, critical]
    deciding = half if np.isfinite(half) else full
    if abs(deciding.imag) > 1e-6:
        return NEIMARK_SACKER
    if np.isfinite(half):
        return FOLD if half.real < 0 else SYMMETRY_BREAKING
    return FOLD if full.real > 0 else PERIOD_DOUBLING

"""Changes of stability along a branch: found, located, named."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.motion.arclength import corrected
from quartering.motion.branch import Curve
from quartering.motion.equations import Floats
from quartering.stability.assessment import Assessment, assess

SYMMETRY_BREAKING, PERIOD_DOUBLING = "symmetry-breaking", "period-doubling"
FOLD, NEIMARK_SACKER = "fold", "neimark-sacker"

_ACCURACY = 1e-9
_BISECTIONS = 40


def judged(curve: Curve, points: Floats) -> Assessment:
    """Stability of points of a branch, as one batch.

    Parameters
    ----------
    curve : Curve
    points : (n, m + 1) float

    Returns
    -------
    Assessment    multipliers over one period of the motion, which may be two of the wave

    Notes
    -----
    Source: Floquet's theorem.
    """
    u, orders = curve.motions(points)
    return assess(curve.systems(points), u, orders, _ACCURACY)


def with_events(curve: Curve, points: Floats, folds: list[int]) -> tuple[Floats, NDArray[np.str_]]:
    """The points of a branch with those between them where stability changes, and what happens at each.

    Parameters
    ----------
    curve : Curve
    points : (n, m + 1) float
    folds : list of int          which of them are folds

    Returns
    -------
    points : (k, m + 1) float
    events : (k,) str            "fold", "symmetry-breaking", "period-doubling", "neimark-sacker", or ""

    Notes
    -----
    A change is a change of the number of multipliers outside the unit circle between two neighbours, located by bisection.
    Two changes between two neighbours are seen as their sum.  Source: [Krack19].
    """
    count = _unstable(judged(curve, points))
    found, names = [], []
    for i, point in enumerate(points):
        if i > 0 and count[i] != count[i - 1] and i not in folds and i - 1 not in folds:
            event = _located(curve, points[i - 1], point, int(count[i - 1]))
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


def _located(curve: Curve, a: Floats, b: Floats, before: int) -> Floats:
    """Point between two where the number of unstable multipliers changes, by bisection."""
    chord = (b - a) / np.linalg.norm(b - a)
    inside, outside = 0.0, float(np.linalg.norm(b - a))
    found = b
    for _ in range(_BISECTIONS):
        middle = 0.5 * (inside + outside)
        point = corrected(curve.residual, a + middle * chord, chord)
        if point is None:
            break
        found = point
        if _unstable(judged(curve, point[None]))[0] == before:
            inside = middle
        else:
            outside = middle
    return found


def _named(curve: Curve, point: Floats) -> str:
    """What kind of change of stability a point is, from the multiplier nearest to the unit circle."""
    floquet = judged(curve, point[None]).floquet
    critical = int(np.argmin(np.abs(np.abs(floquet.multipliers[0]) - 1.0)))
    half, full = floquet.half[0, critical], floquet.multipliers[0, critical]
    deciding = half if np.isfinite(half) else full
    if abs(deciding.imag) > 1e-6:
        return NEIMARK_SACKER
    if np.isfinite(half):
        return FOLD if half.real < 0 else SYMMETRY_BREAKING
    return FOLD if full.real > 0 else PERIOD_DOUBLING

"""Branch switching at symmetry-breaking and period-doubling bifurcations."""

from __future__ import annotations

import numpy as np

from quartering.motion.branches.arclength import corrected
from quartering.motion.branches.branch import Curve
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.balance import balance_of
from quartering.motion.steady.subharmonic import columns, orders_of, rearranged, slowed

_OFFSETS = (0.01, 0.02, 0.05, 0.1)


def leaning(curve: Curve, point: Floats) -> tuple[Curve, Floats, Floats] | None:
    """The branch of leaning motions that leaves a branch of symmetric ones where these lose their symmetry.

    curve: of odd harmonics alone
    point (m + 1,): of it, a symmetry breaking
    Returns curve: with the mean and all harmonics; start (k + 1,): a motion that leans a little, near the point; along
        (k + 1,): direction away from the symmetric branch; None in place of all when nothing leaves here

    The new motion grows along the null vector of the equations for the mean and the even harmonics.  Its mirror image
    (y, t) -> (-y, t + T/2) is a motion too.  Source: [Krack19].
    """
    return _switched(curve, point, orders_of(max(curve.orders), 1), periods=1)


def doubled(curve: Curve, point: Floats) -> tuple[Curve, Floats, Floats] | None:
    """The branch of motions of two wave periods that leaves a branch at a period doubling.

    curve: of motions of one wave period, with the mean and all harmonics
    point (m + 1,): of it, a period doubling
    Returns curve: with harmonics of half the wave's frequency; start (k + 1,): a motion of two wave periods near the
        point; along (k + 1,): direction away from the first branch; None in place of all when nothing leaves here

    As `leaning`, along the null vector of the equations for the odd harmonics of half the wave's frequency.
    Source: [Krack19].
    """
    return _switched(curve, point, orders_of(max(curve.orders), 2), periods=2)


def strength(curve: Curve, points: Floats) -> Floats:
    """Signed amplitude (n,) of the symmetry-breaking (or subharmonic) component.

    curve: of `leaning` or `doubled` motions
    points (n, m + 1)
    Returns (n, 3 c): scaled coefficients that are zero on the first branch
    """
    new = new_columns(curve.orders, curve.periods)
    return np.asarray(points[:, :-1].reshape(len(points), 3, -1)[:, :, new].reshape(len(points), -1))


def new_columns(orders: tuple[int, ...], periods: int) -> list[int]:
    """Columns of harmonics a motion has beyond those of the branch it left: even ones, or odd ones of half the frequency.

    orders: of the motion
    periods: 1 for a leaning motion, 2 for one of two wave periods

    >>> new_columns((0, 1, 2), 1)
    [0, 3, 4]
    """
    parity = 0 if periods == 1 else 1
    return [c for h, where in columns(orders).items() if h % 2 == parity for c in range(where.start, where.stop)]


def disturbance(system: System, u: Floats, orders: tuple[int, ...], scale: Floats, periods: int) -> Floats:
    """Shape in which a motion is closest to losing its symmetry, or its period.

    system: one condition, at the frequency of the new motion
    u (3, b): the motion, as coefficients of the new harmonics
    orders: the new harmonics
    scale (3 b,): size of each unknown
    periods: 1 for a leaning motion, 2 for one of two wave periods
    Returns (3 b,): scaled unit vector: the smallest singular vector of the equations for the new harmonics
    """
    _, matrix = balance_of(system, orders, u)
    nb = u.shape[1]
    new = np.array([k * nb + c for k in range(3) for c in new_columns(orders, periods)])
    shape = np.zeros(3 * nb)
    shape[new] = np.linalg.svd((matrix * scale)[np.ix_(new, new)])[2][-1]
    return shape


def _switched(
    curve: Curve, point: Floats, orders: tuple[int, ...], periods: int
) -> tuple[Curve, Floats, Floats] | None:
    width = curve.coefficients(point).shape[1]
    u = rearranged(curve.coefficients(point)[None], curve.orders, orders, factor=periods)[0]
    scale = np.repeat(curve.scale[::width], u.shape[1])
    larger = Curve(curve.family, orders, scale, periods)
    shape = disturbance(slowed(curve.family(float(point[-1])), periods), u, orders, scale, periods)
    along = np.append(shape, 0.0)
    base = np.append(u.ravel() / scale, point[-1])
    for offset in _OFFSETS:
        start = corrected(larger.residual, base + offset * along, along)
        if start is not None and np.abs(start - base).max() < 0.5:
            return larger, start, along
    return None

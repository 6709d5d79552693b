"""Branches of periodic motions over one parameter: the balance equations as a curve, its folds, its closing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from quartering._machine.piecewise import zero
from quartering.conventions import InputError
from quartering.motion.branches.arclength import Path, corrected, follow, tangent_at
from quartering.motion.equations.batch import joined
from quartering.motion.equations.system import Floats, System
from quartering.motion.status import Status
from quartering.motion.steady.balance import balance_of
from quartering.motion.steady.harmonic import harmonic_balance, orders_for
from quartering.motion.steady.motion import roll_peaks
from quartering.motion.steady.subharmonic import ascending, slowed

Family = Callable[[float], System]
"""A system of one condition for every value of a parameter between 0 and 1."""

_STEP = 1e-6


@dataclass(frozen=True, eq=False)
class Curve:
    """The balance equations of a family of systems; a point is the scaled unknowns and the parameter.

    Parameters
    ----------
    family : function of the parameter (0 to 1), gives a System of one condition
    orders : tuple of int    harmonics of the motion, the wave's own in front (after the mean), see `subharmonic`
    scale : (m,) float       size of each unknown
    periods : int            wave periods after which the motion repeats
    """

    family: Family
    orders: tuple[int, ...]
    scale: Floats
    periods: int = 1

    def coefficients(self, point: Floats) -> Floats:
        """Coefficients (3, b) of a point, in the order of `orders`."""
        return np.ascontiguousarray((point[:-1] * self.scale).reshape(3, -1))

    def motions(self, points: Floats) -> tuple[Floats, tuple[int, ...]]:
        """Coefficients (n, 3, b) of points (n, m + 1) by ascending harmonics, and these harmonics."""
        u = (points[:, :-1] * self.scale).reshape(len(points), 3, -1)
        return ascending(u, self.orders)

    def systems(self, points: Floats) -> System:
        """The systems of points (n, m + 1) as one batch, at the frequency of their motions."""
        return joined([slowed(self.family(float(t)), self.periods) for t in points[:, -1]])

    def residual(self, point: Floats) -> tuple[Floats, Floats]:
        """Residual (m,) and derivative (m, m + 1); by the parameter with central differences."""
        value, matrix = self._balance(point)
        forward, backward = point.copy(), point.copy()
        forward[-1] += _STEP
        backward[-1] -= _STEP
        difference = self._balance(forward, with_matrix=False)[0] - self._balance(backward, with_matrix=False)[0]
        return value, np.column_stack([matrix * self.scale, difference / (2 * _STEP)])

    def _balance(self, point: Floats, *, with_matrix: bool = True) -> tuple[Floats, Floats]:
        s = slowed(self.family(float(point[-1])), self.periods)
        return balance_of(s, self.orders, self.coefficients(point), with_matrix=with_matrix)


def start_of_branch(family: Family, harmonics: int) -> tuple[Curve, Floats]:
    """The curve of a family and its first point, the motion at parameter 0 that grows out of the linear solution.

    harmonics: highest harmonic, odd

    Source: [H71] eq. (A-11).

    See `follow_branch`.
    """
    first, last = family(0.0), family(1.0)
    orders = orders_for(last, harmonics)
    u, status, _ = harmonic_balance(first, orders, from_rest=True)
    if not Status(status[0]).ok:
        raise InputError(f"no motion to start the branch from: {Status(status[0]).advice}")
    end, _, _ = harmonic_balance(last, orders, from_rest=True)
    size = np.nan_to_num(np.abs(np.concatenate([u, end])).max(axis=(0, 2)))
    size = np.maximum(size, 1e-3 * size.max() + 1e-12)
    scale = np.repeat(size, u.shape[2])
    return Curve(family, orders, scale), np.append(u[0].ravel() / scale, 0.0)


def follow_branch(
    curve: Curve,
    start: Floats,
    points: int = 2000,
    limits: tuple[float, float] = (0.0, 1.0),
    *,
    along: Floats | None = None,
    go_on: Callable[[Floats], bool] = lambda _: True,
) -> tuple[Path, list[int]]:
    """Points of a branch from a start to a limit of the parameter, through folds, or until it closes.

    start (m + 1,): a point of it
    points: at the most
    limits (low, high): of the parameter; a branch that reaches one ends on it
    along (m + 1,): direction to set off to; by default that of a rising parameter
    go_on: of a point: False ends the branch there
    Returns path: scaled unknowns and parameter; folds: which points are folds, located to rounding

    Pseudo-arclength continuation: steps go along the tangent, shorter where the branch bends.  Source: [Krack19].

    >>> from dataclasses import replace
    >>> from quartering.motion.equations.model import Model
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> system = Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0)).system
    >>> curve, start = start_of_branch(lambda t: replace(system, frequency=np.array([0.8 + 0.7 * t])), harmonics=1)
    >>> path, folds = follow_branch(curve, start)
    >>> (0.8 + 0.7 * path.points[folds, -1]).round(2).tolist()
    [1.26, 1.1]
    """
    if along is None:
        along = np.zeros(start.size)
        along[-1] = 1.0

    def inside(point: Floats) -> bool:
        return limits[0] <= point[-1] <= limits[1] and go_on(point)

    path = _landed(curve, follow(curve.residual, start, along, inside, points=points), limits)
    found, tangents, folds = [path.points[0]], [path.tangents[0]], []
    for i in range(1, len(path.points)):
        before, tangent = path.points[i - 1], path.tangents[i - 1]
        if path.tangents[i, -1] * tangent[-1] < 0:
            folds.append(len(found))
            found.append(_fold(curve, before, tangent, path.points[i]))
            tangents.append(tangent_at(curve.residual, found[-1], tangent))
        found.append(path.points[i])
        tangents.append(path.tangents[i])
    return Path(np.array(found), np.array(tangents), path.closed), folds


def _landed(curve: Curve, path: Path, limits: tuple[float, float]) -> Path:
    """Path with its last point, a step beyond a limit, back on that limit; without it where the curve has none there."""
    last, limit = path.points[-1], float(np.clip(path.points[-1, -1], *limits))
    if len(path.points) == 1 or last[-1] == limit:
        return path
    before, there = path.points[-2], None
    if before[-1] != limit:
        level = np.zeros(last.size)
        level[-1] = 1.0
        share = (limit - before[-1]) / (last[-1] - before[-1])
        there = corrected(curve.residual, before + share * (last - before), level)
    if there is None or np.linalg.norm(there - before) > np.linalg.norm(last - before):
        return Path(path.points[:-1], path.tangents[:-1], False)
    there[-1] = limit
    tangent = tangent_at(curve.residual, there, path.tangents[-2])
    return Path(np.vstack([path.points[:-1], there]), np.vstack([path.tangents[:-1], tangent]), False)


def within(curve: Curve, steepest: float) -> Callable[[Floats], bool]:
    """Whether a motion rolls no further than an angle.

    steepest: [rad]
    """
    return lambda point: bool(roll_peaks(*curve.motions(point[None]))[0] <= steepest)


def _fold(curve: Curve, before: Floats, tangent: Floats, after: Floats) -> Floats:
    """Point between two neighbours where the tangent has no part along the parameter."""

    def at(share: float) -> Floats:
        point = corrected(curve.residual, before + share * (after - before), tangent)
        return before if point is None else point

    def slope(share: float) -> float:
        return float(tangent_at(curve.residual, at(share), tangent)[-1])

    if slope(1.0) * slope(0.0) > 0:  # a neighbour is the fold, to rounding
        return min(before, after, key=lambda point: abs(tangent_at(curve.residual, point, tangent)[-1]))
    return at(zero(slope, 0.0, 1.0, xtol=1e-13))

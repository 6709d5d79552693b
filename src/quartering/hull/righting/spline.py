"""Odd cubic spline of the righting arm, through the vanishing angle and beyond."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quartering._machine.piecewise import cubic_spline
from quartering.conventions import InputError
from quartering.hull.lines.section import Floats

_FEWEST = 3


@dataclass(frozen=True, eq=False)
class OddSpline:
    """``slope x + cubic x^3 + sum_j jump_j ((|x| - knot_j)+)^3 sgn x``: cubic between knots, two derivatives continuous.

    Parameters
    ----------
    slope, cubic : float    of the piece about 0
    knots : (k,) float      angles where the cubic changes, ascending, above 0 [rad]
    jumps : (k,) float      by how much
    end : float             last angle of the data; the last cubic goes on beyond [rad]
    """

    slope: float
    cubic: float
    knots: Floats
    jumps: Floats
    end: float

    def value(self, angle: ArrayLike) -> Floats:
        """Value at angles [rad]."""
        x = np.asarray(angle, dtype=float)
        beyond = np.maximum(np.abs(x)[..., None] - self.knots, 0.0)
        return np.asarray(x * (self.slope + self.cubic * x**2) + np.sign(x) * (beyond**3 @ self.jumps))

    def derivative(self, angle: ArrayLike) -> Floats:
        """Derivative at angles [rad]."""
        x = np.asarray(angle, dtype=float)
        beyond = np.maximum(np.abs(x)[..., None] - self.knots, 0.0)
        return np.asarray(self.slope + 3.0 * self.cubic * x**2 + 3.0 * (beyond**2 @ self.jumps))

    def times(self, factor: float) -> OddSpline:
        """The spline times a number."""
        return OddSpline(factor * self.slope, factor * self.cubic, self.knots, factor * self.jumps, self.end)


def odd_spline(angles: ArrayLike, values: ArrayLike, slope: float | None = None) -> OddSpline:
    """Spline through points and their mirror images.

    angles (n,): ascending, from 0 or above; 0 with value 0 may be left out [deg]
    values (n,)
    slope: at 0 where it is known, per radian; else what the points make it

    Without a change of cubic at the last angle but one (not-a-knot); no bend at 0, since the curve is odd. A given slope is
    met exactly, by a change of cubic halfway to the first angle, where no point is.
    Source: closed form of the interpolating spline.
    """
    x, y = (np.asarray(array, dtype=float) for array in (angles, values))
    if x.ndim != 1 or x.shape != y.shape or not (np.isfinite(x).all() and np.isfinite(y).all()):
        raise InputError(f"righting curve: {x.shape} angles and {y.shape} values; give a number for each angle")
    if x.size and x[0] == 0.0 and y[0] != 0.0:
        raise InputError(
            f"righting curve: {y[0]:g} at 0 deg; an upright ship is in balance (a steady moment is a force)"
        )
    above = x != 0.0
    x, y = x[above], y[above]
    if x.size < _FEWEST or x[0] < 0 or not (np.diff(x) > 0).all():
        raise InputError(
            f"righting curve: angles {x.tolist()} deg; give at least {_FEWEST} above 0, ascending; to port it is mirrored"
        )
    knots, points = np.radians(np.append(0.0, x)), np.append(0.0, y)
    if slope is None:
        return _joined(knots, _cubics(knots, points))
    # A spline is linear in its points: the one that has the given slope is a sum of two, with different points halfway.
    knots, points = np.insert(knots, 1, 0.5 * knots[1]), np.insert(points, 1, slope * 0.5 * knots[1])
    without, by_point = _cubics(knots, points), _cubics(knots, np.eye(knots.size)[1])
    made = without + (slope - without[2, 0]) / by_point[2, 0] * by_point
    made[2, 0] = slope  # to the last digit
    return _joined(knots, made)


def _cubics(knots: Floats, points: Floats) -> Floats:
    """Coefficients (4, pieces) of the interpolating spline, highest power first."""
    return cubic_spline(knots, points, straight_start=True).c


def _joined(knots: Floats, cubics: Floats) -> OddSpline:
    """The spline of given cubics between knots (n,), the last two of which belong to one cubic."""
    return OddSpline(float(cubics[2, 0]), float(cubics[0, 0]), knots[1:-2], np.diff(cubics[0])[:-1], float(knots[-1]))

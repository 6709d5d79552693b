"""Piecewise cubics and the zero of a function, by numpy alone.

The rules, and the order of every sum, are those of `scipy.interpolate` and `scipy.optimize`, with which a test compares them
digit by digit. Loading these two takes longer than all that a single condition asks of them; where a command loads them
anyway, or needs another rule of theirs, it takes theirs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

_MOST_STEPS: Final = 100
_ROUNDING: Final = 4 * float(np.finfo(float).eps)


@dataclass(frozen=True, eq=False)
class PiecewiseCubic:
    """Cubics joined at knots; beyond the ends the first and the last go on.

    Parameters
    ----------
    x : (n,) float            knots, ascending
    c : (4, n - 1, ...) float coefficients of (x - x_i)^3, ^2, ^1, ^0 on each piece
    """

    x: Floats
    c: Floats

    def __call__(self, at: ArrayLike) -> Floats:
        """Values (..., *) at places (...)."""
        place = np.asarray(at, dtype=float)
        piece = np.clip(np.searchsorted(self.x, place, side="right") - 1, 0, self.x.size - 2)
        s = (place - self.x[piece]).reshape(place.shape + (1,) * (self.c.ndim - 2))
        c3, c2, c1, c0 = self.c[:, piece]
        # By ascending powers, as `scipy.interpolate.PPoly` adds them: Horner's rule would round otherwise.
        return np.asarray(c0 + c1 * s + c2 * (s * s) + c3 * (s * s * s))


def monotone_cubic(x: Floats, y: Floats) -> PiecewiseCubic:
    """Interpolate without overshoot.

    x (n,): ascending, two or more
    y (n, ...): values

    Source: [Fritsch84].  Equal to `scipy.interpolate.PchipInterpolator`.
    """
    return _hermite(x, y, _monotone_slopes(x, y))


def monotone_slopes(x: Floats, y: Floats) -> Floats:
    """Slopes of `monotone_cubic` at its knots, as its derivative gives them: at the last one, at the end of the last piece."""
    slope, (c3, c2, _, _) = _monotone_slopes(x, y), monotone_cubic(x, y).c
    last = x[-1] - x[-2]
    slope[-1] = slope[-2] + 2 * c2[-1] * last + 3 * c3[-1] * (last * last)
    return slope


def _monotone_slopes(x: Floats, y: Floats) -> Floats:
    """Weighted harmonic mean of the chords' slopes; 0 where they differ in sign."""
    h = _beside(np.diff(x), y)
    chord = np.diff(y, axis=0) / h
    if len(y) == 2:
        return np.concatenate([chord, chord])
    before, after = chord[:-1], chord[1:]
    w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    slope = np.zeros_like(y)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        mean = 1.0 / ((w1 / before + w2 / after) / (w1 + w2))
    slope[1:-1] = np.where((np.sign(before) != np.sign(after)) | (before == 0) | (after == 0), 0.0, mean)
    slope[0] = _end_slope(h[0], h[1], chord[0], chord[1])
    slope[-1] = _end_slope(h[-1], h[-2], chord[-1], chord[-2])
    return slope


def _end_slope(h0: Floats, h1: Floats, m0: Floats, m1: Floats) -> Floats:
    """Of a parabola through three points, held to the shape of the first chord."""
    slope = ((2 * h0 + h1) * m0 - h0 * m1) / (h0 + h1)
    steep = (np.sign(m0) != np.sign(m1)) & (np.abs(slope) > 3.0 * np.abs(m0))
    return np.where(np.sign(slope) != np.sign(m0), 0.0, np.where(steep, 3.0 * m0, slope))


def cubic_spline(x: Floats, y: Floats, straight_start: bool = False) -> PiecewiseCubic:
    """Interpolate with two continuous derivatives; the first two pieces are one cubic, and so are the last two.

    x (n,): ascending, four or more; three with a straight start
    y (n, ...): values
    straight_start: the second derivative at the first knot is 0 instead

    Source: [deBoor78] chapter IV.  Equal to `scipy.interpolate.CubicSpline`, to rounding: its tridiagonal system is solved in
    LAPACK's order.
    """
    h = np.diff(x)
    wide = _beside(h, y)
    chord = np.diff(y, axis=0) / wide
    diagonal, above, below = np.empty(x.size), np.empty(x.size - 1), np.empty(x.size - 1)
    diagonal[1:-1], above[1:], below[:-1] = 2 * (h[:-1] + h[1:]), h[:-1], h[1:]
    right = np.empty_like(y, dtype=float)
    right[1:-1] = 3 * (wide[1:] * chord[:-1] + wide[:-1] * chord[1:])
    if straight_start:
        diagonal[0], above[0] = 2 * h[0], h[0]
        right[0] = 3 * (y[1] - y[0])
    else:
        two = x[2] - x[0]
        diagonal[0], above[0] = h[1], two
        right[0] = ((wide[0] + 2 * two) * wide[1] * chord[0] + wide[0] ** 2 * chord[1]) / two
    two = x[-1] - x[-3]
    diagonal[-1], below[-1] = h[-2], two
    right[-1] = (wide[-1] ** 2 * chord[-2] + (2 * two + wide[-1]) * wide[-2] * chord[-1]) / two
    return _hermite(x, y, _tridiagonal(below, diagonal, above, right))


def _tridiagonal(below: Floats, diagonal: Floats, above: Floats, right: Floats) -> Floats:
    """Solve a tridiagonal system (n, n) for right-hand sides (n, ...), by elimination with pivots chosen of two rows."""
    n = diagonal.size
    low, d, up, b = below.copy(), diagonal.copy(), above.copy(), right.copy()
    second = np.zeros(n)  # above the diagonal by two, where rows were exchanged
    for i in range(n - 1):
        if abs(d[i]) >= abs(low[i]):
            factor = low[i] / d[i]
            d[i + 1] -= factor * up[i]
            b[i + 1] -= factor * b[i]
        else:
            factor = d[i] / low[i]
            d[i], up[i], d[i + 1] = low[i], d[i + 1], up[i] - factor * d[i + 1]
            if i < n - 2:
                second[i], up[i + 1] = up[i + 1], -factor * up[i + 1]
            b[i], b[i + 1] = b[i + 1].copy(), b[i] - factor * b[i + 1]
    b[-1] /= d[-1]
    b[-2] = (b[-2] - up[-1] * b[-1]) / d[-2]
    for i in range(n - 3, -1, -1):
        b[i] = (b[i] - up[i] * b[i + 1] - second[i] * b[i + 2]) / d[i]
    return b


def _hermite(x: Floats, y: Floats, slope: Floats) -> PiecewiseCubic:
    """Cubics of given values and slopes at their ends."""
    h = _beside(np.diff(x), y)
    chord = np.diff(y, axis=0) / h
    t = (slope[:-1] + slope[1:] - 2 * chord) / h
    return PiecewiseCubic(x, np.stack([t / h, (chord - slope[:-1]) / h - t, slope[:-1], y[:-1]]))


def _beside(h: Floats, y: Floats) -> Floats:
    """Widths of the pieces (n - 1, 1, ...), to go with values (n, ...)."""
    return h.reshape(h.shape + (1,) * (y.ndim - 1))


def zero(of: Callable[[float], float], low: float, high: float, xtol: float = 2e-12, rtol: float = _ROUNDING) -> float:
    """Where a function crosses 0 between two places.

    of: continuous; of different signs at the two
    low, high: the two places
    xtol, rtol: the place is known to their sum, the second times the place

    Raises ValueError where the signs are equal.  Source: [Brent73] chapter 4.  Equal to `scipy.optimize.brentq`.

    >>> zero(lambda x: x * x - 2.0, 0.0, 2.0)
    1.4142135623731364
    """
    before, now, f_before, f_now = float(low), float(high), float(of(low)), float(of(high))
    if f_before == 0:
        return before
    if f_now == 0:
        return now
    if (f_before < 0) == (f_now < 0):
        raise ValueError(f"{f_before:g} at {low:g} and {f_now:g} at {high:g}: no change of sign between")
    other, f_other, step, last = before, f_before, now - before, now - before
    for _ in range(_MOST_STEPS):
        if f_before != 0 and (f_before < 0) != (f_now < 0):
            other, f_other, last, step = before, f_before, now - before, now - before
        if abs(f_other) < abs(f_now):
            before, now, other, f_before, f_now, f_other = now, other, now, f_now, f_other, f_now
        least, half = (xtol + rtol * abs(now)) / 2, (other - now) / 2
        if f_now == 0 or abs(half) < least:
            return now
        tried = _interpolated(before, now, other, f_before, f_now, f_other)
        good = (
            abs(last) > least and abs(f_now) < abs(f_before) and 2 * abs(tried) < min(abs(last), 3 * abs(half) - least)
        )
        last, step = (step, tried) if good else (half, half)
        before, f_before = now, f_now
        now += step if abs(step) > least else (least if half > 0 else -least)
        f_now = float(of(now))
    raise ValueError(f"no zero found in {_MOST_STEPS} steps; the function is {f_now:g} at {now:g}")


def _interpolated(before: float, now: float, other: float, f_before: float, f_now: float, f_other: float) -> float:
    """Step of the secant, or of the inverse parabola through three different places."""
    if f_now == f_before:
        return float("inf")
    if before == other:
        return -f_now * (now - before) / (f_now - f_before)
    d_before, d_other = (f_before - f_now) / (before - now), (f_other - f_now) / (other - now)
    scale = d_other * d_before * (f_other - f_before)
    return -f_now * (f_other * d_other - f_before * d_before) / scale if scale else float("inf")

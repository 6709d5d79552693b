"""Many forced oscillators x'' + c x' + x - k x^3 + q x^5 = F cos wt at once, by NumPy alone: shooting and long integration."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_STEPS = 96


class Rolls(NamedTuple):
    """Coefficients (n,) of n oscillators."""

    c: Floats
    k: Floats
    q: Floats
    w: Floats
    force: Floats

    def each(self, starts: int) -> "Rolls":
        """Every oscillator as often as there are starts of it."""
        return Rolls(*(np.repeat(one, starts) for one in self))


def _rate(t: Floats, y: Floats, of: Rolls) -> Floats:
    """Rates of x, x' and, where they are given, of both columns of the variational equations."""
    square = y[0] ** 2
    pull = -y[0] * (1.0 - square * (of.k - of.q * square))
    own = np.array([y[1], pull - of.c * y[1] + of.force * np.cos(of.w * t)])
    if len(y) == 2:
        return own
    slope = -1.0 + square * (3.0 * of.k - 5.0 * of.q * square)
    return np.concatenate([own, y[4:], slope * y[2:4] - of.c * y[4:]])


def one_period(y: Floats, of: Rolls) -> tuple[Floats, Floats]:
    """States a period later by the classical Runge-Kutta method, and the first harmonic of x on the way."""
    h, t, first = 2 * np.pi / of.w / _STEPS, np.zeros_like(of.w), np.zeros(of.w.size, dtype=complex)
    for _ in range(_STEPS):
        first += y[0] * np.exp(-1j * of.w * t) * 2 / _STEPS
        k1 = _rate(t, y, of)
        k2 = _rate(t + h / 2, y + h / 2 * k1, of)
        k3 = _rate(t + h / 2, y + h / 2 * k2, of)
        y, t = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + _rate(t + h, y + h * k3, of)), t + h
        y = np.where(np.abs(y[:1]) < 10.0, y, np.nan)
    return y, first


def by_shooting(of: Rolls, top: float, side: int = 24, steps: int = 14) -> list[Floats]:
    """Amplitudes of the first harmonic of all motions of period one met from a grid of starts (x, x') up to `top`."""
    grid = np.linspace(-top, top, side)
    x, v = (np.tile(axis.ravel(), of.w.size) for axis in np.meshgrid(grid, grid))
    all_of, one, none = of.each(side**2), np.ones(x.size), np.zeros(x.size)
    with np.errstate(all="ignore"):
        for i in range(steps):
            y, first = one_period(np.array([x, v, one, none, none, one]), all_of)
            a, b, c, d, left, right = y[2] - 1.0, y[3], y[4], y[5] - 1.0, y[0] - x, y[1] - v
            det = a * d - b * c
            dx, dv = -(d * left - b * right) / det, -(a * right - c * left) / det
            # whole steps at the end, none further than 0.3 before
            shorter = np.maximum(1.0, np.hypot(dx, dv) / 0.3) if i < steps - 5 else 1.0
            x, v = x + dx / shorter, v + dv / shorter
        good = (np.hypot(dx, dv) < 1e-9) & (np.hypot(x, v) < 2 * top)
    rows = zip(good.reshape(of.w.size, -1), np.abs(first).reshape(of.w.size, -1), strict=True)
    return [_different(sizes[ok]) for ok, sizes in rows]


def _different(sizes: Floats) -> Floats:
    rising = np.sort(sizes)
    return rising[np.append(True, np.diff(rising) > 1e-4)] if rising.size else rising


def attractors(of: Rolls, starts: Floats, periods: int) -> list[Floats]:
    """Amplitudes of the first harmonic that starts (m, 2) have come to after many periods; those that repeat, each once."""
    m = len(starts)
    y, all_of = np.tile(starts.T, of.w.size), of.each(m)
    with np.errstate(all="ignore"):
        for _ in range(periods):
            y, _ = one_period(y, all_of)
        after, first = one_period(y, all_of)
        settled = np.abs(after - y).max(axis=0) < 1e-5
    rows = zip(settled.reshape(-1, m), np.abs(first).reshape(-1, m), strict=True)
    return [_different(sizes[ok]) for ok, sizes in rows]

"""Parametric roll in closed form, from one harmonic of half the encounter frequency: threshold, growth, steady amplitudes.

    phi'' + 2 zeta phi' + delta |phi'| phi' + beta3 phi'^3
        + (1 + h cos W t) phi + (alpha3 + h3 cos W t) phi^3 + alpha5 phi^5 = 0

with time in units of the reciprocal of the natural frequency at the mean GM.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.piecewise import zero

Floats = NDArray[np.float64]


def threshold(ratio: ArrayLike, damping: ArrayLike) -> Floats:
    """Least variation h = GM_1/GM_mean with which roll grows near W = 2.

    ratio (...): W, encounter frequency over natural frequency at the mean GM
    damping (...): zeta, of critical at the mean GM
    Returns (...)

    h = 2 sqrt((1 - W^2/4)^2 + (zeta W)^2): 4 zeta at W = 2.  Valid: small h; at W 10 % off, 2 to 3 % off.
    """
    W, zeta = np.asarray(ratio, dtype=float), np.asarray(damping, dtype=float)
    return np.asarray(2.0 * np.sqrt((1.0 - W**2 / 4.0) ** 2 + (zeta * W) ** 2))


def averaged_growth(ratio: ArrayLike, damping: ArrayLike, variation: ArrayLike) -> Floats:
    """Growth of roll in units of the natural frequency; -zeta where roll is not caught by the wave."""
    W, zeta, h = (np.asarray(v, dtype=float) for v in (ratio, damping, variation))
    inside = (h / (2.0 * W)) ** 2 - ((W**2 / 4.0 - 1.0) / W) ** 2
    return np.asarray(-zeta + np.sqrt(np.maximum(inside, 0.0)))


def averaged_amplitudes(
    ratio: float,
    damping: float,
    variation: float,
    *,
    cubic: float = 0.0,
    fifth: float = 0.0,
    cubic_variation: float = 0.0,
    quadratic_damping: float = 0.0,
    cubic_damping: float = 0.0,
    largest: float = 3.0,
) -> Floats:
    """Steady amplitudes of roll of two periods, all roots, least first.

    ratio, damping, variation: W, zeta, h
    cubic, fifth: alpha3, alpha5
    cubic_variation: h3
    quadratic_damping, cubic_damping: delta, beta3
    largest: amplitude up to which roots are looked for [rad]
    Returns (k,): [rad]

    With R = 1 - W^2/4 + 3/4 alpha3 A^2 + 5/8 alpha5 A^4 and I = (2 zeta + 8/(3 pi) delta (W/2) A + 3/4 beta3 (W/2)^2 A^2) W/2,
    (R/(h/2 + h3 A^2/2))^2 + (I/(h/2 + h3 A^2/4))^2 = 1.  Valid: amplitudes below 1 rad to 0.5 %.
    """
    half = ratio / 2.0

    def excess(A: float) -> float:
        stiff = 1.0 - half**2 + 0.75 * cubic * A**2 + 0.625 * fifth * A**4
        by = 2.0 * damping + 8.0 / (3.0 * np.pi) * quadratic_damping * half * A + 0.75 * cubic_damping * half**2 * A**2
        first, second = variation / 2 + cubic_variation * A**2 / 2, variation / 2 + cubic_variation * A**2 / 4
        return float((stiff * second) ** 2 + (by * half * first) ** 2 - (first * second) ** 2)

    grid = np.linspace(0.0, largest, 3001)[1:]
    values = np.array([excess(A) for A in grid])
    roots = [zero(excess, grid[i], grid[i + 1], xtol=1e-14) for i in np.flatnonzero(values[:-1] * values[1:] < 0.0)]
    return np.array(roots, dtype=float)

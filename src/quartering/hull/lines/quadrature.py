"""Quadrature rules along the ship and along a contour."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from quartering.hull.lines.section import Floats


@lru_cache(maxsize=64)
def _legendre(points: int) -> tuple[Floats, Floats]:
    nodes, weights = np.polynomial.legendre.leggauss(points)
    nodes.flags.writeable = weights.flags.writeable = False
    return nodes, weights


def gauss(points: int, start: float, end: float) -> tuple[Floats, Floats]:
    """Gauss-Legendre nodes and weights on an interval.

    points: number of nodes
    start, end: ends of the interval; the weights sum to end - start (negative when it runs backward)
    Returns nodes, weights (points,)

    Exact for polynomials of degree 2 points - 1.  Source: [Abramowitz64] 25.4.30.
    """
    nodes, weights = _legendre(points)
    return start + 0.5 * (end - start) * (nodes + 1.0), 0.5 * (end - start) * weights


def station_weights(x: Floats) -> Floats:
    """Weights that integrate smooth data over stations of any spacing.

    x (s,): station positions, ascending [m]
    Returns (s,): weights: sum(weights * f(x)) is the integral of f from x[0] to x[-1] [m]

    Each interval is integrated with the cubic through its four nearest stations: exact for cubics, local, for any
    spacing. Spacing so uneven that a weight would not be positive falls back to the trapezoidal rule.
    Source: [Gill72].  Valid: data smooth between stations.
    """
    count = len(x)
    width = min(4, count)
    weights = np.zeros(count)
    for i in range(count - 1):
        first = min(max(i - 1, 0), count - width)
        near = x[first : first + width]
        nodes, dx = gauss(2, x[i], x[i + 1])
        for j in range(width):
            others = np.delete(near, j)
            weights[first + j] += dx @ np.prod((nodes[:, None] - others) / (near[j] - others), axis=1)
    if (weights <= 0).any():
        half = 0.5 * np.diff(x)
        weights = np.concatenate([half, [0.0]]) + np.concatenate([[0.0], half])
    return weights

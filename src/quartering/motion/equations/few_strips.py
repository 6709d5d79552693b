"""A hull's drag on few strips: the points and weights that stand for all of its stations.

What the strips do to a motion is a sum over the length of c(x) g(x), with c = (1/2) rho C_D T dx and g made of the velocity
past the strip. At an instant g = |q| q has a kink where q changes sign, but a motion feels its average over a cycle, which
for the fundamental is (8/3 pi) q^ q: as smooth in x as the velocity of water and ship. For such g, Gauss' rule of m points
*of the measure c itself* is exact up to degree 2 m - 1 in x, and its error falls faster than any power of m. Its points are
the eigenvalues of the matrix of the recurrence of the polynomials that are orthogonal in the sum over stations [Golub69];
they lie within the hull, and the weights are above zero. The depth of a strip at a point is that of the polynomial of degree
m - 1 that comes nearest to all depths in the mean square of the measure.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

POINTS: Final = 20
"""Strips that stand for a hull. With twenty, roll is that of a strip at every station to 1e-4 of the roll or the wave's slope,
in waves from half a ship's length on."""


def gauss_of_stations(x: Floats, c: Floats, depth: Floats, points: int = POINTS) -> tuple[Floats, Floats, Floats]:
    """Gauss' rule of a sum over stations.

    x (s,): of the stations, all different [m]
    c (s,): weights, 0 or above
    depth (s,): of each station, or another function of x
    points: m; where there are no more stations of weight than that, the rule is the sum itself
    Returns x, c, depth (m,): with which sums of polynomials up to degree 2 m - 1 are those over all stations, and those
        of the depth times polynomials up to degree m - 1

    Lanczos' method with all vectors made orthogonal anew, on the stations scaled to -1..1.  Source: [Golub69].
    """
    held = c > 0
    nodes, weights, values = gauss_rule(x[held], c[held], points)
    return nodes, weights, values @ depth[held]


def gauss_rule(x: Floats, c: Floats, points: int) -> tuple[Floats, Floats, Floats]:
    """Gauss' rule of a sum over stations of weight above zero, and the map that carries any function over to its points.

    x, c (s,): as of `gauss_of_stations`, c above 0
    points: m
    Returns x, c (m,); map (m, s): from values at the stations to those of the polynomial of degree m - 1 that comes
        nearest to them

    >>> stations = np.linspace(-1.0, 1.0, 21)
    >>> x, _, values = gauss_rule(stations, np.full(21, 0.1), 3)
    >>> bool(np.allclose(values @ stations**2, x**2))
    True
    """
    if x.size <= points:
        return x, c, np.eye(x.size)
    middle, half = 0.5 * (x[0] + x[-1]), 0.5 * float(np.ptp(x))
    scaled = (x - middle) / half
    vectors = [np.sqrt(c / c.sum())]
    diagonal, beside = np.zeros(points), np.zeros(points - 1)
    for k in range(points):
        ahead = scaled * vectors[k]
        diagonal[k] = ahead @ vectors[k]
        for _ in range(2):
            ahead = ahead - np.array(vectors).T @ (np.array(vectors) @ ahead)
        if k < points - 1:
            beside[k] = np.linalg.norm(ahead)
            vectors.append(ahead / beside[k])
    nodes, at_nodes = np.linalg.eigh(np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1))
    values = (at_nodes / at_nodes[0]).T @ np.array(vectors) * vectors[0]
    return middle + half * nodes, c.sum() * at_nodes[0] ** 2, values

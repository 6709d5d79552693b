"""Graded nodes on a section outline and collocation points half-way between them, with trigonometric interpolation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.section.outline import Outline
from quartering.hydro.section.wavemaker import Complexes

END_GRADING: Final = 3
"""Power with which nodes gather at the keel and the waterline: distance ~ u^3."""
CORNER_GRADING: Final = 6
"""The same at corners."""
FEWEST: Final = 5
"""Fewest panels between two corners."""


class Interpolation(NamedTuple):
    """What nodal values say in the nodes and half-way between; theta counts panels.

    Parameters
    ----------
    node_slope : (n+1, n+1) float     derivative at the nodes
    value : (n, n+1) float            value at the collocation points
    slope, curvature : (n, n+1) float first and second derivative there
    """

    node_slope: Floats
    value: Floats
    slope: Floats
    curvature: Floats


@dataclass(frozen=True, eq=False)
class Nodes:
    """Nodes of an outline from the keel to the waterline, and collocation points between them.

    Parameters
    ----------
    split : tuple of int                  panels of each arc between corners
    point, tangent : (n+1,) complex       y + i z of the nodes [m] and derivative by theta [m]
    middle, middle_tangent : (n,) complex the same of the collocation points
    submerged : bool                      the last node lies on the centre plane under water
    """

    split: tuple[int, ...]
    point: Complexes
    tangent: Complexes
    middle: Complexes
    middle_tangent: Complexes
    submerged: bool

    @property
    def bend(self) -> Complexes:
        """Second derivative by theta at the collocation points, by differences [m]."""
        return np.diff(self.tangent)


def nodes_on(outline: Outline, panels: int) -> Nodes:
    """Place nodes on an outline, dense towards the keel, the waterline and corners.

    panels: at least 8; more corners than panels/5 - 1 are treated as smooth

    Chord length on each arc is an incomplete beta function of sin^2(pi u/2): ds/du ~ u^(p-1), (1-u)^(q-1) at its ends
    with p, q = 3 at the keel and the waterline and 6 at corners, where a potential ~ s^(2/3) becomes even and smooth
    in u and the trapezoid rule converges fast. The contour is the trigonometric curve through the nodes, so that kinks
    finer than the panels are rounded consistently in points, tangents and normals.
    Source: [Kress90] graded meshes.  Valid: piecewise smooth contours.

    >>> from quartering.hull.lines.section import Section
    >>> from quartering.hydro.section.outline import section_outline
    >>> box = nodes_on(section_outline(Section(y=[0.0, 2.0, 2.0], z=[1.0, 1.0, 0.0])), 24)
    >>> box.split, box.point[[0, 13, 24]].round(9).tolist()
    ((13, 11), [1j, (2+1j), (2+0j)])
    """
    if panels < 8:
        raise InputError(f"{panels} panels on the half contour are too few; give at least 8")
    corners = _longest_arcs(outline.corners, panels // FEWEST)
    split = _split(np.diff(corners), panels)
    grading = [END_GRADING, *[CORNER_GRADING] * (len(split) - 1), END_GRADING]
    point = np.zeros(panels + 1, dtype=complex)
    start = 0
    for k, n in enumerate(split):
        share = _graded(np.arange(n + 1) / n, grading[k], grading[k + 1])
        y, z, *_ = outline.at(corners[k] + (corners[k + 1] - corners[k]) * share)
        point[start : start + n + 1] = y + 1j * z
        start += n
    point[0] = 1j * point[0].imag
    point[-1] = 1j * point[-1].imag if outline.submerged else point[-1].real
    return Nodes(split, point, *_through(point, split, outline.submerged), outline.submerged)


def _through(point: Complexes, split: tuple[int, ...], submerged: bool) -> tuple[Complexes, Complexes, Complexes]:
    """Derivatives at the nodes, points and derivatives half-way, of the trigonometric curve through the nodes."""
    last = len(split) - 1
    across = [_rule(n, k == 0, submerged and k == last) for k, n in enumerate(split)]
    down = [_rule(n, False, not submerged and k == last) for k, n in enumerate(split)]
    tangent = np.zeros(point.size, dtype=complex)
    middle, middle_tangent = np.zeros(point.size - 1, dtype=complex), np.zeros(point.size - 1, dtype=complex)
    start = 0
    for y_rule, z_rule, n in zip(across, down, split, strict=True):
        at = slice(start, start + n + 1)
        y, z = point[at].real, point[at].imag
        tangent[at] += y_rule.node_slope @ y + 1j * (z_rule.node_slope @ z)
        middle[start : start + n] = y_rule.value @ y + 1j * (z_rule.value @ z)
        middle_tangent[start : start + n] = y_rule.slope @ y + 1j * (z_rule.slope @ z)
        start += n
    return tangent, middle, middle_tangent


def _graded(u: Floats, p: int, q: int) -> Floats:
    from scipy.special import betainc

    return np.asarray(betainc(p / 2.0, q / 2.0, np.sin(np.pi * u / 2.0) ** 2))


def _longest_arcs(corners: Floats, most: int) -> Floats:
    """Corners without the ones next to the shortest arcs, until at most so many arcs are left."""
    kept = list(corners)
    while len(kept) - 1 > max(most, 1):
        lengths = np.diff(kept)
        k = int(np.argmin(lengths[:-1] + lengths[1:]))
        del kept[k + 1]
    return np.array(kept)


def _split(lengths: Floats, panels: int) -> tuple[int, ...]:
    """Panels of each arc, with the square root of its length, at least five."""
    share = np.sqrt(lengths)
    free = panels - FEWEST * lengths.size
    if lengths.size == 1:
        return (panels,)
    counts = FEWEST + np.floor(free * share / share.sum()).astype(int)
    for k in np.argsort(-(free * share / share.sum() % 1.0))[: panels - int(counts.sum())]:
        counts[k] += 1
    return tuple(int(n) for n in counts)


@lru_cache(maxsize=64)
def interpolation(split: tuple[int, ...], odd: bool) -> Interpolation:
    """Matrices that interpolate and differentiate on the nodes of an outline.

    split: panels of each arc
    odd: the function vanishes at the keel and is odd across the centre plane

    Every arc has its own series: cos k pi u, k = 0 .. n; the arc at the keel sin (k + 1/2) pi u when odd.
    Source: trigonometric interpolation on the nodes of [Kress90].  Valid: graded nodes.
    """
    n = sum(split)
    out = Interpolation(np.zeros((n + 1, n + 1)), *(np.zeros((n, n + 1)) for _ in range(3)))
    start = 0
    for k, m in enumerate(split):
        for matrix, block in zip(out, _rule(m, odd and k == 0, False), strict=True):
            matrix[start : start + block.shape[0], start : start + m + 1] += block
        start += m
    for matrix in out:
        matrix.flags.writeable = False
    return out


@lru_cache(maxsize=128)
def _rule(n: int, odd_start: bool, odd_end: bool) -> Interpolation:
    """Interpolation on one arc: sines at an end about which the function is odd, cosines where it is even."""
    node, middle = np.arange(n + 1) / n, (np.arange(n) + 0.5) / n
    half = 0.5 if odd_start != odd_end else 0.0
    first, count = (1, n - 1) if odd_start and odd_end else (0, n if half else n + 1)
    k = np.pi * (np.arange(first, first + count) + half)
    kept = np.arange(n + 1)[int(odd_start) : n + 1 - int(odd_end)]

    def series(u: Floats, order: int) -> Floats:
        phase = np.outer(u, k) + 0.5 * np.pi * (order - int(odd_start))
        return np.asarray((k / n) ** order * np.cos(phase))

    inverse = np.zeros((count, n + 1))
    inverse[:, kept] = np.linalg.inv(series(node[kept], 0))
    return Interpolation(
        *(series(u, order) @ inverse for u, order in ((node, 1), (middle, 0), (middle, 1), (middle, 2)))
    )

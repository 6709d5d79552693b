"""Triangulated hull surface: points, triangles, checks of closure and orientation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats

LEAK: Final = 1e-3
"""Difference of the volumes by x, y and z, of the volume, from which on a surface leaks."""
_HOLE: Final = 0.02  # area of a gap over the square of its edge: a triangle has 0.05, a crack between rows far less
_MERGE: Final = 1e-6


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles of a hull surface.

    Parameters
    ----------
    name : str                   file it comes from, for messages
    points : (v, 3) float        x to the bow, z up [m]
    triangles : (t, 3) int       seen from the water, the corners run anticlockwise: the normal points into the water
    half : bool                  only one side of the centreplane is there
    waterline : float or None    z of the calm plane; above it the surface may be open; None: it is closed
    """

    name: str
    points: Floats
    triangles: NDArray[np.intp]
    half: bool
    waterline: float | None


def joined_surface(name: str, corners: Floats, *, half: bool, waterline: float | None) -> Surface:
    """Surface of loose triangles: corners that coincide become one point, triangles without area are dropped.

    name: file it comes from, for messages
    corners (t, 3, 3): corners of the triangles [m]
    half: only one side is there
    waterline: as in `Surface`

    Corners closer than a millionth of the size are one.  Source: geometry.

    >>> corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0], [0, 1, 0]]], dtype=float)
    >>> len(joined_surface("two.stl", corners, half=False, waterline=None).points)
    4
    """
    if corners.size == 0:
        raise InputError(f"{name}: there are no panels in it; the file is empty or cut short")
    if not np.isfinite(corners).all():
        bad = int(np.argwhere(~np.isfinite(corners))[0, 0]) + 1
        raise InputError(f"{name}: panel {bad} has a corner that is not a number")
    loose = corners.reshape(-1, 3)
    size = float(np.ptp(loose, axis=0).max()) or 1.0
    _, first, which = np.unique(np.round(loose / (_MERGE * size)), axis=0, return_index=True, return_inverse=True)
    triangles = which.reshape(-1, 3)
    a, b, c = triangles.T
    return Surface(name, loose[first], triangles[(a != b) & (b != c) & (c != a)], half, waterline)


def check_surface(surface: Surface) -> str:
    """Refuse a surface with holes, with panels turned against their neighbours, or inside out.

    Returns "", or what to say of panels that meet in part of their points

    Panels of neighbouring rows need no common corners: an edge of one may be covered by several of the other.  Of a whole
    surface int x n_x dA, int y n_y dA and int z n_z dA under the calm plane are one volume; where they differ it leaks.
    Source: Gauss's theorem.

    >>> corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], dtype=float)
    >>> check_surface(joined_surface("one.stl", corners, half=False, waterline=None))
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: one.stl: the surface is open along 3 edges, the first from (0, 0, 0) to (1, 0, 0) ...
    """
    corner, points = surface.triangles, surface.points
    edges = np.concatenate([corner[:, [0, 1]], corner[:, [1, 2]], corner[:, [2, 0]]])
    forward, backward = edges @ [len(points), 1], edges @ [1, len(points)]
    unique, times = np.unique(forward, return_counts=True)
    if (times > 1).any():
        at = points[unique[times > 1][0] // len(points)]
        raise InputError(
            f"{surface.name}: near {_place(at)} neighbouring panels are turned opposite ways (or lie double); give all of "
            "them their corners anticlockwise as seen from the water"
        )
    pairs = edges[~np.isin(forward, backward)]
    pairs = pairs[~_may_be_open(surface, points[pairs])]
    volumes = _volumes(surface)
    remark = _checked_gaps(surface, pairs, volumes) if len(pairs) else ""
    if volumes[1] <= 0:
        raise InputError(
            f"{surface.name}: the surface is inside out (its volume comes out as {volumes[1]:.4g} m3); reverse the order "
            "of the corners of every panel, so that they run anticlockwise as seen from the water"
        )
    sides = _side_volumes(surface)
    if not surface.half and abs(sides[0] - sides[1]) > 0.01 * sum(sides):
        raise InputError(
            f"{surface.name}: port and starboard differ ({sides[0]:.5g} and {sides[1]:.5g} m3 either side of y = 0); only "
            "symmetric hulls with y from the centreplane are treated here"
        )
    return remark


def _checked_gaps(surface: Surface, pairs: NDArray[np.intp], volumes: Floats) -> str:
    """Refuse loose edges that are of a hole; else say how many there are and how well the volumes agree."""
    volume = float(np.abs(volumes).max()) or 1.0
    leak = float(np.ptp(volumes)) / volume
    if leak > LEAK or _holes(surface.points, pairs):
        a, b = surface.points[pairs[0]]
        x, y, z = volumes * (2.0 if surface.half else 1.0)
        raise InputError(
            f"{surface.name}: the surface is open along {len(pairs)} edges, the first from {_place(a)} to {_place(b)} m, and "
            f"leaks: its volume is {x:.5g} m3 by x, {y:.5g} by y, {z:.5g} by z, {100 * leak:.2g} % apart; it may only be open "
            "above the waterline and, for a half, on the centreplane; close the holes"
        )
    return f"panels meet in part along {len(pairs)} edges, volumes by x, y, z agree within {100 * leak:.1g} %"


def _holes(points: Floats, pairs: NDArray[np.intp]) -> bool:
    """Does one of the gaps that loose edges bound have area? Edges that cover each other bound none."""
    _, index = np.unique(pairs, return_inverse=True)
    index = index.reshape(-1, 2)
    graph = coo_array((np.ones(len(index)), (index[:, 0], index[:, 1])), shape=(index.max() + 1,) * 2)
    group = connected_components(graph, directed=False)[1][index[:, 0]]
    a, b = points[pairs[:, 0]], points[pairs[:, 1]]
    for one in np.unique(group):
        own = group == one
        start = a[own][0]
        area = np.linalg.norm(0.5 * np.cross(a[own] - start, b[own] - start).sum(axis=0))
        if area > _HOLE * np.linalg.norm(b[own] - a[own], axis=1).sum() ** 2:
            return True
    return False


def _may_be_open(surface: Surface, edges: Floats) -> NDArray[np.bool_]:
    """Which loose edges (e, 2, 3) lie above the calm plane, or on the centreplane of a half."""
    near = 1e-4 * float(np.ptp(surface.points, axis=0).max())
    allowed = np.zeros(len(edges), dtype=bool)
    if surface.half:
        allowed |= (np.abs(edges[:, :, 1]) < near).all(axis=1)
    if surface.waterline is not None:
        allowed |= (edges[:, :, 2] > surface.waterline - near).all(axis=1)
    return allowed


def _place(point: Floats) -> str:
    return f"({', '.join(f'{value:.5g}' for value in point)})"


def _volumes(surface: Surface) -> Floats:
    """Volume under the calm plane by the x, y and z components [m3]; of a half as it stands."""
    corners = surface.points[surface.triangles]
    if surface.waterline is not None:
        corners = below(corners, surface.waterline) - [0.0, 0.0, surface.waterline]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    area = np.cross(b - a, c - a) / 2
    return np.asarray(((a + b + c) / 3 * area).sum(axis=0))


def below(corners: Floats, height: float) -> Floats:
    """The parts of triangles (t, 3, 3) under a height, corners in the same order."""
    over = corners[:, :, 2] > height
    count = over.sum(axis=1)
    found = [corners[count == 0]]
    for cut, lone_over in ((count == 1, True), (count == 2, False)):
        lone = np.argmax(over[cut] == lone_over, axis=1)
        rows = np.arange(len(lone))
        p, q, r = (corners[cut][rows, (lone + k) % 3] for k in range(3))
        to_q, to_r = (p + ((height - p[:, 2]) / (end[:, 2] - p[:, 2]))[:, None] * (end - p) for end in (q, r))
        if lone_over:
            found += [np.stack([to_q, q, r], axis=1), np.stack([to_q, r, to_r], axis=1)]
        else:
            found.append(np.stack([p, to_q, to_r], axis=1))
    return np.concatenate(found)


def _side_volumes(surface: Surface) -> tuple[float, float]:
    """int y n_y dA over the triangles on either side of y = 0 [m3]."""
    a, b, c = (surface.points[surface.triangles[:, k]] for k in range(3))
    share = (a + b + c)[:, 1] / 3 * np.cross(b - a, c - a)[:, 1] / 2
    left = (a + b + c)[:, 1] < 0
    return float(share[left].sum()), float(share[~left].sum())

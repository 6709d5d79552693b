"""A triangulated hull surface from a file: is it whole and the right way out, and what are its sections."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.offsets import Contour
from quartering.hull.section import Floats
from quartering.hull.section_files import Lines
from quartering.hull.stations import check_contour

STATIONS = 41
"""Stations cut through a surface whose points do not lie on stations of their own."""

_OWN_STATIONS = 80
_MERGE = 1e-6

Node = tuple[int, int]


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

    Parameters
    ----------
    name : str                   file it comes from, for messages
    corners : (t, 3, 3) float    corners of the triangles [m]
    half : bool                  only one side is there
    waterline : float or None    as in `Surface`

    Returns
    -------
    Surface

    Raises
    ------
    InputError    no triangles, or corners that are not numbers

    Notes
    -----
    Corners closer than a millionth of the size are one.  Source: geometry.

    Examples
    --------
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


def check_surface(surface: Surface) -> None:
    """Refuse a surface with holes, with panels turned against their neighbours, or inside out.

    Parameters
    ----------
    surface : Surface

    Raises
    ------
    InputError    the first of these that is found: where it is, and what to do

    Notes
    -----
    Every edge belongs to two triangles that run it opposite ways, but on the centreplane of a half and above the calm
    plane. The volume int y n_y dA is positive.  Source: Gauss's theorem.

    Examples
    --------
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
    loose = points[edges[~np.isin(forward, backward)]]
    allowed = _may_be_open(surface, loose)
    if not allowed.all():
        a, b = loose[~allowed][0]
        raise InputError(
            f"{surface.name}: the surface is open along {int((~allowed).sum())} edges, the first from {_place(a)} to "
            f"{_place(b)} m; it may only be open above the waterline and, for a half, on the centreplane; close the holes"
        )
    sides = _side_volumes(surface)
    if sum(sides) <= 0:
        raise InputError(
            f"{surface.name}: the surface is inside out (its volume comes out as {sum(sides):.4g} m3); reverse the order "
            "of the corners of every panel, so that they run anticlockwise as seen from the water"
        )
    if not surface.half and abs(sides[0] - sides[1]) > 0.01 * sum(sides):
        raise InputError(
            f"{surface.name}: port and starboard differ ({sides[0]:.5g} and {sides[1]:.5g} m3 either side of y = 0); only "
            "symmetric hulls with y from the centreplane are treated here"
        )


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


def _side_volumes(surface: Surface) -> tuple[float, float]:
    """int y n_y dA over the triangles on either side of y = 0 [m3]."""
    a, b, c = (surface.points[surface.triangles[:, k]] for k in range(3))
    share = (a + b + c)[:, 1] / 3 * np.cross(b - a, c - a)[:, 1] / 2
    left = (a + b + c)[:, 1] < 0
    return float(share[left].sum()), float(share[~left].sum())


def surface_lines(surface: Surface, stations: int = STATIONS) -> Lines:
    """Sections of a surface as lines.

    Parameters
    ----------
    surface : Surface    checked
    stations : int       how many to cut when the surface has no stations of its own

    Returns
    -------
    Lines    aft to fore

    Raises
    ------
    InputError    a section in several pieces, or one whose outline goes down again on its way up: named by station

    Notes
    -----
    Cut at the rows of points when they lie on 8 to 80 stations, else at even distances; plane cuts of the triangles.
    Source: geometry.  Valid: sections in one piece.

    Examples
    --------
    >>> from quartering.hull.mesh_files import box_triangles
    >>> box = joined_surface("box", box_triangles(60.0, 10.0, 6.0), half=False, waterline=None)
    >>> lines = surface_lines(box)
    >>> len(lines.x), lines.contours[5][0].max().round(6)
    (41, np.float64(5.0))
    """
    x = surface.points[:, 0]
    low, high = float(x.min()), float(x.max())
    step = 1e-5 * (high - low)
    rows = np.unique(np.round(x / step)) * step
    at = rows if 8 <= len(rows) <= _OWN_STATIONS else np.linspace(low, high, stations)
    at = np.clip(at - np.sign(at - (low + high) / 2) * step, low + step, high - step)
    labels = tuple(f"station {k + 1} (x = {one:.5g} m)" for k, one in enumerate(at))
    contours = tuple(_section(surface, float(one), label) for one, label in zip(at, labels, strict=True))
    return Lines(at, contours, labels, f"sections of the surface {surface.name}", surface.waterline == 0.0)


def _section(surface: Surface, x: float, label: str) -> Contour:
    """Starboard half of the cut at x, keel to deck."""
    where = f"{surface.name}: {label}"
    y, z = _cut(surface, x, where).T
    if surface.half:
        y = np.abs(y)
    else:
        y, z = _positive_side(y, z)
    if z[0] > z[-1]:
        y, z = y[::-1], z[::-1]
    while len(y) > 2 and y[-1] < y[-2] and abs(z[-1] - z[-2]) < 0.1 * (y[-2] - y[-1]):  # the deck
        y, z = y[:-1], z[:-1]
    rise = np.maximum.accumulate(z)
    z = np.where(rise - z < 1e-4 * np.ptp(z), rise, z)
    y = np.where(y < 1e-6 * max(float(y.max()), 1e-9), 0.0, y)
    check_contour(where, y, z)
    return y, z


def _cut(surface: Surface, x: float, where: str) -> Floats:
    """Points (n, 2) of the cut in order, from one end to the other; a closed one starts on the far side of y = 0."""
    neighbours = _crossed_edges(surface, x)
    if not neighbours:
        raise InputError(f"{where}: the surface has no section here")
    place = {node: _crossing(surface, node, x) for node in neighbours}
    tips = [node for node, others in neighbours.items() if len(others) == 1]
    start = tips[0] if tips else min(neighbours, key=lambda node: float(place[node][0]))
    order = [start]
    previous: Node | None = None
    while len(order) <= len(neighbours):
        ahead = [node for node in neighbours[order[-1]] if node not in (previous, start)]
        if not ahead:
            break
        previous = order[-1]
        order.append(ahead[0])
    if len(order) < len(neighbours):
        raise InputError(
            f"{where}: the section is in several pieces (a bulb or an appendage apart from the hull); cut it off"
        )
    return np.array([place[node] for node in order])


def _crossed_edges(surface: Surface, x: float) -> dict[Node, list[Node]]:
    """Edges that cross the plane, each with the edges it shares a triangle with."""
    side = surface.points[:, 0] > x
    crossed = surface.triangles[(side[surface.triangles].sum(axis=1) % 3) != 0]
    neighbours: dict[Node, list[Node]] = {}
    for a, b, c in crossed.tolist():
        one, other = ((min(p, q), max(p, q)) for p, q in ((a, b), (b, c), (c, a)) if side[p] != side[q])
        neighbours.setdefault(one, []).append(other)
        neighbours.setdefault(other, []).append(one)
    return neighbours


def _crossing(surface: Surface, edge: Node, x: float) -> Floats:
    """The point (y, z) at which an edge crosses the plane."""
    a, b = surface.points[edge[0]], surface.points[edge[1]]
    share = (x - a[0]) / (b[0] - a[0])
    cut: Floats = a[1:] + share * (b[1:] - a[1:])
    return cut


def _positive_side(y: Floats, z: Floats) -> Contour:
    """The run of a section with y >= 0, its ends on the centreline where it crosses it."""
    points: list[tuple[float, float]] = [(float(y[0]), float(z[0]))] if y[0] >= 0 else []
    closed = list(zip([*y.tolist(), float(y[0])], [*z.tolist(), float(z[0])], strict=True))
    last = len(y) if y[0] < 0 and y[-1] > 0 else len(y) - 1
    for (y0, z0), (y1, z1) in pairwise(closed[: last + 1]):
        if y0 * y1 < 0:
            points.append((0.0, z0 + (z1 - z0) * y0 / (y0 - y1)))
        if y1 >= 0:
            points.append((y1, z1))
    kept = np.array(points)
    return kept[:, 0], kept[:, 1]

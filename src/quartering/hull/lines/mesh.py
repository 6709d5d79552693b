"""Panel mesh of the immersed hull: quadrilaterals for three-dimensional codes, from the same lines as the strips."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.piecewise import monotone_cubic
from quartering.conventions import InputError
from quartering.hull.lines.contour import along
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import immersed_curve, strips
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import wholly_under_water

POINTED_SHARE = 0.02
"""An end whose section has less than this share of the largest section area closes in a line instead of a flat."""


@dataclass(frozen=True, eq=False)
class Panels:
    """Panels of the starboard half of the immersed hull; port is its mirror image.

    Parameters
    ----------
    vertices : (v, 3) float    x from midship + forward, y to starboard, z down from the calm plane [m]
    quads : (p, 4) int         vertices of each panel, normal out of the hull by the right-hand rule; a triangle repeats
                               one
    """

    vertices: Floats
    quads: NDArray[np.int64]

    @property
    def area_vectors(self) -> Floats:
        """Outward normal times area of each panel (p, 3) [m2]."""
        a, b, c, d = (self.vertices[self.quads[:, k]] for k in range(4))
        return np.asarray(0.5 * np.cross(c - a, d - b))

    @property
    def volume(self) -> float:
        """Displaced volume of both sides, from the vertical projections of the panels [m3]."""
        centre = self.vertices[self.quads].mean(axis=1)
        return float(2.0 * (centre[:, 2] * self.area_vectors[:, 2]).sum())


def hull_panels(hull: Hull, along_hull: int = 40, around: int = 10) -> Panels:
    """Panels of the starboard half of a hull below its waterline.

    along_hull: panels along the ship, at least 8; finer towards the ends
    around: panels from keel to waterline, at least 3; finer towards the waterline
    Returns closed but for the calm plane and the centre plane

    Points at equal fractions of the girth are carried along the ship by monotone cubics through the stations; a box
    keeps its edges. An end with area (a transom) is closed by a flat, a pointed one by its stem line.
    Source: [Fritsch84] (curves).  Valid: hulls whose contours change gradually along the ship.
    """
    if along_hull < 8 or around < 3:
        raise InputError(
            f"{along_hull} panels along and {around} around the hull; give at least 8 along and 3 around, such as 40 and 10"
        )
    return _cleaned(closed_panels(hull_grid(hull, along_hull, around)))


class Grid(NamedTuple):
    """Contours along a hull, the same number of points on each.

    Parameters
    ----------
    x : (n,) float         from midship, aft to fore [m]
    y, z : (n, m) float    starboard points, keel to waterline, z down from the calm plane; an end that closes in a line
                           has y = 0 throughout [m]
    """

    x: Floats
    y: Floats
    z: Floats


def closed_panels(grid: Grid) -> Panels:
    """Panels between the contours of a grid, an end with area closed by a flat.

    grid: n contours of m points
    Returns first those of the (n - 1) (m - 1) meshes, contour by contour from the keel up; some may have no area

    >>> from quartering.hull.lines.hull import wigley_hull
    >>> len(closed_panels(hull_grid(wigley_hull(100.0, 10.0, 6.25, 10.0), 8, 3)).quads)
    24
    """
    x, y, z = grid
    vertices = np.stack([np.broadcast_to(x[:, None], y.shape), y, z], axis=-1).reshape(-1, 3)
    index = np.arange(y.size).reshape(y.shape)
    quads = [np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1).reshape(-1, 4)]
    for end, outward in ((0, -1), (-1, 1)):
        if y[end].any():
            more, faces = _flat(x[end], y[end], z[end], index[end], len(vertices), outward)
            vertices = np.concatenate([vertices, more])
            quads.append(faces)
    return Panels(vertices, np.concatenate(quads))


def hull_grid(hull: Hull, along_hull: int, around: int) -> Grid:
    """Contours of a hull carried along it, finer towards the ends and the waterline.

    along_hull: meshes along the ship
    around: meshes from keel to waterline
    Returns an end whose section has less than 2 % of the largest section area has no breadth

    Sections wholly under water, of a bulb ahead of the stem, are left out.
    Source: [Fritsch84] (curves).  Valid: as `hull_panels`.
    """
    fraction = np.sin(np.linspace(0.0, np.pi / 2, around + 1)) * 0.4 + np.linspace(0.0, 0.6, around + 1)
    under = wholly_under_water(strips(hull))
    piercing = [i for i, out in zip(hull.wet, under, strict=True) if not out]
    stations = np.array([hull.x[i] for i in piercing])
    lines = [_contour(hull, i, fraction) for i in piercing]
    y, z = (np.stack(column) for column in zip(*lines, strict=True))
    first, last = float(stations[0]), float(stations[-1])
    if hull.shape != "offsets":  # stations are Gauss nodes, which stop short of the ends
        first, last = hull.x_aft, hull.x_fore
    angle = np.linspace(0.0, np.pi, along_hull + 1)
    spacing = 0.6 * (1 - np.cos(angle)) / 2 + 0.4 * angle / np.pi
    x = first + (last - first) * spacing
    if hull.shape == "box":
        y, z = (np.repeat(values[:1], x.size, axis=0) for values in (y, z))
    else:
        y, z = (monotone_cubic(stations, values)(x) for values in (y, z))
    y, z = np.maximum(y, 0.0), np.maximum(z, 0.0)
    y[:, 0], z[:, -1] = 0.0, 0.0
    area = -2 * (0.5 * (y[:, 1:] + y[:, :-1]) * np.diff(z, axis=1)).sum(axis=1)
    for end in (0, -1):
        if area[end] <= POINTED_SHARE * area.max():
            y[end] = 0.0
    return Grid(x, y, z)


def _contour(hull: Hull, station: int, fraction: Floats) -> tuple[Floats, Floats]:
    """Points of a station at fractions of its girth; those of a box are spaced on bottom and side apart."""
    curve, end = immersed_curve(hull, station)
    if hull.shape == "box":
        bottom, side = hull.beam / 2, hull.draught
        on_bottom = min(max(2, round((fraction.size - 1) * bottom / (bottom + side))), fraction.size - 2)
        chord = np.concatenate(
            [np.linspace(0.0, bottom, on_bottom + 1), np.linspace(bottom, end, fraction.size - on_bottom)[1:]]
        )
    else:
        s = np.linspace(0.0, end, 401)
        y, height, *_ = along(curve, s)
        girth = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(height)))])
        chord = np.interp(fraction * girth[-1], girth, s)
    y, height, *_ = along(curve, chord)
    return np.maximum(y, 0.0), hull.draught - height


def _flat(
    x: float, y: Floats, z: Floats, rim: NDArray[np.int64], first: int, outward: int
) -> tuple[Floats, NDArray[np.int64]]:
    """Panels of a flat end between the centre line and its contour: new vertices, numbered from `first`, and quads."""
    shares = np.linspace(0.0, 1.0, max(2, round(y.size / 3)) + 1)[:-1]
    inner = np.stack([np.full((shares.size, y.size), x), shares[:, None] * y, np.tile(z, (shares.size, 1))], axis=-1)
    index = np.concatenate([first + np.arange(shares.size * y.size).reshape(shares.size, y.size), rim[None]])
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    # keel to waterline, then outward in y: the right-hand normal points forward
    return inner.reshape(-1, 3), quads if outward > 0 else quads[:, ::-1]


def _cleaned(loose: Panels) -> Panels:
    """Panels with vertices that coincide made one, and those without area left out."""
    vertices, quads = loose.vertices, loose.quads
    size = float(np.ptp(vertices, axis=0).max())
    _, kept, back = np.unique(np.round(vertices / (1e-9 * size)), axis=0, return_index=True, return_inverse=True)
    panels = Panels(vertices[kept], back.ravel()[quads])
    area = np.linalg.norm(panels.area_vectors, axis=1)
    return Panels(panels.vertices, panels.quads[area > 1e-9 * area.max()])

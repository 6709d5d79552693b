"""The immersed hull as quadrature points: `strips(hull)`."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.contour import Curve, along, chord_at_height
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.panels import POINTS_PER_PANEL, Nodes, panel_ends, panel_nodes
from quartering.hull.lines.quadrature import gauss
from quartering.hull.lines.strips import Strips


@lru_cache(maxsize=64)
def strips(hull: Hull, points: int = 24) -> Strips:
    """Quadrature points of the immersed starboard contour at every immersed station, and weights along the ship.

    points: quadrature points on each contour, even, at least 8
    Returns aft to fore; stations without an immersed part are left out (their integrands are zero)

    Offsets: contour curve cut at the waterline, two Gauss-Legendre points on each of ``points / 2`` panels that end at
    offset points.
    Wigley and box: the exact outline at Gauss nodes, in a variable in which every wave integrand is entire.
    A station with depth but no breadth (stem line) is a plate of half thickness 0.001 B/2, so that what depends on its
    depth is not lost.  Source: [Fritsch84] (contour), [Gill72] (stations), [Abramowitz64] 25.4.30 (Gauss).
    Valid: symmetric hull on even keel.
    """
    if points < 8 or points % POINTS_PER_PANEL:
        raise InputError(f"points = {points}; give an even number, 8 or more, such as 24")
    wet = list(hull.wet)
    if not wet:
        raise InputError(f"{hull.name}: no station reaches below the waterline at draught {hull.draught:g} m")
    _refuse_gaps(hull, wet)
    if hull.shape == "offsets":
        nodes = [_offset_nodes(hull, i, points) for i in wet]
        breadth = np.array([_waterline_breadth(hull, i) for i in wet])
    else:
        exact = _wigley_nodes if hull.shape == "wigley" else _box_nodes
        nodes = [exact(hull, float(hull.x[i]), points) for i in wet]
        breadth = np.array([_analytic_breadth(hull, float(hull.x[i])) for i in wet])
    y, z, dy, dz = (np.stack(column) for column in zip(*nodes, strict=True))
    depth = np.array([hull.draught - hull.contours[i][1][0] for i in wet])
    area = -2 * (y * dz).sum(axis=1)
    fields = (hull.x[wet], hull.weight[wet], y, z, dy, dz, breadth, depth, area)
    for field in fields:
        field.flags.writeable = False
    return Strips(*fields)


def _refuse_gaps(hull: Hull, wet: list[int]) -> None:
    """Only the ends may rise out of the water."""
    dry = [i for i in range(wet[0], wet[-1]) if i not in set(wet)]
    if dry:
        raise InputError(
            f"{hull.name}: station {dry[0] + 1} (x = {hull.x[dry[0]]:g} m) lies above the water (lowest point "
            f"{hull.contours[dry[0]][1][0]:g} m over the baseline, draught {hull.draught:g} m) between stations that float; "
            "check the heights of its offsets"
        )


def _offset_nodes(hull: Hull, station: int, points: int) -> Nodes:
    """Nodes of a contour given by offsets: Gauss rules on panels of its curve."""
    curve, end = immersed_curve(hull, station)
    ends = panel_ends(curve, end, points // POINTS_PER_PANEL)
    y, height, dy, dheight = (part.ravel() for part in panel_nodes(curve, ends[:-1], ends[1:]))
    return y, hull.draught - height, dy, -dheight


def immersed_curve(hull: Hull, station: int) -> tuple[Curve, float]:
    """Smooth contour of a station and the chord length at which it meets the calm plane.

    station: index into ``hull.x``
    Returns curve: keel to deck; end: chord length at the waterline [m]

    Source: [Fritsch84].
    """
    curve = hull.curves[station]
    return curve, chord_at_height(curve, hull.draught)


def _waterline_breadth(hull: Hull, station: int) -> float:
    curve, end = immersed_curve(hull, station)
    return float(along(curve, np.array([end]))[0][0])


def _wigley_nodes(hull: Hull, x: float, points: int) -> Nodes:
    """Exact Wigley contour over t = (design draught - height) / design draught, and the wall above when deeper."""
    design, draught = hull.design_draught, hull.draught
    b = hull.beam / 2 * (1 - (2 * x / hull.length) ** 2)
    wall = 8 if draught > design else 0
    t, dt = gauss(points - wall, 1.0, max(0.0, 1 - draught / design))
    y, z = b * (1 - t**2), draught - design * (1 - t)
    dy, dz = -2 * b * t * dt, design * dt
    if wall:
        zw, dzw = gauss(wall, draught - design, 0.0)
        y, z = np.concatenate([y, np.full(wall, b)]), np.concatenate([z, zw])
        dy, dz = np.concatenate([dy, np.zeros(wall)]), np.concatenate([dz, dzw])
    return y, z, dy, dz


def _box_nodes(hull: Hull, _x: float, points: int) -> Nodes:
    """Exact box contour: half of the points on the bottom, half on the side."""
    half = points // 2
    yb, dyb = gauss(half, 0.0, hull.beam / 2)
    zs, dzs = gauss(points - half, hull.draught, 0.0)
    y = np.concatenate([yb, np.full(points - half, hull.beam / 2)])
    z = np.concatenate([np.full(half, hull.draught), zs])
    return y, z, np.concatenate([dyb, np.zeros(points - half)]), np.concatenate([np.zeros(half), dzs])


def _analytic_breadth(hull: Hull, x: float) -> float:
    if hull.shape == "box":
        return hull.beam / 2
    t = max(0.0, 1 - hull.draught / hull.design_draught)
    return hull.beam / 2 * (1 - (2 * x / hull.length) ** 2) * (1 - t**2)

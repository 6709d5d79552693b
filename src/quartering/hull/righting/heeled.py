"""Heeled sections cut by the waterline that keeps the volume: cross curves of stability."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.contour import along
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import immersed_curve
from quartering.hull.lines.section import Floats

PIECES = 96
"""Straight pieces, at least, that half a section is drawn with."""

_ITERATIONS = 60


class _Edges(NamedTuple):
    """Immersed edges of polygons: transverse coordinate of their two ends, and by how much the depth grows along them.

    Parameters
    ----------
    start, end, dq : (..., points - 1) float    of an edge in air dq is 0, and the ends mean nothing
    leaves, enters : (..., points - 1) bool     edges that cross the water on the way up, and on the way down
    """

    start: Floats
    end: Floats
    dq: Floats
    leaves: NDArray[np.bool_]
    enters: NDArray[np.bool_]


@lru_cache(maxsize=128)
def cross_curve(hull: Hull, phi: tuple[float, ...]) -> tuple[Floats, Floats]:
    """Lever KN of buoyancy about the keel, and freeboard of the lowest deck edge, at heel angles.

    phi: heel angles, positive starboard side down [rad]
    Returns kn (n,): [m]; the righting arm is KN - KG sin(phi); freeboard (n,): height of the lowest deck edge over the
        water [m]; negative when it is under

    Sections are polygons, both sides, closed at the deck; at every angle the waterline is moved until the volume is that
    of the upright hull (Newton within a bracket), without trim.  Source: [Lewis88] ch. 2.
    """
    y, height = polygons(hull)
    upright = float(hull.weight @ _area(_immersed(y, hull.draught - height)))
    cosine, sine = np.cos(phi)[:, None, None], np.sin(phi)[:, None, None]
    across, up = y * cosine + height * sine, height * cosine - y * sine  # axes level with the water
    level = _levels(hull, across, up, upright)
    moment = _moment(_immersed(across, level[:, None, None] - up))
    top = y.shape[1] // 2
    edge = up[:, :, top - 1 : top + 1].min(axis=(1, 2))
    return moment @ hull.weight / upright, edge - level


def _levels(hull: Hull, across: Floats, up: Floats, volume: float) -> Floats:
    """Height of the waterline at each angle that holds the volume."""
    low, high = up.min(axis=(1, 2)), up.max(axis=(1, 2))
    level = np.clip(hull.draught * np.ones(len(up)), low, high)
    for _ in range(_ITERATIONS):
        edges = _immersed(across, level[:, None, None] - up)
        excess = _area(edges) @ hull.weight - volume
        if (np.abs(excess) <= 1e-12 * volume).all():
            break
        slope = _width(edges) @ hull.weight
        low, high = np.where(excess < 0, level, low), np.where(excess > 0, level, high)
        newton = level - excess / np.where(slope > 0, slope, np.inf)
        level = np.where((newton > low) & (newton < high), newton, np.where(excess == 0, level, 0.5 * (low + high)))
    return level


@lru_cache(maxsize=64)
def polygons(hull: Hull, pieces: int = PIECES) -> tuple[Floats, Floats]:
    """Sections as polygons with both sides, closed at the deck.

    pieces: straight pieces of half a section, at least
    Returns y, height (s, n): keel, up the starboard side, across the deck, down the port side; the last point of a side
        is repeated where a section has fewer [m]
    """
    halves = []
    for i in range(len(hull.x)):
        curve, _ = immersed_curve(hull, i)
        ends = np.unique(curve.chord)
        each = max(1, -(-pieces // (len(ends) - 1)))
        fraction = np.arange(each) / each
        s = np.append((ends[:-1, None] + np.diff(ends)[:, None] * fraction).ravel(), ends[-1])
        halves.append(np.stack(along(curve, s)[:2]))
    longest = max(half.shape[1] for half in halves)
    y, height = np.stack([np.pad(half, ((0, 0), (0, longest - half.shape[1])), mode="edge") for half in halves], axis=1)
    return np.concatenate([y, -y[:, ::-1]], axis=1), np.concatenate([height, height[:, ::-1]], axis=1)


def _immersed(across: Floats, depth: Floats) -> _Edges:
    """Edges of counter-clockwise polygons (..., points), cut where depth > 0 ends.

    area = -closed integral of a dq, moment = -(1/2) closed integral of a^2 dq with q the depth: the cut itself, on q = 0,
    adds nothing.
    """
    under, wet = depth > 0, np.maximum(depth, 0.0)
    leaves, enters = under[..., :-1] & ~under[..., 1:], ~under[..., :-1] & under[..., 1:]
    start, end = across[..., :-1].copy(), across[..., 1:].copy()
    for crosses, cut in ((leaves, end), (enters, start)):  # few do: the others keep their own ends
        a0, a1 = across[..., :-1][crosses], across[..., 1:][crosses]
        q0, q1 = depth[..., :-1][crosses], depth[..., 1:][crosses]
        cut[crosses] = a0 + q0 / (q0 - q1) * (a1 - a0)
    return _Edges(start, end, wet[..., 1:] - wet[..., :-1], leaves, enters)


def _area(edges: _Edges) -> Floats:
    """Of the immersed part (...)."""
    return np.asarray(-0.5 * ((edges.start + edges.end) * edges.dq).sum(axis=-1))


def _moment(edges: _Edges) -> Floats:
    """First moment of the transverse coordinate of the immersed part (...)."""
    start, end = edges.start, edges.end
    return np.asarray(-((start * start + start * end + end * end) * edges.dq).sum(axis=-1) / 6.0)


def _width(edges: _Edges) -> Floats:
    """At the waterline (...)."""
    up, down = np.where(edges.leaves, edges.end, 0.0), np.where(edges.enters, edges.start, 0.0)
    return np.asarray(up.sum(axis=-1) - down.sum(axis=-1))


def deck_angle(hull: Hull) -> float:
    """Heel at which the first deck edge (top of a contour) goes under, at constant displacement.

    Returns [deg], to the nearest 0.1; inf when no edge goes under below 80 deg

    Source: geometry, with the waterlines of ``righting_arm``.
    """
    angles = np.linspace(0.0, 80.0, 17)
    for _ in range(2):
        freeboard = cross_curve(hull, tuple(np.radians(angles).tolist()))[1]
        if not (freeboard < 0).any():
            return float("inf")
        if freeboard[0] < 0:
            return 0.0
        at = max(1, int(np.argmax(freeboard < 0)))
        angles = np.linspace(angles[at - 1], angles[at], 11)
    return float(np.interp(0.0, -freeboard[at - 1 : at + 1], [angles[0], angles[-1]]))

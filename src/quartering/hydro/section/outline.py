"""The immersed half outline of a section as a curve with corners, ready for a boundary-element solution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.contour import Curve, along, chord_at_height, contour_curve
from quartering.hull.lines.section import Floats, Section

CORNER_ANGLE: Final = 30.0
"""Turn of the contour at a point from which on the point is a corner, not a sample of a smooth bend [deg]."""
STRIP_CORNER_ANGLE: Final = 45.0
"""The same between neighbouring quadrature points of a strip, which are further apart [deg]."""
SHORTEST_ARC: Final = 0.02
"""Arcs between corners shorter than this share of the contour are joined to a neighbour."""
THIN: Final = 1e-3
"""Half thickness, of the largest half breadth, given to a part of the contour that lies in the centre plane."""
_SAME: Final = 1e-9


@dataclass(frozen=True, eq=False)
class Outline:
    """Starboard half of an immersed section, from the keel to the waterline (or to its top on the centre plane).

    Parameters
    ----------
    curve : Curve          half breadth and height above the calm plane (<= 0) over chord length [m]
    corners : (c,) float   chord lengths of both ends and of the corners between, ascending [m]
    submerged : bool       the contour ends on the centre plane below the surface
    """

    curve: Curve
    corners: Floats
    submerged: bool

    def at(self, chord: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Points y, z (down) and their derivatives by chord length."""
        y, height, dy, dheight = along(self.curve, chord)
        return y, -height, dy, -dheight

    @property
    def size(self) -> float:
        """Largest extent of the contour [m]."""
        return float(np.abs(self.curve.point).max())


def section_outline(section: Section) -> Outline:
    """Outline of the immersed part of a section given by points.

    section: from the keel up; a point where the contour turns by 30 degrees or more is a corner

    A flat bottom given from its outer edge is closed to the centre plane; points on the centre plane above the hull (over
    a bulb) are left out, elsewhere (a bare skeg, a web) they are a plate of half thickness 0.001 of the half breadth.
    Points are joined by a monotone cubic.  Source: [Fritsch84] (curve); geometry.
    Valid: contours symmetric to the centre plane.
    """
    y, z = _cleaned(section.y, section.z)
    _refuse_crossing(y, z)
    size = max(float(y.max()), float(z.max()))
    corner = _is_corner(y, z, CORNER_ANGLE)
    repeat = 1 + corner.astype(int)
    curve = contour_curve(np.repeat(y, repeat), -np.repeat(z, repeat))
    end = chord_at_height(curve, 0.0) if z.min() < 0.0 else float(curve.chord[-1])
    submerged = bool(z[-1] > 1e-6 * size)
    if submerged and y[-1] > 1e-6 * size:
        raise InputError(
            f"the section's contour is open: it ends {z[-1]:g} m below the water at half breadth {y[-1]:g} m; "
            "continue it up to the waterline (z = 0), or close it to the centre plane (y = 0)"
        )
    # a repeated chord is a knuckle; only those below the water count
    knuckles = curve.chord[1:][np.diff(curve.chord) <= 0.0]
    return Outline(curve, _arcs(np.concatenate([[0.0], knuckles[knuckles < end * (1 - 1e-9)], [end]])), submerged)


def strip_outline(
    y: Floats, z: Floats, dy: Floats, dz: Floats, half_breadth: float, draught: float, name: str = "section"
) -> Outline:
    """Outline of a strip, through its quadrature points and with their tangents.

    y, z, dy, dz (n,): points and differentials, keel to waterline, as in `Strips` [m]
    half_breadth: at the calm plane [m]
    draught: depth of the keel on the centre plane [m]
    name: what an error calls the section

    Where the tangents of neighbouring points differ by 45 degrees or more, a corner is put where they meet.
    Source: geometry (cubic Hermite curve).  Valid: strips of at least 8 points.
    """
    if y.size < 2 or not y.max() > _SAME * draught:
        raise InputError(
            f"{name} has no breadth or no contour points, so its contour cannot be solved; "
            "take Lewis forms (sections: lewis)"
        )
    length = np.hypot(dy, dz)
    keep = length > 0.0
    point = np.stack([y, -z], axis=1)[keep]
    tangent = np.stack([dy, -dz], axis=1)[keep] / length[keep, None]
    wide = np.flatnonzero(point[:, 0] > _SAME * y.max())
    last = int(wide[-1]) + 1
    head = np.array([0.0, -draught])
    covered = last < len(point) or half_breadth <= _SAME * y.max()
    tail = np.array([0.0, point[last, 1] if last < len(point) else 0.0]) if covered else np.array([half_breadth, 0.0])
    point, tangent = point[:last], tangent[:last]
    point[:, 0] = np.maximum(point[:, 0], THIN * y.max())
    curve = _hermite(head, point, tangent, tail)
    knuckles = curve.chord[1:][np.diff(curve.chord) <= 0.0]
    return Outline(curve, _arcs(np.array([0.0, *knuckles, curve.chord[-1]])), bool(tail[1] < -1e-6 * draught))


def _hermite(head: Floats, point: Floats, tangent: Floats, tail: Floats) -> Curve:
    """Cubic Hermite curve through points with unit tangents, with corners where neighbouring tangents part."""
    t0 = _mirrored(point[0] - head, tangent[0])
    t1 = _mirrored(tail - point[-1], tangent[-1])
    p = [head, *point, tail]
    t = [t0, *tangent, t1]
    points, slopes, chord = [p[0]], [t[0]], [0.0]
    for k in range(1, len(p)):
        if float(t[k - 1] @ t[k]) < np.cos(np.deg2rad(STRIP_CORNER_ANGLE)):
            meet = _meeting(p[k - 1], t[k - 1], p[k], t[k])
            before, after = _unit(meet - p[k - 1]), _unit(p[k] - meet)
            s = chord[-1] + float(np.linalg.norm(meet - p[k - 1]))
            points += [meet, meet]
            slopes += [before, after]
            chord += [s, s]
        points.append(p[k])
        slopes.append(t[k])
        chord.append(chord[-1] + float(np.linalg.norm(points[-1] - points[-2])))
    return Curve(np.array(chord), np.array(points), np.array(slopes))


def _mirrored(chord: Floats, tangent: Floats) -> Floats:
    """Tangent at the far end of a parabola with a given chord and tangent at the near one."""
    along_chord = _unit(chord)
    out = 2.0 * (along_chord @ tangent) * along_chord - tangent
    return np.asarray(out if along_chord @ tangent > 0.5 else along_chord)


def _unit(vector: Floats) -> Floats:
    return np.asarray(vector / max(float(np.linalg.norm(vector)), 1e-300))


def _meeting(p0: Floats, t0: Floats, p1: Floats, t1: Floats) -> Floats:
    """Where two tangents meet between their points, or half-way between the points."""
    cross = t0[0] * t1[1] - t0[1] * t1[0]
    gap = p1 - p0
    reach = float(np.linalg.norm(gap))
    if abs(cross) > 1e-6:
        u, v = (gap[0] * t1[1] - gap[1] * t1[0]) / cross, (gap[0] * t0[1] - gap[1] * t0[0]) / cross
        if 1e-6 * reach < u < 1.5 * reach and 1e-6 * reach < -v < 1.5 * reach:
            return np.asarray(p0 + u * t0)
    return np.asarray(0.5 * (p0 + p1))


def _cleaned(y: Floats, z: Floats) -> tuple[Floats, Floats]:
    """Points without repetitions and without what lies on the centre plane below or above the hull; closed below."""
    if z[0] <= 0.0:
        raise InputError(
            f"the section's contour starts above the water (z = {z[0]:g} m); give its points from the keel up"
        )
    top = _last_wet(z)
    y, z = y[: top + 1], z[: top + 1]
    size = max(float(y.max()), float(z.max()))
    if not y.max() > _SAME * size:
        raise InputError(
            "the section has no breadth under water: its contour lies in the centre plane; give half breadths, or take "
            'the Lewis form of 0.02 of its draught (method "lewis")'
        )
    wide = np.flatnonzero(y > _SAME * size)
    last = min(int(wide[-1]) + 1, y.size - 1)
    y, z = np.array(y[: last + 1]), np.array(z[: last + 1])
    y[y <= _SAME * size] = 0.0
    y[1:-1] = np.maximum(y[1:-1], THIN * y.max())
    if y[0] > 0.0:
        y, z = np.concatenate([[0.0], y]), np.concatenate([z[:1], z])
    new = np.concatenate([[True], np.hypot(np.diff(y), np.diff(z)) > _SAME * size])
    return y[new], z[new]


def _last_wet(z: Floats) -> int:
    """Index of the first point at or above the water; the contour is followed that far."""
    dry = np.flatnonzero(z <= 0.0)
    if dry.size == 0:
        return int(z.size - 1)
    first = int(dry[0])
    if (z[first:] > 1e-6 * z.max()).any():
        raise InputError("the section's contour leaves the water and enters it again; give one hull at a time")
    return first


def _is_corner(y: Floats, z: Floats, angle: float) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    turn = np.zeros(y.size, dtype=bool)
    direction = np.arctan2(np.diff(z), np.diff(y))
    change = np.abs((np.diff(direction) + np.pi) % (2.0 * np.pi) - np.pi)
    turn[1:-1] = change >= np.deg2rad(angle)
    return turn


def _arcs(corners: Floats) -> Floats:
    """Corners without those that bound an arc too short to be one of its own; the ends stay."""
    kept = [float(corners[0])]
    whole = float(corners[-1])
    for c in corners[1:-1]:
        if c - kept[-1] >= SHORTEST_ARC * whole and whole - c >= SHORTEST_ARC * whole:
            kept.append(float(c))
    return np.array([*kept, whole])


def _refuse_crossing(y: Floats, z: Floats) -> None:
    """Refuse a contour of which two pieces cross; a contour that never descends cannot."""
    if (np.diff(z) <= 0.0).all():
        return
    # Piece n, from p_n to p_n + d_n, crosses piece m when the ends of each lie on opposite sides of the other's line.
    # A distance from a line is known to rounding only, so ends nearer than `_SAME` of the size count as on the line:
    # without that, pieces of one straight side cross by chance.
    p = y + 1j * z
    start, step, same = p[:-1], np.diff(p), _SAME * float(np.abs(p).max())
    unit = step / np.abs(step)
    for m in range(step.size - 2):
        after = slice(m + 2, None)
        others = [(unit[m].conj() * (end - start[m])).imag for end in (start[after], p[m + 3 :])]
        own = [(unit[after].conj() * (end - start[after])).imag for end in (start[m], p[m + 1])]
        crossing = np.flatnonzero(_opposite(others, same) & _opposite(own, same))
        if crossing.size:
            n = m + 2 + int(crossing[0])
            raise InputError(
                f"the section's contour crosses itself: the piece from ({y[m]:g}, {z[m]:g}) m crosses the one from "
                f"({y[n]:g}, {z[n]:g}) m; give the points in order from the keel up"
            )


def _opposite(distances: list[Floats], same: float) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Do both ends of a piece lie on opposite sides of a line, by more than ``same``?"""
    return np.asarray((np.minimum(*distances) < -same) & (np.maximum(*distances) > same))

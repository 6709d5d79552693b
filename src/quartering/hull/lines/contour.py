"""Section outline as an interpolated curve through offset points, keel to deck."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from quartering._machine.piecewise import monotone_slopes
from quartering.hull.lines.section import Floats

Outline = Literal["smooth", "straight"]
"""How contour points are joined: by a monotone cubic, or by straight lines."""


@dataclass(frozen=True, eq=False)
class Curve:
    """Monotone cubic curve (y, height) over chord length, through the points of one contour.

    Parameters
    ----------
    chord : (n,) float       chord length at the points, from the keel [m]; a repeated value is a knuckle
    point : (n, 2) float     half breadth and height above the baseline [m]
    slope : (n, 2) float     derivative of the points by chord length [1]
    """

    chord: Floats
    point: Floats
    slope: Floats


def contour_curve(y: Floats, height: Floats, outline: Outline = "smooth") -> Curve:
    """Lay a curve through contour points; a point given twice keeps its corner.

    y, height (n,): half breadths and heights above the baseline, keel to deck [m]
    outline: "smooth" (monotone cubic) or "straight" (every point a corner)
    Returns piecewise cubic, no overshoot between points, continuous tangent except at knuckles

    Monotone cubic interpolation of both coordinates over chord length.  Source: [Fritsch84].
    Valid: heights that do not descend; straight runs (flat bottom, vertical side) stay straight.
    """
    point = np.stack([y, height], axis=1)
    if outline == "straight":
        point = np.repeat(point, 2, axis=0)[1:-1]
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(point, axis=0).T))])
    return Curve(chord, point, _slopes(chord, point))


def _slopes(s: Floats, point: Floats) -> Floats:
    """Slopes at ``point`` (n, 2) over ``s`` (n,) of the monotone cubics that run from knuckle to knuckle."""
    slope = np.zeros_like(point)
    knuckles = np.flatnonzero(np.diff(s) <= 0.0) + 1  # an interval of no length
    for run in np.split(np.arange(s.size), knuckles):
        if run.size == 2:
            slope[run] = (point[run[1]] - point[run[0]]) / (s[run[1]] - s[run[0]])
        elif run.size > 2:
            slope[run] = monotone_slopes(s[run], point[run])
    return slope


def along(curve: Curve, s: Floats, side: Literal["left", "right"] = "right") -> tuple[Floats, Floats, Floats, Floats]:
    """Points and tangents of a contour at chord lengths.

    curve: the contour
    s (n,): chord lengths from the keel [m]
    side: at a knuckle, the tangent above it ("right") or below it ("left")
    Returns y, height, dy, dheight (n,): coordinates [m] and their derivatives by chord length [1]

    Cubic Hermite form.  Source: [Fritsch84].
    """
    i = np.clip(np.searchsorted(curve.chord, s, side=side) - 1, 0, len(curve.chord) - 2)
    while (flat := curve.chord[i + 1] <= curve.chord[i]).any():  # land on the interval before a knuckle
        i = np.where(flat, i - 1, i)
    h = (curve.chord[i + 1] - curve.chord[i])[:, None]
    t = (s - curve.chord[i])[:, None] / h
    p0, p1, m0, m1 = curve.point[i], curve.point[i + 1], curve.slope[i] * h, curve.slope[i + 1] * h
    c2, c3 = 3 * (p1 - p0) - 2 * m0 - m1, 2 * (p0 - p1) + m0 + m1
    value = p0 + t * (m0 + t * (c2 + t * c3))
    tangent = (m0 + t * (2 * c2 + 3 * t * c3)) / h
    return value[:, 0], value[:, 1], tangent[:, 0], tangent[:, 1]


def chord_at_height(curve: Curve, height: float) -> float:
    """Chord length at which a contour first reaches a height (its whole length when it stays below).

    curve: the contour
    height: above the baseline [m]
    Returns chord length from the keel [m]

    Root of the cubic of the crossed interval, by bisection.  Source: [Fritsch84] (the height never descends).
    """
    heights = curve.point[:, 1]
    above = np.flatnonzero(heights >= height)
    if above.size == 0 or above[0] == 0:
        return float(curve.chord[-1] if above.size == 0 else 0.0)
    last = int(above[0])
    if heights[last] == height:
        return float(curve.chord[last])
    start, end = float(curve.chord[last - 1]), float(curve.chord[last])
    h0, h1 = float(heights[last - 1]), float(heights[last])
    m0, m1 = (float(slope) * (end - start) for slope in curve.slope[last - 1 : last + 1, 1])
    c2, c3 = 3 * (h1 - h0) - 2 * m0 - m1, 2 * (h0 - h1) + m0 + m1
    low, high = 0.0, 1.0
    for _ in range(53):
        t = 0.5 * (low + high)
        low, high = (low, t) if h0 + t * (m0 + t * (c2 + t * c3)) >= height else (t, high)
    return start + high * (end - start)

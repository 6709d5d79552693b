"""The lines of a hull: contours from keel to deck at stations, floating at a draught."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.lines.contour import Curve, Outline, along, chord_at_height, contour_curve
from quartering.hull.lines.quadrature import gauss
from quartering.hull.lines.section import Floats, Section
from quartering.hull.option_types import Datum, Ends, Sections
from quartering.option_checks import Refused

Contour = tuple[Floats, Floats]
Shape = Literal["offsets", "wigley", "box"]

STATIONS = 41
"""Stations of a hull given by formula: Gauss-Legendre nodes, one of them amidships."""

STEM_HALF_THICKNESS = 0.001
"""Half thickness [of B/2] given to a station that has depth but no breadth (the line of the stem)."""


@dataclass(frozen=True, eq=False)
class Hull:
    """Lines of a ship, symmetric port and starboard, at the draught it floats at.

    Parameters
    ----------
    name : str                       what the hull is called
    length, beam, draught : float    between perpendiculars, moulded, present draught [m]
    x : (s,) float                   stations from midship, + forward, ascending [m]
    weight : (s,) float              sum(weight * f(x)) is the integral of f along the ship [m]
    contours : tuple of (y, height)  starboard outline of each station, keel to deck, above the baseline [m]
    x_aft, x_fore : float            ends of the hull [m]
    source : str                     where the lines come from
    shape : str                      "offsets", or "wigley" or "box" when integrals may use the exact formula
    design_draught : float           draught the lines were drawn for [m]
    outline : str                    how contour points are joined: "smooth" or "straight"
    section_method : str             how the water at a section is solved: "auto", "lewis" or "close-fit"
    lines_end : float or None        height at which the lowest of the given lines end, where `with_depth` carried them up [m]
    ends : str                       "strips": sections of infinite cylinders, or "three-dimensional"
    datum : str                      where the heights of the file were counted from: "keel" or "waterline"
    """

    name: str
    length: float
    beam: float
    draught: float
    x: Floats
    weight: Floats
    contours: tuple[Contour, ...]
    x_aft: float
    x_fore: float
    source: str
    shape: Shape
    design_draught: float
    outline: Outline = "smooth"
    section_method: Sections = "auto"
    ends: Ends = "strips"
    datum: Datum = "keel"
    lines_end: float | None = None

    def __repr__(self) -> str:
        sizes = f"L {self.length:.6g} B {self.beam:.4g} T {self.draught:.4g} m"
        return f"<Hull {self.name}: {sizes}, {len(self.x)} stations, deck at {self.depth:.4g} m>"

    @property
    def depth(self) -> float:
        """Height of the lowest deck edge (top of a contour) above the baseline [m]."""
        return min(float(height[-1]) for _, height in self.contours)

    @cached_property
    def wet(self) -> tuple[int, ...]:
        """Indices of the stations that have an immersed part, in the order of the strips."""
        keel = np.array([height[0] for _, height in self.contours])
        return tuple(int(i) for i in np.flatnonzero(self.draught - keel > 2e-3 * self.draught))

    @cached_property
    def sections(self) -> tuple[Section, ...]:
        """Sections of the immersed stations, aft to fore; z down from the calm plane."""
        return tuple(self._section(i) for i in self.wet)

    @cached_property
    def curves(self) -> tuple[Curve, ...]:
        """Contours as curves from keel to deck; one without breadth up to the waterline is a thin plate."""
        return tuple(self._curve(station) for station in range(len(self.x)))

    def _curve(self, station: int) -> Curve:
        y, height = self.contours[station]
        thin = STEM_HALF_THICKNESS * self.beam / 2
        if (y[height < self.draught] < thin).all() and np.interp(self.draught, height, y) < thin:
            y = np.concatenate([[0.0], np.maximum(y, thin)])
            height = np.concatenate([height[:1], height])
        return contour_curve(y, height, self.outline)

    def _section(self, station: int) -> Section:
        """Points of a contour and between them, with one at the waterline."""
        curve = self.curves[station]
        ends = np.unique(np.append(curve.chord, chord_at_height(curve, self.draught)))
        between = ends[:-1, None] + np.diff(ends)[:, None] * (np.arange(4) / 4)
        y, height, *_ = along(curve, np.append(between.ravel(), ends[-1]))
        return Section(np.maximum(y, 0.0), self.draught - height)


def wigley_hull(length: float, beam: float, draught: float, depth: float, name: str = "Wigley") -> Hull:
    """Classical Wigley hull, wall-sided above its design waterline.

    length, beam, draught: [m]
    depth: height of the deck above the keel [m]
    name: what it is called
    Returns stations at Gauss-Legendre nodes

    y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), z from the design waterline down.  Source: [Journee92] (the classical form).
    """
    x, weight = gauss(STATIONS, -length / 2, length / 2)
    t = np.linspace(1.0, 0.0, 25)
    height = np.concatenate([draught * (1 - t), [draught, depth]])
    profile = np.concatenate([1 - t**2, [1.0, 1.0]])  # the design waterline is given twice: a corner there
    contours = tuple((frozen(beam / 2 * (1 - (2 * xi / length) ** 2) * profile), frozen(height)) for xi in x)
    return Hull(
        name, length, beam, draught, frozen(x), frozen(weight), contours, -length / 2, length / 2,
        "formula of the classical Wigley hull; vertical sides above the design waterline", "wigley", draught,
    )  # fmt: skip


def box_hull(length: float, beam: float, draught: float, depth: float, name: str = "Box") -> Hull:
    """Rectangular barge.

    as in `wigley_hull`
    Returns stations at Gauss-Legendre nodes

    Source: closed form, y = B/2 for 0 < height < depth.
    """
    x, weight = gauss(STATIONS, -length / 2, length / 2)
    contour = (frozen(np.array([0.0, beam / 2, beam / 2])), frozen(np.array([0.0, 0.0, depth])))
    return Hull(
        name, length, beam, draught, frozen(x), frozen(weight), (contour,) * len(x), -length / 2, length / 2,
        "closed form", "box", draught,
    )  # fmt: skip


def at_draught(hull: Hull, draught: float, called: str | None = None) -> Hull:
    """The same hull floating at another draught, on even keel.

    draught: above 0, at most the height of the lowest deck edge [m]
    called: what the message calls the hull; its name by default
    Returns the lines are unchanged
    """
    if not 0 < draught <= hull.depth:
        raise Refused(
            "draught",
            f"draught = {draught:g} m; it must lie above 0 and at most {hull.depth:g} m, "
            f"where the lowest deck edge lies; try {hull.design_draught:g} m",
            called or hull.name,
        )
    return replace(hull, draught=float(draught))


def scaled(hull: Hull, length: float, beam: float, height: float) -> Hull:
    """Hull with its lines stretched by three factors.

    length, beam, height: factors on x, y and heights (draught among them), above 0

    Source: geometry; equal factors keep the shape (volume goes with their cube).
    """
    factors = np.array([length, beam, height])
    if not (np.isfinite(factors).all() and (factors > 0).all()):
        raise InputError(f"{hull.name}: scale factors {length:g}, {beam:g}, {height:g}; each must be a number above 0")
    return replace(
        hull,
        length=hull.length * length,
        beam=hull.beam * beam,
        draught=hull.draught * height,
        design_draught=hull.design_draught * height,
        x=frozen(hull.x * length),
        weight=frozen(hull.weight * length),
        contours=tuple((frozen(y * beam), frozen(h * height)) for y, h in hull.contours),
        x_aft=hull.x_aft * length,
        x_fore=hull.x_fore * length,
        lines_end=None if hull.lines_end is None else hull.lines_end * height,
    )


def with_depth(hull: Hull, depth: float, called: str | None = None) -> Hull:
    """Hull with its sides carried straight up to a deck at a given height, where they end below it.

    depth: height of the deck above the baseline, not below the draught [m]
    called: what the message calls the hull; its name by default

    Source: geometry; the added sides are an assumption about what the offsets do not give.
    """
    if not (np.isfinite(depth) and depth >= hull.draught):
        raise Refused(
            "depth",
            f"depth = {depth:g} m; the deck lies at or above the draught of {hull.draught:g} m; "
            f"try {1.5 * hull.draught:.4g} m",
            called or hull.name,
        )
    raised = tuple(
        (frozen([*y, y[-1], y[-1]]), frozen([*h, h[-1], depth])) if h[-1] < depth else (y, h) for y, h in hull.contours
    )
    tops = [float(h[-1]) for _, h in hull.contours if h[-1] < depth]
    known = [hull.lines_end] if hull.lines_end is not None else []
    return replace(hull, contours=raised, lines_end=min([*known, *tops], default=None))


def frozen(values: ArrayLike) -> Floats:
    """Copy of an array that cannot be written to.

    values (...): numbers
    Returns (...): read-only
    """
    out = np.array(values, dtype=float)
    out.flags.writeable = False
    return out

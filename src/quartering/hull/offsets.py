"""The lines of a hull: contours from keel to deck at stations, floating at a draught."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from quartering.conventions import InputError
from quartering.hull.contour import Outline
from quartering.hull.quadrature import gauss, station_weights
from quartering.hull.section import Floats, Section

Contour = tuple[Floats, Floats]
Shape = Literal["offsets", "wigley", "box"]

STATIONS_ANALYTIC = 41
"""Stations of a hull given by formula: Gauss-Legendre nodes, one of them amidships."""


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

    @property
    def depth(self) -> float:
        """Height of the highest contour point above the baseline [m]: where the deck is closed."""
        return max(float(height[-1]) for _, height in self.contours)

    @cached_property
    def wet(self) -> tuple[int, ...]:
        """Indices of the stations that have an immersed part, in the order of the strips."""
        keel = np.array([height[0] for _, height in self.contours])
        return tuple(int(i) for i in np.flatnonzero(self.draught - keel > 2e-3 * self.draught))

    @cached_property
    def sections(self) -> tuple[Section, ...]:
        """Sections of the immersed stations, aft to fore; z down from the calm plane."""
        return tuple(
            Section(self.contours[i][0], self.draught - self.contours[i][1])  # the deck part has z < 0
            for i in self.wet
        )


def hull_from_offsets(
    name: str,
    *,
    length: float,
    beam: float,
    draught: float,
    x: Floats,
    contours: tuple[Contour, ...],
    source: str = "given offsets",
    outline: Outline = "smooth",
) -> Hull:
    """Hull from contours at stations.

    Parameters
    ----------
    name : str                       what the hull is called
    length, beam, draught : float    between perpendiculars, moulded, draught [m]
    x : (s,) float                   stations from midship, + forward, ascending, at least 4 [m]
    contours : tuple of (y, height)  half breadths and heights above the baseline, keel to deck [m];
                                     a contour that does not start on the centreline gets a flat bottom
    source : str                     where the lines come from
    outline : str                    points joined "smooth" (monotone cubic) or "straight"

    Returns
    -------
    Hull    at its design draught

    Raises
    ------
    InputError    stations not ascending, heights descending, fewer than two points, a NaN: named by station

    Notes
    -----
    Station weights from ``station_weights``.  Source: [Gill72].

    Examples
    --------
    >>> import numpy as np
    >>> side = (np.array([0.0, 5.0, 5.0]), np.array([0.0, 0.0, 6.0]))
    >>> barge = hull_from_offsets("barge", length=60, beam=10, draught=4, x=np.linspace(-30, 30, 7), contours=(side,) * 7)
    >>> barge.sections[3].draught
    4.0
    """
    stations = np.array(x, dtype=float)
    _check_stations(name, stations, contours)
    closed = tuple(_closed(np.asarray(y, dtype=float), np.asarray(h, dtype=float)) for y, h in contours)
    return Hull(
        name=name,
        length=float(length),
        beam=float(beam),
        draught=float(draught),
        x=_frozen(stations),
        weight=_frozen(station_weights(stations)),
        contours=closed,
        x_aft=float(stations[0]),
        x_fore=float(stations[-1]),
        source=source,
        shape="offsets",
        design_draught=float(draught),
        outline=outline,
    )


def _check_stations(name: str, x: Floats, contours: tuple[Contour, ...]) -> None:
    """Refuse stations out of order and contours that cannot be a section, naming the station."""
    if len(x) != len(contours) or len(x) < 4:
        raise InputError(f"{name}: {len(x)} stations and {len(contours)} contours; give at least 4 of each, one per station")
    if not np.isfinite(x).all():
        raise InputError(f"{name}: a station position is not a number; give x in metres from midship, + forward")
    if (np.diff(x) <= 0).any():
        at = int(np.argmax(np.diff(x) <= 0))
        raise InputError(
            f"{name}: station {at + 2} (x = {x[at + 1]:g} m) does not lie forward of station {at + 1} (x = {x[at]:g} m); "
            "stations go from aft to fore, each once; sort them by x"
        )
    for i, (y, height) in enumerate(contours):
        where = f"{name}: station {i + 1} (x = {x[i]:g} m)"
        if len(y) != len(height) or len(y) < 2:
            raise InputError(f"{where}: {len(y)} half breadths and {len(height)} heights; give two or more, as many of each")
        if not (np.isfinite(y).all() and np.isfinite(height).all()):
            at = int(np.argmin(np.isfinite(y) & np.isfinite(height)))
            raise InputError(f"{where}, waterline {at + 1}: not a number; every half breadth and height must be finite")
        if np.min(y) < 0:
            at = int(np.argmin(y))
            raise InputError(
                f"{where}, waterline {at + 1} (height {height[at]:g} m): half breadth {y[at]:g} m is negative; "
                "half breadths are 0 or more, measured from the centreline to starboard"
            )
        if (np.diff(height) < 0).any():
            at = int(np.argmax(np.diff(height) < 0))
            raise InputError(
                f"{where}, waterline {at + 2}: height {height[at + 1]:g} m lies below the one before it ({height[at]:g} m), "
                "so the offsets cross; heights go up from keel to deck (equal heights make a flat); sort or correct them"
            )
        if height[-1] <= height[0]:
            raise InputError(f"{where}: the contour has no height; give points from the keel up to the deck")


def _closed(y: Floats, height: Floats) -> Contour:
    """Contour that starts on the centreline: a flat bottom is added where the first point has breadth."""
    if y[0] > 0:
        y, height = np.concatenate([[0.0], y]), np.concatenate([[height[0]], height])
    return _frozen(y), _frozen(height)


def _frozen(values: Floats) -> Floats:
    out = np.array(values, dtype=float)
    out.flags.writeable = False
    return out


def wigley_hull(length: float, beam: float, draught: float, depth: float, name: str = "Wigley") -> Hull:
    """Classical Wigley hull, wall-sided above its design waterline.

    Parameters
    ----------
    length, beam, draught : float    [m]
    depth : float                    height of the deck above the keel [m]
    name : str                       what it is called

    Returns
    -------
    Hull    stations at Gauss-Legendre nodes

    Notes
    -----
    y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), z from the design waterline down.  Source: [Journee92] (the classical form).

    Examples
    --------
    >>> wigley_hull(100.0, 10.0, 6.25, 10.0).sections[20].half_breadth
    5.0
    """
    x, weight = gauss(STATIONS_ANALYTIC, -length / 2, length / 2)
    t = np.linspace(1.0, 0.0, 25)
    height = np.concatenate([draught * (1 - t), [draught, depth]])
    profile = np.concatenate([1 - t**2, [1.0, 1.0]])  # the design waterline is given twice: a corner there
    contours = tuple((_frozen(beam / 2 * (1 - (2 * xi / length) ** 2) * profile), _frozen(height)) for xi in x)
    return Hull(
        name, length, beam, draught, _frozen(x), _frozen(weight), contours, -length / 2, length / 2,
        "formula of the classical Wigley hull; vertical sides above the design waterline", "wigley", draught,
    )  # fmt: skip


def box_hull(length: float, beam: float, draught: float, depth: float, name: str = "Box") -> Hull:
    """Rectangular barge.

    Parameters
    ----------
    length, beam, draught : float    [m]
    depth : float                    height of the deck above the keel [m]
    name : str                       what it is called

    Returns
    -------
    Hull    stations at Gauss-Legendre nodes

    Notes
    -----
    Source: closed form, y = B/2 for 0 < height < depth.

    Examples
    --------
    >>> box_hull(100.0, 20.0, 5.0, 10.0).sections[0].draught
    5.0
    """
    x, weight = gauss(STATIONS_ANALYTIC, -length / 2, length / 2)
    contour = (_frozen(np.array([0.0, beam / 2, beam / 2])), _frozen(np.array([0.0, 0.0, depth])))
    return Hull(
        name, length, beam, draught, _frozen(x), _frozen(weight), (contour,) * len(x), -length / 2, length / 2,
        "closed form", "box", draught,
    )  # fmt: skip


def at_draught(hull: Hull, draught: float) -> Hull:
    """The same hull floating at another draught, on even keel.

    Parameters
    ----------
    hull : Hull
    draught : float    above 0, at most the height of the deck [m]

    Returns
    -------
    Hull    the lines are unchanged

    Raises
    ------
    InputError    draught not between the keel and the deck

    Notes
    -----
    Source: geometry.

    Examples
    --------
    >>> at_draught(box_hull(100.0, 20.0, 5.0, 10.0), 6.0).sections[0].draught
    6.0
    """
    if not 0 < draught <= hull.depth:
        raise InputError(
            f"{hull.name}: draught {draught:g} m; it must lie above 0 and at most {hull.depth:g} m, where the offsets end; "
            f"try {hull.design_draught:g} m"
        )
    return replace(hull, draught=float(draught))


def scaled(hull: Hull, length: float, beam: float, height: float) -> Hull:
    """Hull with its lines stretched by three factors.

    Parameters
    ----------
    hull : Hull
    length, beam, height : float    factors on x, y and heights (draught among them), above 0

    Returns
    -------
    Hull

    Raises
    ------
    InputError    a factor that is not a positive number

    Notes
    -----
    Source: geometry; equal factors keep the shape (volume goes with their cube).

    Examples
    --------
    >>> twice = scaled(box_hull(100.0, 20.0, 5.0, 10.0), 2.0, 2.0, 2.0)
    >>> twice.length, twice.beam, twice.draught
    (200.0, 40.0, 10.0)
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
        x=_frozen(hull.x * length),
        weight=_frozen(hull.weight * length),
        contours=tuple((_frozen(y * beam), _frozen(h * height)) for y, h in hull.contours),
        x_aft=hull.x_aft * length,
        x_fore=hull.x_fore * length,
    )

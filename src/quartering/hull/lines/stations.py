"""Build a hull from station contours; validate the offsets."""

from __future__ import annotations

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.contour import Outline
from quartering.hull.lines.hull import Contour, Hull, frozen
from quartering.hull.lines.quadrature import station_weights
from quartering.hull.lines.section import Floats
from quartering.hull.lines.sense import check_breadths, check_coefficients, check_decks, check_extent, waterline_breadth

STEP = 3e-5
"""Distance of two stations that are a step of the lines, of the extent of the hull."""
BLUNT = 0.1
"""Half breadth at the waterline, of half the beam, from which on a section ends the hull in a flat."""


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
    labels: list[str] | None = None,
    title: str | None = None,
) -> Hull:
    """Hull from contours at stations.

    name: what the hull is called
    length, beam, draught: between perpendiculars, moulded, draught [m]
    x (s,): stations from midship, + forward, ascending, at least 4 [m]
    contours: half breadths and heights above the baseline, keel to deck [m]; a contour that does not start on the
        centreline gets a flat bottom
    source: where the lines come from
    outline: points joined "smooth" (monotone cubic) or "straight"
    labels: what the stations are called in messages; "station 1 (x = -60 m)" by default
    title: name of the hull when ``name`` is that of the file it comes from
    Returns at its design draught

    Station weights from ``station_weights``.  Source: [Gill72].
    """
    stations = np.array(x, dtype=float)
    called = labels or [f"station {i + 1} (x = {position:g} m)" for i, position in enumerate(stations)]
    _check_stations(name, stations, contours, called)
    _check_size(name, float(length), float(beam), float(draught), stations, contours)
    check_breadths(name, float(beam), float(draught), contours, called)
    stations, contours, called, bulbs = _with_necks(name, float(draught), float(beam), stations, contours, called)
    check_decks(name, float(length), float(draught), contours, called)
    closed = tuple(_closed(np.asarray(y, dtype=float), np.asarray(h, dtype=float)) for y, h in contours)
    weight = _weights(stations)
    check_coefficients(name, float(length), float(beam), float(draught), stations, weight, closed)
    return Hull(
        name=title or name,
        length=float(length),
        beam=float(beam),
        draught=float(draught),
        x=frozen(stations),
        weight=frozen(weight),
        contours=closed,
        x_aft=float(stations[0]),
        x_fore=float(stations[-1]),
        source=f"{source}; {bulbs}" if bulbs else source,
        shape="offsets",
        design_draught=float(draught),
        outline=outline,
    )


def _check_stations(name: str, x: Floats, contours: tuple[Contour, ...], labels: list[str]) -> None:
    """Refuse stations out of order and contours that cannot be a section, naming the station."""
    if len(x) != len(contours) or len(x) < 4:
        raise InputError(
            f"{name}: {len(x)} stations and {len(contours)} contours; give at least 4 of each, one contour per station"
        )
    if not np.isfinite(x).all():
        raise InputError(f"{name}: a station position is not a number; give x in metres from midship, + forward")
    if (np.diff(x) <= 0).any():
        at = int(np.argmax(np.diff(x) <= 0))
        raise InputError(
            f"{name}: {labels[at + 1]} does not lie forward of {labels[at]}; "
            "stations go from aft to fore, each once; sort them by x"
        )
    for label, (y, height) in zip(labels, contours, strict=True):
        check_contour(f"{name}: {label}", np.asarray(y, dtype=float), np.asarray(height, dtype=float))


def check_contour(where: str, y: Floats, height: Floats, units: tuple[str, str] = (" m", " m"), first: int = 1) -> None:
    """Refuse a contour that cannot be half of a section, naming the waterline.

    where: file and station named in the message
    y, height (n,): half breadths and heights, keel to deck, as given
    units: their units, for the message
    first: number of the first waterline

    >>> import numpy as np
    >>> check_contour("station 1", np.array([0.0, 5.0]), np.array([0.0, 4.0]))
    """
    if len(y) != len(height) or len(y) < 2:
        raise InputError(
            f"{where}: {len(y)} half breadths and {len(height)} heights; give two or more, as many of each"
        )
    if not (np.isfinite(y).all() and np.isfinite(height).all()):
        at = int(np.argmin(np.isfinite(y) & np.isfinite(height)))
        raise InputError(f"{where}, waterline {at + first}: not a number; every half breadth and height must be finite")
    if np.min(y) < 0:
        at = int(np.argmin(y))
        raise InputError(
            f"{where}, waterline {at + first} (height {height[at]:g}{units[1]}): half breadth {y[at]:g}{units[0]} is "
            "negative; half breadths are 0 or more, measured from the centreline to starboard; try "
            f"{abs(y[at]):g}{units[0]}"
        )
    if (np.diff(height) < 0).any():
        at = int(np.argmax(np.diff(height) < 0))
        raise InputError(
            f"{where}, waterline {at + 1 + first}: height {height[at + 1]:g}{units[1]} lies below the one before it "
            f"({height[at]:g}{units[1]}), so the offsets cross; heights go up from keel to deck (equal heights make a "
            "flat); sort or correct them"
        )
    if height[-1] <= height[0]:
        raise InputError(f"{where}: the contour has no height; give points from the keel up to the deck")


def _check_size(
    name: str, length: float, beam: float, draught: float, x: Floats, contours: tuple[Contour, ...]
) -> None:
    """Refuse a draught below the keel, and offsets not of the ship's size (wrong unit, breadths for half breadths)."""
    keel = min(float(height[0]) for _, height in contours)
    if not (np.isfinite(draught) and draught > 0 and draught > keel):
        raise InputError(
            f"{name}: draught {draught:g} m; it must be above 0 and above the keel ({keel:g} m over the baseline)"
        )
    check_extent(name, length, x)
    widest = max(float(np.interp(draught, h, y)) if h[0] < draught else 0.0 for y, h in contours)
    if not 0.9 * beam / 2 <= widest <= 1.1 * beam / 2:
        raise InputError(
            f"{name}: the largest half breadth at the waterline is {widest:g} m, half the beam is {beam / 2:g} m; "
            "the two agree within a tenth; the beam is the moulded breadth at the waterline, not at a flared deck: correct it "
            "(`beam:`, --beam), or the draught; check the unit, and that half breadths are given, not breadths"
        )


def _weights(x: Floats) -> Floats:
    """Weights of stations, each run between steps of the lines by itself."""
    steps = np.flatnonzero(np.diff(x) < STEP * (x[-1] - x[0])) + 1
    runs = np.split(x, steps)
    return np.concatenate([station_weights(run) if len(run) > 1 else np.zeros(1) for run in runs])


def _with_necks(
    name: str, draught: float, beam: float, x: Floats, contours: tuple[Contour, ...], labels: list[str]
) -> tuple[Floats, tuple[Contour, ...], list[str], str]:
    """Contours that all reach over the water, and what to say of those that did not.

    End sections wholly under water, of a bulb ahead of the stem, get a neck without breadth up to the deck of their
    neighbours: their area counts, the waterplane does not gain by them, and the strips pass them over.  Ahead of a blunt end
    the bulb reaches back to it, as a step.  Elsewhere a contour that ends below the waterline is refused.
    """
    under = [label_height[-1] < draught for _, label_height in contours]
    if not any(under):
        return x, contours, labels, ""
    count = len(contours)
    aft = next((k for k in range(count) if not under[k]), count)
    fore = next((k for k in range(count) if not under[count - 1 - k]), count)
    if aft + fore >= count or sum(under) > aft + fore:
        at = next((k for k in range(aft, count) if under[k]), 0)
        raise InputError(
            f"{name}: {labels[at]} ends at height {contours[at][1][-1]:g} m, below the draught of {draught:g} m; "
            "every contour but those of a bulb at the ends goes up to the waterline or above it; add points up to the deck, or "
            "give a smaller draught"
        )
    made = list(contours)
    ends = [*range(aft), *range(count - fore, count)]
    for k in ends:
        y, height = contours[k]
        deck = float(contours[aft if k < aft else count - fore - 1][1][-1])
        made[k] = np.append(y, [0.0, 0.0]), np.append(height, [height[-1], deck])
    names = f"{labels[ends[0]]}" + (f" to {labels[ends[-1]]}" if len(ends) > 1 else "")
    remark = (
        f"{len(ends)} end sections wholly under water ({names}) count in the volume, and are left out of the strips"
    )
    called = list(labels)
    hair = 0.5 * STEP * (x[-1] - x[0])
    for bulb, full, after in ((count - fore, count - fore - 1, count - fore), (aft - 1, aft, aft)):
        if not (0 <= bulb < count and under[bulb]) or abs(x[bulb] - x[full]) < 2 * hair:
            continue
        if waterline_breadth(*contours[full], draught) > BLUNT * beam / 2:
            x = np.insert(x, after, x[full] + np.sign(x[bulb] - x[full]) * hair)
            made.insert(after, made[bulb])
            called.insert(after, f"{labels[bulb]}, carried on to {labels[full]}")
    return x, tuple(made), called, remark


def _closed(y: Floats, height: Floats) -> Contour:
    """Contour that starts on the centreline: a flat bottom is added where the first point has breadth."""
    if y[0] > 0:
        y, height = np.concatenate([[0.0], y]), np.concatenate([[height[0]], height])
    return frozen(y), frozen(height)

"""Build a hull from the keys of a ship file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from quartering.conventions import InputError
from quartering.hull.file.schema import OffsetKeys, ShipKeys, StationKeys
from quartering.hull.formats.read import hull_from_lines, read_lines
from quartering.hull.lines.datum import datum_of, profile_of
from quartering.hull.lines.hull import Contour, Hull, at_draught, box_hull, scaled, wigley_hull, with_depth
from quartering.hull.lines.sense import check_proportions
from quartering.hull.lines.stations import check_contour, hull_from_offsets
from quartering.option_checks import checked
from quartering.options import OPTIONS
from quartering.units import Sizes


def hull_of(where: str, keys: ShipKeys, base: Hull | None) -> Hull:
    """Hull of a ship file: from its own lines, or from those of its base ship stretched to its dimensions.

    where: file named in messages
    keys: content of the file
    base: hull of the base ship
    Returns at the file's draught

    On a base: ``length`` alone scales everything; ``beam`` and ``design_draught`` stretch one direction; ``draught``
    floats the lines higher or lower.  Source: geometry.
    """
    if base is not None:
        own = [key for key in ("shape", "offsets", "lines") if getattr(keys, key) is not None]
        if own:
            raise InputError(
                f"{where}: `{own[0]}` and `base` are both given; the lines come from one of them, drop the other"
            )
        return _stretched(where, keys, base)
    for key in ("length", "beam", "draught"):
        if keys.value(key) is None:
            raise InputError(f"{where}: key `{key}` is missing; give it in metres, or start from `base: series60-cb60`")
    length = dimension(where, keys, "length")
    beam = dimension(where, keys, "beam", length)
    draught = dimension(where, keys, "draught", length, beam)
    design = draught
    if keys.value("design_draught") is not None:
        design = dimension(where, keys, "design_draught", length, beam, draught)
    name = keys.value("name") or where
    shape = keys.shape or "offsets"
    if keys.lines is not None:
        hull = _from_file(where, keys, name, length, beam, design)
    elif shape == "offsets":
        hull = _from_offsets(where, keys, name, length, beam, design)
    else:
        depth = 2 * design if keys.value("depth") is None else dimension(where, keys, "depth", length, beam, design)
        hull = (wigley_hull if shape == "wigley" else box_hull)(length, beam, design, depth, name)
    return _floated(where, keys, hull, draught)


def _stretched(where: str, keys: ShipKeys, base: Hull) -> Hull:
    """Base hull stretched to the dimensions given, others in proportion to the length."""
    length = base.length if keys.value("length") is None else dimension(where, keys, "length")
    ratio = length / base.length
    beam = base.beam * ratio if keys.value("beam") is None else dimension(where, keys, "beam", length)
    design = base.design_draught * ratio
    if keys.value("design_draught") is not None:
        design = dimension(where, keys, "design_draught", length, beam)
    hull = base
    factors = (ratio, beam / base.beam, design / base.design_draught)
    if factors != (1.0, 1.0, 1.0):
        hull = scaled(base, *factors)
    draught = hull.draught
    if keys.value("draught") is not None:
        draught = dimension(where, keys, "draught", length, beam, design)
    return _floated(where, keys, hull, draught)


def _floated(where: str, keys: ShipKeys, hull: Hull, draught: float) -> Hull:
    if keys.value("depth") is not None and hull.shape == "offsets":
        depth = dimension(where, keys, "depth", hull.length, hull.beam, hull.design_draught)
        hull = with_depth(hull, depth, called=where)
    check_proportions(where, hull.length, hull.beam, draught)
    return hull if draught == hull.draught else at_draught(hull, draught, called=where)


DIMENSIONS = ("length", "beam", "draught", "design_draught")
"""Options of a ship file that make its hull."""


def dimension(
    where: str,
    keys: ShipKeys,
    name: str,
    length: float | None = None,
    beam: float | None = None,
    draught: float | None = None,
) -> float:
    """A dimension of a file in metres; L, B and T stand for what is known of it so far."""
    return float(checked(OPTIONS[name], keys.value(name), where, Sizes(length, beam, draught)))


def _from_file(where: str, keys: ShipKeys, name: str, length: float, beam: float, draught: float) -> Hull:
    """Hull of lines in a file of another program, which lies where the ship file says, seen from its folder."""
    lines = keys.lines
    if lines is None or keys.offsets is not None or keys.shape not in (None, "offsets"):
        raise InputError(
            f"{where}: `lines` and `{'offsets' if keys.offsets else 'shape'}` are both given; drop one of them"
        )
    path = Path(where).parent / lines.file
    datum = keys.value("datum")
    if datum is not None:
        checked(OPTIONS["datum"], datum, where)
    read = read_lines(path, lines.format, draught, datum, lines.unit)
    return hull_from_lines(
        f"{where}: {path.name}", read, length=length, beam=beam, draught=draught, midship=lines.midship,
        outline=lines.outline, title=name, datum=datum,
    )  # fmt: skip


def _from_offsets(where: str, keys: ShipKeys, name: str, length: float, beam: float, draught: float) -> Hull:
    """Hull of a file's own offsets, in metres."""
    if keys.offsets is None:
        raise InputError(
            f"{where}: no lines; give `offsets:`, or `lines:` and a file, or `shape: wigley` or `box`, or start from "
            "`base: series60-cb60`"
        )
    offsets = keys.offsets
    size = (length, beam / 2, draught) if offsets.unit == "LBT" else (1.0, 1.0, 1.0)
    stations = sorted(offsets.stations, key=lambda station: station.x)
    _check_order(where, offsets, stations)
    contours = tuple(_contour(where, offsets, station, size) for station in stations)
    x = np.array([station.x * size[0] for station in stations])
    datum = datum_of(where, profile_of(x, contours), draught, keys.value("datum"))
    if datum == "waterline":
        contours = tuple((y, height + draught) for y, height in contours)
    hull = hull_from_offsets(
        where,
        length=length,
        beam=beam,
        draught=draught,
        x=x,
        contours=contours,
        source=keys.provenance.get("lines", "given offsets"),
        outline=offsets.outline,
        labels=[_label(station) for station in stations],
        title=name,
    )
    return replace(hull, datum=datum)


def _check_order(where: str, offsets: OffsetKeys, stations: list[StationKeys]) -> None:
    """Stations run one way in the file, aft to fore or fore to aft."""
    if offsets.stations not in (stations, stations[::-1]):
        x = [station.x for station in offsets.stations]
        turn = next(k for k in range(1, len(x)) if (x[k] - x[k - 1]) * (x[1] - x[0]) <= 0)
        raise InputError(
            f"{where}: offsets, {_label(offsets.stations[turn])} follows {_label(offsets.stations[turn - 1])}; "
            "stations run one way, from aft to fore or from fore to aft; sort them by x"
        )


def _label(station: StationKeys) -> str:
    name = (
        ""
        if station.station is None
        else f"{station.station:g} "
        if isinstance(station.station, float)
        else f"{station.station} "
    )
    return f"station {name}(x = {station.x:g})"


def _contour(where: str, offsets: OffsetKeys, station: StationKeys, size: tuple[float, float, float]) -> Contour:
    """Contour of one station in metres; blanks below the hull are left out."""
    heights = station.heights or offsets.waterlines
    if heights is None:
        raise InputError(
            f"{where}: {_label(station)} has no heights; give `heights:` there or `waterlines:` for all stations"
        )
    breadths = station.half_breadths
    if len(heights) != len(breadths):
        raise InputError(
            f"{where}: {_label(station)}: {len(breadths)} half breadths for {len(heights)} heights; give one for each "
            "(`~` where there is no hull below the first)"
        )
    blanks = next((i for i, value in enumerate(breadths) if value is not None), len(breadths))
    if None in breadths[blanks:] or blanks > len(breadths) - 2:
        raise InputError(
            f"{where}: {_label(station)}: a half breadth is blank; `~` may only stand below the first point of the hull"
        )
    y = np.array([value for value in breadths[blanks:] if value is not None])
    height = np.array(heights[blanks:], dtype=float)
    units = (" B/2", " T") if offsets.unit == "LBT" else (" m", " m")
    check_contour(f"{where}: {_label(station)}", y, height, units, first=blanks + 1)
    return y * size[1], height * size[2]

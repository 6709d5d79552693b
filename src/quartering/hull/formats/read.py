"""Read the lines of another program's file as a hull at its draught."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from quartering.conventions import InputError
from quartering.hull.formats.offset_tables import Lines, read_offset_table, read_pdstrip_sections
from quartering.hull.lines.contour import Outline
from quartering.hull.lines.datum import datum_of
from quartering.hull.lines.hull import Hull, with_depth
from quartering.hull.lines.section import Floats
from quartering.hull.lines.stations import hull_from_offsets
from quartering.option_checks import quoted
from quartering.units import LENGTHS

FREEBOARD = 1.5
"""Depth over draught when a file ends at the waterline and none is given (assumed)."""

FORMATS = {
    "csv": "offset table, or x, y, z",
    "pdstrip": "PDSTRIP section file",
    "gdf": "WAMIT panel file",
    "stl": "STL surface",
}
"""Format -> what it is; the ending of the file tells it, or its first words."""
_ENDINGS = {"csv": "csv", "txt": "csv", "tsv": "csv", "dat": "csv", "gdf": "gdf", "stl": "stl"}


def read_lines(
    path: str | Path,
    form: str | None = None,
    draught: float | None = None,
    datum: str | None = None,
    unit: str | None = None,
) -> Lines:
    """Read lines from a file of any known format.

    path: .csv, .gdf, .stl, or a PDSTRIP section file
    form: "csv", "pdstrip", "gdf" or "stl", where the ending does not tell
    draught: of the lines; tells where the heights of a surface are counted from [m]
    datum: "keel" or "waterline", where the heights are counted from; None: decided from the lines
    unit: of the numbers in the file, "mm"; None: what the file says, else metres
    """
    if unit is not None and unit not in LENGTHS:
        raise InputError(f"{path}: unit = {quoted(unit)}; allowed: {', '.join(LENGTHS)}; leave it out for metres")
    if not Path(path).is_file():
        raise InputError(f"{path} is not there; give the path of a file, seen from the ship file")
    kind = form or _format_of(Path(path))
    if kind == "csv":
        return _in_metres(path, read_offset_table(path), unit)
    if kind == "pdstrip":
        return _in_metres(path, read_pdstrip_sections(path), unit)
    from quartering.hull.formats.meshes import read_gdf, read_stl  # only for those who bring a mesh

    if kind == "gdf":
        return read_gdf(path, draught, datum, unit)
    if kind == "stl":
        return read_stl(path, draught, datum, unit)
    raise _unknown(path, kind)


def _in_metres(path: str | Path, lines: Lines, unit: str | None) -> Lines:
    """Lines whose numbers were read as they stand, in metres."""
    if unit is None:
        return lines
    if lines.own_unit:
        raise InputError(f"{path}: its header names the unit of its columns; leave `unit: {unit}` out")
    factor = LENGTHS[unit]
    return lines._replace(
        x=lines.x * factor,
        contours=tuple((y * factor, z * factor) for y, z in lines.contours),
        still_water=None if lines.still_water is None else lines.still_water * factor,
        remarks=(*lines.remarks, f"given in {unit}"),
    )


def _format_of(path: Path) -> str:
    """Format of a file by its ending, else by its first words; one that fits none is unknown."""
    ending = path.suffix.lower().removeprefix(".")
    if ending in ("csv", "tsv", "gdf", "stl"):
        return _ENDINGS[ending]
    with path.open("rb") as opened:
        head = opened.read(4000)
    if head[:5].lower() == b"solid" and b"vertex" in head:
        return "stl"
    words = head.replace(b",", b" ").split()[:3]
    if len(words) > 1 and words[0].isdigit() and words[1].strip(b".").lower()[:1] in (b"t", b"f"):
        return "pdstrip"
    if ending in _ENDINGS:
        return _ENDINGS[ending]
    if words and words[0].isdigit() and b"\x00" not in head:
        return "pdstrip"
    raise _unknown(path, path.suffix or path.name)


def _unknown(path: str | Path, kind: str) -> InputError:
    return InputError(
        f'{path}: the format "{kind}" is unknown; known are {", ".join(f"{one} ({FORMATS[one]})" for one in FORMATS)}; write '
        "`lines: {file: .., format: ..}` where the ending does not tell, or export the lines as one of these"
    )


def hull_from_lines(
    where: str,
    lines: Lines,
    *,
    length: float,
    beam: float,
    draught: float,
    midship: float = 0.0,
    outline: Outline = "straight",
    title: str | None = None,
    datum: str | None = None,
) -> Hull:
    """Hull of lines read from a file.

    where: file named in messages
    length, beam, draught: between perpendiculars, moulded, draught of the lines [m]
    midship: x of midship in the file [m]
    outline: points joined "straight" or "smooth"
    title: name of the hull
    datum: "keel" or "waterline"; None: what the format says, else decided from the lines
    Returns heights counted from the calm plane are moved to the baseline; sides that end at the waterline are carried
        straight up to 1.5 T (assumed)

    Source: geometry; the freeboard is assumed, and said in the hull's source.
    """
    x = lines.x - midship
    middle = (x[0] + x[-1]) / 2
    if abs(middle) > 0.2 * length:
        raise InputError(
            f"{where}: the stations lie from x = {lines.x[0]:g} to {lines.x[-1]:g} m, their middle {middle:g} m from midship; "
            f"x is counted from midship, + forward; give `midship: {(lines.x[0] + lines.x[-1]) / 2:g}` if the file counts "
            "from another point"
        )
    found = lines.datum or datum_of(where, lines.profile, draught, datum, still_water=lines.still_water)
    lift, counted = (draught, "the calm water") if found == "waterline" else (0.0, "the baseline")
    contours = tuple((y, _at_water(height + lift, draught)) for y, height in lines.contours)
    source = "; ".join([f"given: {lines.source}", f"heights from {counted}", *lines.remarks])
    hull = hull_from_offsets(
        where, length=length, beam=beam, draught=draught, x=x, contours=contours, source=source,
        outline=outline, labels=list(lines.labels), title=title,
    )  # fmt: skip
    hull = replace(hull, datum=found)
    if hull.depth > draught * 1.001:
        return hull
    raised = with_depth(hull, FREEBOARD * draught)
    return replace(raised, source=f"{hull.source}; sides above the waterline assumed straight up to {FREEBOARD:g} T")


def _at_water(height: Floats, draught: float) -> Floats:
    """Heights with a top that misses the draught by rounding put there."""
    missed = draught - height[-1]
    return np.append(height[:-1], draught) if 0 < missed < 1e-4 * draught else height

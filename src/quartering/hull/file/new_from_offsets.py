"""Commented ship file for a user's own offsets, with everything read from them."""

from __future__ import annotations

import json
import math
from pathlib import Path

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.hull.formats.offset_tables import Lines
from quartering.hull.formats.read import read_lines
from quartering.hull.lines.sense import waterline_breadth
from quartering.hull.ship import Ship
from quartering.option_checks import checked
from quartering.options import OPTIONS
from quartering.units import LENGTHS, NO_SHIP


def write_offsets_ship(
    lines: str | Path,
    path: str | Path,
    *,
    draught: float | str | None = None,
    length: float | str | None = None,
    beam: float | str | None = None,
    unit: str | None = None,
) -> Ship:
    """Write the ship file of an offset, section or mesh file, with what was found in it.

    Parameters
    ----------
    lines : str or Path         of any format `read_lines` knows
    path : str or Path          ship file to write; one that exists is not overwritten
    draught : float or str      of the lines; needed where heights count from the baseline [m]
    length, beam : float or str moulded; by default the extent of the stations and the breadth at the waterline [m]
    unit : str                  of the numbers in the file, "mm"; None: what the file says, else metres

    Returns
    -------
    Ship    as it reads back

    Raises
    ------
    InputError    what the readers refuse, a draught that is missing, a ship file that exists or cannot be written

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = (Path(folder) / "a.csv").write_text("x,0,5\\n0,6,6\\n80,6,6")
    ...     made = write_offsets_ship(f"{folder}/a.csv", f"{folder}/a.yaml", draught=3)
    >>> made.hull.length, made.hull.beam
    (80.0, 12.0)
    """
    target, source = Path(path), Path(lines)
    if target.exists():
        raise InputError(f"{target} exists; it is not overwritten; give another name, or remove it first")
    given = {"draught": draught, "length": length, "beam": beam}
    sizes = {
        name: float(checked(OPTIONS[name], value, "new", NO_SHIP)) for name, value in given.items() if value is not None
    }
    read = read_lines(source, None, sizes.get("draught"), unit=unit)
    text = _text(source, target, read, sizes, unit)
    try:
        target.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{target} cannot be written: {error.strerror}; give a file in a folder that exists") from None
    try:
        return ship(target)
    except InputError:
        target.unlink()  # nothing is left of what cannot be read
        raise


def checked_extent(where: str | Path, lines: Lines) -> float:
    """Length of lines [m]; larger than any ship, their numbers are in another unit."""
    length = float(lines.x[-1]) - float(lines.x[0])
    for words, value, most in (
        ("stations reach over", length, OPTIONS["length"].high),
        ("largest breadth is", _largest_breadth(lines), OPTIONS["beam"].high),
    ):
        if value > float(most or math.inf):
            units = ", ".join(unit for unit in LENGTHS if unit != "m")
            raise InputError(
                f"{where}: its {words} {value:.10g} m, and a ship has at most {most:g} m; say the unit of its numbers ({units})"
            )
    return length


def beam_afloat(lines: Lines, draught: float) -> float:
    """Breadth of lines at the waterline [m]; the largest of all where none of them reaches the water."""
    level = 0.0 if lines.afloat else draught
    return 2 * max(waterline_breadth(y, height, level) for y, height in lines.contours) or _largest_breadth(lines)


def _largest_breadth(lines: Lines) -> float:
    """Of all heights, of flared sides that at the deck [m]."""
    return 2 * max(float(y.max()) for y, _ in lines.contours)


def _text(source: Path, target: Path, read: Lines, sizes: dict[str, float], unit: str | None) -> str:
    """The ship file, each line with what it rests on."""
    longest = checked_extent(source, read)
    afloat, (keel, top) = read.afloat, read.profile.middle
    draught = sizes.get("draught", -keel if afloat else None)
    if draught is None:
        raise InputError(
            f"{source}: its heights count from the baseline (keel amidships {keel:.4g} m, deck {top:.4g} m); give --draught too"
        )
    first, last = float(read.x[0]), float(read.x[-1])
    length, beam = sizes.get("length", longest), sizes.get("beam", beam_afloat(read, draught))
    try:
        beside = source.resolve().relative_to(target.resolve().parent).as_posix()
    except ValueError:
        beside = str(source.resolve())
    datum = "waterline" if afloat else "keel"
    remarks = "".join(f"; {one}" for one in read.remarks)
    rows = [
        (f"name: {json.dumps(source.stem)}", ""),
        (
            f"length: {length:.10g} m",
            "" if "length" in sizes else "extent of the stations; give that between perpendiculars",
        ),
        (
            f"beam: {beam:.10g} m",
            "" if "beam" in sizes else "breadth of the lines at the waterline; give the moulded one there",
        ),
        (f"draught: {draught:.10g} m", "" if "draught" in sizes else "of the lines under the calm water amidships"),
        (f"datum: {datum}", f"heights count from there: keel amidships at {keel:.4g} m, top at {top:.4g} m"),
        ("lines:", f"{len(read.x)} stations, {read.source}{remarks}"),
        (f"  file: {json.dumps(beside)}", ""),
        *([] if unit is None else [(f"  unit: {unit}", "of the numbers in the file")]),
        (
            f"  midship: {(first + last) / 2:.10g}",
            f"x of midship in the file [m], stations from {first:.5g} to {last:.5g} m",
        ),
        ("loading:", ""),
        ("  gm: 0.05 B", "assumed; give gm or kg"),
    ]
    head = (
        "# Ship file of quartering for lines of one's own. What was found in them stands behind each value: check it.\n"
    )
    return head + "".join(f"{left:<28} # {note}\n" if note else f"{left}\n" for left, note in rows)

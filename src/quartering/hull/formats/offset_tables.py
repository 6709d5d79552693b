"""Lines in files of other programs: offset tables in CSV, and PDSTRIP section files."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.datum import Datum, Profile, profile_of
from quartering.hull.lines.hull import Contour
from quartering.hull.lines.section import Floats
from quartering.hull.lines.stations import check_contour
from quartering.table_text import Columns, columns_of, read_any_text, read_table

STEP = 1e-6
"""Half distance of two stations at one place, of the extent of the lines."""
MOST = 100_000
"""Most sections of a file, and points of a section."""
PRISM_STATIONS = 11
"""Stations laid through a hull that is the same all along and given by two or three."""


class Lines(NamedTuple):
    """Stations read from a file.

    Parameters
    ----------
    x : (s,) float                   as in the file, ascending [m]
    contours : tuple of (y, height)  starboard half, keel to deck; heights as in the file [m]
    labels : tuple of str            what the stations are called in messages
    source : str                     what was read
    datum : str or None              where the heights are counted from, where the format or the surface tells
    still_water : float or None      height of the calm plane, where the file says it [m]
    remarks : tuple of str           what was done to the lines
    own_unit : bool                  did the file name a unit?
    """

    x: Floats
    contours: tuple[Contour, ...]
    labels: tuple[str, ...]
    source: str
    datum: Datum | None = None
    still_water: float | None = None
    remarks: tuple[str, ...] = ()
    own_unit: bool = False

    @property
    def profile(self) -> Profile:
        """Lowest and highest points."""
        return profile_of(self.x, self.contours)

    @property
    def afloat(self) -> bool:
        """Do the heights count from the calm plane, as far as lines without a draught tell it?"""
        if self.datum is not None:
            return self.datum == "waterline"
        keel, top = self.profile.middle
        return keel < -0.25 * (top - keel)


def read_offset_table(path: str | Path) -> Lines:
    """Read offsets from CSV: a table of stations by waterlines, or a list of x, y, z.

    Parameters
    ----------
    path : str or Path    header ``x, 0, 0.5, 1.0`` (waterline heights; a first column ``station`` is allowed), one station a
                          row, half breadths, blank where there is no hull; or header ``x, y, z``, points of each station
                          from keel to deck, or of both its sides from deck to deck; comma, semicolon, tab or blanks;
                          ``#`` starts a comment; metres, or the unit in the header, "x [mm]", or in a row below it.
                          Two stations at one x are a step

    Returns
    -------
    Lines

    Raises
    ------
    InputError    a cell that is not a number, a half breadth that cannot be right: named by station and waterline

    Notes
    -----
    Source: geometry.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "barge.csv"
    ...     _ = file.write_text("x,0,4" + "".join(f"\\n{x},5,5" for x in (-30, -10, 10, 30)))
    ...     read_offset_table(file).contours[0][0].tolist()
    [5.0, 5.0]
    """
    rows = read_table(path).rows
    if len(rows) < 2:
        raise InputError(f"{path}: no offsets in it; write a header and one row for each station")
    columns = columns_of(rows)
    header, body = columns.names, rows[columns.rows :]
    if header[:3] == ["x", "y", "z"] and len(header) == 3:
        return _in_order(path, *_from_points(path, body, columns), f"offsets x, y, z of {Path(path).name}", columns)
    first = 1 if header[0] == "station" else 0
    if len(header) < first + 3 or header[first] != "x":
        raise InputError(
            f"{path}: the header is {', '.join(rows[0])!r}; write `x, y, z`, or `x` and the heights of two or more "
            "waterlines in metres"
        )
    found = _from_table(path, body, columns, first)
    return _in_order(path, *found, f"offset table {Path(path).name}", columns)


def _number(where: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise InputError(f"{where}: {cell!r} is not a number; give metres")
    return value


def _from_table(
    path: str | Path, rows: list[list[str]], columns: Columns, first: int
) -> tuple[list[float], list[Contour], list[str]]:
    """Stations of a table, one a row."""
    unit = [columns.factor(k, "length", str(path)) for k in range(first, len(columns.names))]
    heights = np.array([
        _number(f"{path}: header, waterline {k + 1}", cell) * (unit[k + 1] if columns.units[first + 1 + k] else unit[0])
        for k, cell in enumerate(columns.names[first + 1 :])
    ])  # fmt: skip
    x, contours, labels = [], [], []
    for row in rows:
        cells = row + [""] * (first + 1 + heights.size - len(row))
        x.append(_number(f"{path}: station {row[0]}, x", cells[first]) * unit[0])
        name = f"station {row[0]} (x = {x[-1]:g} m)" if first else f"station {len(x)} (x = {x[-1]:g} m)"
        if any(cells[first + 1 + heights.size :]):
            raise InputError(
                f"{path}: {name}: {len(cells) - first - 1} half breadths for {heights.size} waterlines; decimal commas need "
                "a semicolon or a tab between the columns"
            )
        given = [k for k, cell in enumerate(cells[first + 1 :]) if cell]
        if len(given) < 2 or given != list(range(given[0], given[-1] + 1)):
            raise InputError(
                f"{path}: {name}: blanks may stand below the lowest and above the highest point of the hull, and two points "
                "are needed"
            )
        y = np.array([_number(f"{path}: {name}, waterline {k + 1}", cells[first + 1 + k]) for k in given])
        y *= np.array([unit[k + 1] if columns.units[first + 1 + k] else unit[0] for k in given])
        check_contour(f"{path}: {name}", y, heights[given], first=given[0] + 1)
        contours.append((y, heights[given]))
        labels.append(name)
    return x, contours, labels


def _from_points(
    path: str | Path, rows: list[list[str]], columns: Columns
) -> tuple[list[float], list[Contour], list[str]]:
    """Stations of a list of points: neighbouring rows of one x, keel to deck; two stations of one x follow each other."""
    points = np.array([
        [_number(f"{path}: point {k + 1}, {axis}", cell) for axis, cell in zip("xyz", [*row, "", "", ""][:3], strict=False)]
        for k, row in enumerate(rows)
    ]).reshape(-1, 3)  # fmt: skip
    points = points * [columns.factor(k, "length", str(path)) for k in range(3)]
    breaks = np.flatnonzero(np.diff(points[:, 0]) != 0) + 1
    whole = _is_whole(points[:, 1])
    x: list[float] = []
    contours, labels = [], []
    for group in np.split(points, breaks):
        if group[0, 0] in x:
            raise InputError(
                f"{path}: points at x = {group[0, 0]:g} m stand in two places; keep the points of a station together"
            )
        if whole:
            where = f"{path}: station {len(x) + 1} (x = {group[0, 0]:g} m)"
            y, z = _half(where, group[:, 1], group[:, 2])
            group = np.column_stack([np.full(len(y), group[0, 0]), y, z])
        for one in _stations_at_one_place(group):
            x.append(float(one[0, 0]))
            labels.append(f"station {len(x)} (x = {x[-1]:g} m)")
            check_contour(f"{path}: {labels[-1]}", one[:, 1], one[:, 2])
            contours.append((one[:, 1], one[:, 2]))
    return x, contours, labels


def _is_whole(y: Floats) -> bool:
    """Are both sides of the hull given: every breadth to starboard to port as well?"""
    port, starboard = np.sort(-y[y < 0]), np.sort(y[y > 0])
    return bool(port.size and port.size == starboard.size and np.allclose(port, starboard, atol=1e-3 * np.ptp(y)))


def _half(where: str, y: Floats, z: Floats) -> Contour:
    """Starboard half, keel to deck, of a section from deck to deck that is the same on both sides."""
    if not (np.allclose(y, -y[::-1], atol=1e-3 * np.ptp(y)) and np.allclose(z, z[::-1], atol=1e-3 * np.ptp(z))):
        raise InputError(
            f"{where}: port and starboard differ; only symmetric hulls are treated here, their sections from deck to deck"
        )
    return np.abs(y[y.size // 2 :]), z[y.size // 2 :]


def _stations_at_one_place(group: Floats) -> list[Floats]:
    """Points of one x, parted where a second contour begins at the keel again: a step in the lines."""
    z = group[:, 2]
    falls = np.flatnonzero(np.diff(z) < -0.5 * np.ptp(z)) + 1
    parts = np.split(group, falls)
    return (
        parts if len(falls) and all(len(part) > 1 and (np.diff(part[:, 2]) >= 0).all() for part in parts) else [group]
    )


def _in_order(
    path: str | Path,
    x: list[float],
    contours: list[Contour],
    labels: list[str],
    source: str,
    columns: Columns | None = None,
    still_water: float | None = None,
) -> Lines:
    """Lines with x ascending; a file may run from fore to aft, and have two stations where the lines have a step."""
    steps = np.diff(x)
    way = np.sign(x[-1] - x[0]) if len(x) > 1 else 0.0
    if len(x) < 2 or way == 0 or not (steps * way >= 0).all():
        at = 0 if len(x) < 2 else int(np.argmax(steps * way <= 0)) + 1
        raise InputError(
            f"{path}: {labels[at] if labels else 'no station'}: stations run one way, from aft to fore or from fore to aft, "
            "and there are at least 4 of them, or 2 of a hull that is the same all along"
        )
    order = slice(None) if way > 0 else slice(None, None, -1)
    found, names = list(contours[order]), list(labels[order])
    at_x, steps_at = _stepped(path, np.array(x[order]), names)
    remarks = [f"two stations at x = {', '.join(f'{one:g}' for one in steps_at)} m (a step)"] if steps_at else []
    if len(at_x) < 4:
        at_x, found, names = _prism(path, at_x, found, names)
        remarks.append("the same all along")
    named = {unit for unit in columns.units if unit} if columns else set()
    remarks += [f"given in {', '.join(sorted(named - {'m'}))}"] if named - {"m"} else []
    return Lines(at_x, tuple(found), tuple(names), source, None, still_water, tuple(remarks), bool(named))


def _stepped(path: str | Path, x: Floats, labels: list[str]) -> tuple[Floats, list[float]]:
    """Stations with two at one place set a hair apart, and the places."""
    same = np.flatnonzero(np.diff(x) == 0)
    if (np.diff(same) == 1).any():
        raise InputError(f"{path}: {labels[same[0]]}: more than two stations at x = {x[same[0]]:g} m; a step has two")
    apart, hair = x.copy(), STEP * float(x[-1] - x[0])
    apart[same] -= hair
    apart[same + 1] += hair
    return apart, [float(one) for one in x[same]]


def _prism(
    path: str | Path, x: Floats, contours: list[Contour], labels: list[str]
) -> tuple[Floats, list[Contour], list[str]]:
    """More stations of a hull given by two or three that are all the same."""
    y, z = contours[0]
    if not all(one.shape == y.shape and np.allclose(one, y) and np.allclose(h, z) for one, h in contours):
        raise InputError(
            f"{path}: {len(x)} stations that differ; at least 4 stations are needed, or 2 of a hull that is the same all along"
        )
    more = np.linspace(x[0], x[-1], PRISM_STATIONS)
    return more, [contours[0]] * len(more), [f"{labels[0]}, the same at x = {one:g} m" for one in more]


def read_pdstrip_sections(path: str | Path) -> Lines:
    """Read the section file of PDSTRIP.

    Parameters
    ----------
    path : str or Path    number of sections, symmetric (t or f), draught; then for each section x, number of points and of
                          gaps (and the gaps), the y, and the z up from the baseline or from the calm plane, keel to deck

    Returns
    -------
    Lines    the starboard half; sections given whole are halved when port and starboard agree

    Raises
    ------
    InputError    a file cut short, a section that is not symmetric or cannot be right: named by section and point

    Notes
    -----
    The y of a symmetric section may have either sign. Gaps only say where its panels are left out; they are passed over.
    Source: [Bertram06].

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "geomet.out"
    ...     _ = file.write_text("4 t 4.0" + "".join(f"\\n{x} 3 0\\n0 5 5\\n0 0 6" for x in (-30, -10, 10, 30)))
    ...     read_pdstrip_sections(file).x.tolist()
    [-30.0, -10.0, 10.0, 30.0]
    """
    words = read_any_text(path).replace(",", " ").split()
    position = 0

    def take(what: str) -> str:
        nonlocal position
        if position >= len(words):
            raise InputError(f"{path}: {what} is missing; the file is cut short")
        position += 1
        return words[position - 1]

    def whole(what: str) -> int:
        value = _number(f"{path}: {what}", take(what))
        if value != round(value) or not 0 <= value <= MOST:
            raise InputError(f"{path}: {what} = {value:g}; it is a whole number from 0 to {MOST}")
        return int(value)

    count, symmetric = whole("number of sections"), take("symmetry")
    if symmetric.strip(".").lower()[:1] not in ("t", "f"):
        raise InputError(
            f"{path}: {symmetric!r} stands where t (symmetric) or f is expected; is it a PDSTRIP section file?"
        )
    if count < 2:
        raise InputError(f"{path}: {count} sections; a hull has at least 4, or 2 where it is the same all along")
    still_water = _number(f"{path}: draught", take("draught"))
    x, contours, labels = [], [], []
    for k in range(count):
        name = f"section {k + 1}"
        x.append(_number(f"{path}: {name}, x", take(f"{name}, x")))
        points, gaps = whole(f"{name}, points"), whole(f"{name}, gaps")
        for _ in range(gaps):
            take(f"{name}, gap")
        y, z = (
            np.array(
                [_number(f"{path}: {name}, {axis} {i + 1}", take(f"{name}, {axis} {i + 1}")) for i in range(points)]
            )
            for axis in "yz"
        )
        labels.append(f"station {k + 1} (x = {x[-1]:g} m)")
        contours.append(_starboard(f"{path}: {labels[-1]}", y, z))
    return _in_order(path, x, contours, labels, f"PDSTRIP sections of {Path(path).name}", still_water=still_water)


def _starboard(where: str, y: Floats, z: Floats) -> Contour:
    """Starboard half of a section, keel to deck; one that is given whole must be the same on both sides."""
    if y.size and y.min() < 0 < y.max():
        y, z = _half(where, y, z)
    y = np.abs(y)
    if z.size > 2 and y.min() > 0.05 * y.max() and z.argmin() not in (0, z.size - 1) and z[0] > z.min() < z[-1]:
        raise InputError(
            f"{where}: the section lies apart from the centreplane, y from {y.min():g} to {y.max():g} m: half of a catamaran; "
            "only hulls in one piece about the centreplane are treated here; give one hull with y from its own middle"
        )
    if z.size > 1 and z[0] > z[-1]:
        y, z = y[::-1], z[::-1]
    check_contour(where, y, z)
    return y, z

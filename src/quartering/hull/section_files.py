"""Lines in files of other programs: offset tables in CSV, and PDSTRIP section files."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import NamedTuple

import numpy as np

from quartering.conventions import InputError
from quartering.hull.offsets import Contour
from quartering.hull.section import Floats
from quartering.hull.stations import check_contour


class Lines(NamedTuple):
    """Stations read from a file.

    Parameters
    ----------
    x : (s,) float                   as in the file, ascending [m]
    contours : tuple of (y, height)  starboard half, keel to deck; heights as in the file [m]
    labels : tuple of str            what the stations are called in messages
    source : str                     what was read
    afloat : bool                    heights are counted from the calm plane, not from the baseline
    """

    x: Floats
    contours: tuple[Contour, ...]
    labels: tuple[str, ...]
    source: str
    afloat: bool = False


def read_offset_table(path: str | Path) -> Lines:
    """Read offsets from CSV: a table of stations by waterlines, or a list of x, y, z.

    Parameters
    ----------
    path : str or Path    header ``x, 0, 0.5, 1.0`` (waterline heights; a first column ``station`` is allowed), one station a
                          row, half breadths, blank where there is no hull; or header ``x, y, z``, points of each station
                          from keel to deck; comma, semicolon or tab; ``#`` starts a comment; metres

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
    rows = _cells(Path(path))
    header = [cell.strip().lower() for cell in rows[0]]
    if header[:3] == ["x", "y", "z"] and len(header) == 3:
        return _ascending(path, *_from_points(path, rows[1:]), f"offsets x, y, z of {Path(path).name}")
    first = 1 if header[0] == "station" else 0
    if len(header) < first + 3 or header[first] != "x":
        raise InputError(
            f"{path}: the header is {', '.join(rows[0])!r}; write `x, y, z`, or `x` and the heights of two or more "
            "waterlines in metres"
        )
    heights = np.array(
        [_number(f"{path}: header, waterline {k + 1}", cell) for k, cell in enumerate(header[first + 1 :])]
    )
    return _ascending(path, *_from_table(path, rows[1:], heights, first), f"offset table {Path(path).name}")


def _cells(path: Path) -> list[list[str]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read as text ({type(error).__name__}); give a CSV file in UTF-8") from None
    lines = [line.split("#")[0].rstrip() for line in text.splitlines()]
    lines = [line for line in lines if line.strip(" ,;\t")]
    if len(lines) < 2:
        raise InputError(f"{path}: no offsets in it; write a header and one row for each station")
    delimiter = next((mark for mark in ";\t" if mark in lines[0]), ",")
    return [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=delimiter)]


def _number(where: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise InputError(f"{where}: {cell!r} is not a number; give metres")
    return value


def _from_table(
    path: str | Path, rows: list[list[str]], heights: Floats, first: int
) -> tuple[list[float], list[Contour], list[str]]:
    """Stations of a table, one a row."""
    x, contours, labels = [], [], []
    for row in rows:
        cells = row + [""] * (first + 1 + heights.size - len(row))
        x.append(_number(f"{path}: station {row[0]}, x", cells[first]))
        name = f"station {row[0]} (x = {x[-1]:g} m)" if first else f"station {len(x)} (x = {x[-1]:g} m)"
        if len(cells) > first + 1 + heights.size:
            raise InputError(f"{path}: {name}: {len(cells) - first - 1} half breadths for {heights.size} waterlines")
        given = [k for k, cell in enumerate(cells[first + 1 :]) if cell]
        if len(given) < 2 or given != list(range(given[0], given[-1] + 1)):
            raise InputError(
                f"{path}: {name}: blanks may stand below the lowest and above the highest point of the hull, and two points "
                "are needed"
            )
        y = np.array([_number(f"{path}: {name}, waterline {k + 1}", cells[first + 1 + k]) for k in given])
        check_contour(f"{path}: {name}", y, heights[given], first=given[0] + 1)
        contours.append((y, heights[given]))
        labels.append(name)
    return x, contours, labels


def _from_points(path: str | Path, rows: list[list[str]]) -> tuple[list[float], list[Contour], list[str]]:
    """Stations of a list of points: neighbouring rows of one x, keel to deck."""
    points = np.array([
        [_number(f"{path}: point {k + 1}, {axis}", cell) for axis, cell in zip("xyz", [*row, "", "", ""][:3], strict=False)]
        for k, row in enumerate(rows)
    ])  # fmt: skip
    breaks = np.flatnonzero(np.diff(points[:, 0]) != 0) + 1
    x, contours, labels = [], [], []
    for group in np.split(points, breaks):
        if group[0, 0] in x:
            raise InputError(
                f"{path}: points at x = {group[0, 0]:g} m stand in two places; keep the points of a station together"
            )
        x.append(float(group[0, 0]))
        labels.append(f"station {len(x)} (x = {x[-1]:g} m)")
        check_contour(f"{path}: {labels[-1]}", group[:, 1], group[:, 2])
        contours.append((group[:, 1], group[:, 2]))
    return x, contours, labels


def _ascending(path: str | Path, x: list[float], contours: list[Contour], labels: list[str], source: str) -> Lines:
    """Lines with x ascending; a file may run from fore to aft."""
    steps = np.diff(x)
    if len(x) < 4 or not ((steps > 0).all() or (steps < 0).all()):
        at = 0 if len(x) < 4 else int(np.argmax(steps * steps[0] <= 0)) + 1
        raise InputError(
            f"{path}: {labels[at]}: at least 4 stations are needed, running one way, from aft to fore or from fore to aft, "
            "each once"
        )
    order = slice(None) if steps[0] > 0 else slice(None, None, -1)
    return Lines(
        np.array(x[order]), tuple(contours[order]), tuple(labels[order]), source, min(h[0] for _, h in contours) < 0
    )


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
    try:
        words = Path(path).read_text(encoding="utf-8", errors="replace").replace(",", " ").split()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}; give a file you may read") from None
    position = 0

    def take(what: str) -> str:
        nonlocal position
        if position >= len(words):
            raise InputError(f"{path}: {what} is missing; the file is cut short")
        position += 1
        return words[position - 1]

    count, symmetric = int(_number(f"{path}: number of sections", take("number of sections"))), take("symmetry")
    if symmetric.strip(".").lower()[:1] not in ("t", "f"):
        raise InputError(
            f"{path}: {symmetric!r} stands where t (symmetric) or f is expected; is it a PDSTRIP section file?"
        )
    take("draught")
    x, contours, labels = [], [], []
    for k in range(count):
        name = f"section {k + 1}"
        x.append(_number(f"{path}: {name}, x", take(f"{name}, x")))
        points, gaps = (int(_number(f"{path}: {name}, {what}", take(f"{name}, {what}"))) for what in ("points", "gaps"))
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
    return _ascending(path, x, contours, labels, f"PDSTRIP sections of {Path(path).name}")


def _starboard(where: str, y: Floats, z: Floats) -> Contour:
    """Starboard half of a section, keel to deck; one that is given whole must be the same on both sides."""
    if y.size and y.min() < 0 < y.max():
        if not (np.allclose(y, -y[::-1], atol=1e-3 * np.ptp(y)) and np.allclose(z, z[::-1], atol=1e-3 * np.ptp(z))):
            raise InputError(f"{where}: port and starboard differ; only symmetric hulls are treated here")
        keel = (y.size - 1) // 2 if y.size % 2 else y.size // 2
        y, z = np.abs(y[keel:]), z[keel:]
    y = np.abs(y)
    if z.size > 1 and z[0] > z[-1]:
        y, z = y[::-1], z[::-1]
    check_contour(where, y, z)
    return y, z

"""Tables in text files as spreadsheets and instruments write them: encoding, delimiter, decimal comma, units."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from quartering.conventions import InputError

UNITS: Final[dict[str, tuple[str, float]]] = {
    "m": ("length", 1.0), "metre": ("length", 1.0), "metres": ("length", 1.0), "meter": ("length", 1.0),
    "meters": ("length", 1.0), "mm": ("length", 1e-3), "cm": ("length", 1e-2), "dm": ("length", 0.1),
    "km": ("length", 1e3), "ft": ("length", 0.3048), "feet": ("length", 0.3048), "in": ("length", 0.0254),
    "inch": ("length", 0.0254), "s": ("time", 1.0), "sec": ("time", 1.0), "second": ("time", 1.0),
    "seconds": ("time", 1.0), "ms": ("time", 1e-3), "msec": ("time", 1e-3), "min": ("time", 60.0),
    "deg": ("angle", 1.0), "degree": ("angle", 1.0), "degrees": ("angle", 1.0), "°": ("angle", 1.0),
    "rad": ("angle", 180.0 / np.pi), "mrad": ("angle", 0.18 / np.pi), "-": ("", 1.0), "": ("", 1.0),
}  # fmt: skip
"""Unit of a column -> what it measures and its factor to m, s or deg."""

_BRACKETS: Final = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]*?)\s*[\])]\s*$")
_COMMA: Final = re.compile(r"^[-+]?\d*,\d+(?:[eE][-+]?\d+)?$")


class Table(NamedTuple):
    """Rows of cells of a text file.

    Parameters
    ----------
    rows : list of list of str    the header first where there is one; decimal commas are points
    lines : list of int           line of each row in the file
    comments : list of str        what stood behind ``#``
    """

    rows: list[list[str]]
    lines: list[int]
    comments: list[str]


def read_any_text(path: str | Path) -> str:
    """Text of a file in UTF-8, UTF-16 or the 8-bit code of western Windows.

    Returns without the mark of the byte order

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "my.csv"
    ...     _ = file.write_bytes("x;y".encode("utf-16"))
    ...     read_any_text(file)
    'x;y'
    """
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}; give a file you may read") from None
    wide = data[:2] in (b"\xff\xfe", b"\xfe\xff")
    even, odd = data[0:400:2].count(0), data[1:400:2].count(0)
    if not wide and max(even, odd) > 0.4 * len(data[:400]) / 2 > min(even, odd) * 10:  # UTF-16 without its mark
        codes = ["utf-16-le" if odd > even else "utf-16-be"]
    else:
        codes = ["utf-16"] if wide else ["utf-8-sig", "cp1252"]
    for code in codes:
        try:
            text = data.decode(code)
        except UnicodeDecodeError:
            continue
        if "\x00" not in text:
            return text.removeprefix("\ufeff")
    raise InputError(f"{path}: cannot be read as text; give a text file in UTF-8 or UTF-16")


def read_table(path: str | Path) -> Table:
    """Rows of a table, whichever way its columns are parted.

    path: columns parted by tab, semicolon, comma or blanks; decimals with a point, or, where the comma does not part
        columns, with a comma; ``#`` starts a comment

    A tab or a semicolon in the first row parts the columns; without them a comma that is followed by more than
    the decimals of one number; without commas, blanks.
    """
    kept: list[str] = []
    numbers: list[int] = []
    comments: list[str] = []
    for number, line in enumerate(read_any_text(path).splitlines(), start=1):
        text, mark, comment = line.partition("#")
        if mark:
            comments.append(comment.strip())
        if text.strip(" ,;\t\xa0"):
            kept.append(text.rstrip())
            numbers.append(number)
    return Table(_parted(kept), numbers, comments)


def _parted(lines: list[str]) -> list[list[str]]:
    """Cells of lines."""
    if not lines:
        return []
    mark = next((mark for mark in "\t;" if mark in lines[0]), None)
    if mark is None and any("," in line for line in lines) and not _blanks_part(lines):
        rows = csv.reader(lines, delimiter=",")
        return [[cell.strip() for cell in row] for row in rows]
    if mark is not None:
        rows = csv.reader(lines, delimiter=mark)
        return [[_decimal(cell.strip()) for cell in row] for row in rows]
    return [[_decimal(cell) for cell in line.split()] for line in lines]


def _blanks_part(lines: list[str]) -> bool:
    """Do blanks part the columns, the commas being decimal ones?"""
    last = lines[-1].split()
    numbers = all(_COMMA.match(word) or is_number(word) for word in last)
    return len(last) > 1 and numbers and len(lines[0].split()) == len(last)


def is_number(word: str) -> bool:
    """Is a cell a number?

    >>> is_number("1e3"), is_number("ms")
    (True, False)
    """
    try:
        float(word)
    except ValueError:
        return False
    return True


def _decimal(cell: str) -> str:
    return cell.replace(",", ".") if _COMMA.match(cell) else cell


class Columns(NamedTuple):
    """Names of columns with their units, and how many rows said so.

    Parameters
    ----------
    names : list of str     lower case, without units
    units : list of str     "" where none is said
    rows : int              rows that hold names and units
    """

    names: list[str]
    units: list[str]
    rows: int

    def factor(self, column: int, kind: str, where: str) -> float:
        """Factor of a column to m, s or deg; refused where its unit measures something else."""
        unit = self.units[column] if column < len(self.units) else ""
        if unit.lower() not in UNITS or UNITS[unit.lower()][0] not in (kind, ""):
            allowed = ", ".join(one for one, (of, _) in UNITS.items() if of == kind)
            raise InputError(
                f"{where}: the unit of column {column + 1} ({self.names[column]}) is {unit!r}; allowed are {allowed}"
            )
        return UNITS[unit.lower()][1]


def columns_of(rows: list[list[str]]) -> Columns:
    """Names and units of columns: "x [mm]" in the header, or a row of units below it.

    >>> columns_of([["time", "roll"], ["ms", "deg"], ["0", "10"]])
    Columns(names=['time', 'roll'], units=['ms', 'deg'], rows=2)
    """
    names, units = [], []
    for cell in rows[0]:
        match = _BRACKETS.match(cell)
        names.append((match[1] if match else cell).strip().lower())
        units.append(match[2] if match else "")
    if len(rows) > 1 and _is_unit_row(rows[1]):
        below = [cell.strip("[]() ") for cell in rows[1]]
        below += [""] * (len(names) - len(below))
        return Columns(names, [mine or own for own, mine in zip(units, below, strict=False)], 2)
    return Columns(names, units, 1)


def _is_unit_row(row: list[str]) -> bool:
    """Does a row hold units: words, none of them a number, at least one of them a unit or in brackets?"""
    words = [cell for cell in row if cell]
    plain = [cell.strip("[]() ").lower() for cell in words]
    return (
        bool(words)
        and not any(is_number(_decimal(cell)) for cell in words)
        and any(one in UNITS or cell[0] in "[(" for one, cell in zip(plain, words, strict=True))
    )

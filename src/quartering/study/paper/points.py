"""Points read from the paper's printed figures, where a user has them: `figNN.csv` files in a folder."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple

from quartering.conventions import InputError

COLUMNS: Final = ("quantity", "series", "x", "y", "x_error", "y_error")
"""Columns of a file of points; the errors may be empty."""


class Point(NamedTuple):
    """One point of a printed figure.

    Parameters
    ----------
    quantity : str             panel it belongs to, such as "roll"
    series : str               what it is: measured or computed, ship, wave
    x, y : float               in the units of the panel's axes
    x_error, y_error : float   half widths of the reading error, 0 where not given
    """

    quantity: str
    series: str
    x: float
    y: float
    x_error: float = 0.0
    y_error: float = 0.0


def read_points(folder: str | Path, known: Sequence[int]) -> dict[int, list[Point]]:
    """Points of every figure in a folder.

    folder: with files fig02.csv, fig06.csv, ..; others are left alone
    known: numbers there are figures for

    Lines that begin with # stand before the columns; one of them says ``# source: ..``.  Source: tests/data/paper/README.md.
    """
    place = Path(folder)
    if not place.is_dir():
        raise InputError(f'points "{place}": there is no such folder; it holds files such as fig06.csv')
    files = {path: re.fullmatch(r"fig(\d+)\.csv", path.name) for path in sorted(place.iterdir())}
    found: dict[int, list[Point]] = {}
    for path, match in files.items():
        if match is None:
            continue
        number = int(match[1])
        if number not in known:
            raise InputError(f'points "{path}": there is no figure {number}; there are {min(known)} to {max(known)}')
        found[number] = _read(path)
    if not found:
        raise InputError(f'points "{place}": no file there is called fig06.csv or alike, so there is nothing to draw')
    return found


def _read(path: Path) -> list[Point]:
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f'points "{path}" cannot be read ({error}); it is a text file in UTF-8') from None
    head = [line for line in lines if line.startswith("#")]
    if not any(re.match(r"#\s*source\s*:\s*\S", line) for line in head):
        raise InputError(f'points "{path}": no line says where they are from; begin the file with "# source: .."')
    body = [(i, line) for i, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    columns = [name.strip() for name in body[0][1].split(",")] if body else []
    missing = [name for name in COLUMNS[:4] if name not in columns]
    unknown = [name for name in columns if name not in COLUMNS]
    if missing or unknown:
        wrong = f"{missing[0]} is missing" if missing else f"{unknown[0]!r} is unknown"
        raise InputError(f'points "{path}": of its columns {wrong}; they are {", ".join(COLUMNS)}')
    cells = csv.reader(line for _, line in body[1:])
    return [_point(path, i, columns, row) for (i, _), row in zip(body[1:], cells, strict=True)]


def _point(path: Path, line: int, columns: Sequence[str], row: Sequence[str]) -> Point:
    if len(row) != len(columns):
        raise InputError(f'points "{path}", line {line}: {len(row)} cells under {len(columns)} columns')
    texts = {name: cell.strip() for name, cell in zip(columns, row, strict=True)}
    numbers = []
    for name in COLUMNS[2:]:
        text = texts.get(name, "")
        try:
            number = float(text or ("0" if name.endswith("error") else "nan"))
        except ValueError:
            number = math.nan
        if not math.isfinite(number) or (name.endswith("error") and number < 0):
            raise InputError(f'points "{path}", line {line}: {name} = "{text}" is not a number that can stand there')
        numbers.append(number)
    return Point(texts["quantity"], texts["series"], *numbers)

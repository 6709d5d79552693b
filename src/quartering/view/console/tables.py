"""Tables as files: .csv for programs and spreadsheets, .xlsx for Excel (extra `excel`).

A .csv is one clean table: the data of a command, one line a condition, below comments of where they are from; of a command
without data its printed tables, one below the other. A .xlsx has all of these, a sheet each.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from quartering.conventions import SYMBOLS, InputError
from quartering.view.console.printed import Table

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

MOST_ROWS: Final = 1_048_576
"""Rows of one sheet of Excel: its own limit."""
_LONGEST_NAME = 31
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")


def write_tables(path: Path, printed: Sequence[Table], data: Sequence[Table]) -> None:
    """Write the tables of a command: data has a line a condition."""
    if path.suffix.lower() == ".xlsx":
        _write_workbook(path, [*printed, *(one for one in data if one not in printed)])
        return
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        for i, one in enumerate(data or printed):
            if i:
                file.write("\n")
            for line in (one.title, *one.notes):
                file.write(f"# {' '.join(line.split())}\n")
            writer.writerow(one.columns)
            writer.writerows([cell_value(cell) for cell in row] for row in one.rows)


def cell_value(cell: str | float | None) -> str | float | None:
    """What a cell says, as a number where it is one; nothing for what is not known.

    Examples
    --------
    >>> cell_value("+0.021"), cell_value("3,200"), cell_value("12 %"), cell_value(float("nan"))
    (0.021, 3200, '12 %', None)
    """
    if isinstance(cell, str):
        plain = cell.replace(",", "") if re.fullmatch(r"\d{1,3}(,\d{3})+", cell) else cell
        try:
            cell = int(plain) if re.fullmatch(r"[+-]?\d+", plain) else float(plain)
        except ValueError:
            return cell
    if cell is None or math.isnan(cell):
        return None
    return cell if math.isfinite(cell) else str(cell)


def data_table(ds: xr.Dataset, title: str, names: Sequence[str] = (), along: Sequence[str] = ()) -> Table:
    """A dataset as a table: a line a place along dimensions (of the first variable where none are named), a column a variable.

    Values along further dimensions are columns too.
    """
    taken = [name for name in names or map(str, ds.data_vars) if name in ds.data_vars]
    dims = [*(along or map(str, ds[taken[0]].dims))]
    beside = [str(name) for name, one in ds.coords.items() if one.ndim and set(one.dims) <= set(dims)]
    columns: dict[str, list[Any]] = {}
    for name in (*beside, *taken):
        one = ds[name].expand_dims({dim: ds.sizes[dim] for dim in dims if dim not in ds[name].dims})
        further = [str(dim) for dim in one.dims if dim not in dims]
        flat = one.transpose(*dims, *further).to_numpy().reshape(prod(ds.sizes[dim] for dim in dims), -1)
        ends = _endings(ds, further)
        columns |= {_head(name, ds, end): _cells(name, flat[:, i], one.attrs) for i, end in enumerate(ends)}
    notes = tuple(f"{key}: {value}" for key, value in ds.attrs.items() if isinstance(value, (str, int, float)))
    return Table(title, tuple(columns), tuple(zip(*columns.values(), strict=True)), notes=notes)


def map_table(ds: xr.Dataset) -> Table:
    """A map, or a part of a sweep, as a table: a line a condition."""
    names = ("sway", "roll", "yaw", "roll_peak", "exponent", "verdict")
    return data_table(ds, f"{ds.attrs['title']}: conditions", names, list(map(str, ds["verdict"].dims)))


def _endings(ds: xr.Dataset, further: Sequence[str]) -> list[str]:
    """What tells the columns of one variable apart: the values along its further dimensions."""
    places = [
        [str(value) for value in (ds[dim].values if dim in ds else range(1, ds.sizes[dim] + 1))] for dim in further
    ]
    return ["".join(f" {place}" for place in one) for one in product(*places)]


def _cells(name: str, values: NDArray[Any], about: Mapping[Any, Any]) -> list[Any]:
    """Values of a column; what is coded as its words."""
    import numpy as np

    from quartering.motion.status import Status
    from quartering.stability.kind import Kind

    if name != "verdict" and "flag_meanings" in about:
        known = dict(zip(np.asarray(about["flag_values"]).tolist(), about["flag_meanings"].split(), strict=True))
        return [known[int(code)] for code in values]
    words: dict[str, Callable[[int], str]]
    words = {"verdict": lambda code: Kind(code).label, "status": lambda code: Status(code).name.lower()}
    if name in words and values.dtype.kind in "iu":
        return [words[name](int(code)) for code in values]
    return [int(cell) if isinstance(cell, bool) else cell for cell in values.tolist()]


def _head(name: str, ds: xr.Dataset, ending: str) -> str:
    """Name and unit of a column; a column of words has none."""
    coded = ds[name].dtype.kind in "OSUb" or name in ("verdict", "status")
    unit = str(ds[name].attrs.get("units", SYMBOLS[name].unit if name in SYMBOLS else "1"))
    return f"{name}{ending}" if coded or unit == "1" else f"{name}{ending} [{unit}]"


def _write_workbook(path: Path, tables: Sequence[Table]) -> None:
    """A sheet each, its title in the first row and what it is from in the last."""
    from openpyxl import Workbook
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.styles import Font

    for one in tables:  # before a sheet is begun
        if len(one.rows) + len(one.notes) + 2 > MOST_ROWS:
            raise InputError(
                f'"{one.title}" has {len(one.rows):,} rows; a sheet of Excel ends at {MOST_ROWS:,}; write a .csv, or a part'
            )
    book = Workbook(write_only=True)
    used: set[str] = set()
    for one in tables:
        sheet = book.create_sheet(_sheet_name(one.title, used))
        sheet.freeze_panes = "A3"

        def cell(value: str | float | None, bold: bool = False, sheet: Any = sheet) -> Any:
            made = WriteOnlyCell(sheet, _CONTROL.sub(" ", value) if isinstance(value, str) else value)
            if isinstance(value, str):
                made.data_type = "s"  # a text that begins with = is no formula
            if bold:
                made.font = Font(bold=True)
            return made

        for i, head in enumerate(one.columns):
            longest = max([len(head), *(len(str(row[i])) for row in one.rows[:50])])
            sheet.column_dimensions[_letters(i)].width = min(60, 2 + longest)
        sheet.append([cell(one.title, bold=True)])
        sheet.append([cell(head, bold=True) for head in one.columns])
        for row in one.rows:
            sheet.append([cell(cell_value(item)) for item in row])
        for line in one.notes:
            sheet.append([cell(line)])
    if not tables:
        book.create_sheet("empty")
    book.save(path)


def _letters(index: int) -> str:
    """Letters of a column."""
    from openpyxl.utils import get_column_letter

    return get_column_letter(index + 1)


def _sheet_name(title: str, used: set[str]) -> str:
    """A name Excel takes: at most 31 letters, none of its signs, each once; the part after the ship's name."""
    text = re.sub(r"[\[\]:*?/\\]", " ", title.split(": ", 1)[-1])
    name = " ".join(text.split())[:_LONGEST_NAME].strip("' ") or "table"
    count = 2
    while name.lower() in used:
        name = f"{name[: _LONGEST_NAME - 4].rstrip()} ({count})"[:_LONGEST_NAME]
        count += 1
    used.add(name.lower())
    return name

"""How often a ship meets each sea, heading and speed: the scatter table, and weights of an axis."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.hull.told import real
from quartering.study.criteria.sea_states import scatter

Floats = NDArray[np.float64]


def read_table(path: str | Path) -> xr.DataArray:
    """A table of how often seas occur, from a .csv: its first line mean periods Tz [s], its first column heights Hs [m]."""
    file = Path(path)
    try:
        with file.open(encoding="utf-8", newline="") as text:
            rows = [row for row in csv.reader(text) if any(cell.strip() for cell in row) and not row[0].startswith("#")]
        tz = [float(cell) for cell in rows[0][1:]]
        lines = [[float(cell) for cell in row] for row in rows[1:]]
        table = np.array(lines, dtype=float)
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f'"{file}" cannot be read ({error}); give a .csv of how often seas occur') from None
    except (ValueError, IndexError):
        table, tz = np.zeros((0, 0)), []
    if table.ndim != 2 or table.shape[1] != len(tz) + 1 or not tz or len(table) == 0:
        raise InputError(
            f'"{file}" is no table of seas: its first line is a word and mean periods [s], each further line a height [m] and'
            " how often seas of it have these periods, in any unit"
        )
    return xr.DataArray(table[:, 1:], {"hs": table[:, 0], "tz": tz}, ("hs", "tz"))


def table_of(given: xr.DataArray | None) -> tuple[xr.DataArray, str]:
    """Shares of time over hs and tz, and what the table is."""
    if given is None:
        own = scatter()
        table = xr.DataArray(own.weight, {"hs": own.hs, "tz": own.tz}, ("hs", "tz"))
        return table, f"North Atlantic, IACS Recommendation 34: {own.status}; unverified"
    if not isinstance(given, xr.DataArray) or set(given.dims) != {"hs", "tz"} or not {"hs", "tz"} <= set(given.coords):
        raise InputError("occurrence is no table; give a DataArray over hs [m] and tz [s] with both as coordinates")
    values = given.transpose("hs", "tz").values.astype(float)
    if not np.isfinite(values).all() or (values < 0).any() or not values.sum() > 0:
        raise InputError("occurrence has values below 0 or none above; give how often each sea occurs, 0 for never")
    return given.transpose("hs", "tz").copy(data=values / values.sum()), "given"


def weights_of(name: str, given: ArrayLike | None, values: Floats, *, round_the_ship: bool = False) -> Floats:
    """Weights of an axis, sum 1."""
    if given is None:
        weight = np.ones(values.size)
        if round_the_ship and np.ptp(values) > 180.0:  # all round: each has half the way to its neighbours
            order = np.argsort(values)
            ring = np.concatenate([[values[order[-1]] - 360.0], values[order], [values[order[0]] + 360.0]])
            weight[order] = np.maximum(0.5 * (ring[2:] - ring[:-2]), 0.0)
        elif round_the_ship and values.size > 1:
            order = np.argsort(values)
            edges = np.concatenate([[values.min()], 0.5 * np.diff(values[order]) + values[order][:-1], [values.max()]])
            weight[order] = np.diff(edges)
        return np.asarray(weight / weight.sum())
    told = real(given)
    if told is None or told.shape != values.shape or not (told >= 0).all() or not told.sum() > 0:
        raise InputError(f"{name} = {given!r}; give {values.size} numbers, none below 0")
    return np.asarray(told / told.sum())

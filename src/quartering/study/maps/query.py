"""Queries of a stored result: worst roll, least margin, slices, tables."""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np

from quartering.conventions import SYMBOLS, InputError
from quartering.motion.status import OnTheWay
from quartering.motion.steady.truncation import ENOUGH
from quartering.stability.kind import Kind
from quartering.study.grid import CONDITION_AXES, STEEPNESS
from quartering.study.loadings import coded

if TYPE_CHECKING:
    import xarray as xr

Measure = Literal["roll", "margin"]
OF_CONDITIONS: Final = frozenset({*CONDITION_AXES, STEEPNESS, "resonance", "rank"})
"""Coordinates of a result that say nothing of its loadings."""
ON_THE_WAY: Final = "capsizes_on_the_way"
MISSED: Final = "missed"
OTHER: Final = "other_roll_peak"
_OF = {"roll": "roll_peak", "margin": "exponent"}


def worst(result: xr.Dataset, by: Measure = "roll", count: int = 10) -> xr.Dataset:
    """The conditions with the largest roll, or the least stable margin.

    result: of `sweep`, `polar` or `open_result`
    by: "roll": largest roll angle over a cycle; "margin": largest Floquet exponent, but for cells where nothing grows
        beside the course in calm water
    count: how many
    Returns along ``rank``, the worst first: every coordinate of the condition, roll_peak [deg], exponent [1/s],
        verdict, capsizes_on_the_way, missed, other_roll_peak [deg]; fewer where fewer conditions have an answer

    Source: [H71]; conditions without an answer are left out.
    """
    import xarray as xr

    values = _measured(result, by)
    if count < 1:
        raise InputError(f"count = {count}; ask for 1 condition or more")
    flat = values.values.ravel()
    known = np.flatnonzero(np.isfinite(flat))
    ranked = known[np.argsort(-flat[known], kind="stable")[:count]]
    where = {
        dim: xr.DataArray(index, dims="rank")
        for dim, index in zip(values.dims, np.unravel_index(ranked, values.shape), strict=True)
    }
    names = ["roll_peak", "exponent", "verdict", *(n for n in (ON_THE_WAY, MISSED, OTHER) if n in result)]
    chosen = result[names].isel(where).load()
    return chosen.assign_coords(rank=np.arange(1, ranked.size + 1))


def capsizing(result: xr.Dataset) -> xr.DataArray:
    """Conditions whose ship capsizes before it comes to its stable motion.

    result: of `sweep`, `polar` or `open_result`; of an earlier version nobody knows: none
    """
    import xarray as xr

    if ON_THE_WAY not in result:
        return xr.zeros_like(result["verdict"], dtype=bool)
    return result[ON_THE_WAY] > int(OnTheWay.NO)


def needing_more(result: xr.Dataset) -> xr.DataArray:
    """Conditions in which the next harmonics are estimated to change roll by more than 1 %.

    result: of `sweep`, `polar`, `worst` or `open_result`; of an earlier version nobody knows: none
    """
    import xarray as xr

    if MISSED not in result:
        return xr.zeros_like(result["verdict"], dtype=bool)
    return result[MISSED] > ENOUGH


def other_rolls(result: xr.Dataset) -> xr.DataArray:
    """Largest roll over a cycle of other stable motions in the waves of a result.

    result: of `sweep`, `polar` or `open_result`; of an earlier version nobody knows: none
    Returns along other_motion, the smallest first; NaN where there is none [deg]
    """
    import xarray as xr

    if OTHER not in result:
        return xr.full_like(result["verdict"], np.nan, dtype=float).expand_dims(other_motion=1, axis=-1)
    return result[OTHER]


def coexisting(result: xr.Dataset) -> xr.DataArray:
    """Conditions in which another stable motion is known beside the one that is judged.

    result: of `sweep`, `polar` or `open_result`
    """
    return other_rolls(result).notnull().any("other_motion")


def worst_by(result: xr.Dataset, dims: Sequence[str] = ("speed", "heading")) -> xr.Dataset:
    """The worst of every speed and heading over everything else.

    result: of `sweep`, `polar` or `open_result`
    dims: that stay
    Returns roll_peak [deg] and exponent [1/s] at their largest; unstable, course_unstable, without_answer, capsizing
        and coexisting: shares of the conditions [1]

    Source: [H71].
    """
    _measured(result, "roll")
    unknown = [dim for dim in dims if dim not in result["verdict"].dims]
    if unknown:
        raise InputError(
            f'"{unknown[0]}" is not a dimension of this result; it has {", ".join(map(str, result["verdict"].dims))}'
        )
    others = [dim for dim in result["verdict"].dims if dim not in dims]
    largest = (
        result[["roll_peak", "exponent"]].assign(exponent=_measured(result, "margin")).max(others, keep_attrs=True)
    )
    verdict = result["verdict"]
    course = verdict == int(Kind.COURSE_IN_CALM_WATER)
    shares = {
        "unstable": (((verdict > int(Kind.STABLE)) & ~course).mean(others), "share of conditions that are unstable"),
        "course_unstable": (course.mean(others), "share of conditions that are course-unstable in calm water too"),
        "without_answer": ((verdict == int(Kind.NO_ANSWER)).mean(others), "share of conditions without an answer"),
        "capsizing": (capsizing(result).mean(others), "share of conditions that are stable, but capsize on the way"),
        "coexisting": (coexisting(result).mean(others), "share of conditions with another stable motion"),
    }
    for name, (values, meaning) in shares.items():
        largest[name] = values.drop_attrs().assign_attrs(units="1", long_name=meaning, symbol="")
    return largest


def sea_of(result: xr.Dataset) -> str | None:
    """The axis of a result that tells how high its waves are.

    result: of `sweep`, `polar` or `open_result`
    Returns "wave_height" or "steepness"; None for one height at each wave length

    >>> from quartering.hull.file.read import ship
    >>> from quartering.study.maps.sweep import sweep
    >>> sea_of(sweep(ship("wigley"), 5.0, 60.0, [80.0, 100.0], steepness=[0.01, 0.02]))
    'steepness'
    """
    return next((name for name in ("wave_height", STEEPNESS) if name in result["verdict"].dims), None)


def cut(result: xr.Dataset, **where: float | str) -> xr.Dataset:
    """The part of a result at given values, the nearest ones taken.

    result: of `sweep`, `polar` or `open_result`
    **where: value by name: heading=30 [deg], wave_height=4 [m], or of a loading: gm=0.7 [m], K_p=2,
        velocities="absolute"
    Returns without the dimensions cut; the dimension "loading" stays while several loadings have the value
    """
    _check_result(result)
    dims = result["verdict"].dims
    allowed = [str(n) for n, v in result.coords.items() if v.dims == ("loading",) or (v.dims == (n,) and n in dims)]
    for name, given in where.items():
        value = coded(name, given)
        if name not in allowed:
            raise InputError(f"a cut at {name} is asked for; this result can be cut at {', '.join(allowed)}")
        values = result[name].values
        if not values.ndim:  # one loading is left, and no choice
            continue
        nearest = np.flatnonzero(values == values[np.nanargmin(np.abs(values - value))])
        result = result.isel({result[name].dims[0]: nearest if nearest.size > 1 else int(nearest[0])})
    return result


def write_csv(
    result: xr.Dataset, path: str | Path, variables: Sequence[str] | None = None, **where: float | str
) -> int:
    """Write a slice of a result as a table: one line a condition, units in the head.

    result: of `sweep`, `polar` or `open_result`
    path: complete or not there at all
    variables: columns after the coordinates; by default the amplitudes, exponent and verdict
    **where: as in `cut`
    Returns number of lines

    Source: [H71].
    """
    names = list(variables or ("sway", "roll", "yaw", "roll_peak", "exponent", "verdict"))
    unknown = [name for name in names if name not in result.data_vars]
    if unknown:
        raise InputError(f'"{unknown[0]}" is not in this result; it has {", ".join(map(str, result.data_vars))}')
    part = cut(result, **where)
    dims = part["verdict"].dims
    table = {name: part[name].load().broadcast_like(part["verdict"]).transpose(*dims, ...) for name in names}
    columns = _columns(part, dims, table)
    target = Path(path)
    half = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        with open(half, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(zip(*columns.values(), strict=True))
        os.replace(half, target)
    except OSError as error:
        raise InputError(f'"{target}" cannot be written ({error.strerror or error}); write elsewhere') from None
    finally:
        half.unlink(missing_ok=True)
    return int(part["verdict"].size)


def _columns(part: xr.Dataset, dims: Sequence[Any], table: dict[str, xr.DataArray]) -> dict[str, list[Any]]:
    """Head and values of every column."""
    columns: dict[str, list[Any]] = {}
    shape = part["verdict"].shape
    for name, coordinate in part.coords.items():
        if set(coordinate.dims) <= set(dims):
            grid = coordinate.broadcast_like(part["verdict"]).transpose(*dims).values
            columns[_head(str(name), coordinate)] = np.broadcast_to(grid, shape).ravel().tolist()
    for name, values in table.items():
        if name == "verdict":
            columns[name] = [Kind(int(v)).label for v in values.values.ravel()]
            continue
        flat = values.values.reshape(int(np.prod(shape)), -1)
        for i in range(flat.shape[1]):
            head = _head(name, values)
            columns[head if flat.shape[1] == 1 else f"{head} {i + 1}"] = flat[:, i].tolist()
    return columns


def _head(name: str, values: xr.DataArray) -> str:
    unit = values.attrs.get("units", SYMBOLS[name].unit if name in SYMBOLS else "1")
    return name if unit == "1" else f"{name} [{unit}]"


def _measured(result: xr.Dataset, by: str) -> xr.DataArray:
    """The variable a measure ranks by."""
    if by not in _OF:
        raise InputError(f'by = "{by}"; allowed are "roll" (largest roll) and "margin" (largest exponent)')
    _check_result(result)
    values = result[_OF[by]]
    return values.where(result["verdict"] != int(Kind.COURSE_IN_CALM_WATER)) if by == "margin" else values


def _check_result(result: xr.Dataset) -> None:
    """Refuse a dataset of something else."""
    if "recommended" in result:
        raise InputError("this is a map over irregular seas, which has advice and no verdicts; take `quartering show`")
    if not {"roll_peak", "exponent", "verdict"} <= set(result.data_vars):
        raise InputError("this is not the result of a sweep or a polar map: roll_peak, exponent or verdict is missing")

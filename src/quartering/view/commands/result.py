"""`quartering worst` and `quartering show`: questions to results that are stored, nothing computed again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from quartering.conventions import InputError, headed, written
from quartering.study.loadings import CHOICE_AXES, coded
from quartering.study.maps.query import (
    OF_CONDITIONS,
    OTHER,
    Measure,
    cut,
    needing_more,
    other_rolls,
    sea_of,
    worst,
    worst_by,
    write_csv,
)
from quartering.study.maps.result import open_result
from quartering.study.maps.zarr_store import write_zarr
from quartering.view.output import PICTURES, claim, write
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import (
    CALM_COURSE,
    edge_words,
    harmonics_of,
    more_harmonics_words,
    value_words,
    verdict_words,
)


def show_worst(result: str, by: str, count: int, as_json: bool) -> None:
    """Print the conditions with the largest roll or the least stable margin."""
    measure: Measure = by  # type: ignore[assignment]  # worst refuses an unknown one
    found = worst(opened(result), measure, count)
    names = [str(n) for n in found.coords if n != "rank"]
    rows = [
        {name: float(found[name][i]) for name in (*names, "roll_peak", "exponent")}
        | {name: value_words(name, float(found[name][i]), "1") for name in names if name in CHOICE_AXES}
        | {"verdict": verdict_words(found.isel(rank=i))}
        | ({OTHER: [float(v) for v in other_rolls(found.isel(rank=i)).values if np.isfinite(v)]} if as_json else {})
        for i in range(found.sizes["rank"])
    ]
    if as_json:
        show_json({"by": by, "worst": rows})
        return
    columns = [_head(name, found) for name in (*names, "roll_peak", "exponent")] + ["verdict"]
    texts = [[v if isinstance(v, str) else f"{v:.4g}" for v in row.values()] for row in rows]
    what = "Largest roll" if by == "roll" else "Least stable margin"
    show(table(f"{what} of {found.attrs['ship']}", columns, texts, tuple(range(len(columns) - 1))))
    _show_short(found)
    if by == "roll":
        show(*edge_words(opened(result), "further values of {}"))
    show(next_steps(f"quartering show {result}"))


def show_result(
    result: str, cuts: list[str], output: str | None, table_file: str | None, store: str | None, as_json: bool
) -> None:
    """Print the worst of every speed and heading; draw the map of a part, or write it as a table or a Zarr store."""
    picture = claim(output, PICTURES) if output is not None else None
    target = claim(table_file, (".csv",)) if table_file is not None else None
    ds, where = opened(result), dict(split_cut(typed) for typed in cuts)
    part = cut(ds, **where)
    taken = {name: float(part[name]) for name in where if not part[name].dims}
    if store is not None:
        write_zarr(part, store)
    if target is not None:
        write_csv(part, target)
    if picture is not None:
        _draw(part, picture)
    by = worst_by(part, [dim for dim in ("speed", "heading") if dim in part["verdict"].dims])
    files = {
        "picture": str(picture) if picture else None, "table": str(target) if target else None, "zarr": store
    }  # fmt: skip
    if as_json:
        show_json(_facts(ds, by) | {"at": taken} | files)
        return
    stacked = by.stack(line=[*by["roll_peak"].dims]) if by["roll_peak"].dims else by.expand_dims("line")
    rows = [_row(stacked.isel(line=i)) for i in range(stacked.sizes["line"])]
    title = f"{ds.attrs['title']}: {_sizes(ds)}"
    if taken:
        title += "; at " + ", ".join(
            f"{_head(name, part)} {value_words(name, value, '1')}" for name, value in taken.items()
        )
    show(table(title, ("speed [m/s]", "heading [deg]", *_COLUMNS), rows, tuple(range(2 + len(_COLUMNS)))))
    _show_short(part)
    if (share := float(by["course_unstable"].mean())) > 0:
        show(
            f"Course-unstable in calm water: {100 * share:.1f} % of the conditions, where nothing else grows. {CALM_COURSE}"
        )
    show(*(f"Wrote {path}" for path in files.values() if path))
    names = [
        n
        for n in ("wave_height", "steepness", *_loading_names(ds))
        if n in ds.coords and ds[n].dims in ((n,), ("loading",))
    ]
    example = "".join(f" --at {name}={value_words(name, float(ds[name][0]), '1')}" for name in names)
    show(next_steps(f"quartering worst {result}", f"quartering show {result}{example} -o map.png --csv slice.csv"))


def _show_short(ds: xr.Dataset) -> None:
    """Say how many conditions want more harmonics."""
    if short := int(needing_more(ds).sum()):
        show(more_harmonics_words(short, ds["verdict"].size, harmonics_of(ds)))


def opened(result: str) -> xr.Dataset:
    """The dataset of a sweep's folder or of a netCDF file."""
    path = Path(result)
    if not path.exists():
        raise InputError(f'there is no "{result}": give the folder of a sweep, or the netCDF file of a map')
    if path.is_dir():
        return open_result(path)
    try:
        return xr.load_dataset(path)
    except (OSError, ValueError):
        raise InputError(f'"{result}" is neither the folder of a sweep nor a netCDF file') from None


def split_cut(typed: str) -> tuple[str, float]:
    """Dimension and value of "wave_height=4"; a steepness may be 1/30, as in a case file, and velocities a word.

    Examples
    --------
    >>> split_cut("wave_height=4")
    ('wave_height', 4.0)
    >>> split_cut("steepness=1/50")
    ('steepness', 0.02)
    """
    name, sign, number = typed.partition("=")
    if name.strip() in CHOICE_AXES:
        return name.strip(), float(coded(name.strip(), number.strip()))
    above, bar, below = number.partition("/")
    try:
        return name.strip(), float(above) / (float(below) if bar else 1.0)
    except (ValueError, ZeroDivisionError):
        raise InputError(
            f'--at "{typed}"{"" if sign else " has no ="}: write it like --at wave_height=4 [m, m/s, deg]'
        ) from None


_COLUMNS = (
    "largest roll [deg]", "largest exponent [1/s]", "unstable", "no answer", "capsizes on the way", "several stable motions",
)  # fmt: skip


def _row(line: xr.Dataset) -> tuple[str, ...]:
    place = [f"{float(line[name]):.4g}" if name in line.coords else "" for name in ("speed", "heading")]
    shares = [f"{100 * float(line[name]):.1f} %" for name in ("unstable", "without_answer", "capsizing", "coexisting")]
    return (*place, f"{float(line['roll_peak']):.3g}", f"{float(line['exponent']):+.3g}", *shares)


def _facts(ds: xr.Dataset, by: xr.Dataset) -> dict[str, Any]:
    return {
        "title": ds.attrs["title"],
        "sizes": {str(name): size for name, size in ds["verdict"].sizes.items()},
        **{str(name): values.values for name, values in by.coords.items()},
        **{str(name): values.values for name, values in by.data_vars.items()},
    }


def _draw(part: xr.Dataset, picture: Path) -> None:
    """The polar map of a part of a result."""
    from quartering.view.plots import style
    from quartering.view.plots.polar_map import polar_map

    flat = map_of(part)
    write((picture, lambda half: style.save(polar_map(flat), half)))


def map_of(part: xr.Dataset) -> xr.Dataset:
    """A part of a sweep in the form of a map: of its first loading and its highest wave, where several are left."""
    several = ""
    if "loading" in part.dims:
        several, part = f" (loading 1 of {part.sizes['loading']})", part.isel(loading=0)
    sea = sea_of(part)
    if sea:
        part = part.isel({sea: -1})
    for dim in ("speed", "heading", "wave_length"):
        if dim not in part["verdict"].dims:
            raise InputError(f"a map needs all values of {dim}; leave out --at {dim}")
    height = part["wave_height"].values * np.ones(part.sizes["wave_length"])
    flat = part.drop_vars("wave_height").assign_coords(wave_height=("wave_length", height, part["wave_height"].attrs))
    if own := ", ".join(f"{written(n)} {value_words(n, float(flat[n]), _unit(n, flat))}" for n in _loading_names(flat)):
        flat = flat.assign_attrs(
            loading=f"{own}{several}; the rest as the ship's own", natural_roll_frequency=small_roll_frequency(flat)
        )
    return flat.load()


def small_roll_frequency(ds: xr.Dataset) -> float:
    """Natural roll frequency [rad/s] of small roll, from the condition that rolls least of those met nearest to it."""
    n2, omega = ds["n2"].values, np.abs(ds["encounter_frequency"].values)
    roll = np.where(np.isfinite(ds["roll"].values), ds["roll"].values, np.inf)
    off = np.abs(omega - n2) / n2 + roll / 10.0
    return float(n2.ravel()[np.nanargmin(off)]) if np.isfinite(off).any() else float("nan")


def _loading_names(ds: xr.Dataset) -> list[str]:
    """Coordinates that tell one loading from another."""
    return [str(name) for name in ds.coords if name not in OF_CONDITIONS]


def _sizes(ds: xr.Dataset) -> str:
    def words(name: str) -> str:
        return name.replace("_", " ") + ("es" if name.endswith("s") else "s")

    sizes = ds["verdict"].sizes.items()
    return ", ".join(f"{size} {words(str(name)) if size != 1 else str(name).replace('_', ' ')}" for name, size in sizes)


def _head(name: str, ds: xr.Dataset) -> str:
    return headed(name, _unit(name, ds))


def _unit(name: str, ds: xr.Dataset) -> str:
    return str(ds[name].attrs.get("units", "1"))

"""Stored results: opened, and in the form in which views take them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from quartering.conventions import InputError, headed, written
from quartering.study.maps.query import OF_CONDITIONS, needing_more, sea_of
from quartering.study.maps.result import open_result
from quartering.study.seas.over_seas.map_axes import period_of
from quartering.view.wording import harmonics_of, more_harmonics_words, value_words


def opened(result: str) -> xr.Dataset:
    """The dataset of a sweep's folder or of a netCDF file."""
    path = Path(result)
    if not path.exists():
        raise InputError(f'there is no "{result}": give the folder of a sweep, or the netCDF file of a map')
    if path.is_dir():
        found = open_result(path)
    else:
        try:
            found = xr.load_dataset(path)
        except (OSError, ValueError):
            raise InputError(f'"{result}" is neither the folder of a sweep nor a netCDF file') from None
    if "lost_expected" in found:
        raise InputError(
            f'"{result}" holds cells of a direct assessment: run the same `quartering assess` again, which computes only what'
            " is missing and tells their sum"
        )
    return found


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
    if own := ", ".join(
        f"{written(n)} {value_words(n, float(flat[n]), unit_of(n, flat))}" for n in loading_names(flat)
    ):
        flat = flat.assign_attrs(
            loading=f"{own}{several}; the rest as the ship's own", natural_roll_frequency=small_roll_frequency(flat)
        )
    return flat.load()


def sea_part(ds: xr.Dataset, where: Mapping[str, float]) -> xr.Dataset:
    """The part of operational guidance at given heights, periods, speeds or headings, the nearest ones taken.

    where: by name; tp and tz are of one axis, and loading counts from 1
    """
    allowed = ("hs", "tp", "tz", "speed", "heading", "loading")
    for name, value in where.items():
        if name not in allowed:
            raise InputError(f"a cut at {name} is asked for; this result can be cut at {', '.join(allowed)}")
        dim = period_of(ds) if name in ("tp", "tz") else name
        if name in ds.coords and ds[name].ndim > 1:
            raise InputError(f"a cut at {name} is asked for; here it hangs on hs and {dim}: cut at {dim}")
        values = np.arange(1, ds.sizes["loading"] + 1) if name == "loading" else ds[name].values
        ds = ds.isel({dim: [int(np.abs(values - value).argmin())]})
    return ds.load()


def small_roll_frequency(ds: xr.Dataset) -> float:
    """Natural roll frequency [rad/s] of small roll, from the condition that rolls least of those met nearest to it."""
    n2, omega = ds["n2"].values, np.abs(ds["encounter_frequency"].values)
    roll = np.where(np.isfinite(ds["roll"].values), ds["roll"].values, np.inf)
    off = np.abs(omega - n2) / n2 + roll / 10.0
    return float(n2.ravel()[np.nanargmin(off)]) if np.isfinite(off).any() else float("nan")


def loading_names(ds: xr.Dataset) -> list[str]:
    """Coordinates that tell one loading from another."""
    return [str(name) for name in ds.coords if name not in OF_CONDITIONS]


def head_of(name: str, ds: xr.Dataset) -> str:
    """Name of a coordinate with its unit, as the head of a column."""
    return headed(name, unit_of(name, ds))


def unit_of(name: str, ds: xr.Dataset) -> str:
    """Unit of a coordinate or value."""
    return str(ds[name].attrs.get("units", "1"))


def short_words(ds: xr.Dataset) -> list[str]:
    """How many conditions of a result want more harmonics, in a sentence; nothing where none does."""
    short = int(needing_more(ds).sum())
    return [more_harmonics_words(short, ds["verdict"].size, harmonics_of(ds))] if short else []

"""A result as a Zarr store, for tools that read that and for object stores; needs the extra `zarr`."""

from __future__ import annotations

import os
import shutil
from importlib.util import find_spec
from pathlib import Path
from typing import Final

import xarray as xr

from quartering.conventions import InputError

_AT_A_TIME: Final = 250_000
"""Conditions in memory at a time: about 50 MB of results."""


def write_zarr(result: xr.Dataset, path: str | Path) -> Path:
    """Write a result, or a part of one, as a Zarr store.

    result: of `sweep`, `polar`, `open_result` or `cut`
    path: a folder that is not there yet; complete or not there at all

    A sweep is computed into netCDF blocks, which a killed run cannot leave half-written; this copies them, part by part along
    the longest dimension, so that memory holds a part and not the whole.
    """
    target = Path(path)
    if find_spec("zarr") is None:
        raise InputError(f'"{target}" needs zarr; install it with: pip install "quartering[zarr]"')
    if target.exists() or not target.parent.is_dir():
        why = (
            "is there already; give another name, or remove it first"
            if target.exists()
            else "has no folder to stand in"
        )
        raise InputError(f'"{target}" {why}')
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        _copy(result, part)
        os.replace(part, target)
    except OSError as error:
        raise InputError(f'"{target}" cannot be written ({error.strerror or error}); write elsewhere') from None
    finally:
        shutil.rmtree(part, ignore_errors=True)
    return target


def _copy(result: xr.Dataset, folder: Path) -> None:
    verdict = result["verdict"]
    if not verdict.dims:
        result.load().to_zarr(folder, consolidated=False)
        return
    dim, size = max(verdict.sizes.items(), key=lambda pair: pair[1])
    rows = max(1, _AT_A_TIME * size // verdict.size)
    for first in range(0, size, rows):
        some = result.isel({dim: slice(first, first + rows)}).load()
        some.to_zarr(folder, consolidated=False, append_dim=dim if first else None)

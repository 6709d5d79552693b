"""What both answers of `quartering vary` share: ranges, names of options, and the file they write."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from quartering.options import OPTIONS
from quartering.view.console.files import File, picture_files
from quartering.view.console.typed_ship import Typed

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def is_range(text: str) -> bool:
    """Does a condition's option stand for several values?"""
    return ":" in text or "," in text


def option(name: str) -> str:
    """The option a parameter is given with."""
    return f"--{name.replace('_', '-')}" if name in OPTIONS else f"--coefficient {name}"


def unvaried_words(typed: Typed) -> str:
    """Options that give the same condition again, ranges left out."""
    return "".join(f" {option(key)} {text}" for key, text in typed.condition.items() if not is_range(text))


def dataset_or_picture(path: Path | None, ds: xr.Dataset, draw: Callable[[], Figure]) -> tuple[File, ...]:
    """The file of a dataset or of its picture, as the path's ending says; none without a path, or where that is of tables."""
    if path is not None and path.suffix.lower() == ".nc":
        return (File(path, lambda part: ds.to_netcdf(part)),)
    return picture_files(path, draw)

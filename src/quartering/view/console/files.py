"""Files a command writes: checked before the work, complete or not there at all."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeGuard, overload

from quartering.conventions import InputError

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

PICTURES = (".png", ".svg", ".pdf")
"""Kinds of picture that can be written."""
TABLES = (".csv", ".xlsx")
"""Kinds of file the tables of a command can be written to."""


class File(NamedTuple):
    """A file to write: its path, and ``writer(path)``, which writes the whole of it."""

    path: Path
    writer: Callable[[Path], object]


@overload
def reserve_path(path: str | Path, endings: Sequence[str]) -> Path: ...
@overload
def reserve_path(path: None, endings: Sequence[str]) -> None: ...
@overload
def reserve_path(path: str | None, endings: Sequence[str]) -> Path | None: ...
def reserve_path(path: str | Path | None, endings: Sequence[str]) -> Path | None:
    """Path of a file to be written, after trying that its folder takes it.

    path: None: nothing is to be written
    endings: allowed, with their dot
    """
    if path is None:
        return None
    target = Path(path)
    if target.suffix.lower() not in endings:
        raise InputError(
            f'output "{path}": its name must end in {" or ".join(endings)}; try "{target.stem or "my"}{endings[0]}"'
        )
    try:
        if target.is_dir():
            raise InputError(f'output "{target}" is a folder; give the name of a file in it')
        if not target.parent.is_dir():
            raise InputError(
                f'output "{target}": there is no folder "{target.parent}"; make it first, or write elsewhere'
            )
        trial = _part(target)
        trial.touch()
        trial.unlink()
    except OSError as error:
        raise InputError(
            f'output "{target}" cannot be written ({error.strerror}); give a file in a folder you may write to'
        ) from None
    _check_excel(target)
    return target


def _check_excel(target: Path) -> None:
    """Refuse a workbook where the package that writes it is missing."""
    if target.suffix.lower() == ".xlsx" and find_spec("openpyxl") is None:
        raise InputError(
            f'"{target}" needs openpyxl; install it with: pip install "quartering[excel]"; or write '
            f'"{target.with_suffix(".csv")}"'
        )


def is_table(path: Path | None) -> TypeGuard[Path]:
    """Is a file one of tables?"""
    return path is not None and path.suffix.lower() in TABLES


def folder_named(path: str) -> Path:
    """Path of a folder to write into.

    >>> folder_named("figures").name
    'figures'
    """
    if not path.strip():
        raise InputError('output "" names no folder; give one, such as results')
    return Path(path)


def picture_files(path: Path | None, draw: Callable[[], Figure]) -> tuple[File, ...]:
    """The file of a picture that is drawn when it is written; none without a path."""

    def writer(part: Path) -> None:
        from quartering.view.plots import style

        style.save(draw(), part)

    return () if path is None or path.suffix.lower() not in PICTURES else (File(path, writer),)


def dataset_files(path: Path | None, ds: xr.Dataset) -> tuple[File, ...]:
    """The file of a dataset; none without a path, or where its ending is another."""
    return (File(path, lambda part: ds.to_netcdf(part)),) if path is not None and path.suffix.lower() == ".nc" else ()


def dataset_or_picture(path: Path | None, ds: xr.Dataset, draw: Callable[[], Figure]) -> tuple[File, ...]:
    """The file of a dataset or of its picture, as the path's ending says; none without a path, or where that is of tables."""
    return dataset_files(path, ds) or picture_files(path, draw)


def write_files(*files: File) -> None:
    """Write files under another name beside their own, and name them only when all are complete."""
    parts = [_part(path) for path, _ in files]
    try:
        for part, (_, writer) in zip(parts, files, strict=True):
            writer(part)
        for part, (path, _) in zip(parts, files, strict=True):
            os.replace(part, path)
    except OSError as error:
        names = ", ".join(f'"{path}"' for path, _ in files)
        raise InputError(
            f"{names} cannot be written ({error.strerror or error}); free some space or write elsewhere"
        ) from None
    finally:
        for part in parts:
            part.unlink(missing_ok=True)


def ship_stem(ship: str) -> str:
    """Short name of a ship given by name or by path, to name files with.

    >>> ship_stem("series60-cb60"), ship_stem("ships/my.yaml")
    ('series60-cb60', 'my')
    """
    path = Path(ship)
    return path.stem if path.is_file() or path.suffix.lower() in (".yaml", ".yml") else path.name


def _part(path: Path) -> Path:
    return path.with_name(f".{path.stem}.{os.getpid()}.part{path.suffix}")

"""Disk cache of arrays, keyed by a hash of their inputs and of the source files.

A file counts only when it is whole and was written for its name: anything else is made anew. That the folder cannot be
written, or that another process works in it, is no error; the arrays are then computed.
"""

from __future__ import annotations

import hashlib
import io
import os
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from platformdirs import user_cache_path

from quartering._machine.publish import publish

Arrays = Mapping[str, NDArray[Any]]

PLACE: Final = "QUARTERING_CACHE"
"""Environment variable: a folder for the files, or "off"."""
LARGEST: Final = 200_000_000
"""Bytes kept; beyond them the files unused for longest go."""
_ABANDONED: Final = 3600.0
_CHECK: Final = hashlib.sha256().digest_size


def cache_folder() -> Path | None:
    """Folder of the files, whether it exists yet or not.

    Returns $QUARTERING_CACHE; else `quartering` in the user's cache folder, where the system keeps it; None when it is
        "off" or the user has no home
    """
    named = os.environ.get(PLACE, "")
    if named:
        return None if named.lower() == "off" else Path(named).expanduser().absolute()
    usual = user_cache_path("quartering", appauthor=False)
    return usual if usual.is_absolute() else None  # no home


def cached(name: str, make: Callable[[], Arrays]) -> Arrays:
    """Load arrays by key from the disk cache; compute and store them if absent.

    name: digest of all the arrays follow from: inputs and source
    make: gives the arrays
    Returns contiguous and writeable, equal to the last bit however they were come by
    """
    folder = cache_folder()
    path = None if folder is None else folder / f"{name}.npz"
    found = None if path is None else _read(path)
    if found is not None:
        return found
    made = {key: np.array(value, order="C") for key, value in make().items()}
    if path is not None:
        with suppress(OSError):
            _write(path, made)
    return made


def _read(path: Path) -> Arrays | None:
    """Arrays of a file; None when it is missing, damaged, or was written under another name."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    check, payload = data[:_CHECK], data[_CHECK:]
    if check != _checksum(path, payload):
        return None
    with suppress(OSError):
        os.utime(path)
    with np.load(io.BytesIO(payload), allow_pickle=False) as opened:
        return {key: opened[key] for key in opened.files}


def _write(path: Path, arrays: Arrays) -> None:
    buffer = io.BytesIO()
    np.savez(buffer, allow_pickle=False, **dict(arrays))
    payload = buffer.getvalue()
    path.parent.mkdir(parents=True, exist_ok=True)
    publish(path, _checksum(path, payload) + payload)
    _make_room(path.parent)


def _checksum(path: Path, payload: bytes) -> bytes:
    return hashlib.sha256(path.name.encode() + payload).digest()


def _make_room(folder: Path) -> None:
    """Remove the files unused for longest until the rest fits, and parts that a killed process left."""
    kept = 0
    now = time.time()
    files = []
    for file in folder.iterdir():
        with suppress(OSError):  # another process may remove it meanwhile
            files.append((file.stat().st_mtime, file.stat().st_size, file))
    for used, size, file in sorted(files, reverse=True):
        unfinished = file.suffix == ".part"
        kept += size
        if (file.suffix == ".npz" and kept > LARGEST) or (unfinished and now - used > _ABANDONED):
            with suppress(OSError):
                file.unlink()

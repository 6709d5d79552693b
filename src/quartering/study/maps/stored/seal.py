"""Checksums at the end of a block file, by which damage is found.

A reader of netCDF does not look behind the variables, so a sealed file is still one. The seal is an index (JSON) and a last
line of fixed length: the index's length, its SHA-256, and the SHA-256 of all that stands before the line. One variable is
checked by its own checksum in the index, without reading the others; a whole file by the last one.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

_LINE: Final = b"\nquartering block %012d %64s %64s\n"
_LENGTH: Final = len(_LINE % (0, b"", b""))
_HASH: Final = 64


class DamagedError(ValueError):
    """A block's file is not what was written."""


def sealed(data: bytes, variables: Mapping[str, NDArray[Any]], about: Mapping[str, Any]) -> bytes:
    """A file's content with its seal.

    variables: by name, in the byte order in which they stand there
    about: further facts the seal holds, in types JSON knows
    """
    index, at = {}, 0
    for name, values in variables.items():
        own = values.tobytes()
        begin = data.find(own, at)  # mostly in this order
        begin = data.index(own) if begin < 0 else begin
        index[name], at = [begin, values.dtype.str, list(values.shape), _hash(values)], begin + len(own)
    text = json.dumps({"variables": index, **about}).encode()
    body = data + text
    return body + _LINE % (len(text), _hash(text).encode(), _hash(body).encode())


def read_index(path: Path) -> dict[str, Any]:
    """Index of a sealed file, checked by its own checksum.

    Returns variables, and what `sealed` was told
    """
    with path.open("rb") as file:
        size = file.seek(0, 2)
        file.seek(max(0, size - _LENGTH))
        length, own, _ = _last_line(file.read())
        if length > size - _LENGTH:
            raise DamagedError
        file.seek(size - _LENGTH - length)
        text = file.read(length)
    if _hash(text) != own:
        raise DamagedError
    index: dict[str, Any] = json.loads(text)
    return index


def read_variable(path: Path, name: str, index: Mapping[str, Any]) -> NDArray[Any]:
    """One variable of a sealed file, checked by its checksum.

    index: from `read_index`
    Returns in this machine's byte order
    """
    begin, dtype, shape, own = index["variables"][name]
    wanted = np.dtype(dtype)
    with path.open("rb") as file:
        file.seek(begin)
        data = file.read(wanted.itemsize * math.prod(shape))
    if _hash(data) != own:
        raise DamagedError
    return np.frombuffer(data, wanted).reshape(shape).astype(wanted.newbyteorder("="))


def is_sound(path: Path) -> bool:
    """Is every byte of a sealed file as it was written?"""
    try:
        data = path.read_bytes()
        return _hash(data[:-_LENGTH]) == _last_line(data[-_LENGTH:])[2]
    except (OSError, DamagedError):
        return False


def _last_line(line: bytes) -> tuple[int, str, str]:
    """Length of the index, its checksum and the file's; the line itself must be as it is written."""
    parts = line.split()
    try:
        length, own, whole = int(parts[2]), parts[3].decode("ascii"), parts[4].decode("ascii")
        same = line == _LINE % (length, own.encode(), whole.encode())
    except (ValueError, IndexError, OverflowError):
        raise DamagedError from None
    if not same or len(own) != _HASH or len(whole) != _HASH:
        raise DamagedError
    return length, own, whole


def _hash(data: bytes | NDArray[Any]) -> str:
    return hashlib.sha256(data if isinstance(data, bytes) else data.tobytes()).hexdigest()

"""Digests: of the numbers in a record, and of the source files that make numbers."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

_ROOT = Path(__file__).parents[1]
_UNSAID = ("provenance", "source", "references")


def fingerprint(value: Any) -> str:
    """Digest of every number in a record, the texts that only tell of sources left out.

    value: number, text, array, mapping, sequence, or a record of such
    Returns 32 hexadecimal digits; equal for equal content in any process
    """
    digest = hashlib.sha256()
    _feed(digest, value)
    return digest.hexdigest()[:32]


def _feed(digest: Any, value: Any) -> None:
    if isinstance(value, np.ndarray):
        digest.update(f"{value.dtype.str}{value.shape}".encode())
        digest.update(np.ascontiguousarray(value).tobytes())
    elif isinstance(value, Mapping):
        for key in sorted(value):
            _feed(digest, [str(key), value[key]])
    elif isinstance(value, (list, tuple)):
        digest.update(f"[{len(value)}".encode())
        for item in value:
            _feed(digest, item)
    elif is_dataclass(value):
        _feed(digest, {f.name: getattr(value, f.name) for f in fields(value) if f.name not in _UNSAID})
    elif isinstance(value, float):
        digest.update(float(value).hex().encode())
    elif value is None or isinstance(value, (bool, int, str, np.generic)):
        digest.update(f"{type(value).__name__}{value};".encode())
    else:
        _feed(digest, [type(value).__name__, vars(value)])


@lru_cache(maxsize=8)
def source_digest(*parts: str) -> str:
    """Digest of the source files of rooms and of single files, with the files beside the rooms.

    *parts: rooms such as "hydro", or files such as "study/grid.py"
    Returns 16 hexadecimal digits, equal for equal installations
    """
    digest = hashlib.sha256()
    for part in (".", "_machine", *parts):
        place = _ROOT / part
        files = [place] if place.suffix == ".py" else sorted(place.glob("*.py") if part == "." else place.rglob("*.py"))
        if not files:
            raise FileNotFoundError(f"no source files in {place}")
        for file in files:
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]

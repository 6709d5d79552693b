"""Files in the classic netCDF format with 64-bit offsets, whole in memory, and where each variable stands in them.

A block of results is a few kilobytes of names and units before some megabytes of numbers. Here each number is turned to the
format's byte order once and put in its place once, and who seals the file is told the place instead of searching for it.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

_BYTE, _TEXT, _INT, _DOUBLE = 1, 2, 4, 6
_KIND: Final = {"i1": _BYTE, "i4": _INT, "f8": _DOUBLE}
_DIMENSIONS, _VARIABLES, _ATTRIBUTES = 10, 11, 12
_ABSENT: Final = bytes(8)


class Held(NamedTuple):
    """One variable of a file.

    Parameters
    ----------
    dims : tuple of str     its dimensions by name
    values : array          of any byte order; int8, or else kept as float64
    attributes : mapping    texts, numbers, flat arrays of numbers
    """

    dims: tuple[str, ...]
    values: NDArray[np.generic]
    attributes: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class ClassicFile:
    """A file in pieces that follow one another.

    Parameters
    ----------
    pieces : list of bytes-like    header, then the variables with what fills them up to four bytes
    begin : mapping                first byte of each variable
    values : mapping               each variable in the byte order of the file
    """

    pieces: list[bytes | memoryview]
    begin: Mapping[str, int]
    values: Mapping[str, NDArray[np.generic]]


def classic_file(sizes: Mapping[str, int], attributes: Mapping[str, Any], variables: Mapping[str, Held]) -> ClassicFile:
    """A netCDF file.

    sizes: of each dimension
    attributes: of the file
    variables: by name, in the order in which they stand in the file

    Source: the netCDF classic format specification, version 2 (CDF-2).

    >>> made = classic_file({"x": 2}, {}, {"a": Held(("x",), np.array([1.0, 2.0]), {"units": "m"})})
    >>> b"".join(made.pieces)[made.begin["a"] :].hex()
    '3ff00000000000004000000000000000'
    """
    values = {name: _in_file_order(one.values) for name, one in variables.items()}
    places = {name: k for k, name in enumerate(sizes)}
    heads = {name: _head(name, one, values[name], places) for name, one in variables.items()}
    start = b"".join([
        b"CDF\x02", struct.pack(">i", 0),
        _listed(_DIMENSIONS, [_text(name) + struct.pack(">i", size) for name, size in sizes.items()]),
        _attributes(attributes),
    ])  # fmt: skip
    at = len(start) + 8 + sum(len(head) + 8 for head in heads.values())
    begin, pieces = {}, list[bytes | memoryview]()
    for name, array in values.items():
        begin[name] = at
        pieces += [array.reshape(-1).view(np.uint8).data, bytes(-array.nbytes % 4)]
        at += array.nbytes + -array.nbytes % 4
    told = _listed(_VARIABLES, [head + struct.pack(">q", begin[name]) for name, head in heads.items()])
    return ClassicFile([start, told, *pieces], begin, values)


def _in_file_order(values: NDArray[np.generic]) -> NDArray[np.generic]:
    """The values contiguous, the most significant byte first."""
    return np.ascontiguousarray(values, dtype=np.int8 if values.dtype == np.int8 else np.dtype(">f8"))


def _head(name: str, one: Held, values: NDArray[np.generic], places: Mapping[str, int]) -> bytes:
    """What stands of a variable before its first byte's place."""
    ids = struct.pack(f">{1 + len(one.dims)}i", len(one.dims), *(places[dim] for dim in one.dims))
    size = values.nbytes + -values.nbytes % 4
    return _text(name) + ids + _attributes(one.attributes) + struct.pack(">iI", _KIND[values.dtype.str[1:]], size)


def _attributes(given: Mapping[str, Any]) -> bytes:
    return _listed(_ATTRIBUTES, [_text(name) + _value(value) for name, value in given.items() if not _empty(value)])


def _empty(value: Any) -> bool:
    """A text of no letters is left out: readers take it for none."""
    return isinstance(value, str) and not value


def _value(value: Any) -> bytes:
    """Kind, number and values of an attribute: text, integers, or else floats of eight bytes."""
    if isinstance(value, str):
        return struct.pack(">i", _TEXT) + _text(value)
    array = np.atleast_1d(np.asarray(value))
    kind = "i1" if array.dtype == np.int8 else "i4" if array.dtype.kind in "iub" else "f8"
    return struct.pack(">ii", _KIND[kind], array.size) + _filled(array.astype(f">{kind}").tobytes())


def _text(words: str) -> bytes:
    own = words.encode()
    return struct.pack(">i", len(own)) + _filled(own)


def _filled(own: bytes) -> bytes:
    """Up to a multiple of four bytes."""
    return own + bytes(-len(own) % 4)


def _listed(kind: int, items: list[bytes]) -> bytes:
    return struct.pack(">ii", kind, len(items)) + b"".join(items) if items else _ABSENT

"""Pack the equations of many conditions into one batch, and unpack results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.program import PLAIN
from quartering.motion.equations.system import PER_CONDITION, System


def joined(systems: Sequence[System]) -> System:
    """Systems as one batch, their products brought into one order of columns.

    systems: of any numbers of conditions; a product one of them lacks is zero there
    """
    extra = max((s.extra for s in systems), key=len)
    if any(len(s.extra) and not np.array_equal(s.extra, extra) for s in systems):
        raise ValueError(f"known inputs to different states: {[s.extra.tolist() for s in systems]}")
    products = [[(*_wide(row, extra.size), bars) for row, bars in _products(s)] for s in systems]
    where = {key: i for i, key in enumerate(dict.fromkeys(key for one in products for key in one))}
    blocks = []
    for s, keys in zip(systems, products, strict=True):
        block = np.zeros((s.count, 3, len(where)))
        block[:, :, [where[key] for key in keys]] = s.coefficients
        blocks.append(block)
    stacked: dict[str, Any] = {name: _stacked([getattr(s, name) for s in systems], name) for name in PER_CONDITION[2:]}
    return replace(
        systems[0],
        linear=np.concatenate([s.linear for s in systems]),
        coefficients=np.concatenate(blocks),
        powers=np.array([key[:-1] for key in where], dtype=np.int64).reshape(-1, PLAIN + extra.size),
        modulus=np.array([key[-1] for key in where], dtype=np.int64),
        extra=extra,
        **stacked,
    )


def _products(s: System) -> list[tuple[tuple[int, ...], int]]:
    return list(zip(map(tuple, s.powers.tolist()), s.modulus.tolist(), strict=True))


def _wide(powers: tuple[int, ...], extra: int) -> tuple[int, ...]:
    return powers + (0,) * (PLAIN + extra - len(powers))


def _stacked(arrays: list[NDArray[np.float64]], name: str) -> NDArray[np.float64]:
    """Arrays of different conditions one after another, the shorter ones filled up so that nothing is added to their equations.

    A table of cubics goes on with its last piece; one that is missing altogether is zero, and so are inputs and strips.
    """
    shape = np.max([array.shape[1:] for array in arrays], axis=0).astype(int)
    filled = []
    for array in arrays:
        if array.shape[1:] == tuple(shape):
            filled.append(array)
            continue
        more = [(0, 0), *((0, int(to - own)) for to, own in zip(shape, array.shape[1:], strict=True))]
        table = name in ("knots", "cubics") and array.shape[1] > 0
        filled.append(np.pad(array, more, mode="edge") if table else np.pad(array, more))
    return np.concatenate(filled)


def rows(system: System, which: slice | NDArray[np.intp]) -> System:
    """Some of the conditions of a batch.

    system: n conditions
    which: of them, in any order; a number may repeat
    """
    return system.each(lambda array: array[which])


def apart(systems: System) -> list[System]:
    """The conditions of a batch one by one: the inverse of `joined`.

    systems: n conditions
    """
    return [rows(systems, slice(i, i + 1)) for i in range(systems.count)]


def copies(system: System, count: int) -> System:
    """One condition as a batch of equal ones.

    system: one condition
    """
    return rows(system, np.zeros(count, dtype=np.intp))

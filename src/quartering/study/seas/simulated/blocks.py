"""Simulation of a ship in a sea, block by block: a seed a block, sums in the order of the blocks, kept in a file if asked."""

# A block is half an hour with a seed of its own, after a run-up that does not count. Blocks are run in rows of 64; rows are
# shared by threads, but their sums are added in the order of the rows, so that nothing hangs on how many threads there are,
# and a longer run goes through the same blocks first.

from __future__ import annotations

import io
import math
import time
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.publish import publish
from quartering._machine.threads import spread
from quartering.conventions import InputError
from quartering.motion.sea.march import NONE, RUN_UP, SUMS, march
from quartering.motion.sea.synthesis import RECORDS, Record, series_of
from quartering.motion.transient.rk4 import Alike

Floats = NDArray[np.float64]
Single = NDArray[np.float32]

BLOCK: Final = 1800.0
"""Length of a block [s]."""
FEWEST: Final = 20
"""Blocks before an error measured between them is believed."""
_AT_ONCE: Final = 128
_BETWEEN_WRITES: Final = 10.0


@dataclass(frozen=True, eq=False)
class Plan:
    """What every block of a condition needs.

    Parameters
    ----------
    equations : Alike
    record : Record
    step : float                 [s]
    first : int                  step that counts first, after the run-up
    speed : float                [m/s]
    place : (x, z)               of the lateral acceleration, from G, z down [m]
    limits : (roll, felt)        of a failure [rad], [m/s2]
    seed, condition : int        of all draws
    """

    equations: Alike
    record: Record
    step: float
    first: int
    speed: float
    place: tuple[float, float]
    limits: tuple[float, float]
    seed: int
    condition: int

    def row(self, number: int) -> Row:
        """Sums, largest values and failures of 64 blocks."""
        steps = self.first + round(BLOCK / self.step)
        forcing = series_of(self.record, self.seed, self.condition, RECORDS * number)
        sums, largest = np.zeros((SUMS, RECORDS)), np.zeros((2, RECORDS))
        until, cause = np.full(RECORDS, BLOCK), np.full(RECORDS, NONE, dtype=np.int64)
        march(
            self.equations, forcing, steps, self.first, self.step, self.speed, *self.place, *self.limits, sums, largest,
            until, cause,
        )  # fmt: skip
        return Row(sums, largest, until, cause)


@dataclass(frozen=True, eq=False)
class Row:
    """What one row of blocks gives; see `march`."""

    sums: Floats
    largest: Floats
    until: Floats
    cause: NDArray[np.int64]


class Blocks(NamedTuple):
    """Of each block, (n,) each.

    Parameters
    ----------
    roll, felt : float32    largest |roll| [rad] and lateral acceleration [m/s2]
    until : float32         time of the failure, or the length of a block [s]
    cause : int8            see `motion.sea.march`
    """

    roll: Single
    felt: Single
    until: Single
    cause: NDArray[np.int8]

    @property
    def counted(self) -> int:
        """How many did not fail in their run-up."""
        return int((self.cause != RUN_UP).sum())


def _blocks(count: int) -> Blocks:
    roll, felt, until = (np.zeros(count, dtype=np.float32) for _ in range(3))
    return Blocks(roll, felt, until, np.zeros(count, dtype=np.int8))


class Tally:
    """What all blocks so far give: sums over them, and of each block what extremes and failures need.

    Attributes
    ----------
    state : (done, total, products)    blocks, the (16,) sums of all, the last the steps counted, and the (16, 16) sums over
                                       blocks of the products of two of their sums: in one, so that an interrupt finds all
    """

    def __init__(self, state: tuple[int, Floats, Floats] | None = None, blocks: Blocks | None = None) -> None:
        self.state: tuple[int, Floats, Floats] = (0, np.zeros(SUMS), np.zeros((SUMS, SUMS))) if state is None else state
        self._blocks = _blocks(0) if blocks is None else blocks

    @property
    def blocks(self) -> Blocks:
        """Of each block done so far."""
        roll, felt, until, cause = self._blocks
        done = self.state[0]
        return Blocks(roll[:done], felt[:done], until[:done], cause[:done])

    def reserve(self, count: int) -> None:
        """Make room for as many blocks."""
        room, held = _blocks(max(count, self.state[0])), self.blocks
        pairs: Any = zip(room, held, strict=True)
        for one, old in pairs:
            one[: old.size] = old
        self._blocks = room

    def add(self, row: Row) -> None:
        """Add a row."""
        done, total, products = self.state
        found = (row.largest[0], row.largest[1], row.until, row.cause)
        pairs: Any = zip(self._blocks, found, strict=True)
        for one, values in pairs:
            one[done : done + RECORDS] = values
        self.state = (
            done + RECORDS,
            total + row.sums.sum(axis=1),
            products + np.einsum("al,bl->ab", row.sums, row.sums),
        )

    def mean(self, k: int) -> tuple[float, float]:
        """Mean of one of the sums over time, and its standard error between blocks."""
        _, total, products = self.state
        n, steps = self.blocks.counted, total[-1]
        if not steps > 0:
            return math.nan, math.nan
        mean = total[k] / steps
        square = products[k, k] - 2.0 * mean * products[k, -1] + mean**2 * products[-1, -1]
        error = math.sqrt(max(square, 0.0) * n / (n - 1)) / steps if n > 1 else math.nan
        return float(mean), float(error)

    @property
    def error_of_roll(self) -> float:
        """Relative standard error of the root mean square roll."""
        mean, error = self.mean(ROLL_SQUARED)
        return 0.5 * error / mean if mean > 0 else math.inf


ROLL_SQUARED: Final = 4
"""Which of the sums is roll squared."""


def run_blocks(plan: Plan, hours: float, enough: Callable[[Tally], bool] | None, file: Path | None, key: str) -> Tally:
    """Run the blocks of a condition.

    hours: to run at the least, in whole rows
    enough: asked before each row: may it stop before?
    file: where finished rows are kept, and gone on from; None: nowhere
    key: of the condition, which the file must be of
    """
    rows = max(1, math.ceil(hours * 3600.0 / (BLOCK * RECORDS)))
    tally = Tally() if file is None else _read(file, key)
    tally.reserve(rows * RECORDS)
    written = time.monotonic()
    try:
        for row in _in_order(plan, tally.state[0] // RECORDS, rows):
            if enough is not None and enough(tally):
                break
            tally.add(row)
            if file is not None and time.monotonic() - written > _BETWEEN_WRITES:
                _write(file, key, tally)
                written = time.monotonic()
    finally:  # an interrupt too leaves what is done
        if file is not None:
            _write(file, key, tally)
    return tally


def error_below(tally: Tally, share: float) -> bool:
    """Is the standard error of roll, measured between blocks, below a share of it?"""
    return tally.blocks.counted >= FEWEST and tally.error_of_roll <= share


def _in_order(plan: Plan, first: int, rows: int) -> Iterator[Row]:
    """Rows from the first on, each handed over when all before it are done."""
    for begin in range(first, rows, _AT_ONCE):
        numbers = list(range(begin, min(begin + _AT_ONCE, rows)))
        waiting: dict[int, Row] = {}
        following = 0
        for i, row in spread(plan.row, numbers):
            waiting[i] = row
            while following in waiting:
                yield waiting.pop(following)
                following += 1


def _write(file: Path, key: str, tally: Tally) -> None:
    buffer = io.BytesIO()
    done, total, products = tally.state
    np.savez(buffer, key=np.array(key), done=np.array(done), total=total, products=products, **tally.blocks._asdict())
    publish(file, buffer.getvalue())


def _read(file: Path, key: str) -> Tally:
    """What a file holds of this condition; nothing where there is none yet."""
    if not file.exists():
        return Tally()
    try:
        with np.load(file, allow_pickle=False) as kept:
            found = str(kept["key"])
            state = (int(kept["done"]), kept["total"], kept["products"])
            tally = Tally(state, Blocks(*(kept[name] for name in Blocks._fields)))
    except (OSError, ValueError, KeyError, zipfile.BadZipFile):
        raise InputError(f"store {file}: it is no file of a simulation in a sea; give another name") from None
    if found != key:
        raise InputError(
            f"store {file}: it holds blocks of another ship, sea, seed or setting, or of another version; give another name, or"
            " remove it to begin anew"
        )
    return tally

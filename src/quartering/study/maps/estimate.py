"""Cost estimate of a run: conditions, time, disk space, plausibility."""

from __future__ import annotations

import shutil
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from quartering._machine.threads import alone, workers
from quartering.conventions import InputError
from quartering.stability.precompile import announce_compilation
from quartering.study.grid import Grid
from quartering.study.maps.kinds import kind_of

LONGEST = 3600.0
"""Seconds a run may be expected to take without being confirmed."""
LARGEST = 10e9
"""Bytes a run may put on the disk without being confirmed."""
SECONDS_OF_A_BLOCK = 1.0
"""Time one block should take on one core."""
_FEWEST_IN_A_BLOCK = 32
_TRIES = 3


@dataclass(frozen=True)
class Estimate:
    """What a run will take.

    Parameters
    ----------
    conditions, blocks : int
    seconds : float             expected, on the cores of this process
    disk : float                expected [bytes]
    missed : tuple of str       parts of the grid that step over the roll resonance, in words
    """

    conditions: int
    blocks: int
    seconds: float
    disk: float
    missed: tuple[str, ...]

    @property
    def sentence(self) -> str:
        """The estimate in one line."""
        about = "" if self.seconds < 1 else "about "
        return (
            f"{self.conditions:,} conditions in {self.blocks} blocks: {about}{duration(self.seconds)} on {workers()} cores,"
            f" {self.disk / 1e6:,.0f} MB"
        )


def duration(seconds: float) -> str:
    """A time in the unit a person would choose."""
    if seconds < 1:
        return "less than 1 s"
    for limit, size, unit in ((90.0, 1.0, "s"), (5400.0, 60.0, "min"), (172800.0, 3600.0, "h")):
        if seconds < limit:
            return f"{seconds:.0f} s" if unit == "s" else f"{seconds / size:.1f} {unit}"
    return f"{seconds / 86400.0:.1f} days"


def estimate(grid: Grid) -> Estimate:
    """What computing a grid will take.

    Returns the time is that of about a thousand of its own conditions, spread over the grid, scaled up

    Kernels that are not yet compiled are compiled by this.
    """
    each = _seconds_each(grid, grid.sampled)
    if not grid.block_size:
        grid = grid.in_blocks_of(_size_of_blocks(grid, each))
    return Estimate(
        conditions=grid.count,
        blocks=len(grid.blocks),
        seconds=each * grid.count / min(workers(), len(grid.blocks)),
        disk=float(kind_of(grid).size * grid.count + 8000 * len(grid.blocks)),
        missed=kind_of(grid).missed(grid),
    )


def timed_block_size(grid: Grid) -> int:
    """Conditions of one block that takes about a second on one core, at most the usual number.

    Measured on a sixtieth of the grid's own conditions, a thousand at most, the best of three tries: what else the machine does
    at that moment has little part in it. A killed run loses the blocks being worked on: seconds, be the conditions cheap
    (the paper's method) or dear (harmonic balance to a high order).
    """
    return _size_of_blocks(grid, _seconds_each(grid, min(grid.sampled, max(grid.count // 60, 64))))


def _size_of_blocks(grid: Grid, each: float) -> int:
    return min(grid.usual_block_size, max(int(SECONDS_OF_A_BLOCK / each), _FEWEST_IN_A_BLOCK))


def _seconds_each(grid: Grid, most: int) -> float:
    """Time of one condition on one core, by up to `most` from all over the grid: the best of a few tries, compiled before."""
    announce_compilation()
    sample = _sampled(grid, most)
    evaluate = partial(kind_of(grid).evaluate, sample)
    alone(evaluate, 0)
    taken = []
    for _ in range(_TRIES):
        begin = time.perf_counter()
        for i in range(len(sample.blocks)):
            alone(evaluate, i)
        taken.append(time.perf_counter() - begin)
    return min(taken) / sample.count


def check_size(found: Estimate, folder: str | Path | None = None, *, yes: bool = False) -> None:
    """Refuse a run that is larger than a person may have meant.

    folder: where the results go
    yes: it is meant; only a disk that cannot hold it is refused then
    """
    if folder is not None:
        there = Path(folder)
        while not there.exists():
            there = there.parent
        free = shutil.disk_usage(there).free
        if found.disk > free:
            raise InputError(
                f"{found.sentence}; the disk of {there} has {free / 1e6:,.0f} MB free: give a folder on another disk, or"
                " fewer values on an axis"
            )
    if not yes and (found.seconds > LONGEST or found.disk > LARGEST):
        raise InputError(
            f"{found.sentence}, more than {duration(LONGEST)} or {LARGEST / 1e9:.0f} GB: confirm it with yes (--yes), take"
            " fewer values on an axis, or more cores (cluster)"
        )


def _sampled(grid: Grid, most: int) -> Grid:
    """A small grid from all over a large one."""
    axes, loadings = dict(grid.axes), dict(grid.loadings)
    if loadings:
        kept = _thinned(grid.loading_count, 3)
        loadings = {name: column[kept] for name, column in loadings.items()}
    left = most // max(1, min(grid.loading_count, 3))
    for name, few in zip(tuple(grid.axes)[::-1], (10, 4, 6, 3), strict=True):
        kept = _thinned(axes[name].size, min(few, max(1, left)))
        axes[name] = axes[name][kept]
        left //= max(1, len(kept))
    return replace(grid, axes=axes, loadings=loadings)


def _thinned(size: int, most: int) -> Sequence[int]:
    return np.unique(np.linspace(0, size - 1, min(size, most)).astype(int)).tolist()

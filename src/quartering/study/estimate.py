"""Before a large run: how many conditions, how long, how much disk, and whether the grid can see the roll resonance."""

from __future__ import annotations

import shutil
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hydro.calm_water import calm_water_exponents
from quartering.loads.waves import encounter_frequency
from quartering.study.conditions import FLAGS, RESULTS, evaluate_block
from quartering.study.grid import CONDITION_AXES, Grid
from quartering.threads import alone, workers

BYTES = sum(int(np.prod(extra)) * (1 if name in FLAGS else 8) for name, extra in RESULTS.items())
"""Disk and result memory of one condition."""
LONGEST = 3600.0
"""Seconds a run may be expected to take without being confirmed."""
LARGEST = 10e9
"""Bytes a run may put on the disk without being confirmed."""
SECONDS_OF_A_BLOCK = 1.0
"""Time one block should take on one core."""
_FEWEST_IN_A_BLOCK = 32
_SAMPLE = 1024
_LIGHTEST_WAVE_FROM_SIDE = 0.1


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
        return (
            f"{self.conditions:,} conditions in {self.blocks} blocks: about {duration(self.seconds)} on {workers()} cores,"
            f" {self.disk / 1e6:,.0f} MB"
        )


def duration(seconds: float) -> str:
    """A time in the unit a person would choose.

    Parameters
    ----------
    seconds : float

    Returns
    -------
    str

    Examples
    --------
    >>> duration(0.4), duration(25.2), duration(150.0), duration(7300.0), duration(3e5)
    ('less than 1 s', '25 s', '2.5 min', '2.0 h', '3.5 days')
    """
    if seconds < 1:
        return "less than 1 s"
    for limit, size, unit in ((90.0, 1.0, "s"), (5400.0, 60.0, "min"), (172800.0, 3600.0, "h")):
        if seconds < limit:
            return f"{seconds:.0f} s" if unit == "s" else f"{seconds / size:.1f} {unit}"
    return f"{seconds / 86400.0:.1f} days"


def estimate(grid: Grid) -> Estimate:
    """What computing a grid will take.

    Parameters
    ----------
    grid : Grid

    Returns
    -------
    Estimate    the time is that of about a thousand of its own conditions, spread over the grid, scaled up

    Notes
    -----
    Kernels that are not yet compiled are compiled by this.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> from quartering.study.grid import grid
    >>> estimate(grid(ship("wigley"), 5.0, [30.0, 60.0], 100.0, [1.0, 2.0])).conditions
    4
    """
    each = _seconds_each(grid)
    if not grid.block_size:
        grid = grid.in_blocks_of(_size_of_blocks(grid, each))
    return Estimate(
        conditions=grid.count,
        blocks=len(grid.blocks),
        seconds=each * grid.count / min(workers(), len(grid.blocks)),
        disk=float(BYTES * grid.count + 8000 * len(grid.blocks)),
        missed=missed_resonance(grid),
    )


def timed_block_size(grid: Grid) -> int:
    """Conditions of one block that takes about a second on one core, at most the usual number.

    Parameters
    ----------
    grid : Grid

    Returns
    -------
    int

    Notes
    -----
    Measured on about a thousand of the grid's own conditions. A killed run loses the blocks being worked on: seconds, be the
    conditions cheap (the paper's method) or dear (harmonic balance to a high order).

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> from quartering.study.grid import grid
    >>> some = grid(ship("wigley"), 5.0, [30.0, 60.0], 100.0, [1.0, 2.0])
    >>> 0 < timed_block_size(some) <= some.usual_block_size
    True
    """
    return _size_of_blocks(grid, _seconds_each(grid))


def _size_of_blocks(grid: Grid, each: float) -> int:
    return min(grid.usual_block_size, max(int(SECONDS_OF_A_BLOCK / each), _FEWEST_IN_A_BLOCK))


def _seconds_each(grid: Grid) -> float:
    """Time of one condition on one core, by some from all over the grid; compiles first."""
    sample = _sampled(grid)
    alone(lambda i: evaluate_block(sample, i), 0)
    begin = time.perf_counter()
    for i in range(len(sample.blocks)):
        alone(lambda j: evaluate_block(sample, j), i)
    return (time.perf_counter() - begin) / sample.count


def check_size(found: Estimate, folder: str | Path | None = None, *, yes: bool = False) -> None:
    """Refuse a run that is larger than a person may have meant.

    Parameters
    ----------
    found : Estimate
    folder : str or Path, optional    where the results go
    yes : bool                        it is meant; only a disk that cannot hold it is refused then

    Raises
    ------
    InputError    longer than an hour or more than 10 GB without `yes`, or more than the disk has free

    Examples
    --------
    >>> check_size(Estimate(10, 1, 0.1, 2e3, ()))
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


def missed_resonance(grid: Grid) -> tuple[str, ...]:
    """Parts of a grid that step over the roll resonance without a condition inside its peak.

    Parameters
    ----------
    grid : Grid

    Returns
    -------
    tuple of str    for each axis (wave length, speed) and loading concerned: the widest range missed, and what to add

    Notes
    -----
    The peak reaches from n2 (1 - zeta) to n2 (1 + zeta) in encounter frequency, zeta the damping of free roll in calm
    water at that speed (closed form, half power).  Lines along which no neighbouring values lie on the two sides of n2 are
    not concerned, nor are waves within 6 degrees of ahead or astern, which do not roll the ship.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> from quartering.study.grid import grid
    >>> missed_resonance(grid(ship("series60-cb60"), 5.0, [90.0], [60.0, 700.0], 1.0))[0][:42]
    'wave lengths between 60 and 700 m step ove'
    """
    speed, heading, length = (grid.axes[name] for name in CONDITION_AXES[:3])
    from_side = np.abs(np.sin(np.radians(heading))) > _LIGHTEST_WAVE_FROM_SIDE
    found: list[str] = []
    some = np.unique(np.linspace(0, grid.loading_count - 1, 9).astype(int))
    for i in some:
        n2, zeta = _free_roll(grid, int(i))
        said = _loading_words(grid, int(i))
        for axis, values, name, unit in ((2, length, "wave lengths", "m"), (0, speed, "speeds", "m/s")):
            found += _along(
                grid, axis, values, n2, zeta, from_side, f"{name} between {{:.4g}} and {{:.4g}} {unit}", said
            )
    return tuple(found)


def _along(
    grid: Grid,
    axis: int,
    values: NDArray[np.float64],
    n2: NDArray[np.float64],
    zeta: NDArray[np.float64],
    from_side: NDArray[np.bool_],
    words: str,
    said: str,
) -> list[str]:
    """Ranges missed along one axis, in one sentence."""
    if values.size < 2:
        return []
    speed, heading, length = (grid.axes[name] for name in CONDITION_AXES[:3])
    order = np.argsort(values)
    sigma = np.sqrt(2 * np.pi * GRAVITY / length)
    u, mu, s = np.meshgrid(speed, heading, sigma, indexing="ij")
    omega = np.abs(encounter_frequency(s, u, mu))
    off = omega / n2[:, None, None] - 1.0
    inside = np.abs(off) <= zeta[:, None, None]
    off = np.take(off, order, axis=axis).swapaxes(axis, 2)
    inside = np.take(inside, order, axis=axis).swapaxes(axis, 2)
    missed = (off[..., :-1] * off[..., 1:] < 0) & ~inside[..., :-1] & ~inside[..., 1:]
    missed &= from_side[None, :, None]  # heading stays in the middle whichever axis is followed
    if not missed.any():
        return []
    lines, gaps = int(missed.any(axis=2).sum()), np.flatnonzero(missed.any(axis=(0, 1)))
    low, high = values[order][gaps[0]], values[order][gaps[-1] + 1]
    where = np.argwhere(missed)[0]
    share = abs(off[tuple(where)]) / (abs(off[tuple(where)]) + abs(off[where[0], where[1], where[2] + 1]))
    a, b = values[order][where[2]], values[order][where[2] + 1]
    finest = float(np.min(zeta)) * (b - a) / float(np.abs(off[where[0], where[1], where[2] + 1] - off[tuple(where)]))
    return [
        f"{words.format(low, high)} step over the roll resonance on {lines} of {missed.shape[0] * missed.shape[1]} lines{said};"
        f" add values near {a + share * (b - a):.4g}, or take steps of {finest:.2g} there"
    ]


def _free_roll(grid: Grid, index: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Natural frequency [rad/s] and fraction of critical damping of free roll at each speed, for one loading."""
    ship = grid.loaded(index)
    n2, zeta = [], []
    for u in grid.axes["speed"]:
        z = np.asarray(calm_water_exponents(ship, float(u)))
        roll = z[np.argmax(z.imag)]
        n2.append(max(abs(roll), 1e-6))
        zeta.append(min(max(-roll.real / max(abs(roll), 1e-6), 1e-3), 1.0))
    return np.array(n2), np.array(zeta)


def _loading_words(grid: Grid, index: int) -> str:
    if not grid.loadings:
        return ""
    return " (" + ", ".join(f"{name} {column[index]:.4g}" for name, column in grid.loadings.items()) + ")"


def _sampled(grid: Grid) -> Grid:
    """A small grid from all over a large one."""
    axes, loadings = dict(grid.axes), dict(grid.loadings)
    if loadings:
        kept = _thinned(grid.loading_count, 3)
        loadings = {name: column[kept] for name, column in loadings.items()}
    left = _SAMPLE // max(1, min(grid.loading_count, 3))
    for name, most in (("wave_height", 10), ("speed", 3), ("wave_length", 4), ("heading", 6)):
        kept = _thinned(axes[name].size, min(most, max(1, left)))
        axes[name] = axes[name][kept]
        left //= max(1, len(kept))
    return replace(grid, axes=axes, loadings=loadings)


def _thinned(size: int, most: int) -> Sequence[int]:
    return np.unique(np.linspace(0, size - 1, min(size, most)).astype(int)).tolist()

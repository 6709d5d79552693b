"""Sweeps: speed, heading, wave length, wave height, and any loading or coefficient."""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, Unpack

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import DamageWarning
from quartering.doors import takes
from quartering.hull.option_types import StudyAxes
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.motion.modes import Modes, in_six
from quartering.study.grid import Grid, grid
from quartering.study.maps.estimate import timed_block_size
from quartering.study.maps.executor import check_cluster, computed, reached
from quartering.study.maps.kinds import kind_of
from quartering.study.maps.result import in_memory, open_result
from quartering.study.maps.stored.block_file import counted
from quartering.study.maps.stored.store import Store, begun_block_size, block_counts, open_store, write_block
from quartering.study.six_modes.grid import in_six_modes


@takes(ship="Ship")
def sweep(
    ship: Ship,
    speed: ArrayLike | str,
    heading: ArrayLike | str,
    wave_length: ArrayLike | str | None = None,
    wave_height: ArrayLike | str | None = None,
    *,
    wave_period: ArrayLike | str | None = None,
    steepness: ArrayLike | str | None = None,
    harmonics: int = 1,
    form: Form = "stf",
    modes: Modes = "three",
    progress: Callable[[int, int], None] | None = None,
    store: str | Path | None = None,
    cluster: str | None = None,
    factors: Mapping[str, ArrayLike] | None = None,
    values: Mapping[str, ArrayLike] | None = None,
    **axes: Unpack[StudyAxes],
) -> xr.Dataset:
    """Response and stability over a grid of conditions and loadings.

    Parameters
    ----------
    ship : Ship
    speed : (u,) float          [m/s]; here and below numbers, text with a unit ("15kn", ["0.8L", "1.2L"]) or a range
                                ("0..18 kn step 1")
    heading : (h,) float        [deg]
    wave_length : (w,) float    [m]
    wave_height : (a,) float    crest to trough [m]
    wave_period : (w,) float    in place of wave_length [s]
    steepness : (a,) float      H/lambda, in place of wave_height: the waves of all lengths are as steep [1]
    harmonics : int             of the steady motion: 1 is the paper's method
    form : str                  of the diffraction force
    modes : str                 "three": sway, roll and yaw; "six": heave and pitch too, as in `polar`
    progress : function(done, total), optional
    store : str or Path         folder the results are put in block by block, for studies larger than memory or longer than
                                patience: a second call with the same case computes only what is missing
    cluster : str, optional     "local:4" or "tcp://host:8786": computed by worker processes; by default by threads
    factors, values : mapping   by coefficient: factors on it, or values in its place, one or several; an axis each
    **axes : (l,) float         values of the ship (`StudyAxes` lists them: gm, kg, gyradius_roll, roll_period, draught, ..),
                                and, in short, factors on coefficients by name (K_p=[0.5, 1, 2]); every combination is one
                                "loading"

    Returns
    -------
    xarray.Dataset    dims (loading where axes are given) speed, heading, wave_length, wave_height (or steepness, along which
                      and along wave_length ``wave_height`` [m] then goes); ``sway_amplitude`` [m], ``roll_amplitude``,
                      ``yaw_amplitude`` [deg], ``roll_peak``, ``k2``, ``q``, ``exponent`` [1/s], ``verdict``, ``status``, ..

    Raises
    ------
    InputError        an axis that is empty or not numbers, both wave_height and steepness, a wave that breaks, an unknown
                      loading or coefficient, a store that holds another case or cannot be written

    Notes
    -----
    Forces are computed once for all wave heights and heights of G.  Source: [H71].

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = sweep(ship("wigley"), speed=5.0, heading=[30, 60], wave_length=100.0, wave_height=[1.0, 2.0], K_p=[0.5, 1.0])
    >>> dict(ds.sizes)["loading"], ds["roll_amplitude"].dims
    (2, ('loading', 'speed', 'heading', 'wave_length', 'wave_height'))
    """
    wanted = grid(
        ship, speed, heading, wave_length, wave_height, wave_period=wave_period, steepness=steepness, harmonics=harmonics,
        form=form, factors=factors, values=values, **axes,
    )  # fmt: skip
    if in_six(modes):
        wanted = in_six_modes(wanted)

    def told(done: int, _: Counter[str]) -> None:
        if progress is not None:
            progress(done, wanted.count)

    if store is not None:
        return filled(wanted, store, cluster=cluster, told=told)
    return evaluated(wanted, cluster=cluster, told=told)


def evaluated(
    wanted: Grid, *, cluster: str | None = None, told: Callable[[int, Counter[str]], None] | None = None
) -> xr.Dataset:
    """Every condition of a grid, in memory.

    wanted: its loadings need not be all combinations of anything
    cluster: as in `sweep`
    told: called after each block
    Returns as from `sweep`
    """
    found: dict[int, Any] = {}
    kind = kind_of(wanted)

    def keep(index: int, block: dict[str, Any]) -> dict[str, int]:
        found[index] = block
        return counted(block, kind)

    total: Counter[str] = Counter()
    with reached(cluster) as client:
        for _, counts_of_block in computed(wanted, range(len(wanted.blocks)), keep, client):
            total.update(counts_of_block)
            if told is not None:
                told(conditions_of(total), total)
    kind.warn(wanted, total)
    return in_memory(wanted, found, kind.heading(wanted))


def in_pieces(wanted: Grid, together: int = 1) -> Iterator[tuple[int, xr.Dataset]]:
    """Every condition of a grid, some blocks at a time: who asks for the next piece has the thread to itself between.

    together: blocks of a piece, worked on by all cores
    Yields (conditions done, dataset of the whole grid with NaN, and what stands for unknown flags, where none is yet)
    """
    kind = kind_of(wanted)
    found: dict[int, Any] = {i: _unknown(wanted, i) for i in range(len(wanted.blocks))}
    total: Counter[str] = Counter()
    heading = kind.heading(wanted)

    def keep(index: int, block: dict[str, Any]) -> dict[str, int]:
        found[index] = block
        return counted(block, kind)

    for first in range(0, len(wanted.blocks), together):
        some = range(first, min(first + together, len(wanted.blocks)))
        for _, counts in computed(wanted, some, keep):
            total.update(counts)
        if some.stop == len(wanted.blocks):
            kind.warn(wanted, total)
        yield conditions_of(total), in_memory(wanted, found, heading)


def _unknown(wanted: Grid, index: int) -> dict[str, Any]:
    """What stands in a block that nobody has computed yet."""
    block, kind = wanted.blocks[index], kind_of(wanted)
    points = block.points.stop - block.points.start
    shape = (block.loadings.stop - block.loadings.start, points, wanted.sea_count)
    whole = {
        name: np.full((*shape, *extra), kind.flags.get(name, np.nan), kind.dtype(name))
        for name, extra in kind.results.items()
    }
    return whole | {name: np.full(points, np.nan) for name in kind.of_points}


def filled(
    wanted: Grid, folder: str | Path, *, cluster: str | None, told: Callable[[int, Counter[str]], None]
) -> xr.Dataset:
    """The result in a store, computed as far as it is missing."""
    kind_of(wanted).warn(wanted, fill(wanted, folder, cluster=cluster, told=told))
    return open_result(folder)


def fill(
    wanted: Grid,
    folder: str | Path,
    *,
    cluster: str | None = None,
    told: Callable[[int, Counter[str]], None] | None = None,
) -> Counter[str]:
    """Compute what is missing of a grid into a store.

    cluster: as in `sweep`
    told: called at the start with what was there, and after each block
    Returns numbers of conditions by "verdict n", "status n", "beyond", the old blocks' included

    However it ends, the blocks finished stay, and the next call goes on from them; every byte of theirs is held against its
    checksum, and damaged blocks are computed again.  Their size is chosen when a store is begun,
    by the time a condition takes here, and stays with it: the numbers do not depend on it.  Memory holds the blocks being
    worked on and nothing else.
    """
    check_cluster(cluster)
    wanted = sized(wanted, folder)
    with reached(cluster) as client:  # before anything is written
        return _filled(wanted, open_store(folder, wanted), client, told)


def _filled(wanted: Grid, store: Store, client: Any, told: Callable[[int, Counter[str]], None] | None) -> Counter[str]:
    """Counts of a store's conditions after the missing blocks are computed."""
    damaged = store.damaged()
    missing = sorted({*store.missing(), *damaged})
    _tell(store, damaged)
    todo = set(missing)
    total: Counter[str] = Counter()
    for i in range(len(wanted.blocks)):
        if i not in todo:
            total.update(block_counts(store, i))
    if told is not None:
        told(conditions_of(total), total)

    def keep(index: int, found: dict[str, Any]) -> dict[str, int]:
        return write_block(store, index, found, wanted)

    for _, counts in computed(wanted, _in_turn(wanted, missing), keep, client):
        total.update(counts)
        if told is not None:
            told(conditions_of(total), total)
    return total


def _tell(store: Store, damaged: list[int]) -> None:
    """Say which blocks are not what was written, and are computed again."""
    if damaged:
        some = ", ".join(map(str, damaged[:5])) + (", .." if len(damaged) > 5 else "")
        warnings.warn(
            f'store "{store.folder}": {len(damaged)} of {store.count} blocks are damaged ({some}): their checksums do not fit;'
            " they are computed again",
            DamageWarning,
            stacklevel=5,
        )


def sized(wanted: Grid, folder: str | Path) -> Grid:
    """The grid in blocks as its store was begun with, or of about a second where none is begun."""
    begun = begun_block_size(folder)
    if begun is not None:
        return wanted.in_blocks_of(begun)
    return wanted if wanted.block_size else wanted.in_blocks_of(timed_block_size(wanted))


def _in_turn(wanted: Grid, missing: list[int]) -> list[int]:
    """Blocks in the order they are begun: the smallest alone, which compiles, then the large ones before the small."""
    sizes = {
        i: (b.points.stop - b.points.start) * (b.loadings.stop - b.loadings.start) for i, b in enumerate(wanted.blocks)
    }
    ordered = sorted(missing, key=lambda i: -sizes[i])
    return ordered[-1:] + ordered[:-1]


def conditions_of(counts: Counter[str]) -> int:
    """Number of conditions counted so far.

    counts: as from `fill`

    >>> conditions_of(Counter({"status 0": 3, "status 2": 1, "verdict 0": 4}))
    4
    """
    return sum(number for key, number in counts.items() if key.startswith("status "))

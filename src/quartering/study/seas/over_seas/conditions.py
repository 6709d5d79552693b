"""Response, largest motions, failures and advice at many conditions in irregular seas: the path of every map of seas."""

# The forces of all wave cells of a speed are found once and kept while its conditions are worked on. Each condition is closed
# by itself; where that does not decide, it is simulated, half hours after half hours, until it does or the hours are used up.

from __future__ import annotations

import math
import threading
import warnings
from collections import OrderedDict
from collections.abc import Mapping
from concurrent.futures import Future
from itertools import product
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import RangeWarning
from quartering.hull.ship import Ship
from quartering.loads.sea.cells import wave_cells
from quartering.loads.sea.sea import STEEP_SEA, STEEPEST_SEA, Sea
from quartering.motion.sea.equations import SeaEquations, equations_of_ship, free_roll_of
from quartering.study.seas.over_seas.advice import Advice, Judged, advised, judged_by_closure, judged_by_simulation
from quartering.study.seas.over_seas.grid import SeaGrid
from quartering.study.seas.over_seas.settings import TWO_PEAKED
from quartering.study.seas.response import LEAST_DAMPING, Answer, SeaStatus, answer_of, place_of, status_of
from quartering.study.seas.simulated.asked import asked_of, felt_limit_of, roll_limit_of
from quartering.study.seas.simulated.blocks import FEWEST, Tally, run_blocks
from quartering.study.seas.simulated.planned import known_of, planned
from quartering.study.seas.simulated.simulated_dataset import simulated_dataset

Floats = NDArray[np.float64]
_KEPT_SPEEDS: Final = 4
_MOST_LOST: Final = 0.05
"""Share of blocks that fail in their run-up, above which a condition is not recommended whatever the rest gives [1]."""

RESULTS: Final[dict[str, tuple[int, ...]]] = dict.fromkeys(
    (
        "roll_rms", "roll_period", "roll_mean_3h_max", "roll_3h_max_lower", "roll_3h_max_upper",
        "lateral_acceleration_rms", "lateral_acceleration_3h_max", "lateral_acceleration_3h_max_lower",
        "lateral_acceleration_3h_max_upper", "failures", "exposure", "failure_rate", "rate_lower", "rate_upper", "n2", "k2",
        "exponent", "overtaken", "near_zero", "cut_off", "status", "rung", "recommended",
    ),
    (),
)  # fmt: skip
"""Name of every result, and the shape it adds to that of the conditions."""


NOT_KNOWN, CLOSURE, SIMULATION = -1, 2, 3
RUNGS: Final = {NOT_KNOWN: "none", CLOSURE: "statistical_linearisation", SIMULATION: "simulation"}
"""How a condition was answered: its place among the methods, and its name."""
UNKNOWN: Final[dict[str, int]] = {"status": SeaStatus.NOT_CONVERGED, "rung": NOT_KNOWN, "recommended": Advice.UNDECIDED}
"""What stands where nothing is known."""


class At(NamedTuple):
    """A ship at one speed: its equations over all wave cells, and what it is judged against."""

    ship: Ship
    speed: float
    equations: SeaEquations
    roll_frequency: float
    place: tuple[float, float]
    limits: tuple[float, float]


_lock = threading.Lock()
_kept: OrderedDict[tuple[str, int, float], Future[At]] = OrderedDict()


def evaluate_sea_block(grid: SeaGrid, index: int) -> dict[str, NDArray[np.generic]]:
    """Results of one block of a grid: a function of nothing but the two.

    Returns `RESULTS` with leading shape (loadings, points, heights)

    >>> from quartering.hull.file.read import ship
    >>> from quartering.study.seas.over_seas.grid import sea_grid
    >>> found = evaluate_sea_block(sea_grid(ship("wigley"), 5.0, [30, 60], [1, 2], tp=8), 0)
    >>> found["roll_rms"].shape, sorted(set(found["rung"].ravel().tolist()))
    ((1, 2, 2), [2])
    """
    block = grid.blocks[index]
    u, mu, period = grid.points(block.points)
    heights = grid.axes["hs"]
    shape = (block.loadings.stop - block.loadings.start, u.size, heights.size)
    results: dict[str, NDArray[np.generic]] = {
        name: np.full(shape, UNKNOWN[name], np.int8) if name in UNKNOWN else np.full(shape, np.nan) for name in RESULTS
    }
    for i, loading in enumerate(range(block.loadings.start, block.loadings.stop)):
        for j in range(u.size):
            at = _at(grid, loading, float(u[j]))
            for k, hs in enumerate(heights.tolist()):
                sea = grid.sea_at(hs, float(period[j]), float(mu[j]))
                found = _no_sea() if sea is None else _condition(grid, at, sea)
                for name, value in found.items():
                    results[name][i, j, k] = value
    return results


def _at(grid: SeaGrid, loading: int, speed: float) -> At:
    """Equations of a loading at a speed, made once though several threads ask."""
    key = (grid.digest, loading, speed)
    with _lock:
        mine = key not in _kept
        if mine:
            _kept[key] = Future()
            while len(_kept) > _KEPT_SPEEDS:
                _kept.popitem(last=False)
        future = _kept[key]
    if mine:
        try:
            future.set_result(_made(grid, loading, speed))
        except BaseException as error:
            with _lock:
                _kept.pop(key, None)
            future.set_exception(error)
    return future.result()


def _made(grid: SeaGrid, loading: int, speed: float) -> At:
    """Equations over the cells of all seas of the grid: they do not hang on how it is divided into blocks."""
    ship = grid.loaded(loading) if grid.loadings else grid.ship
    frequency, damping = free_roll_of(ship, speed)
    cells = wave_cells(_seas_of(grid), speed, frequency, max(damping, LEAST_DAMPING))
    limits = (roll_limit_of(ship, None)[0], felt_limit_of(ship, None, None))
    return At(ship, speed, equations_of_ship(ship, cells, grid.form), frequency, place_of(ship, None), limits)


def _seas_of(grid: SeaGrid) -> list[Sea]:
    """Seas that have the bands and directions of all seas of a grid."""
    # the band of a sea with one peak follows from its period alone: one height stands for all
    heights = grid.axes["hs"].tolist() if grid.spectrum == TWO_PEAKED else [float(grid.axes["hs"].min())]
    swell = () if grid.swell is None else grid.swell.partitions
    lines = grid.spreading is None or any(one.spreading is None for one in swell)
    headings = grid.axes["heading"] if lines else grid.axes["heading"][:1]
    every = product(heights, grid.axes[grid.period].tolist(), headings.tolist())
    return [sea for one in every if (sea := grid.sea_at(*one)) is not None]


def _no_sea() -> dict[str, Any]:
    return {"status": SeaStatus.BREAKS, "recommended": Advice.NOT_VALID}


def _condition(grid: SeaGrid, at: At, sea: Sea) -> dict[str, Any]:
    """Results of one condition, by name."""
    answer = answer_of(at.equations, sea, at.place, None, None, at.roll_frequency)
    status = status_of(answer, at.ship, 3.0)
    found = dict(zip(("overtaken", "near_zero", "cut_off"), answer.shares, strict=True)) | {"status": status}
    if status == SeaStatus.SURF_RIDING:
        return found | {"recommended": Advice.NOT_VALID}
    judged = judged_by_closure(answer.moments, at.limits)
    advice = Advice.UNDECIDED
    if status != SeaStatus.NOT_CONVERGED:
        found |= _told(judged, CLOSURE) | _of_closure(answer)
        advice = advised(grid.judge, grid.threshold, at.limits, judged)
        if status == SeaStatus.UNSTABLE and advice == Advice.RECOMMENDED:
            advice = Advice.UNDECIDED
    if advice == Advice.UNDECIDED and grid.hours > 0:
        return found | _simulated(grid, at, sea)
    return found | {"recommended": advice}


def _of_closure(answer: Answer) -> dict[str, float]:
    moments = answer.moments
    return {
        "roll_rms": math.degrees(math.sqrt(moments.roll[0])),
        "roll_period": moments.roll_period,
        "lateral_acceleration_rms": math.sqrt(moments.acceleration[0]),
        "n2": answer.n2,
        "k2": answer.k2,
        "exponent": float(answer.exponents.real[0]),
    }


def _told(judged: Judged, rung: int) -> dict[str, float]:
    roll, felt, rate = judged
    return {
        "roll_mean_3h_max": roll.value, "roll_3h_max_lower": roll.lower, "roll_3h_max_upper": roll.upper,
        "lateral_acceleration_3h_max": felt.value, "lateral_acceleration_3h_max_lower": felt.lower,
        "lateral_acceleration_3h_max_upper": felt.upper,
        "failure_rate": rate.value, "rate_lower": rate.lower, "rate_upper": rate.upper, "rung": rung,
    }  # fmt: skip


def _simulated(grid: SeaGrid, at: At, sea: Sea) -> dict[str, Any]:
    """Results of a simulation that ends as soon as it decides."""
    asked = asked_of(at.ship, sea, at.speed, None, grid.seed, True, None, grid.form)
    ready = planned(asked)
    known = known_of(asked, ready)

    def advice(tally: Tally) -> Advice:
        blocks = tally.blocks
        if blocks.cause.size - blocks.counted > _MOST_LOST * blocks.cause.size:
            return Advice.NOT_RECOMMENDED
        judged = judged_by_simulation(simulated_dataset(tally, known))
        return advised(grid.judge, grid.threshold, at.limits, judged)

    def decided(tally: Tally) -> bool:
        return tally.state[0] >= FEWEST and advice(tally) != Advice.UNDECIDED

    tally = run_blocks(ready.plan, grid.hours, decided, None, "")
    found = simulated_dataset(tally, known)
    own = {name: float(found[name]) for name in ("roll_rms", "lateral_acceleration_rms", "failures", "exposure")}
    return own | _told(judged_by_simulation(found), SIMULATION) | {"recommended": advice(tally)}


def warn_of_seas(grid: SeaGrid, counts: Mapping[str, int]) -> None:
    """Say how many conditions of a map are not valid, and why, and how many of its seas are steep."""
    steep = grid.steepness
    doubtful = int(((steep > STEEP_SEA) & (steep <= STEEPEST_SEA)).sum())
    if doubtful:
        words = f"{doubtful} of {steep.size} seas are steeper than {STEEP_SEA:g}: linear waves are doubtful"
        warnings.warn(words, RangeWarning, stacklevel=4)
    for status, words in (
        (SeaStatus.SURF_RIDING, "have much energy near encounter frequency 0: surf-riding and broaching, not valid"),
        (SeaStatus.BREAKS, "are of seas that break: not computed"),
        (SeaStatus.NOT_CONVERGED, "have no Gaussian motion: simulate them (hours)"),
    ):
        number = counts.get(f"status {int(status)}", 0)
        if number:
            warnings.warn(f"{number} of {grid.count} conditions {words}", RangeWarning, stacklevel=4)

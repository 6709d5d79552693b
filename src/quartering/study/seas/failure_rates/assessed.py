"""Cells of a direct assessment answered: failures counted until their rate is known well enough, or carried down in height."""

# All heights of one speed, heading and period are one block, worked on from the highest down. Where three of them have thirty
# failures, the line ln r = a - b/Hs^2 through them foretells the next: where its rate is too low to be counted in the hours
# there are, it stands for the cell; further than two decades down the rate is below that of the next higher sea.

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.hull.ship import Ship
from quartering.motion.sea.march import NONE, RUN_UP
from quartering.study.seas.failure_rates.assessment_grid import Assessed, AssessmentGrid
from quartering.study.seas.simulated.asked import asked_of
from quartering.study.seas.simulated.blocks import BLOCK, Plan, Tally, run_blocks
from quartering.study.seas.simulated.failures import Rate, failure_rate, waiting_times_p
from quartering.study.seas.simulated.planned import planned
from quartering.study.seas.simulated.rare import FEWEST_FAILURES, FEWEST_HEIGHTS, failure_rate_at

Floats = NDArray[np.float64]
RESULTS: Final[dict[str, tuple[int, ...]]] = dict.fromkeys(
    (
        "failures",
        "exposure",
        "failure_rate",
        "rate_lower",
        "rate_upper",
        "waiting_time_p",
        "lost",
        "lost_expected",
        "status",
    ),
    (),
)
"""Name of every result, and the shape it adds to that of the conditions."""
UNKNOWN: Final = {"status": Assessed.NOT_KNOWN}
"""What stands where nothing is known."""
MOST_LOST: Final = 0.05
"""Share of blocks that fail in their run-up beyond what the rate foretells, above which it is warned of [1]."""


class Counted(NamedTuple):
    """Failures of one cell.

    Parameters
    ----------
    failures : int
    exposure : float          until failure or end, run-up left out [s]
    rate : Rate               [1/s]
    enough : bool             is its interval small enough?
    waiting_time_p : float    of the times to failure as far from exponential ones
    lost : float              share of blocks that failed in their run-up
    lost_expected : float     the same by the rate
    """

    failures: int
    exposure: float
    rate: Rate
    enough: bool
    waiting_time_p: float
    lost: float
    lost_expected: float


class Wanted(NamedTuple):
    """How exactly the rate of a cell has to be known.

    Parameters
    ----------
    weight : float       share of the ship's time
    precision : float    half width of the interval over the contribution
    allowed : float      half width that is small enough whatever the contribution [1/s]
    """

    weight: float
    precision: float
    allowed: float

    def met(self, rate: Rate) -> bool:
        """Is an interval small enough?"""
        half = 0.5 * self.weight * (rate.upper - rate.lower)
        return half <= max(self.precision * self.weight * rate.rate, self.allowed)


_ANYHOW: Final = Wanted(1.0, math.inf, math.inf)


def counted(plan: Plan, hours: float, wanted: Wanted) -> Counted:
    """Failures of a condition, counted until their rate is known well enough or the hours are spent.

    hours: budget [h], in whole rows of 64 half hours
    """
    tally = run_blocks(plan, hours, lambda one: one.state[0] > 0 and wanted.met(_rate(one)[2]), None, "")
    failures, exposure, rate = _rate(tally)
    blocks = tally.blocks
    failed = (blocks.cause != NONE) & (blocks.cause != RUN_UP)
    p = waiting_times_p(blocks.until[failed].astype(float), BLOCK, rate.rate)
    lost, expected = 1.0 - blocks.counted / blocks.cause.size, -math.expm1(-rate.rate * plan.first * plan.step)
    return Counted(failures, exposure, rate, wanted.met(rate), p, lost, expected)


def _rate(tally: Tally) -> tuple[int, float, Rate]:
    """Failures, exposure [s] and rate of what was run so far."""
    blocks = tally.blocks
    inside = blocks.cause != RUN_UP
    failures, exposure = int((inside & (blocks.cause != NONE)).sum()), float(blocks.until[inside].astype(float).sum())
    return failures, exposure, failure_rate(failures, exposure)


def evaluate_assessment_block(grid: AssessmentGrid, index: int) -> dict[str, NDArray[np.generic]]:
    """Results of one block of a grid: a function of nothing but the two.

    Returns `RESULTS` with leading shape (loadings, points, heights)
    """
    block = grid.blocks[index]
    task = grid.task[block.loadings, block.points]
    results: dict[str, NDArray[np.generic]] = {name: np.full(task.shape, np.nan) for name in RESULTS}
    results["status"] = task.copy()
    for i, loading in enumerate(range(block.loadings.start, block.loadings.stop)):
        ship = grid.loaded(loading) if grid.loadings else grid.ship
        for j, point in enumerate(range(block.points.start, block.points.stop)):
            for k, found in _column(grid, ship, loading, point).items():
                for name, value in found.items():
                    results[name][i, j, k] = value
    return results


def _column(grid: AssessmentGrid, ship: Ship, loading: int, point: int) -> dict[int, dict[str, Any]]:
    """Results of the heights of one point that are not left out, the highest first."""
    speed, heading, period = (float(one[0]) for one in grid.points(slice(point, point + 1)))
    heights, allowed = grid.axes["hs"], grid.allowed(loading)
    task = grid.task[loading, point]
    todo = np.flatnonzero(np.isin(task, (Assessed.NOT_KNOWN, Assessed.TOO_RARE)))
    results: dict[int, dict[str, Any]] = {}
    line: list[tuple[float, int, float]] = []
    above = math.inf
    for k in todo[np.argsort(-heights[todo], kind="stable")].tolist():
        wanted = Wanted(float(grid.weight[point, k]), grid.precision, allowed)
        rare = task[k] == Assessed.TOO_RARE
        found = _carried_down(float(heights[k]), line, above, grid.hours, _ANYHOW if rare else wanted)
        if rare:
            if found is not None and found["status"] == Assessed.EXTRAPOLATED:
                results[k] = found
            continue
        if found is None:
            sea = grid.sea_at(float(heights[k]), period, heading)
            assert sea is not None  # seas that break are left out
            plan = planned(asked_of(ship, sea, speed, None, grid.seed, True, None, grid.form)).plan
            own = counted(plan, grid.hours, wanted)
            if own.failures >= FEWEST_FAILURES:
                line.append((float(heights[k]), own.failures, own.exposure))
            found = _of_count(own) | {
                "failures": own.failures,
                "exposure": own.exposure / 3600.0,
                "waiting_time_p": own.waiting_time_p,
                "lost": own.lost,
                "lost_expected": own.lost_expected,
            }
        above = found["rate_upper"] if found["rate_upper"] == found["rate_upper"] else math.inf
        results[k] = found
    return results


def _of_count(own: Counted) -> dict[str, Any]:
    """Rate and status of a count; nothing is known where every block failed in its run-up."""
    if not own.exposure > 0:
        return dict.fromkeys(("failure_rate", "rate_lower", "rate_upper"), math.nan) | {"status": Assessed.NOT_KNOWN}
    return _told(own.rate, Assessed.COUNTED if own.enough else Assessed.BUDGET_SPENT)


def _told(rate: Rate, status: Assessed) -> dict[str, Any]:
    return {"failure_rate": rate.rate, "rate_lower": rate.lower, "rate_upper": rate.upper, "status": status}


def _carried_down(
    hs: float, line: Sequence[tuple[float, int, float]], above: float, hours: float, wanted: Wanted
) -> dict[str, Any] | None:
    """The rate of a height by higher ones; None where it has to be counted.

    line: heights, failures and exposures [s] with failures enough
    above: upper end of the rate of the next higher sea [1/s]
    """
    if len(line) < FEWEST_HEIGHTS:
        return None
    heights, failures, exposure = zip(*line[-FEWEST_HEIGHTS:], strict=True)
    try:
        found = failure_rate_at(hs, heights, failures, np.array(exposure) / 3600.0)
    except InputError:  # no line, or too far below it
        bound = Rate(0.0, 0.0, above)
        return _told(bound, Assessed.BELOW_HIGHER_SEA) if wanted.met(bound) else None
    rate = Rate(found.rate, found.lower, found.upper)
    countable = rate.rate * 3600.0 * hours >= FEWEST_FAILURES
    return None if countable or not wanted.met(rate) else _told(rate, Assessed.EXTRAPOLATED)


def often_lost(found: Mapping[str, NDArray[np.generic]]) -> dict[str, int]:
    """Number of cells of which more blocks fail in their run-up than the rate foretells."""
    lost, expected = (np.nan_to_num(found[name].astype(float)) for name in ("lost", "lost_expected"))
    return {"often lost": int((lost - expected > MOST_LOST).sum())}


def warn_of_lost(grid: AssessmentGrid, counts: Mapping[str, int]) -> None:
    """Say how many cells lose many blocks to their run-up."""
    if number := counts.get("often lost", 0):
        words = (
            f"{number} of {grid.count} cells fail in their run-ups, which are not counted, more often by {MOST_LOST:.0%} than"
            " their rate foretells: the motion grows from rest, and their rates are too low"
        )
        warnings.warn(words, RangeWarning, stacklevel=4)

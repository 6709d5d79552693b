"""Growth of small disturbances of the motion in a sea: the largest Lyapunov exponent, and that of their mean square."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering._machine.threads import spread_in_order
from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea
from quartering.motion.equations.model import Model
from quartering.motion.sea.equations import Force
from quartering.motion.sea.synthesis import RECORDS, series_of
from quartering.motion.sea.windows import growth_of_disturbances
from quartering.study.dataset import made_by
from quartering.study.seas.dataset import name_of, scalars, sea_coordinates
from quartering.study.seas.simulated.asked import asked_of
from quartering.study.seas.simulated.blocks import BLOCK, Plan
from quartering.study.seas.simulated.planned import planned

Floats = NDArray[np.float64]
FEWEST: Final = 20
"""Blocks without a failure that an exponent and its error are told of at least."""


@takes(ship="Ship, Model", form="word")
def lyapunov(
    ship: Ship | Model,
    sea: Sea,
    speed: float | str,
    heading: float | str | None = None,
    *,
    hours: float = 32.0,
    seed: int = 0,
    memory: bool = True,
    force: Force | None = None,
    form: Form = "stf",
) -> xr.Dataset:
    """Growth rate of small disturbances along the nonlinear motion in a sea, with its standard error.

    Parameters
    ----------
    ship, sea, speed, heading, memory, force, form    as of `irregular`
    hours : float      to simulate at the least, in blocks of half an hour; 64 of them are run at a time [h]
    seed : int         the records are those of `irregular` with the same seed

    Returns
    -------
    Dataset            lyapunov and lyapunov_error: largest exponent, below 0 where disturbances die out in almost every record;
                       mean_square and mean_square_error: growth rate of their mean square, halved, so that both are of the
                       amplitude: above 0 with the other below 0 there are rare, large excursions [1/s]; blocks counted and
                       failed

    Raises
    ------
    InputError         what `irregular` refuses; fewer than 20 blocks without a failure

    Notes
    -----
    d' = J(y(t), t) d along the simulated y. Each block gives ln|d| over its time; the mean of these is the exponent, their
    variance v over time adds g(2)/2 = lambda + v to the mean square: of second order in the logarithm, exact for weak noise.
    A heading is in the exponent only through an autopilot.  Source: [H71] eq. (8) along a random motion; Oseledets' theorem.
    Valid: as `irregular`; blocks that fail do not count.

    Examples
    --------
    >>> import quartering as qt
    >>> found = lyapunov(qt.ship("wigley"), qt.Sea(hs=1, tp=8, heading=60), 5.0)
    >>> bool(found["lyapunov"] < 0), bool(found["mean_square"] >= found["lyapunov"])
    (True, True)
    """
    asked = asked_of(ship, sea, speed, heading, seed, memory, force, form)
    plan = planned(asked).plan
    rows = max(1, math.ceil(number(None, "simulated_hours", hours) * 3600.0 / (BLOCK * RECORDS)))
    found = spread_in_order(lambda row: _row(plan, row), range(rows))
    growth, time = (np.concatenate([part[k] for part in found]) for k in (0, 1))
    whole = time > (1.0 - 1e-9) * BLOCK
    if whole.sum() < FEWEST:
        raise InputError(
            f"{int(whole.sum())} of {whole.size} blocks of half an hour end without a failure; {FEWEST} are needed: simulate"
            " more hours, or take a lower sea"
        )
    return _dataset(asked.sea, growth[whole] / BLOCK, whole.size, {
        "ship": name_of(ship),
        "seas": asked.sea.words, "speed": asked.speed, "seed": asked.seed, "hours": rows * RECORDS * BLOCK / 3600.0,
    })  # fmt: skip


def _row(plan: Plan, row: int) -> tuple[Floats, Floats]:
    """Growth of the logarithm and its time (W,), of 64 blocks."""
    steps = plan.first + round(BLOCK / plan.step)
    forcing = series_of(plan.record, plan.seed, plan.condition, RECORDS * row)
    growth, time = np.zeros(RECORDS), np.zeros(RECORDS)
    states = plan.equations.program.states
    start = np.full(states, 1.0 / math.sqrt(states))
    growth_of_disturbances(
        plan.equations, forcing, steps, plan.first, plan.step, plan.limits[0], start, growth, time
    )  # fmt: skip
    return growth, time


def _dataset(sea: Sea, rates: Floats, blocks: int, about: dict[str, Any]) -> xr.Dataset:
    n = rates.size
    largest, variance = float(rates.mean()), float(rates.var(ddof=1))
    error = math.sqrt(variance / n)
    # v = variance of ln|d| over time; the error of a variance of n normal values is sqrt(2/(n - 1)) of it
    noise = variance * BLOCK
    rows = {
        "lyapunov": (
            largest,
            "1/s",
            "largest Lyapunov exponent: growth rate of small disturbances in almost every record",
        ),
        "lyapunov_error": (error, "1/s", "its standard error, measured between blocks"),
        "mean_square": (largest + noise, "1/s", "half the growth rate of their mean square, to second order"),
        "mean_square_error": (math.hypot(error, noise * math.sqrt(2.0 / (n - 1))), "1/s", "its standard error"),
        "blocks": (n, "1", "blocks of half an hour that count"),
        "failed": (blocks - n, "1", "blocks that ended with a failure, which do not"),
    }
    heads = {"title": "Stability of the motion in an irregular sea", "references": "H71, Tucker84", "source": made_by()}
    return xr.Dataset(scalars(rows), sea_coordinates([sea], {}, {}), heads | about)

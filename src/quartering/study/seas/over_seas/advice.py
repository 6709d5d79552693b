"""Operational guidance: whether a condition is recommended, judged by intervals of its largest motion or of its failures."""

# An interval on one side of its limit decides; one that straddles it does not. That of the closure's largest motion runs from
# Vanmarcke's mean, which counts groups of swings, over 1.15 to Rice's, which counts every swing: all twelve seas compared with
# simulation lay within it (docs/a_real_sea.md). Its rate of failures is Rice's for a Gaussian motion, which a softening ship
# has not: a factor of 100 to either side is left open. A simulation has its own errors: 1.96 standard errors of a mean, the
# exact interval of a Poisson count.

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import IntEnum
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import NORMAL_95
from quartering.study.seas.moments import Moments
from quartering.study.seas.over_seas.settings import Judge

Floats = NDArray[np.float64]

CLOSURE_OVER: Final = 1.15
"""Largest motion of the closure over that simulated, at most, as found in twelve seas [1]."""
RATE_OPEN: Final = 100.0
"""Factor that a Gaussian rate of failures is left open by, to either side [1]."""


class Advice(IntEnum):
    """What guidance says of a condition.

    Examples
    --------
    >>> Advice.UNDECIDED.label
    'undecided'
    """

    RECOMMENDED = 0
    NOT_RECOMMENDED = 1
    UNDECIDED = 2
    NOT_VALID = 3

    @property
    def label(self) -> str:
        """In words."""
        return self.name.lower().replace("_", " ")


class Estimate(NamedTuple):
    """A value and the ends of its interval."""

    value: float
    lower: float
    upper: float


class Judged(NamedTuple):
    """What a condition is judged by: largest roll [deg] and lateral acceleration [m/s2] of three hours, failures [1/s]."""

    roll: Estimate
    felt: Estimate
    rate: Estimate


def judged_by_closure(moments: Moments, limits: tuple[float, float]) -> Judged:
    """What the closure gives.

    limits: roll [rad] and lateral acceleration [m/s2] of a failure
    """
    largest, felt = moments.roll_largest(3.0), moments.acceleration_largest(3.0)
    degrees = math.degrees(math.sqrt(moments.roll[0]))
    rms = math.sqrt(moments.acceleration[0])
    rate = crossings(moments.roll, limits[0]) + crossings(moments.acceleration, limits[1])
    return Judged(
        Estimate(degrees * largest[1], degrees * largest[1] / CLOSURE_OVER, degrees * largest[3]),
        Estimate(rms * felt[1], rms * felt[1] / CLOSURE_OVER, rms * felt[3]),
        Estimate(rate, rate / RATE_OPEN, rate * RATE_OPEN),
    )


def crossings(m: Sequence[float] | Floats, limit: float) -> float:
    """Rate at which a Gaussian motion of moments m leaves a limit to either side [1/s]: Rice's, at most.

    >>> round(crossings((1.0, 1.0, 1.0), 3.0), 7)  # exp(-9/2)/pi
    0.0035361
    """
    if not (m[0] > 0 and math.isfinite(limit)):
        return 0.0
    return math.sqrt(m[2] / m[0]) / math.pi * math.exp(-0.5 * limit**2 / m[0])


def judged_by_simulation(found: xr.Dataset) -> Judged:
    """What a simulation gives."""

    def mean(name: str) -> Estimate:
        value, error = float(found[f"{name}_mean_largest"]), NORMAL_95 * float(found[f"{name}_mean_largest_error"])
        return Estimate(value, value - error, value + error)

    rate = (float(found[name]) for name in ("failure_rate", "rate_lower", "rate_upper"))
    return Judged(mean("roll"), mean("lateral_acceleration"), Estimate(*rate))


def advised(judge: Judge, threshold: float, limits: tuple[float, float], found: Judged) -> Advice:
    """What intervals say: one beyond its limit decides, else one that straddles it leaves all undecided.

    >>> some = Judged(Estimate(15, 13, 18), Estimate(1, 1, 1), Estimate(1e-9, 1e-11, 1e-7))
    >>> [advised(judge, limit, (0.7, math.inf), some).label for judge, limit in (("largest", 2.0), ("rate", 1e-8))]
    ['recommended', 'undecided']
    """
    if judge == "rate":
        return _side(found.rate, threshold)
    sides = [
        _side(one, limit / threshold)
        for one, limit in ((found.roll, math.degrees(limits[0])), (found.felt, limits[1]))
        if math.isfinite(limit)
    ]
    return next((one for one in (Advice.NOT_RECOMMENDED, Advice.UNDECIDED) if one in sides), Advice.RECOMMENDED)


def _side(one: Estimate, limit: float) -> Advice:
    """On which side of a limit an interval lies; one that is not known straddles it."""
    if one.upper <= limit:
        return Advice.RECOMMENDED
    return Advice.NOT_RECOMMENDED if one.lower > limit else Advice.UNDECIDED

"""Rare events from simulations: largest rolls beyond those seen, and rates of failure at lower seas, each with its interval."""

# Block maxima, generalised extreme values:    P(largest of a block < x) = exp(-(1 + k (x - m)/s)^(-1/k))
# Excesses over a threshold, generalised Pareto: P(excess > y) = (1 + k y/s)^(-1/k)
#
# The level not passed in n blocks with probability 1/e is put in place of the location (or scale), so that its profile
# likelihood can be followed: all levels whose likelihood is within chi2/2 of the largest form the interval. Through the largest
# righting moment the law of the tail changes: a level whose interval reaches there is refused.
#
# Rates over wave height: ln r = a - b/Hs^2, as for a linear ship, weighted by the failures; the interval is that of counts
# drawn anew.

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Final, Literal, NamedTuple, get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering._machine.piecewise import zero
from quartering.conventions import InputError
from quartering.hull.told import count, number, numbers
from quartering.option_checks import quoted

Floats = NDArray[np.float64]
Tail = Literal["gev", "gpd"]
FEWEST_LARGEST: Final = 20
"""Values that a tail is fitted to at the least."""
FEWEST_FAILURES, FEWEST_HEIGHTS, MOST_DECADES = 30, 3, 2.0
"""Failures at each wave height, heights, and decades below the least rate counted: beyond, an extrapolation is refused."""
_SHARE_ABOVE: Final = 0.2
_DRAWS: Final = 2000
_FIRST_SHAPE: Final = -0.05
_IMPOSSIBLE: Final = (
    1e9  # loss where a value cannot be of the distribution; finite, since a simplex of infinities has no size
)
_LEAST_SHAPE, _MOST_SHAPE = -0.9, 0.9


class Level(NamedTuple):
    """A level and its interval, and the shape of the tail: below 0 it ends, 0 is exponential.

    Parameters
    ----------
    value, lower, upper : float
    shape : float
    """

    value: float
    lower: float
    upper: float
    shape: float


def largest_roll(found: xr.Dataset, hours: float, tail: Tail = "gev", confidence: float = 0.95) -> Level:
    """Largest roll of more hours than were simulated, with its profile interval.

    found: from `irregular`
    hours: the level that is passed in so many hours with probability 1 - 1/e [h]
    tail: "gev": largest values of 3 h; "gpd": excesses of the largest of half an hour over their upper fifth
    confidence: of the interval
    Returns [deg]

    Maximum likelihood; the interval is where twice the loss of likelihood is below chi2.  Source: [Coles01].
    Valid: failures are rare, and the righting arm still rises.
    """
    wanted, confidence = number(None, "simulated_hours", hours), number(None, "confidence", confidence)
    if tail not in get_args(Tail):
        raise InputError(f"tail = {quoted(tail)}; allowed: gev, gpd; try 'gev'")
    if not isinstance(found, xr.Dataset) or "roll_largest" not in found:
        raise InputError(
            f"found = {quoted(type(found).__name__)} is no simulation; give what quartering.irregular returns"
        )
    if int(found["failures"]):
        raise InputError(
            f"{int(found['failures'])} of the blocks ended with a failure: their largest roll was not seen; take the rate of"
            " failures, or a lower sea"
        )
    largest = found["roll_largest"].values
    largest = largest[np.isfinite(largest)]
    level = _gev(largest, wanted, confidence) if tail == "gev" else _gpd(largest, wanted, confidence)
    arm = float(found.attrs["largest_arm"])
    if level.upper > arm:
        raise InputError(
            f"the largest roll of {wanted:g} h, {level.value:.3g} deg (to {level.upper:.3g}), reaches the largest righting arm"
            f" at {arm:.3g} deg: beyond it the tail is another; take failure_rate_at of higher seas"
        )
    return level


def _gev(half_hours: Floats, hours: float, confidence: float) -> Level:
    values = half_hours[: half_hours.size // 6 * 6].reshape(-1, 6).max(axis=1)
    _enough(values.size, "largest values of 3 h")
    blocks, spread = max(hours / 3.0, 1.0), values.std() * math.sqrt(6.0) / math.pi

    def loss(level: float, shape: float, log_scale: float) -> float:
        # level x: n (1 + k (x - m)/s)^(-1/k) = 1
        scale = spread * math.exp(log_scale)
        location = level - scale * _power(math.log(blocks), shape)
        z = (values - location) / scale
        t = 1.0 + shape * z
        if t.min() <= 0:
            return _IMPOSSIBLE
        y = np.log(t) / shape if abs(shape) > 1e-8 else z
        return float(values.size * math.log(scale) + ((1.0 + shape) * y + np.exp(-y)).sum())

    start = values.mean() - 0.577 * spread + spread * math.log(blocks)
    return _profiled(loss, start, spread, [_FIRST_SHAPE, 0.0], confidence)


def _gpd(half_hours: Floats, hours: float, confidence: float) -> Level:
    threshold = float(np.quantile(half_hours, 1.0 - _SHARE_ABOVE))
    excess = half_hours[half_hours > threshold] - threshold
    _enough(excess.size, "excesses")
    times = max(2.0 * hours * excess.size / half_hours.size, 1.0 + 1e-9)

    def loss(level: float, shape: float) -> float:
        own = (level - threshold) / _power(math.log(times), shape)  # the scale that gives the level
        t = 1.0 + shape * excess / own if own > 0 else np.zeros(1)
        if t.min() <= 0:
            return _IMPOSSIBLE
        y = np.log(t) / shape if abs(shape) > 1e-8 else excess / own
        return float(excess.size * math.log(own) + ((1.0 + shape) * y).sum())

    return _profiled(loss, threshold + excess.mean() * math.log(times), 1.0, [_FIRST_SHAPE], confidence)


def _power(log: float, shape: float) -> float:
    """(n^k - 1)/k of ln n."""
    return math.expm1(shape * log) / shape if abs(shape) > 1e-8 else log


def _enough(count: int, words: str) -> None:
    if count < FEWEST_LARGEST:
        raise InputError(f"{count} {words}; a tail needs {FEWEST_LARGEST} at least: simulate more hours")


def _profiled(
    loss: Callable[..., float], start: float, scale: float, others: Sequence[float], confidence: float
) -> Level:
    """Most likely level, and where the likelihood of others has fallen by half of chi2; `loss` of it, the shape, and more."""

    from scipy import optimize
    from scipy.stats import chi2

    minimize: Any = optimize.minimize  # its stubs know no function of a plain array

    def bounded(level: float, shape: float, *more: float) -> float:
        if not _LEAST_SHAPE < shape < _MOST_SHAPE or not all(abs(one) < 20 for one in more):
            return _IMPOSSIBLE
        return loss(level, shape, *more)

    best = minimize(lambda p: bounded(start + scale * p[0], *p[1:]), [0.0, *others], method="Nelder-Mead",
                    options={"xatol": 1e-5, "fatol": 1e-8, "maxiter": 4000})  # fmt: skip
    value, inner = start + scale * best.x[0], np.array(best.x[1:])
    allowed = best.fun + 0.5 * float(chi2.ppf(confidence, 1))

    def beyond(level: float) -> float:
        found = minimize(lambda p: bounded(level, *p), inner, method="Nelder-Mead",
                         options={"xatol": 1e-4, "fatol": 1e-6})  # fmt: skip
        return min(float(found.fun), 1e6) - allowed

    ends = []
    for sign in (-1.0, 1.0):
        step = 0.5 * scale
        while beyond(value + sign * step) < 0 and step < 1e3 * scale:
            step *= 1.6
        ends.append(zero(lambda x: beyond(value + sign * x), 0.0, step, xtol=1e-3 * step))  # noqa: B023
    return Level(float(value), float(value - ends[0]), float(value + ends[1]), float(best.x[1]))


class RateAt(NamedTuple):
    """Rate of failures at a wave height by the line over others, and its interval [1/s].

    Parameters
    ----------
    rate, lower, upper : float
    decades : float               below the least rate counted
    """

    rate: float
    lower: float
    upper: float
    decades: float


def failure_rate_at(
    hs: float | str,
    heights: ArrayLike,
    failures: ArrayLike,
    exposure: ArrayLike,
    *,
    confidence: float = 0.95,
    seed: int = 0,
) -> RateAt:
    """Rate of failures at a wave height at which they are too rare to count, from heights at which they are not.

    hs: wave height wanted [m]
    heights (n,): at which failures were counted, three at least [m]
    failures (n,): 30 at least at each
    exposure (n,): [h]
    confidence: of the interval, from counts drawn anew

    ln r = a - b/Hs^2, weighted by the failures: exact for a linear ship, whose roll is Gaussian.  Source: MSC.1/Circ.1627 asks
    for as much, recalled, unverified.  Valid: the same ship, speed, heading, period and spectrum at all heights.
    """
    h, wanted = np.atleast_1d(numbers(None, "hs", heights)), number(None, "hs", hs)
    k, hours = np.atleast_1d(numbers(None, "failures", failures)), np.atleast_1d(numbers(None, "exposure", exposure))
    confidence, seed = number(None, "confidence", confidence), count("seed", seed, 0, 0)
    if not h.shape == k.shape == hours.shape or h.size < FEWEST_HEIGHTS or np.unique(h).size < FEWEST_HEIGHTS:
        raise InputError(
            f"heights {h.shape}, failures {k.shape}, exposure {hours.shape}: give the same number of each, of"
            f" {FEWEST_HEIGHTS} different heights at least"
        )
    if not (k >= FEWEST_FAILURES).all() or not (hours > 0).all():
        raise InputError(
            f"failures = {int(k.min())} at one height; each needs {FEWEST_FAILURES} at least, and an exposure above 0: simulate"
            " more hours there"
        )
    seconds = 3600.0 * hours
    intercept, slope = _line(h, k, seconds)
    if not slope > 0:
        raise InputError("the rates do not rise with wave height: no line tells what lower seas have; count there")
    rate = math.exp(intercept - slope / wanted**2)
    decades = math.log10(float((k / seconds).min()) / rate)
    if decades > MOST_DECADES:
        raise InputError(
            f"Hs = {wanted:g} m: the line gives {rate:.2g} 1/s, {decades:.1f} decades below the least rate counted; at most"
            f" {MOST_DECADES:g} are answered for: count failures at a lower sea too"
        )
    draws = np.random.default_rng(seed).poisson(k, size=(_DRAWS, k.size))
    lines = [_line(h, np.maximum(one, 1.0), seconds) for one in draws.astype(float)]
    rates = np.exp([a - b / wanted**2 for a, b in lines])
    tail = 0.5 * (1.0 - confidence)
    lower, upper = np.quantile(rates, [tail, 1.0 - tail])
    return RateAt(rate, float(lower), float(upper), decades)


def _line(h: Floats, k: Floats, seconds: Floats) -> tuple[float, float]:
    """a and b of ln r = a - b/Hs^2, weighted by the failures."""
    matrix = np.stack([np.ones_like(h), -1.0 / h**2], axis=1)
    root = np.sqrt(k)
    a, b = np.linalg.lstsq(matrix * root[:, None], root * np.log(k / seconds), rcond=None)[0]
    return float(a), float(b)

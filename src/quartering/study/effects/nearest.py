"""The change of one value nearest to none that makes a motion stable: a search that asks, for others to answer in batches.

The searches of several parameters go on side by side.  Each is a generator: it yields factors on its parameter, with how they
are to be judged, and receives the leading exponents there.  So that a batch of conditions holds what all of them ask.

Along a parameter the exponent is smooth but where a motion appears or vanishes, where it jumps.  A ladder of values, the
nearest first, finds a step with an unstable and a stable end; sections of it narrow a crossing down to where the exponent is
nearly straight, or to a jump; and the ship itself settles it: by the secant where the exponent is smooth, by stepping to the
stable side where it jumps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from typing import NamedTuple

import numpy as np

from quartering.motion.equations.system import Floats

REACH = 5.0
"""Largest factor that is tried, and one over the smallest."""
_STEPS = 32
_CHUNKS = (4, 12, _STEPS)
"""Steps of the ladder to either side of 1, and how far it is asked at once: most cures are near."""

INSIDE = 1e-6
"""How far below minus the margin the exponent is at a cure [1/s]: beyond what a verdict's error may turn."""

_SECTIONS, _ROUNDS = 9, 5
"""Of a step of the ladder, and how often: 9^5 parts of 5 % are 1e-6."""
_SMOOTH, _SECANTS, _FARTHEST = 0.02, 4, 0.1
"""Change of the exponent between two neighbours that is no jump [1/s]; steps of the secant, and the longest (of log factor)."""
_BACK = 1e-6
"""Share of a value by which a cure stays away from a fold: nearer, rounding decides to which motion rest leads."""
_NUDGES = np.array([1e-4, 1e-3, 1e-2])
_UNITS = 4
"""Units of the last digit that are tried at once where the rounded value is not stable."""


class Asked(NamedTuple):
    """Factors whose leading exponents a search wants next.

    Parameters
    ----------
    factors : (n,) float    on the parameter
    settled : bool          by the ship itself, as accurate as a verdict; else by equations interpolated between ships
    """

    factors: Floats
    settled: bool


class Reached(NamedTuple):
    """The factors between which a parameter can be asked: low <= 1 <= high."""

    low: float
    high: float


Search = Generator[Asked, Floats, float | None]
Span = Callable[[float, float], Reached]
Told = Callable[[float, int], float]


def rounded(value: float, now: float, decimals: int, units: int = 0) -> float:
    """A value to some decimals, never short of it on the way from `now`; and units of the last decimal farther."""
    scaled = value * 10.0**decimals
    more = value > now
    whole = math.ceil(scaled - 1e-6) + units if more else math.floor(scaled + 1e-6) - units
    return round(whole * 10.0**-decimals, decimals)


def nearest(span: Span, reach: Reached, present: float, target: float, told: Told) -> Search:
    """Factor nearest to 1 (in ratio) at which the ship is stable, and stays so where the value is rounded as it is told.

    span: prepares the equations between two factors; says between which they could be made
    reach: factors with which there is a ship and a wave
    present: exponent at factor 1, above the target [1/s]
    target: exponent of a cure [1/s]
    told: factor of the value as it is told, some units of its last digit farther from the present one
    Yields what is to be judged next; `send` the exponents (n,), infinite where there is no motion
    Returns None where no change helps
    """
    steps = np.geomspace(1.0, REACH, _STEPS + 1)
    sides = [_Side(1.0 / steps, present), _Side(steps, present)]
    first = 1
    for last in _CHUNKS:
        ends = [float(np.clip(side.factors[last], reach.low, reach.high)) for side in sides]
        low, high = span(*ends)
        asked = [side.within(first, last, low, high) for side in sides]
        factors = np.concatenate(asked)
        if factors.size:
            growth = yield Asked(factors, False)
            for side, own in zip(sides, np.split(growth, [asked[0].size]), strict=True):
                side.found = np.append(side.found, own)
        crossed = [(b, side) for side in sides if side.open and (b := side.bracket(target)) is not None]
        for bracket, side in sorted(crossed, key=lambda pair: abs(math.log(pair[0].stable))):
            side.open = False
            factor = yield from _settled(bracket, target, told)
            if factor is not None:
                return factor
        first = last + 1
    return None


class _Bracket(NamedTuple):
    """Two neighbouring factors, one with an unstable motion or none and one with a stable one, and their exponents."""

    unstable: float
    stable: float
    growth: tuple[float, float]


class _Side:
    """The ladder to one side of the present value."""

    def __init__(self, factors: Floats, present: float) -> None:
        self.factors, self.found, self.open = factors, np.array([present]), True

    def within(self, first: int, last: int, low: float, high: float) -> Floats:
        """Rungs first..last between two factors; none once a crossing has been looked into, or a rung is missing."""
        rungs = self.factors[first : last + 1]
        possible = (rungs > low * (1 - 1e-12)) & (rungs < high * (1 + 1e-12))
        return rungs[possible] if self.open and self.found.size == first else rungs[:0]

    def bracket(self, target: float) -> _Bracket | None:
        """The first rung below the target, with the one before it."""
        inside = self.found < target
        if not inside.any():
            return None
        i = int(inside.argmax())
        return _Bracket(
            float(self.factors[i - 1]), float(self.factors[i]), (float(self.found[i - 1]), float(self.found[i]))
        )


def _settled(bracket: _Bracket, target: float, told: Told) -> Search:
    """The crossing in a bracket: narrowed down, settled by the ship itself, and stable as it is told."""
    away = math.copysign(1.0, bracket.stable - bracket.unstable)
    start, slope = bracket.stable, math.nan
    for _ in range(_ROUNDS):
        bracket = yield from _narrower(bracket, target)
        rise, apart = bracket.growth[1] - bracket.growth[0], math.log(bracket.stable / bracket.unstable)
        start, slope = bracket.stable, rise / apart
        if math.isfinite(rise) and 0.0 < abs(rise) < _SMOOTH:
            start *= math.exp(min(1.0, max((target - bracket.growth[1]) / rise, -1.0)) * apart)
            break
    factor = yield from _by_the_ship(start, slope, away, target)
    if factor is None:
        return None
    return (yield from _as_told(factor, bracket.stable, target, told))


def _narrower(bracket: _Bracket, target: float) -> Generator[Asked, Floats, _Bracket]:
    """The first section of a bracket, from its unstable end, in which the exponent passes the target."""
    factors = np.geomspace(bracket.unstable, bracket.stable, _SECTIONS + 1)
    growth = yield Asked(factors[1:-1], False)
    growth = np.concatenate([bracket.growth[:1], growth, bracket.growth[1:]])
    i = max(1, int((growth < target).argmax()))
    return _Bracket(float(factors[i - 1]), float(factors[i]), (float(growth[i - 1]), float(growth[i])))


def _by_the_ship(factor: float, slope: float, away: float, target: float) -> Search:
    """A factor near an interpolated one at which the ship itself is stable with the margin: by the secant, or beyond it."""
    good, before = None, None
    for _ in range(_SECANTS):
        growth = float((yield Asked(np.array([factor]), True))[0])
        if growth < target + 0.5 * INSIDE:
            good = factor
            if growth > target - INSIDE:
                return good
        if before is not None and math.isfinite(growth) and growth != before[1]:
            slope = (growth - before[1]) / math.log(factor / before[0])
        if not math.isfinite(growth) or not slope or not abs(step := (target - growth) / slope) <= _FARTHEST:
            break
        before = factor, growth
        factor *= math.exp(step)
    if good is not None:  # the exponent bends down to a fold here: a step back from where motions end
        back = good * (1.0 + _BACK * away)
        return back if (yield Asked(np.array([back]), True))[0] < target + 0.5 * INSIDE else good
    beyond = factor * (1.0 + _NUDGES * away)  # the equations were interpolated, or the exponent jumps here
    inside = (yield Asked(beyond, True)) < target + 0.5 * INSIDE
    return float(beyond[inside.argmax()]) if inside.any() else None


def _as_told(factor: float, stable: float, target: float, told: Told) -> Search:
    """The factor, where the ship is stable at the value as it is told too; else the first told value beyond at which it is."""
    if (yield Asked(np.array([told(factor, 0)]), True))[0] < target + 0.5 * INSIDE:
        return factor
    units = 1
    while abs(math.log(told(factor, units))) < abs(math.log(stable)) + _FARTHEST:
        farther = np.array([told(factor, units + i) for i in range(_UNITS)])
        inside = (yield Asked(farther, True)) < target + 0.5 * INSIDE
        if inside.any():
            return float(farther[inside.argmax()])
        units += _UNITS
    return None

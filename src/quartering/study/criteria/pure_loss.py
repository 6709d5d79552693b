"""Pure loss of stability on a wave crest: least GM, and the angles of the righting arm in waves as long as the ship."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from quartering.study.criteria.constants import limit
from quartering.study.criteria.in_waves import HEELS, arms, gm_least
from quartering.study.criteria.parametric_rolling import by_waterplanes
from quartering.study.criteria.particulars import Particulars
from quartering.study.criteria.record import Judgement, Quantity, not_judged
from quartering.study.criteria.sea_states import effective_deviation, scatter

Floats = NDArray[np.float64]

_STEEPNESSES = np.arange(11) / 100
_NONE = 90.0
"""Angle [deg] where no equilibrium exists under the lever, and where GZ does not vanish up to 70 deg: a convention."""


def level1(p: Particulars) -> Judgement:
    """Least GM in the wave of steepness 0.0334, by the lower waterplane and in the wave itself."""
    applies, reason = _applies(p)
    steepness = limit("pure_loss.steepness")
    low = by_waterplanes(p, steepness)[1]
    by_planes = p.kb + low / p.volume - p.kg
    in_wave = gm_least(p, p.length, steepness * p.length)
    least = limit("pure_loss.gm_limit")
    flares = p.reserve_ratio >= limit("pure_loss.reserve_ratio")
    passed = (flares and by_planes >= least) or in_wave >= least
    return Judgement(
        "pure_loss", 1,
        (
            Quantity("gm_min_waterplane", by_planes, "m", "by the lower waterplane"),
            Quantity("gm_min_waves", in_wave, "m", "least over ten crest positions"),
            Quantity("reserve_ratio", p.reserve_ratio, "1", "volume above the waterline over that of vertical sides"),
            Quantity("froude", p.froude, "1", "of the service speed"),
        ),
        not passed,
        reason or f"least GM {by_planes:.3g} m by waterplanes, {in_wave:.3g} m in waves; {least:g} m asked", applies=applies,
        notes=p.depth_note,
    )  # fmt: skip


def _applies(p: Particulars) -> tuple[bool, str]:
    above = limit("pure_loss.applies_above")
    if math.isnan(p.froude) or p.froude > above:
        return True, ""
    return False, f"Froude number {p.froude:.3g} is not above {above:g}"


def angles(p: Particulars) -> Floats:
    """Least vanishing angle and largest heel under the lever [deg], (11, 2), for heights 0 to 0.1 L.

    The lever 8 (H/lambda) d Fn^2 heels the ship to the first angle at which GZ has risen to it.
    """
    found = np.empty((_STEEPNESSES.size, 2))
    for i, steepness in enumerate(_STEEPNESSES):
        lever = limit("pure_loss.heeling_lever") * steepness * p.draught * p.froude**2
        rows = arms(p, p.length, steepness * p.length)
        found[i] = min(_vanishing(row) for row in rows), max(_heel_under(row, lever) for row in rows)
    return found


def balanced(p: Particulars) -> Iterator[None]:
    """Balance the waves of the second level one height at a time; `angles` then finds them ready."""
    for steepness in _STEEPNESSES:
        arms(p, p.length, steepness * p.length)
        yield


def _vanishing(arm: Floats) -> float:
    """First heel at which an arm that rights becomes 0 [deg]; 0 where it never rights, 90 where it does not vanish."""
    positive = np.flatnonzero(arm[1:] > 0) + 1
    if positive.size == 0:
        return 0.0
    gone = np.flatnonzero((arm[:-1] > 0) & (arm[1:] <= 0) & (np.arange(arm.size - 1) >= positive[0]))
    return _crossing(arm, int(gone[0])) if gone.size else _NONE


def _heel_under(arm: Floats, lever: float) -> float:
    """First stable heel under a lever [deg]: where GZ rises through it; 90 where it never does."""
    rest = arm - lever
    rises = np.flatnonzero((rest[:-1] <= 0) & (rest[1:] > 0))
    return _crossing(rest, int(rises[0])) if rises.size else _NONE


def _crossing(arm: Floats, i: int) -> float:
    step = HEELS[i + 1] - HEELS[i]
    return float(HEELS[i] + step * arm[i] / (arm[i] - arm[i + 1]))


def level2(p: Particulars) -> Judgement:
    """CR1 and CR2: shares of sea states in whose effective wave the ship loses its arm, or heels too far."""
    applies, reason = _applies(p)
    most = limit("pure_loss.limit")
    if math.isnan(p.speed):
        return not_judged("pure_loss", 2, ("cr1", "cr2"), "needs the service speed")
    table = scatter()
    by_height = angles(p)
    heights = np.minimum(
        limit("effective_wave.three_percent") * effective_deviation(p.length, table.hs[:, None], table.tz),
        _STEEPNESSES[-1] * p.length,
    )
    vanishing, heel = (np.interp(heights, _STEEPNESSES * p.length, column) for column in by_height.T)
    lost = float(table.weight[vanishing < limit("pure_loss.least_vanishing_angle")].sum())
    heeled = float(table.weight[heel > limit("pure_loss.largest_heel")].sum())
    low, high = _bracket(p, heights, by_height[:, 1], table.weight)
    value = max(lost, heeled)
    return Judgement(
        "pure_loss", 2,
        (
            Quantity("cr1", lost, "1", f"vanishing angle below 30 deg, up to {most:g}"),
            Quantity("cr2", heeled, "1", f"heel under the lever above 25 deg, up to {most:g}"),
            Quantity("cr2_low", low, "1", "with the step to no equilibrium at the upper of two heights"),
            Quantity("cr2_high", high, "1", "with that step at the lower of them"),
        ),
        value > most, reason or f"the larger of CR1 {lost:.3g} and CR2 {heeled:.3g}; up to {most:g}", applies=applies,
        notes=("where no equilibrium exists under the lever the heel is taken as 90 deg, a convention that decides CR2",),
        cases=tuple(
            {"wave_height": float(s * p.length), "vanishing_angle": float(v), "heel": float(h)}
            for s, (v, h) in zip(_STEEPNESSES, by_height, strict=True)
        ),
    )  # fmt: skip


def _bracket(p: Particulars, heights: Floats, heel: Floats, weight: Floats) -> tuple[float, float]:
    """CR2 with the jump to no equilibrium at either end of the step in height it lies in."""
    grid, most = _STEEPNESSES * p.length, limit("pure_loss.largest_heel")
    too_far = np.flatnonzero(heel > most)
    if too_far.size == 0 or too_far[0] == 0:
        whole = float(weight.sum()) if too_far.size else 0.0
        return whole, whole
    upper, lower = grid[too_far[0]], grid[too_far[0] - 1]
    return float(weight[heights >= upper].sum()), float(weight[heights > lower].sum())

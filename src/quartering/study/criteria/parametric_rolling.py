"""Parametric rolling: GM in waves against R_PR of the damping, the 2:1 resonance in 16 wave cases, and the roll itself."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from quartering.study.criteria.constants import limit
from quartering.study.criteria.in_waves import gm_mean, gm_variation
from quartering.study.criteria.particulars import Particulars
from quartering.study.criteria.record import Judgement, Quantity
from quartering.study.criteria.roll_in_waves import STEEPNESSES, largest_rolls
from quartering.study.criteria.sea_states import effective_deviation, scatter, wave_cases

_FINE, _FULL = 0.94, 0.96
_SHARES = tuple(math.cos(math.radians(7.5 * i)) for i in range(12))
"""Speeds of the second check over the service speed, in head and in following seas; 0 comes to them, once for both."""
_HEADINGS = (180.0, 0.0)


def standard(p: Particulars) -> float:
    """R_PR, the change of GM over GM up to which damping holds parametric roll down.

    0.17 + c min(100 A_k/(L B), 4); c is linear in Cm between 0.94 and 0.96.
    """
    if p.cm > _FULL:
        share = limit("parametric_rolling.keel_share_full")
    elif p.cm < _FINE:
        share = limit("parametric_rolling.keel_share_fine")
    else:
        share = limit("parametric_rolling.keel_share_slope") * p.cm - limit("parametric_rolling.keel_share_offset")
    keels = min(p.keels_percent(), limit("parametric_rolling.most_keels"))
    return limit("parametric_rolling.standard_bare") + share * keels


def by_waterplanes(p: Particulars, steepness: float) -> tuple[float, float]:
    """Second moments [m4] of the waterplanes half a wave above and below the draught, within deck and keel."""
    rise = p.length * steepness / 2
    least = limit("parametric_rolling.least_draught") * p.ship.hull.design_draught
    high = p.draught + min(p.depth - p.draught, rise)
    low = p.draught - min(max(p.draught - least, 0.0), rise)
    return p.waterplane_inertia(high), p.waterplane_inertia(low)


def level1(p: Particulars) -> Judgement:
    """GM's change in the wave of steepness 0.0167 against R_PR GM, by waterplanes and in the wave itself."""
    steepness = limit("parametric_rolling.steepness")
    high, low = by_waterplanes(p, steepness)
    by_planes = (high - low) / (2 * p.volume)
    in_wave = gm_variation(p, p.length, steepness * p.length)
    allowed, reserve = standard(p), p.reserve_ratio
    # The waterplanes speak for a hull whose sides do not fall in; for another one the wave does.
    flares = reserve >= limit("parametric_rolling.reserve_ratio")
    passed = (flares and by_planes / p.gm <= allowed) or in_wave / p.gm <= allowed
    return Judgement(
        "parametric_rolling", 1,
        (
            Quantity("gm_variation_waterplane", by_planes, "m", "by waterplanes"),
            Quantity("gm_variation_waves", in_wave, "m", "half the range over ten crest positions"),
            Quantity("r_pr", allowed, "1", "standard: allowed change over GM"),
            Quantity("gm", p.gm, "m", "in calm water"),
            Quantity("reserve_ratio", reserve, "1", "volume above the waterline over that of vertical sides"),
        ),
        not passed,
        f"change over GM {by_planes / p.gm:.3g} by waterplanes, {in_wave / p.gm:.3g} in waves; up to {allowed:.3g} allowed",
        notes=p.keel_note + p.depth_note,
    )  # fmt: skip


def _speeds(p: Particulars) -> tuple[float, ...]:
    """Speeds of the second check [m/s]."""
    return (*(p.speed * share for share in _SHARES), 0.0)


def rolled(p: Particulars) -> Iterator[None]:
    """Find the rolls of the second check one speed at a time, where the first one fails; `level2` then finds them ready."""
    if level2(p, second=False).value("c1") > limit("parametric_rolling.c1_limit"):
        for heading in _HEADINGS:
            for speed in _speeds(p):
                largest_rolls(p.ship, speed, heading)
                yield


def second_check(p: Particulars) -> tuple[float, float]:
    """C2, and the largest roll met [deg].

    C2 is the share of sea states, averaged over speeds in head and following seas, in whose effective wave the roll is too
    large.

    C2 = [sum_12 C2(head) + (C2(0, head) + C2(0, following))/2 + sum_12 C2(following)]/25, each the weight of the sea states
    whose effective wave, as long as the ship, makes it roll more than 25 deg. The roll is the largest stable motion of two
    periods, with sway, yaw and the ship's own damping; what lies between two heights is interpolated, and what capsizes counts
    90 deg.
    """
    table = scatter()
    heights = limit("effective_wave.significant") * effective_deviation(p.length, table.hs[:, None], table.tz)
    heights = np.minimum(heights, STEEPNESSES[-1] * p.length)
    total, largest = 0.0, 0.0
    for heading in _HEADINGS:
        for speed in _speeds(p):
            roll = np.interp(heights, STEEPNESSES * p.length, largest_rolls(p.ship, speed, heading))
            share = float(table.weight[roll > limit("parametric_rolling.largest_roll")].sum())
            total += share * (0.5 if speed == 0.0 else 1.0)
            largest = max(largest, float(roll.max()))
    return total / (2 * len(_SHARES) + 1), largest


def level2(p: Particulars, second: bool = True) -> Judgement:
    """C1: share of wave cases with too large a change of GM whose 2:1 resonance lies within the service speed; then C2.

    second: make the second check where the first fails: some seconds

    In a wave of length lambda a ship of roll period T_r meets twice its roll frequency at
    V = |(2 lambda/T_r) sqrt(GM_wave/GM) - sqrt(g lambda/(2 pi))|, in head or following seas by the sign.
    """
    allowed, gravity = standard(p), limit("general.gravity")
    cases, total = [], 0.0
    for weight, length, height in wave_cases():
        mean, change = gm_mean(p, length, height), gm_variation(p, length, height)
        ratio = change / mean if mean > 0 else math.inf
        meets = 2 * length / p.roll_period * math.sqrt(max(mean, 0.0) / p.gm) - math.sqrt(
            gravity * length / (2 * math.pi)
        )
        counts = not ((mean > 0 and ratio < allowed) or abs(meets) > p.speed)
        total += weight * counts
        cases.append({
            "weight": float(weight), "wave_length": float(length), "wave_height": float(height), "gm_mean": mean,
            "gm_variation": change, "ratio": ratio, "resonant_speed": abs(meets), "counts": float(counts),
        })  # fmt: skip
    most, most_second = limit("parametric_rolling.c1_limit"), limit("parametric_rolling.c2_limit")
    known = not math.isnan(p.speed)
    value, by_roll, largest, notes = total if known else math.nan, math.nan, math.nan, p.keel_note
    vulnerable: bool | None = None
    if not known:
        reason = "needs the service speed"
    elif value <= most:
        vulnerable, reason = False, f"C1 {value:.3g}; up to {most:g}"
    elif not second:
        reason = f"C1 {value:.3g} is above {most:g}; the second check was not asked for"
    else:
        by_roll, largest = second_check(p)
        vulnerable = by_roll > most_second
        reason = f"C1 {value:.3g} is above {most:g}; C2 {by_roll:.3g}; up to {most_second:g}"
        notes += (
            "roll in the second check has the ship's own damping; where none is stable it counts 90 deg, a convention",
        )
    return Judgement(
        "parametric_rolling", 2,
        (
            Quantity("c1", value, "1", f"first check, up to {most:g}"),
            Quantity("c2", by_roll, "1", f"second check, by the roll in head and following seas, up to {most_second:g}"),
            Quantity("largest_roll", largest, "deg", "in the effective waves of the second check; 90 stands for a capsize"),
        ),
        vulnerable, reason, notes=notes, cases=tuple(cases),
    )  # fmt: skip

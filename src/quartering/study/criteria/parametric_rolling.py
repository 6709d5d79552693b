"""Parametric rolling: GM in waves against the standard of the ship's damping, and the 2:1 resonance in 16 wave cases."""

from __future__ import annotations

import math

from quartering.study.criteria.constants import limit
from quartering.study.criteria.in_waves import gm_mean, gm_variation
from quartering.study.criteria.particulars import Particulars
from quartering.study.criteria.record import Judgement, Quantity
from quartering.study.criteria.sea_states import wave_cases

_FINE, _FULL = 0.94, 0.96


def standard(p: Particulars) -> float:
    """R_PR, the change of GM over GM up to which damping holds parametric roll down.

    Notes
    -----
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


def level2(p: Particulars) -> Judgement:
    """C1: share of wave cases with too large a change of GM whose 2:1 resonance lies within the service speed.

    Notes
    -----
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
    most = limit("parametric_rolling.c1_limit")
    known = not math.isnan(p.speed)
    value = total if known else math.nan
    if not known:
        reason = "needs the service speed"
    else:
        passed = value <= most
        reason = (
            f"C1 {value:.3g}; up to {most:g}" if passed else f"C1 {value:.3g} is above {most:g}; no second check yet"
        )
    return Judgement(
        "parametric_rolling", 2,
        (
            Quantity("c1", value, "1", f"first check, up to {most:g}"),
            Quantity("c2", math.nan, "1", "second check, by the roll in head and following seas"),
        ),
        False if value <= most else None, reason,
        notes=p.keel_note, cases=tuple(cases),
    )  # fmt: skip

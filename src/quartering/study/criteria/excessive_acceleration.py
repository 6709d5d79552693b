"""Excessive acceleration: lateral acceleration of people high up, by a roll in resonance, and over all sea states."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.hydro.decay.free_roll import free_damping
from quartering.study.criteria.constants import interpolated, limit
from quartering.study.criteria.parametric_rolling import standard
from quartering.study.criteria.particulars import Particulars
from quartering.study.criteria.record import Judgement, Quantity, not_judged
from quartering.study.criteria.sea_states import bretschneider, scatter

Floats = NDArray[np.float64]

_FREQUENCIES = 400
_NEEDS = "needs highest_position: {x: .., height: ..}"


def slope_ratio(frequency: ArrayLike, beam: float, draught: float, og: float) -> Floats:
    """Roll moment of a beam wave over displacement, GM and wave slope, for a rectangle of the ship's beam and C_B d.

    With B~ = w^2 B/(2 g), T~ = w^2 C_B d/g: beta = sin B~/B~, tau = exp(-T~)/T~, K1 = (g/w^2) beta (tau + tau T~ - 1/T~),
    K2 = (g/w^2) tau (beta - cos B~), F = beta (tau - 1/T~), r = (K1 + K2 + OG F)/(B^2/(12 C_B d) - C_B d/2 - OG).
    It is the Froude-Krylov moment of the rectangle in closed form; 1 in long waves.
    """
    w, gravity = np.asarray(frequency, dtype=float), limit("general.gravity")
    half, deep, scale = w**2 * beam / (2 * gravity), w**2 * draught / gravity, gravity / w**2
    beta, tau = np.sin(half) / half, np.exp(-deep) / deep
    first = scale * beta * (tau + tau * deep - 1 / deep)
    second = scale * tau * (beta - np.cos(half))
    arm = beta * (tau - 1 / deep)
    return (first + second + og * arm) / (beam**2 / (12 * draught) - draught / 2 - og)


def level1(p: Particulars) -> Judgement:
    """Acceleration at the highest place of people in a resonant roll."""
    place = _place(p)
    if place is None:
        return not_judged("excessive_acceleration", 1, ("acceleration",), _NEEDS)
    x, height = place
    applies, reason = _applies(p, height)
    lever, share = _lever(p, height), longitudinal(p, x)
    w = 2 * math.pi / p.roll_period
    ratio = float(slope_ratio(w, p.beam, p.cb * p.draught, p.og))
    steepness = interpolated("steepness_table", p.roll_period)
    decrement = 0.5 * math.pi * standard(p)
    roll = limit("excessive_acceleration.roll_factor") * ratio * steepness / math.sqrt(decrement)
    found = roll * share * (limit("general.gravity") + w**2 * lever)
    most = limit("excessive_acceleration.level1_limit")
    return Judgement(
        "excessive_acceleration", 1,
        (
            Quantity("acceleration", found, "m/s2", f"lateral, up to {most:g}"),
            Quantity("roll", math.degrees(roll), "deg", "amplitude in resonance"),
            Quantity("slope_ratio", ratio, "1", "effective wave slope over the wave's"),
            Quantity("steepness", steepness, "1", "of the wave at the roll period"),
            Quantity("height", lever, "m", "of the place over the roll axis"),
        ),
        found > most, reason or f"{found:.3g} m/s2; up to {most:g}", applies=applies, notes=p.keel_note,
    )  # fmt: skip


def level2(p: Particulars) -> Judgement:
    """C: chance of passing 9.81 m/s2 in beam seas, over all sea states.

    Roll in beam waves by one linear equation with the ship's GM, roll period and linear damping in a free roll; the drag of
    the sections is left out, which is on the safe side.
    """
    place = _place(p)
    if place is None:
        return not_judged("excessive_acceleration", 2, ("c",), _NEEDS)
    x, height = place
    applies, reason = _applies(p, height)
    low, high = max(0.5 / p.roll_period, 0.2), min(25 / p.roll_period, 2.0)
    w = np.linspace(low, high, _FREQUENCIES)
    damping = free_damping(p.ship).ratio
    gain = longitudinal(p, x) * (limit("general.gravity") + _lever(p, height) * w**2) * roll_of_slope(p, w, damping)
    table = scatter()
    density = bretschneider(w, table.hs[:, None, None], table.tz[None, :, None])
    variance = limit("excessive_acceleration.short_crested") * np.trapezoid(gain**2 * density, w, axis=-1)
    limit_of = limit("excessive_acceleration.acceleration")
    passes = np.exp(-(limit_of**2) / (2 * np.maximum(variance, 1e-300)))
    found, most = float((table.weight * passes).sum()), limit("excessive_acceleration.level2_limit")
    return Judgement(
        "excessive_acceleration", 2,
        (Quantity("c", found, "1", f"up to {most:g}"), Quantity("damping", damping, "1", "of critical, linear part")),
        found > most, reason or f"C {found:.3g}; up to {most:g}", applies=applies,
        notes=("linear roll damping of the model at rest; the drag of the sections is left out",),
    )  # fmt: skip


def roll_of_slope(p: Particulars, w: Floats, damping: float) -> Floats:
    """Roll amplitude [rad] for a wave amplitude of 1 m, in beam waves."""
    natural = 2 * math.pi / p.roll_period
    slope = w**2 / limit("general.gravity") * np.abs(slope_ratio(w, p.beam, p.cb * p.draught, p.og))
    return np.asarray(slope * natural**2 / np.hypot(natural**2 - w**2, 2 * damping * natural * w))


def longitudinal(p: Particulars, x: float) -> float:
    """Factor k_L of the place along the ship, x from midship."""
    share = 0.5 + x / p.length  # from the aft end
    if share < 0.2:
        return 1.125 - 0.625 * share
    return 1.0 if share <= 0.65 else 0.527 + 0.727 * share


def _place(p: Particulars) -> tuple[float, float] | None:
    x, height = p.ship.value("highest_position_x"), p.ship.value("highest_position_height")
    return None if x is None or height is None else (float(x), float(height))


def _lever(p: Particulars, height: float) -> float:
    """Height of a place over the roll axis, midway between waterline and G [m]."""
    return height - (p.draught + p.kg) / 2


def _applies(p: Particulars, height: float) -> tuple[bool, str]:
    over, gm = limit("excessive_acceleration.least_height"), limit("excessive_acceleration.least_gm")
    if height - p.draught <= over * p.beam:
        return (
            False,
            f"the place is {height - p.draught:.3g} m over the waterline, not above {over:g} B = {over * p.beam:.3g} m",
        )
    if p.gm <= gm * p.beam:
        return False, f"GM {p.gm:.3g} m is not above {gm:g} B = {gm * p.beam:.3g} m"
    return True, ""

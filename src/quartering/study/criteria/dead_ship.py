"""Dead ship: beam wind and waves on a ship without power, by the weather criterion and over all sea states."""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import RangeWarning
from quartering.hull.righting.arm import righting_arm
from quartering.hydro.capsize import capsize_limit
from quartering.hydro.decay.free_roll import free_damping
from quartering.study.criteria.constants import interpolated, limit
from quartering.study.criteria.excessive_acceleration import slope_ratio
from quartering.study.criteria.particulars import Particulars
from quartering.study.criteria.record import Judgement, Quantity, not_judged
from quartering.study.criteria.sea_states import bretschneider, scatter

Floats = NDArray[np.float64]

_HEELS = np.arange(-60.0, 60.25, 0.25)
_NEEDS = "needs windage: {area: .., lever: ..}"
_FREQUENCIES = 300
_SETTLED = 1e-6


def level1(p: Particulars) -> Judgement:
    """The weather criterion: area of the righting arm left after a gust against that of the roll to windward."""
    wind = _wind(p)
    if wind is None:
        return not_judged("dead_ship", 1, ("area_ratio",), _NEEDS)
    area, lever = wind
    arm = _arm(p)
    mass = p.ship.loading.density * p.volume
    steady = limit("dead_ship.wind_pressure") * area * lever / (limit("general.gravity") * mass)
    gust = limit("dead_ship.gust") * steady
    heel, back = _heel_under(arm, steady), _roll_back(p)
    deck = math.degrees(math.atan2(2 * (p.depth - p.draught), p.beam))
    most = min(limit("dead_ship.steady_heel"), limit("dead_ship.deck_share") * deck)
    first = _heel_under(arm, gust)
    last = min(limit("dead_ship.largest_heel"), capsize_limit(p.ship).angle, _last_heel(arm, gust, first))
    a = _area(arm, gust, heel - back, first) if math.isfinite(first) else math.inf
    b = -_area(arm, gust, first, last) if math.isfinite(first) else 0.0
    passed = bool(heel <= most and b >= a)
    return Judgement(
        "dead_ship", 1,
        (
            Quantity("area_ratio", b / a if a > 0 else math.inf, "1", "area b over area a, at least 1"),
            Quantity("steady_heel", heel, "deg", f"under the steady wind, up to {most:.3g}"),
            Quantity("roll_back", back, "deg", "roll to windward"),
            Quantity("steady_lever", steady, "m", "of the steady wind"),
            Quantity("last_heel", last, "deg", "least of 50 deg, openings and vanishing angle, second intercept"),
        ),
        not passed, f"heel {heel:.3g} deg of {most:.3g}, area ratio {b / a if a > 0 else math.inf:.3g} of at least 1",
        notes=p.keel_note,
    )  # fmt: skip


def _roll_back(p: Particulars) -> float:
    """Roll to windward phi_1 = 109 k X1 X2 sqrt(r s) [deg]."""
    x1 = interpolated("beam_table", p.beam / p.draught)
    x2 = interpolated("block_table", p.cb)
    k = interpolated("keel_table", p.keels_percent())
    r = 0.73 + 0.6 * p.og / p.draught
    s = interpolated("steepness_table", p.roll_period)
    return limit("dead_ship.roll_factor") * k * x1 * x2 * math.sqrt(max(r * s, 0.0))


def level2(p: Particulars) -> Judgement:
    """C: chance of passing the equal-area angles in an hour of beam wind and waves, over all sea states."""
    wind = _wind(p)
    if wind is None:
        return not_judged("dead_ship", 2, ("c",), _NEEDS)
    table, response = scatter(), _Response(p, *wind)
    total = 0.0
    for hs, row in zip(table.hs, table.weight, strict=True):
        chances = [
            response.chance(float(hs), float(tz)) if weight else 0.0 for tz, weight in zip(table.tz, row, strict=True)
        ]
        total += float(row @ np.array(chances))
    most = limit("dead_ship.limit")
    return Judgement(
        "dead_ship", 2, (Quantity("c", total, "1", f"up to {most:g}"),), total > most, f"C {total:.3g}; up to {most:g}",
        notes=("roll damping of the model: linear part and drag of the sections, linearised on the roll of each sea state",),
    )  # fmt: skip


class _Response:
    """Roll of the ship about its heel under the wind, sea state by sea state."""

    def __init__(self, p: Particulars, area: float, lever: float) -> None:
        self.p, self.arm = p, _arm(p)
        self.area, self.lever = area, lever
        self.weight = p.ship.loading.density * p.volume * limit("general.gravity")
        self.damping = free_damping(p.ship)
        self.last = min(limit("dead_ship.largest_heel"), capsize_limit(p.ship).angle)

    def chance(self, hs: float, tz: float) -> float:
        """Chance of a capsize in the exposure of the criterion."""
        wind = (hs / limit("general.storm_height_over_wind")) ** (1 / limit("general.storm_exponent"))
        force = 0.5 * limit("dead_ship.air_density") * limit("dead_ship.wind_coefficient") * self.area
        lever = force * self.lever * wind**2 / self.weight
        heel = _heel_under(self.arm, lever)
        if not heel < self.last:
            return 1.0
        lee, windward, stiffness = self._margins(heel, lever)
        if lee <= 0 or stiffness <= 0:
            return 1.0
        deviation, period = self._roll(hs, tz, wind, stiffness, 2 * force * self.lever * wind / self.weight)
        rate = sum(math.exp(-(margin**2) / (2 * deviation**2)) for margin in (lee, windward)) / period
        return 1 - math.exp(-limit("dead_ship.exposure") * rate)

    def _margins(self, heel: float, lever: float) -> tuple[float, float, float]:
        """Equal-area margins to lee and to windward [rad], and the slope of GZ at the heel [m/rad].

        A linear arm of that slope holds the energy of the real one at heel + sqrt(2 area/slope).
        """
        fold = _last_heel(self.arm, lever, heel)
        last = min(self.last, fold)
        slope = _slope_at(self.arm, heel)
        lee = math.sqrt(max(2 * -_area(self.arm, lever, heel, last) / slope, 0.0)) if slope > 0 else 0.0
        back = -min(self.last, -_HEELS[0])
        windward = math.sqrt(max(2 * _area(self.arm, lever, back, heel) / slope, 0.0)) if slope > 0 else 0.0
        return lee, windward, slope

    def _roll(self, hs: float, tz: float, wind: float, stiffness: float, gust: float) -> tuple[float, float]:
        """Standard deviation of roll [rad] and its zero-crossing period [s].

        One equation phi'' + 2 zeta w0 phi' + d |phi'| phi' + w1^2 phi = w0^2 (slope + gust lever/GM), with the stiffness
        at the heel in w1; |phi'| phi' is replaced by sqrt(8/pi) sigma phi', and sigma found by repetition.
        """
        p, w0 = self.p, 2 * math.pi / self.p.roll_period
        w1 = w0 * math.sqrt(stiffness / p.gm)
        w = np.linspace(max(0.05 / tz, 0.02), 4.0, _FREQUENCIES)
        slope = np.abs(slope_ratio(w, p.beam, p.cb * p.draught, p.og)) * w**2 / limit("general.gravity")
        x = limit("dead_ship.gust_length") * w / (math.pi * wind)
        gusts = 4 * limit("dead_ship.gust_drag") * wind**2 * x**2 / (w * (1 + x**2) ** (4 / 3))
        force = w0**4 * (slope**2 * bretschneider(w, hs, tz) + (gust / p.gm) ** 2 * gusts)
        rate = 0.1
        for _ in range(60):
            damping = 2 * self.damping.ratio * w0 + math.sqrt(8 / math.pi) * self.damping.quadratic * rate
            density = force / ((w1**2 - w**2) ** 2 + (damping * w) ** 2)
            variance, square = np.trapezoid(density, w), np.trapezoid(w**2 * density, w)
            last, rate = rate, math.sqrt(square)
            if abs(rate - last) < _SETTLED * rate:
                break
        return math.sqrt(variance), 2 * math.pi * math.sqrt(variance / square)


class _Arm(NamedTuple):
    """Righting arm over heel."""

    heel: Floats
    value: Floats


def _arm(p: Particulars) -> _Arm:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # a deck under water is part of this criterion
        return _Arm(_HEELS, np.asarray(righting_arm(p.ship, _HEELS)))


def _heel_under(arm: _Arm, lever: float) -> float:
    """First heel above 0 at which GZ has risen to a lever [deg]; infinite where it never does."""
    positive = arm.heel >= 0
    heel, rest = arm.heel[positive], arm.value[positive] - lever
    rises = np.flatnonzero((rest[:-1] <= 0) & (rest[1:] > 0))
    if rises.size == 0:
        return math.inf
    i = int(rises[0])
    return float(heel[i] - rest[i] * (heel[i + 1] - heel[i]) / (rest[i + 1] - rest[i]))


def _last_heel(arm: _Arm, lever: float, beyond: float) -> float:
    """Heel beyond another at which GZ has fallen to a lever again [deg]; the end of the curve where it does not."""
    kept = arm.heel > beyond
    heel, rest = arm.heel[kept], arm.value[kept] - lever
    falls = np.flatnonzero((rest[:-1] > 0) & (rest[1:] <= 0))
    if falls.size == 0:
        return float(arm.heel[-1])
    i = int(falls[0])
    return float(heel[i] + rest[i] * (heel[i + 1] - heel[i]) / (rest[i] - rest[i + 1]))


def _area(arm: _Arm, lever: float, start: float, end: float) -> float:
    """Area of a lever over GZ between two heels [m rad]."""
    heel = np.linspace(start, end, 400)
    return float(np.trapezoid(lever - np.interp(heel, *arm), np.radians(heel)))


def _slope_at(arm: _Arm, heel: float) -> float:
    """Slope of GZ at a heel [m/rad]."""
    step = 0.5
    low, high = np.interp([heel - step, heel + step], *arm)
    return float((high - low) / math.radians(2 * step))


def _wind(p: Particulars) -> tuple[float, float] | None:
    area, lever = p.ship.value("windage_area"), p.ship.value("windage_lever")
    return None if area is None or lever is None else (float(area), float(lever))

"""Resistance of a hull in calm water, estimated from its lines."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.strips import has_transom
from quartering.hull.ship import Ship

Floats = NDArray[np.float64]

VISCOSITY: Final = 1.19e-6
"""Kinematic viscosity of sea water at 15 deg C [m2/s]."""
_EXPONENT: Final = -0.9
_LOW, _HIGH = 0.4, 0.55
"""Froude numbers below and above which one formula of the wave resistance holds; between them it is interpolated."""
_RANGES: Final = {"CP": (0.55, 0.85), "L/B": (3.9, 15.0), "B/T": (2.1, 4.0)}
"""Proportions of the models behind the regression."""


class HullForm(NamedTuple):
    """What the regression asks of a hull.

    Parameters
    ----------
    length, beam, draught : float    [m]
    volume, surface : float          displaced [m3], wetted [m2]
    lcb : float                      centre of buoyancy from midship, + forward [per cent of the length]
    cp, cm, cw, cb : float           coefficients of fineness
    transom : float                  immersed area of the transom at rest [m2]
    """

    length: float
    beam: float
    draught: float
    volume: float
    surface: float
    lcb: float
    cp: float
    cm: float
    cw: float
    cb: float
    transom: float

    @property
    def run(self) -> float:
        """Length of run over the length."""
        return 1 - self.cp + 0.06 * self.cp * self.lcb / (4 * self.cp - 1)


def hull_form(ship: Ship) -> HullForm:
    """What the regression asks of a ship.

    >>> from quartering.hull.file.read import ship
    >>> round(hull_form(ship("series60-cb60")).cp, 3)
    0.614
    """
    water, wet = hydrostatics(ship), strips(ship.hull)
    aft = float(wet.area[np.argmin(wet.x)]) if has_transom(wet) else 0.0
    return HullForm(
        ship.hull.length, ship.hull.beam, ship.hull.draught, water.volume, water.wetted_surface,
        100 * water.lcb / ship.hull.length, water.cp, water.cm, water.cw, water.cb, aft,
    )  # fmt: skip


def outside(form: HullForm) -> list[str]:
    """Proportions of a hull beyond those of the models behind the regression, in words.

    >>> from quartering.hull.file.read import ship
    >>> outside(hull_form(ship("series60-cb60")))
    []
    """
    values = {"CP": form.cp, "L/B": form.length / form.beam, "B/T": form.beam / form.draught}
    return [
        f"{name} {values[name]:.3g} is outside {low:g} to {high:g}"
        for name, (low, high) in _RANGES.items()
        if not low <= values[name] <= high
    ]


def friction(form: HullForm, speed: ArrayLike, density: float) -> Floats:
    """Friction of a flat plate of the hull's length and wetted surface [N]: C_F = 0.075/(log10 Re - 2)^2."""
    u = np.asarray(speed, dtype=float)
    reynolds = np.maximum(u * form.length / VISCOSITY, 1e4)
    return np.asarray(0.5 * density * u**2 * form.surface * 0.075 / (np.log10(reynolds) - 2) ** 2)


def form_factor(form: HullForm) -> float:
    """1 + k of the hull: viscous resistance over friction; a stern of usual shape."""
    ratio = form.draught / form.length
    c12 = ratio**0.2228446 if ratio > 0.05 else 0.479948 + 48.20 * max(ratio - 0.02, 0.0) ** 2.078
    slender = (form.beam / (form.run * form.length)) ** 0.92497
    full = (0.95 - form.cp) ** -0.521448 * (1 - form.cp + 0.0225 * form.lcb) ** 0.6906
    return 0.93 + c12 * slender * full


def correlation(form: HullForm, speed: ArrayLike, density: float) -> Floats:
    """Allowance between model and ship, without a bulb [N]."""
    c4 = min(form.draught / form.length, 0.04)
    ca = 0.006 * (form.length + 100) ** -0.16 - 0.00205
    ca += 0.003 * math.sqrt(form.length / 7.5) * form.cb**4 * (0.04 - c4)
    return np.asarray(0.5 * density * np.asarray(speed, dtype=float) ** 2 * form.surface * ca)


def entrance(form: HullForm) -> float:
    """Half the angle of entrance of the waterline [deg], from the hull's proportions."""
    slender = (form.length / form.beam) ** 0.80856 * (1 - form.cw) ** 0.30484
    fine = (1 - form.cp - 0.0225 * form.lcb) ** 0.6367 * (form.run * form.length / form.beam) ** 0.34574
    return 1 + 89 * math.exp(-slender * fine * (100 * form.volume / form.length**3) ** 0.16302)


# With d = -0.9 and lambda = 1.446 CP - 0.03 L/B (1.446 CP - 0.36 from L/B 12 on), the resistance over the weight is
#     Fn < 0.4:   c1 c5 exp(m1 Fn^d + c15 CP^2 exp(-0.1 Fn^-2) cos(lambda Fn^-2))
#     Fn > 0.55:  c17 c5 exp(m3 Fn^d + 0.4 c15 exp(-0.034 Fn^-3.29) cos(lambda Fn^-2))
def wave_resistance(form: HullForm, speed: ArrayLike, density: float) -> Floats:
    """Resistance by the ship's own waves [N], without a bulb.

    speed (...): [m/s]
    density: of the water [kg/m3]

    Source: [Holtrop82] below a Froude number of 0.4, [Holtrop84] above 0.55, a line between (recalled).
    """
    u = np.asarray(speed, dtype=float)
    froude = np.maximum(u / math.sqrt(GRAVITY * form.length), 0.02)
    weight = form.volume * density * GRAVITY * (1 - 0.8 * form.transom / (form.beam * form.draught * form.cm))
    share = np.clip((froude - _LOW) / (_HIGH - _LOW), 0.0, 1.0)
    low, high = _slow(form, np.minimum(froude, _LOW)), _fast(form, np.maximum(froude, _HIGH))
    return np.asarray(weight * ((1 - share) * low + share * high))


def _slow(form: HullForm, froude: Floats) -> Floats:
    """Wave resistance over the weight at low Froude numbers."""
    breadth = form.beam / form.length
    c7 = 0.229577 * breadth**0.33333 if breadth < 0.11 else breadth if breadth < 0.25 else 0.5 - 0.0625 / breadth
    c1 = 2223105 * c7**3.78613 * (form.draught / form.beam) ** 1.07961 * (90 - entrance(form)) ** -1.37565
    cp = form.cp
    c16 = 8.07981 * cp - 13.8673 * cp**2 + 6.984388 * cp**3 if cp < 0.8 else 1.73014 - 0.7067 * cp
    m1 = (
        0.0140407 * form.length / form.draught
        - 1.75254 * form.volume ** (1 / 3) / form.length
        - 4.79323 * breadth
        - c16
    )
    humps = _c15(form) * cp**2 * np.exp(-0.1 * froude**-2) * np.cos(_humps(form) * froude**-2)
    return np.asarray(c1 * np.exp(m1 * froude**_EXPONENT + humps))


def _fast(form: HullForm, froude: Floats) -> Floats:
    """Wave resistance over the weight at high Froude numbers."""
    slender = form.length / form.beam - 2
    c17 = 6919.3 * form.cm**-1.3346 * (form.volume / form.length**3) ** 2.00977 * slender**1.40692
    m3 = -7.2035 * (form.beam / form.length) ** 0.326869 * (form.draught / form.beam) ** 0.605375
    humps = 0.4 * _c15(form) * np.exp(-0.034 * froude**-3.29) * np.cos(_humps(form) * froude**-2)
    return np.asarray(c17 * np.exp(m3 * froude**_EXPONENT + humps))


def _humps(form: HullForm) -> float:
    """Length of the wave of bow and stern over the ship's, as the regression has it."""
    return 1.446 * form.cp - min(0.03 * form.length / form.beam, 0.36)


def _c15(form: HullForm) -> float:
    slender = form.length**3 / form.volume
    if slender < 512:
        return -1.69385
    return 0.0 if slender > 1726.91 else -1.69385 + (slender ** (1 / 3) - 8) / 2.36


def resistance(ship: Ship, speed: ArrayLike) -> Floats:
    """Estimated resistance of a bare hull in calm water [N].

    speed (...): [m/s]

    (1 + k) R_F + R_W + R_A; no appendages, no bulb. A hull so far from any ship that the regression has no value is refused.
    Source: [Holtrop82], [Holtrop84] (recalled).  Valid: CP 0.55 to 0.85, L/B 3.9 to 15, B/T 2.1 to 4.

    >>> from quartering.hull.file.read import ship
    >>> 2e5 < float(resistance(ship("series60-cb60"), 8.0)) < 3e5
    True
    """
    form, density = hull_form(ship), ship.loading.density
    if not (form.length > 2 * form.beam and 0.3 < form.cp < 0.95):
        raise InputError(
            f"{ship.name}: L/B {form.length / form.beam:.3g}, CP {form.cp:.3g}: no resistance can be estimated of it; "
            "give propulsion, resistance and thrust of its own"
        )
    viscous = form_factor(form) * friction(form, speed, density) + correlation(form, speed, density)
    return np.asarray(viscous + wave_resistance(form, speed, density))

"""Roll damping of a ship: by components from its lines, by regression, or as a fraction of the critical damping."""

from __future__ import annotations

import warnings
from typing import get_args

import numpy as np

from quartering.conventions import InputError, RangeWarning
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.damping.components import REFERENCES, Method, RollDamping
from quartering.hydro.damping.forms import fitted_form
from quartering.hydro.damping.ikeda import Particulars, Rolling, eddy_speed_factor, friction, lift, wave_speed_factor
from quartering.hydro.damping.ikeda_bilge_keel import BilgeKeel, bilge_keels, checked_keel
from quartering.hydro.damping.ikeda_eddy import eddy_damping
from quartering.hydro.damping.ikeda_simplified import simplified_ikeda
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.source.of_ship import source_of

AMPLITUDES = np.linspace(0.25, 1.5, 11)
"""Amplitudes over which the linear + quadratic and linear + cubic forms are fitted, as shares of the one asked for."""

SHARP_BILGE = (0.995, 0.9995)
"""Midship coefficients between which the eddy formula hangs on the third decimal of the area (5 at 1, 1 at 0.995)."""

FLATTEST = 4.5
"""B/T of the flattest hulls its authors ran the component method on ([Kawahara09]); eddies were measured up to 2.5."""

LARGEST_AMPLITUDE = 20.0
"""Roll amplitude up to which the component formulas were tested [deg]."""


def fraction_of_critical(fraction: float, frequency: float, inertia: float) -> float:
    """Linear roll damping that is a given fraction of the critical damping.

    fraction: zeta, >= 0; 0.05 is common for a ship with bilge keels [1]
    frequency: natural roll frequency n2 [rad/s]
    inertia: I_x + a44(n2) [kg m2]
    Returns contribution to K_p, <= 0 [kg m2/s]

    K_p = -2 zeta n2 (I_x + a44).  Source: [Himeno81], equivalent linear damping.  Valid: at the amplitude zeta is for.
    """
    if not (fraction >= 0 and np.isfinite(fraction)):
        raise InputError(f"roll damping {fraction:g} of critical must be a number >= 0; 0.05 is a common value")
    return -2 * fraction * frequency * inertia


def roll_damping(
    ship: Ship,
    speed: float,
    frequency: float,
    amplitude_deg: float,
    *,
    method: Method = "ikeda",
    bilge_keel: tuple[float, float] | None = None,
) -> RollDamping:
    """Roll damping of a ship about G by components, as equivalent linear, linear + quadratic and linear + cubic damping.

    speed: U >= 0 [m/s]
    frequency: omega > 0 of the roll [rad/s]
    amplitude_deg: phi_a > 0 [deg]
    method: "ikeda" from the lines, "simplified" from the main particulars, "fraction" of critical
    bilge_keel: (length, breadth) of one keel of the pair [m]; None: the ship's own, if it has any

    The two nonlinear forms are least squares of the equivalent linear damping over eleven amplitudes, evenly from 0.25
    to 1.5 times the one asked for, all weighted alike. Speed acts on the simplified method as on the component method.
    "fraction" is the ship's `roll_damping`: -2 zeta n2 (I_x + a44(n2)) of `fraction_of_critical`, the same at all
    speeds, frequencies and amplitudes, without waves; bilge keels are not allowed for twice.
    Source: [Himeno81], [ITTC11], [Kawahara09].  Valid: monohulls with round bilges up to 20 deg; expect 20 to 30 % of
    error in the sum, more at speed.
    """
    if method not in get_args(Method):
        raise InputError(f'roll damping method "{method}" is unknown; allowed are "ikeda", "simplified" and "fraction"')
    if not (np.isfinite(amplitude_deg) and 0 < amplitude_deg < 60):
        raise InputError(f"roll amplitude {amplitude_deg:g} deg must lie between 0 and 60 deg; try 10")
    if amplitude_deg > LARGEST_AMPLITUDE:
        message = (
            f"roll amplitude {amplitude_deg:g} deg is above the {LARGEST_AMPLITUDE:g} deg the formulas were tested to"
        )
        warnings.warn(message, RangeWarning, stacklevel=2)
    hull = particulars(ship)
    motion = Rolling(frequency, np.radians(amplitude_deg) * np.append(1.0, AMPLITUDES), speed)
    sizes = ship.bilge_keels if bilge_keel is None else bilge_keel
    keel = None if sizes is None else checked_keel(hull, *sizes)
    potential = 0.0 if method == "fraction" else _potential_wave(ship, frequency)
    if method == "fraction":
        parts = _fraction_of_critical(ship, motion)
    elif method == "ikeda":
        _warn_sharp_bilge(hull)
        _warn_flat(hull)
        parts = _from_lines(ship, hull, motion, keel, potential)
    else:
        parts = _from_particulars(hull, motion, keel)
    rate, total = frequency * motion.amplitude[1:], np.sum(list(parts.values()), axis=0)[1:]
    if not np.isfinite(total).all():
        raise InputError(
            f'{ship.name}: roll damping "{method}" gives no number at B/T {hull.beam / hull.draught:.3g}, C_B '
            f'{hull.block:.3g}, C_M {hull.midship:.3g}; try "ikeda", which works from the lines, or a fraction of critical'
        )
    one = {name: float(values[0]) for name, values in parts.items()}
    return RollDamping(
        ship=ship.name,
        method=method,
        speed=float(speed),
        frequency=float(frequency),
        amplitude_deg=float(amplitude_deg),
        potential_wave=potential,
        quadratic=fitted_form(rate, total, 2),
        cubic=fitted_form(rate, total, 3),
        fitted_from_deg=float(amplitude_deg * AMPLITUDES[0]),
        fitted_to_deg=float(amplitude_deg * AMPLITUDES[-1]),
        references=REFERENCES[method],
        **one,
    )


def particulars(ship: Ship) -> Particulars:
    """What the component formulas ask of a ship.

    Returns og = T - KG

    Source: [ITTC11] 4.1.
    """
    floating, hull, loading = hydrostatics(ship), ship.hull, ship.loading
    og = hull.draught - loading.kg
    return Particulars(hull.length, hull.beam, hull.draught, floating.cb, floating.cm, og, loading.density)


def _potential_wave(ship: Ship, frequency: float) -> float:
    """Wave damping of the strips at rest about G, sway held [N m s]."""
    return float(source_of(ship).at(np.array([frequency])).b[0, 0, 2])


def _warn_sharp_bilge(hull: Particulars) -> None:
    low, high = SHARP_BILGE
    if low < hull.midship < high:
        message = (
            f"midship coefficient {hull.midship:.4f} between {low:g} and {high:g}: there the eddy damping is overestimated, up "
            "to fivefold, and hangs on the third decimal of the section area; prefer a measured decay"
        )
        warnings.warn(message, RangeWarning, stacklevel=3)


def _warn_flat(hull: Particulars) -> None:
    ratio = hull.beam / hull.draught
    if ratio > FLATTEST:
        message = (
            f"B/T {ratio:.3g} is above the {FLATTEST:g} of the flattest hulls the component method of roll damping was tried "
            "on; its eddies grow with B/T; prefer a measured decay or a fraction of critical"
        )
        warnings.warn(message, RangeWarning, stacklevel=3)


def _from_lines(
    ship: Ship, hull: Particulars, motion: Rolling, keel: BilgeKeel | None, potential: float
) -> dict[str, Floats]:
    """Components from the sections."""
    s, none = strips(ship.hull), np.zeros_like(motion.amplitude)
    rate = motion.frequency * motion.amplitude
    eddy = eddy_damping(s.half_breadth, s.draught, s.area, hull.og, rate, hull.density) @ s.weight
    return {
        "friction": friction(hull, motion),
        "eddy": eddy * eddy_speed_factor(motion.frequency, motion.speed, hull.length),
        "lift": lift(hull, motion),
        "wave": none + potential * wave_speed_factor(motion.frequency, motion.speed, hull.draught),
        "bilge_keel": none if keel is None else bilge_keels(hull, motion, keel).total,
        "fraction": none,
    }


def _from_particulars(hull: Particulars, motion: Rolling, keel: BilgeKeel | None) -> dict[str, Floats]:
    """Components from the regression, with the same effects of speed as the component method."""
    with np.errstate(over="ignore", invalid="ignore"):  # NaN is refused by `roll_damping`
        damping = simplified_ikeda(hull, motion, keel)
    omega, U = motion.frequency, motion.speed
    return {
        "friction": damping.friction * hull.scale * (1 + 4.1 * U / (omega * hull.length)),
        "eddy": damping.eddy * hull.scale * eddy_speed_factor(omega, U, hull.length),
        "lift": lift(hull, motion),
        "wave": damping.wave * hull.scale * wave_speed_factor(omega, U, hull.draught),
        "bilge_keel": damping.bilge_keel * hull.scale,
        "fraction": np.zeros_like(motion.amplitude),
    }


def _fraction_of_critical(ship: Ship, motion: Rolling) -> dict[str, Floats]:
    """The ship's fraction of critical damping, alike at every amplitude."""
    roll, none = free_roll(ship), np.zeros_like(motion.amplitude)
    value = -fraction_of_critical(ship.loading.roll_damping, roll.frequency, roll.inertia)
    return dict.fromkeys(("friction", "eddy", "lift", "wave", "bilge_keel"), none) | {"fraction": none + value}

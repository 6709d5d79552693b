"""The equations of a ship or a model over one parameter: what a branch is followed over."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.motion.branch import Family
from quartering.motion.equations import Model, System
from quartering.motion.of_ship import equations, ship_system
from quartering.motion.terms import parse
from quartering.study.grid import CONDITION_AXES, LOADING_AXES, loaded

_NODES = 65
_ARRAYS = ("linear", "coefficients", "mean", "cos", "sin", "frequency")


def family(
    ship_or_model: Ship | Model,
    over: str,
    limits: tuple[float, float] | None,
    wave: Wave | None,
    speed: float,
    heading: float,
) -> tuple[float, float, Family]:
    """Limits of the parameter, and the system at each share of the way between them."""
    if isinstance(ship_or_model, Ship) and wave is None:
        raise InputError(
            "a branch of a ship needs a wave: branch(ship, wave=Wave(length=.., height=..), speed=.., heading=..)"
        )
    of_ship = isinstance(ship_or_model, Ship) and over in (*CONDITION_AXES, *LOADING_AXES)
    if isinstance(ship_or_model, Ship):
        assert wave is not None
        model = equations(ship_or_model, wave, speed, heading)
        own = {"speed": speed, "heading": heading, "wave_length": wave.length, "wave_height": wave.height}
        own |= {name: getattr(ship_or_model.loading, name, np.nan) for name in LOADING_AXES}
    else:
        model, own = ship_or_model, {}
    if not of_ship and over not in ("frequency", "excitation"):
        _check_term(model, over, isinstance(ship_or_model, Ship))
    centre = own[over] if of_ship else {"frequency": model.frequency}.get(over, 1.0)
    low, high = limits or ((0.0, 2.0) if over == "excitation" else (0.5 * centre, 1.5 * centre))
    if not (np.isfinite(low) and np.isfinite(high) and 0 <= low < high) or (over == "frequency" and low == 0):
        raise InputError(f"limits ({low:g}, {high:g}) of {over} must be two rising numbers, above zero for a frequency")
    if of_ship:
        assert isinstance(ship_or_model, Ship)
        assert wave is not None
        return low, high, _splined(ship_or_model, over, low, high, wave, speed, heading)

    def at(share: float) -> System:
        value, s = low + (high - low) * share, model.system
        if over == "frequency":
            return replace(s, frequency=np.array([value]))
        if over == "excitation":
            return replace(s, mean=value * s.mean, cos=value * s.cos, sin=value * s.sin)
        return replace(model, terms=dict(model.terms) | {over: value * model.terms[over]}).system

    return low, high, at


def _check_term(model: Model, over: str, of_ship: bool) -> None:
    """Refuse a parameter that is neither a condition nor a term the model has."""
    known = "'frequency', 'excitation'" + (
        ", " + ", ".join(map(repr, (*CONDITION_AXES, *LOADING_AXES))) if of_ship else ""
    )
    if "_" not in over:
        raise InputError(f"over={over!r}: a branch can be followed over {known}, or a term such as 'K_ppp'")
    parse(over)
    if model.terms.get(over, 0.0) == 0.0:
        raise InputError(f"over={over!r}: the model has no such term (or it is zero), so there is nothing to multiply")


def _splined(ship: Ship, over: str, low: float, high: float, wave: Wave, speed: float, heading: float) -> Family:
    """Systems of a ship between two values of a parameter, through a spline of every coefficient and force."""
    share = np.linspace(0.0, 1.0, _NODES)
    values = low + (high - low) * share
    if over in CONDITION_AXES:
        own = {"speed": speed, "heading": heading, "wave_length": wave.length, "wave_height": wave.height} | {
            over: values
        }
        u, mu, length, height = (np.broadcast_to(own[name], values.shape).astype(float) for name in CONDITION_AXES)
        at = ship_system(ship, 2 * np.pi / length, u, mu)
        if at.slow.any() or (at.encounter_frequency.min() < 0 < at.encounter_frequency.max()):
            raise InputError(
                f"between {over} = {low:g} and {high:g} the ship keeps pace with the wave; take narrower limits"
            )
        systems = at.at_amplitude(0.5 * height[:, None])
    else:
        each = [equations(loaded(ship, {over: float(v)}), wave, speed, heading).system for v in values[:: _NODES // 16]]
        share = share[:: _NODES // 16]
        systems = replace(each[0], **{name: np.concatenate([getattr(s, name) for s in each]) for name in _ARRAYS})
    splines = {name: CubicSpline(share, getattr(systems, name), axis=0) for name in _ARRAYS}

    def at_share(t: float) -> System:
        return replace(systems, **{name: np.ascontiguousarray(spline(t)[None]) for name, spline in splines.items()})

    return at_share

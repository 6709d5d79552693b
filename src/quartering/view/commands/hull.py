"""`quartering hull`: what floats, how it rights itself, and whether it keeps its course without waves."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
import xarray as xr
from rich.table import Table

from quartering.conventions import SYMBOLS, InputError, in_unit, written
from quartering.hull.hydrostatics import Hydrostatics, hydrostatics
from quartering.hull.lines.bulb import bulb
from quartering.hull.righting.arm import RightingFit, righting_arm, righting_polynomial
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.capsize import capsize_limit
from quartering.hydro.decay.free_roll import FreeDamping, free_damping, total_words
from quartering.loads.waves import Wave
from quartering.options import OPTIONS, parts
from quartering.study.gm_in_waves import gm_in_waves
from quartering.study.gm_in_waves import righting_arm as arm_on_wave
from quartering.units import quantity
from quartering.view.commands.conditions import typed_ship, typed_value
from quartering.view.output import PICTURES, claim, write
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import carries_curve, exponents_words, speed_words

HYDROSTATICS = {
    "volume": ("displaced volume", "m3"), "mass": ("displaced mass", "kg"),
    "lcb": ("centre of buoyancy from midship, + forward", "m"), "lcf": ("centre of flotation from midship, + forward", "m"),
    "kb": ("KB", "m"), "bm": ("BM", "m"), "km": ("KM", "m"), "kg": ("KG", "m"), "gm": ("GM", "m"),
    "cb": ("block coefficient CB", "-"), "cm": ("midship coefficient CM", "-"), "cp": ("prismatic coefficient CP", "-"),
    "cw": ("waterplane coefficient CW", "-"), "wetted_surface": ("wetted surface", "m2"),
}  # fmt: skip
"""Attribute of the hydrostatics -> what it is, and its unit."""

LOADING = (
    *((key, written(key), SYMBOLS[key].unit) for key in ("gm", "kg", "gyradius_roll", "gyradius_yaw")),
    ("roll_damping", f"{written('roll_damping')}, of critical", "-"),
)  # fmt: skip
"""Attribute of the loading, what it is, and its unit."""

_FROUDE_NUMBERS = (0.0, 0.15, 0.25)
_NEUTRAL = 1e-9


OnWave = tuple[str | None, str | None, str]
"""Length, height and heading of a wave as typed; no wave without length and height."""


def describe_hull(name: str, on_wave: OnWave, changes: Mapping[str, str], output: str | None, as_json: bool) -> None:
    """Print hydrostatics, loading, righting arm and calm-water exponents; draw the hull where asked."""
    one = typed_ship(name, changes)
    wave, heading = _wave(one, on_wave)
    path = claim(output, PICTURES) if output is not None else None
    floats, fit = hydrostatics(one), righting_polynomial(one)
    angles = np.linspace(0.0, 60.0, 61)
    arms = righting_arm(one, angles)
    calm = {
        u: calm_water_exponents(one, u)
        for u in (quantity(f"{fn} Fn", "speed", length=one.hull.length) for fn in _FROUDE_NUMBERS)
    }
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.hull import hull_picture

        picture = hull_picture(one, angles, arms, fit, waves=_arms_on(one, wave, heading, angles))
        write((path, lambda part: style.save(picture, part)))
    found = gm_in_waves(one, wave, heading) if wave is not None else None
    if as_json:
        show_json(_facts(one, floats, fit, calm) | ({"on_wave": _facts_on(found)} if found is not None else {}))
        return
    _print(one, floats, fit, calm)
    if found is not None:
        show(_on_wave(found))
    if path is not None:
        show(f"Wrote {path}")
    again = option_words(changes)
    show(next_steps(f"quartering coefficients {name}{again}", f"quartering polar {name}{again}"))


def _wave(one: Ship, on_wave: OnWave) -> tuple[Wave | None, float]:
    """The wave typed, None where none was, and the heading to it."""
    length, height, heading = on_wave
    mu = typed_value("heading", heading, one.sizes)
    if length is None and height is None:
        return None, mu
    if length is None or height is None:
        missing = "--wave-length" if length is None else "--wave-height"
        raise InputError(
            f"{missing} is missing; a wave has a length and a height, such as --wave-length 1.0L --wave-height 4"
        )
    return Wave(
        *(typed_value(key, text, one.sizes) for key, text in (("wave_length", length), ("wave_height", height)))
    ), mu


def _arms_on(one: Ship, wave: Wave | None, heading: float, angles: np.ndarray) -> dict[str, np.ndarray]:
    """Righting arms with the crest and with the trough at midship."""
    if wave is None:
        return {}
    places = {"crest at midship": 0.0, "trough at midship": 0.5}
    return {words: arm_on_wave(one, angles, wave, heading, place) for words, place in places.items()}


def _on_wave(found: xr.Dataset) -> Table:
    """GM, heave and trim over the position of the crest."""
    columns = (found["position"], found["gm"], found["heave"], found["trim"])
    rows = [tuple(f"{float(value) + 0.0:.4g}" for value in row) for row in zip(*columns, strict=True)]
    about = found.attrs
    title = (
        f"On a wave of {about['wave_length']:.4g} m, {about['wave_height']:.3g} m high, heading {about['heading']:g} deg, "
        f"balanced in heave and trim; {about['sides']}"
    )
    return table(
        title,
        ("crest from midship, of the wave", "GM [m]", "heave, down [m]", "trim, bow up [deg]"),
        rows,
        (0, 1, 2, 3),
    )


def _facts_on(found: xr.Dataset) -> dict[str, object]:
    return dict(found.attrs) | {str(name): found[name].to_numpy() for name in (*found.coords, *found.data_vars)}


def _print(one: Ship, floats: Hydrostatics, fit: RightingFit, calm: Mapping[float, np.ndarray]) -> None:
    rows = [(words, f"{round(getattr(floats, key), 9) + 0.0:.5g}", unit) for key, (words, unit) in HYDROSTATICS.items()]
    under = bulb(one.hull)
    if under.sections:
        words = f"of it in {under.sections} sections of a bulb wholly under water, left out in waves"
        rows.insert(1, (words, f"{under.volume:.5g}", "m3"))
    show(table(f"{one.name}: hydrostatics at T {one.hull.draught:.4g} m", ("quantity", "value", "unit"), rows, (1,)))
    show(table("Loading", ("quantity", "value", "unit", "where it comes from"), loading_rows(one), (1,)))
    told = particular_rows(one)
    if told:
        show(table("Told, and recorded", ("quantity", "value", "unit", "where it comes from"), told, (1,)))
    powers = (("phi", fit.gm), ("phi^3", fit.gz3), ("phi^5", fit.gz5), ("phi^7", fit.gz7))
    terms = " ".join(f"{c:+.4g} {power}" for power, c in powers if c)
    fitted = f"GZ = {terms} m (phi in rad), within {fit.residual:.1%} of the largest up to {fit.max_angle:g} deg"
    if carries_curve(one):
        show(f"Righting arm: the equations carry the curve itself, as a spline. Fitted for comparison: {fitted}.")
    else:
        show(f"Righting arm: the equations carry a polynomial, {fitted}.")
    show(f"Capsize: roll past {capsize_limit(one).words}.")
    if np.isfinite(fit.deck_angle):
        show(
            f"The top of the offsets goes under at {fit.deck_angle:.3g} deg; beyond, the hull is closed by a deck there."
        )
    rows = [(speed_words(u, one.hull.length), exponents_words(z), _course(z)) for u, z in calm.items()]
    show(table("Small motions in calm water, rudder amidships: exponents", ("speed", "1/s", "verdict"), rows))


def loading_rows(one: Ship) -> list[tuple[str, str, str, str]]:
    """Each value of the loading: what it is, how much, its unit, where it comes from."""
    value = {"roll_damping": "by components"} if one.damped_by_components else {}
    rows = [
        (words, value.get(key, f"{getattr(one.loading, key):.5g}"), unit, one.provenance.get(key, "given"))
        for key, words, unit in LOADING
    ]
    roll = free_damping(one)
    return [
        *rows,
        ("roll damping in all, of critical", f"{roll.ratio:.4g}", "-", f"derived: {total_words(one, roll, 0.0)}"),
    ]


def particular_rows(one: Ship) -> list[tuple[str, str, str, str]]:
    """Each further thing the ship was told: what it is, its value, its unit, where it comes from."""
    rows = []
    for name, value in one.particulars.items():
        of = OPTIONS[name]
        if isinstance(value, Mapping) and of.kind == "group":
            units = {key: part.unit for key, part in parts(name).items()}
            text = ", ".join(f"{key} {number:.5g}{in_unit(units[key])}" for key, number in value.items())
        else:
            text = (
                ", ".join(map(str, value))
                if isinstance(value, Mapping)
                else f"{value:.5g}"
                if of.numeric
                else str(value)
            )
        rows.append((of.text, text, of.unit or "-", one.provenance.get(name, "given")))
    return rows


def _course(exponents: np.ndarray) -> str:
    """Stability in calm water in words; without speed nothing holds a ship on its course."""
    largest = float(exponents.real.max())
    return "neutral" if abs(largest) < _NEUTRAL else "course-unstable" if largest > 0 else "stable"


def _facts(one: Ship, floats: Hydrostatics, fit: RightingFit, calm: Mapping[float, np.ndarray]) -> dict[str, object]:
    roll: FreeDamping = free_damping(one)
    return {
        "ship": one.name,
        "hydrostatics": dataclasses.asdict(floats),
        "bulb_left_out_in_waves": bulb(one.hull)._asdict(),
        "loading": dataclasses.asdict(one.loading),
        "free_roll_at_rest": {**roll._asdict(), "at_10_deg": roll.equivalent(np.radians(10.0))},
        "righting": dataclasses.asdict(fit),
        "righting_curve": one.righting,
        "capsize_angle_deg": capsize_limit(one).angle,
        "capsize_reason": capsize_limit(one).reason,
        "told": dict(one.particulars),
        "calm_water_exponents": [{"speed": u, "exponents": z} for u, z in calm.items()],
        "provenance": dict(one.provenance),
    }

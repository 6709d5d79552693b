"""`quartering hull`: what floats, how it rights itself, and whether it keeps its course without waves."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from quartering.conventions import SYMBOLS, in_unit, written
from quartering.hull.bulb import bulb
from quartering.hull.hydrostatics import Hydrostatics, hydrostatics
from quartering.hull.righting import RightingFit, righting_arm, righting_polynomial
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.capsize import capsize_limit
from quartering.hydro.freedamping import FreeDamping, free_damping, total_words
from quartering.options import OPTIONS, parts
from quartering.units import quantity
from quartering.view.commands.conditions import typed_ship
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


def describe_hull(name: str, changes: Mapping[str, str], output: str | None, as_json: bool) -> None:
    """Print hydrostatics, loading, righting arm and calm-water exponents; draw the hull where asked."""
    one = typed_ship(name, changes)
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

        write((path, lambda part: style.save(hull_picture(one, angles, arms, fit), part)))
    if as_json:
        show_json(_facts(one, floats, fit, calm))
        return
    _print(one, floats, fit, calm)
    if path is not None:
        show(f"Wrote {path}")
    again = option_words(changes)
    show(next_steps(f"quartering coefficients {name}{again}", f"quartering polar {name}{again}"))


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

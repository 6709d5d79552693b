"""`quartering hull`: what floats, how it rights itself, and whether it keeps its course without waves."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.units import quantity
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Picture, ShipName
from quartering.view.console.files import PICTURES, TABLES, picture_files, reserve_path
from quartering.view.console.printed import Table, table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship, typed_value

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.hydrostatics import Hydrostatics
    from quartering.hull.righting.arm import RightingFit
    from quartering.hull.ship import Ship
    from quartering.hydro.decay.free_roll import FreeDamping
    from quartering.loads.waves import Wave

_FROUDE_NUMBERS = (0.0, 0.15, 0.25)
_NEUTRAL = 1e-9


def hull(
    ship: ShipName,
    changes: Changes,
    wave_length: Annotated[
        str | None,
        typer.Option(help="Of a wave on which GM and GZ are wanted too [m]: 150 or 1.0L, or a period, 9.8s."),
    ] = None,
    wave_height: Annotated[str | None, typer.Option(help="Of that wave [m].")] = None,
    heading: Annotated[str, typer.Option(help="To that wave [deg]; 0 is a following sea.")] = "0",
    output: Picture = None,
) -> Answer:
    """Body plan, hydrostatics, righting arm in calm water and on a wave, and course stability in calm water."""
    import numpy as np

    from quartering.hull.hydrostatics import hydrostatics
    from quartering.hull.righting.arm import righting_arm, righting_polynomial
    from quartering.hydro.calm_water import calm_water_exponents

    one = typed_ship(ship, changes)
    wave, mu = _wave(one, wave_length, wave_height, heading)
    path = reserve_path(output, (*PICTURES, *TABLES))
    floats, fit = hydrostatics(one), righting_polynomial(one)
    angles = np.linspace(0.0, 60.0, 61)
    arms = righting_arm(one, angles)
    calm = {
        u: calm_water_exponents(one, u)
        for u in (quantity(f"{fn} Fn", "speed", length=one.hull.length) for fn in _FROUDE_NUMBERS)
    }
    found = _gm_on(one, wave, mu)

    def draw() -> Figure:
        from quartering.view.plots.hull import hull_picture

        return hull_picture(one, angles, arms, fit, waves=_arms_on(one, wave, mu, angles))

    def lines() -> Iterator[Table | str]:
        yield from _lines(one, floats, fit, calm)
        if found is not None:
            yield _on_wave(found)

    def facts() -> dict[str, object]:
        return _facts(one, floats, fit, calm) | ({"on_wave": _facts_on(found)} if found is not None else {})

    again = f"{ship}{option_words(changes)}"
    return Answer(
        lines(),
        facts,
        picture_files(path, draw),
        next_steps=[f"quartering coefficients {again}", f"quartering polar {again}"],
        output=path,
        data=lambda: [
            *(part for part in lines() if isinstance(part, Table)),
            _arms(one, angles, arms, _arms_on(one, wave, mu, angles)),
        ],
    )


def _wave(one: Ship, length: str | None, height: str | None, heading: str) -> tuple[Wave | None, float]:
    """The wave typed, None where none was, and the heading to it."""
    mu = typed_value("heading", heading, one.sizes)
    if length is None and height is None:
        return None, mu
    if length is None or height is None:
        missing = "--wave-length" if length is None else "--wave-height"
        raise InputError(
            f"{missing} is missing; a wave has a length and a height, such as --wave-length 1.0L --wave-height 4"
        )
    from quartering.loads.waves import Wave

    return Wave(
        *(typed_value(key, text, one.sizes) for key, text in (("wave_length", length), ("wave_height", height)))
    ), mu


def _gm_on(one: Ship, wave: Wave | None, heading: float) -> xr.Dataset | None:
    """GM over the position of the crest; None without a wave."""
    if wave is None:
        return None
    from quartering.study.six_modes.gm_in_waves import gm_in_waves

    return gm_in_waves(one, wave, heading)


def _arms_on(one: Ship, wave: Wave | None, heading: float, angles: np.ndarray) -> dict[str, np.ndarray]:
    """Righting arms with the crest and with the trough at midship."""
    if wave is None:
        return {}
    from quartering.study.six_modes.gm_in_waves import righting_arm as arm_on_wave

    places = {"crest at midship": 0.0, "trough at midship": 0.5}
    return {words: arm_on_wave(one, angles, wave, heading, place) for words, place in places.items()}


def _arms(one: Ship, angles: np.ndarray, arms: np.ndarray, waves: Mapping[str, np.ndarray]) -> Table:
    """Righting arms over heel."""
    columns = {"heel [deg]": angles, "GZ [m]": arms} | {f"GZ, {words} [m]": values for words, values in waves.items()}
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    return table(f"{one.name}: righting arm", list(columns), rows)


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


def _lines(
    one: Ship, floats: Hydrostatics, fit: RightingFit, calm: Mapping[float, np.ndarray]
) -> Iterator[Table | str]:
    """Hydrostatics, loading, righting arm and calm-water exponents."""
    import numpy as np

    from quartering.hull.lines.bulb import bulb
    from quartering.hydro.capsize import capsize_limit
    from quartering.view.particulars import HYDROSTATICS, loading_rows, particular_rows
    from quartering.view.wording import carries_curve, exponents_words, speed_words

    rows = [(words, f"{round(getattr(floats, key), 9) + 0.0:.5g}", unit) for key, (words, unit) in HYDROSTATICS.items()]
    under = bulb(one.hull)
    if under.sections:
        words = f"of it in {under.sections} sections of a bulb wholly under water, left out in waves"
        rows.insert(1, (words, f"{under.volume:.5g}", "m3"))
    yield table(f"{one.name}: hydrostatics at T {one.hull.draught:.4g} m", ("quantity", "value", "unit"), rows, (1,))
    yield table("Loading", ("quantity", "value", "unit", "where it comes from"), loading_rows(one), (1,))
    told = particular_rows(one)
    if told:
        yield table("Told, and recorded", ("quantity", "value", "unit", "where it comes from"), told, (1,))
    powers = (("phi", fit.gm), ("phi^3", fit.gz3), ("phi^5", fit.gz5), ("phi^7", fit.gz7))
    terms = " ".join(f"{c:+.4g} {power}" for power, c in powers if c)
    fitted = f"GZ = {terms} m (phi in rad), within {fit.residual:.1%} of the largest up to {fit.max_angle:g} deg"
    if carries_curve(one):
        yield f"Righting arm: the equations carry the curve itself, as a spline. Fitted for comparison: {fitted}."
    else:
        yield f"Righting arm: the equations carry a polynomial, {fitted}."
    yield f"Capsize: roll past {capsize_limit(one).words}."
    if np.isfinite(fit.deck_angle):
        yield (
            f"The top of the offsets goes under at {fit.deck_angle:.3g} deg; beyond, the hull is closed by a deck there."
        )
    rows = [(speed_words(u, one.hull.length), exponents_words(z), _course(z)) for u, z in calm.items()]
    yield table("Small motions in calm water, rudder amidships: exponents", ("speed", "1/s", "verdict"), rows)


def _course(exponents: np.ndarray) -> str:
    """Stability in calm water in words; without speed nothing holds a ship on its course."""
    largest = float(exponents.real.max())
    return "neutral" if abs(largest) < _NEUTRAL else "course-unstable" if largest > 0 else "stable"


def _facts(one: Ship, floats: Hydrostatics, fit: RightingFit, calm: Mapping[float, np.ndarray]) -> dict[str, object]:
    import numpy as np

    from quartering.hull.lines.bulb import bulb
    from quartering.hydro.capsize import capsize_limit
    from quartering.hydro.decay.free_roll import free_damping

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

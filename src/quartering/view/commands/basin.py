"""`quartering basin`: the safe basin of a wave, and how waves erode it."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from rich.table import Table

from quartering.conventions import InputError
from quartering.hydro.capsize import capsize_limit
from quartering.hydro.coefficients import coefficients
from quartering.loads.waves import STEEPEST, Wave
from quartering.motion.of_ship import equations
from quartering.motion.transient.basin import basin
from quartering.options import OPTIONS
from quartering.stability.ahead import announce_compilation
from quartering.view.commands.conditions import condition, sizes
from quartering.view.options import values
from quartering.view.output import PICTURES, claim, write
from quartering.view.progress import bar
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import ship_notes, speed_words

_ANGLES, _RATES, _HEIGHTS, _MOST_HEIGHTS = 61, 49, 9, 200


def erode(
    name: str,
    typed: tuple[str, str, str, str],
    heights: str | None,
    periods: int,
    changes: Mapping[str, str],
    output: str | None,
    as_json: bool,
) -> None:
    """Integrate from a grid of starts in each wave, print what is left of the basin, draw it where asked."""
    one, wave, speed, heading = condition(name, typed, changes)
    path = claim(output, PICTURES) if output is not None else None
    limit = capsize_limit(one)
    rate = coefficients(one, 0.0, 0.0).roll_frequency * limit.angle
    roll, rates = np.linspace(-limit.angle, limit.angle, _ANGLES), np.linspace(-rate, rate, _RATES)
    top = min(2.0 * wave.height, 0.999 * STEEPEST * wave.length)
    chosen = [0.0, *values([heights or f"0:{top}"], OPTIONS["wave_height"], sizes(one), "--wave-heights", _HEIGHTS)]
    if len(chosen) > _MOST_HEIGHTS:
        raise InputError(
            f'--wave-heights "{heights}": {len(chosen):,} heights, each with a basin of its own; give up to {_MOST_HEIGHTS}'
        )
    announce_compilation()
    waves = [Wave(wave.length, height) for height in sorted({*chosen, wave.height})]
    maps = []
    with bar("waves", len(waves)) as report:
        for i, each in enumerate(waves):
            model = equations(one, each, speed, heading)
            maps.append(basin(model, roll, rates, periods=periods))
            report(i + 1, len(waves))
    share = np.array([ds.attrs["safe_share"] for ds in maps])
    height = np.array([each.height for each in waves])
    integrity = share / share[0] if share[0] > 0 else np.full(share.size, math.nan)
    here = maps[int(np.flatnonzero(height == wave.height)[0])]
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.basin import basin_picture

        title = f"{one.name}: heading {heading:g} deg, {speed_words(speed, one.hull.length)}, wave length {wave.length:.4g} m"
        picture = basin_picture(here, (height, integrity), wave.height, limit.words, title, ship_notes(one))
        write((path, lambda part: style.save(picture, part)))
    at = float(integrity[height == wave.height][0])
    if as_json:
        curve = [
            {"wave_height": h, "safe_share": s, "integrity": q}
            for h, s, q in zip(height, share, integrity, strict=True)
        ]
        show_json(
            {
                "ship": one.name, "heading": heading, "speed": speed, "wave_length": wave.length,
                "wave_height": wave.height, "capsize_angle_deg": limit.angle, "capsize_reason": limit.reason,
                "periods": periods, "integrity": at,
                "curve": curve,
                "picture": None if path is None else str(path),
            }
        )  # fmt: skip
        return
    show(
        f"In waves of {wave.height:g} m, {at:.1%} of the starts that are safe in calm water stay below {limit.words},"
        f" for {periods} wave periods."
    )
    show(_curve(height, share, integrity), ship_notes(one))
    if path is not None:
        show(f"Wrote {path}")
    name += option_words(changes)
    words = f"--heading {typed[0]} --speed {typed[1]} --wave-length {typed[2]} --wave-height {typed[3]}"
    first = [f"quartering basin {name} {words} -o basin.png"] if path is None else []
    show(next_steps(*first, f"quartering branch {name} {words} --over wave_height"))


def _curve(height: np.ndarray, share: np.ndarray, integrity: np.ndarray) -> Table:
    rows = [(f"{h:.3g}", f"{s:.1%}", f"{q:.1%}") for h, s, q in zip(height, share, integrity, strict=True)]
    return table(
        "Integrity of the safe basin", ("wave height [m]", "of all starts", "of the safe ones"), rows, (0, 1, 2)
    )

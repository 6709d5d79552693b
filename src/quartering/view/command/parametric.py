"""`quartering parametric`: parametric roll and pure loss in a regular sea."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Picture, ShipName, Speed, WaveHeight, WaveLength
from quartering.view.console.files import PICTURES, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import Typed

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

    from quartering.study.six_modes.parametric_roll import ParametricRoll

_NUMBERS = (
    ("growth of small roll, sway and yaw free", "growth", "1/s"),
    ("growth of roll alone", "growth_roll_only", "1/s"),
    ("time to grow tenfold", "tenfold", "s"),
    ("GM along heave and pitch, mean", "gm_mean", "m"),
    ("GM along heave and pitch, first harmonic", "gm_first", "m"),
    ("GM along heave and pitch, least", "gm_least", "m"),
    ("GM at rest on the wave, mean", "gm_mean_quasistatic", "m"),
    ("GM at rest on the wave, first harmonic", "gm_first_quasistatic", "m"),
    ("encounter frequency over that of roll", "frequency_ratio", "-"),
    ("variation of GM with which roll alone grows", "threshold", "-"),
    ("variation of GM over it", "margin", "-"),
    ("GM below zero, of each encounter", "time_below_zero", "s"),
    ("water over the top of the offsets", "deck_under", "m"),
)
"""What is printed: in words, the attribute of the record, its unit."""
_SPEEDS, _HEIGHTS = 13, 9
"""Speeds and heights of the picture, up to twice those typed."""


def parametric(
    ship: ShipName,
    changes: Changes,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    heading: Annotated[str, typer.Option(help="180 for a head sea, 0 for a following one; or another.")] = "180",
    output: Picture = None,
) -> Answer:
    """Parametric roll and pure loss in a regular sea; with -o a map over speed and height in a head or following one."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.six_modes.parametric_roll import parametric_roll

    one, wave, u, mu = Typed(ship, heading, speed, wave_length, wave_height, changes).read()
    path = reserve_path(output, PICTURES)
    if path is not None and mu not in (0.0, 180.0):
        raise InputError(f"--heading: {mu:g} deg; a map is drawn of head (180) and following (0) seas; try 180")
    announce_compilation()
    found = parametric_roll(one, wave, u, mu)

    def draw() -> Figure:
        import numpy as np

        from quartering.study.six_modes.parametric_map import parametric_map
        from quartering.view.plots.parametric import parametric_picture

        heights = np.linspace(0.0, min(2 * wave.height, wave.length / 8), _HEIGHTS + 1)[1:]
        speeds = np.linspace(0.0, max(2 * u, 1.0), _SPEEDS)
        return parametric_picture(parametric_map(one, wave.length, heights.tolist(), speeds.tolist(), mu))

    again = f"{ship}{option_words(changes)}"
    return Answer(
        _lines(found),
        lambda: _facts(found) | {"file": str(path) if path else None},
        picture_files(path, draw),
        next_steps=[f"quartering hull {again}", f"quartering criteria {again}"],
    )


def _lines(found: ParametricRoll) -> Iterator[Table | str]:
    yield found.sentence
    rows = [(words, _shown(getattr(found, key)), unit) for words, key, unit in _NUMBERS]
    rolls = ", ".join(f"{roll:.3g}" for roll in found.amplitude) or "none"
    rows.append(("stable roll of two wave periods", rolls, "deg"))
    yield table("In numbers", ("quantity", "value", "unit"), rows, (1,))


def _shown(value: float) -> str:
    return "-" if math.isnan(value) else "never" if math.isinf(value) else f"{value:.4g}"


def _facts(found: ParametricRoll) -> dict[str, object]:
    """Everything for programs."""
    facts: dict[str, object] = {
        key: getattr(found, key)
        for key in ("ship", "speed", "heading", "encounter_frequency", "kind", "unstable", "amplitude", "sentence")
    }
    facts |= {"wave_length": found.wave.length, "wave_height": found.wave.height}
    facts |= {"status": found.status.name, "advice": found.status.advice}
    return facts | {key: getattr(found, key) for _, key, _ in _NUMBERS} | {"growth_below_zero": found.growth_below_zero}

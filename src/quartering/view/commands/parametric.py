"""`quartering parametric`: parametric roll and pure loss in a regular sea."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from quartering.conventions import InputError
from quartering.stability.ahead import announce_compilation
from quartering.study.parametric_map import parametric_map
from quartering.study.parametric_roll import ParametricRoll, parametric_roll
from quartering.view.commands.conditions import condition
from quartering.view.output import PICTURES, claim, write
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table

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


def judge_parametric(
    name: str, typed: tuple[str, str, str, str], changes: Mapping[str, str], output: str | None, as_json: bool
) -> None:
    """Print what the wave does to roll; draw the map over speed and wave height where asked."""
    one, wave, speed, heading = condition(name, typed, changes)
    path = claim(output, PICTURES) if output is not None else None
    if path is not None and heading not in (0.0, 180.0):
        raise InputError(f"--heading: {heading:g} deg; a map is drawn of head (180) and following (0) seas; try 180")
    announce_compilation()
    found = parametric_roll(one, wave, speed, heading)
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.parametric import parametric_picture

        heights = np.linspace(0.0, min(2 * wave.height, wave.length / 8), _HEIGHTS + 1)[1:]
        speeds = np.linspace(0.0, max(2 * speed, 1.0), _SPEEDS)
        picture = parametric_picture(parametric_map(one, wave.length, heights.tolist(), speeds.tolist(), heading))
        write((path, lambda part: style.save(picture, part)))
    if as_json:
        show_json(_facts(found) | {"file": str(path) if path else None})
        return
    show(found.sentence)
    rows = [(words, _shown(getattr(found, key)), unit) for words, key, unit in _NUMBERS]
    rolls = ", ".join(f"{roll:.3g}" for roll in found.amplitude) or "none"
    show(
        table(
            "In numbers",
            ("quantity", "value", "unit"),
            [*rows, ("stable roll of two wave periods", rolls, "deg")],
            (1,),
        )
    )
    if path is not None:
        show(f"Wrote {path}")
    again = option_words(changes)
    show(next_steps(f"quartering hull {name}{again}", f"quartering criteria {name}{again}"))


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

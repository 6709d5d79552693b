"""What is told of roll in a regular sea in six modes: by `quartering parametric`, and by `verdict` where they are asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from quartering.view.console.printed import table

if TYPE_CHECKING:
    from quartering.study.six_modes.parametric_roll import ParametricRoll
    from quartering.view.console.printed import Table

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


def parametric_lines(found: ParametricRoll) -> Iterator[Table | str]:
    """Its sentence, and its numbers."""
    yield found.sentence
    rows = [(words, _shown(getattr(found, key)), unit) for words, key, unit in _NUMBERS]
    rolls = ", ".join(f"{roll:.3g}" for roll in found.amplitude) or "none"
    rows.append(("stable roll of two wave periods", rolls, "deg"))
    yield table("In numbers", ("quantity", "value", "unit"), rows, (1,))


def _shown(value: float) -> str:
    return "-" if math.isnan(value) else "never" if math.isinf(value) else f"{value:.4g}"


def parametric_facts(found: ParametricRoll) -> dict[str, object]:
    """Everything for programs."""
    facts: dict[str, object] = {
        key: getattr(found, key)
        for key in ("ship", "speed", "heading", "encounter_frequency", "kind", "unstable", "amplitude", "sentence")
    }
    facts |= {"wave_length": found.wave.length, "wave_height": found.wave.height}
    facts |= {"status": found.status.name, "advice": found.status.advice}
    return facts | {key: getattr(found, key) for _, key, _ in _NUMBERS} | {"growth_below_zero": found.growth_below_zero}

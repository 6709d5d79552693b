"""`quartering surf-riding`: from which speed on a following wave holds the ship."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Picture, ShipName, WaveHeight, WaveLength
from quartering.view.console.files import PICTURES, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship, typed_value

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from quartering.study.six_modes.surf_riding import SurfRiding
    from quartering.view.console.printed import Table

_NUMBERS = (
    ("celerity of the wave", "celerity", "m/s"),
    ("celerity as a Froude number", "celerity_froude", "-"),
    ("surging force of the wave", "force", "N"),
    ("the same of a low wave, scaled up", "force_low", "N"),
    ("mass of the ship", "mass", "kg"),
    ("added mass in surge", "added_mass", "kg"),
    ("first threshold, revolutions", "first_revolutions", "1/s"),
    ("first threshold, nominal Froude number", "first_froude", "-"),
    ("second threshold, revolutions", "revolutions_exact", "1/s"),
    ("second threshold, nominal Froude number", "froude_exact", "-"),
    ("the same by Melnikov, revolutions", "revolutions", "1/s"),
    ("the same by Melnikov, Froude number", "froude", "-"),
    ("the wave can hold it up to, revolutions", "last_revolutions", "1/s"),
    ("the wave can hold it up to, Froude number", "last_froude", "-"),
)
"""What is printed: in words, the attribute of the record, its unit."""
_POINTS = 25
_STEEPNESSES, _LENGTHS = (0.005, 0.1), (0.8, 2.5)
"""Ranges of the picture: height over length, wave length over ship length."""


def surf_riding(
    ship: ShipName,
    changes: Changes,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    speed: Annotated[
        str | None, typer.Option(help="Nominal speed to judge, that of the ship in calm water: 7.5, 15kn, 0.3Fn.")
    ] = None,
    output: Picture = None,
) -> Answer:
    """Surf-riding in a following wave; with -o a diagram over Froude number, steepness and wave length."""
    from quartering.loads.waves import Wave
    from quartering.stability.precompile import announce_compilation
    from quartering.study.six_modes.surf_riding import surf_riding as judged

    one = typed_ship(ship, changes)
    length, height = (
        typed_value(name, text, one.sizes)
        for name, text in (("wave_length", wave_length), ("wave_height", wave_height))
    )
    nominal = None if speed is None else typed_value("speed", speed, one.sizes)
    path = reserve_path(output, PICTURES)
    wave = Wave(length, height)
    announce_compilation()
    found = judged(one, wave, speed=nominal)

    def draw() -> Figure:
        import numpy as np

        from quartering.study.six_modes.surf_riding import surf_riding_map
        from quartering.view.plots.surf_riding import surf_riding_picture

        steep = surf_riding_map(one, wave.length, np.linspace(*_STEEPNESSES, _POINTS).tolist())
        lengths = np.linspace(*_LENGTHS, _POINTS) * one.hull.length
        return surf_riding_picture(steep, surf_riding_map(one, lengths.tolist(), wave.steepness), found.speed_froude)

    again = f"{ship}{option_words(changes)}"
    told = "15kn" if speed is None else speed
    return Answer(
        _lines(found),
        lambda: _facts(found) | {"file": str(path) if path else None},
        picture_files(path, draw),
        next_steps=[
            f"quartering criteria {again} --speed {told}",
            f"quartering parametric {again} --wave-length {wave_length} --wave-height {wave_height} --speed {told} --heading 0",
        ],
    )


def _lines(found: SurfRiding) -> Iterator[Table | str]:
    yield found.sentence
    rows = [(words, _shown(getattr(found, key)), unit) for words, key, unit in _NUMBERS]
    yield table("In numbers", ("quantity", "value", "unit"), rows, (1,))


def _shown(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.4g}"


def _facts(found: SurfRiding) -> dict[str, object]:
    """Everything for programs."""
    facts: dict[str, object] = {
        key: getattr(found, key) for key in ("ship", "kind", "sentence", "source", "estimated", "speed", "speed_froude")
    }
    facts |= {"wave_length": found.wave.length, "wave_height": found.wave.height}
    facts |= {"status": found.status.name, "advice": found.status.advice}
    return facts | {key: getattr(found, key) for _, key, _ in _NUMBERS}

"""`quartering parametric`: parametric roll and pure loss in a regular sea."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Picture, ShipName, Speed, WaveHeight, WaveLength
from quartering.view.console.files import PICTURES, TABLES, is_table, picture_files, reserve_path
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import Typed
from quartering.view.parametric_record import parametric_facts, parametric_lines

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
    path = reserve_path(output, (*PICTURES, *TABLES))
    if path is not None and not is_table(path) and mu not in (0.0, 180.0):
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
        parametric_lines(found),
        lambda: parametric_facts(found) | {"file": str(path) if path else None},
        picture_files(path, draw),
        output=path,
        next_steps=[f"quartering hull {again}", f"quartering criteria {again}"],
    )

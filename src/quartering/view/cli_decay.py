"""The command that makes the roll damping of a ship from a measured decay."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.view.arguments import Json
from quartering.view.outcome import answering


def decay(
    record: Annotated[str, typer.Argument(help="Record of a free roll decay: a text file of time [s] and angle.")],
    ship: Annotated[
        str | None, typer.Option("--ship", help="Ship file, or built-in ship, as loaded when it was measured.")
    ] = None,
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Ship file to write, such as damped.yaml.")
    ] = None,
    picture: Annotated[str | None, typer.Option(help="Picture of record and envelopes: .png, .svg or .pdf.")] = None,
    unit: Annotated[
        str | None, typer.Option(help="Of the angle, deg or rad; otherwise the name of its column tells.")
    ] = None,
    columns: Annotated[
        str | None, typer.Option(help="Which columns hold time and angle, such as 2,3; otherwise it has two.")
    ] = None,
    speed: Annotated[str, typer.Option(help="Speed it was measured at, full scale: 7.5 [m/s], 15kn or 0.25Fn.")] = "0",
    scale: Annotated[str, typer.Option(help="Scale of a model whose time it is, such as 68 for 1:68.")] = "1",
    skip: Annotated[int, typer.Option(help="Extremes left out after the release.")] = 0,
    json: Json = False,
) -> None:
    """Fit a measured roll decay and write a ship file with its damping, less what the ship's waves and drag have already."""
    with answering():
        from quartering.view.commands.decay import Request, damp_ship

        damp_ship(Request(record, ship, output, picture, unit, columns, speed, scale, skip), json)

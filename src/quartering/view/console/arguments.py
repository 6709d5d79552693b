"""Arguments and options that several commands share, with their help."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

import typer

from quartering.options import OPTIONS, line_of

ShipName = Annotated[str, typer.Argument(help="Built-in ship (see `quartering ships`) or path of a ship file.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of tables.")]
Picture = Annotated[
    str | None, typer.Option("-o", "--output", help="Picture to write: .png, .svg or .pdf; or tables: .csv or .xlsx.")
]
PictureOrData = Annotated[
    str | None,
    typer.Option(
        "-o", "--output", help="To write: a picture (.png, .svg, .pdf), the dataset (.nc), or tables (.csv, .xlsx)."
    ),
]
DataOrTables = Annotated[
    str | None, typer.Option("-o", "--output", help="To write: the dataset (.nc), or tables (.csv, .xlsx).")
]
TableFile = Annotated[str | None, typer.Option("-o", "--output", help="Tables to write: .csv or .xlsx.")]


def _told(name: str, example: str) -> Any:
    """Option of the command line for one of the condition, with the words of the table."""
    one = OPTIONS[name]
    text = line_of(one)
    return typer.Option(one.command, help=f"{text[0].upper()}{text[1:]}: {example}.")


Heading = Annotated[str, _told("heading", "30")]
Speed = Annotated[str, _told("speed", "7.5, 15kn or 0.25Fn")]
WaveLength = Annotated[str, _told("wave_length", "150, 1.0L, or a period, 9.8s")]
WaveHeight = Annotated[str, _told("wave_height", "4")]
Changes = Mapping[str, str]
"""Options of the ship as typed, name -> text, see `quartering.view.console.run`."""
Harmonics = Annotated[int, typer.Option(help="1: the paper's method; 3, 5, 7, .. 199: harmonic balance to that order.")]
Modes = Annotated[
    str,
    typer.Option(help="three: sway, roll, yaw; six: heave and pitch too, GZ changing in the wave, head seas answered."),
]
FormName = Annotated[str, typer.Option(help="Diffraction force: stf, relative-motion, paper-corrected or paper.")]

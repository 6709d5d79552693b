"""Arguments and options that several commands share, with their help."""

from __future__ import annotations

from typing import Annotated

import typer

Ship = Annotated[str, typer.Argument(help="Built-in ship (see `quartering ships`) or path of a ship file.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of tables.")]
Picture = Annotated[str | None, typer.Option("-o", "--output", help="Picture to write: .png, .svg or .pdf.")]
Heading = Annotated[str, typer.Option(help="Heading [deg]: 0 following, 90 beam, 180 head sea.")]
Speed = Annotated[str, typer.Option(help="Speed: 7.5 [m/s], 15kn or 0.25Fn.")]
WaveLength = Annotated[str, typer.Option(help="Wave length: 150 [m] or 1.0L.")]
WaveHeight = Annotated[str, typer.Option(help="Wave height, crest to trough: 4 [m].")]
Harmonics = Annotated[int, typer.Option(help="1: the paper's method; 3, 5, 7, .. 199: harmonic balance to that order.")]
Autopilot = Annotated[
    str | None,
    typer.Option(
        help="Autopilot: gain,rate gain [s],lag [s], such as 1,10s,2s; or none. Otherwise the ship file's own."
    ),
]
Velocities = Annotated[
    str | None,
    typer.Option(
        help="Lift acts on the velocity relative (to the water) or absolute (the paper). Otherwise the ship file's own."
    ),
]
Form = Annotated[str, typer.Option(help="Diffraction force: stf, relative-motion, paper-corrected or paper.")]

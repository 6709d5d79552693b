"""Commands about one condition: its steady motion, its verdict, its course in time."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.view.arguments import (
    Changes,
    Form,
    Harmonics,
    Heading,
    Json,
    Picture,
    Ship,
    Speed,
    WaveHeight,
    WaveLength,
)
from quartering.view.outcome import answering


def verdict(
    ship: Ship,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    harmonics: Harmonics = 1,
    form: Form = "stf",
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Judge the steady motion in one condition: how large, stable or not, why, and what cures it."""
    with answering():
        from quartering.view.commands.verdict import judge

        judge(ship, (heading, speed, wave_length, wave_height), harmonics, form, changes or {}, json)


def simulate(
    ship: Ship,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    roll: Annotated[str, typer.Option(help="Roll angle at the start [deg].")] = "5",
    duration: Annotated[str, typer.Option(help="Duration: 300 [s] or 5min.")] = "300",
    output: Picture = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Integrate the full equations in time from a roll angle."""
    with answering():
        from quartering.view.commands.simulate import run_simulation

        run_simulation(ship, (heading, speed, wave_length, wave_height), roll, duration, changes or {}, output, json)


def branch(
    ship: Ship,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    over: Annotated[
        str,
        typer.Option(
            help="What changes: wave_height, heading, speed, wave_length, frequency, gm, .. or a term, K_ppp."
        ),
    ] = "wave_height",
    limits: Annotated[str | None, typer.Option(help="From and to: 1:6 [m], 20:160 [deg], 5kn:15kn.")] = None,
    harmonics: Harmonics = 9,
    output: Picture = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Follow every motion over one parameter: folds, bifurcations, what is stable."""
    with answering():
        from quartering.view.commands.branch import follow_motions

        follow_motions(
            ship, (heading, speed, wave_length, wave_height), over, limits, harmonics, changes or {}, output, json
        )


def basin(
    ship: Ship,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    wave_heights: Annotated[
        str | None, typer.Option(help="Heights of the integrity curve: 0:8:9 [m]; by default up to twice the height.")
    ] = None,
    periods: Annotated[int, typer.Option(help="Wave periods to go on for.")] = 16,
    output: Picture = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """From which roll angles and rates the ship survives a wave, and how waves erode that safe basin."""
    with answering():
        from quartering.view.commands.basin import erode

        erode(ship, (heading, speed, wave_length, wave_height), wave_heights, periods, changes or {}, output, json)

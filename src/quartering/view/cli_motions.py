"""Commands about one condition: its steady motion, its verdict, its course in time."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.view.arguments import (
    Autopilot,
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
    autopilot: Autopilot = None,
    json: Json = False,
) -> None:
    """Judge the steady motion in one condition: how large, stable or not, why, and what cures it."""
    with answering():
        from quartering.view.commands.verdict import judge

        judge(ship, (heading, speed, wave_length, wave_height), harmonics, form, autopilot, json)


def simulate(
    ship: Ship,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    roll: Annotated[str, typer.Option(help="Roll angle at the start [deg].")] = "5",
    duration: Annotated[str, typer.Option(help="Duration: 300 [s] or 5min.")] = "300",
    autopilot: Autopilot = None,
    output: Picture = None,
    json: Json = False,
) -> None:
    """Integrate the full equations in time from a roll angle."""
    with answering():
        from quartering.view.commands.simulate import run_simulation

        run_simulation(ship, (heading, speed, wave_length, wave_height), roll, duration, autopilot, output, json)

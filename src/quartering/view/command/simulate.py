"""`quartering simulate`: the full equations in time."""

from __future__ import annotations

import math
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Heading, ShipName, Speed, WaveHeight, WaveLength
from quartering.view.console.files import PICTURES, TABLES, File, picture_files, reserve_path
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import Typed
from quartering.view.console.typed_values import value

MOVING = (".gif", ".mp4")
"""Kinds of moving picture."""

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.motion.equations.model import Model


def simulate(
    ship: ShipName,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    changes: Changes,
    roll: Annotated[str, typer.Option(help="Roll angle at the start [deg].")] = "5",
    duration: Annotated[str, typer.Option(help="Duration: 300 [s] or 5min.")] = "300",
    output: Annotated[
        str | None,
        typer.Option(
            "-o",
            "--output",
            help="To write: a picture (.png, .svg, .pdf), the ship moving in its wave (.gif, .mp4), or tables (.csv, .xlsx).",
        ),
    ] = None,
) -> Answer:
    """Integrate the full equations in time from a roll angle."""
    import numpy as np

    from quartering.hull.righting.arm import warn_of_polynomial
    from quartering.motion.of_ship import equations
    from quartering.motion.steady.motion import steady_motion, within_limit
    from quartering.motion.transient.simulate import simulate as simulated
    from quartering.stability.precompile import announce_compilation
    from quartering.view.wording import ship_notes, speed_words

    typed = Typed(ship, heading, speed, wave_length, wave_height, changes)
    one, wave, u, mu = typed.read()
    path = reserve_path(output, (*PICTURES, *MOVING, *TABLES))
    program = _film_program(path)
    seconds = value(duration, "time", one.sizes, "--duration")
    heel = value(roll, "angle", one.sizes, "--roll")
    announce_compilation()
    model = equations(one, wave, u, mu)
    trace = simulated(model, seconds, (0.0, math.radians(heel), 0.0, 0.0))
    motion = within_limit(model, steady_motion(model, 3, start="rest"))
    steady = math.degrees(motion.peak[1]) if motion.status.ok else None
    limit, capsize = model.capsize_limit, trace.attrs.get("capsize_time")
    largest = float(np.abs(trace["roll"]).max())
    warn_of_polynomial(one, min(largest, limit.angle))
    late = float(np.abs(trace["roll"].where(trace["time"] > 0.75 * seconds)).max())

    def draw() -> Figure:
        from quartering.view.plots.trace import trace_picture

        at = f"heading {mu:g} deg, {speed_words(u, one.hull.length)}"
        title = f"{one.name}: {at}, wave {wave.length:.4g} x {wave.height:.3g} m"
        note = f"Full nonlinear equations, from rest but for the roll angle. {ship_notes(one)}"
        return trace_picture(trace, steady, title, note)

    known = f"the steady motion peaks at {steady:.3g} deg" if steady is not None else "no steady motion was found"
    sentence = f"Largest roll {largest:.3g} deg, in the last quarter {late:.3g} deg; {known}."
    if capsize is not None:
        sentence = f"Capsizes after {capsize:.3g} s (roll past {limit.words})."

    def facts() -> dict[str, object]:
        return {
            "ship": one.name, "condition": dict(model.source), "roll_at_start_deg": heel,
            "largest_roll_deg": largest, "largest_late_roll_deg": late, "steady_roll_peak_deg": steady,
            "capsize_time": capsize, "capsize_angle_deg": limit.angle, "capsize_reason": limit.reason,
        }  # fmt: skip

    return Answer(
        iter([sentence]),
        facts,
        [*picture_files(path, draw), *_moving(path, program, one, model, trace)],
        remarks=[ship_notes(one)],
        next_steps=[f"quartering verdict {ship} {typed.words}{option_words(changes)}"],
        output=path,
        data=lambda: [data_table(trace, f"{one.name}: motion in time")],
    )


def _film_program(path: Path | None) -> str:
    """The program that writes a film, where one is asked for.

    Raises
    ------
    InputError    it is not on this machine
    """
    if path is None or path.suffix.lower() != ".mp4":
        return ""
    found = shutil.which("ffmpeg")
    if found is None:
        raise InputError(
            f'output "{path}": films are written by ffmpeg, which is not on this machine; install it, or write '
            f'"{path.with_suffix(".gif")}"'
        )
    return found


def _moving(path: Path | None, program: str, one: Ship, model: Model, trace: xr.Dataset) -> list[File]:
    """The file of the ship moving in its wave; none where another one is asked for."""
    if path is None or path.suffix.lower() not in MOVING:
        return []

    def writer(part: Path) -> None:
        from quartering.view.plots.ship_in_wave import write_moving

        write_moving(part, one, model, trace, program)

    return [File(path, writer)]

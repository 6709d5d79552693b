"""Commands about many conditions: maps, what a value does, sweeps and their stored results."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.view.arguments import Form, Harmonics, Json, Picture, Ship, Velocities
from quartering.view.outcome import answering


def polar(
    ship: Ship,
    speed: Annotated[list[str] | None, typer.Option(help="Speeds: 5,7.5 [m/s], 15kn, 0.25Fn; repeatable.")] = None,
    headings: Annotated[str, typer.Option(help="Headings [deg]: from:to:count or a list.")] = "0:180:37",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: from:to:count or a list, m or L.")] = "0.4L:2.3L:20",
    steepness: Annotated[
        str | None, typer.Option(help="Wave height over wave length; 1/50 where nothing is given.")
    ] = None,
    wave_height: Annotated[
        str | None, typer.Option(help="One wave height for all lengths [m], instead of a steepness.")
    ] = None,
    harmonics: Harmonics = 1,
    form: Form = "stf",
    velocities: Velocities = None,
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Dataset to write (.nc); a .png goes beside it.")
    ] = None,
    json: Json = False,
) -> None:
    """Map of roll and stability over headings, wave lengths and speeds."""
    with answering():
        from quartering.view.commands.polar import draw_map

        waves = (wave_lengths, steepness, wave_height)
        draw_map(ship, speed or ["0.15Fn,0.2Fn,0.25Fn"], headings, waves, harmonics, form, output, velocities, json)


_RANGE = "from:to or from:to:count"


def vary(
    ship: Ship,
    heading: Annotated[str, typer.Option(help=f"Heading [deg], or {_RANGE}.")] = "45",
    speed: Annotated[str, typer.Option(help=f"Speed: 7.5 [m/s], 15kn, 0.25Fn, or {_RANGE}.")] = "0.2Fn",
    wave_length: Annotated[str, typer.Option(help=f"Wave length: 150 [m], 1L, or {_RANGE}.")] = "1L",
    wave_height: Annotated[str, typer.Option(help=f"Wave height: 4 [m], 0.02L, or {_RANGE}.")] = "0.02L",
    gm: Annotated[str | None, typer.Option(help=f"GM [m, B], {_RANGE}.")] = None,
    kg: Annotated[str | None, typer.Option(help=f"KG [m, T], {_RANGE}.")] = None,
    gyradius_roll: Annotated[str | None, typer.Option(help=f"k_xx [m, B], {_RANGE}.")] = None,
    gyradius_yaw: Annotated[str | None, typer.Option(help=f"k_zz [m, L], {_RANGE}.")] = None,
    roll_damping: Annotated[str | None, typer.Option(help=f"Added roll damping, share of critical, {_RANGE}.")] = None,
    bilge_keel_length: Annotated[
        str | None, typer.Option(help=f"Length of each bilge keel [m, L]: a value, {_RANGE}.")
    ] = None,
    bilge_keel_breadth: Annotated[
        str | None, typer.Option(help=f"Breadth of each bilge keel [m, B]: a value, {_RANGE}.")
    ] = None,
    coefficient: Annotated[
        list[str] | None, typer.Option(help="K_ppp=0.2:2: factors on a coefficient; repeatable.")
    ] = None,
    tornado: Annotated[
        str | None, typer.Option(help="10%: change every value by so much, one at a time, instead of a range.")
    ] = None,
    harmonics: Harmonics = 1,
    form: Form = "stf",
    velocities: Velocities = None,
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Picture (.png, .svg, .pdf) or dataset (.nc) to write.")
    ] = None,
    json: Json = False,
) -> None:
    """What one or two values do to roll and stability, and where the verdict flips."""
    with answering():
        condition = {"heading": heading, "speed": speed, "wave_length": wave_length, "wave_height": wave_height}
        loading = {
            "gm": gm, "kg": kg, "gyradius_roll": gyradius_roll, "gyradius_yaw": gyradius_yaw, "roll_damping": roll_damping,
            "bilge_keel_length": bilge_keel_length, "bilge_keel_breadth": bilge_keel_breadth,
        }  # fmt: skip
        ranges = {name: text for name, text in loading.items() if text is not None}
        if tornado is not None:
            from quartering.view.commands.tornado import draw_tornado

            draw_tornado(ship, condition, ranges, coefficient or [], tornado, harmonics, form, output, velocities, json)
        else:
            from quartering.view.commands.vary import draw_variation

            draw_variation(ship, condition, ranges, coefficient or [], harmonics, form, output, velocities, json)


def sweep(
    case: Annotated[str, typer.Argument(help="Case file, see `quartering new --case`.")],
    output: Annotated[
        str | None,
        typer.Option(
            "-o", "--output", help="Folder of the results, by default the case's name; a .nc file with --uncertainty."
        ),
    ] = None,
    cluster: Annotated[str | None, typer.Option(help="local:4, or tcp://host:8786 of a dask scheduler.")] = None,
    yes: Annotated[bool, typer.Option("--yes", help="Run it however large it is.")] = False,
    uncertainty: Annotated[
        str | None, typer.Option(help="K_ppp=20%,gm=5%: probability of instability instead of one verdict.")
    ] = None,
    draws: Annotated[int, typer.Option(help="Random draws with --uncertainty, a multiple of 8.")] = 256,
    json: Json = False,
) -> None:
    """Every condition of a case file; interrupted, it goes on where it was when it is called again."""
    with answering():
        from quartering.view.commands.sweep import run_sweep, run_uncertain

        if uncertainty is not None:
            run_uncertain(case, uncertainty, draws, output, cluster, yes, json)
        else:
            run_sweep(case, output, cluster, yes, json)


def worst(
    result: Annotated[str, typer.Argument(help="Folder of a sweep, or a .nc file.")],
    by: Annotated[str, typer.Option(help="roll: largest roll; margin: least stable.")] = "roll",
    count: Annotated[int, typer.Option(help="How many conditions.")] = 10,
    json: Json = False,
) -> None:
    """The worst conditions of a stored result."""
    with answering():
        from quartering.view.commands.result import show_worst

        show_worst(result, by, count, json)


def show(
    result: Annotated[str, typer.Argument(help="Folder of a sweep, or a .nc file.")],
    at: Annotated[
        list[str] | None,
        typer.Option(help="Cut at wave_height=4, steepness=1/30, gm=0.7, .., repeatable; the nearest value is taken."),
    ] = None,
    output: Picture = None,
    csv: Annotated[str | None, typer.Option(help="Table of the cut to write (.csv).")] = None,
    zarr: Annotated[str | None, typer.Option(help="Zarr store of the cut to write (a new folder).")] = None,
    json: Json = False,
) -> None:
    """What a stored result holds: the worst of every speed and heading; its map, or a table, without computing again."""
    with answering():
        from quartering.view.commands.result import show_result

        show_result(result, at or [], output, csv, zarr, json)

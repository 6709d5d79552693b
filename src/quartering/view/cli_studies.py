"""Commands about many conditions: maps, what a value does, sweeps and their stored results."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.options import OPTIONS, line_of
from quartering.view.arguments import Changes, Form, Harmonics, Json, Picture, Ship
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
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Dataset to write (.nc); a .png goes beside it.")
    ] = None,
    extend: Annotated[bool, typer.Option("--extend", help=f"{line_of(OPTIONS['extend']).partition(':')[0]}.")] = False,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Map of roll and stability over headings, wave lengths and speeds."""
    with answering():
        from quartering.view.commands.polar import draw_map

        waves = (wave_lengths, steepness, wave_height)
        draw_map(
            ship,
            speed or ["0.15Fn,0.2Fn,0.25Fn"],
            headings,
            waves,
            harmonics,
            form,
            changes or {},
            output,
            json,
            extend,
        )


_RANGE = "from:to or from:to:count"


def vary(
    ship: Ship,
    heading: Annotated[str, typer.Option(help=f"Heading [deg], or {_RANGE}.")] = "45",
    speed: Annotated[str, typer.Option(help=f"Speed: 7.5 [m/s], 15kn, 0.25Fn, or {_RANGE}.")] = "0.2Fn",
    wave_length: Annotated[str, typer.Option(help=f"Wave length: 150 [m], 1L, or {_RANGE}.")] = "1L",
    wave_height: Annotated[str, typer.Option(help=f"Wave height: 4 [m], 0.02L, or {_RANGE}.")] = "0.02L",
    coefficient: Annotated[
        list[str] | None, typer.Option(help="K_p=0.2:2: factors on a coefficient; repeatable.")
    ] = None,
    tornado: Annotated[
        str | None, typer.Option(help="10%: change every value by so much, one at a time, instead of a range.")
    ] = None,
    harmonics: Harmonics = 1,
    form: Form = "stf",
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Picture (.png, .svg, .pdf) or dataset (.nc) to write.")
    ] = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """What one or two values do to roll and stability, and where the verdict flips."""
    with answering():
        condition = {"heading": heading, "speed": speed, "wave_length": wave_length, "wave_height": wave_height}
        told = changes or {}
        if tornado is not None:
            from quartering.view.commands.tornado import draw_tornado

            draw_tornado(ship, condition, told, coefficient or [], tornado, harmonics, form, output, json)
        else:
            from quartering.view.commands.vary import draw_variation

            draw_variation(ship, condition, told, coefficient or [], harmonics, form, output, json)


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
        str | None, typer.Option(help="K_p=20%,gm=5%: probability of instability instead of one verdict.")
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

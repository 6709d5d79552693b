"""Commands about a ship: what is built in, its lines, coefficients and wave forces."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.conventions import InputError
from quartering.view.arguments import Changes, Json, Picture, Ship, Speed
from quartering.view.outcome import answering


def ships(json: Json = False) -> None:
    """List the built-in ships."""
    with answering():
        from quartering.view.commands.ships import list_ships

        list_ships(json)


def new(
    ship: Annotated[
        str | None, typer.Argument(help="Built-in ship to start from; with --offsets, the ship file to write.")
    ] = None,
    file: Annotated[str | None, typer.Argument(help="Ship file to write, such as my.yaml.")] = None,
    case: Annotated[
        bool, typer.Option("--case", help="Write the case file of a study with this ship instead.")
    ] = False,
    offsets: Annotated[
        str | None, typer.Option("--offsets", help="Lines of your own (CSV, PDSTRIP, GDF, STL) to start from instead.")
    ] = None,
    draught: Annotated[str | None, typer.Option(help="Draught of the lines, with --offsets [m].")] = None,
    length: Annotated[str | None, typer.Option(help="Between perpendiculars, with --offsets [m].")] = None,
    beam: Annotated[str | None, typer.Option(help="Moulded, with --offsets [m].")] = None,
    json: Json = False,
) -> None:
    """Write a commented ship file that starts from a built-in ship or from your own lines, or the case file of a study."""
    with answering():
        if offsets is not None:
            from quartering.view.commands.ships import new_from_offsets

            new_from_offsets(offsets, file or ship, {"draught": draught, "length": length, "beam": beam}, json)
            return
        if ship is None or file is None:
            raise InputError(
                "new: give a built-in ship and the file to write, `new wigley my.yaml`, or `new --offsets my.csv`"
            )
        if case:
            from quartering.view.commands.sweep import new_case

            new_case(ship, file, json)
            return
        from quartering.view.commands.ships import new_file

        new_file(ship, file, json)


def hull(
    ship: Ship,
    wave_length: Annotated[
        str | None,
        typer.Option(help="Of a wave on which GM and GZ are wanted too [m]: 150 or 1.0L, or a period, 9.8s."),
    ] = None,
    wave_height: Annotated[str | None, typer.Option(help="Of that wave [m].")] = None,
    heading: Annotated[str, typer.Option(help="To that wave [deg]; 0 is a following sea.")] = "0",
    output: Picture = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Body plan, hydrostatics, righting arm in calm water and on a wave, and course stability in calm water."""
    with answering():
        from quartering.view.commands.hull import describe_hull

        describe_hull(ship, (wave_length, wave_height, heading), changes or {}, output, json)


def responses(
    ship: Ship,
    speed: Speed = "0.2Fn",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: 0.5L,1L,2L or from:to:count.")] = "0.4L:3L:27",
    headings: Annotated[str, typer.Option(help="Headings [deg]: 0:180:13 or a list.")] = "0:180:7",
    place: Annotated[
        str | None,
        typer.Option(
            help="Of accelerations: x forward of midship, y to starboard, height over the baseline; G by default."
        ),
    ] = None,
    output: Annotated[str | None, typer.Option("-o", "--output", help="Table to write: .csv or .nc (netCDF).")] = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Linear responses in all six modes per metre of wave amplitude, over wave length and heading."""
    with answering():
        from quartering.view.commands.responses import list_responses

        list_responses(ship, (speed, wave_lengths, headings, place), changes or {}, output, json)


def coefficients(
    ship: Ship,
    speed: Speed = "0.2Fn",
    frequency: Annotated[str | None, typer.Option(help="Encounter frequency [rad/s]; by default that of roll.")] = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Every coefficient of the equations with value, unit and source."""
    with answering():
        from quartering.view.commands.coefficients import list_coefficients

        list_coefficients(ship, speed, frequency, changes or {}, json)


def forces(
    ship: Ship,
    speed: Speed = "0.2Fn",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: 0.5L,1L,2L or from:to:count.")] = "0.5L,1L,1.5L,2L",
    form: Annotated[
        list[str] | None,
        typer.Option(help="Form to show beside stf, repeatable; by default all but bem (Capytaine, at --speed 0)."),
    ] = None,
    output: Picture = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Wave force and moments over heading, for several wave lengths, the forms side by side."""
    with answering():
        from quartering.view.commands.forces import compare_forms

        compare_forms(ship, speed, wave_lengths, form or [], changes or {}, output, json)


def criteria(
    ship: Ship,
    speed: Annotated[
        str | None, typer.Option(help="Service speed: 15kn, 0.25Fn; what needs it is not judged without.")
    ] = None,
    kgmax: Annotated[bool, typer.Option("--kgmax", help="Limiting heights of G of every level instead.")] = False,
    draughts: Annotated[
        str | None, typer.Option(help="Draughts of --kgmax: 5,6.5 [m], or from:to:count; by default the ship's own.")
    ] = None,
    json: Json = False,
    changes: Changes = None,
) -> None:
    """The five failure modes of second-generation intact stability, levels 1 and 2."""
    with answering():
        from quartering.view.commands.criteria import judge_criteria, limit_heights

        if kgmax:
            limit_heights(ship, speed, draughts, changes or {}, json)
        elif draughts is not None:
            raise InputError("--draughts are those of --kgmax; one draught of the ship is --draught")
        else:
            judge_criteria(ship, speed, changes or {}, json)

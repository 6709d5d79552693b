"""The command line: what a person types. Each command's work, and every heavy import, lives in ``view/commands``."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.view.outcome import answering

app = typer.Typer(
    name="quartering",
    help="At which headings, speeds and waves does a ship roll badly or lose a stable motion, why, and what cures it?",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

Ship = Annotated[str, typer.Argument(help="Built-in ship (see `quartering ships`) or path of a ship file.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of tables.")]
Picture = Annotated[str | None, typer.Option("-o", "--output", help="Picture to write: .png, .svg or .pdf.")]
Heading = Annotated[str, typer.Option(help="Heading [deg]: 0 following, 90 beam, 180 head sea.")]
Speed = Annotated[str, typer.Option(help="Speed: 7.5 [m/s], 15kn or 0.25Fn.")]
WaveLength = Annotated[str, typer.Option(help="Wave length: 150 [m] or 1.0L.")]
WaveHeight = Annotated[str, typer.Option(help="Wave height, crest to trough: 4 [m].")]
Harmonics = Annotated[int, typer.Option(help="1: the paper's method; 3, 5, 7, ..: harmonic balance to that order.")]
Form = Annotated[str, typer.Option(help="Diffraction force: stf, relative-motion, paper-corrected or paper.")]


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"quartering {version('quartering')}")
        raise typer.Exit


@app.callback()
def main_options(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print it.")] = False,
) -> None:
    """At which headings, speeds and waves does a ship roll badly or lose a stable motion, why, and what cures it?"""


@app.command()
def ships(json: Json = False) -> None:
    """List the built-in ships."""
    with answering():
        from quartering.view.commands.ships import list_ships

        list_ships(json)


@app.command()
def new(
    ship: Annotated[str, typer.Argument(help="Built-in ship to start from.")],
    file: Annotated[str, typer.Argument(help="Ship file to write, such as my.yaml.")],
    case: Annotated[
        bool, typer.Option("--case", help="Write the case file of a study with this ship instead.")
    ] = False,
    json: Json = False,
) -> None:
    """Write a commented ship file that starts from a built-in ship, or the case file of a study."""
    with answering():
        if case:
            from quartering.view.commands.sweep import new_case

            new_case(ship, file, json)
            return
        from quartering.view.commands.ships import new_file

        new_file(ship, file, json)


@app.command()
def hull(ship: Ship, output: Picture = None, json: Json = False) -> None:
    """Body plan, hydrostatics, righting arm, and course stability in calm water."""
    with answering():
        from quartering.view.commands.hull import describe_hull

        describe_hull(ship, output, json)


@app.command()
def coefficients(
    ship: Ship,
    speed: Speed = "0.2Fn",
    frequency: Annotated[str | None, typer.Option(help="Encounter frequency [rad/s]; by default that of roll.")] = None,
    json: Json = False,
) -> None:
    """Every coefficient of the equations with value, unit and source."""
    with answering():
        from quartering.view.commands.coefficients import list_coefficients

        list_coefficients(ship, speed, frequency, json)


@app.command()
def forces(
    ship: Ship,
    speed: Speed = "0.2Fn",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: 0.5L,1L,2L or from:to:count.")] = "0.5L,1L,1.5L,2L",
    form: Annotated[
        list[str] | None, typer.Option(help="Diffraction form, repeatable; by default stf and paper.")
    ] = None,
    output: Picture = None,
    json: Json = False,
) -> None:
    """Wave force and moments over heading, for several wave lengths and forms of the diffraction force."""
    with answering():
        from quartering.view.commands.forces import compare_forms

        compare_forms(ship, speed, wave_lengths, form or ["stf", "paper"], output, json)


@app.command()
def verdict(
    ship: Ship,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    harmonics: Harmonics = 1,
    form: Form = "stf",
    json: Json = False,
) -> None:
    """Judge the steady motion in one condition: how large, stable or not, why, and what cures it."""
    with answering():
        from quartering.view.commands.verdict import judge

        judge(ship, (heading, speed, wave_length, wave_height), harmonics, form, json)


@app.command()
def polar(
    ship: Ship,
    speed: Annotated[list[str] | None, typer.Option(help="Speeds: 5,7.5 [m/s], 15kn, 0.25Fn; repeatable.")] = None,
    headings: Annotated[str, typer.Option(help="Headings [deg]: from:to:count or a list.")] = "0:180:37",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: from:to:count or a list, m or L.")] = "0.4L:2.3L:20",
    steepness: Annotated[str, typer.Option(help="Wave height over wave length.")] = "1/50",
    wave_height: Annotated[
        str | None, typer.Option(help="One wave height for all lengths [m], instead of a steepness.")
    ] = None,
    harmonics: Harmonics = 1,
    form: Form = "stf",
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Dataset to write (.nc); a .png goes beside it.")
    ] = None,
    json: Json = False,
) -> None:
    """Map of roll and stability over headings, wave lengths and speeds."""
    with answering():
        from quartering.view.commands.polar import draw_map

        waves = (wave_lengths, steepness, wave_height)
        draw_map(ship, speed or ["0.15Fn,0.2Fn,0.25Fn"], headings, waves, harmonics, form, output, json)


@app.command()
def sweep(
    case: Annotated[str, typer.Argument(help="Case file, see `quartering new --case`.")],
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Folder of the results; by default the case's name.")
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
            run_uncertain(case, uncertainty, draws, output, yes, json)
        else:
            run_sweep(case, output, cluster, yes, json)


@app.command()
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


@app.command()
def show(
    result: Annotated[str, typer.Argument(help="Folder of a sweep, or a .nc file.")],
    at: Annotated[list[str] | None, typer.Option(help="Cut at wave_height=4, repeatable.")] = None,
    output: Picture = None,
    csv: Annotated[str | None, typer.Option(help="Table of the cut to write (.csv).")] = None,
    json: Json = False,
) -> None:
    """What a stored result holds: the worst of every speed and heading; its map, or a table, without computing again."""
    with answering():
        from quartering.view.commands.result import show_result

        show_result(result, at or [], output, csv, json)


@app.command()
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
) -> None:
    """Integrate the full equations in time from a roll angle."""
    with answering():
        from quartering.view.commands.simulate import run_simulation

        run_simulation(ship, (heading, speed, wave_length, wave_height), roll, duration, output, json)


def main() -> None:
    """Entry point of the ``quartering`` command."""
    app()

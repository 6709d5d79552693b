"""Commands that make or serve pages."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.view.arguments import Json
from quartering.view.outcome import answering


def report(
    result: Annotated[
        str, typer.Argument(help="A .nc file, the folder of a sweep, or a ship, whose map is then made.")
    ],
    form: Annotated[
        str, typer.Option(help="report: all about the ship and its map; guidance: polar diagrams for every wave.")
    ] = "report",
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Page to write: .html, or .pdf (extra pdf).")
    ] = None,
    ship: Annotated[str | None, typer.Option(help="Ship file of the result, where it is not a built-in ship.")] = None,
    openings: Annotated[
        str | None, typer.Option(help="With --form guidance: heel at which unprotected openings go under [deg].")
    ] = None,
    json: Json = False,
) -> None:
    """A report to print: one page that holds everything, or polar diagrams in the form of operational guidance."""
    with answering():
        from quartering.view.commands.report import make_report

        make_report(result, form, output, ship, openings, json)


def app(
    ship: Annotated[
        str | None, typer.Argument(help="Built-in ship or ship file to open with; others can be chosen on the page.")
    ] = None,
    host: Annotated[
        str, typer.Option(help="Address to listen on; by default only this machine reaches it.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=1, max=65535, help="Port to listen on.")] = 8080,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,
    name: Annotated[
        list[str] | None, typer.Option(help="Further name the server goes by, as behind a proxy; may be repeated.")
    ] = None,
) -> None:
    """The explorer in the browser: choose a hull, turn the dials, watch the map; also serves /api/verdict and /api/polar."""
    with answering():
        from quartering.view.explorer.server import run_explorer

        run_explorer(ship, host, port, browser, name or ())

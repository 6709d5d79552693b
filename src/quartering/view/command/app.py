"""`quartering app`: the explorer in the browser."""

from __future__ import annotations

from typing import Annotated

import typer


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
    from quartering.view.explorer.server import run_explorer

    run_explorer(ship, host, port, browser, name or ())

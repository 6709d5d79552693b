"""The server of the page and the service: one process, reached from this machine only unless told otherwise."""

from __future__ import annotations

import importlib.util
import socket
import threading
import webbrowser
from collections.abc import Sequence
from contextlib import suppress

import typer

from quartering.conventions import InputError
from quartering.stability.precompile import announce_compilation

_LONGEST_MESSAGE = 1_000_000


def run_explorer(ship: str | None, host: str, port: int, browser: bool, names: Sequence[str] = ()) -> None:
    """Serve the explorer until Ctrl-C.

    ship: built-in ship or ship file to open with
    to listen on
    browser: open the page in the system's browser
    further names the server goes by, where it is reached by others than its host's
    """
    if importlib.util.find_spec("nicegui") is None:
        raise InputError("the explorer needs NiceGUI, which is not installed; try: pip install 'quartering[app]'")
    _check_port(host, port)
    import uvicorn

    from quartering.view.explorer.application import explorer
    from quartering.view.explorer.computing.guard import LOOPBACK
    from quartering.view.explorer.computing.patience import Patient
    from quartering.view.explorer.hulls.ship_registry import ShipRegistry

    announce_compilation()
    registry = ShipRegistry(ship)
    server = explorer(registry, registry.first, host, names)
    address = f"http://{host}:{port}/"
    typer.echo(f"quartering explorer: {address}   (Ctrl-C ends it; the service is described at {address}api/docs)")
    if host not in LOOPBACK:
        typer.echo(f"note: everyone who can reach {host} can use it", err=True)
    if browser:
        threading.Timer(0.5, webbrowser.open, (address,)).start()
    with suppress(KeyboardInterrupt):  # Ctrl-C is how it ends
        uvicorn.run(
            server,
            host=host,
            port=port,
            log_level="warning",
            ws_max_size=_LONGEST_MESSAGE,
            http=Patient,
            server_header=False,
        )


def _check_port(host: str, port: int) -> None:
    """Refuse an address that cannot be listened on."""
    try:
        with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_STREAM) as trial:
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            trial.bind((host, port))
    except (OSError, OverflowError) as error:
        raise InputError(
            f"cannot listen on {host}, port {port} ({getattr(error, 'strerror', None) or error}); try --port {port % 60000 + 1}"
        ) from None

"""The application: the page, the service, and the guard before them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fastapi import FastAPI, Request
from nicegui import ui
from starlette.formparsers import MultiPartParser
from starlette.types import ASGIApp

from quartering.conventions import InputError
from quartering.view.explorer.computing.computations import map_blocks, noting, scene, verdict
from quartering.view.explorer.computing.guard import LARGEST_BODY, LOOPBACK, Guard
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.page import Page
from quartering.view.explorer.service.api import serve_api
from quartering.view.explorer.service.problems import without_paths
from quartering.view.explorer.state import STARTING, State, read_link

_HERE = Path(__file__).parent
_DARK = {"dark": True, "light": False}
"""Themes a visitor's browser may remember; every other word follows the system."""
_ICON = (
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 32 32'><circle cx='16' cy='16' r='15' fill='#1f6fb2'/>"
    "<path d='M16 4l4 8v13l-4 3-4-3V12z' fill='#fff'/></svg>"
)


def explorer(
    registry: ShipRegistry, ship: str | None = None, host: str = LOOPBACK[0], names: Sequence[str] = ()
) -> ASGIApp:
    """The application, its kernels compiled or loaded before the first visitor comes.

    ship: key of the ship a page opens with
    host: listened on
    names: further names the server goes by
    """
    MultiPartParser.spool_max_size = LARGEST_BODY  # an upload stays in memory
    jobs = JobQueue()
    opening = STARTING if ship is None else State(ship=ship)
    of = scene(opening, registry.known(opening.ship))
    for work in (lambda: verdict(of), map_blocks(of)[0]):
        noting(work)()
    server = FastAPI(title="quartering", docs_url=None, redoc_url=None, openapi_url="/api/openapi.json")
    serve_api(server, registry, jobs)

    @ui.page("/", title="quartering explorer", favicon=_ICON)
    def index(request: Request) -> None:
        for sheet in ("base.css", "explorer.css", "compare.css", "visit.css"):
            ui.add_css(_HERE / sheet)
        ui.colors(primary="#1f6fb2")
        ui.add_body_html(f"<script>{(_HERE / 'page.js').read_text(encoding='utf-8')}</script>")
        state, problem = opening, ""
        try:
            if request.query_params:
                state, problem = read_link(request.query_params)
                problem = without_paths(problem)
                registry.check(state.ship)
        except InputError as error:
            state, problem = opening, without_paths(str(error))
        client = ui.context.client
        page = Page(client, registry, jobs, state, problem, _DARK.get(request.cookies.get("quartering-theme", "")))
        ui.on("quartering-back", lambda event: page.back(str(event.args)))
        client.on_delete(page.leave)

    ui.run_with(server, dark=None, show_welcome_message=False, reconnect_timeout=10.0, tailwind=False)
    return Guard(server, host, names)

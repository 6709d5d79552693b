"""The application: the page, the service, and the guard before them."""

from __future__ import annotations

import json
from pathlib import Path

from fastapi import FastAPI, HTTPException, Request
from nicegui import ui
from starlette.formparsers import MultiPartParser
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from quartering.conventions import InputError
from quartering.view.explorer.answers import map_blocks, noting, scene, verdict
from quartering.view.explorer.api import serve_api
from quartering.view.explorer.fleet import Fleet
from quartering.view.explorer.page import Page
from quartering.view.explorer.state import STARTING, State
from quartering.view.explorer.turns import Turns

LARGEST_BODY = 8_200_000
"""Largest request taken: an upload with what surrounds it [bytes]."""

_TOO_LARGE, _REASON = 413, f"the request is larger than {LARGEST_BODY / 1e6:.0f} MB; send a smaller file"
_HERE = Path(__file__).parent
_ICON = (
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 32 32'><circle cx='16' cy='16' r='15' fill='#1f6fb2'/>"
    "<path d='M16 4l4 8v13l-4 3-4-3V12z' fill='#fff'/></svg>"
)


def explorer(fleet: Fleet, ship: str | None = None) -> ASGIApp:
    """The application, its kernels compiled or loaded before the first visitor comes.

    Parameters
    ----------
    fleet : Fleet
    ship : str or None    what a page opens with
    """
    MultiPartParser.spool_max_size = LARGEST_BODY  # an upload stays in memory
    turns = Turns()
    opening = STARTING if ship is None else State(ship=ship)
    of = scene(opening, fleet.known(opening.ship))
    for work in (lambda: verdict(of), map_blocks(of)[0]):
        noting(work)()
    server = FastAPI(title="quartering", docs_url=None, redoc_url=None, openapi_url="/api/openapi.json")
    serve_api(server, fleet, turns)

    @ui.page("/", title="quartering explorer", favicon=_ICON)
    def index(request: Request) -> None:
        ui.add_css(_HERE / "explorer.css")
        ui.colors(primary="#2f86c9")
        state, problem = opening, ""
        try:
            if request.query_params:
                state = State.of_query(request.query_params)
                fleet.check(state.ship)
        except InputError as error:
            state, problem = opening, str(error)
        client = ui.context.client
        page = Page(client, fleet, turns, state, problem)
        client.on_delete(page.leave)

    ui.run_with(server, dark=None, show_welcome_message=False, reconnect_timeout=10.0)
    return Guard(server)


class Guard:
    """Refuses requests with a body that is too large, before anything reads it.

    Parameters
    ----------
    inside : ASGI application
    """

    def __init__(self, inside: ASGIApp) -> None:
        self._inside = inside

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, its body counted on the way."""
        if scope["type"] != "http":
            await self._inside(scope, receive, send)
            return
        said = dict(scope["headers"]).get(b"content-length", b"0")
        if not said.isdigit() or int(said) > LARGEST_BODY:
            await _too_large(send)
            return
        taken = 0

        async def counted() -> Message:
            nonlocal taken
            message = await receive()
            taken += len(message.get("body", b""))
            if taken > LARGEST_BODY:
                raise HTTPException(_TOO_LARGE, _REASON, {"connection": "close"})  # whoever reads the body answers so
            return message

        await self._inside(scope, counted, send)


async def _too_large(send: Send) -> None:
    headers = [(b"content-type", b"application/json"), (b"connection", b"close")]
    await send({"type": "http.response.start", "status": _TOO_LARGE, "headers": headers})
    await send({"type": "http.response.body", "body": json.dumps({"error": _REASON}).encode()})

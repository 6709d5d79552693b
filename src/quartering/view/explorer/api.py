"""The same answers as a service: /api/verdict and /api/polar, by GET with a query or by POST with JSON."""

from __future__ import annotations

import html
from collections.abc import Awaitable, Callable
from typing import Annotated, Any

import numpy as np
import xarray as xr
from fastapi import APIRouter, FastAPI, Query, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import HTMLResponse, JSONResponse

from quartering.conventions import InputError
from quartering.hull.refusals import allowed, own_words
from quartering.hull.told import condition, number, numbers
from quartering.loads.waves import Wave
from quartering.motion.status import Status
from quartering.stability.kind import Kind
from quartering.study.polar import polar
from quartering.view.commands.verdict import examine, facts, helps
from quartering.view.explorer.answers import joined, noting
from quartering.view.explorer.calls import PolarCall, VerdictCall
from quartering.view.explorer.fleet import Fleet
from quartering.view.explorer.turns import Turns
from quartering.view.terminal import plain

_AT_ONCE = 1024
_RESULTS = ("roll", "roll_peak", "sway", "yaw", "k2", "exponent", "encounter_frequency")
_UNPROCESSABLE, _BUSY, _CLIENT_LEFT = 422, 503, 499
_MOST_CALLS = 32


def serve_api(server: FastAPI, fleet: Fleet, turns: Turns) -> None:
    """Add the service to a server.

    Parameters
    ----------
    server : FastAPI
    fleet : Fleet      ships that can be asked for
    turns : Turns      all calls together are one client of it, so that they never crowd out the people on the pages
    """
    routes = APIRouter(prefix="/api", tags=["api"])
    under_way = [0]

    async def answered(work: Callable[[], Awaitable[JSONResponse]]) -> JSONResponse:
        if under_way[0] >= _MOST_CALLS:
            return _refused(f"{_MOST_CALLS} calls are waiting already; try again in a moment", _BUSY)
        under_way[0] += 1
        try:
            return await work()
        except InputError as error:
            return _refused(str(error))
        finally:
            under_way[0] -= 1

    async def verdict(call: VerdictCall) -> JSONResponse:
        async def work() -> JSONResponse:
            return _json(*await turns.take("api", noting(lambda: _verdict(call, fleet))))

        return await answered(work)

    async def polar_map(request: Request, call: PolarCall) -> JSONResponse:
        async def work() -> JSONResponse:
            blocks, notes = [], []
            for block in _blocks(call, fleet):
                if await request.is_disconnected():
                    return _refused("the caller has gone", _CLIENT_LEFT)
                part, said = await turns.take("api", noting(block))
                blocks.append(part)
                notes += said
            return _json(_map(joined(blocks)), list(dict.fromkeys(notes)))

        return await answered(work)

    @routes.get("/verdict", summary="Judge one condition")
    async def get_verdict(call: Annotated[VerdictCall, Query()]) -> JSONResponse:
        """What `quartering verdict --json` prints: motion, indices, multipliers, sentence, cures, sources."""
        return await verdict(call)

    @routes.post("/verdict", summary="Judge one condition")
    async def post_verdict(call: VerdictCall) -> JSONResponse:
        """What `quartering verdict --json` prints: motion, indices, multipliers, sentence, cures, sources."""
        return await verdict(call)

    @routes.get("/polar", summary="Map of roll and stability")
    async def get_polar(request: Request, call: Annotated[PolarCall, Query()]) -> JSONResponse:
        """Nested lists [speed][heading][wave length] with their units; null where there is no answer."""
        return await polar_map(request, call)

    @routes.post("/polar", summary="Map of roll and stability")
    async def post_polar(request: Request, call: PolarCall) -> JSONResponse:
        """Nested lists [speed][heading][wave length] with their units; null where there is no answer."""
        return await polar_map(request, call)

    @routes.get("/docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        return HTMLResponse(_page(server.openapi()))

    @server.exception_handler(RequestValidationError)
    async def invalid(_: Request, error: RequestValidationError) -> JSONResponse:
        return _refused("; ".join(_problem(one) for one in error.errors()[:5]))

    server.include_router(routes)


def _verdict(call: VerdictCall, fleet: Fleet) -> dict[str, Any]:
    one = call.loaded(fleet)
    wave = Wave(call.wave_length, call.wave_height, period=call.wave_period, ship=one)
    found = examine(one, wave, *condition(one, call.speed, call.heading), call.harmonics, call.form)
    return facts(found, helps(found))


def _blocks(call: PolarCall, fleet: Fleet) -> list[Any]:
    """The map as pieces of about a thousand conditions."""
    one = call.loaded(fleet)
    lengths = numbers(one, "wave_length", call.wave_length).tolist()
    steep = None if call.steepness is None else number(one, "steepness", call.steepness)
    waves = [Wave(n, call.wave_height if steep is None else steep * n, ship=one) for n in lengths]
    speed, heading = (numbers(one, name, getattr(call, name)).tolist() for name in ("speed", "heading"))
    rows = max(1, _AT_ONCE // (len(speed) * len(waves)))
    parts = [heading[i : i + rows] for i in range(0, len(heading), rows)]
    return [
        lambda part=part: polar(one, waves, speed, part, harmonics=call.harmonics, form=call.form) for part in parts
    ]


def _map(ds: xr.Dataset) -> dict[str, Any]:
    names = np.vectorize(lambda code, of: of(code).name.lower(), excluded={1}, otypes=[object])
    axes = ("speed", "heading", "wave_length", "wave_height")
    about = (
        "ship",
        "loading",
        "steady_motion",
        "diffraction",
        "natural_roll_frequency",
        "estimated_coefficients",
        "source",
    )
    return {
        **{name: ds.attrs[name] for name in about},
        "dims": ["speed", "heading", "wave_length"],
        **{name: ds[name].values for name in (*axes, *_RESULTS)},
        "verdict": names(ds["verdict"].values, Kind),
        "status": names(ds["status"].values, Status),
        "units": {name: ds[name].attrs["units"] for name in (*axes, *_RESULTS)},
    }


def _json(content: dict[str, Any], notes: list[str]) -> JSONResponse:
    return JSONResponse(plain({**content, "notes": notes}))


def _refused(reason: str, status: int = _UNPROCESSABLE) -> JSONResponse:
    return JSONResponse({"error": reason}, status_code=status)


def _problem(one: Any) -> str:
    where = ", ".join(str(part) for part in one["loc"] if part not in ("body", "query"))
    said = {"missing": "is missing", "extra_forbidden": "is unknown"}.get(one["type"])
    said = said or own_words(one) or f"allowed is {allowed(one)}"
    return f"{where}: {said}" if where else said


def _page(schema: dict[str, Any]) -> str:
    """The documentation of the service as one page that needs nothing from elsewhere."""
    rows = []
    for call, path in ((VerdictCall, "/api/verdict"), (PolarCall, "/api/polar")):
        said = schema["paths"][path]["post"]
        fields = "".join(
            f"<tr><td><code>{name}</code></td><td>{'yes' if field.is_required() else ''}</td>"
            f"<td>{html.escape(field.description or '')}</td></tr>"
            for name, field in call.model_fields.items()
        )
        rows.append(
            f"<h2>GET or POST {path}</h2><p>{html.escape(str(call.__doc__))} {html.escape(said['description'])}</p>"
            f"<table><tr><th>field</th><th>needed</th><th></th></tr>{fields}</table>"
        )
    example = (
        "curl 'http://127.0.0.1:8080/api/verdict?ship=series60-cb60&speed=7.5&heading=30&wave_length=150&wave_height=4'"
    )
    style = (
        "body{font:16px/1.5 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color-scheme:light dark}"
        "td,th{text-align:left;padding:.2em 1em .2em 0;vertical-align:top}pre{overflow:auto}"
    )
    return (
        f"<!doctype html><html lang=en><meta charset=utf-8><title>quartering: service</title><style>{style}</style>"
        f"<h1>quartering as a service</h1><pre>{html.escape(example)}</pre>"
        "<p>Refusals have status 422 and say why in <code>error</code>. The machine-readable description is"
        f" <a href=openapi.json>openapi.json</a>.</p>{''.join(rows)}</html>"
    )

"""The same answers as a service: one condition by GET, and by POST with JSON what takes longer: cures, maps, the criteria."""

from __future__ import annotations

import html
from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
import xarray as xr
from fastapi import APIRouter, FastAPI, HTTPException, Query, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import HTMLResponse, JSONResponse
from starlette.exceptions import HTTPException as StarletteError

from quartering.hull.file.refusals import allowed, user_words
from quartering.hull.told import condition, number, numbers
from quartering.loads.waves import STEEPEST, Wave
from quartering.motion.status import OnTheWay, Status
from quartering.options import unknown
from quartering.stability.kind import Kind
from quartering.study.condition.examine import Examined, examine, facts
from quartering.study.effects.cure import Cure
from quartering.study.maps.extension import carried_on, edges_of_largest
from quartering.study.maps.polar import polar
from quartering.units import wave_length_of
from quartering.view.explorer.computing.computations import joined, sought
from quartering.view.explorer.computing.guard import METHODS
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.calls import MOST_CELLS, PolarCall, ShipCall, VerdictCall
from quartering.view.explorer.service.criteria_api import CriteriaCall, serve_criteria
from quartering.view.explorer.service.desk import OF_GET, OF_POST, ONCE, Desk, answer_json, busy
from quartering.view.explorer.service.problems import STATUSES, refused, responses, without_paths
from quartering.view.explorer.service.sea_api import GuidanceCall, SeaCall, serve_sea

_AT_ONCE = 1024
_RESULTS = ("roll", "roll_peak", "other_roll_peak", "sway", "yaw", "k2", "exponent", "encounter_frequency")
_MOST_SEARCHES = 4
_CALLS: dict[str, tuple[type[ShipCall], str]] = {
    "verdict": (VerdictCall, "GET, POST"), "polar": (PolarCall, "POST"), "sea": (SeaCall, "GET, POST"),
    "guidance": (GuidanceCall, "POST"), "criteria": (CriteriaCall, "POST"),
}  # fmt: skip
_TAKEN = {name: methods for name, (_, methods) in _CALLS.items()} | {"docs": "GET", "openapi.json": "GET"}


def serve_api(server: FastAPI, registry: ShipRegistry, jobs: JobQueue) -> None:
    """Add the service to a server.

    registry: ships that can be asked for
    jobs: all calls together are one client of it, so that they never crowd out the people on the pages
    """
    routes, desk, once = APIRouter(prefix="/api", tags=["api"]), Desk(jobs), ONCE
    judge = _Judge(registry, desk)

    @routes.get("/verdict", dependencies=once, summary="Judge one condition", responses=responses(*OF_GET))
    async def get_verdict(request: Request, call: Annotated[VerdictCall, Query()]) -> JSONResponse:
        """What `quartering verdict --json` prints, but no cures are sought: `cures` is null for an unstable motion."""
        return await desk.answered(request, lambda: judge.judged(call, with_cures=False))

    @routes.post(
        "/verdict",
        dependencies=once,
        summary="Judge one condition, and seek what cures it",
        responses=responses(*OF_POST),
    )
    async def post_verdict(request: Request, call: VerdictCall) -> JSONResponse:
        """What `quartering verdict --json` prints: motion, indices, multipliers, sentence, cures, sources."""
        return await desk.answered(request, lambda: judge.judged(call, with_cures=True))

    @routes.post("/polar", dependencies=once, summary="Map of roll and stability", responses=responses(*OF_POST))
    async def post_polar(request: Request, call: PolarCall) -> JSONResponse:
        """Nested lists [speed][heading][wave length] with their units; null where there is no answer."""
        return await desk.answered(request, lambda: _mapped(call, registry, desk))

    serve_sea(routes, registry, desk)
    serve_criteria(routes, registry, desk)

    @routes.get("/docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        return HTMLResponse(_page(server.openapi()))

    _refuse_the_rest(server, routes)
    server.include_router(routes)


def _refuse_the_rest(server: FastAPI, routes: APIRouter) -> None:
    """Give every other refusal of the service the shape of its own."""

    @routes.api_route("/{rest:path}", methods=METHODS, include_in_schema=False)
    async def nothing(request: Request, rest: str) -> JSONResponse:
        taken = _TAKEN.get(rest)
        if taken is None:
            return refused(
                f'there is no "/api/{rest[:80]}"; there are {", ".join(f"/api/{name}" for name in _TAKEN)}', 404
            )
        return refused(f"/api/{rest} takes {taken}, not {request.method}", 405, allow=taken)

    @server.exception_handler(RequestValidationError)
    async def invalid(request: Request, error: RequestValidationError) -> JSONResponse:
        fields = _CALLS[request.url.path.rsplit("/", 1)[-1]][0].model_fields
        return refused(without_paths("; ".join(_problem(one, tuple(fields)) for one in error.errors()[:5])))

    @server.exception_handler(StarletteError)
    @server.exception_handler(HTTPException)
    async def wrong(_: Request, error: StarletteError) -> JSONResponse:
        return refused(str(error.detail), error.status_code, **(error.headers or {}))

    @server.exception_handler(Exception)
    async def failed(_: Request, __: Exception) -> JSONResponse:
        return refused("the server failed at this call, a fault of its own; whoever runs it finds it in the log", 500)


class _Judge:
    """Verdicts, and the few searches for cures that are made at a time."""

    def __init__(self, registry: ShipRegistry, desk: Desk) -> None:
        self._registry, self._desk, self._searches = registry, desk, 0

    async def judged(self, call: VerdictCall, *, with_cures: bool) -> JSONResponse:
        found, notes = await self._desk.take(lambda: _examined(call, self._registry))
        if not _ailing(found):
            healing: list[Cure] | None = []
        elif with_cures and self._searches >= _MOST_SEARCHES:
            return busy(f"{_MOST_SEARCHES} searches for cures are under way; try again, or ask by GET")
        else:
            healing = await self._cured(found) if with_cures else None
        told, _ = await self._desk.take(lambda: facts(found, healing))
        return answer_json(told, notes)

    async def _cured(self, found: Examined) -> list[Cure]:
        self._searches += 1
        try:
            return await sought(found, self._desk.take_long, lambda: True)
        finally:
            self._searches -= 1


async def _mapped(call: PolarCall, registry: ShipRegistry, desk: Desk) -> JSONResponse:
    """The map of a call, block by block, and carried on past its edges if wanted."""
    blocks, notes = [], []
    for block in (await desk.take(lambda: _blocks(call, registry)))[0]:
        part, said = await desk.take_long(block)
        blocks.append(part)
        notes += said
    whole = joined(blocks)
    if call.extend:
        whole, said = await desk.take_long(
            lambda: carried_on(whole, lambda axes: _further(call, registry, axes), MOST_CELLS)
        )
        notes += said
    return answer_json(_map(whole), list(dict.fromkeys(notes)))


def _examined(call: VerdictCall, registry: ShipRegistry) -> Examined:
    one = call.loaded(registry)
    wave = Wave(call.wave_length, call.wave_height, period=call.wave_period, ship=one)
    return examine(one, wave, *condition(one, call.speed, call.heading), call.harmonics, call.form)


def _ailing(found: Examined) -> bool:
    return not found.verdict.stable and found.motion.status.ok


def _blocks(call: PolarCall, registry: ShipRegistry) -> list[Any]:
    """The map as pieces of about a thousand conditions."""
    one = call.loaded(registry)
    if call.wave_period is None:
        lengths = numbers(one, "wave_length", call.wave_length or []).tolist()
    else:
        lengths = [wave_length_of(period) for period in numbers(one, "wave_period", call.wave_period).tolist()]
    steep = None if call.steepness is None else number(one, "steepness", call.steepness)
    waves = [Wave(n, call.wave_height if steep is None else steep * n, ship=one) for n in lengths]
    speed, heading = (numbers(one, name, getattr(call, name)).tolist() for name in ("speed", "heading"))
    rows = max(1, _AT_ONCE // (len(speed) * len(waves)))
    parts = [heading[i : i + rows] for i in range(0, len(heading), rows)]
    return [
        lambda part=part: polar(one, waves, speed, part, harmonics=call.harmonics, form=call.form) for part in parts
    ]


def _further(call: PolarCall, registry: ShipRegistry, axes: Mapping[str, Any]) -> xr.Dataset:
    """The map of a call at other axes."""
    one, lengths = call.loaded(registry), axes["wave_length"]
    if call.wave_height is not None:
        height = np.minimum(number(one, "wave_height", call.wave_height), STEEPEST * lengths)
    else:  # one of the two is given: the call was refused otherwise
        height = number(one, "steepness", call.steepness or 0.0) * lengths
    waves = [Wave(float(n), float(h)) for n, h in zip(lengths, height, strict=True)]
    return polar(one, waves, axes["speed"], axes["heading"], harmonics=call.harmonics, form=call.form)


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
        "capsizes_on_the_way": names(ds["capsizes_on_the_way"].values, OnTheWay),
        "largest_on_edge": [edge._asdict() for edge in edges_of_largest(ds)],
        "units": {name: ds[name].attrs["units"] for name in (*axes, *_RESULTS)},
    }


def _problem(one: Any, fields: tuple[str, ...]) -> str:
    if one["type"] == "extra_forbidden":
        return unknown(str(one["loc"][-1]), fields).words
    where = ", ".join(str(part) for part in one["loc"] if part not in ("body", "query"))
    said = "is missing" if one["type"] == "missing" else None
    said = said or user_words(one) or f"allowed is {allowed(one)}"
    return f"{where}: {said}" if where else said


def _page(schema: dict[str, Any]) -> str:
    """The documentation of the service as one page that needs nothing from elsewhere."""
    rows = []
    for name, (call, methods) in _CALLS.items():
        path, how = f"/api/{name}", methods.replace(", ", " or ")
        said = schema["paths"][path]["post"]
        fields = "".join(
            f"<tr><td><code>{key}</code></td><td>{'yes' if field.is_required() else ''}</td>"
            f"<td>{html.escape(field.description or '')}</td></tr>"
            for key, field in call.model_fields.items()
        )
        rows.append(
            f"<h2>{how} {path}</h2><p>{html.escape(str(call.__doc__))} {html.escape(said['description'])}</p>"
            f"<table><tr><th>field</th><th>needed</th><th></th></tr>{fields}</table>"
        )
    refusals = "".join(f"<tr><td>{status}</td><td>{when}</td></tr>" for status, when in STATUSES.items())
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
        "<p>GET answers one condition; POST takes JSON, and of a verdict seeks cures too. The machine-readable description is"
        f" <a href=openapi.json>openapi.json</a>.</p>{''.join(rows)}<h2>Refusals</h2><p>Every refusal is"
        f" <code>{{&quot;error&quot;: &quot;why&quot;}}</code>, with the status</p><table>{refusals}</table></html>"
    )

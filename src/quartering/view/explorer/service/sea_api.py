"""Calls of the service about irregular seas: one sea, by GET or POST, and maps over seas by POST."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Final

import xarray as xr
from fastapi import APIRouter, Query, Request
from fastapi.responses import JSONResponse
from pydantic import Field, model_validator

from quartering.arguments import ARGUMENTS
from quartering.hull.told import condition, number, numbers
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea, Spectrum
from quartering.options import OPTIONS, line_of
from quartering.study.maps.sweep import in_pieces
from quartering.study.seas.over_seas.advice import Advice
from quartering.study.seas.over_seas.grid import sea_grid
from quartering.study.seas.over_seas.settings import Judge, SeaSettings
from quartering.study.seas.response import SeaStatus, sea_response
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.sea.sea_state import SPREADING_WORDS, told_spreading
from quartering.view.explorer.service.calls import ShipCall
from quartering.view.explorer.service.desk import OF_GET, OF_POST, ONCE, Desk, answer_json
from quartering.view.explorer.service.problems import responses
from quartering.view.explorer.state import Value
from quartering.view.sea_words import METHODS, guidance_facts, sea_facts, sea_sentence

MOST_CONDITIONS: Final = 2_000
"""Largest map over seas of one call: some twenty seconds."""
_AT_ONCE: Final = 32


class _SeaCall(ShipCall):
    """What all calls about seas have."""

    spectrum: Spectrum = Field(default="jonswap", description="of the sea")
    gamma: Value = Field(default=3.3, description=line_of(ARGUMENTS["gamma"]))
    spreading: Value = Field(default="none", description=SPREADING_WORDS)
    form: Form = Field(default="stf", description="of the diffraction force")


class SeaCall(_SeaCall):
    """One ship in one irregular sea."""

    hs: Value = Field(description=line_of(ARGUMENTS["hs"]))
    tp: Value | None = Field(default=None, description=f"{line_of(ARGUMENTS['tp'])}; or give tz")
    tz: Value | None = Field(default=None, description=f"{line_of(ARGUMENTS['tz'])}; or give tp")
    speed: Value = Field(description=line_of(OPTIONS["speed"]))
    heading: Value = Field(description=f"{line_of(OPTIONS['heading'])}, of the sea")


class GuidanceCall(_SeaCall):
    """Every combination of seas, speeds and headings."""

    hs: list[Value] = Field(min_length=1, max_length=MOST_CONDITIONS, description=line_of(ARGUMENTS["hs"]))
    tp: list[Value] | None = Field(
        default=None, min_length=1, max_length=MOST_CONDITIONS, description=f"{line_of(ARGUMENTS['tp'])}; or give tz"
    )
    tz: list[Value] | None = Field(
        default=None, min_length=1, max_length=MOST_CONDITIONS, description=f"{line_of(ARGUMENTS['tz'])}; or give tp"
    )
    speed: list[Value] = Field(min_length=1, max_length=MOST_CONDITIONS, description=line_of(OPTIONS["speed"]))
    heading: list[Value] = Field(
        default=[5.0 * i for i in range(37)],
        min_length=1,
        max_length=MOST_CONDITIONS,
        description="[deg]; by default 0, 5, .. 180",
    )
    judge: Judge = Field(default="largest", description="guidance by the largest motion of three hours, or by failures")
    threshold: Value | None = Field(
        default=None, description="factor on that motion, by default 2, or rate of failures, 1e-6 [1/s]"
    )

    @model_validator(mode="after")
    def _possible(self) -> GuidanceCall:
        if (self.tp is None) == (self.tz is None):
            raise ValueError("give tp or tz, one of the two")
        count = len(self.hs) * len(self.tp or self.tz or ()) * len(self.speed) * len(self.heading)
        if count > MOST_CONDITIONS:
            raise ValueError(
                f"{count:,} conditions; a call takes up to {MOST_CONDITIONS:,}: make several calls, or use `quartering polar`"
                " with --hs"
            )
        return self


def sea_answer(call: SeaCall, registry: ShipRegistry) -> dict[str, Any]:
    """What `quartering sea --json` prints of its two methods without a simulation, and its sentence."""
    one = call.loaded(registry)
    speed, heading = condition(one, call.speed, call.heading)
    sea = Sea(
        hs=call.hs, tp=call.tp, tz=call.tz, spectrum=call.spectrum, gamma=call.gamma, heading=heading,
        spreading=told_spreading(call.spreading),
    )  # fmt: skip
    found = {
        method: sea_response(one, sea, speed, method=method, form=call.form)  # type: ignore[arg-type]  # both are
        for method in METHODS
    }
    told = {"sentence": sea_sentence(one, sea, speed, found["closure"])} | sea_facts(one, sea, speed, found)
    return told | {"stable": int(found["closure"]["status"]) == SeaStatus.ANSWERED}


def guidance_pieces(call: GuidanceCall, registry: ShipRegistry) -> Iterator[tuple[int, xr.Dataset]]:
    """The map of a call, a piece of work at a time."""
    one = call.loaded(registry)
    given: dict[str, Any] = {
        name: numbers(one, name, value)
        for name in ("speed", "heading", "hs", "tp", "tz")
        if (value := getattr(call, name)) is not None
    }
    limit = None
    if call.threshold is not None:
        limit = number(None, "rate_limit" if call.judge == "rate" else "safety_factor", call.threshold)
    told = SeaSettings(
        spectrum=call.spectrum, gamma=number(None, "gamma", call.gamma), spreading=told_spreading(call.spreading),
        judge=call.judge, threshold=limit, form=call.form,
    )  # fmt: skip
    grid = sea_grid(one, **given, settings=told)
    return in_pieces(grid.in_blocks_of(_AT_ONCE))


def guidance_answer(ds: xr.Dataset) -> dict[str, Any]:
    """A map over seas for programs; what guidance says of each condition in words."""
    told = guidance_facts(ds)
    words = [kind.name.lower() for kind in Advice]
    return told | {
        "dims": list(ds["recommended"].dims),
        "recommended": _named(told["recommended"].tolist(), words),
        "units": {name: ds[name].attrs["units"] for name in ("speed", "heading", "hs", "tp", "tz", "roll_mean_3h_max")},
    }


def _named(codes: Any, words: list[str]) -> Any:
    """Codes in nested lists as words."""
    return [_named(one, words) for one in codes] if isinstance(codes, list) else words[codes]


def serve_sea(routes: APIRouter, registry: ShipRegistry, desk: Desk) -> None:
    """Add the calls about seas to a service."""

    async def at_sea(call: SeaCall) -> JSONResponse:
        return answer_json(*await desk.take(lambda: sea_answer(call, registry)))

    async def guided(call: GuidanceCall) -> JSONResponse:
        whole, notes = await desk.stepped(lambda: guidance_pieces(call, registry))
        return answer_json(guidance_answer(whole), notes)

    @routes.get("/sea", dependencies=ONCE, summary="One ship in one irregular sea", responses=responses(*OF_GET))
    async def get_sea(request: Request, call: Annotated[SeaCall, Query()]) -> JSONResponse:
        """What `quartering sea --json` prints without its simulation: linear response and statistical linearisation."""
        return await desk.answered(request, lambda: at_sea(call))

    @routes.post("/sea", dependencies=ONCE, summary="One ship in one irregular sea", responses=responses(*OF_POST))
    async def post_sea(request: Request, call: SeaCall) -> JSONResponse:
        """What `quartering sea --json` prints without its simulation: linear response and statistical linearisation."""
        return await desk.answered(request, lambda: at_sea(call))

    @routes.post("/guidance", dependencies=ONCE, summary="Map over seas", responses=responses(*OF_POST))
    async def post_guidance(request: Request, call: GuidanceCall) -> JSONResponse:
        """What `quartering polar --hs --json` prints: nested lists [loading][hs][tz][speed][heading], recommended in words."""
        return await desk.answered(request, lambda: guided(call))

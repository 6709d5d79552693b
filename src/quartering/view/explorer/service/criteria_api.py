"""A call of the service about the five failure modes, by POST."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse
from pydantic import Field

from quartering.hull.told import number
from quartering.options import OPTIONS, line_of
from quartering.study.criteria.judged import judging
from quartering.study.criteria.record import Criteria
from quartering.view.criteria_words import criteria_facts, recalled_words
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.calls import ShipCall
from quartering.view.explorer.service.desk import OF_POST, ONCE, Desk, answer_json
from quartering.view.explorer.service.problems import responses
from quartering.view.explorer.state import Value


class CriteriaCall(ShipCall):
    """Five failure modes of one ship and loading."""

    speed: Value | None = Field(
        default=None, description=f"service speed, {line_of(OPTIONS['speed'])}; what needs it is not judged without"
    )
    levels: Literal[1, 2] = Field(default=2, description="1: level 1 alone, which takes a second at most; 2: both")


def criteria_steps(call: CriteriaCall, registry: ShipRegistry) -> Iterator[tuple[float, Criteria]]:
    """The judgements of a call, a piece of work at a time."""
    one = call.loaded(registry)
    speed = None if call.speed is None else number(one, "speed", call.speed)
    return judging(one, speed, levels=(1, 2) if call.levels == 2 else (1,))


def criteria_answer(found: Criteria) -> dict[str, Any]:
    """What `quartering criteria --json` prints, with the form it is prepared in; without a sentence for level 1 alone."""
    return criteria_facts(found) | {"form": f"{recalled_words(found)}. It shows no compliance."}


def serve_criteria(routes: APIRouter, registry: ShipRegistry, desk: Desk) -> None:
    """Add the call about the failure modes to a service."""

    async def judged(call: CriteriaCall) -> JSONResponse:
        found, notes = await desk.stepped(lambda: criteria_steps(call, registry))
        return answer_json(criteria_answer(found), notes)

    @routes.post("/criteria", dependencies=ONCE, summary="Five failure modes", responses=responses(*OF_POST))
    async def post_criteria(request: Request, call: CriteriaCall) -> JSONResponse:
        """What `quartering criteria --json` prints, prepared in the form of MSC.1/Circ.1627; it shows no compliance."""
        return await desk.answered(request, lambda: judged(call))

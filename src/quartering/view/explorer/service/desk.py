"""What every call of the service goes through: its body looked at once, its turn in the queue, its answer as JSON."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Iterator
from typing import Any, Final, NamedTuple

from fastapi import Depends, HTTPException, Request
from fastapi.responses import JSONResponse

from quartering.view.console.printed import plain
from quartering.view.explorer.service.problems import plain_names

OF_GET: Final = (400, 403, 422, 500, 503)
OF_POST: Final = (400, 403, 408, 413, 415, 422, 500, 503)
"""Refusals of a route."""
Take = Callable[[Callable[[], Any]], Awaitable[tuple[Any, list[str]]]]
"""Waits for the turn of a piece of work: its result, and its warnings."""


class Desk(NamedTuple):
    """How calls are served.

    Parameters
    ----------
    answered : function    of a request and what makes its answer; refuses it where too many wait
    take : Take            for what is short
    take_long : Take       for what comes in many pieces
    """

    answered: Callable[[Request, Callable[[], Awaitable[JSONResponse]]], Awaitable[JSONResponse]]
    take: Take
    take_long: Take

    async def stepped(self, begin: Callable[[], Iterator[tuple[Any, Any]]]) -> tuple[Any, list[str]]:
        """What the last of some steps yields beside how far it is, others being served between; and all warnings."""
        steps, notes = await self.take(begin)
        last = None
        while True:
            step, said = await self.take_long(lambda: next(steps, None))
            notes += said
            if step is None:
                return last, list(dict.fromkeys(notes))
            last = step[1]


def answer_json(content: dict[str, Any], notes: list[str]) -> JSONResponse:
    """An answer and its warnings, without a path of this machine."""
    return JSONResponse(plain_names(plain({**content, "notes": notes})))


async def _once(request: Request) -> None:
    """Refuse a field that is given twice, of which all but the last would be lost."""

    def pairs(given: list[tuple[str, Any]]) -> dict[str, Any]:
        names = [name for name, _ in given]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise HTTPException(422, f"{twice} is given twice; leave one out")
        return dict(given)

    pairs(request.query_params.multi_items())
    try:
        json.loads(await request.body() or b"{}", object_pairs_hook=pairs)
    except ValueError:  # what is no JSON is refused as the body is read
        return


ONCE: Final = [Depends(_once)]
"""What each route of the service begins with."""

"""What every call of the service goes through: its body looked at once, its turn in the queue, its answer as JSON."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable, Iterator
from typing import Any, Final

from fastapi import Depends, HTTPException, Request
from fastapi.responses import JSONResponse

from quartering.conventions import InputError
from quartering.view.console.printed import plain
from quartering.view.explorer.computing.computations import noting
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.service.problems import plain_names, refused, without_paths

OF_GET: Final = (400, 403, 422, 500, 503)
OF_POST: Final = (400, 403, 408, 413, 415, 422, 500, 503)
"""Refusals of a route."""
_BUSY, _CLIENT_LEFT, _MOST_CALLS = 503, 499, 32


class Desk:
    """How calls are served: all of them together are one client of the queue, and never crowd out the people on the pages."""

    def __init__(self, jobs: JobQueue) -> None:
        self._jobs, self._under_way = jobs, 0

    async def answered(self, request: Request, work: Callable[[], Awaitable[JSONResponse]]) -> JSONResponse:
        """The answer of some work, unless too many wait already; a caller who leaves gives its place to the next at once."""
        if self._under_way >= _MOST_CALLS:
            return busy(f"{_MOST_CALLS} calls are waiting already; try again in a moment")
        self._under_way += 1
        working, leaving = asyncio.ensure_future(work()), asyncio.ensure_future(_left(request))
        try:
            await asyncio.wait({working, leaving}, return_when=asyncio.FIRST_COMPLETED)
            return working.result() if working.done() else refused("the caller has gone", _CLIENT_LEFT)
        except InputError as error:
            return refused(without_paths(str(error)))
        finally:
            self._under_way -= 1
            working.cancel()
            leaving.cancel()

    async def take(self, work: Callable[[], Any]) -> tuple[Any, list[str]]:
        """Wait for the turn of what is short: its result, and its warnings."""
        return await self._jobs.take("api", noting(work))

    async def take_long(self, work: Callable[[], Any]) -> tuple[Any, list[str]]:
        """As `take`, of what comes in many pieces."""
        return await self._jobs.take("api, long work", noting(work))

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


def busy(words: str) -> JSONResponse:
    """The refusal of a call while too many others are served."""
    return refused(words, _BUSY)


async def _left(request: Request) -> None:
    """Wait until the caller leaves."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


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

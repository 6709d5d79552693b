"""Job queue: one computation at a time on all cores, clients in turn."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

Answer = TypeVar("Answer")
Take = Callable[[Callable[[], Any]], Awaitable[tuple[Any, list[str]]]]
"""Waits for the turn of a piece of work: its result, and its warnings."""


class JobQueue:
    """A line for each client; their heads are served round and round, in a thread, so that the server never waits.

    Work handed in is short (a verdict, a block of a map): who wants much hands it in piece by piece, and the others come
    between. A piece given up before its turn (its waiter was cancelled) is skipped.

    Examples
    --------
    >>> async def two():
    ...     jobs = JobQueue()
    ...     return await asyncio.gather(jobs.take("a", lambda: 1), jobs.take("b", lambda: 2))
    >>> asyncio.run(two())
    [1, 2]
    """

    def __init__(self) -> None:
        self._lines: dict[str, deque[tuple[asyncio.Future[Any], Callable[[], Any]]]] = {}
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="jobs")
        self._busy = False

    async def take(self, client: str, work: Callable[[], Answer]) -> Answer:
        """Wait for the client's turn, do the work in the thread, and return its result or raise its error."""
        answer: asyncio.Future[Answer] = asyncio.get_running_loop().create_future()
        self._lines.setdefault(client, deque()).append((answer, work))
        self._next()
        try:
            return await answer
        except asyncio.CancelledError:
            self._forget(client, answer)
            raise

    def _forget(self, client: str, answer: asyncio.Future[Any]) -> None:
        """Take a piece that nobody waits for out of its line."""
        line = self._lines.get(client, deque())
        for piece in [piece for piece in line if piece[0] is answer]:
            line.remove(piece)
        if client in self._lines and not line:
            del self._lines[client]

    def _next(self) -> None:
        """Begin the next piece of work when the thread is free."""
        while self._lines and not self._busy:
            client = next(iter(self._lines))
            line = self._lines.pop(client)
            answer, work = line.popleft()
            if line:
                self._lines[client] = line  # behind the others
            if not answer.cancelled():
                self._busy = True
                loop = answer.get_loop()
                done = self._thread.submit(work)
                done.add_done_callback(lambda d, a=answer, at=loop: at.call_soon_threadsafe(self._finish, a, d))  # type: ignore[misc]

    def _finish(self, answer: asyncio.Future[Any], done: Any) -> None:
        self._busy = False
        error = done.exception()
        if not answer.cancelled():
            if error is None:
                answer.set_result(done.result())
            else:
                answer.set_exception(error)
        self._next()

    def close(self) -> None:
        """Release the worker thread; pending jobs are cancelled."""
        self._thread.shutdown(wait=False, cancel_futures=True)

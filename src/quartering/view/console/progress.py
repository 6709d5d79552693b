"""How far a long computation has come."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from quartering.view.console.interrupts import stop_if_asked


@contextmanager
def bar(words: str, total: int) -> Iterator[Callable[[int, int], None]]:
    """Progress bar on stderr while the body runs; nothing when stderr is not a terminal.

    words: what is being computed
    total: number of conditions
    """
    if not sys.stderr.isatty():
        yield lambda _done, _total: stop_if_asked()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(words, total=total)

        def told(done: int, of: int) -> None:
            stop_if_asked()
            progress.update(task, completed=done, total=of)

        yield told


@contextmanager
def working(words: str) -> Iterator[None]:
    """Turning sign on stderr while the body runs, for work whose length is not known; nothing without a terminal.

    words: what is being done
    """
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console

    with Console(stderr=True).status(words):
        yield

"""How far a long computation has come, and a line when kernels must be compiled first."""

from __future__ import annotations

import atexit
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

import typer

from quartering.threads import workers

NOTICE = "compiling numerical kernels, once (15 to 30 s)"


def announce_compilation() -> None:
    """Say on stderr that kernels will be compiled, when they are not in the cache, and have a second process compile some."""
    if compiled():
        return
    typer.echo(NOTICE, err=True)
    if workers() > 1:
        beside = subprocess.Popen(
            [sys.executable, "-m", "quartering.stability.ahead"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        atexit.register(beside.terminate)


def compiled() -> bool:
    """Are kernels of every module a map compiles in the cache, and newer than their source?"""
    from quartering.loads import diffraction
    from quartering.motion import harmonic
    from quartering.stability import variation

    return all(_cached(module) for module in (diffraction, harmonic, variation))


def _cached(module: ModuleType) -> bool:
    source = Path(str(module.__file__))
    folders = {kernel.stats.cache_path for kernel in vars(module).values() if hasattr(kernel, "stats")}
    pattern = f"{source.stem}.*.py{sys.version_info.major}{sys.version_info.minor}*.nbi"
    entries = [entry for folder in folders for entry in Path(folder).glob(pattern)]
    return any(entry.stat().st_mtime >= source.stat().st_mtime for entry in entries)


@contextmanager
def bar(words: str, total: int) -> Iterator[Callable[[int, int], None]]:
    """Progress bar on stderr while the body runs; nothing when stderr is not a terminal.

    Parameters
    ----------
    words : str    what is being computed
    total : int    number of conditions

    Yields
    ------
    function(done, total)
    """
    if not sys.stderr.isatty():
        yield lambda _done, _total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(words, total=total)
        yield lambda done, of: progress.update(task, completed=done, total=of)


@contextmanager
def working(words: str) -> Iterator[None]:
    """Turning sign on stderr while the body runs, for work whose length is not known; nothing without a terminal.

    Parameters
    ----------
    words : str    what is being done
    """
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console

    with Console(stderr=True).status(words):
        yield

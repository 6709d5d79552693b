"""Where the blocks of a grid are computed: threads of this process, worker processes of this machine, a cluster."""

from __future__ import annotations

import copyreg
import pickle
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import contextmanager
from functools import lru_cache
from importlib import import_module
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering._machine.threads import alone, spread
from quartering.conventions import InputError
from quartering.stability.precompile import announce_compilation
from quartering.study.grid import Grid
from quartering.study.maps.kinds import kind_of

Found = dict[str, NDArray[np.generic]]
Counts = dict[str, int]
_AHEAD = 3
"""Blocks given to each worker of a cluster at a time: enough to keep it busy, few enough to hold in memory."""
_TRIES = 3
LONGEST_WAIT = 10.0
"""For a scheduler to answer [s]."""


def computed(
    grid: Grid, indices: Sequence[int], keep: Callable[[int, Found], Counts], client: Any = None
) -> Iterator[tuple[int, Counts]]:
    """Compute some blocks of a grid and hand each to `keep`.

    indices: of the blocks
    keep: of index and results: stores them, and returns what they count; called by several threads
    client: connection of `reached`; None: this process's threads
    Yields (index, counts): as blocks are kept, in any order

    A block is a function of the grid and its index alone, so it gives the same numbers wherever it is computed; one that is
    lost with its worker is computed by another.
    """
    if client is None:
        yield from _in_threads(grid, indices, keep)
    else:
        yield from _on_cluster(grid, indices, keep, client)


def _in_threads(
    grid: Grid, indices: Sequence[int], keep: Callable[[int, Found], Counts]
) -> Iterator[tuple[int, Counts]]:
    announce_compilation()
    for i, counts in spread(lambda index: keep(index, kind_of(grid).evaluate(grid, index)), indices):
        yield indices[i], counts


def _on_cluster(
    grid: Grid, indices: Sequence[int], keep: Callable[[int, Found], Counts], client: Any
) -> Iterator[tuple[int, Counts]]:
    """Blocks by the workers of a dask cluster, a few ahead of what has been kept."""
    prepare_pickling()
    payload = pickle.dumps(grid)
    executor = client.get_executor(retries=_TRIES, pure=False)
    waiting = list(reversed(indices))
    pending: dict[Future[Any], int] = {}
    ahead = _AHEAD * max(1, len(client.scheduler_info()["workers"]))
    try:
        while waiting or pending:
            while waiting and len(pending) < ahead:
                index = waiting.pop()
                with _reaching(client):
                    pending[executor.submit(_one_block, payload, index)] = index
            for done in wait(pending, return_when=FIRST_COMPLETED).done:
                index = pending.pop(done)
                with _reaching(client):
                    found = done.result()
                yield index, keep(index, found)
    finally:
        for future in pending:
            future.cancel()
        executor.shutdown(wait=False)


@contextmanager
def _reaching(client: Any) -> Iterator[None]:
    """Say in one message that a cluster was lost, whatever it says of it itself."""
    try:
        yield
    except Exception as error:
        own = type(error).__module__.partition(".")[0] in ("distributed", "concurrent", "asyncio")
        if not own and client.status == "running":
            raise  # the block's own error
        raise InputError(
            f"the cluster was lost ({type(error).__name__}); the finished blocks are kept: start it again and run the same"
            " command, only what is missing is computed"
        ) from None


def prepare_pickling() -> None:
    """Let the mappings that nobody can change, which a ship holds, travel to other processes."""
    copyreg.pickle(MappingProxyType, _as_plain)


def _as_plain(mapping: MappingProxyType[Any, Any]) -> tuple[Any, tuple[dict[Any, Any]]]:
    return _frozen, (dict(mapping),)


def _frozen(mapping: dict[Any, Any]) -> MappingProxyType[Any, Any]:
    return MappingProxyType(mapping)


@lru_cache(maxsize=4)
def _unpacked(payload: bytes) -> Grid:
    """The grid as a worker keeps it from block to block, with what it has found out about its ship."""
    grid: Grid = pickle.loads(payload)
    return grid


def _one_block(payload: bytes, index: int) -> Found:
    """One block on a worker, which uses one core."""
    grid = _unpacked(payload)
    return alone(lambda i: kind_of(grid).evaluate(grid, i), index)


def check_cluster(cluster: str | None) -> None:
    """Refuse a cluster whose name cannot be read, or whose extra is not installed.

    cluster: "local:4" for four worker processes on this machine, "tcp://host:8786" for a dask scheduler; None for this
        process's threads

    >>> check_cluster(None)
    """
    if cluster is None:
        return
    _distributed(cluster)
    kind, _, rest = cluster.partition(":")
    local = kind == "local" and rest.isdecimal() and int(rest) > 0
    if not local and not (kind in ("tcp", "tls", "ws", "wss") and rest.startswith("//")):
        raise InputError(
            f'cluster "{cluster}" is not known; give "local:4" or the address of a scheduler, "tcp://host:8786"'
        )


@contextmanager
def reached(cluster: str | None) -> Iterator[Any]:
    """Connection to a cluster; worker processes begun here end here.

    cluster: as in `check_cluster`
    """
    check_cluster(cluster)
    if cluster is None:
        yield None
        return
    distributed = _distributed(cluster)
    kind, _, rest = cluster.partition(":")
    if kind == "local":
        with (
            distributed.LocalCluster(
                n_workers=int(rest), threads_per_worker=1, dashboard_address=None, processes=True
            ) as workers,
            distributed.Client(workers) as client,
        ):
            yield client
        return
    try:
        client = distributed.Client(cluster, timeout=LONGEST_WAIT)
    except (OSError, TimeoutError, ValueError) as error:
        raise InputError(f'no dask scheduler answers at "{cluster}" ({error}); is it running?') from None
    with client:
        yield client


def _distributed(cluster: str) -> Any:
    try:
        return import_module("distributed")
    except ImportError:
        raise InputError(
            f'cluster "{cluster}" needs dask.distributed; install it with: pip install "quartering[cluster]"'
        ) from None

"""Run compiled kernels over many conditions on all cores.

A kernel takes ``(first, last, *arrays)``, works on that range of conditions and releases the interpreter lock, so plain
threads share the work: nothing is copied, nothing is compiled twice, and two callers never disturb each other.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager
from typing import Any, TypeVar, cast

_WORKERS = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else (os.cpu_count() or 1)
_inside = threading.local()

Item = TypeVar("Item")
Result = TypeVar("Result")


def in_threads(kernel: Callable[..., Any], count: int, *arrays: Any, smallest: int = 16) -> None:
    """Run ``kernel(first, last, *arrays)`` over ``range(count)`` in blocks, on all cores.

    kernel: writes its results into some of the arrays
    count: number of conditions
    passed on unchanged
    smallest: conditions that are worth a block of their own; blocks are multiples of it

    Blocks are a fraction of each core's share, so that a core that meets harder conditions does not hold the others up.
    Inside work that `spread` has already put on a thread, the kernel runs there and then.
    """
    block = smallest * max(1, -(-count // (8 * _WORKERS * smallest)))
    if getattr(_inside, "busy", False) or _WORKERS == 1 or count <= block:
        kernel(0, count, *arrays)
        return
    kernel(0, 0, *arrays)  # compiles once, before threads would race to do it
    with ThreadPoolExecutor(_WORKERS) as pool:
        for done in [
            pool.submit(kernel, first, min(first + block, count), *arrays) for first in range(0, count, block)
        ]:
            done.result()


def workers() -> int:
    """Number of cores this process may use."""
    return _WORKERS


def alone(work: Callable[[Item], Result], item: Item) -> Result:
    """Do a piece of work on this thread only, as one of many that others do at the same time.

    work: of one item
    Returns its result
    """
    before = getattr(_inside, "busy", False)
    _inside.busy = True
    try:
        return work(item)
    finally:
        _inside.busy = before


def spread_in_order(work: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
    """Results of a piece of work for each item, done on all cores, in the order of the items; see `spread`."""
    found = dict(spread(work, items))
    return [found[i] for i in range(len(items))]


def spread(work: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[tuple[int, Result]]:
    """Do a piece of work for each item on all cores, and hand the results over as they are done.

    work: of one item; spends its time in compiled code
    Yields (int, result): index of the item, and its result; the first item comes first, done alone so that kernels
        compile once

    Stopping the iteration (an interrupt, an error) drops the items not yet begun.
    """

    if not items:
        return
    if len(items) == 1 or _WORKERS == 1 or getattr(_inside, "busy", False):
        yield from ((i, work(item)) for i, item in enumerate(items))
        return
    yield 0, work(items[0])
    pool = ThreadPoolExecutor(_WORKERS)
    try:
        pending = {pool.submit(alone, work, item): i for i, item in enumerate(items) if i > 0}
        while pending:
            for done in wait(pending, return_when=FIRST_COMPLETED).done:
                yield pending.pop(done), done.result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def small_matrices() -> AbstractContextManager[Any]:
    """Solve linear systems on one thread while the body runs.

    Matrices of a hundred unknowns are solved faster by one core than shared by several; on a busy machine, seven times. And
    the last digits do not depend on how many cores there are.
    """
    from threadpoolctl import threadpool_limits

    return cast(AbstractContextManager[Any], threadpool_limits(limits=1, user_api="blas"))

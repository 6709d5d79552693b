"""Compiled kernels over many conditions, spread over this machine's cores.

A kernel takes ``(first, last, *arrays)``, works on that range of conditions and releases the interpreter lock, so plain
threads share the work: nothing is copied, nothing is compiled twice, and two callers never disturb each other.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

_WORKERS = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else (os.cpu_count() or 1)
_SMALLEST_BLOCK = 16


def in_threads(kernel: Callable[..., Any], count: int, *arrays: Any) -> None:
    """Run ``kernel(first, last, *arrays)`` over ``range(count)`` in blocks, on all cores.

    Parameters
    ----------
    kernel : compiled function    writes its results into some of the arrays
    count : int                   number of conditions
    *arrays                       passed on unchanged

    Notes
    -----
    Blocks are a fraction of each core's share, so that a core that meets harder conditions does not hold the others up.
    """
    if count == 0:
        return
    kernel(0, 1, *arrays)  # compiles once, before threads would race to do it
    block = max(_SMALLEST_BLOCK, -(-count // (8 * _WORKERS)))
    starts = range(1, count, block)
    if len(starts) <= 1 or _WORKERS == 1:
        kernel(1, count, *arrays)
        return
    with ThreadPoolExecutor(_WORKERS) as pool:
        for done in [pool.submit(kernel, first, min(first + block, count), *arrays) for first in starts]:
            done.result()

"""Ctrl-C at any moment: one line, none lost.

The interpreter tells of an interrupt by an exception wherever it stands. While a kernel is compiled that may be in code that
cleans up after itself and lets exceptions go, and the program would run on. So it is also kept, and asked for between blocks.
"""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_asked = threading.Event()


@contextmanager
def quiet_start() -> Iterator[None]:
    """End without a word on Ctrl-C while modules are imported, when there is nothing to keep or to say yet."""
    with _handled(signal.SIG_DFL):
        yield


@contextmanager
def listening() -> Iterator[None]:
    """Keep an interrupt beside raising it, while the body runs; one that a destructor swallowed is kept, and not printed."""
    _asked.clear()
    usual = sys.unraisablehook
    sys.unraisablehook = lambda told: None if told.exc_type is KeyboardInterrupt and _asked.is_set() else usual(told)
    try:
        with _handled(_keep):
            yield
    finally:
        sys.unraisablehook = usual


def was_asked() -> bool:
    """Did an interrupt come that was lost?"""
    return _asked.is_set()


def stop_if_asked() -> None:
    """Raise the interrupt that came and was lost."""
    if _asked.is_set():
        _asked.clear()
        raise KeyboardInterrupt


def _keep(*_: Any) -> None:
    _asked.set()
    raise KeyboardInterrupt


@contextmanager
def _handled(by: Any) -> Iterator[None]:
    """Another handler of SIGINT, where it may be set and nobody has set one of their own."""
    usual = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or usual is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, by)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, usual)

"""One process compiles a kernel, others that need it wait until it is kept.

Programs that begin together need the same kernels, and a second process compiles some ahead. Each marks, in a file beside the
kept code, a byte of its own for every kernel that it compiles. A mark goes with its process, and nobody waits for long: where
marks cannot be made, or one is never taken away, a kernel is compiled twice.
"""

from __future__ import annotations

import os
import time
import zlib
from contextlib import suppress
from pathlib import Path
from typing import Final

try:
    import fcntl
except ImportError:  # not on every system: there each process compiles for itself
    _MARKS = False
else:
    _MARKS = True

_LONGEST: Final = 120.0
"""Longest wait for another process [s]."""
_BETWEEN: Final = 0.02
_FILE: Final = "quartering.compiling"
_opened: dict[tuple[int, str], int] = {}
"""File of marks by process and folder: it stays open, since whoever closes it loses all marks in it."""


def begin(folder: str, kernel: str) -> None:
    """Mark a kernel as compiled by this process, once no other has it marked.

    folder: where it is kept
    kernel: its name
    """
    if not _MARKS:
        return
    end = time.monotonic() + _LONGEST
    with suppress(OSError):
        file = _file(folder)
        while True:
            try:
                fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, _byte(kernel))
            except (BlockingIOError, PermissionError):
                if time.monotonic() > end:
                    return
                time.sleep(_BETWEEN)
            else:
                return


def end(folder: str, kernel: str) -> None:
    """Take the mark away."""
    if _MARKS and (os.getpid(), folder) in _opened:
        with suppress(OSError):
            fcntl.lockf(_opened[os.getpid(), folder], fcntl.LOCK_UN, 1, _byte(kernel))


def _byte(kernel: str) -> int:
    """Place of the mark of a kernel; two that share one wait for each other for nothing."""
    return zlib.crc32(kernel.encode())


def _file(folder: str) -> int:
    key = os.getpid(), folder
    if key not in _opened:
        Path(folder).mkdir(parents=True, exist_ok=True)
        _opened[key] = os.open(Path(folder) / _FILE, os.O_RDWR | os.O_CREAT | getattr(os, "O_CLOEXEC", 0), 0o666)
    return _opened[key]

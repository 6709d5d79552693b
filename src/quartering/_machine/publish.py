"""A file written whole or not at all."""

from __future__ import annotations

import os
import threading
from pathlib import Path


def publish(path: Path, data: bytes) -> None:
    """Write a file atomically: temporary file, fsync, rename."""
    part = path.with_name(f".{path.name}.{os.getpid()}.{threading.get_ident()}.part")
    try:
        with open(part, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)

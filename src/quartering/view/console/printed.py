"""What a command prints: tables for people, JSON for programs, and what to type next."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

WIDTH_WITHOUT_TERMINAL = 120
_NEXT = "Next:\n"


def console() -> Console:
    """Console on standard output; wide when that is a file or a pipe."""
    from rich.console import Console

    return Console(width=None if sys.stdout.isatty() else WIDTH_WITHOUT_TERMINAL, highlight=False, soft_wrap=False)


def table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> Table:
    """Table of texts.

    right: columns of numbers, aligned to the right
    """
    from rich.table import Table
    from rich.text import Text

    made = Table(title=Text(title), title_justify="left", header_style="bold", title_style="bold")
    for i, name in enumerate(columns):
        made.add_column(Text(name), justify="right" if i in right else "left", overflow="fold")
    for row in rows:
        made.add_row(*(Text(cell) for cell in row))
    return made


def show(*parts: Table | str) -> None:
    """Print tables and plain lines on standard output."""
    from rich.text import Text

    screen = console()
    for part in parts:
        if isinstance(part, str) and part.startswith(_NEXT):  # whole lines, to be copied
            screen.print(Text(part), soft_wrap=True)
        else:
            screen.print(Text(part) if isinstance(part, str) else part)


def next_steps(*commands: str) -> str:
    """Lines that say what to type next."""
    return _NEXT + "\n".join(f"  {command}" for command in commands)


def show_json(content: Mapping[str, Any]) -> None:
    """Print one JSON object on standard output; NaN becomes null, a complex number {"re", "im"}."""
    print(json.dumps(plain(content), indent=2, ensure_ascii=False, allow_nan=False))


def plain(value: Any) -> Any:
    """Value in types JSON knows."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, complex):
        return {"re": plain(value.real), "im": plain(value.imag)}
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)

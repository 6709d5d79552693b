"""What a command prints: tables for people, JSON for programs, and what to type next."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table as Printed

WIDTH_WITHOUT_TERMINAL = 120
_NEXT = "Next:\n"


def console() -> Console:
    """Console on standard output; wide when that is a file or a pipe."""
    from rich.console import Console

    return Console(width=None if sys.stdout.isatty() else WIDTH_WITHOUT_TERMINAL, highlight=False, soft_wrap=False)


@dataclass(frozen=True)
class Table:
    """A table of a command: cells are texts on the screen, numbers too in a file, where the notes say what they are from."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]
    right: tuple[int, ...] = ()
    notes: tuple[str, ...] = ()


def table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> Table:
    """Table of texts.

    right: columns of numbers, aligned to the right
    """
    return Table(title, tuple(columns), tuple(tuple(row) for row in rows), tuple(right))


def _printed(one: Table) -> Printed:
    """A table as the screen takes it."""
    from rich.table import Table as Printed
    from rich.text import Text

    made = Printed(title=Text(one.title), title_justify="left", header_style="bold", title_style="bold")
    for i, name in enumerate(one.columns):
        made.add_column(Text(name), justify="right" if i in one.right else "left", overflow="fold")
    for row in one.rows:
        made.add_row(*(Text(str(cell)) for cell in row))
    return made


def show(*parts: Table | str) -> None:
    """Print tables and plain lines on standard output."""
    from rich.text import Text

    screen = console()
    for part in parts:
        if isinstance(part, str) and part.startswith(_NEXT):  # whole lines, to be copied
            screen.print(Text(part), soft_wrap=True)
        else:
            screen.print(Text(part) if isinstance(part, str) else _printed(part))


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

"""The built-in ships by name; none of their files is read but for the line that says what it is."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

LIBRARY = Path(__file__).parents[1] / "library"


class ShipEntry(NamedTuple):
    """A built-in ship: its name and one line about it."""

    name: str
    description: str


def available_ships() -> list[ShipEntry]:
    """Built-in ships, sorted by name.

    Returns name and one-line description

    Source: the files of ``hull/library``; each names where its lines come from.
    """
    found = []
    for path in sorted(LIBRARY.glob("*.yaml")):
        with path.open(encoding="utf-8") as lines:
            line = next(text for text in lines if text.startswith("description:"))
        found.append(ShipEntry(path.stem, line.removeprefix("description:").strip().strip('"')))
    return found

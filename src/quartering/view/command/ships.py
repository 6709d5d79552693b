"""`quartering ships`: the built-in ships."""

from __future__ import annotations

from quartering.view.console.answer import Answer
from quartering.view.console.printed import table


def ships() -> Answer:
    """List the built-in ships."""
    from quartering.hull.file.read import available_ships

    entries = available_ships()
    return Answer(
        [table("Built-in ships", ("name", "what it is"), entries)],
        lambda: {entry.name: entry.description for entry in entries},
        next_steps=["quartering hull series60-cb60", "quartering new series60-cb60 my.yaml"],
    )

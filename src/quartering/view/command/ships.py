"""`quartering ships`: the built-in ships."""

from __future__ import annotations

from quartering.view.console.answer import Answer
from quartering.view.console.arguments import TableFile
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import table


def ships(output: TableFile = None) -> Answer:
    """List the built-in ships."""
    from quartering.hull.file.built_in import available_ships

    entries = available_ships()
    return Answer(
        [table("Built-in ships", ("name", "what it is"), entries)],
        lambda: {entry.name: entry.description for entry in entries},
        output=reserve_path(output, TABLES),
        next_steps=["quartering hull series60-cb60", "quartering new series60-cb60 my.yaml"],
    )

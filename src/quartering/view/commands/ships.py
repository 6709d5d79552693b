"""`quartering ships` and `quartering new`."""

from __future__ import annotations

from pathlib import Path

from quartering.hull.readers import available_ships
from quartering.hull.starting_file import write_ship
from quartering.view.output import claim, write
from quartering.view.terminal import next_steps, show, show_json, table


def list_ships(as_json: bool) -> None:
    """Print the built-in ships."""
    entries = available_ships()
    if as_json:
        show_json({entry.name: entry.description for entry in entries})
        return
    show(table("Built-in ships", ("name", "what it is"), entries))
    show(next_steps("quartering hull series60-cb60", "quartering new series60-cb60 my.yaml"))


def new_file(name: str, path: str, as_json: bool) -> None:
    """Write a ship file and say what to do with it."""
    target = Path(path)
    if target.exists():
        write_ship(name, target)  # refuses, and says why
    written = claim(target, (".yaml", ".yml"))
    write((written, lambda part: write_ship(name, part)))
    if as_json:
        show_json({"file": str(written), "base": name})
        return
    show(f"Wrote {written}: change what differs on your ship; a comment on each line says what it is.")
    show(next_steps(f"quartering hull {written}", f"quartering polar {written}"))

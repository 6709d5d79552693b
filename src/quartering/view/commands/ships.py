"""`quartering ships` and `quartering new`."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from quartering.conventions import InputError, RangeWarning
from quartering.hull.file.new import write_ship
from quartering.hull.file.new_from_offsets import write_offsets_ship
from quartering.hull.file.read import available_ships
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.righting.arm import righting_arm, righting_polynomial
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


def new_from_offsets(lines: str, path: str | None, sizes: Mapping[str, str | None], as_json: bool) -> None:
    """Write the ship file of one's own lines with what was found, and draw them."""
    target = Path(path or Path(lines).with_suffix(".yaml").name)
    if target.suffix not in (".yaml", ".yml"):
        raise InputError(f'"{target}": its name must end in .yaml; try "{target.with_suffix(".yaml")}"')
    made = write_offsets_ship(lines, target, **sizes)
    picture = target.with_suffix(".png")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # the deck edge of the arm drawn
        angles = np.linspace(0.0, 60.0, 61)
        arms, fit = righting_arm(made, angles), righting_polynomial(made)
    from quartering.view.plots import style
    from quartering.view.plots.hull import hull_picture

    write((picture, lambda part: style.save(hull_picture(made, angles, arms, fit), part)))
    floats = hydrostatics(made)
    if as_json:
        show_json(
            {
                "file": str(target),
                "picture": str(picture),
                "volume": floats.volume,
                "cb": floats.cb,
                "lines": made.hull.source,
            }
        )
        return
    show(target.read_text(encoding="utf-8").rstrip())
    show(f"Volume {floats.volume:.5g} m3, CB {floats.cb:.3f}, KM {floats.km:.4g} m. {made.hull.source}.")
    show(f"Wrote {target} and {picture}: check both against your plan.")
    show(next_steps(f"quartering hull {target}", f"quartering polar {target}"))


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

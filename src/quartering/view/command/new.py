"""`quartering new`: a ship file that starts from a built-in ship or from one's own lines, or a case file."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError, RangeWarning
from quartering.view.console.answer import Answer
from quartering.view.console.files import File, picture_files, reserve_path

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FILES = (".yaml", ".yml")


def new(
    ship: Annotated[
        str | None, typer.Argument(help="Built-in ship to start from; with --offsets, the ship file to write.")
    ] = None,
    file: Annotated[str | None, typer.Argument(help="Ship file to write, such as my.yaml.")] = None,
    case: Annotated[
        bool, typer.Option("--case", help="Write the case file of a study with this ship instead.")
    ] = False,
    offsets: Annotated[
        str | None, typer.Option("--offsets", help="Lines of your own (CSV, PDSTRIP, GDF, STL) to start from instead.")
    ] = None,
    draught: Annotated[str | None, typer.Option(help="Draught of the lines, with --offsets [m].")] = None,
    length: Annotated[str | None, typer.Option(help="Between perpendiculars, with --offsets [m].")] = None,
    beam: Annotated[str | None, typer.Option(help="Moulded, with --offsets [m].")] = None,
    unit: Annotated[
        str | None, typer.Option(help="Of the numbers in the file, with --offsets: mm; else what it says, or m.")
    ] = None,
) -> Answer:
    """Write a commented ship file that starts from a built-in ship or from your own lines, or the case file of a study."""
    if offsets is not None:
        return _from_offsets(offsets, file or ship, {"draught": draught, "length": length, "beam": beam, "unit": unit})
    if ship is not None:
        from quartering.hull.file.new import refuse_lines

        refuse_lines(ship)
    if ship is None or file is None:
        raise InputError(
            "new: give a built-in ship and the file to write, `new wigley my.yaml`, or `new --offsets my.csv`"
        )
    return _case(ship, file) if case else _from_ship(ship, file)


def _from_ship(name: str, file: str) -> Answer:
    """A ship file that starts from a built-in ship."""
    from quartering.hull.file.new import write_ship

    target = Path(file)
    if target.exists():
        write_ship(name, target)  # refuses, and says why
    path = reserve_path(target, _FILES)
    return Answer(
        [],
        lambda: {"file": str(path), "base": name},
        [File(path, lambda part: write_ship(name, part))],
        written=f"Wrote {path}: change what differs on your ship; a comment on each line says what it is.",
        next_steps=[f"quartering hull {path}", f"quartering polar {path}"],
    )


def _case(name: str, file: str) -> Answer:
    """A case file to begin a study from."""
    from quartering.hull.file.read import ship as read_ship
    from quartering.study.case.new import starting_case

    read_ship(name)
    target = Path(file)
    if target.exists():
        raise InputError(f'"{target}" is there already; give another name, or remove it first')
    path = reserve_path(target, _FILES)
    return Answer(
        [],
        lambda: {"file": str(path), "ship": name},
        [File(path, lambda part: part.write_text(starting_case(name), encoding="utf-8"))],
        written=f"Wrote {path}: a comment on each line says what it is.",
        next_steps=[f"quartering sweep {path}"],
    )


def _from_offsets(lines: str, file: str | None, sizes: Mapping[str, str | None]) -> Answer:
    """The ship file of one's own lines with what was found, and their picture."""
    import numpy as np

    from quartering.hull.file.new_from_offsets import write_offsets_ship
    from quartering.hull.hydrostatics import hydrostatics
    from quartering.hull.righting.arm import righting_arm, righting_polynomial

    target = Path(file or Path(lines).with_suffix(".yaml").name)
    if target.suffix not in _FILES:
        raise InputError(f'"{target}": its name must end in .yaml; try "{target.with_suffix(".yaml")}"')
    made = write_offsets_ship(lines, target, **sizes)
    picture = target.with_suffix(".png")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # the deck edge of the arm drawn
        angles = np.linspace(0.0, 60.0, 61)
        arms, fit = righting_arm(made, angles), righting_polynomial(made)
    floats = hydrostatics(made)

    def draw() -> Figure:
        from quartering.view.plots.hull import hull_picture

        return hull_picture(made, angles, arms, fit)

    def told() -> Iterator[str]:
        yield target.read_text(encoding="utf-8").rstrip()
        yield f"Volume {floats.volume:.5g} m3, CB {floats.cb:.3f}, KM {floats.km:.4g} m. {made.hull.source}."

    def facts() -> dict[str, object]:
        about = {"volume": floats.volume, "cb": floats.cb, "lines": made.hull.source}
        return {"file": str(target), "picture": str(picture)} | about

    return Answer(
        told(),
        facts,
        picture_files(picture, draw),
        written=f"Wrote {target} and {picture}: check both against your plan.",
        next_steps=[f"quartering hull {target}", f"quartering polar {target}"],
    )

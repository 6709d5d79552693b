"""`quartering decay`: from a measured roll decay to a ship file with its damping, counted once."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.units import quantity
from quartering.view.console.answer import Answer
from quartering.view.console.files import PICTURES, TABLES, File, is_table, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.typed_ship import typed_value

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.hydro.decay.fit import Estimate
    from quartering.hydro.decay.of_ship import Part, RollDecay
    from quartering.hydro.decay.record import AngleUnit, DecayRecord
    from quartering.view.console.printed import Table


def decay(
    record: Annotated[str, typer.Argument(help="Record of a free roll decay: a text file of time [s] and angle.")],
    ship: Annotated[
        str | None, typer.Option("--ship", help="Ship file, or built-in ship, as loaded when it was measured.")
    ] = None,
    output: Annotated[
        str | None,
        typer.Option("-o", "--output", help="Ship file to write, such as damped.yaml; or tables: .csv, .xlsx."),
    ] = None,
    picture: Annotated[str | None, typer.Option(help="Picture of record and envelopes: .png, .svg or .pdf.")] = None,
    unit: Annotated[
        str | None, typer.Option(help="Of the angle, deg or rad; otherwise the name of its column tells.")
    ] = None,
    columns: Annotated[
        str | None, typer.Option(help="Which columns hold time and angle, such as 2,3; otherwise it has two.")
    ] = None,
    speed: Annotated[str, typer.Option(help="Speed it was measured at, full scale: 7.5 [m/s], 15kn or 0.25Fn.")] = "0",
    scale: Annotated[str, typer.Option(help="Scale of a model whose time it is, such as 68 for 1:68.")] = "1",
    skip: Annotated[int, typer.Option(help="Extremes left out after the release.")] = 0,
) -> Answer:
    """Fit a measured roll decay and write a ship file with its damping, less what the ship's waves and drag have already."""
    from quartering.hull.file.changed import changed_text
    from quartering.hull.file.read import ship as read_ship
    from quartering.hydro.decay.of_ship import roll_decay

    if ship is None:
        raise InputError(
            "no ship is named; the damping that is added depends on what its waves and drag have already: give "
            "--ship my.yaml (`quartering new series60-cb60 my.yaml` writes one to start from)"
        )
    one = read_ship(ship)
    path, picture_path = _output(output), reserve_path(picture, PICTURES)
    if path is not None and not is_table(path):
        changed_text(ship, {}, path)  # refuses before the work what cannot be written there
    data = _record(record, unit, columns, scale)
    found = roll_decay(one, data, speed=typed_value("speed", speed, one.sizes), skip=skip)
    files: list[File] = []
    if path is not None and not is_table(path):
        text = changed_text(ship, _values(found, one), path)
        files.append(File(path, lambda part: part.write_text(text, encoding="utf-8")))

    def draw() -> Figure:
        from quartering.view.plots.decay import decay_picture

        return decay_picture(found)

    files += picture_files(picture_path, draw)
    return Answer(
        _lines(found, one),
        lambda: _facts(found, files),
        files,
        output=path,
        next_steps=[f"quartering hull {output or ship}", f"quartering polar {output or ship}"]
        if path is not None and not is_table(path)
        else [f"quartering decay {record} --ship {ship} -o damped.yaml --picture decay.png"],
    )


def _output(path: str | None) -> Path | None:
    """The ship file to write, which must not be there yet."""
    if path is None:
        return None
    if Path(path).exists():
        raise InputError(f"{path} exists; it is not overwritten; give another name, or remove it first")
    return reserve_path(path, (".yaml", ".yml", *TABLES))


def _record(path: str, unit: str | None, columns: str | None, scale: str) -> DecayRecord:
    """The record as its options say it is to be read."""
    import numpy as np

    from quartering.hydro.decay.record import read_decay

    of_angle: AngleUnit | None = None
    if unit is not None:
        if unit not in ("deg", "rad"):
            raise InputError(f'--unit "{unit}" is unknown; allowed are deg and rad')
        of_angle = "rad" if unit == "rad" else "deg"
    factor = quantity(scale, "ratio", what="--scale")
    if factor <= 0:
        raise InputError(f"--scale {scale} must be above 0; it is 68 for a model of 1:68")
    chosen = None if columns is None else _columns(columns)
    return read_decay(path, unit=of_angle, columns=chosen, time_factor=float(np.sqrt(factor)))


def _columns(text: str) -> tuple[int, int]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(part.isdecimal() and int(part) > 0 for part in parts):
        raise InputError(f'--columns "{text}" must be two numbers from 1 up, time first, such as 2,3')
    return int(parts[0]) - 1, int(parts[1]) - 1


def _values(found: RollDecay, before: Ship) -> dict[str, dict[str, float | str]]:
    """What the ship file is to say."""
    from quartering.hull.file.changed import rounded
    from quartering.hydro.decay.free_roll import QUADRATIC

    notes = found.provenance
    values: dict[str, dict[str, float | str]] = {"loading": {"roll_damping": rounded(found.roll_damping)}}
    told = {"roll_damping": notes["roll_damping"]}
    if found.quadratic or QUADRATIC in before.overrides:
        values["coefficients"] = {QUADRATIC: rounded(found.quadratic)}
        told[QUADRATIC] = notes[QUADRATIC]
    return {**values, "provenance": {**told}}


def _lines(found: RollDecay, before: Ship) -> Iterator[Table | str]:
    """What was fitted, what the ship had already, and what is added."""
    import numpy as np

    from quartering.hull.file.changed import rounded
    from quartering.hydro.decay.free_roll import QUADRATIC, damping_words
    from quartering.view.wording import sentence, speed_words

    fit, energy = found.fit, found.energy
    yield (
        f"{Path(found.record.source).name}: {fit.swings} swings from {np.degrees(fit.largest):.3g} to "
        f"{np.degrees(fit.smallest):.2g} deg, period {fit.period:.4g} s (small swings); {before.name}: "
        f"{2 * np.pi / found.bare.frequency:.4g} s"
    )
    rows = [
        ("linear, % of critical", _interval(fit.damping_ratio, 100), _interval(energy.damping_ratio, 100)),
        ("quadratic d, 1/rad", _interval(fit.nonlinear, 1), _interval(energy.nonlinear, 1)),
        ("misfit", f"{100 * fit.misfit:.2g} % of the first swing", f"{100 * energy.misfit:.2g} % of the damping"),
    ]
    yield table("Fitted, with intervals of 95 %", ("part", "equation of motion", "energy"), rows, (1, 2))
    at = f" at {speed_words(found.speed, before.hull.length)}" if found.speed else ""
    yield table(
        f"Damping of a free roll{at}",
        ("part", "record", "ship has already", "added", "ship now"),
        [_row(part) for part in found.parts()],
        (1, 2, 3, 4),
    )
    yield f"The ship has already: {_has_words(found)}."
    yield (
        f"Added: roll_damping {rounded(found.roll_damping):g} (of 2 n2 (I_x + a44), as the ship file counts) and {QUADRATIC} "
        f"{rounded(found.quadratic):g} kg m2{_replaced_words(before)}."
    )
    yield sentence(damping_words(found.ship, found.speed))


def _row(part: Part) -> tuple[str, str, str, str, str]:
    values = (part.record, part.has, part.added, part.now)
    if part.unit == "1":
        record, has, added, now = (f"{100 * number:.3g} %" for number in values)
    else:
        record, has, added, now = (f"{number:.3g}" for number in values)
    name = f"{part.name}, of critical" if part.unit == "1" else f"{part.name} d, {part.unit}"
    return name, record, has, added, now


def _has_words(found: RollDecay) -> str:
    from quartering.hydro.source.of_ship import source_of

    bare = found.bare
    lift = f", lift {100 * found.lift:.3g} %" if found.speed else ""
    drag = f"drag of the sections (C_D {found.ship.drag_coefficient:g}) d = {bare.drag:.3g} 1/rad"
    if not bare.drag:
        drag = "no drag of the sections (drag_coefficient 0)"
    return f"waves of {source_of(found.ship).words} {100 * (bare.ratio - found.lift):.3g} % of critical{lift}; {drag}"


def _replaced_words(before: Ship) -> str:
    """What the file had added before."""
    from quartering.hydro.decay.free_roll import QUADRATIC

    own = f", and its {QUADRATIC}" if QUADRATIC in before.overrides else ""
    return f"; in place of {before.roll_damping_words}{own}"


def _interval(estimate: Estimate, factor: float) -> str:
    return f"{factor * estimate.value:.3g} ± {factor * (estimate.high - estimate.low) / 2:.1g}"


def _facts(found: RollDecay, files: list[File]) -> dict[str, object]:
    import numpy as np

    from quartering.hull.file.changed import rounded
    from quartering.hydro.decay.free_roll import QUADRATIC

    return {
        "record": found.record.source,
        "ship": found.ship.name,
        "speed": found.speed,
        "fit": {
            row.name: {"value": row.value, "low": row.low, "high": row.high, "unit": row.unit}
            for row in found.fit.table()
        },
        "energy": {
            row.name: {"value": row.value, "low": row.low, "high": row.high, "unit": row.unit}
            for row in found.energy.table()
        },
        "period": found.fit.period,
        "ship_period": 2 * np.pi / found.bare.frequency,
        "parts": [part._asdict() for part in found.parts()],
        "waves": found.bare.ratio - found.lift,
        "lift": found.lift,
        "drag": found.bare.drag,
        "roll_damping": rounded(found.roll_damping),
        QUADRATIC: rounded(found.quadratic),
        "provenance": found.provenance,
        "notes": list(found.notes),
        "files": [str(file.path) for file in files],
    }

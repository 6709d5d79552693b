"""`quartering decay`: from a measured roll decay to a ship file with its damping, counted once."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from quartering.conventions import InputError
from quartering.hull.file.changed import changed_text, rounded
from quartering.hull.file.read import ship
from quartering.hull.ship import Ship
from quartering.hydro.decay.fit import Estimate
from quartering.hydro.decay.free_roll import QUADRATIC, damping_words
from quartering.hydro.decay.of_ship import Part, RollDecay, roll_decay
from quartering.hydro.decay.record import AngleUnit, DecayRecord, read_decay
from quartering.hydro.source.of_ship import source_of
from quartering.units import quantity
from quartering.view.commands.conditions import typed_value
from quartering.view.output import PICTURES, claim, write
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import sentence, speed_words


class Request(NamedTuple):
    """What was typed."""

    record: str
    ship: str | None
    output: str | None
    picture: str | None
    unit: str | None
    columns: str | None
    speed: str
    scale: str
    skip: int


def damp_ship(asked: Request, as_json: bool) -> None:
    """Fit the record, take off what the ship has, print both, and write ship file and picture where asked."""
    if asked.ship is None:
        raise InputError(
            "no ship is named; the damping that is added depends on what its waves and drag have already: give "
            "--ship my.yaml (`quartering new series60-cb60 my.yaml` writes one to start from)"
        )
    one = ship(asked.ship)
    output, picture = _output(asked.output), None if asked.picture is None else claim(asked.picture, PICTURES)
    if output is not None:
        changed_text(asked.ship, {}, output)  # refuses before the work what cannot be written there
    record = _record(asked)
    found = roll_decay(one, record, speed=typed_value("speed", asked.speed, one.sizes), skip=asked.skip)
    files: list[Any] = []
    if output is not None:
        text = changed_text(asked.ship, _values(found, one), output)
        files.append((output, lambda part: part.write_text(text, encoding="utf-8")))
    if picture is not None:
        from quartering.view.plots import style
        from quartering.view.plots.decay import decay_picture

        files.append((picture, lambda part: style.save(decay_picture(found), part)))
    write(*files)
    if as_json:
        show_json(_facts(found, files))
        return
    _print(found, one)
    for path, _ in files:
        show(f"Wrote {path}")
    mine = output or asked.ship
    if output is None:
        show(next_steps(f"quartering decay {asked.record} --ship {asked.ship} -o damped.yaml --picture decay.png"))
    else:
        show(next_steps(f"quartering hull {mine}", f"quartering polar {mine}"))


def _output(path: str | None) -> Path | None:
    """The ship file to write, which must not be there yet."""
    if path is None:
        return None
    if Path(path).exists():
        raise InputError(f"{path} exists; it is not overwritten; give another name, or remove it first")
    return claim(path, (".yaml", ".yml"))


def _record(asked: Request) -> DecayRecord:
    """The record as its options say it is to be read."""
    unit: AngleUnit | None = None
    if asked.unit is not None:
        if asked.unit not in ("deg", "rad"):
            raise InputError(f'--unit "{asked.unit}" is unknown; allowed are deg and rad')
        unit = "rad" if asked.unit == "rad" else "deg"
    scale = quantity(asked.scale, "ratio", what="--scale")
    if scale <= 0:
        raise InputError(f"--scale {asked.scale} must be above 0; it is 68 for a model of 1:68")
    columns = None if asked.columns is None else _columns(asked.columns)
    return read_decay(asked.record, unit=unit, columns=columns, time_factor=float(np.sqrt(scale)))


def _columns(text: str) -> tuple[int, int]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(part.isdecimal() and int(part) > 0 for part in parts):
        raise InputError(f'--columns "{text}" must be two numbers from 1 up, time first, such as 2,3')
    return int(parts[0]) - 1, int(parts[1]) - 1


def _values(found: RollDecay, before: Ship) -> dict[str, dict[str, float | str]]:
    """What the ship file is to say."""
    notes = found.provenance
    values: dict[str, dict[str, float | str]] = {"loading": {"roll_damping": rounded(found.roll_damping)}}
    told = {"roll_damping": notes["roll_damping"]}
    if found.quadratic or QUADRATIC in before.overrides:
        values["coefficients"] = {QUADRATIC: rounded(found.quadratic)}
        told[QUADRATIC] = notes[QUADRATIC]
    return {**values, "provenance": {**told}}


def _print(found: RollDecay, before: Ship) -> None:
    fit, energy = found.fit, found.energy
    show(
        f"{Path(found.record.source).name}: {fit.swings} swings from {np.degrees(fit.largest):.3g} to "
        f"{np.degrees(fit.smallest):.2g} deg, period {fit.period:.4g} s (small swings); {before.name}: "
        f"{2 * np.pi / found.bare.frequency:.4g} s"
    )
    rows = [
        ("linear, % of critical", _interval(fit.damping_ratio, 100), _interval(energy.damping_ratio, 100)),
        ("quadratic d, 1/rad", _interval(fit.nonlinear, 1), _interval(energy.nonlinear, 1)),
        ("misfit", f"{100 * fit.misfit:.2g} % of the first swing", f"{100 * energy.misfit:.2g} % of the damping"),
    ]
    show(table("Fitted, with intervals of 95 %", ("part", "equation of motion", "energy"), rows, (1, 2)))
    at = f" at {speed_words(found.speed, before.hull.length)}" if found.speed else ""
    show(
        table(
            f"Damping of a free roll{at}",
            ("part", "record", "ship has already", "added", "ship now"),
            [_row(part) for part in found.parts()],
            (1, 2, 3, 4),
        )
    )
    show(f"The ship has already: {_has_words(found)}.")
    show(
        f"Added: roll_damping {rounded(found.roll_damping):g} (of 2 n2 (I_x + a44), as the ship file counts) and {QUADRATIC} "
        f"{rounded(found.quadratic):g} kg m2{_replaced_words(before)}."
    )
    show(sentence(damping_words(found.ship, found.speed)))


def _row(part: Part) -> tuple[str, str, str, str, str]:
    values = (part.record, part.has, part.added, part.now)
    if part.unit == "1":
        record, has, added, now = (f"{100 * number:.3g} %" for number in values)
    else:
        record, has, added, now = (f"{number:.3g}" for number in values)
    name = f"{part.name}, of critical" if part.unit == "1" else f"{part.name} d, {part.unit}"
    return name, record, has, added, now


def _has_words(found: RollDecay) -> str:
    bare = found.bare
    lift = f", lift {100 * found.lift:.3g} %" if found.speed else ""
    drag = f"drag of the sections (C_D {found.ship.drag_coefficient:g}) d = {bare.drag:.3g} 1/rad"
    if not bare.drag:
        drag = "no drag of the sections (drag_coefficient 0)"
    return f"waves of {source_of(found.ship).words} {100 * (bare.ratio - found.lift):.3g} % of critical{lift}; {drag}"


def _replaced_words(before: Ship) -> str:
    """What the file had added before."""
    own = f", and its {QUADRATIC}" if QUADRATIC in before.overrides else ""
    return f"; in place of {before.roll_damping_words}{own}"


def _interval(estimate: Estimate, factor: float) -> str:
    return f"{factor * estimate.value:.3g} ± {factor * (estimate.high - estimate.low) / 2:.1g}"


def _facts(found: RollDecay, files: list[Any]) -> dict[str, object]:
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
        "files": [str(path) for path, _ in files],
    }

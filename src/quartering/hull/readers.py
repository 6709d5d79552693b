"""Ship files: YAML with units, built in or one's own, read into a `Ship`."""

from __future__ import annotations

from dataclasses import replace
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from quartering.conventions import InputError
from quartering.hull.autopilot import ASPECT, Autopilot, Rudder
from quartering.hull.choices import Ends, checked_ends
from quartering.hull.lines import hull_of
from quartering.hull.loading_entries import loading_entries, loading_of
from quartering.hull.offsets import Hull
from quartering.hull.own_database import Database, database_of
from quartering.hull.own_measured import MeasuredFile, measured_source
from quartering.hull.roll_method import BilgeKeels, checked_bilge_keels, roll_damping_note, roll_method
from quartering.hull.schema import Entry, ShipKeys, checked_keys
from quartering.hull.ship import DRAG_COEFFICIENT, Ship
from quartering.hull.units import Kind, quantity
from quartering.hull.yaml_text import read_yaml
from quartering.names import checked_values

LIBRARY = Path(__file__).parent / "library"


class ShipEntry(NamedTuple):
    """A built-in ship: its name and one line about it."""

    name: str
    description: str


def available_ships() -> list[ShipEntry]:
    """Built-in ships, sorted by name.

    Returns
    -------
    list of ShipEntry    name and one-line description

    Notes
    -----
    Source: the files of ``hull/library``; each names where its lines come from.

    Examples
    --------
    >>> [entry.name for entry in available_ships()][:2]
    ['box', 'dtc']
    """
    found = []
    for path in sorted(LIBRARY.glob("*.yaml")):
        with path.open(encoding="utf-8") as lines:
            line = next(text for text in lines if text.startswith("description:"))
        found.append(ShipEntry(path.stem, line.removeprefix("description:").strip().strip('"')))
    return found


def read_ship(name_or_path: str | Path) -> Ship:
    """Read a ship by built-in name or from a file (see ``ship``).

    Parameters
    ----------
    name_or_path : str or Path

    Returns
    -------
    Ship

    Raises
    ------
    InputError    no such ship or file, or something in it that cannot be right

    Notes
    -----
    Source: the file names its own.

    Examples
    --------
    >>> read_ship("box").hull.beam
    20.0
    """
    text = str(name_or_path)
    names = [entry.name for entry in available_ships()]
    if text in names:
        return _built_in(text)
    path = Path(text)
    try:
        there = path.is_file()
    except OSError:  # no name a file could have
        there = False
    if not there:
        raise InputError(f'"{text}" is neither a file nor a built-in ship; {_nearest(text, names)}')
    return _assembled(str(path), _keys(path))


def _nearest(text: str, names: list[str]) -> str:
    """Nearest built-in name to a word, and all of them."""
    near = [name for name in names if name.startswith(text.lower())] or get_close_matches(
        text.lower(), names, cutoff=0.6
    )
    hint = f'; did you mean "{near[0]}"?' if near else ""
    return f"built-in ships are {', '.join(names)}{hint}"


@lru_cache(maxsize=32)
def _built_in(name: str) -> Ship:
    return _assembled(name, _keys(LIBRARY / f"{name}.yaml"))


def _keys(path: Path) -> ShipKeys:
    return checked_keys(str(path), read_yaml(path))


def _assembled(where: str, keys: ShipKeys) -> Ship:
    """Ship from checked keys, on its base ship when it has one."""
    base, base_keys = _base(where, keys)
    hull = hull_of(where, keys, base.hull if base else None)
    database = _database(where, keys, base)
    hull = replace(
        hull,
        section_method=keys.sections or (base.hull.section_method if base else "auto"),
        ends=_ends(where, keys, base, database),
    )
    entries = loading_entries(where, keys.loading, base_keys, base, hull)
    notes = _notes(keys, base, hull, entries)
    method, keels = roll_method(entries["roll_damping"].value), _bilge_keels(where, keys, base, hull)
    if method != "fraction":
        notes["roll_damping"] = roll_damping_note(method, keels)
    given = {key: quantity(entry.value, "ratio", what=f"{where}: {key}") for key, entry in keys.coefficients.items()}
    return Ship(
        name=keys.name or (base.name if base else hull.name),
        hull=hull,
        loading=loading_of(where, hull, entries),
        overrides={**(base.overrides if base else {}), **checked_values(f"{where}: coefficients", given)},
        multipliers={
            **(base.multipliers if base else {}),
            **checked_values(f"{where}: multipliers", keys.multipliers),
        },
        linear=keys.linear or (base.linear if base else "default"),
        drag_coefficient=_drag(where, keys, base),
        velocity_scale=_velocity_scale(where, keys, base, hull),
        provenance=notes,
        measured=_measured(where, keys, base),
        autopilot=_autopilot(where, keys, base),
        rudder=_rudder(where, keys, base),
        righting=keys.righting or (base.righting if base else "polynomial"),
        velocities=keys.velocities or (base.velocities if base else "relative"),
        roll_method=method,
        bilge_keels=keels,
        database=database,
    )


def _ends(where: str, keys: ShipKeys, base: Ship | None, database: Database | None) -> Ends:
    """How the water at the ends is found: the file's own choice, or its base's."""
    chosen = keys.ends or (base.hull.ends if base else "strips")
    return checked_ends(where, chosen, None if database is None else database.name)


def _autopilot(where: str, keys: ShipKeys, base: Ship | None) -> Autopilot | None:
    """Autopilot of a ship: the file's own, or its base's."""
    own = keys.autopilot
    if own is None:
        return base.autopilot if base else None
    kinds: dict[str, Kind] = {"gain": "ratio", "rate_gain": "time", "lag": "time"}
    values = {key: quantity(getattr(own, key), kind, what=f"{where}: autopilot, {key}") for key, kind in kinds.items()}
    try:
        return Autopilot(**values)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def _rudder(where: str, keys: ShipKeys, base: Ship | None) -> Rudder | None:
    """Rudder of a ship: the file's own, or its base's in proportion to the side of the hull."""
    own = keys.rudder
    if own is None:
        return base.rudder if base else None
    area = quantity(own.area.value, "area", what=f"{where}: rudder, area")
    aspect = ASPECT if own.aspect is None else quantity(own.aspect.value, "ratio", what=f"{where}: rudder, aspect")
    try:
        return Rudder(area, aspect)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def _bilge_keels(where: str, keys: ShipKeys, base: Ship | None, hull: Hull) -> BilgeKeels | None:
    """Bilge keels in metres."""
    given = keys.bilge_keels
    if given is None:
        return base.bilge_keels if base else None
    sizes = {"length": hull.length, "beam": hull.beam, "draught": hull.draught}
    one, other = (
        quantity(value, "length", what=f"{where}: bilge_keels, {key}", **sizes)
        for key, value in (("length", given.length), ("breadth", given.breadth))
    )
    return checked_bilge_keels(where, hull.length, hull.beam, (one, other))


def _measured(where: str, keys: ShipKeys, base: Ship | None) -> str | MeasuredFile | None:
    """Measured set of a ship: a name, or a file seen from the folder of the ship file."""
    if keys.measured is None:
        return base.measured if base else None
    if keys.measured == "none":
        return None
    beside = Path(where).parent / keys.measured
    return measured_source(beside) if beside.is_file() else keys.measured


def _database(where: str, keys: ShipKeys, base: Ship | None) -> Database | None:
    """Own coefficients of a ship: a file seen from the folder of the ship file."""
    given = keys.database
    if given is None:
        return base.database if base else None
    if given.file == "none":
        return None
    return database_of(
        Path(where).parent / given.file,
        where,
        midship=given.midship,
        moments_about=given.moments_about,
        length=given.length,
    )


def _base(where: str, keys: ShipKeys) -> tuple[Ship | None, ShipKeys | None]:
    """Base ship of a file, and its keys."""
    if keys.base is None:
        return None, None
    names = [entry.name for entry in available_ships()]
    if keys.base not in names:
        raise InputError(f'{where}: base: "{keys.base}" is not a built-in ship; {_nearest(keys.base, names)}')
    return _built_in(keys.base), _keys(LIBRARY / f"{keys.base}.yaml")


def _notes(keys: ShipKeys, base: Ship | None, hull: Hull, entries: dict[str, Entry]) -> dict[str, str]:
    """Where each value of a ship comes from."""
    described = {**entries, **keys.coefficients}
    described |= {
        key: entry for key in ("drag_coefficient", "velocity_scale") if (entry := getattr(keys, key)) is not None
    }
    described |= {"rudder": keys.rudder.area} if keys.rudder else {}
    notes = {
        "lines": hull.source,
        "drag_coefficient": f"assumed: {DRAG_COEFFICIENT}; usual for ship sections in cross-flow",
        "velocity_scale": "assumed: the cross-flow model's own default",
        **(base.provenance if base else {}),
        **{key: f"{entry.status}: {entry.value}; {entry.source}" for key, entry in described.items()},
        "kg" if "gm" in entries else "gm": "derived: from KM of the lines",
    }
    if base is not None and (hull.length, hull.beam) != (base.hull.length, base.hull.beam):
        notes["dimensions"] = f"given: lines of {base.name} stretched to these dimensions"
    return {**notes, **keys.provenance}


def _drag(where: str, keys: ShipKeys, base: Ship | None) -> float:
    if keys.drag_coefficient is None:
        return base.drag_coefficient if base else DRAG_COEFFICIENT
    value = quantity(keys.drag_coefficient.value, "ratio", what=f"{where}: drag_coefficient")
    if value < 0:
        raise InputError(f"{where}: drag_coefficient = {value:g}; it is 0 or more; try {DRAG_COEFFICIENT}")
    return value


def _velocity_scale(where: str, keys: ShipKeys, base: Ship | None, hull: Hull) -> float | None:
    if keys.velocity_scale is None:
        return base.velocity_scale if base else None
    value = quantity(keys.velocity_scale.value, "speed", length=hull.length, what=f"{where}: velocity_scale")
    if value <= 0:
        raise InputError(f"{where}: velocity_scale = {value:g} m/s; it is above 0; try 0.03 Fn, or leave it out")
    return value

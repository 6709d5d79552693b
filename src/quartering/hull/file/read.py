"""Ship files: YAML with units, built in or one's own, read into a `Ship`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path
from typing import Any, cast

from quartering.conventions import InputError
from quartering.hull.changes import changed
from quartering.hull.file.built_in import LIBRARY, available_ships
from quartering.hull.file.lines import DIMENSIONS, dimension, hull_of
from quartering.hull.file.loading import LOADING, loading_entries, loading_of, user_entries
from quartering.hull.file.schema import Entry, Lines, ShipKeys, checked_keys, located
from quartering.hull.file.yaml_text import key_lines, parsed, read_text
from quartering.hull.option_types import Ends
from quartering.hull.roll_method import roll_damping_note
from quartering.hull.ship import Ship
from quartering.hull.user_database import Database, database_of
from quartering.hull.user_measured import MeasuredFile, measured_source
from quartering.option_checks import Option, Refused
from quartering.options import OPTIONS


def ship(name_or_path: str | Path) -> Ship:
    """Read a ship: a built-in one by name, or one's own from a YAML file.

    Parameters
    ----------
    name_or_path : str or Path    such as "series60-cb60", or the path of a ship file

    Returns
    -------
    Ship

    Raises
    ------
    InputError    no such ship or file, or something in the file that cannot be right, named by key

    Notes
    -----
    Source: each built-in ship names its own in ``provenance``.

    Examples
    --------
    >>> ship("series60-cb60").hull.length
    121.92
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
    return _assembled(str(path), *_read(path))


def _nearest(text: str, names: list[str]) -> str:
    """Nearest built-in name to a word, and all of them."""
    near = [name for name in names if name.startswith(text.lower())] or get_close_matches(
        text.lower(), names, cutoff=0.6
    )
    hint = f'; did you mean "{near[0]}"?' if near else ""
    return f"built-in ships are {', '.join(names)}{hint}"


@lru_cache(maxsize=32)
def _built_in(name: str) -> Ship:
    return _assembled(name, *_read(LIBRARY / f"{name}.yaml"))


def _keys(path: Path) -> ShipKeys:
    return _read(path)[0]


def _read(path: Path) -> tuple[ShipKeys, Lines]:
    text = read_text(path)
    content, lines = parsed(text, path), key_lines(text)
    return checked_keys(str(path), content, lines), lines


def _assembled(where: str, keys: ShipKeys, lines: Lines) -> Ship:
    """Ship from checked keys; a refused option is told with its line."""
    try:
        return _made(where, keys)
    except Refused as error:
        one = OPTIONS.get(error.option)
        path = (error.option,) if one is None else _path(one, lines)
        group = "".join(f"{key}, " for key in path[:-1])
        raise InputError(f"{located(where, lines, path)}: {group}{error.words}") from None


def _path(one: Option, lines: Lines) -> tuple[str, ...]:
    """Keys under which a file gives an option, which may be by an older word."""
    words = [(*one.path[:-1], key) for key in (one.path[-1], *one.also)]
    return next((path for path in words if path in lines), one.path)


def _made(where: str, keys: ShipKeys) -> Ship:
    """Ship from checked keys, on its base ship when it has one: its hull and loading, then every other option."""
    base, base_keys = _base(where, keys)
    hull = hull_of(where, keys, base.hull if base else None)
    if base is None:
        hull = replace(hull, ends=cast(Ends, OPTIONS["ends"].default))
    entries = loading_entries(user_entries(keys), base_keys, base, hull)
    loading = loading_of(where, hull, entries)
    start = Ship(hull.name, hull, loading) if base is None else replace(base, hull=hull, loading=loading, database=None)
    given = {
        name: entry.value for name, entry in keys.told.items() if name not in (*DIMENSIONS, *LOADING, "loading_case")
    }
    given |= {"values": {name: entry.value for name, entry in keys.coefficients.items()}, "factors": keys.factors}
    given |= {"measured": _measured(where, keys), "database": _database(where, keys, base)}
    given |= {"roll_damping": entries["roll_damping"].value}
    if keys.value("depth") is not None:
        given["depth"] = dimension(where, keys, "depth", hull.length, hull.beam, hull.design_draught)
    if keys.lines is not None or keys.offsets is not None:  # it acted while they were read
        datum = given.pop("datum", None)
        start = start if datum is None else replace(start, particulars={**start.particulars, "datum": datum})
    made = changed(start, given, where)
    made = replace(made, provenance={**_notes(keys, base, entries, made), **keys.provenance})
    return changed(made, {"loading_case": keys.value("loading_case")}, where)


def _measured(where: str, keys: ShipKeys) -> str | MeasuredFile | None:
    """Measured set of a ship: a name, or a file seen from the folder of the ship file."""
    if keys.measured is None or keys.measured == "none":
        return keys.measured
    beside = Path(where).parent / keys.measured
    return measured_source(beside if beside.is_file() else keys.measured)


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
        said=given.file,
    )


def _base(where: str, keys: ShipKeys) -> tuple[Ship | None, ShipKeys | None]:
    """Base ship of a file, and its keys."""
    if keys.base is None:
        return None, None
    names = [entry.name for entry in available_ships()]
    if keys.base not in names:
        raise InputError(f'{where}: base: "{keys.base}" is not a built-in ship; {_nearest(keys.base, names)}')
    return _built_in(keys.base), _keys(LIBRARY / f"{keys.base}.yaml")


def _notes(keys: ShipKeys, base: Ship | None, entries: dict[str, Entry], made: Ship) -> dict[str, str]:
    """Where each value of a ship comes from."""
    told = {key: entry for key, entry in keys.told.items() if key not in LOADING and _noted(key)}
    notes = {
        "lines": made.hull.source,
        "drag_coefficient": f"assumed: {OPTIONS['drag_coefficient'].default}; usual for ship sections in cross-flow",
        "velocity_scale": "assumed: the cross-flow model's own default",
        **(base.provenance if base else {}),
        **{
            key: f"{entry.status}: {_written(entry.value)}; {entry.source}"
            for key, entry in {**entries, **keys.coefficients, **told}.items()
        },
        "kg" if "gm" in entries else "gm": "derived: from KM of the lines",
    }
    if "roll_period" in keys.told:
        notes["gyradius_roll"] = made.provenance["gyradius_roll"]
    if made.damped_by_components:
        notes["roll_damping"] = roll_damping_note(made.roll_method, made.bilge_keels)
    if base is not None and (made.hull.length, made.hull.beam) != (base.hull.length, base.hull.beam):
        notes["dimensions"] = f"given: lines of {base.name} stretched to these dimensions"
    return notes


def _noted(name: str) -> bool:
    """Does a note of its source go with an option? Choices of method need none."""
    one = OPTIONS[name]
    return name not in ("name", "loadings", "loading_case", *DIMENSIONS) and one.kind not in ("word", "file")


def _written(value: Any) -> str:
    """A value as a note gives it."""
    return ", ".join(f"{key} {part}" for key, part in value.items()) if isinstance(value, Mapping) else str(value)

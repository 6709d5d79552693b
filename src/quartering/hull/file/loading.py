"""Loading of a ship file: own values, then those of the base ship, then defaults."""

from __future__ import annotations

import math
from collections.abc import Mapping

from quartering.conventions import InputError
from quartering.hull.changes import check_twice, sizes_of
from quartering.hull.file.schema import Entry, ShipKeys
from quartering.hull.lines.hull import Hull
from quartering.hull.loading import Loading, reloaded
from quartering.hull.ship import Ship
from quartering.option_checks import checked
from quartering.options import OPTIONS, options
from quartering.units import split_quantity

_USUAL = "usual value; nothing published was found"
LOADING = tuple(one.name for one in options(place="loading") if one.home)
"""Options a `Loading` is made of."""

_SOURCES = {
    "roll_damping": "fraction of critical, for viscosity and bilge keels",
    "water_density": "sea water",
    "gm": "usual for a cargo ship; nothing published was found",
}
_DEFAULTS = {
    name: Entry(value=OPTIONS[name].default, status="assumed", source=_SOURCES.get(name, _USUAL))
    for name in LOADING
    if OPTIONS[name].default is not None
}


def user_entries(keys: ShipKeys) -> dict[str, Entry]:
    """Loading values a file gives itself."""
    told = {name: keys.told[name] for name in (*LOADING, "roll_period") if name in keys.told}
    check_twice({name: entry.value for name, entry in told.items()}, "")
    return told


def loading_entries(
    own: Mapping[str, Entry], base_keys: ShipKeys | None, base: Ship | None, hull: Hull
) -> dict[str, Entry]:
    """Loading values of a file: its own, then those of its base (metres in proportion to the hull), then the usual.

    own: of the file, from `user_entries`
    base_keys, base: keys of the base ship, and that ship
    hull: of the file
    """
    entries = dict(_DEFAULTS)
    if base is not None and base_keys is not None:
        sizes = {"gyradius_roll": hull.beam / base.hull.beam, "gyradius_yaw": hull.length / base.hull.length}
        height = hull.design_draught / base.hull.design_draught
        entries = _over(entries, {
            key: _proportional(entry, sizes.get(key, height if key in ("gm", "kg") else 1.0))
            for key, entry in base_keys.told.items() if key in LOADING
        })  # fmt: skip
    return _over(
        entries,
        {
            key: entries[key] if key in entries and _unchanged(key, entry, entries[key], hull) else entry
            for key, entry in own.items()
            if key in LOADING
        },
    )


def _unchanged(key: str, own: Entry, base: Entry, hull: Hull) -> bool:
    """Does a file repeat the value of its base without a word on where it comes from? Then the base's word stands."""
    if not all(isinstance(entry.value, (int, float)) or entry.value[:1].isdigit() for entry in (own, base)):
        return False
    try:
        values = [checked(OPTIONS[key], entry.value, "", sizes_of(hull)) for entry in (own, base)]
    except InputError:
        return False  # refused with its own message where the loading is put together
    return own.status == "given" and math.isclose(*values, rel_tol=1e-8)


def _over(entries: dict[str, Entry], own: dict[str, Entry]) -> dict[str, Entry]:
    """Entries with some replaced; gm and kg replace one another."""
    dropped = {"gm", "kg"} if {"gm", "kg"} & own.keys() else set()
    return {**{key: entry for key, entry in entries.items() if key not in dropped}, **own}


def _proportional(entry: Entry, ratio: float) -> Entry:
    """Entry in metres of a ship scaled by a ratio; one in L, B or T, or at full size, is left as it is."""
    if ratio == 1.0:
        return entry  # a word, such as a method of roll damping, too
    number, unit = split_quantity(entry.value)
    if unit in ("L", "B", "T"):
        return entry
    return Entry(
        value=f"{number * ratio:.6g} {unit}".strip(), status="derived", source=f"{entry.source}; scaled with the hull"
    )


def loading_of(where: str, hull: Hull, entries: dict[str, Entry]) -> Loading:
    """Loading in SI, checked.

    where: file named in messages
    entries: from `loading_entries`
    """
    values = {name: checked(OPTIONS[name], entry.value, where, sizes_of(hull)) for name, entry in entries.items()}
    blank = Loading(gm=1.0, kg=0.0, gyradius_roll=1.0, gyradius_yaw=1.0, density=values.pop("water_density"))
    return reloaded(where, hull, blank, **values)

"""The loading of a ship file: its own values, then those of its base ship, then the usual ones."""

from __future__ import annotations

import math

from quartering.conventions import WATER_DENSITY, InputError
from quartering.hull.loading import ROLL_DAMPING, Loading, reloaded
from quartering.hull.offsets import Hull
from quartering.hull.schema import Entry, LoadingKeys, ShipKeys
from quartering.hull.ship import Ship
from quartering.hull.units import Kind, quantity, split_quantity

_DEFAULTS = {
    "gm": Entry(value="0.05 B", status="assumed", source="usual for a cargo ship; nothing published was found"),
    "gyradius_roll": Entry(value="0.35 B", status="assumed", source="usual value; nothing published was found"),
    "gyradius_yaw": Entry(value="0.25 L", status="assumed", source="usual value; nothing published was found"),
    "roll_damping": Entry(
        value=ROLL_DAMPING, status="assumed", source="fraction of critical, for viscosity and bilge keels"
    ),
    "water_density": Entry(value=WATER_DENSITY, status="assumed", source="sea water"),
}


def loading_entries(
    where: str, own: LoadingKeys, base_keys: ShipKeys | None, base: Ship | None, hull: Hull
) -> dict[str, Entry]:
    """Loading values of a file: its own, then those of its base (metres in proportion to the hull), then the usual.

    Parameters
    ----------
    where : str                       file named in messages
    own : LoadingKeys                 of the file
    base_keys, base : or None         keys of the base ship, and that ship
    hull : Hull                       of the file

    Returns
    -------
    dict of str to Entry

    Raises
    ------
    InputError                        both gm and kg

    Notes
    -----
    Source: the format of the ship file.
    """
    if own.gm is not None and own.kg is not None:
        raise InputError(f"{where}: gm and kg are both given; one follows from the other (kg = KM - gm), leave one out")
    entries = dict(_DEFAULTS)
    if base is not None and base_keys is not None:
        sizes = {"gyradius_roll": hull.beam / base.hull.beam, "gyradius_yaw": hull.length / base.hull.length}
        height = hull.design_draught / base.hull.design_draught
        entries = _over(entries, {
            key: _proportional(entry, sizes.get(key, height if key in ("gm", "kg") else 1.0))
            for key, entry in base_keys.loading if entry is not None
        })  # fmt: skip
    return _over(
        entries,
        {
            key: entries[key] if key in entries and _unchanged(key, entry, entries[key], hull) else entry
            for key, entry in own
            if entry is not None
        },
    )


def _unchanged(key: str, own: Entry, base: Entry, hull: Hull) -> bool:
    """Does a file repeat the value of its base without a word on where it comes from? Then the base's word stands."""
    kind: Kind = {"water_density": "density", "roll_damping": "ratio"}.get(key, "length")  # type: ignore[assignment]
    sizes = {"length": hull.length, "beam": hull.beam, "draught": hull.draught}
    try:
        values = [quantity(entry.value, kind, what=key, **sizes) for entry in (own, base)]
    except InputError:
        return False  # refused with its own message where the loading is put together
    return own.status == "given" and math.isclose(*values, rel_tol=1e-8)


def _over(entries: dict[str, Entry], own: dict[str, Entry]) -> dict[str, Entry]:
    """Entries with some replaced; gm and kg replace one another."""
    dropped = {"gm", "kg"} if {"gm", "kg"} & own.keys() else set()
    return {**{key: entry for key, entry in entries.items() if key not in dropped}, **own}


def _proportional(entry: Entry, ratio: float) -> Entry:
    """Entry in metres of a ship scaled by a ratio; one in L, B or T, or at full size, is left as it is."""
    number, unit = split_quantity(entry.value)
    if ratio == 1.0 or unit in ("L", "B", "T"):
        return entry
    return Entry(
        value=f"{number * ratio:.6g} {unit}".strip(), status="derived", source=f"{entry.source}; scaled with the hull"
    )


def loading_of(where: str, hull: Hull, entries: dict[str, Entry]) -> Loading:
    """Loading in SI, checked.

    Parameters
    ----------
    where : str          file named in messages
    hull : Hull
    entries : mapping    from `loading_entries`

    Returns
    -------
    Loading

    Raises
    ------
    InputError           a value or unit that cannot be, what `reloaded` refuses

    Notes
    -----
    Source: the format of the ship file.
    """
    sizes = {"length": hull.length, "beam": hull.beam, "draught": hull.draught}
    lengths = {
        key: quantity(entries[key].value, "length", what=f"{where}: loading, {key}", **sizes)
        for key in ("gm", "kg", "gyradius_roll", "gyradius_yaw")
        if key in entries
    }
    density = quantity(entries["water_density"].value, "density", what=f"{where}: loading, water_density")
    if density <= 0:
        raise InputError(f"{where}: loading, water_density = {density:g} kg/m3; it is above 0; try 1025")
    blank = Loading(gm=1.0, kg=0.0, gyradius_roll=1.0, gyradius_yaw=1.0, density=density)
    return reloaded(f"{where}: loading", hull, blank, roll_damping=entries["roll_damping"].value, **lengths)

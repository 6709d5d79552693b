"""What a ship is, in rows of a table: hydrostatics, loading, and what else it was told."""

from __future__ import annotations

from collections.abc import Mapping

from quartering.conventions import SYMBOLS, in_unit, written
from quartering.hull.ship import Ship
from quartering.hydro.decay.free_roll import free_damping, total_words
from quartering.options import OPTIONS, parts

HYDROSTATICS = {
    "volume": ("displaced volume", "m3"), "displacement": ("displacement", "t"),
    "lcb": ("centre of buoyancy from midship, + forward", "m"), "lcb_from_ap": ("LCB from AP, + forward", "m"),
    "lcf": ("centre of flotation from midship, + forward", "m"), "lcf_from_ap": ("LCF from AP, + forward", "m"),
    "kb": ("KB", "m"), "bm": ("BM", "m"), "km": ("KM", "m"), "kg": ("KG", "m"), "gm": ("GM", "m"),
    "cb": ("block coefficient CB", "-"), "cm": ("midship coefficient CM", "-"), "cp": ("prismatic coefficient CP", "-"),
    "cw": ("waterplane coefficient CW", "-"), "waterplane_area": ("waterplane area", "m2"),
    "wetted_surface": ("wetted surface", "m2"), "bml": ("longitudinal BM", "m"), "gml": ("longitudinal GM", "m"),
    "tpc": ("tonnes per centimetre TPC", "t/cm"), "mct": ("moment to trim one centimetre MCT", "t m/cm"),
}  # fmt: skip
"""Attribute of the hydrostatics -> what it is, and its unit."""

LOADING = (
    *((key, written(key), SYMBOLS[key].unit) for key in ("gm", "kg", "gyradius_roll", "gyradius_yaw")),
    ("roll_damping", f"{written('roll_damping')}, of critical", "-"),
)  # fmt: skip
"""Attribute of the loading, what it is, and its unit."""


def loading_rows(one: Ship) -> list[tuple[str, str, str, str]]:
    """Each value of the loading: what it is, how much, its unit, where it comes from."""
    value = {"roll_damping": "by components"} if one.damped_by_components else {}
    rows = [
        (words, value.get(key, f"{getattr(one.loading, key):.5g}"), unit, one.provenance.get(key, "given"))
        for key, words, unit in LOADING
    ]
    roll = free_damping(one)
    return [
        *rows,
        ("roll damping in all, of critical", f"{roll.ratio:.4g}", "-", f"derived: {total_words(one, roll, 0.0)}"),
    ]


def particular_rows(one: Ship) -> list[tuple[str, str, str, str]]:
    """Each further thing the ship was told: what it is, its value, its unit, where it comes from."""
    rows = []
    for name, value in one.particulars.items():
        of = OPTIONS[name]
        if isinstance(value, Mapping) and of.kind == "group":
            units = {key: part.unit for key, part in parts(name).items()}
            text = ", ".join(f"{key} {number:.5g}{in_unit(units[key])}" for key, number in value.items())
        else:
            text = (
                ", ".join(map(str, value))
                if isinstance(value, Mapping)
                else f"{value:.5g}"
                if of.numeric
                else str(value)
            )
        rows.append((of.text, text, of.unit or "-", one.provenance.get(name, "given")))
    return rows

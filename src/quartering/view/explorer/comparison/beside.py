"""What a page compares with: another ship or loading, its map over the same waves, and what differs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple
from urllib.parse import parse_qsl, urlencode

import xarray as xr

from quartering.conventions import InputError, in_unit
from quartering.hull.ship import Ship
from quartering.options import OPTIONS
from quartering.study.loadings import user_value
from quartering.study.maps.compare import map_difference
from quartering.view.explorer.computing.computations import Scene, scene
from quartering.view.explorer.hulls.ship_registry import Known, ShipRegistry
from quartering.view.explorer.state import LOADING, State
from quartering.view.map_summary import summary_of
from quartering.view.side_by_side import alike, comparison_rows, told_apart, warned
from quartering.view.wording import notes, wave_words

_CASE = "loading_case"
_MOST_WORDS = 2
"""Values of a loading by which two of one ship are told apart; more are called kept and shown."""


class Kept(NamedTuple):
    """The ship and loading a page compares with.

    Parameters
    ----------
    known : Known     as the server knows it, in its own loading
    ship : Ship       loaded as it is kept
    case : str        named loading case it has, or ""
    """

    known: Known
    ship: Ship
    case: str


class Compared(NamedTuple):
    """Two maps side by side: `ds` of `map_difference`, the second less the first, and what is told of them."""

    ds: xr.Dataset
    labels: list[str]
    rows: list[tuple[str, str, str, str]]
    said: list[str]
    length: float
    title: str


def link_of(state: State) -> str:
    """Ship and loading of a page, as the part of a link that keeps them."""
    return State(ship=state.ship, **{name: getattr(state, name) for name in LOADING}).query()


def offered(state: State, known: Known, registry: ShipRegistry) -> dict[str, str]:
    """What a page may be compared with: link -> words."""
    made = {"": "choose a ship or a loading"}
    cases = tuple(known.ship.value("loadings") or ())
    made |= {urlencode({"ship": state.ship, _CASE: case}): f"{known.label}, {case}" for case in cases}
    made[urlencode({"ship": state.ship})] = f"{known.label}, its own loading"
    made |= {urlencode({"ship": key}): label for key, label in registry.options().items() if key != state.ship}
    if state.beside and state.beside not in made:
        made[state.beside] = _kept_words(state.beside, known)
    return made


def _kept_words(link: str, known: Known) -> str:
    """A loading that was kept, in a few words."""
    parts = dict(parse_qsl(link))
    name = parts.pop("ship", "?")[:60]
    label = known.label if name == known.key else name
    values = ", ".join(f"{_word(key)} {value[:12]}" for key, value in list(parts.items())[:4])
    return f"kept: {label}, {values}" if values else label


def kept(link: str, registry: ShipRegistry) -> Kept:
    """The ship and loading of a link.

    Raises
    ------
    InputError    a link that holds something else, a ship this server does not know, a loading no ship has
    """
    parts = dict(parse_qsl(link))
    case = parts.pop(_CASE, "")
    strange = [name for name in parts if name not in ("ship", *LOADING)]
    if strange or "ship" not in parts:
        what = f"not {', '.join(strange)[:80]}" if strange else "and the ship is missing"
        raise InputError(f"what is compared with is a ship and its loading, {what}; choose one again")
    state = State.of_query(parts)
    known = registry.known(state.ship)
    own = known.ship.with_(loading_case=case) if case else known.ship
    return Kept(known, scene(state, replace(known, ship=own)).ship, case)


def same(of: Scene, other: Kept) -> bool:
    """Is what is kept what the page shows?"""
    return alike(of.ship, other.ship)


def compared(of: Scene, other: Kept, maps: Sequence[xr.Dataset]) -> Compared:
    """The page less what is kept; maps: of what is kept, of the page."""
    ships = (other.ship, of.ship)
    labels, one_name = _labels(of, other)
    ds = map_difference(maps, labels)
    summaries = [[summary_of(who, m.isel(speed=0))] for who, m in zip(ships, maps, strict=True)]
    said = warned(ships, labels, same_name=one_name, measured_by=1)
    title = f"{labels[1]} less {labels[0]}: largest roll in regular waves, {wave_words(maps[0])}"
    about = [f"{label}: {' '.join(notes(m))}" for label, m in zip(labels, maps, strict=True)]
    return Compared(ds, labels, comparison_rows(ships, maps, summaries), [*said, *about], of.ship.hull.length, title)


def _labels(of: Scene, other: Kept) -> tuple[list[str], bool]:
    """What the two are called, and whether two ships have one name."""
    one, two = other.ship, of.ship
    if one.name != two.name:
        return [one.name, two.name], False
    if other.known.key != of.known.key:
        return told_apart((one, two), (other.known.label, of.known.label)), True
    if other.case:
        return [f"{one.name}, {other.case}", f"{two.name}, as shown"], False
    apart = [name for name in LOADING if not math.isclose(_value(one, name), _value(two, name), rel_tol=1e-9)]
    if not 0 < len(apart) <= _MOST_WORDS:
        return told_apart((one, two), ("as kept", "as shown")), False
    return [f"{ship.name}, {', '.join(_valued(ship, name) for name in apart)}" for ship in (one, two)], False


def _value(ship: Ship, name: str) -> float:
    """A value of a loading; -1 where it is a word."""
    try:
        return user_value(ship, name)
    except (TypeError, ValueError):
        return -1.0


def _valued(ship: Ship, name: str) -> str:
    value = _value(ship, name)
    told = f"{value:.4g}{in_unit(OPTIONS[name].unit)}" if value >= 0 else str(ship.value(name))
    return f"{_word(name)} {told}"


def _word(name: str) -> str:
    """What a value of a loading is called."""
    label = OPTIONS[name].label if name in OPTIONS else ""
    return label or name.replace("_", " ")[:40]

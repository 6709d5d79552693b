"""The case file of a study: a ship, the values of every axis with their units, checked line by line."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ValidationError

from quartering.arguments import ARGUMENTS
from quartering.conventions import InputError
from quartering.hull.changes import COEFFICIENTS, changed
from quartering.hull.file.read import ship
from quartering.hull.file.refusals import allowed, nearest_word, user_words
from quartering.hull.file.yaml_text import key_lines, parsed, read_text
from quartering.hull.ship import Ship
from quartering.loads.sea.sea import Sea
from quartering.names import checked_values
from quartering.option_checks import Option, Refused, quoted
from quartering.options import OPTIONS
from quartering.study.case.keys import Case, LoadingAxes, SeaAxes, SwellKeys, Values
from quartering.study.case.values import values_of
from quartering.study.grid import CONDITION_AXES, SEA_AXES, STEEPNESS, Grid, axis, grid
from quartering.study.loadings import CHOICE_AXES
from quartering.study.seas.over_seas.grid import sea_grid
from quartering.study.seas.over_seas.settings import SeaSettings
from quartering.study.six_modes.grid import in_six_modes


@dataclass(frozen=True)
class _Place:
    """Where in a file a value stands, for messages."""

    name: str
    lines: Mapping[tuple[str, ...], int]

    def says(self, path: tuple[str, ...], text: str) -> InputError:
        line = next((self.lines[path[:n]] for n in range(len(path), -1, -1) if path[:n] in self.lines), 1)
        return InputError(f"{self.name}, line {line}: {text}")


def case_grid(path: str | Path) -> Grid:
    """The grid of conditions a case file describes, its text kept for the record.

    L, B and T stand for the ship's own length, beam and draught.  Source: the format of the case file.
    """
    case, place, text = _read(path)
    own = _ship(case, Path(path), place)
    axes = {
        name: _values(place, (name,), given, OPTIONS[name], own)
        for name in (*CONDITION_AXES, "wave_period", STEEPNESS)
        if (given := getattr(case, name)) is not None
    }
    loading = {
        name: _values(place, ("loading", name), value, OPTIONS[name], own)
        for name, value in case.loading
        if value is not None
    }
    factors, values = (
        {name: _values(place, (key, name), given, _COEFFICIENT, own) for name, given in getattr(case, key).items()}
        for key in ("factors", "values")
    )
    for key, columns in (("factors", factors), ("values", values)):
        for name, column in columns.items():
            try:
                checked_values(own.name, {name: float(column[0])})
            except InputError as error:
                raise place.says((key, name), str(error)) from None
    asked: dict[str, Any] = {**axes, "form": case.form, "factors": factors, "values": values, **loading}
    sea = None if case.sea is None else _sea(case, own, place, asked)
    try:
        made = grid(own, **asked, harmonics=case.harmonics) if sea is None else _seas(own, asked | sea)
        if case.modes == "six":
            made = in_six_modes(made)
    except InputError as error:
        raise place.says(_blamed(str(error), place), str(error)) from None
    return replace(made, text=text)


def _sea(case: Case, own: Ship, place: _Place, given: Mapping[str, Any]) -> dict[str, Any]:
    """What a case says of its irregular seas, as `sea_grid` takes it."""
    for name in (*CONDITION_AXES[2:], "wave_period", STEEPNESS):
        if name in given:
            raise place.says(
                (name,), f"{name} is of regular waves and sea of irregular ones; leave out the one or the other"
            )
    if case.harmonics != 1:
        raise place.says(("harmonics",), "harmonics are of motions in regular waves; leave them out beside sea")
    if case.modes == "six":
        raise place.says(("modes",), "six modes are of regular waves in a study; leave modes or sea out")
    sea = dict(case.sea or ())
    for name in SEA_AXES:
        if sea[name] is not None:
            sea[name] = _values(place, ("sea", name), sea[name], ARGUMENTS[name], own)
    sea["swell"] = _swell(case.sea, place)
    return sea | {"spreading": None if sea["spreading"] == "none" else sea["spreading"]}


def _swell(of: SeaAxes | None, place: _Place) -> Sea | None:
    """The swell a case puts beside its seas."""
    if of is None or of.swell is None:
        return None
    told = dict(of.swell)
    try:
        return Sea(**told | {"spreading": None if told["spreading"] == "none" else told["spreading"]})
    except InputError as error:
        raise place.says(("sea", "swell"), f"swell: {error}") from None


def _seas(own: Ship, given: dict[str, Any]) -> Grid:
    """The grid of a case in irregular seas."""
    told = {one.name: given.pop(one.name) for one in fields(SeaSettings)}
    return sea_grid(own, **given, settings=SeaSettings(**told))


_GROUPS: Final[Mapping[str, type[BaseModel]]] = {"loading": LoadingAxes, "sea": SeaAxes}
_COEFFICIENT = Option("coefficient", "ratio", "factor on a coefficient, or its value")


def case_schema() -> str:
    """JSON schema of the case file, as shipped for editors."""
    return json.dumps(Case.model_json_schema(), indent=1, sort_keys=True) + "\n"


def _read(path: str | Path) -> tuple[Case, _Place, str]:
    text = read_text(Path(path))
    content = parsed(text, Path(path))
    place = _Place(str(path), key_lines(text))
    if not isinstance(content, dict):
        raise place.says((), f"a case is a list of keys with values: {', '.join(_keys(Case))}")
    if "ship" not in content and ("base" in content or "lines" in content):
        raise place.says(
            (), f"this is a ship file; a case names it: `ship: {Path(path).name}`; `quartering new --case` writes one"
        )
    try:
        return Case.model_validate(content), place, text
    except ValidationError as error:
        raise _refusal(error, place, content) from None


def _refusal(error: ValidationError, place: _Place, content: dict[str, Any]) -> InputError:
    """The first thing that is wrong, in words."""
    problem = min(
        error.errors(), key=lambda one: one["type"] != "extra_forbidden"
    )  # a misspelt key, before a missing one
    path = tuple(str(part) for part in problem["loc"])
    keys: tuple[str, ...] = tuple(
        part
        for part in path
        if part in _allowed_everywhere()
        or part in content
        or any(part in (content.get(group) or {}) for group in _GROUPS)
    )
    if path == ("coefficients",):
        raise place.says(path, COEFFICIENTS)
    if problem["type"] == "extra_forbidden":
        known = _keys(SwellKeys if path[:2] == ("sea", "swell") else _GROUPS.get(path[0], Case))
        nearest = get_close_matches(path[-1], known, n=1, cutoff=0.0)[0]
        return place.says(path, f"{path[-1]} is unknown; did you mean {nearest}? Keys allowed here: {', '.join(known)}")
    if problem["type"] == "missing":
        return place.says(path[:-1], f"key `{path[-1]}` is missing; write it like the one of `quartering new`")
    if problem["type"] == "literal_error":
        return place.says(keys, f"{path[-1]}: {quoted(problem['input'])} is given; {nearest_word(problem)}")
    key, own = ", ".join(keys) or "case", user_words(problem)
    if own is not None:
        return place.says(keys, f"{key}: {quoted(problem['input'])} is given; {own}")
    return place.says(keys, f"{key}: {quoted(problem['input'])} is given; allowed: {allowed(problem)}")


def _keys(of: type[BaseModel]) -> list[str]:
    return [field.alias or name for name, field in of.model_fields.items()]


def _allowed_everywhere() -> set[str]:
    groups: tuple[type[BaseModel], ...] = (*_GROUPS.values(), SwellKeys)
    return {*_keys(Case), *(key for group in groups for key in _keys(group))}


def _values(place: _Place, path: tuple[str, ...], given: Values, one: Option, own: Ship) -> NDArray[np.float64]:
    """Values of one axis in SI, degrees or 1."""
    try:
        return axis(one.name, given) if one.name in CHOICE_AXES else np.array(values_of(one, given, own))
    except InputError as error:
        raise place.says(path, str(error)) from None


def _ship(case: Case, path: Path, place: _Place) -> Ship:
    """The ship a case names, with the options it changes."""
    name = case.ship
    beside = path.parent / name
    try:
        own = ship(beside if beside.suffix in (".yaml", ".yml") and beside.exists() else name)
    except InputError as error:
        raise place.says(("ship",), str(error)) from None
    try:
        return changed(own, case.changes)
    except Refused as error:
        raise place.says(("with", error.option), f"with, {error.words}") from None
    except InputError as error:
        raise place.says(("with",), str(error)) from None


def _blamed(message: str, place: _Place) -> tuple[str, ...]:
    """Key of the file a message of another room is about."""
    if "bilge_keels" in message:  # what a ship calls the two sizes
        return ("loading", "bilge_keel_length")
    for path in sorted(place.lines, key=len, reverse=True):
        if path[-1] in message:
            return path
    words = {"wave_height": ("steep", "height"), "wave_length": ("length",)}
    return next(((key,) for key, hints in words.items() if any(hint in message for hint in hints)), ())

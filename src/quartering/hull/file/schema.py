"""Schema of the ship file, with its error messages."""

from __future__ import annotations

import json
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, WithJsonSchema

from quartering.conventions import InputError
from quartering.hull.file.refusals import allowed, nearest_word, user_words
from quartering.option_checks import Option, quoted
from quartering.options import line_of, no_coefficients, options, parts

Lines = Mapping[tuple[str, ...], int]
"""Keys of a file, the outermost first -> the line they stand on."""


def _entry(given: Any) -> Any:
    return given if isinstance(given, (dict, Entry)) else {"value": given}


class _Strict(BaseModel):
    model_config: ClassVar[ConfigDict] = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False, defer_build=True)


class Entry(_Strict):
    """A value, with whether it is published, derived, assumed or given, and its source."""

    value: Any
    status: Literal["published", "derived", "assumed", "given"] = "given"
    source: str = "this file"


_NUMBER = WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string"}], "title": "Value"})


class _Number(Entry):
    value: Annotated[Any, _NUMBER]  # checked by its option, in the words of every door


Given = Annotated[_Number, BeforeValidator(_entry)]


class StationKeys(_Strict):
    """One station: x from midship, + forward; half breadths at its own heights or at the common waterlines."""

    x: float
    half_breadths: list[float | None] = Field(min_length=2)
    heights: list[float] | None = None
    station: str | float | None = None


class OffsetKeys(_Strict):
    """`offsets:` unit "m", or "LBT" (x in L, half breadths in B/2, heights in T), and the stations."""

    unit: Literal["m", "LBT"]
    outline: Literal["smooth", "straight"] = "smooth"
    waterlines: list[float] | None = None
    stations: list[StationKeys] = Field(min_length=4)


class LinesKeys(_Strict):
    """`lines:` a file of another program, its format where the ending does not tell, its unit, and x of midship in it [m]."""

    file: str
    format: Literal["csv", "pdstrip", "gdf", "stl"] | None = None
    unit: Literal["m", "mm", "cm", "ft"] | None = None
    midship: float = 0.0
    outline: Literal["smooth", "straight"] = "straight"


class DatabaseKeys(_Strict):
    """`database:` a Capytaine netCDF or WAMIT's .1; midship and the point of the moments in its axes, ULEN of WAMIT [m]."""

    file: str
    midship: float = 0.0
    moments_about: tuple[float, float] | None = None
    length: float = 1.0


def _lines(given: Any) -> Any:
    return {"file": given} if isinstance(given, str) else given


class ShipKeys(_Strict):
    """A ship file: its lines as they are written, and what else it tells, by option.

    `told` holds every option of `quartering.options` the file gives a value of, groups as mappings.
    """

    description: str | None = None
    base: str | None = None
    shape: Literal["offsets", "wigley", "box"] | None = None
    offsets: OffsetKeys | None = None
    lines: Annotated[LinesKeys, BeforeValidator(_lines)] | None = None
    coefficients: dict[str, Given] = {}
    factors: dict[str, Any] = {}
    measured: str | None = None
    database: Annotated[DatabaseKeys, BeforeValidator(_lines)] | None = None
    provenance: dict[str, str] = {}
    told: dict[str, Entry] = {}

    def value(self, name: str) -> Any:
        """What the file gives for an option; None where it gives nothing."""
        entry = self.told.get(name)
        return None if entry is None else entry.value


_OWN_KEYS = ("measured", "database")
"""Options whose content has a form of its own."""
_GROUPS: dict[str, type[_Strict]] = {
    "offsets": OffsetKeys,
    "stations": StationKeys,
    "lines": LinesKeys,
    "database": DatabaseKeys,
}


def file_keys() -> list[str]:
    """Keys at the top of a ship file."""
    own = [one.path[-1] for one in options(place="ship", group="")]
    return ["base", "shape", "lines", "offsets", *own, "loading", "provenance", "description"]


def loading_keys() -> list[str]:
    """Keys of `loading:`."""
    return [one.path[-1] for one in options(place="loading") if one.path[0] == "loading"]


def checked_keys(where: str, data: Any, lines: Lines | None = None) -> ShipKeys:
    """The content of a ship file with its keys and types checked.

    where: file named in the message
    data: what the YAML holds
    lines: the line of each key, for messages

    >>> checked_keys("my.yaml", {"base": "box", "length": "120 m"}).value("length")
    '120 m'
    """
    if not isinstance(data, dict):
        raise InputError(f"{where}: a ship file is a list of keys with values; start from `base: series60-cb60`")
    lines = lines or {}
    data, told = _parted(where, data, lines)
    try:
        return ShipKeys.model_validate({**data, "told": told})
    except ValidationError as error:
        problems = error.errors()
        more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        place = located(where, lines, tuple(str(part) for part in problems[0]["loc"] if part != "told"))
        raise InputError(f"{place}: {_sentence(problems[0], data)}{more}") from None


def located(where: str, lines: Lines, path: tuple[str, ...]) -> str:
    """File and line of a key, or of the innermost one around it that is known."""
    line = next((lines[path[:n]] for n in range(len(path), 0, -1) if path[:n] in lines), None)
    return where if line is None else f"{where}, line {line}"


def _parted(where: str, data: dict[str, Any], lines: Lines) -> tuple[dict[str, Any], dict[str, Any]]:
    """The keys that describe lines, and the values of options by name."""
    rest, told = dict(data), dict[str, Any]()
    loading = rest.pop("loading", {})
    if not isinstance(loading, dict):
        raise InputError(
            f"{located(where, lines, ('loading',))}: loading: {quoted(loading)} is given; allowed: a group of keys: "
            f"{', '.join(loading_keys())}"
        )
    for group, keys in ((loading, loading_keys()), (rest, file_keys())):
        for key in group:
            if key not in keys and key not in _ALSO:
                path = ("loading", key) if group is loading else (str(key),)
                raise InputError(f"{located(where, lines, path)}: {_unknown(', '.join(map(str, path)), keys)}")
    for one in options(group=""):
        if one.place == "condition" or one.name in _OWN_KEYS:
            continue
        home = loading if one.place == "loading" else rest
        found = [key for key in (one.path[-1], *one.also) if key in home]
        if len(found) > 1:
            place = located(where, lines, (found[1],))
            raise InputError(f"{place}: `{found[0]}` and `{found[1]}` are one thing; leave one out")
        if not found or (value := home.pop(found[0])) is None:
            continue
        if one.kind == "coefficients":
            if not isinstance(value, dict):
                raise InputError(f"{located(where, lines, (found[0],))}: {no_coefficients(one.name, value).words}")
            rest[one.path[-1]] = value
        else:
            told[one.name] = _told(one, value)
    return rest, told


_ALSO = {key for one in options() for key in one.also}


def _told(one: Option, value: Any) -> Any:
    """A value with what is said of it; in a group the first part that says something speaks for all."""
    if one.kind == "group" and isinstance(value, dict) and "value" not in value:
        said = next((part for part in value.values() if isinstance(part, dict)), {})
        plain = {
            key: part["value"] if isinstance(part, dict) and "value" in part else part for key, part in value.items()
        }
        return {**said, "value": plain}
    return {"value": value} if one.kind in ("group", "table") or not isinstance(value, dict) else value


def _unknown(key: str, allowed: list[str]) -> str:
    near = get_close_matches(key.rpartition(", ")[2], allowed, n=1, cutoff=0.5)
    hint = f"did you mean {near[0]}? Keys" if near else "keys"
    return f"{key} is unknown; {hint} allowed here: {', '.join(allowed)}"


def _names_lines(key: str, problem: Any) -> bool:
    """Is the name of a file given for offsets?"""
    return key == "offsets" and isinstance(problem["input"], str) and "." in problem["input"]


def _sentence(problem: Any, data: dict[str, Any]) -> str:
    """One problem in words."""
    location = [part for part in problem["loc"] if not (isinstance(part, str) and "[" in part)]
    key, given = _path(location, data), quoted(problem["input"])
    kind, own = problem["type"], user_words(problem)
    if kind == "extra_forbidden":
        return _unknown(key, _keys_at(location))
    if kind == "missing":
        return f"key `{key}` is missing; keys allowed here: {', '.join(_keys_at(location))}"
    if own is not None:
        return f"{key}{own}" if own.startswith(":") else f"{key}: {own}"
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        hint = f"; a file of lines stands under `lines: {problem['input']}`" if _names_lines(key, problem) else ""
        return f"{key}: {given} is given; allowed: a group of keys: {', '.join(_keys_at([*location, '']))}{hint}"
    if kind == "literal_error":
        return f"{key}: {given} is given; {nearest_word(problem)}"
    return f"{key}: {given} is given; allowed: {allowed(problem)}"


def _path(location: list[Any], data: dict[str, Any]) -> str:
    """Key path in words: `offsets, station 3 (x = 0.45), half_breadths 4`."""
    names = {"stations": "station", "half_breadths": "half_breadths, waterline", "heights": "heights, waterline"}
    words: list[str] = []
    here: Any = data
    for part in location:
        if part == "told":
            continue
        here = _step(here, part)
        if isinstance(part, int):
            x = f" (x = {here['x']})" if isinstance(here, dict) and "x" in here else ""
            words[-1] = f"{names.get(words[-1], words[-1])} {part + 1}{x}"
        elif part != "value" or not words:
            words.append(str(part))
    return ", ".join(words)


def _step(here: Any, part: Any) -> Any:
    try:
        return here[part]
    except (KeyError, IndexError, TypeError):
        return None


def _keys_at(location: list[Any]) -> list[str]:
    """Keys allowed beside the last part of a location."""
    parents = [part for part in location[:-1] if isinstance(part, str) and part != "told"]
    if not parents:
        return file_keys()
    model: type[_Strict] = _GROUPS.get(parents[-1], Entry)
    return list(model.model_fields)


def ship_schema() -> str:
    """JSON schema of the ship file, as shipped for editors."""
    schema = ShipKeys.model_json_schema()
    properties = {key: value for key, value in schema["properties"].items() if key != "told"}
    loading: dict[str, Any] = {}
    for one in options(group=""):
        if one.place == "condition" or one.name in (*_OWN_KEYS, "values"):
            continue
        (loading if one.place == "loading" else properties).update(
            dict.fromkeys((one.path[-1], *one.also), _schema_of(one))
        )
    properties["loading"] = {
        "type": "object", "properties": loading, "additionalProperties": False, "description": "how the ship is loaded"
    }  # fmt: skip
    return json.dumps({**schema, "properties": properties}, indent=1, sort_keys=True) + "\n"


def _schema_of(one: Option) -> dict[str, Any]:
    """JSON schema of one option."""
    about = {"description": line_of(one)}
    if one.kind == "group":
        inner = {key: _schema_of(part) for key, part in parts(one.name).items()}
        return about | {"type": "object", "properties": inner, "additionalProperties": False}
    if one.kind in ("coefficients", "table"):
        return about | {"type": "object"}
    if one.kind == "word":
        return about | {"enum": list(one.words or ())}
    if not one.numeric:
        return about | {"type": "string"}
    limits: dict[str, Any] = {"type": "number"}
    if isinstance(one.low, (int, float)):
        limits["exclusiveMinimum" if one.above else "minimum"] = one.low
    if isinstance(one.high, (int, float)):
        limits["maximum"] = one.high
    return about | {"anyOf": [limits, {"type": "string"}, {"$ref": "#/$defs/_Number"}]}

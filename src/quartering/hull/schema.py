"""The keys a ship file may have, and what is said when one is wrong."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from quartering.conventions import InputError
from quartering.hull.choices import Ends, Linear, Righting, Sections, Velocities
from quartering.hull.refusals import allowed, nearest_word, own_words
from quartering.hull.roll_method import roll_method
from quartering.hull.units import split_quantity

_LONGEST_QUOTE = 60


def _value(given: Any) -> Any:
    split_quantity(given, "")  # raises when it is not a number, with or without a unit
    return given


def _entry(given: Any) -> Any:
    return given if isinstance(given, (dict, Entry)) else {"value": given}


def _damping(given: Any) -> Any:
    return given if roll_method(given) != "fraction" else _value(given)


Value = Annotated[float | str, BeforeValidator(_value)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Entry(_Strict):
    """A value, with whether it is published, derived, assumed or given, and its source."""

    value: Value
    status: Literal["published", "derived", "assumed", "given"] = "given"
    source: str = "this file"


Given = Annotated[Entry, BeforeValidator(_entry)]


class DampingEntry(Entry):
    """A roll damping: a fraction of critical, or the name of a method."""

    value: Annotated[float | str, BeforeValidator(_damping)]


class LoadingKeys(_Strict):
    """`loading:` gm or kg [m], gyradius_roll and gyradius_yaw [m], roll_damping [of critical], water_density [kg/m3]."""

    gm: Given | None = None
    kg: Given | None = None
    gyradius_roll: Given | None = None
    gyradius_yaw: Given | None = None
    roll_damping: Annotated[DampingEntry, BeforeValidator(_entry)] | None = None
    water_density: Given | None = None


class BilgeKeelKeys(_Strict):
    """`bilge_keels:` length and breadth of one of the pair [m]."""

    length: Value
    breadth: Value


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
    """`lines:` a file of another program, its format where the ending does not tell, and x of midship in it [m]."""

    file: str
    format: Literal["csv", "pdstrip", "gdf", "stl"] | None = None
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


class AutopilotKeys(_Strict):
    """`autopilot:` gain, rudder angle per angle off course [1]; rate_gain, per rate of turn [s]; lag of the gear [s]."""

    gain: Value
    rate_gain: Value = 0.0
    lag: Value = 0.0


class RudderKeys(_Strict):
    """`rudder:` area of the blade [m2] and its aspect ratio, height over chord [1]."""

    area: Given
    aspect: Given | None = None


class ShipKeys(_Strict):
    """A ship file."""

    name: str | None = None
    description: str | None = None
    base: str | None = None
    shape: Literal["offsets", "wigley", "box"] | None = None
    length: Value | None = None
    beam: Value | None = None
    draught: Value | None = None
    design_draught: Value | None = None
    depth: Value | None = None
    offsets: OffsetKeys | None = None
    lines: Annotated[LinesKeys, BeforeValidator(_lines)] | None = None
    loading: LoadingKeys = LoadingKeys()
    coefficients: dict[str, Given] = {}
    multipliers: dict[str, float] = {}
    linear: Linear | None = None
    sections: Sections | None = None
    ends: Ends | None = None
    measured: str | None = None
    autopilot: AutopilotKeys | None = None
    rudder: RudderKeys | None = None
    righting: Righting | None = None
    velocities: Velocities | None = None
    database: Annotated[DatabaseKeys, BeforeValidator(_lines)] | None = None
    bilge_keels: BilgeKeelKeys | None = None
    drag_coefficient: Given | None = None
    velocity_scale: Given | None = None
    provenance: dict[str, str] = {}


def checked_keys(where: str, data: Any) -> ShipKeys:
    """The content of a ship file with its keys and types checked.

    Parameters
    ----------
    where : str    file named in the message
    data : Any     what the YAML holds

    Returns
    -------
    ShipKeys

    Raises
    ------
    InputError    the first thing that is wrong: key, what was given, what is allowed, what to try

    Notes
    -----
    Source: the format of the ship file.

    Examples
    --------
    >>> checked_keys("my.yaml", {"base": "box", "length": "120 m"}).length
    '120 m'
    """
    if not isinstance(data, dict):
        raise InputError(f"{where}: a ship file is a list of keys with values; start from `base: series60-cb60`")
    try:
        return ShipKeys.model_validate(data)
    except ValidationError as error:
        problems = error.errors()
        more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        raise InputError(f"{where}: {_sentence(problems[0], data)}{more}") from None


def _sentence(problem: Any, data: dict[str, Any]) -> str:
    """One problem in words."""
    location = [part for part in problem["loc"] if not (isinstance(part, str) and "[" in part)]
    key, given = _path(location, data), quoted(problem["input"])
    kind, own = problem["type"], own_words(problem)
    if kind == "extra_forbidden":
        keys = _keys_at(location)
        near = get_close_matches(str(location[-1]), keys, n=1, cutoff=0.5)
        hint = f"did you mean `{near[0]}`? Keys" if near else "keys"
        return f"key `{key}` is unknown; {hint} allowed here: {', '.join(keys)}"
    if kind == "missing":
        return f"key `{key}` is missing; keys allowed here: {', '.join(_keys_at(location))}"
    if own is not None:
        return f"{key}{own}" if own.startswith(":") else f"{key}: {own}"
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        return f"{key}: {given} is given; allowed: a group of keys: {', '.join(_keys_at([*location, '']))}"
    if kind == "literal_error":
        return f"{key}: {given} is given; {nearest_word(problem)}"
    return f"{key}: {given} is given; allowed: {allowed(problem)}"


def quoted(given: Any) -> str:
    """What was given as a message repeats it: whole, or its beginning.

    Notes
    -----
    Source: none; wording.

    Examples
    --------
    >>> quoted("straight"), len(quoted([0.5] * 1000))
    ("'straight'", 60)
    """
    text = repr(given)
    return text if len(text) <= _LONGEST_QUOTE else f"{text[: _LONGEST_QUOTE - 3]}..."


def _path(location: list[Any], data: dict[str, Any]) -> str:
    """Key path in words: `offsets, station 3 (x = 0.45), half_breadths 4`."""
    names = {"stations": "station", "half_breadths": "half_breadths, waterline", "heights": "heights, waterline"}
    words: list[str] = []
    here: Any = data
    for part in location:
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
    groups: dict[str, type[_Strict]] = {
        "loading": LoadingKeys,
        "offsets": OffsetKeys,
        "stations": StationKeys,
        "lines": LinesKeys,
        "autopilot": AutopilotKeys,
        "rudder": RudderKeys,
        "bilge_keels": BilgeKeelKeys,
        "database": DatabaseKeys,
    }
    parents = [part for part in location[:-1] if isinstance(part, str)]
    model: type[_Strict] = ShipKeys
    for part in parents:
        model = groups.get(part, Entry)
    return list(model.model_fields)

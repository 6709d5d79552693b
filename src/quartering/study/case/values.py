"""Values and ranges as a case file writes them, with their units."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.option_checks import Option, Refused, checked
from quartering.units import MOST_VALUES, Kind, quantity

_RANGE = re.compile(
    r"\s*(?P<first>[-+.\deE]+?)\s*\.\.\s*(?P<last>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(?P<unit>\S*?)\s*"
    r"(?:(?P<how>step|count)\s+(?P<size>\S+)\s*(?P<own>\S*))?\s*"
)


def values_of(one: Option, given: Any, own: Ship, where: str = "") -> list[float]:
    """Values of an option as a case file, or Python, writes them.

    given: a number, text with a unit, a range as for `range_values`, or a flat list of such
    own: whose L, B and T are meant
    where: the message begins with it
    Returns SI, degrees or 1

    >>> from quartering.hull.file.read import ship
    >>> from quartering.options import option
    >>> [round(one, 2) for one in values_of(option("wave_length"), ["0.5 L", 80, "10 s"], ship("wigley"))]
    [50.0, 80.0, 156.13]
    """
    items = [given] if isinstance(given, str) or np.ndim(given) == 0 else list(given)
    if not items:
        raise Refused(one.name, f"{one.name}: the list is empty; give at least one value", where)
    found: list[float] = []
    for item in items:
        if isinstance(item, str) and ".." in item:
            found += range_values(item, one, own, where)
        else:
            found.append(_one_value(one, item, own, where))
    return found


def _one_value(one: Option, item: Any, own: Ship, where: str) -> float:
    value = checked(one, item, where, own.sizes)
    if isinstance(value, str):
        raise Refused(one.name, f"{one.name} = {value}; a study takes numbers here, one or a list", where)
    return float(value)


def range_values(item: str, one: Option, own: Ship, where: str = "") -> list[float]:
    """Values of "0..18 kn step 1" or "0.4..2.3 L count 20" in SI, degrees or 1.

    item: the range
    one: whose values they are
    own: whose L, B and T are meant
    where: the message begins with it

    >>> from quartering.hull.file.read import ship
    >>> from quartering.options import option
    >>> range_values("0..90 deg step 45", option("heading"), ship("wigley"))
    [0.0, 45.0, 90.0]
    """
    what = f"{where}: {one.name}" if where else one.name

    def single(text: str) -> float:
        return _one_value(one, text, own, where)

    match = _RANGE.fullmatch(item)
    if match is None or match["how"] is None:
        raise InputError(f'{what}: "{item}" is not a range; write it like "0..18 kn step 1" or "0.4..2.3 L count 20"')
    unit = match["unit"]
    first, last = (single(f"{number} {unit}".strip()) for number in (match["first"], match["last"]))
    if not last >= first:
        raise Refused(
            one.name,
            f'{one.name}: the range "{item}" is empty, it ends below its begin; write the smaller value first',
            where,
        )
    size = _step(f"{match['size']} {match['own'] or unit}".strip(), one, own, what) if match["how"] == "step" else 0.0
    if match["how"] == "step":
        if not size > 0:
            raise InputError(f'{what}: the step of "{item}" must be above 0')
        count = int((last - first) / size + 1 + 1e-9) if (last - first) / size < MOST_VALUES else MOST_VALUES + 1
        last = first + (count - 1) * size
    else:
        if not match["size"].isdigit() or int(match["size"]) < 1:
            raise InputError(f'{what}: the count of "{item}" must be a whole number from 1')
        count = int(match["size"])
    if count > MOST_VALUES:
        raise InputError(f'{what}: "{item}" stands for more than {MOST_VALUES:,} values; take a larger step')
    return [float(v) for v in np.linspace(first, last, count)]


def _step(text: str, one: Option, own: Ship, what: str) -> float:
    """Step of a range, which may be smaller than any value allowed."""
    kind: Kind = "ratio" if one.kind == "steepness" else one.kind  # type: ignore[assignment]
    return quantity(text, "length" if kind == "wave length" else kind, **own.sizes._asdict(), what=what)

"""What people type on the command line: values, lists and ranges with units, a steepness."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

from quartering.conventions import InputError, RangeWarning
from quartering.option_checks import Option, Refused, checked
from quartering.units import MOST_VALUES, Kind, Sizes, quantity, split_quantity

_HARDLY_MOVING = 0.02
"""Froude number below which a speed typed without a unit is doubted [1]."""


def value(text: str, kind: Kind | Option, sizes: Sizes, what: str) -> float:
    """One value with its unit, in SI (angles in degrees).

    text: such as "7.5", "15kn", "0.25Fn", "1.0L", "30"
    kind: "length", "speed", "angle", "time", .. or an option, whose range is then checked
    sizes: of the ship [m]
    what: the option, for messages
    """
    if isinstance(kind, Option):
        found = checked(kind, text, what, sizes)
        if isinstance(found, str):
            raise Refused(kind.name, f"{kind.name} = {found}; a number is wanted here", what)
        found, kind = float(found), kind.kind  # type: ignore[assignment]
    else:
        found = quantity(text, kind, **sizes._asdict(), what=what)
    if kind == "speed" and sizes.length and not split_quantity(text)[1]:
        froude = found / quantity("1 Fn", "speed", length=sizes.length)
        if 0 < froude < _HARDLY_MOVING:
            message = f"{what} {text} is {found:g} m/s, Froude number {froude:.2g}; a Froude number is written 0.25Fn"
            warnings.warn(message, RangeWarning, stacklevel=2)
    return found


def values(texts: Sequence[str], kind: Kind | Option, sizes: Sizes, what: str, count: int) -> list[float]:
    """Values of an option that takes lists ("0.5L,1L") and ranges ("0.4:2.3L:20": from, to, number of values).

    texts: the option as often as it was given
    kind: as in `value`
    sizes: of the ship [m]
    what: the option, for messages
    count: number of values of a range that does not say
    Returns ascending, each once; within one text a number without unit takes the unit of the others
    """
    found: set[float] = set()
    for text in texts:
        items = [item.split(":") for item in text.split(",")]
        unit = _shared_unit([part for item in items for part in item[:2]], text, what)
        for parts in items:
            ends = [value(_with_unit(part, unit, what), kind, sizes, what) for part in parts[:2]]
            found.update(ends if len(parts) == 1 else _spread(ends, parts, count, text, what))
    return sorted(found)


def _shared_unit(numbers: Sequence[str], text: str, what: str) -> str:
    """The unit numbers without one take."""
    units = [split_quantity(number, what)[1] for number in numbers]
    different = {unit for unit in units if unit}
    if "" in units and len(different) > 1:
        raise InputError(f'{what} "{text}": some numbers have no unit and the others differ; write a unit on each')
    return next(iter(different), "")


def _with_unit(number: str, unit: str, what: str) -> str:
    return number if split_quantity(number, what)[1] else f"{number}{unit}"


def _spread(ends: Sequence[float], parts: Sequence[str], count: int, text: str, what: str) -> list[float]:
    """Evenly spaced values of one range."""
    if len(parts) == 3:
        number = parts[2].strip()
        if not number.isdecimal() or not 2 <= int(number) <= MOST_VALUES:
            raise InputError(
                f'{what} "{text}": the third part of a range is how many values it has, a whole number of 2 or more, '
                f"up to {MOST_VALUES:,} (from:to:count); {parts[2]!r} given"
            )
        count = int(number)
    if len(parts) > 3:
        raise InputError(f'{what} "{text}": a range is from:to or from:to:count, such as 0:180:37')
    first, last = ends
    return [first + (last - first) * i / (count - 1) for i in range(count)]

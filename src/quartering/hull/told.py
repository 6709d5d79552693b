"""Numbers given in Python: floats or text with a unit, checked against the range of their option."""

from __future__ import annotations

from numbers import Integral
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.arguments import ARGUMENTS
from quartering.conventions import InputError
from quartering.option_checks import Option, Refused, checked, quoted
from quartering.options import OPTIONS
from quartering.units import NO_SHIP, Sizes

if TYPE_CHECKING:
    from quartering.hull.ship import Ship


def number(ship: Ship | None, name: str, given: float | str) -> float:
    """One value of an option in SI or degrees.

    ship: whose L, B and T are meant
    name: of the option
    given: 7.5, "15kn", "0.25Fn", "1.2L"
    """
    return _one(_named(name), given, NO_SHIP if ship is None else ship.sizes)


def numbers(ship: Ship | None, name: str, given: ArrayLike) -> NDArray[np.float64]:
    """One value or several of an option in SI or degrees.

    ship: whose L, B and T are meant
    name: of the option
    given: numbers, or text with a unit, as for `number`
    """
    one, sizes = _named(name), NO_SHIP if ship is None else ship.sizes
    if _has_text(given):
        given = _each(one, given, sizes)
    array = real(given)
    if array is None or array.size == 0:
        why = "give one or more" if array is not None else "that is not a number or a list of numbers"
        raise Refused(one.name, f"{one.name} = {quoted(given)}; {why}; {one.range(sizes)}")
    bad = array[~np.isfinite(array)]
    for value in [bad.flat[0]] if bad.size else [array.min(), array.max()]:
        checked(one, float(value), "", sizes)
    return array


def real(given: Any) -> NDArray[np.float64] | None:
    """Numbers as they are given; None for what is none, or what numpy would make one of: dates, bytes, truth values.

    >>> real([1, 2.5]).tolist(), real(b"5"), real([True]), real(10**400)
    ([1.0, 2.5], None, None, None)
    """
    try:
        array = np.asarray(given)
        return array.astype(float) if array.dtype.kind in "iufO" else None
    except (TypeError, ValueError, OverflowError):
        return None


def count(name: str, given: Any, least: int, usual: int, most: int | None = None) -> int:
    """A whole number of something."""
    whole = isinstance(given, (Integral, np.integer)) and not isinstance(given, bool)
    if not whole or int(given) < least or (most is not None and int(given) > most):
        limits = f"of {least} or more" if most is None else f"from {least} to {most:,}"
        raise InputError(f"{name} = {quoted(given)}; it is a whole number {limits}; try {usual}")
    return int(given)


def _named(name: str) -> Option:
    return OPTIONS[name] if name in OPTIONS else ARGUMENTS[name]


def _has_text(given: Any) -> bool:
    if isinstance(given, np.ndarray) and given.dtype.kind in "UO":
        given = given.tolist()
    return isinstance(given, str) or (isinstance(given, (list, tuple)) and any(_has_text(item) for item in given))


def _each(one: Option, given: Any, sizes: Sizes) -> Any:
    """Numbers in the shape they are given in."""
    if _is_list(given):
        return [_each(one, item, sizes) for item in given]
    return _one(one, given, sizes)


def _one(one: Option, given: Any, sizes: Sizes) -> float:
    if _is_list(given):
        raise Refused(one.name, f"{one.name} = {quoted(given)}; one number is wanted here; {one.range(sizes)}")
    found = checked(one, given, "", sizes)
    if isinstance(found, str):
        raise Refused(one.name, f"{one.name} = {found}; a number is wanted here")
    return float(found)


def _is_list(given: Any) -> bool:
    return isinstance(given, (list, tuple)) or getattr(given, "ndim", 0) > 0


def condition(ship: Ship | None, speed: float | str, heading: float | str) -> tuple[float, float]:
    """Speed [m/s] and heading [deg] of a condition."""
    return number(ship, "speed", speed), number(ship, "heading", heading)

"""Numbers of a condition as people give them in Python: numbers, or text with a unit, in the range of their option."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.options import OPTIONS, Refused, checked
from quartering.units import NO_SHIP

if TYPE_CHECKING:
    from quartering.hull.ship import Ship


def number(ship: Ship | None, name: str, given: float | str) -> float:
    """One value of an option in SI or degrees.

    Parameters
    ----------
    ship : Ship or None    whose L, B and T are meant
    name : str             of the option
    given : float or str   7.5, "15kn", "0.25Fn", "1.2L"

    Returns
    -------
    float

    Raises
    ------
    InputError             what `quartering.options.checked` refuses

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> number(ship("wigley"), "wave_length", "1.2L")
    120.0
    """
    return float(checked(OPTIONS[name], given, "", NO_SHIP if ship is None else ship.sizes))


def numbers(ship: Ship | None, name: str, given: ArrayLike) -> NDArray[np.float64]:
    """One value or several of an option in SI or degrees.

    Parameters
    ----------
    ship : Ship or None    whose L, B and T are meant
    name : str             of the option
    given : () or (n,)     numbers, or text with a unit, as for `number`

    Returns
    -------
    () or (n,) float

    Raises
    ------
    InputError             what `quartering.options.checked` refuses

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> numbers(ship("wigley"), "speed", ["10kn", 3.0]).round(3).tolist()
    [5.144, 3.0]
    """
    one, sizes = OPTIONS[name], NO_SHIP if ship is None else ship.sizes
    if isinstance(given, str) or (isinstance(given, (list, tuple)) and any(isinstance(item, str) for item in given)):
        items: Any = given
        return np.array(
            [checked(one, item, "", sizes) for item in items]
            if not isinstance(given, str)
            else number(ship, name, given)
        )
    try:
        array = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        raise Refused(name, f"{name} = {given!r} is not a number or a list of numbers; {one.range(sizes)}") from None
    bad = array[~np.isfinite(array)]
    for value in [bad.flat[0]] if bad.size else [array.min(), array.max()] if array.size else []:
        checked(one, float(value), "", sizes)
    return array


def condition(ship: Ship | None, speed: float | str, heading: float | str) -> tuple[float, float]:
    """Speed [m/s] and heading [deg] of a condition.

    Examples
    --------
    >>> condition(None, "10 m/s", 30)
    (10.0, 30.0)
    """
    return number(ship, "speed", speed), number(ship, "heading", heading)

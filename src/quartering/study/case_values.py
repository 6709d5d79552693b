"""Values and ranges as a case file writes them, with their units."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Final

import numpy as np

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.hull.units import Kind, quantity, split_quantity
from quartering.loads.waves import STEEPEST

MOST_VALUES: Final = 100_000
"""Largest number of values one range may stand for."""
_UNITS: Final = {
    "speed": ("m/s", "kn", "km/h", "Fn"), "angle": ("deg", "rad"), "length": ("m", "mm", "cm", "km", "ft", "L", "B", "T"),
    "ratio": ("%",),
}  # fmt: skip
_RANGE = re.compile(
    r"\s*(?P<first>[-+.\deE]+?)\s*\.\.\s*(?P<last>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(?P<unit>\S*?)\s*"
    r"(?:(?P<how>step|count)\s+(?P<size>\S+)\s*(?P<own>\S*))?\s*"
)


def single_value(item: float | str, kind: Kind, own: Ship, what: str) -> float:
    """One value in SI, degrees or 1.

    Parameters
    ----------
    item : float or str    such as 4.5, "8 kn", "0.5 L"
    kind : str             of the quantity
    own : Ship             whose L, B and T are meant
    what : str             named in the message

    Returns
    -------
    float

    Raises
    ------
    InputError             a unit that is not one of the quantity, not a number

    Notes
    -----
    Source: the format of the case file.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> single_value("0.5 L", "length", ship("wigley"), "wave_length")
    50.0
    """
    hull = own.hull
    unit = split_quantity(item, what)[1]
    if unit and unit not in _UNITS[kind]:
        near = get_close_matches(unit, _UNITS[kind], n=1, cutoff=0.0)
        raise InputError(
            f'{what}: unit "{unit}" in "{item}" is unknown; did you mean "{near[0]}"? Units allowed: {", ".join(_UNITS[kind])}'
        )
    return quantity(item, kind, length=hull.length, beam=hull.beam, draught=hull.draught, what=what)


def range_values(item: str, kind: Kind, own: Ship, what: str) -> list[float]:
    """Values of "0..18 kn step 1" or "0.4..2.3 L count 20" in SI, degrees or 1.

    Parameters
    ----------
    item : str     the range
    kind : str     of the quantity
    own : Ship     whose L, B and T are meant
    what : str     named in the message

    Returns
    -------
    list of float

    Raises
    ------
    InputError     not a range, an empty one, one of too many values

    Notes
    -----
    Source: the format of the case file.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> range_values("0..90 deg step 45", "angle", ship("wigley"), "heading")
    [0.0, 45.0, 90.0]
    """
    match = _RANGE.fullmatch(item)
    if match is None or match["how"] is None:
        raise InputError(f'{what}: "{item}" is not a range; write it like "0..18 kn step 1" or "0.4..2.3 L count 20"')
    unit = match["unit"]
    first, last = (
        single_value(f"{number} {unit}".strip(), kind, own, what) for number in (match["first"], match["last"])
    )
    if not last >= first:
        raise InputError(f'{what}: the range "{item}" is empty, it ends below its begin; write the smaller value first')
    size = (
        single_value(f"{match['size']} {match['own'] or unit}".strip(), kind, own, what)
        if match["how"] == "step"
        else 0.0
    )
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


def steepness(given: float | str, what: str) -> float:
    """Wave height over wave length, as a fraction or a number.

    Parameters
    ----------
    given : float or str    "1/50", 0.02 or "2%"
    what : str              named in the message

    Returns
    -------
    float

    Raises
    ------
    InputError    not a number, not above 0 or above 1/7

    Notes
    -----
    Source: the format of the case file.

    Examples
    --------
    >>> steepness("1/50", "--steepness"), steepness("2%", "--steepness")
    (0.02, 0.02)
    """
    parts = given.split("/") if isinstance(given, str) else [given]
    numbers = [quantity(part, "ratio", what=what) for part in parts]
    found = numbers[0] / numbers[1] if len(numbers) == 2 and numbers[1] else numbers[0]
    if len(numbers) > 2 or 0 in numbers[1:] or not 0 < found <= STEEPEST:
        typed = given if isinstance(given, str) else f"{given:g}"
        raise InputError(f'{what} "{typed}": wave height over wave length, above 0 and at most 1/7; try 1/50')
    return found


def checked_headings(headings: Sequence[float], what: str) -> Sequence[float]:
    """Headings [deg] as they are: from 0 to 360, or from -180 to 0 with the wave on the other side.

    Parameters
    ----------
    headings : (n,) float    [deg]
    what : str               option or key, for the message

    Returns
    -------
    the same

    Raises
    ------
    InputError    one outside, which is more likely a slip than a turn more

    Notes
    -----
    Source: the format of the case file.

    Examples
    --------
    >>> checked_headings([-60.0, 350.0], "heading")
    [-60.0, 350.0]
    """
    for heading in headings:
        if not -180.0 <= heading <= 360.0:
            raise InputError(
                f"{what} {heading:g} deg: a heading is 0 (following) to 180 (head sea), or up to 360 or down to -180 with"
                f" the wave on the other side; try {heading % 360.0:g}"
            )
    return headings

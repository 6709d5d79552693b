"""Values with units, as people write them: "4.5 m", "18 kn", "0.38 B", "8500 t"."""

from __future__ import annotations

import math
import re
from numbers import Real
from typing import Final, Literal, NamedTuple

from quartering.conventions import GRAVITY, InputError, as_float

Kind = Literal[
    "length", "wave length", "speed", "mass", "angle", "time", "density", "area", "ratio", "frequency", "roll angle", "rate",
    "growth rate",
]  # fmt: skip

MOST_VALUES: Final = 100_000
"""Largest number of values one range may stand for."""

LENGTHS: Final = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "ft": 0.3048}
"""Unit of a length -> metres."""
_UNITS: Final[dict[str, dict[str, float]]] = {
    "length": LENGTHS,
    "wave length": LENGTHS,
    "speed": {"m/s": 1.0, "kn": 1852.0 / 3600.0, "km/h": 1.0 / 3.6},
    "mass": {"kg": 1.0, "t": 1e3},
    "angle": {"deg": 1.0, "rad": 180.0 / math.pi},
    "time": {"s": 1.0, "min": 60.0, "h": 3600.0},
    "density": {"kg/m3": 1.0, "t/m3": 1e3},
    "area": {"m2": 1.0},
    "ratio": {"": 1.0, "%": 0.01},
    "frequency": {"rad/s": 1.0, "Hz": 2.0 * math.pi},
    "roll angle": {"rad": 1.0, "deg": math.pi / 180.0},
    "rate": {"rad/s": 1.0, "deg/s": math.pi / 180.0},
    "growth rate": {"1/s": 1.0, "1/min": 1.0 / 60.0},
}
"""Kind -> unit -> factor to the unit a bare number has: m, m/s, kg, deg, s, kg/m3, m2, rad/s; rad for angles of a state."""

_SHIP_UNITS: Final = ("L", "B", "T")
BARE: Final[dict[Kind, str]] = {
    "length": "m", "wave length": "m", "speed": "m/s", "mass": "kg", "angle": "deg", "time": "s", "density": "kg/m3",
    "area": "m2", "ratio": "1", "frequency": "rad/s", "roll angle": "rad", "rate": "rad/s",
    "growth rate": "1/s",
}  # fmt: skip
"""Kind -> the unit a bare number has."""


class Sizes(NamedTuple):
    """What L, B and T stand for [m]; None where no ship is known."""

    length: float | None = None
    beam: float | None = None
    draught: float | None = None


NO_SHIP: Final = Sizes()


def wave_length_of(period: float) -> float:
    """Length of the deep-water wave of a period.

    period: seen from a fixed point [s]
    Returns g T^2 / (2 pi) [m]

    Source: [Lewis89] ch. VIII, waves on deep water.

    >>> round(wave_length_of(10.0), 2)
    156.13
    """
    return GRAVITY * period * period / (2.0 * math.pi)


def units_of(kind: Kind, sizes: Sizes = NO_SHIP) -> tuple[str, ...]:
    """Units a quantity may be written in, where the sizes of a ship are known those of the ship among them.

    >>> units_of("speed", Sizes(100.0))
    ('m/s', 'kn', 'km/h', 'Fn')
    """
    own = tuple(unit for unit in _UNITS[kind] if unit)
    if kind in ("length", "wave length"):
        own += tuple(letter for letter, size in zip(_SHIP_UNITS, sizes, strict=True) if size)
    if kind == "wave length":
        own += tuple(_UNITS["time"])
    return own + (("Fn",) if kind == "speed" and sizes.length else ())


def article(kind: Kind) -> str:
    """The article before a kind of quantity."""
    return "an" if kind[0] in "ae" else "a"


_PATTERN: Final = re.compile(
    r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+]?\.?(?:nan|inf))\s*\*?\s*(\S*)\s*", re.IGNORECASE
)


def split_quantity(value: float | str, what: str = "value") -> tuple[float, str]:
    """Take a value apart into its number and its unit.

    value: such as 4.5, "4.5 m", "0.38B"
    what: what the value is, for the message
    Returns unit: "" when none is given
    """
    value = as_float(value)
    if isinstance(value, bool) or not isinstance(value, (Real, str)):
        raise InputError(f'{what}: {value!r} is not a value; give a number or a number with a unit, such as "4.5 m"')
    match = _PATTERN.fullmatch(value) if isinstance(value, str) else None
    if isinstance(value, str) and match is None:
        raise InputError(
            f'{what}: "{value}" is not a number, or a number with its unit, such as 4.5, "4.5 m" or "15kn"'
        )
    number, unit = (
        (float(match[1].replace(".nan", "nan").replace(".inf", "inf")), match[2]) if match else (float(value), "")
    )
    if not math.isfinite(number):
        raise InputError(f"{what}: {value} is not a finite number; give one, such as 4.5")
    return number, unit


def quantity(
    value: float | str,
    kind: Kind,
    *,
    length: float | None = None,
    beam: float | None = None,
    draught: float | None = None,
    what: str | None = None,
) -> float:
    """Value in SI (angles in degrees) of a number, or of a number with a unit.

    value: 4.5, "4.5 m", "18 kn", "0.38 B", "1.2L", "0.25 Fn", "5 %"
    kind: "length", "speed", "mass", "angle", "time", "density", "area", "ratio" or "wave length", which a period gives
        too: "9 s"
    length, beam, draught: what L, B and T stand for [m]; left out, those units are refused
    what: name used in messages; the kind when left out
    Returns in m, m/s, kg, deg, s, kg/m3, m2 or 1

    L, B and T multiply lengths, "Fn" is sqrt(g L) for speeds.  Source: SI definitions, 1 kn = 1852 m/h, 1 ft = 0.3048 m.
    """
    name = what or kind
    number, unit = split_quantity(value, name)
    factors = dict(_UNITS[kind])
    if kind in ("length", "wave length"):
        sizes = zip(_SHIP_UNITS, (length, beam, draught), strict=True)
        factors |= {letter: size for letter, size in sizes if size is not None}
    elif kind == "speed" and length is not None:
        factors["Fn"] = math.sqrt(GRAVITY * length)
    if unit == "":
        return number
    if kind == "wave length" and unit in _UNITS["time"]:
        return wave_length_of(number * _UNITS["time"][unit])
    if unit not in factors:
        allowed = ", ".join([*(u for u in factors if u), *(_UNITS["time"] if kind == "wave length" else ())]) or "none"
        raise InputError(
            f'{name}: unit "{unit}" in "{value}" is not known for {article(kind)} {kind}; units allowed: {allowed}'
        )
    return number * factors[unit]

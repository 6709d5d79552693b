"""Ship and condition as typed on the command line."""

from __future__ import annotations

from collections.abc import Mapping

from quartering.conventions import InputError
from quartering.hull.changes import changed
from quartering.hull.file.read import ship
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.options import OPTIONS, Refused
from quartering.units import Sizes
from quartering.view.options import value


def sizes(of: Ship) -> Sizes:
    """What L, B and T stand for."""
    return of.sizes


def typed_ship(name: str, changes: Mapping[str, str]) -> Ship:
    """The ship of a name or file with the options typed beside it.

    Raises
    ------
    InputError    no such ship, an option that cannot be: its name as typed, and the words every door says
    """
    return with_typed(ship(name), changes)


def with_typed(one: Ship, changes: Mapping[str, str]) -> Ship:
    """The ship with the options typed.

    Raises
    ------
    InputError    as for `typed_ship`
    """
    if not changes:
        return one
    try:
        return changed(one, dict(changes))
    except Refused as error:
        known = OPTIONS.get(error.option)
        typed = next((key for key in (error.option, error.group) if key in changes), known.name if known else "")
        raise InputError(f"{OPTIONS[typed].command}: {error.words}" if typed in OPTIONS else error.words) from None


def typed_value(name: str, text: str, of: Sizes, what: str | None = None) -> float:
    """One value of the condition as typed.

    Raises
    ------
    InputError    the option as typed, and the words every door says

    Warns
    -----
    RangeWarning  a speed without a unit so small that a Froude number may be meant
    """
    return value(text, OPTIONS[name], of, what or OPTIONS[name].command)


def condition(
    name: str, typed: tuple[str, str, str, str], changes: Mapping[str, str]
) -> tuple[Ship, Wave, float, float]:
    """Ship, wave, speed [m/s] and heading [deg] from the words given.

    Parameters
    ----------
    name : str     of a built-in ship, or a path
    typed : (heading, speed, wave length, wave height)
    changes : mapping of str to str    options of the ship
    """
    one = typed_ship(name, changes)
    heading, speed, length, height = (
        typed_value(key, text, one.sizes)
        for key, text in zip(("heading", "speed", "wave_length", "wave_height"), typed, strict=True)
    )
    return one, Wave(length, height), speed, heading

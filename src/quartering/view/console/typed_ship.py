"""Ship and condition as typed on the command line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from quartering.conventions import InputError
from quartering.option_checks import Refused
from quartering.options import OPTIONS
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_values import value

if TYPE_CHECKING:
    from quartering.hull.ship import Ship
    from quartering.loads.waves import Wave
    from quartering.units import Sizes


def typed_ship(name: str, changes: Mapping[str, str]) -> Ship:
    """The ship of a name or file with the options typed beside it."""
    from quartering.hull.changes import changed
    from quartering.hull.file.read import ship

    one = ship(name)
    if not changes:
        return one
    try:
        return changed(one, dict(changes))
    except Refused as error:
        known = OPTIONS.get(error.option)
        typed = next((key for key in (error.option, error.group) if key in changes), known.name if known else "")
        raise InputError(f"{OPTIONS[typed].command}: {error.words}" if typed in OPTIONS else error.words) from None


def typed_value(name: str, text: str, of: Sizes, what: str | None = None) -> float:
    """One value of the condition as typed."""
    return value(text, OPTIONS[name], of, what or OPTIONS[name].command)


class Typed(NamedTuple):
    """A ship and one condition as typed.

    Parameters
    ----------
    ship : str                                           built-in ship, or path
    heading, speed, wave_length, wave_height : str
    changes : mapping of str to str                      options of the ship
    """

    ship: str
    heading: str
    speed: str
    wave_length: str
    wave_height: str
    changes: Mapping[str, str]

    @property
    def condition(self) -> dict[str, str]:
        """The condition: name -> text."""
        return {key: getattr(self, key) for key in ("heading", "speed", "wave_length", "wave_height")}

    @property
    def words(self) -> str:
        """The options of the condition, to be typed again."""
        return " ".join(f"{OPTIONS[key].command} {text}" for key, text in self.condition.items())

    @property
    def ship_words(self) -> str:
        """The ship with its options, to be typed again."""
        return f"{self.ship}{option_words(self.changes)}"

    def read(self) -> tuple[Ship, Wave, float, float]:
        """Ship, wave, speed [m/s] and heading [deg]."""
        from quartering.loads.waves import Wave

        one = typed_ship(self.ship, self.changes)
        heading, speed, length, height = (typed_value(key, text, one.sizes) for key, text in self.condition.items())
        return one, Wave(length, height), speed, heading

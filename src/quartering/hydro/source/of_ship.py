"""Selection of a ship's source of hydrodynamics.

A further source is a file with a function that makes a `Hydrodynamics` of a ship, and one line here.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Final, NamedTuple

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.hydro.source.panels import panel_source
from quartering.hydro.source.record import Hydrodynamics
from quartering.hydro.source.strips import strip_source
from quartering.hydro.source.user_database import database_source


class Choice(NamedTuple):
    """A source of hydrodynamics.

    Parameters
    ----------
    make : callable    ship -> Hydrodynamics
    own : callable     ship -> bool: is it the source this ship asks for?
    """

    make: Callable[[Ship], Hydrodynamics]
    own: Callable[[Ship], bool]


SOURCES: Final[dict[str, Choice]] = {
    "database": Choice(database_source, lambda ship: ship.database is not None),
    "panels": Choice(panel_source, lambda ship: ship.hydrodynamics == "panels"),
    "strips": Choice(strip_source, lambda _: True),
}
"""Name -> source; a ship's own is the first that it asks for."""


@lru_cache(maxsize=64)  # of one ship it is asked for every block of a map, and several times in each
def source_of(ship: Ship, by: str | None = None) -> Hydrodynamics:
    """The hydrodynamics of a ship, by its own source or by another.

    by: one of `SOURCES`; None: its own database where it has one, else what it asks for
    Returns made once for a ship
    """
    chosen = by or next(name for name, choice in SOURCES.items() if choice.own(ship))
    if chosen not in SOURCES:
        raise InputError(f"source {by!r} of hydrodynamics is given; allowed: {', '.join(SOURCES)}; try 'strips'")
    return SOURCES[chosen].make(ship)

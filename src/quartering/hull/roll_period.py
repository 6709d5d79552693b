"""Roll radius of gyration from a natural roll period: a hook filled by `hydro`, which knows the added inertia.

A ship may be told its roll period, and what follows from that needs added mass, which is known one room further on.  So that no
room imports one to its right, that room's function is put here: by `quartering` itself, which knows all rooms and is imported
before any of them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from quartering.hull.ship import Ship

Finder = Callable[["Ship", float, str], float]
"""Ship, natural roll period [s], name for messages -> radius of gyration in roll, without added mass [m]."""

_finders: list[Finder] = []


def find_by(finder: Finder) -> Finder:
    """Put the function that finds the radius here, in the place of one that was there."""
    _finders[:] = [finder]
    return finder


def gyradius_of_period(ship: Ship, period: float, where: str) -> float:
    """Radius of gyration in roll with which a ship rolls freely at a period [s], without added mass [m]."""
    return _finders[0](ship, period, where)

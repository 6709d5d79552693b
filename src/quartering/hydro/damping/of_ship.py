"""The added roll damping of a ship: its methods by name, and the one place that chooses between them."""

from __future__ import annotations

from typing import Final

import numpy as np

from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.damping.ikeda_terms import IKEDA, IKEDA_SIMPLIFIED
from quartering.hydro.damping.method import LINEAR, AddedDamping, DampingMethod
from quartering.hydro.damping.natural_roll import FreeRoll, free_roll
from quartering.hydro.damping.roll import fraction_of_critical


def _fraction(ship: Ship, speed: Floats, roll: FreeRoll) -> AddedDamping:
    """A fraction of critical is linear and alike at all speeds."""
    value = np.full(speed.shape, fraction_of_critical(ship.loading.roll_damping, roll.frequency, roll.inertia))
    return AddedDamping({LINEAR: value}, value)


def _fraction_words(ship: Ship) -> str:
    return f"{ship.loading.roll_damping:g} of critical ({ship.provenance.get('roll_damping', 'given')})"


METHODS: Final[dict[str, DampingMethod]] = {
    "fraction": DampingMethod(_fraction, "derived", _fraction_words, (), lift=False),
    "ikeda": IKEDA,
    "ikeda-simplified": IKEDA_SIMPLIFIED,
}
"""Word of `roll_damping` in a ship file -> method; "fraction" for a number."""


def damping_method(ship: Ship) -> DampingMethod:
    """The method of a ship's added roll damping; nothing else in the equations asks `ship.roll_method`."""
    return METHODS[ship.roll_method]


def added_damping(ship: Ship, speed: Floats, roll: FreeRoll) -> AddedDamping:
    """Added roll damping of a ship at given speeds, by its method.

    speed (n,): U >= 0 [m/s]
    roll: of the ship

    Source: [Himeno81], [ITTC11], [Kawahara09].  Valid: as `roll_damping`; near the natural frequency.

    >>> from quartering.hull.file.read import ship
    >>> keels = ship("series60-cb60").with_(roll_damping="ikeda", bilge_keels=(30.0, 0.33))
    >>> damping = added_damping(keels, np.array([0.0, 7.5]), free_roll(keels))
    >>> bool((np.diff(damping.equivalent) < 0).all())  # more damping with speed
    True
    """
    return damping_method(ship).added(ship, speed, roll)


def equivalent_fraction(ship: Ship, speed: float) -> float:
    """Added roll damping of a ship at one speed, as the fraction of critical that loses as much at 10 deg of roll.

    speed: U >= 0 [m/s]
    Returns [1]; of a ship that says a fraction, that fraction

    Over 2 n2 (I_x + a44). By components it holds the lift too, which with a fraction is the regression's, in K_p.
    Source: [Himeno81].
    """
    roll = free_roll(ship)
    equivalent = float(added_damping(ship, np.array([speed]), roll).equivalent[0])
    return equivalent / fraction_of_critical(1.0, roll.frequency, roll.inertia)

"""The added roll damping of a ship at its speeds, as the equations take it: K_p and, by a component method, K_p|p|."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from quartering.hull.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.dampingforms import LINEAR_OF_QUADRATIC
from quartering.hydro.freeroll import FreeRoll, free_roll
from quartering.hydro.rollcomponents import REFERENCES, Method
from quartering.hydro.rolldamping import fraction_of_critical, roll_damping

AMPLITUDE = 10.0
"""Roll amplitude about which the components are fitted, from a quarter of it to one and a half [deg]."""

MODULUS = "K_p|p|"
_METHODS: dict[str, Method] = {"ikeda": "ikeda", "ikeda-simplified": "simplified"}


class AddedDamping(NamedTuple):
    """Roll damping to be added to the wave damping of the strips at rest.

    Parameters
    ----------
    linear : (n,) float           part of K_p, mostly <= 0 [kg m2/s]
    quadratic : (n,) float        K_p|p|, mostly <= 0; 0 for a fraction of critical [kg m2]
    equivalent : (n,) float       linear damping of equal dissipation at 10 deg, n2 [kg m2/s]
    """

    linear: Floats
    quadratic: Floats
    equivalent: Floats


def added_damping(ship: Ship, speed: Floats, roll: FreeRoll) -> AddedDamping:
    """Added roll damping of a ship at given speeds.

    Parameters
    ----------
    ship : Ship
    speed : (n,) float    U >= 0 [m/s]
    roll : FreeRoll       of the ship

    Returns
    -------
    AddedDamping

    Warns
    -----
    RangeWarning          what `roll_damping` warns of, once for a ship and speed

    Notes
    -----
    A fraction of critical is linear and alike at all speeds. The components are taken at the natural roll frequency and
    fitted by B1 p + B2 |p| p over 2.5 to 15 deg; less the wave damping of the strips at rest, which K_p has already.
    Source: [Himeno81], [ITTC11], [Kawahara09].  Valid: as `roll_damping`; near the natural frequency.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> keels = ship("series60-cb60").with_(roll_damping="ikeda", bilge_keels=(30.0, 0.33))
    >>> damping = added_damping(keels, np.array([0.0, 7.5]), free_roll(keels))
    >>> bool((np.diff(damping.equivalent) < 0).all())  # more damping with speed
    True
    """
    if ship.roll_method == "fraction":
        value = np.full(speed.shape, fraction_of_critical(ship.loading.roll_damping, roll.frequency, roll.inertia))
        return AddedDamping(value, np.zeros(speed.shape), value)
    each, back = np.unique(speed, return_inverse=True)
    forms = np.array([_form(ship, float(u)) for u in each])[back]
    rate = roll.frequency * np.radians(AMPLITUDE)
    return AddedDamping(forms[:, 0], forms[:, 1], forms[:, 0] + LINEAR_OF_QUADRATIC * rate * forms[:, 1])


def equivalent_fraction(ship: Ship, speed: float) -> float:
    """Added roll damping of a ship at one speed, as the fraction of critical that loses as much at 10 deg of roll.

    Parameters
    ----------
    ship : Ship
    speed : float    U >= 0 [m/s]

    Returns
    -------
    float            [1]; of a ship that says a fraction, that fraction

    Warns
    -----
    RangeWarning     what `roll_damping` warns of, once for a ship and speed

    Notes
    -----
    Over 2 n2 (I_x + a44). By components it holds the lift too, which with a fraction is the regression's, in K_p.
    Source: [Himeno81].

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> round(equivalent_fraction(ship("series60-cb60").with_(roll_damping=0.08), 7.5), 6)
    0.08
    """
    roll = free_roll(ship)
    equivalent = float(added_damping(ship, np.array([speed]), roll).equivalent[0])
    return equivalent / fraction_of_critical(1.0, roll.frequency, roll.inertia)


def damping_references(ship: Ship) -> tuple[str, ...]:
    """Keys of the papers behind a ship's added roll damping.

    Parameters
    ----------
    ship : Ship

    Returns
    -------
    tuple of str    empty for a fraction of critical

    Notes
    -----
    Source: [Himeno81] and the papers it gathers.
    """
    return () if ship.roll_method == "fraction" else REFERENCES[_METHODS[ship.roll_method]]


@lru_cache(maxsize=4096)
def _form(ship: Ship, speed: float) -> tuple[float, float]:
    """K_p and K_p|p| to add at one speed."""
    frequency = free_roll(ship).frequency
    damping = roll_damping(ship, speed, frequency, AMPLITUDE, method=_METHODS[ship.roll_method])
    return damping.potential_wave - damping.quadratic.linear, -damping.quadratic.nonlinear

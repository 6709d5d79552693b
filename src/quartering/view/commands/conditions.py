"""Ship and condition as typed on the command line."""

from __future__ import annotations

from quartering.hull.ship import Ship, ship
from quartering.loads.waves import Wave
from quartering.view.options import Sizes, value


def sizes(of: Ship) -> Sizes:
    """What L, B and T stand for."""
    return Sizes(of.hull.length, of.hull.beam, of.hull.draught)


def condition(name: str, typed: tuple[str, str, str, str]) -> tuple[Ship, Wave, float, float]:
    """Ship, wave, speed [m/s] and heading [deg] from the words given.

    Parameters
    ----------
    name : str     of a built-in ship, or a path
    typed : (heading, speed, wave length, wave height)
    """
    one = ship(name)
    units = sizes(one)
    heading = value(typed[0], "angle", units, "--heading")
    speed = value(typed[1], "speed", units, "--speed")
    wave = Wave(value(typed[2], "length", units, "--wave-length"), value(typed[3], "length", units, "--wave-height"))
    return one, wave, speed, heading

"""Ship and condition as typed on the command line."""

from __future__ import annotations

from typing import Literal

from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot
from quartering.hull.choices import checked_velocities
from quartering.hull.ship import Ship, ship
from quartering.hull.units import Kind
from quartering.loads.waves import Wave
from quartering.study.case_values import checked_headings
from quartering.view.options import Sizes, value


def sizes(of: Ship) -> Sizes:
    """What L, B and T stand for."""
    return Sizes(of.hull.length, of.hull.beam, of.hull.draught)


def autopilot_of(text: str) -> Autopilot | Literal["none"]:
    """Autopilot from the words given: "gain", "gain,rate gain", "gain,rate gain,lag", or "none".

    Raises
    ------
    InputError    other words, a value below 0
    """
    if text == "none":
        return "none"
    parts = text.split(",")
    kinds: tuple[Kind, ...] = ("ratio", "time", "time")
    if len(parts) > len(kinds):
        raise InputError(f'--autopilot "{text}": at most three values, gain, rate gain [s], lag [s]; try 1,10s,2s')
    nothing = Sizes(0.0, 0.0, 0.0)
    return Autopilot(*(value(part, kind, nothing, "--autopilot") for part, kind in zip(parts, kinds, strict=False)))


def ship_as(name: str, velocities: str | None) -> Ship:
    """A built-in ship, or that of a file, with what the command line says of it."""
    return (
        ship(name)
        if velocities is None
        else ship(name).with_(velocities=checked_velocities("--velocities", velocities))
    )


def velocity_words(velocities: str | None) -> str:
    """The option as it was typed, for the next command."""
    return f" --velocities {velocities}" if velocities else ""


def condition(
    name: str, typed: tuple[str, str, str, str], autopilot: str | None = None, velocities: str | None = None
) -> tuple[Ship, Wave, float, float]:
    """Ship, wave, speed [m/s] and heading [deg] from the words given.

    Parameters
    ----------
    name : str     of a built-in ship, or a path
    typed : (heading, speed, wave length, wave height)
    autopilot : in place of the ship's own, see `autopilot_of`
    velocities : in place of the ship's own
    """
    one = ship_as(name, velocities)
    if autopilot is not None:
        one = one.with_(autopilot=autopilot_of(autopilot))
    units = sizes(one)
    (heading,) = checked_headings([value(typed[0], "angle", units, "--heading")], "--heading")
    speed = value(typed[1], "speed", units, "--speed")
    wave = Wave(value(typed[2], "length", units, "--wave-length"), value(typed[3], "length", units, "--wave-height"))
    return one, wave, speed, heading

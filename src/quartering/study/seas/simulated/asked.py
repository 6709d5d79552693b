"""What a simulation in a sea is asked for: ship, sea, speed and the limits of a failure, checked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.hull.told import count, number
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea
from quartering.motion.equations.model import Model
from quartering.motion.sea.equations import Force
from quartering.option_checks import quoted
from quartering.study.seas.response import (
    limit_of,
    place_of,
)

Floats = NDArray[np.float64]

FAILURE_ROLL: Final = 40.0
"""Roll angle of a failure where the capsize limit is larger [deg]: MSC.1/Circ.1627, 3.2.1."""
FAILURE_FELT: Final = 9.81
"""Lateral acceleration of a failure [m/s2]: the same place."""


@dataclass(frozen=True, eq=False)
class Asked:
    """What a simulation is of, checked."""

    ship: Ship | Model
    sea: Sea
    speed: float
    place: tuple[float, float]
    limits: tuple[float, float]
    reason: str
    step: float | None
    strips: int | None
    memory: bool
    seed: int
    form: Form
    force: Force | None


def asked_of(
    ship: Ship | Model,
    sea: Sea,
    speed: float | str,
    heading: float | str | None,
    seed: int,
    memory: bool,
    force: Force | None,
    form: Form,
    *,
    limit: float | str | None = None,
    place: Any = None,
) -> Asked:
    """What is asked, checked: arguments as of `irregular`."""
    if not isinstance(sea, Sea):
        raise InputError(f"sea = {quoted(sea)} is no Sea; give one, such as quartering.Sea(hs=6, tp=11)")
    of = ship if isinstance(ship, Ship) else None
    roll, reason = roll_limit_of(ship, limit)
    return Asked(
        ship=ship,
        sea=sea if heading is None else sea.turned_to(number(of, "heading", heading)),
        speed=number(of, "speed", speed),
        place=place_of(ship, place),
        limits=(roll, felt_limit_of(ship, place, None)),
        reason=reason,
        step=None,
        strips=None,
        memory=_yes_or_no("memory", memory),
        seed=count("seed", seed, 0, 6),
        form=form,
        force=force,
    )


def _yes_or_no(name: str, given: Any) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise InputError(f"{name} = {quoted(given)}; it is True or False")
    return bool(given)


def roll_limit_of(ship: Ship | Model, limit: float | str | None) -> tuple[float, str]:
    """Roll of a failure [rad], and why that."""
    if limit is not None:
        return number(None, "limit", limit), "given"
    own = limit_of(ship)
    if own.angle < FAILURE_ROLL:
        return own.radians, own.reason
    return math.radians(FAILURE_ROLL), f"{FAILURE_ROLL:g} deg"


def felt_limit_of(ship: Ship | Model, place: Any, given: float | None) -> float:
    """Lateral acceleration of a failure [m/s2]; infinite where no place is known."""
    if given is not None:
        return number(None, "felt_limit", given)
    known = place is not None or (isinstance(ship, Ship) and ship.value("highest_position_height") is not None)
    return FAILURE_FELT if known else math.inf

"""What stops parametric roll, pure loss or a growing forced roll: the least change of each value that lets small roll decay."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Final

import numpy as np

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import STEEPEST, Wave
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.orbits import forced_motions, symmetric_orbits
from quartering.option_checks import Refused
from quartering.options import OPTIONS
from quartering.stability.parametric import forced_growth, roll_growth
from quartering.study.effects.cure import Cure
from quartering.study.loadings import user_value

CURES: Final = ("roll_damping", "bilge_keel_breadth", "gm", "gyradius_roll", "speed", "heading", "wave_height")
"""Values tried when none are named; keels where the ship's damping knows them."""
_FACTOR, _FURTHEST, _HALVINGS = 1.05, 5.0, 14
_STEPS: Final = {"heading": (5.0, 60.0), "speed": (0.25, 10.0)}
"""Of values that are no matter of a factor: step and furthest change, [deg] and [m/s]."""


def cures_six(
    ship: Ship, wave: Wave, speed: float, heading: float, parameters: Sequence[str] = CURES, margin: float = 0.0
) -> list[Cure]:
    """Smallest change of each value that lets small roll decay in six modes, the smallest relative change first.

    speed, heading: [m/s], [deg]
    parameters: of `CURES`
    margin: growth must be below minus this [1/s]
    Returns empty where small roll decays already, and where no change helps

    Each value alone, outwards on both sides in steps of 5 % up to fivefold (heading 5 deg up to 60, speed 0.25 m/s up to 10),
    then halved 14 times. A large roll that lasts beside one that decays is not looked for: ask `parametric_roll` there.

    >>> from quartering.hull.file.read import ship
    >>> cures_six(ship("wigley"), Wave(100.0, 1.0), 3.0, 180.0)
    []
    """
    unknown = [name for name in parameters if name not in CURES]
    if unknown:
        raise InputError(f"{unknown[0]} is no cure in six modes; they are {', '.join(CURES)}; try gm")
    given = {"speed": speed, "heading": heading, "wave_height": wave.height}
    if not _growth(ship, wave, given) > -margin:
        return []
    found = []
    for name in parameters:
        now = given.get(name, _told(ship, name))
        if now is None or (now <= 0 and name not in _STEPS):
            continue
        needed = _nearest(lambda value, name=name: _with(ship, wave, given, name, value), name, now, margin)  # type: ignore[misc]
        if needed is not None:
            found.append(Cure(name, now, needed, OPTIONS[name].unit))
    return sorted(found, key=lambda one: abs(one.needed - one.now) / max(abs(one.now), 1e-9))


def _told(ship: Ship, name: str) -> float | None:
    """A value of the ship that acts on its motion, or None."""
    if name == "bilge_keel_breadth":
        keels = ship.value(name)
        return None if keels is None or ship.loading.roll_damping > 0 else float(keels)
    if name == "roll_damping":
        return float(ship.loading.roll_damping)
    return float(user_value(ship, name)) if name in ("gm", "gyradius_roll") else None


def _with(ship: Ship, wave: Wave, given: dict[str, float], name: str, value: float) -> float:
    """Growth with one value changed; NaN where the ship cannot have it."""
    if name in given:
        return _growth(ship, wave, given | {name: value})
    try:
        changed: dict[str, Any] = {name: value}
        return _growth(ship.with_(**changed), wave, given)
    except (Refused, InputError):
        return math.nan


def _growth(ship: Ship, wave: Wave, given: dict[str, float]) -> float:
    """Growth of small roll beside the motion of one period [1/s]; NaN where there is none."""
    mu = given["heading"]
    if not 0.0 < given["wave_height"] <= STEEPEST * wave.length:
        return math.nan
    one = course(ship, wave.wavenumber, *(np.array([v]) for v in (given["wave_height"] / 2, given["speed"], mu)))
    if mu in (0.0, 180.0):
        return float(roll_growth(symmetric_orbits(one), 0.0).growth[0])
    orbits = forced_motions(one)
    return forced_growth(orbits)[0] if orbits.found[0] else math.nan


def _values(name: str, now: float) -> Iterator[tuple[float, float]]:
    """Values outwards on both sides, each with the one before it on its side."""
    step, furthest = _STEPS.get(name, (0.0, 0.0))
    high = 180.0 if name == "heading" else math.inf
    count = round(furthest / step) if step else math.ceil(math.log(_FURTHEST) / math.log(_FACTOR))
    for k in range(1, count + 1):
        for way in (1, -1):
            there, before = (now + way * j * step if step else now * _FACTOR ** (way * j) for j in (k, k - 1))
            if 0.0 <= there <= high:
                yield there, before


def _nearest(growth: Callable[[float], float], name: str, now: float, margin: float) -> float | None:
    """The nearest value at which small roll decays."""
    for there, before in _values(name, now):
        if growth(there) <= -margin:
            stable, grows = there, before
            for _ in range(_HALVINGS):
                middle = 0.5 * (stable + grows)
                stable, grows = (middle, grows) if growth(middle) <= -margin else (stable, middle)
            return stable
    return None

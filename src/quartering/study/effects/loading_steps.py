"""What steps a loading, a yard or a master can make do in one condition: 0.1 m of GM, bilge keels, 2 kn."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import Final, NamedTuple

from quartering.conventions import InputError, RangeWarning
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.study.condition.examine import Examined, examine
from quartering.study.loadings import KEEL_AXES, loaded
from quartering.units import quantity

GM_STEP: Final = 0.1
"""Step of GM [m]."""
SPEED_STEP: Final = 2.0
"""Step of speed [kn]."""
_WIDER = 1.5
_USUAL_LENGTH, _USUAL_BREADTH = 0.25, 0.02


class Step(NamedTuple):
    """One change and what it makes of the condition; ``found`` is None where it cannot be made, for a reason."""

    words: str
    found: Examined | None
    reason: str = ""


def loading_steps(found: Examined) -> list[Step]:
    """The condition as it is, and after each change alone."""
    return [Step("as it is", found), *(_made(found, *change) for change in _changes(found))]


def _changes(found: Examined) -> Iterator[tuple[str, dict[str, float], float]]:
    """Each change: in words, values of the loading, speed [m/s]."""
    one, knot = found.ship, quantity("1 kn", "speed")
    for sign in (1, -1):
        yield f"GM {sign * GM_STEP:+g} m", {"gm": one.loading.gm + sign * GM_STEP}, found.speed
    if not one.damped_by_components:  # keels act in place of a fraction of critical: what the ship has without them
        yield "damping by components, no bilge keels", dict.fromkeys(KEEL_AXES, 0.0), found.speed
    length, breadth = keels_of(one)
    verb = "wider bilge keels" if one.bilge_keels and breadth > one.bilge_keels[1] else "bilge keels"
    yield f"{verb}, {length:.3g} x {breadth:.2g} m", dict(zip(KEEL_AXES, (length, breadth), strict=True)), found.speed
    for sign in (1, -1):
        yield f"speed {sign * SPEED_STEP:+g} kn", {}, found.speed + sign * SPEED_STEP * knot


def keels_of(one: Ship) -> tuple[float, float]:
    """Length and breadth of the keels that are tried: half as wide again as its own, or usual ones where it has none."""
    if one.bilge_keels and min(one.bilge_keels) > 0:
        return one.bilge_keels[0], _WIDER * one.bilge_keels[1]
    return _USUAL_LENGTH * one.hull.length, _USUAL_BREADTH * one.hull.beam


def _made(found: Examined, words: str, values: dict[str, float], speed: float) -> Step:
    """A change judged."""
    if speed < 0:
        return Step(words, None, "astern")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RangeWarning)  # what is out of range is said of the condition as it is
            one = loaded(found.ship, values)
            wave = Wave(found.wave.length, found.wave.height)
            return Step(words, examine(one, wave, speed, found.heading, found.harmonics, found.form))
    except InputError as error:
        return Step(words, None, str(error))

"""What a page asks of the library: ship and sea of a state, the verdict, the map by blocks, and the panels' datasets."""

from __future__ import annotations

import math
import warnings
from collections.abc import Awaitable, Callable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np
import xarray as xr

from quartering.conventions import InputError, RangeWarning
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.loads.waves import STEEPEST, Wave
from quartering.motion.transient.simulate import simulate
from quartering.study.branches.branch import branch
from quartering.study.condition.examine import Examined, examine, seek_help
from quartering.study.effects.cure import Cure
from quartering.study.effects.sensitivity import sensitivity
from quartering.study.loadings import loaded
from quartering.study.maps.polar import polar
from quartering.units import quantity
from quartering.view.explorer.hulls.ship_registry import Known
from quartering.view.explorer.state import LOADING, State

HEADINGS = np.linspace(0.0, 180.0, 37)
RATIOS = np.round(np.linspace(0.4, 2.3, 20), 10)
"""Headings [deg] and wave lengths over the ship's length of the map."""

_HEADINGS_AT_ONCE = 5
_CYCLES, _PUSH, _START = 12, math.radians(1.0), math.radians(5.0)

Answer = TypeVar("Answer")


class Scene(NamedTuple):
    """A state with its ship loaded and every value settled."""

    known: Known
    ship: Ship
    wave: Wave
    speed: float
    heading: float
    harmonics: int
    waves: tuple[Wave, ...]


def loaded_ship(state: State, known: Known) -> Ship:
    """The ship as the dials of its loading are turned."""
    own = known.ship
    return loaded(
        own, {name: number(own, name, value) for name in LOADING if (value := getattr(state, name)) is not None}
    )


def scene(state: State, known: Known) -> Scene:
    """Ship, wave and speed of a state."""
    length = known.ship.hull.length
    speed = quantity("0.25 Fn", "speed", length=length) if state.speed is None else state.speed
    at = length if state.wave_length is None else state.wave_length

    def height(wave_length: float) -> float:
        return state.steepness * wave_length if state.wave_height is None else state.wave_height  # type: ignore[operator]

    lengths = [float(ratio) * length for ratio in RATIOS]
    waves = tuple(Wave(one, height(one)) for one in lengths if height(one) <= STEEPEST * one)
    return Scene(known, loaded_ship(state, known), Wave(at, height(at)), speed, state.heading, state.harmonics, waves)


def verdict(of: Scene) -> Examined:
    """The condition of a page, judged."""
    return examine(of.ship, of.wave, of.speed, of.heading, of.harmonics)


def map_blocks(of: Scene) -> list[Callable[[], xr.Dataset]]:
    """The map as pieces of work, some headings each."""
    if not of.waves:
        raise InputError(f"waves of {of.wave.height:.3g} m break at every length of this map; take a lower one")
    parts = [HEADINGS[i : i + _HEADINGS_AT_ONCE] for i in range(0, HEADINGS.size, _HEADINGS_AT_ONCE)]
    return [
        lambda part=part: polar(of.ship, of.waves, [of.speed], part, harmonics=of.harmonics)  # type: ignore[misc]
        for part in parts
    ]


def joined(parts: Sequence[xr.Dataset]) -> xr.Dataset:
    """Blocks of a map put together."""
    return xr.concat(
        parts, dim="heading", data_vars="all", coords="minimal", compat="override", combine_attrs="override"
    )


class History(NamedTuple):
    """Motion in time after a push, beside the steady motion.

    Parameters
    ----------
    trace : Dataset           of `simulate`
    steady : (t, 4) array     state (v, phi, p, r) at the same times; NaN without a motion
    start : str               where it begins, in words
    """

    trace: xr.Dataset
    steady: np.ndarray
    start: str


def history(found: Examined) -> History:
    """Twelve wave periods in time: the steady motion pushed by a degree of roll, or the ship let go where there is none."""
    exists = found.motion.status.ok
    state = found.motion.state(0.0) if exists else np.zeros(4)
    state[1] += _PUSH if exists else _START
    trace = simulate(found.model, _CYCLES * 2 * math.pi / found.model.frequency, [float(s) for s in state])
    words = "pushed by 1°" if exists else "from 5° of roll"
    return History(trace, found.motion.state(trace["time"].values), words)


def curve(of: Scene, over: str) -> xr.Dataset:
    """The response curve through this condition."""
    if over == "frequency":
        return branch(of.ship, over, wave=of.wave, speed=of.speed, heading=of.heading)
    centre = {"wave_height": of.wave.height, "wave_length": of.wave.length, "speed": of.speed}[over]
    if not centre > 0:
        raise InputError(f"a curve over {over.replace('_', ' ')} needs one above zero")
    high = min(2 * centre, STEEPEST * of.wave.length) if over == "wave_height" else 1.5 * centre
    low = (
        0.1 * centre
        if over == "wave_height"
        else max(0.5 * centre, of.wave.height / STEEPEST * (over == "wave_length"))
    )
    return branch(of.ship, over, limits=(low, high), wave=of.wave, speed=of.speed, heading=of.heading)


def causes(of: Scene) -> xr.Dataset:
    """Sensitivities to every coefficient and design value."""
    return sensitivity(of.ship, of.wave, of.speed, of.heading, harmonics=max(3, of.harmonics))


def noting(work: Callable[[], Answer]) -> Callable[[], tuple[Answer, list[str]]]:
    """The work with its range warnings collected, each once; for a thread that nothing else warns from."""

    def done() -> tuple[Answer, list[str]]:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always", RangeWarning)
            answer = work()
        return answer, list(dict.fromkeys(str(one.message) for one in said if issubclass(one.category, RangeWarning)))

    return done


async def sought(
    found: Examined, take: Callable[[Callable[[], Any]], Awaitable[tuple[Any, list[str]]]], wanted: Callable[[], bool]
) -> list[Cure]:
    """The cures of a condition, sought ship by ship, others being served between, as long as they are wanted."""
    steps = seek_help(found)
    healing: list[Cure] = []
    while wanted():
        more, _ = await take(lambda: next(steps, None))
        if more is None:
            break
        healing = more
    return healing

"""What a page asks of the library for an irregular sea: ship and sea of a state, the response, the map in pieces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.hull.ship import Ship
from quartering.loads.sea.sea import Sea
from quartering.study.maps.sweep import evaluated, in_pieces
from quartering.study.seas.over_seas.advice import Advice
from quartering.study.seas.over_seas.grid import SeaGrid, sea_grid
from quartering.study.seas.over_seas.settings import SeaSettings
from quartering.study.seas.response import sea_response
from quartering.units import quantity
from quartering.view.explorer.computing.computations import HEADINGS, loaded_ship
from quartering.view.explorer.hulls.ship_registry import Known
from quartering.view.explorer.sea.sea_state import sea_of, told_of, told_spreading
from quartering.view.explorer.state import State

FROUDE: Final = np.round(np.linspace(0.0, 0.24, 7), 10)
"""Speeds of the map as Froude numbers: those of `quartering polar --hs`."""
_TOP, _FURTHER, _MARGIN = float(FROUDE[-1]), 0.08, 0.02
"""For a faster ship the map goes on in steps of a Froude number of 0.08; half a ring is drawn beyond its end."""
HALVES: Final = 2
"""Blocks of one speed, worked on side by side."""


class SeaScene(NamedTuple):
    """A state in an irregular sea, with its ship loaded and every value settled; `told` is height and period of the sea."""

    known: Known
    ship: Ship
    sea: Sea
    told: dict[str, float]
    speed: float
    heading: float
    speeds: tuple[float, ...]


def sea_scene(state: State, known: Known) -> SeaScene:
    """Ship, sea and speed of a state."""
    length = known.ship.hull.length
    one = quantity("1 Fn", "speed", length=length)
    speed = 0.25 * one if state.speed is None else state.speed
    speeds = tuple(float(froude) / _TOP * _top(speed / one) * one for froude in FROUDE)
    told = told_of(state, length)
    return SeaScene(known, loaded_ship(state, known), sea_of(state, told), told, speed, state.heading, speeds)


def _top(froude: float) -> float:
    """Froude number at which a map ends that shows one.

    >>> _top(0.25), _top(0.3)
    (0.24, 0.32)
    """
    return max(_TOP, round(math.ceil((froude - _MARGIN) / _FURTHER) * _FURTHER, 10))


def response(of: SeaScene) -> xr.Dataset:
    """The response at the chosen speed and heading, by statistical linearisation."""
    return sea_response(of.ship, of.sea, of.speed, method="closure")


def advice(state: State, of: SeaScene) -> Advice:
    """What guidance says of the chosen speed and heading, judged as the map is."""
    return Advice(int(evaluated(_grid(state, of, [of.speed], [of.heading]))["recommended"].item()))


def map_grid(state: State, of: SeaScene) -> SeaGrid:
    """The grid of the map, in blocks of half a speed."""
    blocks = _grid(state, of, of.speeds, HEADINGS).in_blocks_of(math.ceil(HEADINGS.size / HALVES))
    assert isinstance(blocks, SeaGrid)
    return blocks


def _grid(state: State, of: SeaScene, speeds: ArrayLike, headings: ArrayLike) -> SeaGrid:
    """Some speeds and headings in the sea of a state."""
    hs, tp, tz = of.told["hs"], of.told.get("tp"), of.told.get("tz")
    told = SeaSettings(spectrum=state.spectrum, spreading=told_spreading(state.spreading))
    return sea_grid(of.ship, speeds, headings, hs, tp, tz, settings=told)


def map_pieces(state: State, of: SeaScene) -> Iterator[tuple[int, xr.Dataset]]:
    """The map, a piece of work at a time: conditions done, and the map so far."""
    return in_pieces(map_grid(state, of), HALVES)


def of_sea_map(state: State, of: SeaScene) -> tuple[State, float]:
    """What of a state the map of a sea depends on."""
    of_waves = {"wave_length": None, "wave_height": None, "steepness": 1 / 30, "harmonics": 1, "over": "wave_height"}
    rest = {"heading": 0.0, "speed": None, "panel": "response", **of_waves}
    return state.model_copy(update=rest), of.speeds[-1]

"""What a page asks of the library for an irregular sea: ship and sea of a state, the response, the map in pieces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.loads.sea.sea import Sea
from quartering.study.loadings import loaded
from quartering.study.maps.sweep import in_pieces
from quartering.study.seas.grid import SeaGrid, sea_grid
from quartering.study.seas.response import sea_response
from quartering.units import quantity
from quartering.view.explorer.computations import HEADINGS
from quartering.view.explorer.sea_state import sea_of, told_of, told_spreading
from quartering.view.explorer.ship_registry import Known
from quartering.view.explorer.state import LOADING, State

FROUDE: Final = np.round(np.linspace(0.0, 0.24, 7), 10)
"""Speeds of the map as Froude numbers: those of `quartering polar --hs`."""
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
    own = known.ship
    changes = {name: number(own, name, value) for name in LOADING if (value := getattr(state, name)) is not None}
    one = quantity("1 Fn", "speed", length=own.hull.length)
    speed = 0.25 * one if state.speed is None else state.speed
    speeds = tuple(float(froude) * one for froude in FROUDE)
    told = told_of(state, own.hull.length)
    return SeaScene(known, loaded(own, changes), sea_of(state, told), told, speed, state.heading, speeds)


def response(of: SeaScene) -> xr.Dataset:
    """The response at the chosen speed and heading, by statistical linearisation."""
    return sea_response(of.ship, of.sea, of.speed, method="closure")


def map_grid(state: State, of: SeaScene) -> SeaGrid:
    """The grid of the map, in blocks of half a speed."""
    hs, tp, tz = of.told["hs"], of.told.get("tp"), of.told.get("tz")
    spreading = told_spreading(state.spreading)
    made = sea_grid(of.ship, list(of.speeds), HEADINGS, hs, tp, tz, spectrum=state.spectrum, spreading=spreading)
    blocks = made.in_blocks_of(math.ceil(HEADINGS.size / HALVES))
    assert isinstance(blocks, SeaGrid)
    return blocks


def map_pieces(state: State, of: SeaScene) -> Iterator[tuple[int, xr.Dataset]]:
    """The map, a piece of work at a time: conditions done, and the map so far."""
    return in_pieces(map_grid(state, of), HALVES)


def of_sea_map(state: State) -> State:
    """The part of a state the map of a sea depends on."""
    of_waves = {"wave_length": None, "wave_height": None, "steepness": 1 / 30, "harmonics": 1, "over": "wave_height"}
    return state.model_copy(update={"heading": 0.0, "speed": None, "panel": "response", **of_waves})

"""What the browser draws of a ship itself: its form, and the ship moving in its wave."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from nicegui.element import Element

from quartering.hull.ship import Ship
from quartering.loads.waves import encounter_frequency, heading_components
from quartering.study.condition.examine import Examined
from quartering.view.explorer.computing.computations import History
from quartering.view.moves import Moves, moves_of, pace_of
from quartering.view.ship_shape import Shape, shape_of

_SAMPLES = 120
"""Moments of one round of a steady motion."""
_BELOW, _ABOVE, _STATIONS = 8, 4, 31
"""Points of a section below and above the water, and stations of the form: few enough to be turned by hand."""


class Drawn(NamedTuple):
    """A part of a panel that a component of our own draws: which, and its properties."""

    component: type[Element]
    props: dict[str, Any]


class ShipInWave(Element, component="ship_in_wave.js"):
    """The ship moving in its wave."""


class HullForm(Element, component="hull_form.js"):
    """The hull in three dimensions."""


def hull_form(ship: Ship) -> Drawn:
    """The form of a hull, to be turned."""
    shape = shape_of(ship)
    stations = np.unique(np.linspace(0, shape.surface.shape[0] - 1, _STATIONS).round().astype(int))
    facets = np.array([_cut_at_water(shape.surface[i], shape.water) for i in stations]).round(3)
    words = f"{ship.name} in three dimensions, blue below the calm water; arrow keys turn it"
    return Drawn(HullForm, {"surface": facets.tolist(), "water": round(shape.water, 3), "label": words})


def _cut_at_water(section: np.ndarray, water: float) -> np.ndarray:
    """Points of a half section (n, 3), keel to deck, so many of them below the water, one on it."""
    under = int((section[:, 2] < water).sum())
    place = float(under)  # of the waterline among the points
    if 0 < under < len(section):
        low, high = section[under - 1, 2], section[under, 2]
        place = under - 1 + (water - low) / (high - low)
    last = len(section) - 1.0
    at = np.concatenate(
        [np.linspace(0.0, min(place, last), _BELOW), np.linspace(min(place, last), last, _ABOVE + 1)[1:]]
    )
    return np.stack([np.interp(at, np.arange(len(section)), column) for column in section.T], axis=1)


def ship_in_wave(found: Examined, past: History) -> Drawn:
    """The steady motion over one round, or, where there is none, how the ship let go moves."""
    shape, wave = shape_of(found.ship), found.wave
    k1, k2 = (float(wave.wavenumber * part) for part in heading_components(found.heading))
    period = 2 * math.pi / found.model.frequency
    moves = _steady(found) if found.motion.status.ok else moves_of(past.trace, period)
    scene = _plain(shape) | {name: np.round(values, 5).tolist() for name, values in moves._asdict().items()}
    scene |= {
        "k1": k1, "k2": k2, "omega": float(encounter_frequency(wave.frequency, found.speed, found.heading)),
        "amplitude": wave.amplitude, "beam": found.ship.hull.beam, "length": found.ship.hull.length, "pace": pace_of(period),
        "tall": max(float(np.ptp(shape.surface[..., 2])), 2 * wave.amplitude),
    }  # fmt: skip
    what = "steady motion" if found.motion.status.ok else "the ship let go in the wave"
    words = (
        f"{found.ship.name} from aft and from above, {what}, roll up to {math.degrees(np.abs(moves.roll).max()):.3g} degrees;"
        " space plays and pauses, left and right step, up and down change the pace"
    )
    return Drawn(ShipInWave, {"scene": scene, "label": words})


def _steady(found: Examined) -> Moves:
    """One round of the steady motion: sway and yaw about their mean."""
    motion = found.motion
    time = np.arange(_SAMPLES) / _SAMPLES * motion.periods * 2 * math.pi / found.model.frequency
    phase = time[:, None] * motion.frequency * np.array(motion.orders, dtype=float)
    position = np.cos(phase) @ motion.cos + np.sin(phase) @ motion.sin
    still = np.zeros_like(time)
    return Moves(time, position[:, 1] + motion.mean[1], position[:, 0], position[:, 2], still, still)


def _plain(shape: Shape) -> dict[str, Any]:
    """Outlines of a ship for the browser."""
    return {
        "deck": shape.deck.round(2).tolist(), "waterline": shape.waterline.round(2).tolist(),
        "sections": [section[::2].round(2).tolist() for section in shape.sections], "water": shape.water,
    }  # fmt: skip

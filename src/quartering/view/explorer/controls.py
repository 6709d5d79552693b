"""The dials of a page: which there are, on which scales, and what turning one changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.units import quantity
from quartering.view.explorer.answers import Scene
from quartering.view.explorer.damping_dials import DampingDials
from quartering.view.explorer.dials import Dial, Scale, plain
from quartering.view.explorer.state import LOADING, State

_METHODS = {1: "the paper's method", 3: "balance of 3 harmonics", 5: "balance of 5", 7: "balance of 7"}
Change = Callable[..., None]


class Controls:
    """Condition, sea and loading; each dial changes the state by name."""

    def __init__(self, change: Change) -> None:
        self._length = 1.0
        ui.label("Course").classes("group")
        self._heading = Dial("heading", lambda value, _: change(heading=round(value, 3)))
        self._speed = Dial("speed", lambda value, _: change(speed=value))
        ui.label("Sea").classes("group")
        self._wave_length = Dial("wave_length", lambda value, _: change(wave_length=value))
        self._height = Dial("wave_height", lambda value, at: change(**self._sea(value, at)))
        self._wave = 1.0
        ui.label("Loading").classes("group")
        self._gm = Dial("gm", lambda value, _: change(gm=value))
        self._roll = Dial("gyradius_roll", lambda value, _: change(gyradius_roll=value))
        self._yaw = Dial("gyradius_yaw", lambda value, _: change(gyradius_yaw=value))
        ui.label("Roll damping").classes("group")
        self._damping = DampingDials(change)
        self._own = ui.button("the ship's own loading", on_click=lambda: change(**dict.fromkeys(LOADING)))
        self._own.props("flat dense no-caps").classes("dial-unit")
        ui.label("Steady motion").classes("group")
        self._method = ui.select(_METHODS, value=1, on_change=lambda event: change(harmonics=event.value))
        self._method.props('dense options-dense borderless aria-label="steady motion by"')

    def _sea(self, height: float, at: int) -> dict[str, Any]:
        """A height for all waves of the map, or a steepness."""
        if at == 0:
            return {"wave_height": height, "steepness": None}
        return {"steepness": height / self._wave, "wave_height": None}

    def show(self, of: Scene, state: State, damping: str) -> None:
        """Set every dial to a scene; `damping` says what the roll damping amounts to."""
        hull, load = of.ship.hull, of.ship.loading
        length, beam, km = hull.length, hull.beam, hydrostatics(hull).km
        self._wave = of.wave.length
        self._heading.show(of.heading, [plain("heading", "deg", 0, 180, 1)])
        self._speed.show(of.speed, _speeds(length))
        self._wave_length.show(of.wave.length, [
            plain("wave length", "m", 0.3 * length, 3 * length, 1), plain("wave length", "L", 0.3, 3.0, 0.05, 1 / length),
        ])  # fmt: skip
        self._height.show(of.wave.height, [
            plain("wave height", "m", 0.1, round(0.08 * length, 1), 0.1),
            plain("steepness", "H/λ", 0.005, 0.1, 0.001, 1 / of.wave.length),
        ], 1 if state.wave_height is None else 0)  # fmt: skip
        top = max(0.15 * beam, 1.5 * load.gm)
        self._gm.show(load.gm, [
            plain("GM", "m", 0.01 * beam, top, 0.01),
            Scale("KG", "m", km - top, km - 0.01 * beam, 0.01, lambda gm: km - gm, lambda kg: km - kg),
        ])  # fmt: skip
        self._roll.show(load.gyradius_roll, [
            plain("roll gyradius", "m", 0.25 * beam, 0.5 * beam, 0.01), plain("roll gyradius", "B", 0.25, 0.5, 0.005, 1 / beam),
        ])  # fmt: skip
        self._yaw.show(load.gyradius_yaw, [
            plain("yaw gyradius", "m", 0.15 * length, 0.35 * length, 0.1),
            plain("yaw gyradius", "L", 0.15, 0.35, 0.005, 1 / length),
        ])  # fmt: skip
        self._damping.show(of, state, damping)
        self._own.set_visibility(any(getattr(state, name) is not None for name in LOADING))
        self._method.set_value(state.harmonics)


def _speeds(length: float) -> list[Scale]:
    """Speed in m/s, knots and as Froude number, up to Fn 0.5."""
    one, knot = quantity("1 Fn", "speed", length=length), quantity("1 kn", "speed")
    top = 0.5 * one
    return [
        plain("speed", "m/s", 0, top, 0.1),
        plain("speed", "kn", 0, top / knot, 0.1, 1 / knot),
        plain("speed", "Fn", 0, 0.5, 0.005, 1 / one),
    ]

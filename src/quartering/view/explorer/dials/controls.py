"""The dials of a page: which there are, on which scales, and what turning one changes."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial
from typing import Any

from nicegui import ui

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.ship import Ship
from quartering.options import OPTIONS
from quartering.study.loadings import user_value
from quartering.units import quantity
from quartering.view.explorer.computing.computations import Scene
from quartering.view.explorer.dials.damping_dials import DampingDials
from quartering.view.explorer.dials.dials import Dial, Scale, plain, scales_of
from quartering.view.explorer.sea.sea_dials import SeaDials
from quartering.view.explorer.sea.sea_scene import SeaScene
from quartering.view.explorer.state import DIALS, LOADING, State

_MODES = {"wave": "wave", "sea": "sea"}
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
        self._mode = ui.toggle(_MODES, value="wave", on_change=lambda event: change(mode=event.value))
        self._mode.classes("choices q-mode").props(
            'dense unelevated toggle-color=chosen toggle-text-color=on-chosen no-caps aria-label="wave or sea"'
        ).mark("mode")
        self._sea_dials = SeaDials(change)
        with ui.element("div") as self._of_wave:
            self._wave_length = Dial("wave_length", lambda value, _: change(wave_length=value))
            self._height = Dial("wave_height", lambda value, at: change(**self._sea(value, at)))
        self._wave = 1.0
        ui.label("Loading").classes("group")
        self._dials = {
            one.name: Dial(one.name, partial(_turn, change, one.name)) for one in DIALS if one.title == "Loading"
        }
        ui.label("Roll damping").classes("group")
        self._damping = DampingDials(change)
        self._own = ui.button("the ship's own loading", color=None, on_click=lambda: change(**dict.fromkeys(LOADING)))
        self._own.props("flat dense no-caps").classes("dial-unit")
        with ui.element("div") as self._of_motion:
            ui.label("Steady motion").classes("group")
            self._method = ui.select(_METHODS, value=1, on_change=lambda event: change(harmonics=event.value))
            self._method.props('dense options-dense borderless aria-label="steady motion by"')

    def refuse(self, names: Collection[str]) -> None:
        """Mark the dials of values that cannot be, and no other."""
        dials = {"heading": self._heading, "speed": self._speed, "wave_length": self._wave_length, **self._dials}
        for name, dial in (dials | self._damping.dials | self._sea_dials.dials).items():
            dial.refuse(name in names)
        self._height.refuse(bool({"wave_height", "steepness"} & set(names)))

    def _sea(self, height: float, at: int) -> dict[str, Any]:
        """A height for all waves of the map, or a steepness."""
        if at == 0:
            return {"wave_height": height, "steepness": None}
        return {"steepness": height / self._wave, "wave_height": None}

    def show(self, of: Scene | SeaScene, state: State, damping: str) -> None:
        """Set every dial to a scene; `damping` says what the roll damping amounts to."""
        in_sea = isinstance(of, SeaScene)
        self._mode.set_value(state.mode)
        self._sea_dials.box.set_visibility(in_sea)
        self._of_wave.set_visibility(not in_sea)
        self._of_motion.set_visibility(not in_sea)
        self._heading.show(of.heading, [plain("heading", "deg", 0, 180, 1)])
        self._speed.show(of.speed, _speeds(of.ship.hull.length))
        if isinstance(of, SeaScene):
            self._sea_dials.show(of, state)
        else:
            self._show_wave(of, state)
        self._show_loading(of.ship)
        self._damping.show(of, state, damping)
        self._own.set_visibility(any(getattr(state, name) is not None for name in LOADING))
        self._method.set_value(state.harmonics)

    def _show_wave(self, of: Scene, state: State) -> None:
        length = of.ship.hull.length
        self._wave = of.wave.length
        self._wave_length.show(of.wave.length, [
            plain("wave length", "m", 0.3 * length, 3 * length, 1), plain("wave length", "L", 0.3, 3.0, 0.05, 1 / length),
        ])  # fmt: skip
        self._height.show(of.wave.height, [
            plain("wave height", "m", 0.1, round(0.08 * length, 1), 0.1),
            plain("steepness", "H/λ", 0.005, 0.1, 0.001, 1 / of.wave.length),
        ], 1 if state.wave_height is None else 0)  # fmt: skip

    def _show_loading(self, one: Ship) -> None:
        km = hydrostatics(one.hull).km
        for name, dial in self._dials.items():
            scales = scales_of(OPTIONS[name], one)
            if name == "gm":  # as far as half as much again, and read as KG too
                top = max(scales[0].high, 1.5 * one.loading.gm)
                low = scales[0].low
                kg = Scale("KG", "m", km - top, km - low, 0.01, lambda gm: km - gm, lambda kg: km - kg)
                scales = [scales[0]._replace(high=top), kg]
            dial.show(user_value(one, name), scales)


def _turn(change: Change, name: str, value: float, _: int) -> None:
    """Change one value of the loading."""
    change(**{name: value})


def _speeds(length: float) -> list[Scale]:
    """Speed in m/s, knots and as Froude number, up to Fn 0.5."""
    one, knot = quantity("1 Fn", "speed", length=length), quantity("1 kn", "speed")
    top = 0.5 * one
    return [
        plain("speed", "m/s", 0, top, 0.1),
        plain("speed", "kn", 0, top / knot, 0.1, 1 / knot),
        plain("speed", "Fn", 0, 0.5, 0.005, 1 / one),
    ]

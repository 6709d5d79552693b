"""The dials of roll damping: a fraction of critical, or bilge keels and what Ikeda's components make of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from quartering.hull.ship import Ship
from quartering.hydro.damping.method import AMPLITUDE
from quartering.hydro.damping.of_ship import equivalent_fraction
from quartering.options import OPTIONS
from quartering.study.loadings import KEEL_AXES, user_value
from quartering.view.explorer.computing.computations import Scene
from quartering.view.explorer.dials.dials import Dial, scales_of
from quartering.view.explorer.sea.sea_scene import SeaScene
from quartering.view.explorer.state import State

_WAYS = {"fraction": "per cent of critical", "components": "bilge keels, by Ikeda"}
_USUAL_LENGTH, _USUAL_BREADTH, _USUAL_FRACTION = 0.25, 0.02, 0.05
_HINTS = {
    "fraction": "of critical; stands for viscosity and bilge keels",
    "ikeda": "Ikeda's components of the hull and a pair of keels at round bilges: {percent:.3g} % of critical at {amplitude:g}°"
    " of roll and this speed, within 30 %",
    "ikeda-simplified": "regression on Ikeda's components, a pair of keels at round bilges: {percent:.3g} % of critical at"
    " {amplitude:g}° of roll and this speed, within 30 %",
}
_AMOUNT = "{percent:.3g} % of critical at {amplitude:g}° of roll and this speed"


class DampingDials:
    """The choice between the two ways, and the dials of the one chosen."""

    def __init__(self, change: Callable[..., None]) -> None:
        self._change = change
        self._own: Ship | None = None
        self._keels = (1.0, 0.0)
        self._quiet = False
        self._way = ui.select(_WAYS, value="fraction", on_change=lambda event: self._choose(event.value))
        self._way.props('dense options-dense borderless aria-label="roll damping as"').classes("choice").mark("damping")
        with ui.element("div") as self._of_fraction:
            self._fraction = Dial("roll_damping", lambda value, _: change(roll_damping=value))
        with ui.element("div") as self._of_keels:
            self._length = Dial("bilge_keel_length", lambda value, _: self._fit(value, self._keels[1]))
            self._breadth = Dial("bilge_keel_breadth", lambda value, _: self._fit(self._keels[0], value))
        self._hint = ui.label("").classes("hint").mark("damping-hint")

    @property
    def dials(self) -> dict[str, Dial]:
        """The dials by what they change."""
        return dict(zip(("roll_damping", *KEEL_AXES), (self._fraction, self._length, self._breadth), strict=True))

    def _fit(self, length: float, breadth: float) -> None:
        self._keels = (length, breadth)
        self._change(roll_damping=None, **dict(zip(KEEL_AXES, self._keels, strict=True)))

    def _choose(self, way: str) -> None:
        """The ship's own values where it has that way itself, else the usual ones."""
        own = self._own
        if self._quiet or own is None:
            return
        values: dict[str, Any] = dict.fromkeys(("roll_damping", *KEEL_AXES))
        if way == "fraction" and own.damped_by_components:
            values["roll_damping"] = _USUAL_FRACTION
        elif way == "components" and not own.damped_by_components:
            values |= dict(zip(KEEL_AXES, _sizes(own), strict=True))
        self._change(**values)

    def show(self, of: Scene | SeaScene, state: State, hint: str) -> None:
        """Set the choice and the dials to a scene."""
        ship, self._own = of.ship, of.known.ship
        by_fraction = not ship.damped_by_components
        self._quiet = True
        self._way.set_value("fraction" if by_fraction else "components")
        self._quiet = False
        self._of_fraction.set_visibility(by_fraction)
        self._of_keels.set_visibility(not by_fraction)
        self._hint.set_text(hint)
        if by_fraction:
            self._fraction.show(ship.loading.roll_damping, scales_of(OPTIONS["roll_damping"], ship))
            return
        given = tuple(getattr(state, name) for name in KEEL_AXES)
        self._keels = _shown(ship) if None in given else given
        for dial, size, name in zip((self._length, self._breadth), self._keels, KEEL_AXES, strict=True):
            dial.show(size, scales_of(OPTIONS[name], ship))


def damping_hint(of: Scene | SeaScene) -> str:
    """What the numbers of the roll damping mean, and what the components amount to."""
    words = _HINTS.get(of.ship.roll_method, _AMOUNT)
    if not of.ship.damped_by_components:
        return words
    said = words.format(percent=100 * equivalent_fraction(of.ship, of.speed), amplitude=AMPLITUDE)
    return said if of.ship.measured is None else f"{said}; of this and what the measured set has, the larger counts"


def _sizes(ship: Ship) -> tuple[float, float]:
    """Keels of the ship, else usual ones [m]."""
    return ship.bilge_keels or (_USUAL_LENGTH * ship.hull.length, _USUAL_BREADTH * ship.hull.beam)


def _shown(ship: Ship) -> tuple[float, float]:
    """Keels of a ship that goes by components already: of none, the length to begin from."""
    return _sizes(ship)[0], user_value(ship, KEEL_AXES[1])

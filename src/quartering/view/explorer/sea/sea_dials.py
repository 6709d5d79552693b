"""The dials of an irregular sea: height, period, spectrum, spreading."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from nicegui import ui

from quartering.view.explorer.dials.dials import Dial, plain
from quartering.view.explorer.sea.sea_scene import SeaScene
from quartering.view.explorer.sea.sea_state import PERIODS, SPECTRA, SPREADINGS
from quartering.view.explorer.state import State

_HIGHEST: Final = 12.0
_LONGEST: Final = 20.0
"""Ends of the sliders; what the table allows beyond them is typed."""


class SeaDials:
    """Four controls, each of which changes the state by name."""

    def __init__(self, change: Callable[..., None]) -> None:
        self._change, self._of = change, {"tp": 0.0, "tz": 0.0}
        self._own_period, self._quiet = False, False
        with ui.element("div") as self.box:
            self._height = Dial("hs", lambda value, _: change(hs=value, **self._kept()))
            self._period = Dial("period", lambda value, at: change(**self._told(value, at)))
            self._spectrum = ui.select(SPECTRA, value="jonswap", on_change=lambda event: self._choose(event.value))
            self._spectrum.props('dense options-dense borderless aria-label="spectrum"').mark("spectrum")
            self._spreading = ui.select(SPREADINGS, value="none", on_change=lambda event: self._spread(event.value))
            self._spreading.props('dense options-dense borderless aria-label="spreading"').mark("spreading")

    @property
    def dials(self) -> dict[str, Dial]:
        """The dials by what they change."""
        return {"hs": self._height, "tp": self._period, "tz": self._period}

    def _kept(self) -> dict[str, Any]:
        """The period that was chosen for the ship, kept when another height is turned to."""
        return {} if self._own_period else {"tp": self._of["tp"]}

    def _told(self, value: float, at: int) -> dict[str, Any]:
        """A period of the peak, or the mean one that goes with it; the dial holds that of the peak."""
        periods = (value, value * self._of["tz"] / self._of["tp"])
        return {name: periods[i] if i == at else None for i, name in enumerate(PERIODS)}

    def _choose(self, name: str) -> None:
        if not self._quiet:  # of two peaks no mean period tells the one
            self._change(spectrum=name, **({"tp": self._of["tp"], "tz": None} if name == "torsethaugen" else {}))

    def _spread(self, name: str) -> None:
        if not self._quiet:
            self._change(spreading=name)

    def show(self, of: SeaScene, state: State) -> None:
        """Set every control to a scene."""
        peak = of.told.get("tp", of.sea.tp)
        self._of = {"tp": peak, "tz": of.sea.tz}
        self._own_period = state.tp is not None or state.tz is not None
        ratio = of.sea.tz / peak
        scales = [
            plain("Tp", "s, peak", 2.0, _LONGEST, 0.1),
            plain("Tz", "s, mean", 2.0 * ratio, _LONGEST * ratio, 0.1, ratio),
        ]
        self._height.show(of.told["hs"], [plain("Hs", "m", 0.1, _HIGHEST, 0.1)])
        several = 1 if state.spectrum == "torsethaugen" else 2
        self._period.show(peak, scales[:several], 0 if state.tz is None else 1)
        self._quiet = True
        self._spectrum.set_value(state.spectrum)
        known = (
            SPREADINGS if state.spreading in SPREADINGS else {**SPREADINGS, state.spreading: f"s = {state.spreading}"}
        )
        self._spreading.set_options(known, value=state.spreading)
        self._quiet = False

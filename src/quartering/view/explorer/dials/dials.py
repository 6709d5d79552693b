"""Dials: a number and a slider for one value, in the unit its reader prefers."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from nicegui import ui
from nicegui.events import ValueChangeEventArguments

from quartering.hull.ship import Ship
from quartering.option_checks import Option
from quartering.units import Kind, quantity


class Scale(NamedTuple):
    """One way to read a value.

    Parameters
    ----------
    name : str               what is read, such as "GM"
    unit : str
    low, high, step : float  of the slider, in this unit
    typed : function         from SI to this unit
    meant : function         from this unit to SI
    """

    name: str
    unit: str
    low: float
    high: float
    step: float
    typed: Callable[[float], float]
    meant: Callable[[float], float]


def plain(name: str, unit: str, low: float, high: float, step: float, factor: float = 1.0) -> Scale:
    """A scale whose value is a factor times the SI value."""
    return Scale(name, unit, low, high, step, lambda si: si * factor, lambda typed: typed / factor)


def scales_of(one: Option, of: Ship) -> list[Scale]:
    """The scales of an option's dial for a ship: those the table gives, else one over its range."""
    kind: Kind = "ratio" if one.kind == "steepness" else one.kind  # type: ignore[assignment]
    rows = one.dial if one.dial is not None else ((one.unit, one.low, one.high, 0.0),)
    found = []
    for unit, low, high, step in rows:
        factor = 1.0 / quantity(f"1 {unit}" if unit not in ("1", "") else 1.0, kind, **of.sizes._asdict())
        ends = [
            factor * quantity(end, kind, **of.sizes._asdict()) if isinstance(end, str) else float(end or 0.0)
            for end in (low, high)
        ]
        words, low, high = one.label or one.name.replace("_", " "), *ends
        found.append(plain(words, unit, low, high, step or (high - low) / 100, factor))
    return found


def _ends(scale: Scale) -> tuple[tuple[Callable[[float], int], float], ...]:
    """The limits of a scale, each with the way it is rounded to whole steps."""
    return (math.ceil, scale.low), (math.floor, scale.high)


class Dial:
    """Label, number, unit and slider; a click on the unit reads the value in the next one.

    Parameters
    ----------
    key : str                      names the controls, for people who test or automate
    turned : function(value, scale)    called with the value in SI and the index of the scale it was set on
    """

    def __init__(self, key: str, turned: Callable[[float, int], None]) -> None:
        self._turned, self._at, self._quiet = turned, 0, False
        self._scales: Sequence[Scale] = ()
        self._value = 0.0
        with ui.element("div").classes("dial") as self._box:
            self._label = ui.element("label").classes("dial-name").props(f"for=number-{key}")
            with self._label:
                self._name = ui.label("")
            self._number = ui.number(on_change=self._moved).props(
                f'id=number-{key} for=number-{key} dense borderless hide-bottom-space debounce=250 input-class="dial-number"'
            )
            self._unit = ui.button("", color=None, on_click=self._next).props("flat dense no-caps").classes("dial-unit")
            self._unit.props(f'aria-label="unit of {key.replace("_", " ")}"')
            self._slider = ui.slider(min=0, max=1, on_change=self._moved).classes("dial-slider")
            self._slider.props(f'id=slider-{key} aria-label="{key.replace("_", " ")}" dense')

    def show(self, value: float, scales: Sequence[Scale], at: int | None = None) -> None:
        """Show a value [SI] on one of some scales, without triggering callbacks."""
        self._scales, self._value = scales, value
        self._at = min(self._at if at is None else at, len(scales) - 1)
        scale = scales[self._at]
        typed = scale.typed(value)
        self._quiet = True
        try:
            self._name.set_text(scale.name)
            self._unit.set_text(scale.unit)
            self._unit.set_enabled(len(scales) > 1)
            low, high = (round(end(limit / scale.step) * scale.step, 6) for end, limit in _ends(scale))
            for name, limit in (("min", low), ("max", high), ("step", scale.step)):
                self._slider.props[name] = limit
            self._number.props["step"] = scale.step
            self._slider.set_value(min(max(typed, low), high))
            self._number.set_value(float(f"{typed:.4g}"))
            self._tell(typed)
        finally:
            self._quiet = False

    def refuse(self, refused: bool) -> None:
        """Mark the value that stands there as one that cannot be, or take the mark away."""
        marks = "error aria-invalid=true"
        self._number.props(marks if refused else "", remove="" if refused else "error aria-invalid")
        self._box.classes("refused" if refused else "", remove="" if refused else "refused")

    def _tell(self, typed: float) -> None:
        """Name the slider's value with its unit, for those who hear it."""
        scale = self._scales[self._at]
        unit = "" if scale.unit in ("", "1") else f" {scale.unit}"
        self._slider.props["aria-label"] = scale.name
        self._slider.props["aria-valuetext"] = f"{typed:.4g}{unit}"

    def _moved(self, event: ValueChangeEventArguments[float | None]) -> None:
        if self._quiet or event.value is None:
            return
        value = self._scales[self._at].meant(float(event.value))
        if abs(value - self._value) <= 1e-4 * abs(self._value):
            return
        self._value = value
        self._quiet = True
        if event.sender is self._slider:
            self._number.set_value(float(f"{event.value:.4g}"))
        else:
            self._slider.set_value(event.value)
        self._quiet = False
        self._tell(float(event.value))
        self._turned(value, self._at)

    def _next(self) -> None:
        at = (self._at + 1) % len(self._scales)
        self.show(self._value, self._scales, at)
        self._turned(self._value, at)

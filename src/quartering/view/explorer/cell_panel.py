"""The chosen condition at the right of the page: its motion, its judges, its curve, its causes, and the hull."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from nicegui import ui
from nicegui.element import Element

from quartering.conventions import InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.motion.steady.motion import advice
from quartering.stability.verdict import Verdict
from quartering.study.condition.examine import Examined, estimated
from quartering.view.explorer import charts
from quartering.view.explorer.animation import Drawn, hull_form, ship_in_wave
from quartering.view.explorer.comparison.compare_panel import ComparePanel
from quartering.view.explorer.computing.computations import History, Scene, causes, curve, history
from quartering.view.explorer.criteria_panel import CriteriaPanel
from quartering.view.explorer.state import OF_SEA, OF_WAVE, State
from quartering.view.wording import estimated_words, exponents_words

Part = str | charts.Chart | Drawn
"""Text (HTML), a figure, or what a component of our own draws."""

_TABS = {
    "motion": "Motion", "stability": "Stability", "curve": "Curve", "causes": "Causes", "response": "Response", "hull": "Hull",
    "criteria": "Criteria", "compare": "Compare",
}  # fmt: skip
_OVER = {"wave_height": "height", "wave_length": "length", "speed": "speed", "frequency": "frequency"}


_LEVEL = (
    "<p class='hint'>To scale. Heave and pitch are not in these equations: the ship is drawn at its mean level."
    " Dark water: trough, light: crest.</p>"
)


class CellPanel:
    """Tabs, of which the one in front is kept up to date."""

    def __init__(self, change: Callable[..., None], compare: Callable[[], ComparePanel]) -> None:
        self._made: dict[str, list[Element]] = {name: [] for name in _TABS}
        self._area: dict[str, ui.element] = {}
        self._tabs = (
            ui.tabs(on_change=lambda event: change(panel=event.value)).classes("tabs").props("dense align=left")
        )
        with self._tabs:
            self._tab = {name: ui.tab(name, words) for name, words in _TABS.items()}
        with ui.tab_panels(self._tabs, animated=False).classes("w-full bg-transparent"):
            for name in _TABS:
                with ui.tab_panel(name).classes("p-0"):
                    if name == "curve":
                        self._over = ui.toggle(_OVER, on_change=lambda event: change(over=event.value))
                        self._over.classes("choices").props(
                            'dense unelevated toggle-color=chosen toggle-text-color=on-chosen aria-label="curve over"'
                        )
                    self._area[name] = ui.element("div").classes("w-full")
                    if name == "criteria":
                        with self._area[name]:
                            self.criteria = CriteriaPanel()
                    if name == "compare":
                        self.compare: ComparePanel = compare()

    def front(self, state: State) -> None:
        """Show the tabs of a state's mode, and bring its own to the front."""
        for name in (*OF_WAVE, *OF_SEA):
            self._tab[name].set_visibility(name in (OF_SEA if state.mode == "sea" else OF_WAVE))
        self._tabs.set_value(state.panel)
        self._over.set_value(state.over)

    def show(self, panel: str, parts: Sequence[Part]) -> None:
        """Fill a tab; figures that are there already are changed, not made anew."""
        made = self._made[panel]
        if [_element_of(part) for part in parts] != [type(one) for one in made]:
            self._area[panel].clear()
            with self._area[panel]:
                made[:] = [_made_of(part) for part in parts]
            return
        for one, part in zip(made, parts, strict=True):
            if isinstance(part, Drawn):
                for name, value in part.props.items():
                    one.props[name] = value
            elif isinstance(one, ui.html):
                one.set_content(str(part))
            elif isinstance(one, ui.plotly):
                one.update_figure(part)


def _element_of(part: Part) -> type[Element]:
    """The element that shows a part."""
    return part.component if isinstance(part, Drawn) else ui.html if isinstance(part, str) else ui.plotly


def _made_of(part: Part) -> Element:
    """A new element for a part."""
    if isinstance(part, Drawn):
        element = part.component()
        for name, value in part.props.items():
            element.props[name] = value
        return element
    return ui.html(part, sanitize=False) if isinstance(part, str) else ui.plotly(part)


def parts(state: State, of: Scene, found: Examined) -> list[Part]:
    """What the tab of a state shows; computed in the thread that has the turn."""
    make: dict[str, Callable[[], list[Part]]] = {
        "motion": lambda: _motion(found),
        "stability": lambda: _stability(of, found),
        "curve": lambda: _curve(state, of, found),
        "causes": lambda: _causes(of),
        "hull": lambda: hull_parts(of.ship, estimated(found)),
    }
    if state.panel not in make:  # what compares waits for the map
        return []
    try:
        return make[state.panel]()
    except InputError as error:
        return [f"<p>{html.escape(str(error))}</p>"]


def _motion(found: Examined) -> list[Part]:
    motion = found.motion
    past = history(found)
    if not motion.status.ok:
        words = f"<p>No steady motion: {html.escape(advice(motion, found.model.capsize_limit))}.</p>"
        return [
            words,
            ship_in_wave(found, past),
            _LEVEL,
            "<h2>Roll in time</h2>",
            charts.time_history(past),
            _end(past, found),
        ]
    sway, roll, yaw = motion.amplitude
    period = 2 * math.pi / found.model.frequency
    words = (
        f"<p><b>Largest roll {math.degrees(motion.peak[1]):.3g}°</b> over a cycle; amplitudes of the fundamental: roll"
        f" {math.degrees(roll):.3g}°, sway {sway:.3g} m, yaw {math.degrees(yaw):.3g}°; the ship meets"
        f" a wave every {period:.3g} s, its own small roll takes"
        f" {2 * math.pi / _roll_frequency(found):.3g} s.</p>"
    )
    sizes = np.hypot(motion.cos, motion.sin)
    return [
        "<h2>The ship in the wave</h2>", ship_in_wave(found, past), _LEVEL,
        "<h2>Roll in time</h2>", charts.time_history(past),
        f"{_end(past, found)}<h2>Harmonics of the steady motion</h2>", charts.harmonics(motion.orders, sizes), words,
    ]  # fmt: skip


def _end(past: History, found: Examined) -> str:
    """How the time history ends, and what it means when that is not what the verdict says."""
    at = past.trace.attrs.get("capsize_time")
    if at is None:
        return "<p class='hint'>A stable motion takes the push back; an unstable one leaves its dotted line.</p>"
    rolled = f"<p><b>Capsizes after {at:.3g} s</b> (roll past {found.model.capsize_limit.words})."
    if not found.verdict.stable:
        return f"{rolled}</p>"
    return (
        f"{rolled} The verdict is on smaller disturbances, of the motion as {found.motion.method} with harmonics up to"
        f" {max(found.motion.orders)} finds it: here either the push is too large or the harmonics are too few. Compare with"
        " more of them.</p>"
    )


def _roll_frequency(found: Examined) -> float:
    from quartering.hydro.coefficients import coefficients

    return float(coefficients(found.ship, 0.0, 0.0).roll_frequency)


def _stability(of: Scene, found: Examined) -> list[Part]:
    if not found.motion.status.ok:
        return [f"<p>No motion to judge: {html.escape(advice(found.motion, found.model.capsize_limit))}.</p>"]
    calm = calm_water_exponents(of.ship, of.speed)
    return [
        judges(found.verdict, calm),
        "<h2>Floquet multipliers over one period</h2>",
        charts.unit_circle(found.verdict),
    ]


def judges(v: Verdict, calm: Any) -> str:
    """Table of every judge: what it computes, its number, and what it says."""
    q = max((full for _, full in v.q.values()), key=lambda one: -math.inf if math.isnan(one) else one)
    each = ", ".join(f"n₂ = {m}ω/2: {_signed(full)}" for m, (_, full) in v.q.items())
    rows = [
        ("<b>Floquet</b>, leading exponent", v.exponents[0].real, "1/s", "decides"),
        ("K₂, all averages", v.k2, "1/s²", f"paper's 0.3 and 0.1: {_signed(v.k2_paper)}; S = {_signed(v.index)} 1/s"),
        ("q, largest of three", q, "1/s", each),
        ("slow sway-yaw modes", float(max(v.slow)), "1/s", "averaged over the wave"),
        ("roll with slow modes", v.combination, "1/s", "n₂ near 2ω"),
        ("course in calm water, no rudder", float(max(calm.real)), "1/s", f"{exponents_words(calm, 2)}; no wave acts"),
    ]
    body = "".join(
        f"<tr><td>{what}</td><td>{_signed(value)} {unit if math.isfinite(value) else ''}</td>"
        f"<td>{_says(value, 'course-unstable' if what.startswith('course') else 'unstable')}</td>"
        f"<td class='hint'>{remark}</td></tr>"
        for what, value, unit, remark in rows
    )
    return f"<table class='judges'><tr><th>judge</th><th>growth</th><th>says</th><th>remark</th></tr>{body}</table>"


def _signed(value: float) -> str:
    return f"{value:+.3g}" if math.isfinite(value) else "none"


def _says(growth: float, unstable: str) -> str:
    if math.isnan(growth):
        return "no answer"
    return f"<span class='unstable'>{unstable}&nbsp;×</span>" if growth > 1e-9 else "<span class='stable'>stable</span>"


def _curve(state: State, of: Scene, found: Examined) -> list[Part]:
    followed = curve(of, state.over)
    roll = math.degrees(found.motion.peak[1]) if found.motion.status.ok else math.nan
    here = charts.place_on(state.over, of, found.model.frequency)
    folds = int(followed["fold"].sum())
    words = {0: "no fold", 1: "one fold"}.get(folds, f"{folds} folds")
    return [
        charts.response_curve(followed, state.over, here, roll),
        f"<p class='hint'>Balance of harmonics up to {followed.attrs['harmonics']}, followed through its folds: {words}."
        " Where the curve passes one value more than once, several motions exist.</p>",
    ]


def _causes(of: Scene) -> list[Part]:
    found = causes(of)
    return [
        "<h2>What moves the leading exponent</h2>", charts.tornado(found, "exponent"),
        "<h2>What moves the roll amplitude (fundamental)</h2>", charts.tornado(found, "roll"),
        "<p class='hint'>From derivatives at this condition. Right and hatched: less stable, or more roll.</p>",
    ]  # fmt: skip


def hull_parts(one: Ship, guesses: Mapping[str, Sequence[str]]) -> list[Part]:
    """What the Hull tab shows.

    guesses: coefficients that are estimated, by method
    """
    hull, floats = one.hull, hydrostatics(one)
    lines = html.escape(one.provenance.get("lines", hull.source))
    guessed = html.escape(estimated_words(guesses, one.provenance))
    words = (
        f"<p>L {hull.length:.4g} m, B {hull.beam:.4g} m, T {hull.draught:.4g} m; displaced {floats.volume:,.0f} m³,"
        f" CB {floats.cb:.3f}; KM {floats.km:.3f} m, KG {floats.kg:.3f} m, GM {floats.gm:.3f} m.</p>"
        f"<p class='hint'>Lines: {lines}<br>{guessed}</p>"
    )
    return [
        "<h2>The hull</h2>",
        hull_form(one),
        "<h2>Body plan</h2>",
        charts.body_plan(one),
        "<h2>Righting arm</h2>",
        charts.righting(one),
        words,
    ]

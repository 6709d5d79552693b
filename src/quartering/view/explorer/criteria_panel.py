"""The Criteria tab: five failure modes at two levels for the ship of the page, the first at once, the second when asked for."""

from __future__ import annotations

import html
import math
from collections.abc import Awaitable, Callable, Iterator
from typing import Final

from nicegui import background_tasks, ui

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.study.criteria.judged import judging
from quartering.study.criteria.record import LABELS, MODES, Criteria, Judgement
from quartering.view.criteria_words import recalled_words
from quartering.view.explorer.computing.job_queue import Take
from quartering.view.explorer.service.problems import without_paths

_LOOKS: Final = {"vulnerable": "unstable", "not vulnerable": "stable"}
_WHAT: Final = (
    "<p class='hint'>Service speed: that of the dial. Sway-roll-yaw motion, which the rest of this page is about, is none of"
    " these five modes.</p>"
)


class CriteriaPanel:
    """Table, button and progress; of one ship and speed at a time."""

    def __init__(self) -> None:
        self._key: object = None
        self._first: Criteria | None = None
        self._ask: Callable[[], Awaitable[None]] | None = None
        self._table = ui.html("", sanitize=False).classes("w-full q-criteria").mark("criteria")
        with ui.element("div").classes("progress"):
            self._button = ui.button("Judge level 2", color=None, on_click=self._asked)
            self._button.props("outline dense no-caps").classes("q-judge").mark("level 2")
            self._progress = ui.label("").mark("criteria progress").props("aria-live=polite")
        self._button.set_visibility(False)
        self._about = ui.html("", sanitize=False).classes("w-full")

    async def follow(self, ship: Ship, speed: float, key: object, take: Take, wanted: Callable[[], bool]) -> None:
        """Judge a ship at level 1, unless it is the one that is there.

        key: what ship, loading and speed are told apart by
        """
        if key == self._key:
            return
        self._key = key
        self._button.set_visibility(False)
        self._progress.set_text("")
        try:
            found = await self._judged(ship, speed, key, take, (1,))
        except InputError as error:
            self._table.set_content(f"<p>{html.escape(without_paths(str(error)))}</p>")
            self._about.set_content("")
            return
        if found is None or not wanted():
            self._key = None if self._key == key else self._key
            return
        self._first = found
        self._show(found)
        self._button.set_visibility(True)
        self._ask = lambda: self._second(ship, speed, key, take)

    def _show(self, found: Criteria) -> None:
        self._table.set_content(criteria_table(found))
        self._about.set_content(about_criteria(found))

    def _asked(self) -> None:
        if self._ask is not None:
            background_tasks.create(self._ask(), name="criteria, level 2")

    async def _second(self, ship: Ship, speed: float, key: object, take: Take) -> None:
        self._button.set_visibility(False)
        self._progress.set_text("level 2: 0 %")
        try:
            found = await self._judged(ship, speed, key, take, (2,))
        except InputError as error:
            self._progress.set_text(without_paths(str(error)))
            return
        if found is not None:
            self._progress.set_text("")

    async def _judged(
        self, ship: Ship, speed: float, key: object, take: Take, levels: tuple[int, ...]
    ) -> Criteria | None:
        """The judgements at some levels, step by step; None when another ship is asked for meanwhile."""
        steps: Iterator[tuple[float, Criteria]] = judging(ship, speed, levels=levels)
        found = None
        while self._key == key:
            step, _notes = await take(lambda: next(steps, None))
            if step is None:
                return found
            share, found = step
            if self._key == key and levels == (2,) and self._first is not None:
                self._progress.set_text(f"level 2: {share:.0%}".replace("%", " %"))
                self._show(_both(self._first, found))
        return None


def _both(first: Criteria, second: Criteria) -> Criteria:
    """Level 1 of one record and level 2 of another."""
    made = {(one.mode, one.level): one for one in (*first.judgements, *second.judgements)}
    return Criteria(
        first.ship,
        first.loading,
        tuple(made[mode, level] for mode in MODES for level in (1, 2) if (mode, level) in made),
    )


def criteria_table(found: Criteria) -> str:
    """Every judgement with its value and limit, its numbers behind a mark."""
    rows = "".join(_row(one) for one in found.judgements)
    return (
        f"<p class='hint'>{html.escape(found.loading[:1].upper() + found.loading[1:])}.</p>"
        "<table class='judges'><tr><th>failure mode</th><th>level</th><th>verdict</th><th>value and limit</th></tr>"
        f"{rows}</table>"
    )


def about_criteria(found: Criteria) -> str:
    """In which form the judgements are, what was assumed, and every constant with its place and status."""
    notes = "; ".join(dict.fromkeys(note for one in found.judgements for note in one.notes))
    assumed = f"<p class='hint'>Assumed: {html.escape(notes)}.</p>" if notes else ""
    constants = "".join(
        f"<tr><td><code>{html.escape(one.name)}</code></td><td>{one.value:g}</td><td>{html.escape(one.place)}</td>"
        f"<td>{html.escape(one.status)}</td></tr>"
        for one in found.constants
    )
    return (
        f"<p><b>{html.escape(recalled_words(found))}.</b> It shows no compliance.</p>{assumed}{_WHAT}"
        "<details><summary>Constants, with place and status</summary><table class='judges told'>"
        f"<tr><th>name</th><th>value</th><th>place</th><th>status</th></tr>{constants}</table></details>"
    )


def _row(one: Judgement) -> str:
    look = _LOOKS.get(one.verdict, "hint")
    mark = "&nbsp;×" if one.verdict == "vulnerable" else ""
    numbers = "".join(
        f"<li>{html.escape(q.name)} {q.value:.3g}{'' if q.unit in ('', '1') else ' ' + html.escape(q.unit)}"
        f"{': ' + html.escape(q.meaning) if q.meaning else ''}</li>"
        for q in one.quantities
        if math.isfinite(q.value)
    )
    label = f"{LABELS[one.mode]}, level {one.level}"
    more = (
        f"<details><summary aria-label='numbers of {label}'>numbers</summary><ul>{numbers}</ul></details>"
        if numbers
        else ""
    )
    return (
        f"<tr><td>{LABELS[one.mode]}</td><td>{one.level}</td><td><span class='{look}'>{one.verdict}{mark}</span></td>"
        f"<td>{html.escape(one.reason)}{more}</td></tr>"
    )

"""The page: sentence on top, dials, map and panel below; one `Page` for each browser tab."""

from __future__ import annotations

import asyncio
import html
import json
from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any
from urllib.parse import parse_qsl

import xarray as xr
from nicegui import background_tasks, ui
from nicegui.client import Client

from quartering.conventions import InputError
from quartering.hydro.coefficients import coefficients
from quartering.study.condition.examine import Examined
from quartering.view.explorer import downloads
from quartering.view.explorer.cell_panel import CellPanel, parts
from quartering.view.explorer.comparison.compare_panel import ComparePanel
from quartering.view.explorer.comparison.following import Comparison
from quartering.view.explorer.computing.computations import HEADINGS, Scene, map_blocks, noting, scene, sought, verdict
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.dials.controls import Controls
from quartering.view.explorer.dials.damping_dials import damping_hint
from quartering.view.explorer.first_steps import FirstSteps
from quartering.view.explorer.headline import NO_MOTION, beyond, headline
from quartering.view.explorer.hulls.ship_registry import Known, ShipRegistry
from quartering.view.explorer.hulls.upload_dialog import UploadDialog
from quartering.view.explorer.map_panel import MapPanel
from quartering.view.explorer.saved_views import LONGEST_LINK, SavedViews
from quartering.view.explorer.sea import sea_downloads
from quartering.view.explorer.sea.sea_map import SeaMap, fill
from quartering.view.explorer.sea.sea_panel import sea_headline, sea_notes, sea_parts
from quartering.view.explorer.sea.sea_scene import SeaScene, advice, map_pieces, of_sea_map, response, sea_scene
from quartering.view.explorer.sea.sea_state import NO_SEA
from quartering.view.explorer.service.problems import without_paths
from quartering.view.explorer.state import LOADING, State, read_link
from quartering.view.explorer.theme import theme_button

_COPY = """return (async () => {{
  const link = location.origin + location.pathname + {query};
  history.replaceState({{}}, '', link);
  try {{ await navigator.clipboard.writeText(link); return true; }} catch {{ return false; }}
}})()"""
"""Copies the link; a browser may refuse, and does where the page comes neither by https nor from this machine."""


class Page:
    """What one visitor sees and does; nothing of it is shared but the ships and the jobs.

    Parameters
    ----------
    client : Client      of NiceGUI: this browser tab
    registry : ShipRegistry
    jobs : JobQueue
    state : State        what the link asked for
    problem : str        what was wrong with the link, or ""
    dark : bool or None  the theme this visitor chose before; None follows the system
    """

    def __init__(
        self,
        client: Client,
        registry: ShipRegistry,
        jobs: JobQueue,
        state: State,
        problem: str,
        dark: bool | None = None,
    ) -> None:
        self._client, self._registry, self._jobs, self._dark = client, registry, jobs, dark
        self._touched: tuple[str, ...] = ()
        self._refused = False
        self.state: State = state
        self._opening, self._backs = state, "0"
        self._shown: State | None = None
        self._following: asyncio.Task[None] | None = None
        self._stopped = False
        self._map_of: State | None = None
        self._sea_map_of: tuple[State, float] | None = None
        self._blocks: list[xr.Dataset] = []
        self._build(problem)

    def _build(self, problem: str) -> None:
        with ui.element("div").classes("sheet"):
            with ui.element("header").classes("bar"):
                self._bar()
            self._steps = FirstSteps()
            with ui.element("section").classes("says").props("aria-live=polite") as self._says:
                self._sentence = ui.html("<h1 class='when'>…</h1>", sanitize=False).mark("sentence")
                self._heal = ui.html("", sanitize=False)
                self._notes = ui.html("", sanitize=False)
                self._wrong = ui.html("", sanitize=False).mark("problem")
            with ui.element("div").classes("grid"):
                with ui.element("section").classes("dials"):
                    self._controls = Controls(self.change)
                with ui.element("section").classes("map"):
                    self._map = MapPanel(self._choose_cell)
                    self._sea_map = SeaMap(lambda heading, speed: self.change(heading=heading, speed=speed))
                    with ui.element("div").classes("progress"):
                        self._progress = ui.label("").mark("progress")
                        self._stop = ui.button("Stop", color=None, on_click=self._stop_map).props("flat dense no-caps")
                        self._stop.set_visibility(False)
                with ui.element("section").classes("panel"):
                    self._panel = CellPanel(self.change, self._compare)
            ui.html(_FOOT, sanitize=False).classes("foot")
        if problem:
            self._say_wrong(problem)
        self._go()

    def _choose_cell(self, heading: float, length: float) -> None:
        self.change(heading=heading, wave_length=length)

    def _compare(self) -> ComparePanel:
        """The tab that compares, with what fills it."""
        panel = ComparePanel(
            self.change, self._choose_cell, lambda: self._send_made(lambda: self._made(self._comparison.picture))
        )
        self._comparison = Comparison(panel, self._registry, self._take)
        return panel

    def _bar(self) -> None:
        ui.label("quartering").classes("wordmark")
        self._ships = ui.select(self._options(), value=self.state.ship, on_change=lambda e: self._choose_ship(e.value))
        self._ships.props('dense options-dense outlined aria-label="ship"')
        self._dialog = UploadDialog(self._uploaded)
        ui.button("Your hull", icon="upload_file", color=None, on_click=self._dialog.open).props(
            "flat dense no-caps"
        ).mark("upload")
        ui.element("span").classes("push")
        SavedViews(self.open_link)
        ui.button("Copy link", icon="link", color=None, on_click=self._copy).props("flat dense no-caps")
        with ui.button("Download", icon="download", color=None).props("flat dense no-caps"), ui.menu():
            for words, make in downloads.files().items():
                ui.menu_item(words, on_click=partial(self._send, make, sea_downloads.files()[words]))
        theme_button(self._client, self._dark)
        ui.button(icon="help_outline", color=None, on_click=lambda: self._steps.begin()).props(
            'flat dense aria-label="what am I looking at" title="what am I looking at"'
        )

    def _options(self) -> dict[str, str]:
        options = self._registry.options()
        if self.state.ship in options:
            return options
        try:
            return {self.state.ship: self._registry.known(self.state.ship).label, **options}
        except InputError:
            return {self.state.ship: "?", **options}

    # What a visitor does

    def change(self, **values: Any) -> None:
        """Change the state; what is on the page follows. A value that cannot be stays marked where it was set."""
        self._touched = tuple(values)
        try:
            state = self.state.changed(**values)
        except InputError as error:
            self._refuse(str(error))
            return
        if self._refused or state != self.state:
            self._accept()
        if state != self.state or self._stopped:
            self.state = state
            self._go()

    def back(self, told: str) -> None:
        """Show what a link of the browser's history describes, with the number of the step in front of it."""
        self._backs, _, query = told[:LONGEST_LINK].partition(" ")
        self.open_link(query)

    def open_link(self, query: str) -> None:
        """Show what a link of the browser's history, or of a saved view, describes."""
        try:
            state, told = read_link(dict(parse_qsl(query.removeprefix("?"))))
            self._registry.check(state.ship)
        except InputError as error:
            self._say_wrong(str(error))
            return
        self._accept()
        if told:
            self._say_wrong(told)
        if state != self.state:
            self.state = state
            self._ships.set_options(self._options(), value=state.ship)
            self._go()

    def _refuse(self, problem: str) -> None:
        """Say what cannot be, mark the dial it was set on, and grey the verdict, which is of another condition."""
        self._say_wrong(problem)
        self._controls.refuse(self._touched)
        self._says.classes("stale")
        self._refused = True

    def _accept(self) -> None:
        """Take every mark of a refusal away."""
        self._wrong.set_content("")
        self._controls.refuse(())
        self._says.classes(remove="stale")
        self._refused = False

    def _go(self) -> None:
        self._stopped = False
        if self._following is None or self._following.done():
            self._following = background_tasks.create(self._follow(), name="explorer page")

    def leave(self) -> None:
        """The visitor has gone: give up what is under way."""
        if self._following is not None:
            self._following.cancel()

    def _choose_ship(self, name: str) -> None:
        if name != self.state.ship:
            kept = ("heading", "harmonics", "panel", "over", "mode", "beside")
            self.state = State(ship=name, **{key: getattr(self.state, key) for key in kept})
            self._accept()
            self._go()

    def _uploaded(self, known: Known) -> None:
        self._registry.keep(known)
        self._ships.set_options({known.key: known.label, **self._options()})
        self._ships.set_value(known.key)
        self.change(panel="hull")

    def _stop_map(self) -> None:
        self._stopped = True

    async def _copy(self) -> None:
        query = json.dumps(f"?{self.state.query()}")
        copied = await self._client.run_javascript(_COPY.format(query=query), timeout=10.0)
        with self._client:
            if copied:
                ui.notify("The link to exactly this view is copied.", position="top")
            else:
                ui.notify(
                    "The browser does not let a page copy here: take the link from its address line.", position="top"
                )

    async def _send(self, make: downloads.File, of_sea: sea_downloads.File) -> None:
        state = self.state

        async def in_a_sea() -> tuple[str, bytes]:
            of, _ = await self._take(lambda: sea_scene(state, self._registry.known(state.ship)))
            whole = self._sea_map.whole if self._sea_map_of == of_sea_map(state, of) else None
            return await sea_downloads.made(of_sea, state, of, whole, self._take)

        def in_a_wave() -> tuple[str, bytes]:
            return make(state, scene(state, self._registry.known(state.ship)))

        await self._send_made(in_a_sea if state.mode == "sea" else lambda: self._made(in_a_wave))

    async def _made(self, make: Callable[[], tuple[str, bytes]]) -> tuple[str, bytes]:
        """A file, made in its turn."""
        return (await self._take(make))[0]

    async def _send_made(self, made: Callable[[], Awaitable[tuple[str, bytes]]]) -> None:
        try:
            name, content = await made()
        except InputError as error:
            self._say_wrong(str(error))
            return
        with self._client:
            ui.download.content(content, name)

    # What follows

    async def _follow(self) -> None:
        """Bring the page up to its state; when the state moves on meanwhile, begin again with the new one."""
        while self._shown is not self.state:
            state = self.state
            try:
                await self._settle(state)
            except InputError as error:
                self._refuse(str(error))
            self._shown = state

    async def _settle(self, state: State) -> None:
        if state.mode == "sea":
            await self._settle_sea(state)
            return
        of, _ = await self._take(lambda: scene(state, self._registry.known(state.ship)))
        try:
            found, notes = await self._take(lambda: verdict(of))
        except InputError as error:  # ship and sea are as they should be; in this condition there is no motion
            self._say(NO_MOTION, [])
            self._say_wrong(str(error))
            await self._show_scene(state, of)
            await self._fill_map(state, of)
            await self._fill_comparison(state, of)
            return
        self._say(headline(found), [*found.beside.sentences, *notes, *beyond(found)])
        await self._show_scene(state, of)
        for step in (self._fill_panel, self._fill_map, self._fill_comparison, self._fill_cures):
            if self.state is not state:
                return
            await step(state, of, found)

    async def _settle_sea(self, state: State) -> None:
        of, _ = await self._take(lambda: sea_scene(state, self._registry.known(state.ship)))
        found, notes = await self._take(lambda: response(of))
        said, _ = await self._take(lambda: advice(state, of))
        self._say(sea_headline(of, found, said), [*notes, *sea_notes()])
        await self._show_scene(state, of)
        if state.panel == "criteria":
            await self._judge(state, of)
        else:
            shown, _ = await self._take(lambda: sea_parts(state.panel, of, found))
            if self.state is state:
                self._panel.show(state.panel, shown)
        asked = of_sea_map(state, of)
        if self.state is not state or asked == self._sea_map_of:
            return
        self._sea_map_of = None
        self._stop.set_visibility(True)
        try:
            pieces = map_pieces(state, of)
            wanted = partial(self._wants, state)
            if await fill(self._sea_map, pieces, self._take, wanted, self._progress.set_text):
                self._sea_map_of = asked
            elif self._stopped:
                self._progress.set_text("stopped; any change begins again")
        finally:
            self._stop.set_visibility(False)

    def _wants(self, state: State) -> bool:
        """Is a state still the one of the page, and its map not stopped?"""
        return self.state is state and not self._stopped

    async def _judge(self, state: State, of: Scene | SeaScene) -> None:
        """The criteria of the ship at its speed."""
        key = (state.ship, of.speed, *(getattr(state, name) for name in LOADING))
        await self._panel.criteria.follow(of.ship, of.speed, key, self._take, lambda: self.state is state)

    def _say(self, words: str, notes: list[str]) -> None:
        self._sentence.set_content(words)
        self._heal.set_content("")
        self._notes.set_content("".join(f"<p>{html.escape(note)}</p>" for note in notes))

    async def _show_scene(self, state: State, of: Scene | SeaScene) -> None:
        damping, _ = await self._take(lambda: damping_hint(of))
        if self.state is not state:  # a dial in motion is not turned back
            return
        self._controls.show(of, state, damping)
        self._map.box.set_visibility(isinstance(of, Scene))
        self._sea_map.box.set_visibility(isinstance(of, SeaScene))
        if isinstance(of, SeaScene):
            self._sea_map.place(of)
        else:
            self._map.place(of)
            self._comparison.front(state, of)
        self._panel.front(state)
        told = (f"?{state.query()}", state is self._opening, self._backs)
        self._client.run_javascript(f"quarteringLink({', '.join(map(json.dumps, told))})")

    async def _fill_panel(self, state: State, of: Scene, found: Examined) -> None:
        if state.panel == "criteria":
            await self._judge(state, of)
            return
        shown, _ = await self._take(lambda: parts(state, of, found))
        if self.state is state:
            self._panel.show(state.panel, shown)

    async def _fill_map(self, state: State, of: Scene, _: Examined | None = None) -> None:
        """The map, block by block, unless it is the one that is there."""
        asked = _of_map(state)
        if asked == self._map_of:
            return
        self._map_of = None
        frequency, _notes = await self._take(lambda: coefficients(of.ship, 0.0, 0.0).roll_frequency)
        self._map.lines(of, float(frequency))
        self._stop.set_visibility(True)
        try:
            if await self._fill_blocks(state, of):
                self._map_of = asked
        finally:
            self._stop.set_visibility(False)

    async def _fill_blocks(self, state: State, of: Scene) -> bool:
        """Every block of a map, in turn; False when it is stopped, or the state moves on."""
        done, self._blocks = 0, []
        for block in map_blocks(of):
            part: xr.Dataset
            part, _notes = await self._take(block)
            if self.state is not state:
                return False
            self._map.show(part, fresh=done == 0)
            self._blocks.append(part)
            done += part.sizes["heading"]
            self._progress.set_text(f"{done} of {HEADINGS.size} headings" if done < HEADINGS.size else "")
            if self._stopped and done < HEADINGS.size:
                self._progress.set_text(f"stopped at {done} of {HEADINGS.size} headings; any change begins again")
                return False
        return True

    async def _fill_comparison(self, state: State, of: Scene, _: Examined | None = None) -> None:
        """The page beside what it keeps, where that tab stands open."""
        if state.panel != "compare":
            return

        def going() -> str:
            return "moved on" if self.state is not state else "stopped" if self._stopped else ""

        own = self._blocks if self._map_of == _of_map(state) else []
        self._stop.set_visibility(bool(state.beside))
        try:
            await self._comparison.follow(state, of, own, going, self._progress.set_text)
        finally:
            self._stop.set_visibility(False)

    async def _fill_cures(self, state: State, _: Scene, found: Examined) -> None:
        if found.verdict.stable or not found.motion.status.ok:
            return
        healing = await sought(found, self._take, lambda: self.state is state)
        if self.state is state and healing:
            words = "; ".join(html.escape(cure.sentence) for cure in healing)
            self._heal.set_content(f"<p class='heal'>Each of these alone restores stability: {words}.</p>")

    async def _take(self, work: Callable[[], Any]) -> tuple[Any, list[str]]:
        return await self._jobs.take(self._client.id, noting(work))

    def _say_wrong(self, problem: str) -> None:
        self._wrong.set_content(f"<p class='wrong'>{html.escape(without_paths(problem))}</p>")


def _of_map(state: State) -> State:
    """The part of a state the map depends on."""
    return state.model_copy(
        update={"heading": 0.0, "wave_length": None, "panel": "motion", "over": "wave_height", "beside": None, **NO_SEA}
    )


_FOOT = (
    "Regular long-crested waves, or an irregular sea, on deep water; no heave, pitch or flooding."
    " Estimated coefficients are named under <i>Hull</i>."
    " For study and design; it shows compliance with no rule. The map: bow up, waves come from the side of the cell; the right"
    " half mirrors the left. Arrow keys on the map choose a cell. The same answers as a service:"
    " <a href='/api/docs'>/api/docs</a>."
)

"""The dialog that takes a hull: a file and, where the file does not tell them, its dimensions."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from nicegui import run, ui
from nicegui.events import UploadEventArguments

from quartering.conventions import InputError
from quartering.units import LENGTHS
from quartering.view.explorer.hulls.ship_registry import Known
from quartering.view.explorer.hulls.uploads import ENDINGS, LARGEST, Sizes, check_file, hull_of_upload

_ONE_AT_A_TIME = asyncio.Semaphore(1)
_UNITS = {"": "what the file says, else m"} | {unit: unit for unit in LENGTHS}
_HEAD = """<div class="upload-head"><button type="button" @click="props.pickFiles">Choose a file</button>
<span>or drop one here</span><label>file of lines<q-uploader-add-trigger /></label></div>"""
"""In place of Quasar's own, whose button has no name: a button for mouse and keyboard, and the field it opens, out of sight."""


class UploadDialog:
    """Takes a file, keeps it in memory until a hull is made of it, and says what is wrong with it."""

    def __init__(self, made: Callable[[Known], None]) -> None:
        self._made = made
        self._name, self._data = "", b""
        with ui.dialog().props('aria-label="draw your hull"') as self._dialog, ui.card().classes("upload-box"):
            ui.label("Draw your hull").classes("text-lg")
            ui.label(
                "Offset table or x, y, z (.csv), PDSTRIP sections (.out, .dat), WAMIT panels (.gdf) or STL; x forward."
                f" Up to {LARGEST / 1e6:g} MB. Nothing is kept longer than this server runs."
            ).classes("hint")
            self._upload = ui.upload(
                on_upload=self._arrived,
                on_rejected=self._too_large,
                auto_upload=True,
                max_file_size=LARGEST,
                max_files=1,
            )
            self._upload.props(f'accept="{",".join(ENDINGS)}" flat bordered').classes("w-full")
            self._upload.add_slot("header", _HEAD)
            with ui.element("div").classes("sizes"):
                self._length = ui.number("length [m]").props("dense outlined")
                self._beam = ui.number("beam [m]").props("dense outlined")
                self._draught = ui.number("draught [m]").props("dense outlined")
            self._unit = ui.select(_UNITS, value="", label="unit of the numbers in the file")
            self._unit.props("dense outlined options-dense").classes("w-full")
            ui.label("Left empty, they are taken from the lines; GM and gyradii begin with usual values.").classes(
                "hint"
            )
            self._problem = (
                ui.label("").style("color:var(--bad);font-weight:600").props("role=alert").mark("upload-problem")
            )
            with ui.row().classes("w-full justify-end"):
                ui.button("Cancel", color=None, on_click=self._dialog.close).props("flat no-caps")
                ui.button("Draw it", on_click=self._draw).props("unelevated no-caps")

    def open(self) -> None:
        """Show the dialog."""
        self._problem.set_text("")
        self._dialog.open()

    def _too_large(self) -> None:
        self._problem.set_text(f"files of up to {LARGEST / 1e6:g} MB that end in {', '.join(ENDINGS)} are taken")

    async def _arrived(self, event: UploadEventArguments) -> None:
        self._upload.reset()
        try:
            check_file(event.file.name, event.file.size())
        except InputError as error:
            self._problem.set_text(str(error))
            return
        self._name, self._data = event.file.name, await event.file.read()
        await self._draw()

    async def _draw(self) -> None:
        """Make a hull of the file; apart from the queue, because reading a mesh takes long."""
        if not self._data:
            self._problem.set_text("choose a file first")
            return
        sizes = Sizes(*(field.value or None for field in (self._length, self._beam, self._draught, self._unit)))
        try:
            async with _ONE_AT_A_TIME:
                known = await run.io_bound(hull_of_upload, self._name, self._data, sizes)
        except InputError as error:
            self._problem.set_text(str(error))
            return
        if known is None:  # the server is shutting down
            return
        self._data = b""
        self._dialog.close()
        self._made(known)

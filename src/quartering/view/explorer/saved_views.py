"""Named views of a visitor, which the browser keeps: a name, and the link that gives the view again."""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import version

from nicegui import ui
from nicegui.element import Element
from nicegui.events import GenericEventArguments

LONGEST_LINK = 4000
"""Of a link a browser hands in, more is cut off."""


class _Views(Element, component="saved_views.js"):
    """The list in the browser."""


class SavedViews:
    """Button and dialog; `opened` is called with the link of the view that is chosen."""

    def __init__(self, opened: Callable[[str], None]) -> None:
        button = ui.button("Views", icon="bookmark_border", color=None).props("flat dense no-caps aria-haspopup=dialog")
        with ui.dialog().props('aria-label="saved views"') as dialog, ui.card().classes("views-box"):
            ui.label("Saved views").classes("text-lg")
            views = _Views()
            views.props["version"] = version("quartering")
            ui.button("Close", color=None, on_click=dialog.close).props("flat no-caps").classes("self-end")

        def chosen(event: GenericEventArguments) -> None:
            dialog.close()
            opened(str(event.args)[:LONGEST_LINK])

        views.on("open", chosen)
        button.on_click(dialog.open)

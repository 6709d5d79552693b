"""The button for light or dark: three choices in turn, kept by the browser for a year."""

from __future__ import annotations

import json

from nicegui import ui
from nicegui.client import Client

_KEPT = {None: "system", True: "dark", False: "light"}
_THEMES = {None: ("contrast", "as the system"), True: ("dark_mode", "dark"), False: ("light_mode", "light")}


def theme_button(client: Client, chosen: bool | None) -> None:
    """Place the button; chosen before: dark, light, or None to follow the system."""
    dark = ui.dark_mode(chosen)
    button = ui.button(color=None).props("flat dense").mark("theme")

    def show() -> None:
        icon, words = _THEMES[dark.value]
        button.set_icon(icon)
        button.props(f'aria-label="light or dark: {words}" title="light or dark: {words}"')

    def turn() -> None:
        order = list(_THEMES)
        dark.value = order[(order.index(dark.value) + 1) % len(order)]
        show()
        kept = f"quartering-theme={_KEPT[dark.value]}; path=/; max-age=31536000; SameSite=Strict"
        client.run_javascript(f"document.cookie = {json.dumps(kept)}")

    show()
    button.on_click(turn)

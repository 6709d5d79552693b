"""Records show themselves in notebooks: what they look like is `quartering.view.notebook`'s affair."""

from __future__ import annotations

from importlib import import_module


class ShownInNotebooks:
    """A record with a picture or a table of itself in a notebook."""

    def _repr_html_(self) -> str:
        """Page of the record; the room of pictures stands after its own, so it is found by name when it is asked for."""
        return str(import_module("quartering.view.notebook").page_of(self))

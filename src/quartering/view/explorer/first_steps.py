"""What am I looking at: three steps for a first visit, reached again by a button."""

from __future__ import annotations

from nicegui.element import Element

_STEPS = (
    (
        "The verdict",
        "One ship keeps its course and speed in one regular wave. Stable: a small disturbance dies out, and the ship rolls as"
        " far as is said here. Unstable: it grows; below stand the smallest changes that end it. What leaves the range of the"
        " theory is said beside the number.",
        ".says",
    ),
    (
        "The map",
        "The same ship and speed in waves of every length, from every side, bow up. Colour is how far it rolls, hatched cells"
        " are unstable. Click a cell, or take the arrow keys, and verdict and panels follow.",
        ".sheet .map",
    ),
    (
        "Dials and panels",
        "Turn a dial and everything follows. The tabs show how the ship moves, why it is stable or not, what to change, and"
        " another loading beside this one.",
        ".dials, .panel",
    ),
)


class FirstSteps(Element, component="first_steps.js"):
    """The steps in the browser: shown at the first visit, remembered there when they are closed."""

    def __init__(self) -> None:
        super().__init__()
        self.props["steps"] = [{"title": title, "words": words, "selector": at} for title, words, at in _STEPS]

    def begin(self) -> None:
        """Show them from the first."""
        self.run_method("begin")

"""The tab that compares: what is chosen, the map of differences with its scale and legend, and the one table."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np
from nicegui import ui
from nicegui.events import GenericEventArguments

from quartering.study.maps.compare import Change, OnlyOne
from quartering.view.explorer.comparison.beside import Compared
from quartering.view.explorer.computing.computations import HEADINGS, RATIOS, Scene
from quartering.view.explorer.map_panel import PolarMap, key
from quartering.view.explorer.state import State
from quartering.view.plots.difference_map import LEAST, SCALE

_COLOURS = 65
_KINDS = {
    Change.NONE: "the verdict stays",
    Change.UNSTABLE: "becomes unstable",
    Change.STABLE: "becomes stable",
    Change.UNKNOWN: "no answer in one of them",
}
_NOTHING = (
    "Keep the loading the dials show, then turn them; or choose another ship. The map then shows how much more the ship of the"
    " dials rolls than the one that is kept."
)
ALIKE = "What is kept and what the dials show is one ship, loaded alike: turn a dial of the loading, or choose another ship."
STOPPED = "The map was stopped; any change begins it again."


class ComparePanel:
    """Choice, map and table; `show` fills it, `say` empties it and says why.

    Parameters
    ----------
    change : function            changes the state of the page by name
    choose : function(heading [deg], wave length [m])    called for a click on a cell
    take : function              takes the picture home
    """

    def __init__(
        self, change: Callable[..., None], choose: Callable[[float, float], None], take: Callable[[], object]
    ) -> None:
        self._length, self._keep = 1.0, ""
        self._change = change
        with ui.element("div").classes("beside-bar"):
            self._choice = ui.select({"": ""}, value="", on_change=lambda event: self._chosen(event.value))
            self._choice.props('dense options-dense outlined aria-label="compare with"').mark("beside")
            ui.button("Keep this loading", color=None, on_click=lambda: change(beside=self._keep)).props(
                "flat dense no-caps"
            )
        self._words = ui.html("", sanitize=False).classes("beside-says").props("aria-live=polite")
        with ui.element("div").classes("map-box beside-map") as self._box:
            self._map = PolarMap()
            fixed = {
                "headings": HEADINGS.tolist(), "radii": RATIOS.tolist(), "palette": list(palette()), "lines": [],
                "kinds": {str(int(k)): words for k, words in _KINDS.items()}, "hatched": [int(Change.UNSTABLE)],
                "dotted": [int(Change.STABLE)], "size": "roll difference", "chosen": [0.0, 1.0],
                "cross_words": "this one alone capsizes on the way",
                "label": "Polar map of the difference of the largest roll; arrow keys choose heading and wave length",
            }  # fmt: skip
            cells = HEADINGS.size * RATIOS.size
            fixed |= {"roll": [None] * cells, "kind": [int(Change.UNKNOWN)] * cells, "top": LEAST, "low": -LEAST}
            for name, value in fixed.items():
                self._map.props[name] = value
            with ui.element("div").classes("scale"):
                self._low = ui.label("")
                ui.element("div").classes("scale-bar").style(f"background:linear-gradient(90deg,{','.join(palette())})")
                self._top = ui.label("")
            self._legend = ui.html("", sanitize=False).classes("legend")
            ui.button("Picture of the difference, PNG", icon="download", color=None, on_click=take).props(
                "flat dense no-caps"
            )
        self._table = ui.html("", sanitize=False)
        self._box.set_visibility(False)
        self._map.on("choose", lambda event: choose(*self._place(event)))

    def _place(self, event: GenericEventArguments) -> tuple[float, float]:
        return float(HEADINGS[int(event.args["heading"])]), float(RATIOS[int(event.args["length"])]) * self._length

    def _chosen(self, link: str) -> None:
        self._change(beside=link or None)

    def front(self, state: State, of: Scene, options: Mapping[str, str], keep: str) -> None:
        """Show what is chosen; keep: the link of what the dials show."""
        self._keep, self._length = keep, of.ship.hull.length
        self._choice.set_options(dict(options), value=state.beside or "")
        self._map.props["chosen"] = [of.heading, of.wave.length / self._length]

    def wait(self) -> None:
        """What stands there is of another state."""
        self._box.classes("later")
        self._table.classes("later")

    def say(self, words: str = _NOTHING, *, wrong: bool = False) -> None:
        """Show a sentence in place of a comparison."""
        self._words.set_content(f"<p class='{'beside-wrong' if wrong else 'hint'}'>{html.escape(words)}</p>")
        self._box.set_visibility(False)
        self._table.set_content("")
        self._settled()

    def _settled(self) -> None:
        """What stands there is of the state of the page."""
        for one in (self._box, self._table):
            one.classes(remove="later")

    def show(self, found: Compared) -> None:
        """Show a comparison."""
        ds = found.ds.isel(speed=0).transpose("ship", "heading", "wave_length", ...)
        rows = np.searchsorted(HEADINGS, ds["heading"].values)
        columns = np.searchsorted(RATIOS, ds["wave_length"].values / found.length - 1e-6)
        at = np.ix_(rows, columns)
        roll, kind = (
            np.full((HEADINGS.size, RATIOS.size), np.nan),
            np.full((HEADINGS.size, RATIOS.size), Change.UNKNOWN),
        )
        only = np.zeros(roll.shape, int)
        roll[at], kind[at], only[at] = ds["roll_difference"], ds["change"], ds["only_one_capsizes"]
        known = np.abs(roll[np.isfinite(roll)])
        top = max(LEAST, float(np.ceil(known.max(initial=0.0))))
        self._map.props["top"], self._map.props["low"] = top, -top
        self._map.props["roll"] = [float(v) if np.isfinite(v) else None for v in roll.round(2).ravel()]
        self._map.props["kind"] = kind.ravel().tolist()
        self._map.props["crossed"] = np.flatnonzero(only == OnlyOne.SECOND).tolist()
        first = np.flatnonzero(only == OnlyOne.FIRST)
        self._map.props["also"] = {str(k): "the kept one alone capsizes on the way" for k in first}
        self._low.set_text(f"rolls less −{top:g}°")
        self._top.set_text(f"+{top:g}° more")
        self._legend.set_content(_legend_words(kind, only))
        labels = [html.escape(label) for label in found.labels]
        self._words.set_content(f"<p><b>{labels[1]}</b> less <b>{labels[0]}</b>: difference of the largest roll.</p>")
        self._table.set_content(_table_words(found))
        self._box.set_visibility(True)
        self._settled()


@lru_cache(maxsize=1)
def palette() -> tuple[str, ...]:
    """Colours of a difference: violet for less, white, orange for more; told apart by colour-blind people."""
    import matplotlib as mpl
    from matplotlib.colors import to_hex

    return tuple(to_hex(colour) for colour in mpl.colormaps[SCALE](np.linspace(0.0, 1.0, _COLOURS)))


def _legend_words(kind: np.ndarray, only: np.ndarray) -> str:
    """Which marks occur, and how often."""
    rows = [
        ("hatch", "{} become unstable", kind == Change.UNSTABLE),
        ("dots", "{} become stable", kind == Change.STABLE),
        ("grey", "{} without an answer in one of them", kind == Change.UNKNOWN),
        ("cross", "{} where this one alone capsizes on the way", only == OnlyOne.SECOND),
        ("ring", "{} where the kept one alone does", only == OnlyOne.FIRST),
    ]
    told = [f"<span>{key(name)}{words.format(int(cells.sum()))}</span>" for name, words, cells in rows if cells.any()]
    return "".join(told) or "<span>no verdict changes</span>"


def _table_words(found: Compared) -> str:
    """The table, and below it what should be known."""
    head = "".join(f"<th scope='col'>{html.escape(words)}</th>" for words in (*found.labels, "difference"))
    body = "".join(
        f"<tr><th scope='row'>{html.escape(row[0].strip())}</th>"
        + "".join(f"<td>{html.escape(cell)}</td>" for cell in row[1:])
        + "</tr>"
        for row in found.rows
    )
    said = "".join(f"<p class='hint'>{html.escape(words)}</p>" for words in found.said)
    return f"<table class='judges beside-table'><tr><td></td>{head}</tr>{body}</table>{said}"

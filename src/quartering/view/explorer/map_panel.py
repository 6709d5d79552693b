"""The map on the page: which cell has which colour and pattern, the lines of resonance, and what a click chooses."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
import xarray as xr
from nicegui import ui
from nicegui.element import Element
from nicegui.events import GenericEventArguments

from quartering.hull.righting.arm import fitted_to
from quartering.stability.kind import Kind
from quartering.study.condition.resonance import resonance_fields
from quartering.study.maps.query import capsizing, other_rolls
from quartering.view.explorer.computing.computations import HEADINGS, RATIOS, Scene
from quartering.view.plots import style

_COLOURS = 64
_DASHES = (("resonance", "none"), ("twice", "5 2.5"), ("pace", "1 2"))
_HATCHED = [int(k) for k in Kind if k > Kind.STABLE and k != Kind.COURSE_IN_CALM_WATER]
_DOTTED = [int(Kind.COURSE_IN_CALM_WATER)]
_LEAST_TOP = 5.0


def _words(kind: Kind) -> str:
    """What a cell is, in words."""
    if kind == Kind.COURSE_IN_CALM_WATER:
        return "course-unstable even in calm water"
    return kind.label.replace("-", " ") if kind <= Kind.STABLE else f"unstable ({kind.label})"


def key(name: str) -> str:
    """Sample of a pattern or line for the legend."""
    return f'<i class="key {name}"></i>' if name else ""


class PolarMap(Element, component="polar_map.js"):
    """The component in the browser."""


class MapPanel:
    """Map, colour scale and legend; filled block by block."""

    def __init__(self, choose: Callable[[float, float], None]) -> None:
        self._length = 1.0
        self._lines: list[str] = []
        self._fitted = np.inf
        with ui.element("div").classes("map-box") as self.box:
            self._map = PolarMap()
            self._map.props["headings"], self._map.props["radii"] = HEADINGS.tolist(), RATIOS.tolist()
            self._map.props["kinds"] = {str(int(k)): _words(k) for k in Kind}
            self._map.props["palette"] = list(palette())
            self._map.props["hatched"], self._map.props["dotted"] = _HATCHED, _DOTTED
            self._map.props["label"] = (
                "Polar map of the largest roll over a cycle; arrow keys choose heading and wave length"
            )
            self._map.props["chosen"], self._map.props["lines"] = [0.0, 1.0], []
            self._map.props["top"] = _LEAST_TOP
            self._roll = np.full((HEADINGS.size, RATIOS.size), np.nan)
            self._other = self._roll.copy()
            self._kind = np.full(self._roll.shape, int(Kind.NO_ANSWER))
            self._lost = np.zeros(self._roll.shape, dtype=bool)
            self._awaited = np.ones(HEADINGS.size, dtype=bool)
            with ui.element("div").classes("scale"):
                ui.label("largest roll 0°")
                ui.element("div").classes("scale-bar").style(f"background:linear-gradient(90deg,{','.join(palette())})")
                self._top = ui.label("")
            self._legend = ui.html("", sanitize=False).classes("legend")
        self._send()

        def chosen(event: GenericEventArguments) -> None:
            choose(float(HEADINGS[int(event.args["heading"])]), float(RATIOS[int(event.args["length"])]) * self._length)

        self._map.on("choose", chosen)

    def place(self, of: Scene) -> None:
        """Show which heading and wave length the page is about, and where the resonances lie."""
        self._length = of.ship.hull.length
        self._map.props["chosen"] = [of.heading, of.wave.length / self._length]

    def lines(self, of: Scene, roll_frequency: float) -> None:
        """Draw lines where the encounter frequency equals n2, 2 n2 and zero."""
        found = resonance_lines(of.ship.hull.length, of.speed, roll_frequency)
        self._map.props["lines"] = [{"points": found[name], "dash": dash} for name, dash in _DASHES if found[name]]
        self._fitted = fitted_to(of.ship)
        self._lines = [name for name, _ in _DASHES if found[name]]

    def show(self, part: xr.Dataset, *, fresh: bool) -> None:
        """Put a block of the map in its place; the first of a new map empties it."""
        if fresh:
            self._roll[:], self._other[:], self._kind[:] = np.nan, np.nan, int(Kind.NO_ANSWER)
            self._lost[:], self._awaited[:] = False, True
        rows = np.searchsorted(HEADINGS, part["heading"].values)
        columns = np.searchsorted(RATIOS, part["wave_length"].values / self._length - 1e-6)
        at = np.ix_(rows, columns)
        self._other[at] = other_rolls(part).max("other_motion").values[0]
        self._roll[at], self._kind[at] = part["roll_peak"].values[0], part["verdict"].values[0]
        self._lost[at] = capsizing(part).values[0]
        self._awaited[rows] = False
        self._send()

    def _send(self) -> None:
        roll = self._roll.round(2)
        self._map.props["roll"] = [float(v) if np.isfinite(v) else None for v in roll.ravel()]
        waiting = np.broadcast_to(self._awaited[:, None], roll.shape)
        self._map.props["kind"] = [None if w else int(k) for k, w in zip(self._kind.flat, waiting.flat, strict=True)]
        self._map.props["crossed"] = np.flatnonzero(self._lost).tolist()
        beside = np.flatnonzero(np.isfinite(self._other))
        self._map.props["also"] = {str(k): round(float(self._other.flat[k]), 1) for k in beside}
        if np.isfinite(roll).any():
            top = max(_LEAST_TOP, float(np.ceil(np.nanmax(roll))))
            self._map.props["top"] = top
            self._top.set_text(f"{top:g}°")
            self._legend.set_content(self._legend_words())

    def _legend_words(self) -> str:
        stable, none = int((self._kind == Kind.STABLE).sum()), int((self._kind == Kind.NO_ANSWER).sum())
        calm = int((self._kind == Kind.COURSE_IN_CALM_WATER).sum())
        unstable, lost = self._kind.size - stable - none - calm, int(self._lost.sum())
        also = int(np.isfinite(self._other).sum())
        rows = [
            ("", "every cell is stable", stable == self._kind.size and not lost and not also),
            ("hatch", f"{unstable} of {self._kind.size} cells unstable", unstable),
            ("dots", f"{calm} course-unstable even in calm water", calm),
            ("cross", f"{lost} stable, but the ship capsizes on the way", lost),
            ("ring", f"{also} with another stable motion", also),
            ("grey", f"{none} without an answer", none),
            ("line", "encounter at the roll frequency n₂", "resonance" in self._lines),
            ("dash", "at 2 n₂", "twice" in self._lines),
            ("dotted", "ship keeps pace with the wave", "pace" in self._lines),
        ]
        beyond = int((np.nan_to_num(self._roll) > self._fitted).sum())
        words = f"{beyond} cells roll beyond {self._fitted:g}°, where the fit of the righting arm ends: extrapolated"
        return (f"<div>{words}</div>" if beyond else "") + "".join(
            f"<span>{key(name)}{words}</span>" for name, words, shown in rows if shown
        )


@lru_cache(maxsize=1)
def palette() -> tuple[str, ...]:
    """Colours of roll, small to large."""
    import matplotlib as mpl
    from matplotlib.colors import to_hex

    colours = mpl.colormaps[style.SEQUENTIAL](np.linspace(0.0, 1.0, _COLOURS))
    return tuple(to_hex(colour) for colour in colours)


def resonance_lines(length: float, speed: float, roll_frequency: float) -> dict[str, list[list[list[float]]]]:
    """Lines (heading [deg], wave length over L) on which the encounter frequency is n2, 2 n2 and zero, as pieces.

    >>> at_rest = resonance_lines(100.0, 0.0, 0.6)
    >>> round(at_rest["resonance"][0][0][1], 3), at_rest["pace"]
    (1.712, [])
    """
    ratio = np.linspace(RATIOS[0] - 0.05, RATIOS[-1] + 0.05, 200)
    heading = np.linspace(0.0, 180.0, 181)
    fields = resonance_fields(ratio * length, speed, heading[:, None], roll_frequency)
    return {name: _crossings(field, level, heading, ratio) for name, (field, level) in fields.items()}


def _crossings(field: np.ndarray, level: float, heading: np.ndarray, ratio: np.ndarray) -> list[list[list[float]]]:
    """Contour at a level of a field over heading and ratio, thinned."""
    from contourpy import contour_generator

    pieces = contour_generator(heading, ratio, field.T).lines(level)
    return [_thinned(np.asarray(piece)).round(3).tolist() for piece in pieces if len(piece) > 1]


def _thinned(piece: np.ndarray) -> np.ndarray:
    kept = np.unique(np.append(np.arange(0, len(piece), 3), len(piece) - 1))
    return np.asarray(piece[kept])

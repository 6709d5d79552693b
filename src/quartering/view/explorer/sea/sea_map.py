"""The map of an irregular sea on the page: over heading and speed the largest roll of three hours, and what guidance says."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np
import xarray as xr
from nicegui import ui
from nicegui.events import GenericEventArguments

from quartering.study.seas.over_seas.advice import Advice
from quartering.study.seas.over_seas.map_axes import period_of
from quartering.units import quantity
from quartering.view.explorer.computing.computations import HEADINGS
from quartering.view.explorer.computing.job_queue import Take
from quartering.view.explorer.map_panel import PolarMap, palette
from quartering.view.explorer.sea.sea_scene import FROUDE, SeaScene
from quartering.view.plots.guidance import round_knots
from quartering.view.plots.sea_polar import limit_words

_DASHES: Final = {"synchronous": "none", "parametric": "5 2.5"}
_LEAST_TOP: Final = 5.0
_KNOT: Final = quantity("1 kn", "speed")
_LABEL: Final = "Polar map of the mean largest roll of three hours; arrow keys choose heading and speed"
CONDITIONS: Final = HEADINGS.size * FROUDE.size
"""Of the whole map."""


class SeaMap:
    """Map, colour scale and legend of a sea; filled speed by speed."""

    def __init__(self, choose: Callable[[float, float], None]) -> None:
        self._choose, self._made = choose, False
        self._speeds: tuple[float, ...] = tuple(FROUDE)
        self.whole: xr.Dataset | None = None
        self.box = ui.element("div").classes("map-box q-sea-map")

    def _make(self) -> None:
        """Draw an empty map; not before a visitor asks for a sea."""
        self._made = True
        with self.box:
            self._map = PolarMap()
            self._map.props.update(
                headings=HEADINGS.tolist(), radii=FROUDE.tolist(), palette=list(palette()), label=_LABEL, size="largest of 3 h",
                kinds={str(int(one)): one.label for one in Advice}, hatched=[int(Advice.NOT_RECOMMENDED)],
                dotted=[int(Advice.UNDECIDED)], crossed=[], also={}, chosen=[0.0, 0.16], lines=[], rings=[], rows=[],
                top=_LEAST_TOP, roll=[None] * CONDITIONS, kind=[None] * CONDITIONS,
            )  # fmt: skip
            with ui.element("div").classes("scale"):
                ui.label("mean largest roll of 3 h 0°")
                ui.element("div").classes("scale-bar").style(f"background:linear-gradient(90deg,{','.join(palette())})")
                self._top = ui.label("")
            self._legend = ui.html("", sanitize=False).classes("legend")
        self._map.on("choose", self._chosen)

    def _chosen(self, event: GenericEventArguments) -> None:
        self._choose(float(HEADINGS[int(event.args["heading"])]), self._speeds[int(event.args["length"])])

    def place(self, of: SeaScene) -> None:
        """Show which heading and speed the page is about, and the speeds of the rings in knots."""
        if not self._made:
            self._make()
        self._speeds, one = of.speeds, of.speeds[-1] / float(FROUDE[-1])
        self._map.props["chosen"] = [of.heading, of.speed / one]
        self._map.props["rings"] = [[ring * _KNOT / one, f"{ring:g} kn"] for ring in round_knots(of.speeds[-1] / _KNOT)]
        self._map.props["rows"] = [f"{speed / _KNOT:.3g} kn" for speed in of.speeds]

    def show(self, part: xr.Dataset, done: int) -> None:
        """Show the map as far as it goes.

        part: from `map_pieces`
        done: its conditions that are computed, speed by speed
        """
        self.whole = part if done == CONDITIONS else None
        one = part.isel({"loading": 0, "hs": 0, period_of(part): 0}).transpose("heading", "speed", ...)
        roll, advice = one["roll_mean_3h_max"].values, one["recommended"].values
        known = done > np.arange(roll.size).reshape(roll.shape[::-1]).T
        limit = float(part.attrs["roll_limit"])
        top = min(max(_LEAST_TOP, float(np.ceil(np.nanmax(roll, initial=0.0)))), limit)
        self._map.props["roll"] = [round(float(r), 2) if np.isfinite(r) else None for r in roll.ravel()]
        self._map.props["kind"] = [int(a) if k else None for a, k in zip(advice.flat, known.flat, strict=True)]
        self._map.props["top"] = top
        unit = float(part["speed"][-1]) / float(FROUDE[-1])
        self._map.props["lines"] = list(_danger_lines(part, unit))
        self._top.set_text(f"{top:.3g}°{' and more' if np.nanmax(roll, initial=0.0) > top else ''}")
        self._legend.set_content(_legend(part, advice[known], roll[known]))


async def fill(
    shown: SeaMap,
    pieces: Iterator[tuple[int, xr.Dataset]],
    take: Take,
    wanted: Callable[[], bool],
    tell: Callable[[str], object],
) -> bool:
    """Every piece of a map, in turn; False when it is wanted no more. `tell` says how far it is."""
    done = 0
    while done < CONDITIONS:
        found, _notes = await take(lambda: next(pieces))
        if not wanted():
            return False
        done, part = found
        shown.show(part, done)
        tell(f"{done} of {CONDITIONS} conditions" if done < CONDITIONS else "")
    return True


def _danger_lines(part: xr.Dataset, unit: float) -> Iterator[dict[str, Any]]:
    """The lines U cos mu = constant as far as the map goes; speed in Froude numbers, `unit` of which is one [m/s]."""
    largest = 1.5 * float(FROUDE[-1]) - 0.5 * float(FROUDE[-2])
    for name, speed in zip(part["line"].values.tolist(), part["pile_up"].values / unit, strict=True):
        if speed < largest:
            mu = np.linspace(0.0, np.arccos(speed / largest), 60)
            yield {
                "points": [np.column_stack([np.degrees(mu), speed / np.cos(mu)]).round(4).tolist()],
                "dash": _DASHES[name],
            }


def _legend(part: xr.Dataset, advice: np.ndarray, roll: np.ndarray) -> str:
    """What the patterns and lines mean, and how many cells there are of each."""
    counts = {kind: int((advice == int(kind)).sum()) for kind in Advice}
    line, half = part["pile_up"].values / _KNOT
    rows = [
        ("", "every cell is recommended", counts[Advice.RECOMMENDED] == CONDITIONS),
        ("hatch", f"{counts[Advice.NOT_RECOMMENDED]} of {advice.size} not recommended", counts[Advice.NOT_RECOMMENDED]),
        ("dots", f"{counts[Advice.UNDECIDED]} undecided: the interval straddles the limit", counts[Advice.UNDECIDED]),
        ("grey", f"{int(np.isnan(roll).sum())} without an answer", np.isnan(roll).any()),
        ("line", f"U cos μ = {line:.3g} kn: roll in step with the waves", True),
        ("dash", f"{half:.3g} kn: parametric roll", True),
    ]
    about = part.attrs
    limit = f"{about['threshold_words']} ({about['threshold_source']}); {limit_words(part)}"
    return (
        "".join(
            f'<span>{f"""<i class="key {key}"></i>""" if key else ""}{words}</span>'
            for key, words, there in rows
            if there
        )
        + f"<div>{limit[0].upper()}{limit[1:]}.</div>"
    )

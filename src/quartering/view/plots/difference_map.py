"""Two maps side by side: how much more the second ship rolls, hatched where the verdict changes, marked where one capsizes."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.projections.polar import PolarAxes

from quartering.study.maps.compare import Change, OnlyOne
from quartering.view.plots import style
from quartering.view.plots.polar_map import (
    CROSS,
    GREY,
    HOW_TO_READ,
    MIRRORED,
    OUTLINE_OF_MARK,
    RING,
    cell_edges,
    dress,
    head,
    mark_cells,
    mirrors,
    paint_cells,
)
from quartering.view.wording import speed_words

SCALE: Final = "PuOr_r"
"""From violet (rolls less) over white to orange (rolls more): told apart by colour-blind people."""
LEAST = 1.0
"""The scale reaches at least so far: differences of a hundredth of a degree look like none [deg]."""
_LOOKS: Final = {
    Change.UNSTABLE: ("unstable", {"facecolor": "none", "edgecolor": style.INK}, "becomes unstable"),
    Change.STABLE: ("course", {"facecolor": "none", "edgecolor": style.INK}, "becomes stable"),
    Change.UNKNOWN: ("no answer", {"facecolor": GREY, "edgecolor": GREY}, "no answer in one of them"),
}
_MARKS: Final = {
    OnlyOne.SECOND: ("the second alone capsizes on the way", CROSS),
    OnlyOne.FIRST: ("the first alone capsizes on the way", RING),
}
_HATCHES = {Change.UNSTABLE: "/////", Change.STABLE: "...", Change.UNKNOWN: None}


def difference_map(ds: xr.Dataset, length: float, title: str, note: str) -> Figure:
    """Draw the dataset of `map_difference`, one panel a speed.

    length: of the ship whose wave length ratio is the radius [m]
    """
    count = ds.sizes["speed"]
    columns = min(count, 3)
    rows = -(-count // columns)
    width = max(4.4 * columns + 1.2, 7.4)
    made = style.figure(width, (width - 1.2) / columns * rows + 1.2)
    panels = made.subplots(rows, columns, subplot_kw={"projection": "polar"}, squeeze=False).ravel()
    for panel in panels[count:]:
        panel.set_visible(False)
    known = np.abs(ds["roll_difference"].values)
    top = max(float(np.nanmax(known)) if np.isfinite(known).any() else 0.0, LEAST)
    for i, panel in enumerate(panels[:count]):
        mesh = _panel(panel, ds.isel(speed=i), length, Normalize(-top, top))
    scale = made.colorbar(mesh, ax=list(panels[:count]), shrink=0.7, pad=0.03, aspect=28)
    first, second = (str(label) for label in ds["ship"].values)
    scale.set_label("difference of the largest roll over a cycle [deg]\nbelow 0: the second rolls less")
    style.title(made, title)
    words = f"{second} less {first}. {HOW_TO_READ}{MIRRORED if mirrors(ds) else ''}\n{note}"
    top_of_print = style.footnote(made, words, above=0.4)
    handles: list[Any] = [
        Patch(facecolor=look["facecolor"], edgecolor=look["edgecolor"], hatch=_HATCHES[change], label=label)
        for change, (_, look, label) in _LOOKS.items()
        if (ds["change"] == int(change)).any()
    ]
    handles += [
        Line2D([], [], label=label, path_effects=OUTLINE_OF_MARK, **look)
        for which, (label, look) in _MARKS.items()
        if (ds["only_one_capsizes"] == int(which)).any()
    ]
    if handles:
        made.legend(
            handles=handles,
            loc="lower left",
            bbox_to_anchor=(0.008, top_of_print),
            ncols=3,
            frameon=False,
            handlelength=2.8,
        )
    return made


def _panel(ax: PolarAxes, ds: xr.Dataset, length: float, colours: Normalize) -> Any:
    """One speed."""
    theta, r = cell_edges(ds, length)
    marks = [(name, np.asarray(ds["change"] == int(change)), look) for change, (name, look, _) in _LOOKS.items()]
    mirrored = mirrors(ds)
    for side in (1.0, -1.0) if mirrored else (1.0,):
        mesh = paint_cells(ax, side * theta, r, np.asarray(ds["roll_difference"]), marks, colours, SCALE)
        for which, (name, look) in _MARKS.items():
            mark_cells(ax, ds["only_one_capsizes"] == int(which), length, side, name, look)
    dress(ax, r, mirrored)
    counts = [(label, int((ds["change"] == int(change)).sum())) for change, (_, _, label) in _LOOKS.items()]
    said = ", ".join(f"{n} {label}" for label, n in counts if n) or "no verdict changes"
    head(ax, f"{speed_words(float(ds['speed']), length)}\n{said}")
    return mesh

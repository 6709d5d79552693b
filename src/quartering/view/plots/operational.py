"""Operational guidance of one loading: a row for each form, a column for each sea, speed outward and heading all round."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.collections import PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.projections.polar import PolarAxes
from numpy.typing import NDArray

from quartering.study.criteria.operational import ADVICE, FORMS, NOT_RECOMMENDED, UNDECIDED
from quartering.study.seas.over_seas.map_axes import mirrors, period_of
from quartering.view.plots import style
from quartering.view.plots.polar_map import edges

COLOURS: Final = ("#f4f4f4", "#c0504d", "#f2c879", "#9a9a9a")
"""Of the advice, each of another lightness."""
HATCHES: Final = {NOT_RECOMMENDED: "////", UNDECIDED: "...."}
MOST_SEAS: Final = 4
_KNOT: Final = 1852 / 3600


def operational_picture(ds: xr.Dataset, loading: int = 0) -> Figure:
    """Draw the dataset of `quartering.operational_guidance` for one loading.

    Parameters
    ----------
    ds : Dataset
    loading : int    which one

    Returns
    -------
    Figure           head seas on top; of more than four seas the first, the last and two between
    """
    part = ds.isel(loading=loading)
    seas = [(i, j) for i in range(part.sizes["hs"]) for j in range(part.sizes[period_of(part)])]
    shown = [seas[k] for k in sorted({round(v) for v in np.linspace(0, len(seas) - 1, min(len(seas), MOST_SEAS))})]
    made = style.figure(style.PAGE, 1.95 * len(FORMS) + 0.7)
    panels = made.subplots(len(FORMS), len(shown), subplot_kw={"projection": "polar"}, squeeze=False)
    for row, form in enumerate(FORMS):
        for column, (i, j) in enumerate(shown):
            one = part.isel({"hs": i, period_of(part): j})
            _panel(panels[row, column], one, form)
            if row == 0:
                sea = f"Hs {float(one['hs']):.3g} m, Tz {float(one['tz']):.3g} s"
                panels[row, column].set_title(sea, fontsize=8.5, pad=8)
        panels[row, 0].set_ylabel(form, labelpad=26, fontsize=9)
    patches = [
        Patch(facecolor=colour, edgecolor=style.INK, hatch=HATCHES.get(k, ""), linewidth=0.5, label=ADVICE[k])
        for k, colour in enumerate(COLOURS)
    ]
    more = f" Drawn: {len(shown)} of {len(seas)} seas." if len(shown) < len(seas) else ""
    end = style.footnote(
        made, f"Bow up: the sea comes from the side of the cell; radius is speed [kn].{more}", above=0.3
    )
    made.legend(handles=patches, loc="lower center", bbox_to_anchor=(0.5, end), ncols=4, frameon=False)
    return made


def _outline(theta: NDArray[np.float64], r: NDArray[np.float64], ring: int, sector: int) -> NDArray[np.float64]:
    """Outline (n, 2) of a cell: its inner arc and back along the outer one."""
    arc = np.linspace(theta[sector], theta[sector + 1], 9)
    inner, outer = (np.stack([arc, np.full_like(arc, radius)], axis=1) for radius in (r[ring], r[ring + 1]))
    return np.concatenate([inner, outer[::-1]])


def _panel(ax: PolarAxes, one: xr.Dataset, form: str) -> None:
    heading, speed = np.asarray(one["heading"]), np.asarray(one["speed"]) / _KNOT
    mirrored = mirrors(one)
    theta, r = np.radians(edges(heading, 10.0)), np.maximum(edges(speed, 1.0), 0.0)
    if mirrored:
        theta = np.clip(theta, 0.0, np.pi)
    advice = np.asarray(one[form].transpose("speed", "heading"))
    looks: dict[str, Any] = {
        "cmap": ListedColormap(COLOURS),
        "norm": BoundaryNorm(np.arange(5) - 0.5, 4),
        "rasterized": True,
    }
    for side in (1.0, -1.0) if mirrored else (1.0,):
        ax.pcolormesh(side * theta, r, advice, **looks)
        for code, hatch in HATCHES.items():
            cells = [_outline(side * theta, r, *place) for place in np.argwhere(advice == code)]
            look = {"facecolor": "none", "edgecolor": style.INK, "linewidth": 0.0}
            ax.add_collection(PolyCollection(cells, hatch=hatch, **look), autolim=False)
    ax.set_theta_zero_location("S")
    ax.set_theta_direction(-1)
    ax.set_rlim(0.0, r[-1])
    ax.set_rticks([v for v in (5, 10, 15, 20, 25, 30, 35) if v < r[-1]])
    ax.tick_params(labelsize=6.5, pad=0)
    ax.set_thetagrids(range(0, 360, 45), ["0", "45", "90", "135", "180", "135", "90", "45"] if mirrored else None)
    ax.grid(visible=True, color="#808080", alpha=0.4, linewidth=0.5)

"""Tornado: how far each value moves roll and stability, and where the verdict flips."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from quartering.study.effects.tornado import MEASURES
from quartering.view.plots import style
from quartering.view.wording import MOST_ROWS, flip_words, row_words

LABELS: Final = {
    "roll": "roll amplitude [deg]",
    "index": "stability index S [1/s]\nabove 0: stable",
    "exponent": "leading Floquet exponent [1/s]\nbelow 0: stable",
}
_CUT = 2.5
"""A bar longer than so many times the second longest is cut, its end written on it."""

_LOOKS: Final = {
    "less": {"facecolor": "white", "edgecolor": style.INK, "hatch": "////"},
    "more": {"facecolor": style.CONTRAST[0], "edgecolor": style.INK},
}


def tornado_picture(ds: xr.Dataset, title: str, note: str) -> Figure:
    """Draw the dataset of `quartering.tornado`.

    ds: of `tornado`
    title: ship and condition
    note: what is estimated
    """
    shown = ds.isel(parameter=slice(0, MOST_ROWS))
    made = style.figure(12.5, 1.9 + 0.32 * shown.sizes["parameter"])
    panels = made.subplots(1, 3, sharey=True)
    for ax, name in zip(panels, MEASURES, strict=True):
        _bars(ax, shown, name)
    rows = np.arange(shown.sizes["parameter"])
    panels[0].set_yticks(rows, [row_words(shown.isel(parameter=i)) for i in rows])
    panels[0].invert_yaxis()
    panels[-1].tick_params(axis="y", right=False)
    beyond = panels[-1].secondary_yaxis("right")
    beyond.set_yticks(rows, [flip_words(shown.isel(parameter=i)) for i in rows])
    beyond.tick_params(length=0)
    for side in ("top", "right"):
        beyond.spines[side].set_visible(False)
    change = 100 * ds.attrs["change"]
    handles = [Patch(**look, label=f"{change:g} % {side}") for side, look in _LOOKS.items()]
    panels[1].legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)
    style.title(made, title)
    style.footnote(made, note)
    return made


def _bars(ax: Axes, ds: xr.Dataset, name: str) -> None:
    base = ds.attrs[f"base_{name}"]
    changes = np.nan_to_num(ds[name].values - base)
    most = _CUT * np.sort(np.abs(changes).max(axis=1))[-2:][0]  # one giant would hide all others
    for i, row in enumerate(changes):
        for change, look, place in zip(row, _LOOKS.values(), (i - 0.16, i + 0.16), strict=True):
            ax.barh(place, np.clip(change, -most, most), left=base, height=0.3, linewidth=0.8, **look)
            if abs(change) > most:
                side = "right" if change > 0 else "left"
                ax.text(
                    base + np.copysign(most, change), place, f"{base + change:.3g} ", ha=side, va="center", color="white",
                    fontsize=7, bbox={"facecolor": style.INK, "pad": 1.0},
                )  # fmt: skip
    ax.axvline(base, color=style.INK, linewidth=1.0)
    left, right = ax.get_xlim()
    if name != "roll" and left < 0 < right:
        ax.axvline(0.0, color=style.WARNING_INK, linewidth=1.4)
    ax.set_xlabel(LABELS[name])
    ax.xaxis.set_major_locator(MaxNLocator(5))
    ax.set_axisbelow(True)
    ax.grid(visible=False, axis="y")

"""Comfort against stability: roll amplitude and how fast disturbances die out, as a value of the loading changes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from quartering.conventions import SYMBOLS
from quartering.view.plots import style
from quartering.view.wording import condition_words, notes

_MARKS = ("o", "s", "^", "D", "v", "P")


def comfort_picture(studies: Sequence[xr.Dataset]) -> Figure:
    """Draw roll against stability, a line a heading, a column for each value of the loading.

    studies: of `quartering.vary`, each over a value of the loading and ``heading``
    Returns upper row the stability index S, lower row the decay rate by Floquet, both [1/s] and larger the more stable;
        filled mark: largest value of the loading, open mark: smallest
    """
    made = style.figure(5.0 * len(studies) + 1.6, 8.0)
    panels = made.subplots(2, len(studies), squeeze=False, sharex="col")
    for column, ds in zip(panels.T, studies, strict=True):
        name = next(str(dim) for dim in ds["roll"].dims if dim != "heading")
        _lines(column[0], ds, name, ds["index"])
        _lines(column[1], ds, name, -ds["exponent"])
        low, high = float(ds[name].min()), float(ds[name].max())
        symbol = SYMBOLS[name]
        column[0].set_title(f"{symbol.symbol} from {low:.3g} (open) to {high:.3g} {symbol.unit} (filled)")
        column[1].set_xlabel("roll amplitude [deg]")
    panels[0, 0].set_ylabel("stability index S [1/s]\nlarger: more stable")
    panels[1, 0].set_ylabel("decay rate by Floquet [1/s]\nlarger: more stable, below 0: unstable")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    made.legend(handles, labels, loc="outside right center", frameon=False, title="heading")
    style.title(made, f"{studies[0].attrs['ship']}: comfort against stability\n{condition_words(studies[0])}")
    how = "A line that climbs to the right: less roll costs stability. The decay rate is that of the slowest mode, roll or not."
    style.footnote(made, "\n".join([how, *notes(studies[0])]))
    return made


def _lines(ax: Axes, ds: xr.Dataset, name: str, stability: xr.DataArray) -> None:
    colours = style.sequence(ds.sizes["heading"])
    for i, (colour, mark) in enumerate(zip(colours, _MARKS, strict=False)):
        x = ds["roll"].isel(heading=i).values
        y = stability.isel(heading=i).transpose(name).values
        label = f"{float(ds['heading'][i]):g} deg"
        ax.plot(x, y, color=colour, marker=mark, markersize=3, markevery=(1, 4), label=label, linewidth=1.3)
        ax.plot(x[0], y[0], mark, color=colour, markerfacecolor="white", markersize=8)
        ax.plot(x[-1], y[-1], mark, color=colour, markersize=8)
    ax.set_xlim(left=0.0)
    if np.nanmin(stability.values) < 0:
        ax.axhline(0.0, color=style.WARNING_INK, linewidth=1.2)

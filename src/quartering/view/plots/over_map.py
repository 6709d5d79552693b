"""What one or two values do to a whole map: shares of its conditions, and its largest roll."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from quartering.view.plots import style
from quartering.view.plots.vary import axis_words
from quartering.view.wording import notes

SHARES = {
    "unstable": "unstable",
    "capsizing": "stable, but capsizes on the way",
    "without_answer": "no answer",
    "course_unstable": "course-unstable in calm water too",
}
_LEAST_SHARE = 5.0
"""An axis of shares reaches this far: nothing looks like much [%]."""


def over_map_picture(ds: xr.Dataset, said: str) -> Figure:
    """Draw the dataset of `over_map`: lines over one parameter, two maps over two.

    said: what the map is over
    """
    names = [str(name) for name in ds["roll_peak"].dims]
    made = style.figure(10.5, 6.2 if len(names) == 1 else 5.2)
    if len(names) == 1:
        _lines(made, ds, names[0])
    else:
        _maps(made, ds, *names)
    style.title(made, f"{ds.attrs['title']}\n{said}")
    style.footnote(made, "\n".join([f"{ds.attrs['loading']}, but for what is varied.", *notes(ds)]))
    return made


def _lines(made: Figure, ds: xr.Dataset, name: str) -> None:
    above, below = made.subplots(2, 1, sharex=True)
    x = ds[name].values
    for (key, words), look in zip(SHARES.items(), style.looks(len(SHARES)), strict=True):
        if key == "unstable" or float(ds[key].max()) > 0:
            above.plot(x, 100 * ds[key], label=words, markersize=4, **look)
    above.set_ylabel("share of the map [%]")
    above.set_ylim(0.0, max(_LEAST_SHARE, 105.0 * max(float(ds[key].max()) for key in SHARES)))
    below.plot(x, ds["roll_peak"], "o-", color=style.CONTRAST[0], markersize=4, label="largest roll of the map")
    below.set_ylabel("angle [deg]")
    below.set_ylim(bottom=0.0)
    below.set_xlabel(axis_words(ds, name))
    for ax in (above, below):
        _now(ax, ds, name)
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def _now(ax: Axes, ds: xr.Dataset, name: str) -> None:
    """A line where the ship stands today."""
    now = ds[name].attrs.get("user_value")
    if now is not None and float(ds[name].min()) <= now <= float(ds[name].max()):
        ax.axvline(now, color=style.QUIET, linestyle=":", linewidth=1.2, label=f"now, {now:.4g}")


def _maps(made: Figure, ds: xr.Dataset, along: str, up: str) -> None:
    panels = made.subplots(1, 2, sharey=True)
    x, y = ds[along].values, ds[up].values
    fields = (
        (100 * ds["unstable"], "unstable share of the map [%]"),
        (ds["roll_peak"], "largest roll of the map [deg]"),
    )
    for ax, (values, label) in zip(panels, fields, strict=True):
        field = np.ma.masked_invalid(values.values.T)
        mesh = ax.pcolormesh(x, y, field, cmap=style.SEQUENTIAL, shading="nearest", rasterized=True, vmin=0.0)
        if label.endswith("[%]") and float(values.max()) < _LEAST_SHARE:
            mesh.set_clim(0.0, _LEAST_SHARE)
        made.colorbar(mesh, ax=ax, label=label, shrink=0.9)
        ax.set_facecolor("#b8b8b8")
        now = [ds[name].attrs.get("user_value") for name in (along, up)]
        if None not in now:
            ax.plot(*now, "o", color="white", markeredgecolor=style.INK, markersize=7)
        ax.grid(visible=False)
        ax.set_xlabel(axis_words(ds, along))
        ax.set_title(label.split(" [")[0] + ("" if None in now else "; dot: now"))
    panels[0].set_ylabel(axis_words(ds, up))

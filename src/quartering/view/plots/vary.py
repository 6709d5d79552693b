"""One or two values varied: curves of response and growth rates, or maps with the boundary of stability."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from quartering.conventions import SYMBOLS
from quartering.stability.kind import Kind
from quartering.study.effects.vary import varied
from quartering.view.plots import style
from quartering.view.wording import condition_words, notes

SHADE = "#e3e3e3"
HATCH = "////"


def vary_picture(ds: xr.Dataset) -> Figure:
    """Draw the dataset of `quartering.vary`.

    ds: over one or two parameters
    Returns curves for one parameter, maps for two
    """
    names = varied(ds)
    made = style.figure(10.5, 6.6 if len(names) == 1 else 5.2)
    if len(names) == 1:
        _curves(made, ds, names[0])
    else:
        _maps(made, ds, *names)
    style.title(made, f"{ds.attrs['title']}\n{condition_words(ds)}; {ds.attrs['loading']}, but for what is varied")
    style.footnote(made, "\n".join(notes(ds)))
    return made


def axis_words(ds: xr.Dataset, name: str) -> str:
    """Label of a parameter's axis: name, letter and unit."""
    if name not in SYMBOLS:
        return f"{name} over its present value"
    unit = str(ds[name].attrs["units"])
    return f"{SYMBOLS[name].meaning.split(':')[0]}, {SYMBOLS[name].symbol}" + ("" if unit == "1" else f" [{unit}]")


def _curves(made: Figure, ds: xr.Dataset, name: str) -> None:
    above, below = made.subplots(2, 1, sharex=True)
    x = ds[name].values
    for ax in (above, below):
        _unstable_spans(ax, ds, name)
        if "user_value" in ds[name].attrs:
            ax.axvline(ds[name].attrs["user_value"], color=style.QUIET, linestyle=":", linewidth=1.2)
        for flip in ds["flip"].values:
            ax.axvline(flip, color=style.WARNING_INK, linewidth=1.2)
    lines = (
        ("roll_peak", "largest roll over a cycle", "-", style.CONTRAST[0]),
        ("yaw", "yaw amplitude, fundamental", "--", style.CONTRAST[1]),
    )
    for quantity, label, dash, colour in lines:
        above.plot(x, ds[quantity], dash, color=colour, label=label)
    above.set_ylabel("angle [deg]")
    above.set_ylim(bottom=0.0)
    below.plot(x, ds["exponent"], "-", color=style.CONTRAST[0], label="leading Floquet exponent (decides)")
    below.plot(x, -ds["index"], "--", color=style.CONTRAST[1], label="K2/(2 n2) = -S: roll, first order")
    below.axhline(0.0, color=style.INK, linewidth=0.8)
    below.set_ylabel("growth rate [1/s]\nbelow 0: stable")
    below.set_xlabel(axis_words(ds, name))
    if "user_value" in ds[name].attrs:
        above.plot([], [], color=style.QUIET, linestyle=":", label=f"now, {ds[name].attrs['user_value']:.4g}")
    if ds["flip"].size:
        flips = ", ".join(f"{flip:.4g}" for flip in ds["flip"].values)
        above.plot([], [], color=style.WARNING_INK, label=f"verdict flips at {flips}")
    for ax in (above, below):
        ax.set_xlim(x[0], x[-1])
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def _unstable_spans(ax: Axes, ds: xr.Dataset, name: str) -> None:
    """Shade where the motion is unstable, from flip to flip."""
    x, kinds = ds[name].values, ds["verdict"].values
    edges = np.concatenate([x[:1], ds["flip"].values, x[-1:]])
    states = np.concatenate([kinds[:1], ds["verdict_above"].values])
    for left, right, kind in zip(edges[:-1], edges[1:], states, strict=True):
        if kind > Kind.STABLE:
            ax.axvspan(left, right, facecolor=SHADE, edgecolor="white", hatch=HATCH, linewidth=0.0, zorder=0)


def _maps(made: Figure, ds: xr.Dataset, along: str, up: str) -> None:
    panels = made.subplots(1, 2, sharey=True)
    x, y = ds[along].values, ds[up].values
    columns = (("roll_peak", "largest roll over a cycle [deg]"), ("exponent", "leading Floquet exponent [1/s]"))
    for ax, (quantity, label) in zip(panels, columns, strict=True):
        field = np.ma.masked_invalid(ds[quantity].values.T)
        mesh = ax.pcolormesh(x, y, field, cmap=style.SEQUENTIAL, shading="nearest", rasterized=True)
        made.colorbar(mesh, ax=ax, label=label, shrink=0.9)
        ax.set_facecolor("#b8b8b8")
        unstable = (ds["verdict"].values.T > Kind.STABLE).astype(float)
        if unstable.any():
            ax.contourf(x, y, unstable, levels=[0.5, 1.5], colors="none", hatches=[HATCH])
        exponent = np.ma.masked_invalid(ds["exponent"].values.T)
        if exponent.count() and exponent.min() < 0 < exponent.max():
            ax.contour(x, y, exponent, levels=[0.0], colors="white", linewidths=2.4)
            ax.contour(x, y, exponent, levels=[0.0], colors=style.INK, linewidths=1.0)
        now = [ds[name].attrs.get("user_value") for name in (along, up)]
        if None not in now:
            ax.plot(*now, "o", color="white", markeredgecolor=style.INK, markersize=7)
        ax.set_xlim(x[0], x[-1])
        ax.set_ylim(y[0], y[-1])
        ax.grid(visible=False)
        ax.set_xlabel(axis_words(ds, along))
        ax.set_title(f"{label.split(' [')[0]}; hatched: unstable{'' if None in now else '; dot: now'}")
    panels[0].set_ylabel(axis_words(ds, up))

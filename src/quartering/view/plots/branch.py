"""Response curves: stable motions solid, unstable ones dashed, folds and bifurcations marked, multipliers beside them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from quartering.conventions import headed, in_unit
from quartering.stability.kind import Kind
from quartering.view.plots import style

MARKS = {"fold": "s", "symmetry-breaking": "^", "period-doubling": "D", "neimark-sacker": "o"}
CURVES = {
    "start": (style.CONTRAST[0], "from the lower limit"),
    "symmetry-breaking": (style.CONTRAST[1], "leaning"),
    "period-doubling": (style.CONTRAST[2], "two wave periods"),
    "search": (style.CONTRAST[3], "a curve of its own"),
}
_REACH = 1.6


def branch_picture(ds: xr.Dataset, over: str, title: str, note: str = "", asked: float | None = None) -> Figure:
    """Draw the dataset of `quartering.branch`.

    over: the parameter
    note: more small print
    asked: value of the parameter that was typed
    Returns largest roll over the parameter, and the Floquet multipliers in the complex plane
    """
    made = style.figure(11.0, 5.6)
    curve, circle = made.subplots(1, 2, width_ratios=(2.0, 1.0))
    curves_on(curve, ds, over)
    unit = str(ds[over].attrs["units"])
    if asked is not None and float(ds[over].min()) <= asked <= float(ds[over].max()):
        label = f"asked: {asked:.4g}{in_unit(unit)}"
        curve.axvline(asked, color=style.WARNING_INK, linestyle=":", linewidth=1.4, zorder=1, label=label)
        curve.legend(loc="upper left", frameon=False)
    multipliers_on(circle, ds)
    style.title(made, title)
    words = (
        "Solid: stable, dashed: unstable, by Floquet multipliers over one period of the motion; stable inside the circle."
        f" Multipliers beyond {_REACH:g} are not drawn."
    )
    top_of_print = style.footnote(made, f"{words}\n{note}", above=0.4)
    made.legend(handles=_legend(ds), loc="lower center", bbox_to_anchor=(0.5, top_of_print), ncols=5, frameon=False)
    return made


def curves_on(ax: Axes, ds: xr.Dataset, over: str) -> None:
    """Draw the curves and their events into an axes."""
    for number in np.unique(ds["curve"]):
        own = ds.isel(point=np.flatnonzero(ds["curve"] == number))
        x, y = np.asarray(own[over]), np.asarray(own["roll_peak"])
        stable = np.asarray(own["verdict"]) == Kind.STABLE
        marked = np.asarray(own["event"]) != ""
        colour = CURVES[str(own["origin"].values[0])][0]
        # A piece runs from one change to the next; an event itself belongs to both sides.
        plain = np.flatnonzero(~marked)
        cuts = [0, *(int(b) for a, b in pairwise(plain.tolist()) if stable[a] != stable[b]), int(x.size)]
        for first, last in pairwise(cuts):
            inside = plain[(plain >= first) & (plain < last)]
            if inside.size:
                begin = first - 1 if first > 0 and marked[first - 1] else first
                dash = "-" if stable[inside[0]] else "--"
                end = min(last + (1 if last < x.size and marked[last - 1] else 0), x.size)
                ax.plot(x[begin:end], y[begin:end], color=colour, linestyle=dash, linewidth=1.7)
    for event, mark in MARKS.items():
        at = np.flatnonzero(ds["event"] == event)
        ax.plot(
            ds[over][at], ds["roll_peak"][at], mark, color=style.INK, markerfacecolor="white", markersize=6, zorder=4
        )
    ax.set_xlabel(headed(over, str(ds[over].attrs["units"])))
    ax.set_ylabel("largest roll over a cycle [deg]")
    upright = float(ds["roll_peak"].min()) == 0.0 and float(ds["roll_peak"].max()) > 0.0
    ax.set_ylim(bottom=-0.015 * float(ds["roll_peak"].max()) if upright else 0.0)


def multipliers_on(ax: Axes, ds: xr.Dataset) -> None:
    """Draw the Floquet multipliers of all motions and the unit circle into an axes."""
    turn = np.linspace(0.0, 2 * np.pi, 181)
    ax.plot(np.cos(turn), np.sin(turn), color=style.INK, linewidth=1.0)
    for number in np.unique(ds["curve"]):
        own = ds.isel(point=np.flatnonzero(ds["curve"] == number))
        z = (np.asarray(own["multiplier_real"]) + 1j * np.asarray(own["multiplier_imag"])).ravel()
        z = z[np.abs(z) < _REACH]
        colour = CURVES[str(own["origin"].values[0])][0]
        for part, fill in ((np.abs(z) <= 1.0, colour), (np.abs(z) > 1.0, "white")):
            ax.plot(
                z[part].real, z[part].imag, "o", color=colour, markerfacecolor=fill, markersize=3.5, markeredgewidth=0.8
            )
    ax.set_aspect("equal")
    ax.set_xlim(-_REACH, _REACH)
    ax.set_ylim(-_REACH, _REACH)
    ax.set_xlabel("Re μ")
    ax.set_ylabel("Im μ")
    ax.set_title("Floquet multipliers")


def _legend(ds: xr.Dataset) -> list[Line2D]:
    """What colours, dashes and marks mean, those that occur."""
    made = [
        Line2D([], [], color=colour, label=words)
        for origin, (colour, words) in CURVES.items()
        if (ds["origin"] == origin).any()
    ]
    made += [Line2D([], [], color=style.QUIET, linestyle=d, label=w) for d, w in (("-", "stable"), ("--", "unstable"))]
    return made + [
        Line2D([], [], color=style.INK, marker=mark, markerfacecolor="white", linestyle="none", label=event)
        for event, mark in MARKS.items()
        if (ds["event"] == event).any()
    ]

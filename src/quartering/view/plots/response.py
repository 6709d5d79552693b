"""Roll, sway and yaw over heading, a line for each speed and wave length, unstable motions marked."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from quartering.conventions import SYMBOLS
from quartering.stability.kind import Kind
from quartering.view.plots import style
from quartering.view.wording import notes, speed_words, wave_words

MARKS = {"unstable": "x", "course-unstable even in calm water": "."}


def response_picture(ds: xr.Dataset, columns: int = 3) -> Figure:
    """Draw a map of few wave lengths as lines over heading.

    ds: of `quartering.polar`, dims speed, heading, wave_length
    columns: panels beside each other: 3 for a screen, or 2, with the legend in the empty corner, for a page
    """
    made = style.figure(13.0, 5.4) if columns == 3 else style.figure(style.PAGE, 7.0)
    panels = made.subplots(-(-3 // columns), columns).ravel()
    ratio = np.asarray(ds["wave_length"]) / float(ds.attrs["ship_length"])
    colours = style.sequence(ds.sizes["speed"])
    for ax, name in zip(panels[:3], ("roll_peak", "sway", "yaw"), strict=True):
        for i, colour in enumerate(colours):
            for j, dash in zip(range(ratio.size), style.DASHES, strict=False):
                _line(ax, ds.isel(speed=i, wave_length=j), name, colour, dash)
        style.headings(ax, float(ds["heading"].max()))
        ax.set_ylim(bottom=0.0)
        what = "largest roll over a cycle" if name == "roll_peak" else f"{name} amplitude, fundamental"
        ax.set_ylabel(f"{what} [{SYMBOLS[name].unit}]")
        ax.set_title(name.removesuffix("_peak").capitalize())
    length = float(ds.attrs["ship_length"])
    handles = [
        Line2D([], [], color=c, label=speed_words(float(u), length)) for c, u in zip(colours, ds["speed"], strict=True)
    ]
    handles += [
        Line2D([], [], color=style.INK, linestyle=d, label=f"λ/L = {x:.3g}")
        for d, x in zip(style.DASHES, ratio, strict=False)
    ]
    handles += [
        Line2D([], [], color=style.WARNING_INK, linestyle="none", marker=mark, label=label)
        for label, mark in MARKS.items()
        if _unstable(ds, label).any()
    ]
    if columns == 3:
        made.legend(handles=handles, loc="outside right center", frameon=False)
    else:
        panels[3].set_axis_off()
        panels[3].legend(handles=handles, loc="center", frameon=False)
    style.title(made, f"{ds.attrs['ship']}: response in regular waves, {wave_words(ds)}\n{ds.attrs['loading']}")
    style.footnote(made, "\n".join(notes(ds)))
    return made


def _line(ax: object, ds: xr.Dataset, name: str, colour: object, dash: str) -> None:
    heading, amplitude = np.asarray(ds["heading"]), np.asarray(ds[name])
    ax.plot(heading, amplitude, color=colour, linestyle=dash, linewidth=1.5)  # type: ignore[attr-defined]
    for label, mark in MARKS.items():
        here = _unstable(ds, label)
        if here.any():
            ax.plot(  # type: ignore[attr-defined]
                heading[here], amplitude[here], marker=mark, color=style.WARNING_INK, linestyle="none", markersize=5
            )


def _unstable(ds: xr.Dataset, label: str) -> np.ndarray:
    kind = np.asarray(ds["verdict"])
    calm = kind == Kind.COURSE_IN_CALM_WATER
    return (kind > Kind.STABLE) & ~calm if label == "unstable" else calm

"""The safe basin over roll angle and rate, and its integrity over wave height."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from quartering.view.plots import style

SAFE = "#d7ebf7"
"""Colour of starts that do not capsize."""


def basin_picture(
    ds: xr.Dataset,
    curve: tuple[NDArray[np.float64], NDArray[np.float64]],
    height: float,
    limit: str,
    title: str,
    note: str = "",
) -> Figure:
    """Draw a safe basin and the integrity curve.

    ds: of `quartering.motion.transient.basin.basin`
    curve (heights, integrity): [m], share of the calm-water basin
    height: of the basin drawn [m]
    limit: roll that counts as capsize, in words
    note: more small print
    """
    made = style.figure(11.0, 4.8)
    left, right = made.subplots(1, 2, width_ratios=(1.5, 1.0))
    mesh = basin_on(left, ds)
    if mesh is not None:
        made.colorbar(mesh, ax=left, label="time to capsize [s]", aspect=30)
    left.set_title(f"Starts in waves of {height:g} m")
    left.legend(handles=[Patch(facecolor=SAFE, edgecolor=style.QUIET, label="safe")], loc="upper right", framealpha=0.9)
    integrity_on(right, *curve, height)
    style.title(made, title)
    style.footnote(
        made,
        f"Capsize: roll past {limit}. Sway velocity and yaw rate start at zero, at one phase of the wave. Integrity:"
        f" safe starts as a share of those safe in calm water.\n{note}",
    )
    return made


def basin_on(ax: Axes, ds: xr.Dataset) -> object | None:
    """Draw a safe basin into an axes; gives the coloured mesh, None when every start is safe."""
    time = np.ma.masked_invalid(ds["capsize_time"].values)
    ax.set_facecolor(SAFE)
    mesh = None
    if not np.all(time.mask):
        mesh = ax.pcolormesh(
            ds["roll"], ds["roll_rate"], time, cmap=style.SEQUENTIAL, shading="nearest", rasterized=True
        )
    ax.set_xlim(float(ds["roll"][0]), float(ds["roll"][-1]))
    ax.set_ylim(float(ds["roll_rate"][0]), float(ds["roll_rate"][-1]))
    ax.set_xlabel("roll angle at the start [deg]")
    ax.set_ylabel("roll rate at the start [deg/s]")
    ax.grid(visible=False)
    return mesh


def integrity_on(ax: Axes, heights: NDArray[np.float64], integrity: NDArray[np.float64], height: float) -> None:
    """Draw the integrity curve into an axes."""
    ax.plot(heights, 100.0 * integrity, "o-", color=style.CONTRAST[0], linewidth=1.5, markersize=4)
    ax.axvline(height, color=style.INK, linestyle=":", linewidth=1.0)
    ax.annotate(
        "drawn on the left", (height, 4.0), xytext=(3, 0), textcoords="offset points", fontsize=7.5, rotation=90
    )
    ax.set_xlabel("wave height [m]")
    ax.set_ylabel("safe basin left [% of calm water]")
    ax.set_ylim(0.0, 105.0)
    ax.set_title("Integrity")

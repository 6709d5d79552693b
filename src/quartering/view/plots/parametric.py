"""Parametric roll over speed and wave height: the roll that settles, where it begins, and where nothing stable was found."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from quartering.view.plots import style


def parametric_picture(ds: xr.Dataset) -> Figure:
    """Draw the dataset of `quartering.parametric_map`.

    ds: over speed and wave_height, at least two of each
    Returns colour: the largest stable roll; line: small roll neither grows nor decays; dashes: the margin of roll alone
        is 1; hatched: small roll grows and no stable motion was found
    """
    made = style.figure(style.PAGE, 5.2)
    ax = made.subplots()
    speed, height = np.asarray(ds["speed"]), np.asarray(ds["wave_height"])
    growth, roll, margin = (np.asarray(ds[name]).T for name in ("growth", "roll_settled", "margin"))
    shown = np.where(roll > 0, roll, np.nan)
    mesh = ax.pcolormesh(speed, height, shown, cmap=style.SEQUENTIAL, shading="nearest", vmin=0.0)
    made.colorbar(mesh, ax=ax, label="largest roll of two wave periods [deg]")
    lost = (growth > 0) & ~(roll > 0)
    handles = [
        Patch(facecolor="none", edgecolor=style.INK, label="line: small roll begins to grow"),
        Patch(facecolor="none", edgecolor=style.QUIET, linestyle="--", label="dashes: roll alone, closed form"),
    ]
    if lost.any():
        mask = np.ma.masked_where(~lost, np.ones_like(growth))
        ax.pcolor(speed, height, mask, hatch="xx", facecolor="#f3d1dc", edgecolor=style.WARNING_INK, linewidth=0.0,
                  shading="nearest", cmap=None, alpha=0.6)  # fmt: skip
        handles.append(
            Patch(facecolor="#f3d1dc", edgecolor=style.WARNING_INK, hatch="xx", label="grows, no stable roll found")
        )
    for values, level, colour, dash in ((growth, 0.0, style.INK, "-"), (margin, 1.0, style.QUIET, "--")):
        if np.nanmin(values) < level < np.nanmax(values):
            ax.contour(speed, height, values, levels=[level], colors=colour, linewidths=1.3, linestyles=dash)
    ax.set_xlabel("speed [m/s]")
    ax.set_ylabel("wave height [m]")
    sea = "head" if ds.attrs["heading"] == 180.0 else "following"
    ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False)
    style.title(
        made,
        f"{ds.attrs['ship']}: parametric roll in {sea} seas of {ds.attrs['wave_length']:.4g} m\n{ds.attrs['loading']}",
    )
    return made

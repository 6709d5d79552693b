"""Motion in time: roll, sway velocity and yaw rate."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from quartering.view.plots import style


def trace_picture(trace: xr.Dataset, steady_roll: float | None, title: str, note: str) -> Figure:
    """Draw the dataset of `quartering.simulate`.

    trace: sway_velocity, roll, yaw_rate over time
    steady_roll: largest roll of the steady motion, None when there is none [deg]
    """
    made = style.figure(11.0, 6.4)
    panels = made.subplots(3, 1, sharex=True, height_ratios=(1.6, 1.0, 1.0))
    names = ("roll", "sway_velocity", "yaw_rate")
    for ax, name, colour in zip(panels, names, style.CONTRAST, strict=False):
        ax.plot(trace["time"], trace[name], color=colour, linewidth=1.1)
        ax.set_ylabel(f"{name.replace('_', ' ')}\n[{trace[name].attrs['units']}]")
    if steady_roll is not None:
        for side in (1, -1):
            words = f"steady motion, ±{steady_roll:.3g}°" if side > 0 else None
            panels[0].axhline(side * steady_roll, color=style.INK, linestyle="--", linewidth=0.9, label=words)
        panels[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), frameon=False, borderaxespad=0.2)
    panels[-1].set_xlabel("time [s]")
    panels[-1].set_xlim(0.0, float(trace["time"][-1]))
    made.align_ylabels(panels)
    style.title(made, title)
    style.footnote(made, note)
    return made

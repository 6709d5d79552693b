"""Wave forces over heading: sway force, roll and yaw moment, for several wave lengths and diffraction forms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from quartering.view.plots import style
from quartering.view.wording import metric_prefix

PANELS = (("sway", "sway force |Y| / A", "N/m"), ("roll", "roll moment |K| / A", "N m/m"),
          ("yaw", "yaw moment |N| / A", "N m/m"))  # fmt: skip


def forces_picture(amplitudes: Mapping[str, xr.DataArray], title: str, note: str) -> Figure:
    """Amplitude of the wave forces per metre of wave amplitude.

    Parameters
    ----------
    amplitudes : mapping of form to DataArray    dims wave_length, heading, mode; coordinate ``ratio`` = length / L [N/m]
    title, note : str

    Returns
    -------
    Figure
    """
    made = style.figure(13.0, 5.2, bottom=0.45)
    panels = made.subplots(1, 3)
    lengths = next(iter(amplitudes.values()))["ratio"].values
    colours = style.sequence(len(lengths))
    for ax, (mode, words, unit) in zip(panels, PANELS, strict=True):
        scale, prefix = metric_prefix(max(float(field.sel(mode=mode).max()) for field in amplitudes.values()))
        for (_, field), dash in zip(amplitudes.items(), style.DASHES, strict=False):
            for i, colour in enumerate(colours):
                shown = field.isel(wave_length=i).sel(mode=mode)
                ax.plot(np.asarray(field["heading"]), shown / scale, color=colour, linestyle=dash, linewidth=1.5)
        style.headings(ax)
        ax.set_ylim(bottom=0.0)
        ax.set_ylabel(f"{words} [{prefix}{unit}]")
        ax.set_title(mode.capitalize())
    handles = [Line2D([], [], color=c, label=f"λ/L = {x:.3g}") for c, x in zip(colours, lengths, strict=True)]
    handles += [
        Line2D([], [], color=style.INK, linestyle=dash, label=form)
        for form, dash in zip(amplitudes, style.DASHES, strict=False)
    ]
    made.legend(handles=handles, loc="outside right center", frameon=False)
    style.title(made, title)
    style.footnote(made, note)
    return made

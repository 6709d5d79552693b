"""The likeliest way to a rare roll, over time."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from quartering.view.plots import style


def design_point_picture(ds: xr.Dataset) -> Figure:
    """Draw the roll of the likeliest window of `quartering.design_point`."""
    made = style.figure(style.PAGE, 3.6)
    ax = made.subplots()
    ax.plot(ds["time"], ds["roll"], color=style.CONTRAST[0], linewidth=1.2)
    level = float(ds.attrs["level"])
    ax.axhline(level, color=style.INK, linestyle="--", linewidth=0.9, label=f"roll of {level:.3g} deg")
    ax.set(xlabel="time before the roll [s]", ylabel="roll [deg]", xlim=(float(ds["time"][0]), 0.0))
    ax.legend(loc="upper left")
    style.title(made, f"{ds.attrs['ship']}: likeliest way to a roll of {level:.3g} deg\n{ds.attrs['seas']}")
    chance, error = float(ds["probability"]), float(ds["probability_error"])
    style.footnote(
        made,
        f"{ds.attrs['speed']:.4g} m/s, heading {float(ds['heading']):g} deg; from rest. Distance {float(ds['beta']):.3g}"
        f" deviations; probability at an instant {chance:.2g} ± {error:.1g}, sampled in {ds.attrs['windows']} windows, seed"
        f" {ds.attrs['seed']}.",
    )
    return made

"""Equilibria of a ship that a wave carries along, over the heading ordered."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from quartering.view.plots import style

_CURVES: Final = (("yaw", "heading off the wave"), ("rudder", "rudder"), ("heel", "heel"))
_EVENTS: Final = ((1, "s", "the wave lets the ship go (fold)"), (2, "o", "swings begin (Hopf)"))


def broaching_picture(ds: xr.Dataset) -> Figure:
    """Draw the dataset of `quartering.broaching_branch` over the heading.

    Parameters
    ----------
    ds : Dataset

    Returns
    -------
    Figure    left: angles of the equilibria, right: growth of the fastest disturbance; thick where stable, else dashes
    """
    made = style.figure(style.PAGE, 4.6)
    left, right = made.subplots(1, 2)
    ordered, growth = np.asarray(ds["heading"]), np.asarray(ds["growth"])
    stable = growth <= 0
    for (name, words), look in zip(_CURVES, style.CONTRAST, strict=False):
        values = np.asarray(ds[name])
        left.plot(ordered, values, color=look, linewidth=1.0, linestyle="--")
        left.plot(ordered, np.where(stable, values, np.nan), color=look, linewidth=2.4, label=words)
        _events(left, ds, ordered, values)
    left.set_ylabel("[deg]")
    left.legend(loc="best")
    right.plot(ordered, growth, color=style.INK, linewidth=1.0, linestyle="--")
    right.plot(ordered, np.where(stable, growth, np.nan), color=style.INK, linewidth=2.4)
    right.axhline(0.0, color=style.QUIET, linewidth=0.8)
    _events(right, ds, ordered, growth, labelled=True)
    right.set_ylabel("growth of the fastest disturbance [1/s]")
    if np.asarray(ds["event"]).any():
        right.legend(loc="best")
    for ax in (left, right):
        ax.set_xlabel("heading ordered, off the wave's direction [deg]")
    at = f"{ds.attrs['wave_length']:.4g} m long and {ds.attrs['wave_height']:.3g} m high"
    style.title(made, f"{ds.attrs['ship']}: carried along by a wave {at}")
    style.footnote(
        made,
        f"Thick: stable. Dashes: unstable. Autopilot: {ds.attrs['autopilot']}; {float(ds['revolutions'][0]):.3g} revolutions a "
        f"second. Resistance and thrust {ds.attrs['propulsion']}.",
    )
    return made


def _events(ax: object, ds: xr.Dataset, x: np.ndarray, y: np.ndarray, *, labelled: bool = False) -> None:
    for code, marker, words in _EVENTS:
        here = np.asarray(ds["event"]) == code
        if here.any():
            ax.plot(  # type: ignore[attr-defined]
                x[here], y[here], marker, color=style.WARNING_INK, markersize=6, mfc="white", label=words if labelled else None
            )  # fmt: skip

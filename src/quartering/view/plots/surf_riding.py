"""Surf-riding diagram: what becomes of a ship over its nominal Froude number, steepness and length of the wave."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from quartering.conventions import GRAVITY
from quartering.view.plots import style

_FILLS: Final = (
    ("wave passes, ship surges", "#ffffff", ""),
    ("may be caught, by its start", "#d3e3f0", ""),
    ("caught from any start", "#6f9fc8", ""),
    ("faster than the wave, may be held", "#f0e0c8", ".."),
)
"""What becomes of the ship, lightness rising with danger, and hatches that print."""
_MOST: Final = 0.65
"""Froude number up to which the axes go."""
_KNOT: Final = 1852 / 3600


def surf_riding_picture(over_steepness: xr.Dataset, over_length: xr.Dataset, froude: float = math.nan) -> Figure:
    """Draw two datasets of `quartering.surf_riding_map`.

    Parameters
    ----------
    over_steepness : Dataset    one wave length
    over_length : Dataset       one steepness
    froude : float              nominal Froude number of the ship, drawn as a line; NaN: none

    Returns
    -------
    Figure
    """
    made = style.figure(style.PAGE, 4.9)
    left, right = made.subplots(1, 2)
    size = float(over_steepness.attrs["ship_length"])
    length, steep = float(over_steepness["wave_length"][0]), float(over_length["steepness"][0])
    top = max(_MOST, 1.05 * froude) if math.isfinite(froude) else _MOST
    _panel(left, over_steepness.isel(wave_length=0), np.asarray(over_steepness["steepness"]), froude, top)
    _panel(right, over_length.isel(steepness=0), np.asarray(over_length["wave_length"]) / size, froude, top)
    left.set_ylabel("wave height over length [-]")
    right.set_ylabel("wave length over ship length [-]")
    left.set_title(f"waves of {length:.4g} m, {length / size:.3g} of the ship's length", loc="left")
    right.set_title(f"waves {steep:.3g} of their length high", loc="left")
    unit = math.sqrt(GRAVITY * size) / _KNOT
    for ax in (left, right):
        ax.set_xlabel("nominal Froude number, that of the ship in calm water [-]")
        knots = ax.secondary_xaxis("top", functions=(lambda fn: fn * unit, lambda kn: kn / unit))
        knots.set_xlabel("[kn]", fontsize=8, labelpad=2)
        knots.tick_params(labelsize=8)
    handles: list[Patch] = [
        Patch(facecolor=colour, edgecolor=style.INK, hatch=hatch, linewidth=0.6, label=words)
        for words, colour, hatch in _FILLS
    ]
    style.title(made, f"{over_steepness.attrs['ship']}: surf-riding in following waves")
    above = style.footnote(
        made,
        "Thick: every start is caught (dashes: by Melnikov's method). Thin: some starts are caught. Dotted: celerity of the "
        "wave.\n"
        f"Resistance and thrust {over_steepness.attrs['propulsion']}.",
        above=0.3,
    )
    made.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, above), ncols=4, frameon=False)
    return made


def _panel(ax: Axes, ds: xr.Dataset, y: np.ndarray, froude: float, top: float) -> None:
    """Regions and lines over one axis of the waves."""
    first, second, celerity, last = (np.asarray(ds[name]) for name in ("first", "second", "celerity", "last"))
    second = np.where(np.isfinite(second), np.fmin(second, celerity), celerity)
    last = np.where(np.isfinite(last), np.maximum(last, celerity), 9.0)
    between = ((first, second), (second, celerity), (celerity, last))
    for (low, high), (_, colour, hatch) in zip(between, _FILLS[1:], strict=True):
        style_of = {"facecolor": colour, "edgecolor": style.QUIET, "hatch": hatch, "linewidth": 0}
        ax.fill_betweenx(y, low, high, where=high > low, **style_of)
    ax.plot(first, y, color=style.INK, linewidth=0.9)
    ax.plot(np.asarray(ds["second"]), y, color=style.INK, linewidth=2.0)
    ax.plot(np.asarray(ds["second_melnikov"]), y, color=style.INK, linewidth=1.2, linestyle="--")
    ax.plot(celerity, y, color=style.INK, linewidth=1.2, linestyle=":")
    if math.isfinite(froude):
        ax.axvline(froude, color=style.WARNING_INK, linewidth=1.6)
        at = (froude, 0.95)
        words, look = f"ship, Fn {froude:.3g} ", {"color": style.WARNING_INK, "fontsize": 8, "ha": "right"}
        ax.annotate(words, at, xycoords=("data", "axes fraction"), **look)
    ax.set_xlim(0.0, top)
    ax.set_ylim(float(y.min()), float(y.max()))

"""The small print of the paper's figures: ship, condition, loading, and what is estimated."""

from __future__ import annotations

import numpy as np
import xarray as xr

from quartering.hull.ship import Ship
from quartering.view.wording import forces_note, notes, speed_words, steepness_words

OURS = "The condition is ours: the paper's own is not known here."


def force_caption(one: Ship, compared: xr.Dataset) -> str:
    """Ship, speed, height of G, and what the forces are.

    compared: of `compare_forces` for it
    """
    where = f"{one.name}, {speed_words(float(compared.attrs['speed']), one.hull.length)}"
    loading = f"GM {one.loading.gm:.4g} m, KG {one.loading.kg:.4g} m (GM assumed)"
    return f"{where}; {loading}. Per metre of wave amplitude A. {OURS}\n{forces_note(compared)}"


def caption(ds: xr.Dataset, *more: str, loading: str = "") -> str:
    """Ship, speed, waves, loading, what is estimated.

    ds: of `study.paper.curves`
    *more: further sentences
    loading: in place of the dataset's own loading
    """
    where = f"{ds.attrs['ship']}, {speed_words(float(ds['speed']), float(ds.attrs['ship_length']))}"
    said = "; ".join((where, wave_of(ds), loading or str(ds.attrs["loading"])))
    return "\n".join(part for part in (f"{said}. {OURS}", *notes(ds), *more) if part)


def wave_of(ds: xr.Dataset) -> str:
    """Length and steepness of the waves of a dataset."""
    length, height = (np.atleast_1d(np.asarray(ds[name], dtype=float)) for name in ("wave_length", "wave_height"))
    share = length / float(ds.attrs["ship_length"])
    shown = ", ".join(f"{x:.3g}" for x in share)
    return f"waves λ/L = {shown}, H/λ = {steepness_words(float(height[0] / length[0]))}"

"""The small print of the paper's figures: ship, condition, loading, and what is estimated."""

from __future__ import annotations

import numpy as np
import xarray as xr

from quartering.view.wording import notes, speed_words, steepness_words

OURS = "The condition is ours: the paper's own is not known here."


def force_caption(ds: xr.Dataset) -> str:
    """Ship, speed, height of G, and what the forces are about.

    Parameters
    ----------
    ds : Dataset    of `force_curves`

    Returns
    -------
    str
    """
    where = f"{ds.attrs['ship']}, {speed_words(float(ds['speed']), float(ds.attrs['ship_length']))}"
    loading = ", ".join(str(ds.attrs["loading"]).split(", ")[:2])
    return f"{where}; {loading} (GM assumed). Per metre of wave amplitude A; moments about G. {OURS}"


def caption(ds: xr.Dataset, *more: str, loading: str = "") -> str:
    """Ship, speed, waves, loading, what is estimated.

    Parameters
    ----------
    ds : Dataset       of `study.paper.curves`
    *more : str        further sentences
    loading : str      in place of the dataset's own loading

    Returns
    -------
    str
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

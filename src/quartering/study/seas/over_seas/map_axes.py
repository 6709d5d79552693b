"""Axes of a map over seas: which period is one, and whether its headings stand for both sides of the ship."""

from __future__ import annotations

import xarray as xr


def period_of(found: xr.Dataset) -> str:
    """Dimension of periods: tz, or tp where the mean period hangs on the height too.

    >>> period_of(xr.Dataset(coords={"tp": [8.0, 9.0]}))
    'tp'
    """
    return "tp" if "tp" in found.dims else "tz"


def dims_of(found: xr.Dataset) -> tuple[str, ...]:
    """Dimensions of operational guidance, in their order."""
    return ("loading", "hs", period_of(found), "speed", "heading")


def mirrors(found: xr.Dataset) -> bool:
    """Do headings from 0 to 180 stand for the other side too?

    >>> mirrors(xr.Dataset(coords={"heading": [0.0, 90.0, 270.0]}))
    False
    """
    heading = found["heading"].values
    return bool((heading >= 0).all() and (heading <= 180).all()) and found.attrs.get("sides") != "differ"

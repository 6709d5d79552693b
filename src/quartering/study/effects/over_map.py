"""What one or two values do to a whole map: the share of its conditions that is unstable, and its largest roll."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import written
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.study.effects.vary import checked_parameters, present_value, unstacked
from quartering.study.grid import CONDITION_AXES
from quartering.study.maps.query import worst_by
from quartering.study.maps.sweep import sweep

SHARES: Final = ("unstable", "capsizing", "without_answer", "course_unstable")
"""Shares of the conditions of a map, as `worst_by` gives them."""


def over_map(
    ship: Ship,
    conditions: Mapping[str, NDArray[np.float64]],
    parameters: Mapping[str, ArrayLike],
    *,
    harmonics: int = 1,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Shares and the largest roll of a map, over one or two parameters.

    conditions: speed [m/s], heading [deg], wave_length [m] and steepness [1] of the map; a speed that is varied stands in place
    parameters: as of `vary`, but for heading and waves, which the map is over
    Returns over the parameters: what `worst_by` gives, and worst_heading [deg], worst_wave_length [m] of the largest roll
    """
    wanted = checked_parameters(ship, parameters)
    loading = {name: values for name, values in wanted.items() if name not in CONDITION_AXES}
    axes = {**conditions, **{name: values for name, values in wanted.items() if name in CONDITION_AXES}}
    ds = sweep(ship, **axes, harmonics=harmonics, form=form, progress=progress, **loading)  # type: ignore[arg-type]
    dims = [
        name for name in ("loading", "speed") if name in ds["verdict"].dims and (name == "loading" or name in wanted)
    ]
    found = worst_by(ds, dims).assign(_places(ds, dims))
    if loading:
        found = unstacked(found, loading)
    found = found.transpose(*wanted)
    for name in wanted:
        found[name].attrs = dict(ds[name].attrs)
        if name in loading:
            found[name].attrs["user_value"] = present_value(ship, {}, name)
    sizes = " x ".join(f"{np.size(axes[name])}" for name in axes if name not in wanted)
    about = {"title": f"{ship.name}: the map over {' and '.join(map(written, wanted))}", "conditions_of_a_map": sizes}
    return found.assign_attrs(ds.attrs | about)


def _places(ds: xr.Dataset, dims: Sequence[str]) -> dict[str, xr.Variable]:
    """Heading and wave length of the largest roll; NaN where no condition has an answer."""
    others = [dim for dim in ds["verdict"].dims if dim not in dims]
    roll = ds["roll_peak"].stack(condition=others)
    at = roll.fillna(-1.0).argmax("condition")
    known = roll.notnull().any("condition")
    found: dict[str, xr.Variable] = {}
    for name in ("heading", "wave_length"):
        place = roll[name].isel(condition=at).where(known).variable
        found[f"worst_{name}"] = xr.Variable(
            place.dims, place.values, ds[name].attrs | {"long_name": f"{name} of the largest roll"}
        )
    return found

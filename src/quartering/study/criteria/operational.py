"""Operational guidance in its three forms: by rates of failures, by largest motions, and by speeds alone."""

from __future__ import annotations

import csv
import io
import math
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.study.criteria.constants import constant, limit
from quartering.study.seas.over_seas.map_axes import dims_of

Flags = NDArray[np.int8]

FORMS: Final = ("probabilistic", "deterministic", "simplified")
ADVICE: Final = ("recommended", "not recommended", "undecided", "not valid")
"""What guidance says of a condition, by its number."""
RECOMMENDED, NOT_RECOMMENDED, UNDECIDED, NOT_VALID = range(4)
_NEEDED: Final = (
    "failure_rate", "rate_lower", "rate_upper", "roll_mean_3h_max", "roll_3h_max_lower", "roll_3h_max_upper",
)  # fmt: skip


def operational_guidance(
    found: xr.Dataset, rate_limit: float | None = None, safety_factor: float | None = None
) -> xr.Dataset:
    """Operational guidance of a ship by a map over seas, speeds and headings, in the three forms of the circular.

    Parameters
    ----------
    found : Dataset         over hs, tz, speed and heading, with a loading or without: failure_rate, rate_lower, rate_upper
                            [1/s], roll_mean_3h_max, roll_3h_max_lower, roll_3h_max_upper [deg]; the same of
                            lateral_acceleration where it is known; attributes ship, ship_length, roll_limit [deg] and
                            acceleration_limit [m/s2]
    rate_limit : float      rate of failures above which a condition is not recommended [1/s]; None: that of the circular
    safety_factor : float   on the mean largest motion of three hours; None: that of the circular

    Returns
    -------
    Dataset    over loading, hs, tz, speed, heading: ``probabilistic``, ``deterministic``, ``simplified`` (int8 flags of
               `ADVICE`), and the rates and motions they rest on; attributes name every limit and how sure it is

    Raises
    ------
    InputError    a dataset that is no such map, a limit that is not above 0

    Notes
    -----
    An interval on one side of its limit decides; one that straddles it is undecided. The simplified form speaks of surf-riding
    (U cos mu above 0.94 sqrt(L) within 45 deg of a following sea, where the wave of the mean period is longer than 0.8 L and
    the significant height above 0.04 L) and of pure loss (U cos mu above 0.752 sqrt(L)); of the other modes it says nothing.
    Source: MSC.1/Circ.1627 ch. 4 (recalled, unverified), MSC.1/Circ.1228.

    Examples
    --------
    >>> axes = {"hs": [4.0], "tz": [8.0], "speed": [0.0, 12.0], "heading": [0.0, 180.0]}
    >>> calm = xr.DataArray(np.zeros((1, 1, 2, 2)), axes, tuple(axes))
    >>> ds = xr.Dataset({name: calm for name in _NEEDED}, attrs={"ship": "a", "ship_length": 90.0, "roll_limit": 40.0})
    >>> operational_guidance(ds).simplified.values.ravel().tolist()
    [0, 0, 1, 0]
    """
    if not isinstance(found, xr.Dataset) or not {*_NEEDED, "hs", "tz", "speed", "heading"} <= {
        *found.data_vars,
        *found.coords,
    }:
        raise InputError(
            "found is no map over seas; give a dataset over hs, tz, speed and heading with rates and largest motions"
        )
    rate = _limit("rate_limit", rate_limit, "operational_guidance.failure_rate")
    factor = _limit("safety_factor", safety_factor, "operational_guidance.safety_factor")
    whole = found if "loading" in found.dims else found.expand_dims("loading")
    dims = dims_of(whole)
    whole = whole.transpose(*dims, ...)
    roll_limit = float(found.attrs["roll_limit"])
    by_rate = _side(whole["rate_lower"], whole["rate_upper"], rate)
    by_motion = _side(whole["roll_3h_max_lower"], whole["roll_3h_max_upper"], roll_limit / factor)
    felt = found.attrs.get("acceleration_limit")
    if isinstance(felt, (int, float)) and "lateral_acceleration_3h_max_lower" in whole:
        lower, upper = (whole[f"lateral_acceleration_3h_max_{end}"] for end in ("lower", "upper"))
        by_motion = _worse(by_motion, _side(lower, upper, float(felt) / factor))
    if "recommended" in whole:  # where the map has no answer neither have the forms that rest on it
        lost = whole["recommended"].values == NOT_VALID
        by_rate, by_motion = (np.where(lost, NOT_VALID, one).astype(np.int8) for one in (by_rate, by_motion))
    forms = (by_rate, by_motion, simplified(whole, float(found.attrs["ship_length"])))
    flags = {"flag_values": np.arange(4, dtype=np.int8), "flag_meanings": " ".join(w.replace(" ", "_") for w in ADVICE)}
    kept = [name for name in (*_NEEDED, "lateral_acceleration_3h_max", "failures", "exposure") if name in whole]
    fields: dict[str, Any] = {name: whole[name] for name in kept}
    fields |= {
        name: (dims, values, flags | {"units": "1", "long_name": f"advice in the {name} form"})
        for name, values in zip(FORMS, forms, strict=True)
    }
    return xr.Dataset(fields, whole.coords, _about(found, rate, factor, roll_limit))


def _limit(name: str, given: float | None, own: str) -> float:
    value = limit(own) if given is None else float(given)
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{name} = {given}; it is a finite number above 0; try {limit(own):g}")
    return value


def _side(lower: xr.DataArray, upper: xr.DataArray, most: float) -> Flags:
    """On which side of a limit intervals lie; one that is not known straddles it."""
    below, above = (upper <= most).values, (lower > most).values
    return np.select([below, above], [RECOMMENDED, NOT_RECOMMENDED], UNDECIDED).astype(np.int8)


def _worse(one: Flags, other: Flags) -> Flags:
    """Not recommended by either, else undecided by either, else recommended."""
    rank = np.array([0, 2, 1, 3], dtype=np.int8)
    return np.where(rank[one] >= rank[other], one, other).astype(np.int8)


def simplified(found: xr.Dataset, length: float) -> Flags:
    """Advice by speed, heading and sea alone, over `dims_of`.

    length: of the ship [m]
    """
    heading, speed, hs, tz = (found[name] for name in ("heading", "speed", "hs", "tz"))
    along = speed * np.cos(np.radians(heading))
    off = np.abs((heading + 180.0) % 360.0 - 180.0)
    wave = GRAVITY * (limit("simplified_guidance.mean_period") * tz) ** 2 / (2 * math.pi)
    high = (hs > limit("simplified_guidance.surf_riding_height") * length) & (
        wave > limit("simplified_guidance.surf_riding_length") * length
    )
    fast = (along > limit("simplified_guidance.surf_riding_speed") * math.sqrt(length)) & (
        off <= limit("simplified_guidance.surf_riding_sector")
    )
    lost = along > limit("simplified_guidance.pure_loss_speed") * math.sqrt(length)
    said = (high & fast) | lost
    count = found.sizes["loading"]
    whole = said.expand_dims(loading=count).broadcast_like(found["failure_rate"]).transpose(*dims_of(found))
    return np.where(whole.values, NOT_RECOMMENDED, RECOMMENDED).astype(np.int8)


def _about(found: xr.Dataset, rate: float, factor: float, roll_limit: float) -> dict[str, Any]:
    """What stands beside the advice: limits with their source."""

    def source(name: str, value: float) -> str:
        one = constant(name)
        own = "" if value == one.value else f"given; that of the circular is {one.value:g}, "
        return f"{own}MSC.1/Circ.1627, {one.place}: {one.status}"

    kept = ("ship", "ship_length", "loading", "sea", "hours", "seed", "acceleration_limit", "roll_limit_reason",
            "interval_of_closure", "provenance", "sides", "estimated_coefficients", "estimated_by")  # fmt: skip
    rules = {
        "probabilistic": f"not recommended where the rate of failures is above {rate:.3g} 1/s "
        f"({source('operational_guidance.failure_rate', rate)})",
        "deterministic": f"not recommended where {factor:g} times the mean largest motion of 3 h is beyond the limit of a "
        f"failure, {roll_limit:.3g} deg of roll ({source('operational_guidance.safety_factor', factor)})",
        "simplified": "not recommended where U cos mu is above 0.752 sqrt(L) (pure loss), or above 0.94 sqrt(L) within 45 deg "
        f"of a following sea of long and high waves (surf-riding) ({source('simplified_guidance.pure_loss_speed', 0.752)})",
    }
    about = {name: found.attrs[name] for name in kept if name in found.attrs}
    return about | {f"rule_{name}": words for name, words in rules.items()} | {"roll_limit": roll_limit}


def guidance_csv(ds: xr.Dataset) -> str:
    """Every condition of `operational_guidance` in a line: loading, sea, speed, heading, the forms, and what they rest on."""
    text = io.StringIO()
    numbers = [name for name in ds.data_vars if name not in FORMS]
    units = [str(ds[name].attrs.get("units", "1")) for name in numbers]
    writer = csv.writer(text, lineterminator="\n")
    dims = dims_of(ds)
    heads = ["loading", "hs [m]", f"{dims[2]} [s]", "speed [m/s]", "heading [deg]", *FORMS]
    writer.writerow([*heads, *(f"{name} [{unit}]" for name, unit in zip(numbers, units, strict=True))])
    names = (
        [str(one) for one in ds["loading"].values] if "loading" in ds.coords else map(str, range(ds.sizes["loading"]))
    )
    loadings = list(names)
    for place in np.ndindex(*(ds.sizes[name] for name in dims)):
        at = dict(zip(dims, place, strict=True))
        axes = [f"{float(ds[name].values[at[name]]):.6g}" for name in dims[1:]]
        said = [ADVICE[int(ds[form].values[place])] for form in FORMS]
        values = [f"{float(ds[name].values[place]):.4g}" for name in numbers]
        writer.writerow([loadings[at["loading"]], *axes, *said, *values])
    return text.getvalue()

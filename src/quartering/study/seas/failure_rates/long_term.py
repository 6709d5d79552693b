"""Failures over a ship's life: rates in every sea, weighted by how often seas, headings and speeds occur."""

from __future__ import annotations

import warnings
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.study.criteria.constants import constant
from quartering.study.dataset import made_by
from quartering.study.seas.failure_rates.occurrence import table_of, weights_of
from quartering.study.seas.over_seas.map_axes import period_of

Floats = NDArray[np.float64]

YEAR: Final = 365.25 * 86400.0
"""A year [s]."""
NOTEWORTHY: Final = 1e-3
"""Share of time in seas the map does not hold, above which it is warned of [1]."""
_RATES: Final = ("failure_rate", "rate_lower", "rate_upper")


def long_term(
    found: xr.Dataset,
    occurrence: xr.DataArray | None = None,
    *,
    heading_weight: ArrayLike | None = None,
    speed_weight: ArrayLike | None = None,
) -> xr.Dataset:
    """Rate of failures over all the seas a ship meets, by its map of guidance and a table of how often they occur.

    Parameters
    ----------
    found : Dataset              from `guidance`: failure_rate, rate_lower and rate_upper over hs, tz, speed, heading
    occurrence : DataArray       over hs and tz, in any unit; by default the North Atlantic's, IACS Recommendation 34
    heading_weight : (h,) float  by default all headings alike; of a map from 0 to 180 deg the ends count half
    speed_weight : (u,) float    by default all speeds alike

    Returns
    -------
    Dataset           failure_rate with lower and upper end [1/s], failures_a_year [1/year], over loading where there are
                      several; contribution (hs, tz) of each sea of the map to the rate [1/s]; weight (hs, tz) of each, and
                      not_covered: share of time in seas the map does not hold, which are not in the rate [1]

    Raises
    ------
    InputError        no guidance; weights that do not fit or are below 0; a table without hs and tz

    Warns
    -----
    RangeWarning      seas the map does not hold, beyond its ends or without an answer, with more than 0.1 % of the time

    Notes
    -----
    Each sea of the table counts for the nearest of the map, if it lies no further beyond its ends than half a step. The lower
    end is the sum of the lower ends, the upper that of the upper. The table is recalled, its status an attribute.
    Source: IACS Recommendation 34; a safety level of 2.6e-3 failures a ship-year, MSC.1/Circ.1627.

    Examples
    --------
    >>> import quartering as qt
    >>> some = qt.guidance(qt.ship("wigley"), [1, 2], tz=[6, 7], speed=4.0, heading=[0, 90, 180], spreading="cos2")
    >>> table = xr.DataArray([[3, 1], [0, 1]], {"hs": [1, 2], "tz": [6, 7]}, ("hs", "tz"))
    >>> life = long_term(some, table)
    >>> float(life["weight"].sum()), bool(life["failures_a_year"] < 1e-3)
    (1.0, True)
    """
    if not isinstance(found, xr.Dataset) or not {*_RATES, "hs", "tz", "heading", "speed"} <= {
        *found.data_vars,
        *found.coords,
    }:
        raise InputError("found is no map over seas; give what quartering.guidance returns")
    table, status = table_of(occurrence)
    period = period_of(found)
    share, missed = _regrouped(table, found)
    each = found[list(_RATES)].transpose("hs", period, "heading", "speed", ...)
    by_heading = weights_of("heading_weight", heading_weight, found["heading"].values, round_the_ship=True)
    by_speed = weights_of("speed_weight", speed_weight, found["speed"].values)
    weight = xr.DataArray(
        share[:, :, None, None] * by_heading[:, None] * by_speed, dims=("hs", period, "heading", "speed")
    )  # fmt: skip
    known = each["failure_rate"].notnull()
    missed += float(weight.where(~known, 0.0).sum(("hs", period, "heading", "speed")).max())
    if missed > NOTEWORTHY:
        warnings.warn(
            f"{missed:.2%} of the time is spent in seas that the map does not hold or has no answer for: their failures are"
            " not counted; widen it",
            RangeWarning,
            stacklevel=2,
        )
    return _dataset(found, each, weight, missed, status)


def _dataset(found: xr.Dataset, each: xr.Dataset, weight: xr.DataArray, missed: float, status: str) -> xr.Dataset:
    sums = (each * weight).sum(("heading", "speed"))
    level = constant("operational_guidance.year_rate")
    data: dict[str, Any] = {name: sums[name].sum(("hs", period_of(found))) for name in _RATES}
    for name, words in zip(_RATES, ("failures of a ship over all its seas", "lower end", "upper end"), strict=True):
        data[name].attrs = {"units": "s-1", "long_name": f"rate, {words}"}
    data["failures_a_year"] = (data["failure_rate"] * YEAR).assign_attrs(units="1/year", long_name="failures a year")
    data["contribution"] = sums["failure_rate"].assign_attrs(units="s-1", long_name="of each sea to the rate")
    data["weight"] = weight.sum(("heading", "speed")).assign_attrs(units="1", long_name="share of time in each sea")
    data["not_covered"] = xr.Variable(
        (), missed, {"units": "1", "long_name": "share of time in seas without an answer"}
    )
    about = {name: found.attrs[name] for name in ("ship", "sea", "hours") if name in found.attrs}
    return xr.Dataset(data).assign_attrs(
        title="Failures over all seas", **about, table=status, source=made_by(),
        safety_level=f"{level.value:g} {level.unit}: MSC.1/Circ.1627, {level.place}, {level.status}",
    )  # fmt: skip


def _regrouped(table: xr.DataArray, found: xr.Dataset) -> tuple[Floats, float]:
    """Shares of time of the seas of a map (n, m), and of those beyond it; a mean period may hang on the height."""
    hs = found["hs"].values
    tz = np.broadcast_to(found["tz"].values, (hs.size, found.sizes[period_of(found)]))
    i, there = _nearest(table["hs"].values, hs)
    by_height = [_nearest(table["tz"].values, row) for row in tz]
    j, also = np.stack([one[0] for one in by_height])[i], np.stack([one[1] for one in by_height])[i]
    share = np.zeros(tz.shape)
    inside = there[:, None] & also
    np.add.at(share, (i[:, None], j), np.where(inside, table.values, 0.0))
    return share, float(table.values[~inside].sum())


def _nearest(wanted: Floats, own: Floats) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Places of the nearest values, and whether they are no further beyond the ends than half a step of both lists."""
    place = np.abs(wanted[:, None] - own).argmin(axis=1)
    steps = [np.diff(np.sort(one)).max(initial=0.0) for one in (wanted, own)]
    half = 0.5 * max(steps) * (1.0 + 1e-9)
    return place, (wanted >= own.min() - half) & (wanted <= own.max() + half)

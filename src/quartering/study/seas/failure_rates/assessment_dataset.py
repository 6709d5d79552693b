"""A direct assessment as one labelled dataset: rates of cells, their sum with its interval, what was left out and why."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.study.criteria.constants import constant
from quartering.study.seas.failure_rates.assessed import RESULTS
from quartering.study.seas.failure_rates.assessment_grid import Assessed, AssessmentGrid
from quartering.study.seas.failure_rates.long_term import YEAR
from quartering.study.seas.over_seas import guidance_dataset
from quartering.study.seas.over_seas.map_axes import dims_of
from quartering.study.seas.simulated.failures import weighted_rate

Floats = NDArray[np.float64]
_OWN: Final[Mapping[str, tuple[str, str]]] = {
    "failures": ("1", "failures counted, by roll or by lateral acceleration; NaN where not simulated"),
    "exposure": ("h", "time simulated until failure or end, run-up left out; NaN where not simulated"),
    "failure_rate": ("s-1", "rate of failures: counted, or carried down from higher seas; 0 of cells left out"),
    "rate_lower": ("s-1", "lower end of its 95 % interval"),
    "rate_upper": ("s-1", "upper end of its 95 % interval; of cells left out that of the closure, or of the next higher sea"),
    "waiting_time_p": ("1", "probability of times to failure as far from exponential ones; NaN of fewer than five"),
    "lost": ("1", "share of blocks that failed in their run-up, which do not count"),
    "lost_expected": ("1", "the same if failures come at the rate from the start"),
    "status": ("1", "how a cell was answered, or why it was left out"),
}  # fmt: skip
_BY_CLOSURE: Final = (Assessed.EXCLUDED, Assessed.TOO_RARE)
_BOUNDS: Final = (*_BY_CLOSURE, Assessed.BELOW_HIGHER_SEA)
"""Cells that are in the sum by an upper end alone."""
_UNJUDGED: Final = (Assessed.SURF_RIDING, Assessed.BREAKS, Assessed.NOT_KNOWN)


def attributes(name: str) -> dict[str, object]:
    """Unit and meaning of a variable, and the meaning of its flags.

    >>> attributes("status")["flag_meanings"].split()[:2]
    ['counted', 'budget_spent']
    """
    if name not in _OWN:
        return guidance_dataset.attributes(name)
    unit, meaning = _OWN[name]
    known: dict[str, object] = {"units": unit, "long_name": meaning}
    if name == "status":
        known["flag_values"] = np.array(list(Assessed), dtype=np.int8)
        known["flag_meanings"] = " ".join(one.name.lower() for one in Assessed)
    return known


def labelled(
    heading: Mapping[str, object],
    results: Mapping[str, Any],
    coordinates: Mapping[str, tuple[tuple[str, ...], Floats]],
    dims: tuple[str, ...],
) -> xr.Dataset:
    """Dataset of the cells, in the order of `dims_of`; a single loading is one too."""
    data = {name: xr.Variable(dims, results[name], attributes(name)) for name in RESULTS}
    coords = {name: xr.Variable(where, values, attributes(name)) for name, (where, values) in coordinates.items()}
    made = xr.Dataset(data, coords | guidance_dataset.other_period(heading, coordinates), dict(heading))
    if "loading" not in made.dims:
        made = made.expand_dims("loading")
    return made.transpose(*dims_of(made), ...)


def heading_of(grid: AssessmentGrid) -> dict[str, object]:
    """Attributes of the whole: ship, seas, what a failure is, and how exact it is meant to be."""
    own = guidance_dataset.heading_of(grid)
    level = constant("operational_guidance.year_rate")
    left = {
        name: value
        for name, value in own.items()
        if name not in ("judge", "threshold", "threshold_words", "threshold_source")
    }
    return left | {
        "title": f"Direct assessment of {grid.ship.name}: failures over all seas",
        "precision": grid.precision,
        "scale": grid.scale.tolist(),
        "safety_level": f"{level.value:g} {level.unit}: MSC.1/Circ.1627, {level.place}, {level.status}",
        "safety_level_rate": level.value / YEAR,
        "references": "H71, STF70, Kazakov54, Rice44, Tucker84, Fay97",
    }  # fmt: skip


def summed(found: xr.Dataset, closed: xr.Dataset, weight: xr.DataArray, share: float, table: str) -> xr.Dataset:
    """Cells with the sum over them.

    found: from `labelled`
    closed: from `guidance`, over the same cells: its upper ends stand for those left out
    weight: share of time of each cell
    share: see `tasks_of`
    table: what says how often seas occur
    """
    cells, closed = found.load(), closed.transpose(*dims_of(closed), ...)
    status = cells["status"]
    excluded = status.isin(_BY_CLOSURE)
    for name, value in (("failure_rate", 0.0), ("rate_lower", 0.0), ("rate_upper", closed["rate_upper"])):
        cells[name] = cells[name].where(~excluded, value).assign_attrs(attributes(name))
    cells["contribution"] = (weight * cells["failure_rate"]).transpose(*dims_of(cells))
    cells["contribution"].attrs = {"units": "s-1", "long_name": "of each cell to the rate over all seas"}
    cells["weight"] = weight.assign_attrs(units="1", long_name="share of the ship's time in each cell")
    rows = [_sum(cells.isel(loading=i), weight) for i in range(cells.sizes["loading"])]
    for name, (unit, meaning) in _SUMS.items():
        cells[name] = (("loading",), [row[name] for row in rows], {"units": unit, "long_name": meaning})
    return cells.assign_attrs(share_left_out=share, table=table)


_SUMS: Final[Mapping[str, tuple[str, str]]] = {
    "long_term_rate": ("s-1", "rate of failures over all seas, headings and speeds"),
    "long_term_lower": ("s-1", "lower end of its interval"),
    "long_term_upper": ("s-1", "upper end of its interval, with all that was left out at its upper ends"),
    "failures_a_year": ("1/year", "failures a year"),
    "carried_down": ("s-1", "part of the rate that was carried down from higher seas"),
    "left_out": ("s-1", "upper end of what cells left out add up to"),
    "not_judged": ("1", "share of time in seas that break, in surf-riding, or without an answer: not in the rate"),
    "hours_spent": ("h", "simulated, run-up left out"),
}


def _sum(one: xr.Dataset, weight: xr.DataArray) -> dict[str, float]:
    """Sum over the cells of one loading."""
    w = weight.transpose(*dims_of(one)[1:]).values
    status = one["status"].values
    rate, lower, upper = (one[name].values for name in ("failure_rate", "rate_lower", "rate_upper"))
    counted = np.isin(status, (Assessed.COUNTED, Assessed.BUDGET_SPENT))
    seen = weighted_rate(w[counted], one["failures"].values[counted], 3600.0 * one["exposure"].values[counted])
    carried = status == Assessed.EXTRAPOLATED
    bounds = np.isin(status, _BOUNDS)
    left = float((w * upper)[bounds].sum())
    total = seen.rate + float((w * rate)[carried].sum())
    return {
        "long_term_rate": total,
        "long_term_lower": seen.lower + float((w * lower)[carried].sum()),
        "long_term_upper": seen.upper + float((w * upper)[carried].sum()) + left,
        "failures_a_year": total * YEAR,
        "carried_down": float((w * rate)[carried].sum()),
        "left_out": left,
        "not_judged": float(w[np.isin(status, _UNJUDGED)].sum()),
        "hours_spent": float(np.nansum(one["exposure"].values)),
    }

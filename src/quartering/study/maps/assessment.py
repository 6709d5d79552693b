"""Direct assessment: the rate of failures over all the seas a ship meets, counted as exactly as it matters."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, Unpack

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.option_types import StudyAxes
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Spectrum
from quartering.loads.sea.spreading import Spreading
from quartering.study.criteria.constants import constant
from quartering.study.grid import Grid
from quartering.study.maps.stored.store import MANIFEST
from quartering.study.maps.sweep import evaluated, filled
from quartering.study.seas.failure_rates.assessment_dataset import summed
from quartering.study.seas.failure_rates.assessment_grid import AssessmentGrid, tasks_of
from quartering.study.seas.failure_rates.long_term import YEAR
from quartering.study.seas.failure_rates.occurrence import table_of, weights_of
from quartering.study.seas.over_seas.grid import SeaGrid, sea_grid
from quartering.study.seas.over_seas.settings import SeaSettings
from quartering.study.seas.simulated.failures import failure_rate

_POINTS = ("speed", "heading", "tz", "hs")


@takes(ship="Ship")
def direct_assessment(
    ship: Ship,
    speed: ArrayLike | str,
    heading: ArrayLike | str | None = None,
    occurrence: xr.DataArray | None = None,
    *,
    heading_weight: ArrayLike | None = None,
    speed_weight: ArrayLike | None = None,
    spectrum: Spectrum = "bretschneider",
    gamma: float = 3.3,
    spreading: Spreading = "cos2",
    hours: float = 1000.0,
    precision: float = 0.2,
    share: float = 0.01,
    seed: int = 0,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
    store: str | Path | None = None,
    cluster: str | None = None,
    factors: Mapping[str, ArrayLike] | None = None,
    values: Mapping[str, ArrayLike] | None = None,
    **axes: Unpack[StudyAxes],
) -> xr.Dataset:
    """Rate of failures of a ship over all seas it meets, by simulation of every cell that can matter.

    Parameters
    ----------
    ship : Ship
    speed : (u,) float           [m/s]; numbers, text with a unit, or a range, as of `sweep`
    heading : (h,) float         the sea goes to, from the bow [deg]; by default 0 to 180 every 15
    occurrence : DataArray       over hs and tz, in any unit; by default the North Atlantic's, IACS Recommendation 34
    heading_weight, speed_weight : (h,), (u,) float    as of `long_term`; by default all alike
    spectrum, gamma, spreading   of the seas, as of `Sea`
    hours : float                budget of a cell, 32 at a time [h]
    precision : float            half width of the interval of a cell over what it adds to the sum; what adds less than matters
                                 may be as wrong as one that does [1]
    share : float                of what matters, up to which cells are left out together by the closure's upper ends [1]
    seed : int                   of simulations
    form : str                   of the diffraction force
    progress, store, cluster, factors, values, **axes    as of `sweep`

    Returns
    -------
    xarray.Dataset    over loading: long_term_rate with long_term_lower and _upper [1/s], failures_a_year [1/year], carried_down
                      and left_out (parts of it) [1/s], not_judged share of time [1], hours_spent [h]. Dims loading, hs, tz,
                      speed, heading: failure_rate, rate_lower, rate_upper, contribution [1/s], failures, exposure [h],
                      waiting_time_p, lost and lost_expected (shares of blocks that fail in their run-up), status: how a cell
                      was answered or why it was left out; weight: share of time

    Raises
    ------
    InputError        what `guidance` and `long_term` refuse; precision or share out of range

    Warns
    -----
    RangeWarning      seas that are steep or break, surf-riding, cells that often fail in their run-up

    Notes
    -----
    The closure's upper end, a hundred times a Gaussian rate, says which cells cannot matter; what matters is the safety level
    of MSC.1/Circ.1627, or the sum where it is higher. Where it is below what the hours could show without a failure, it stands
    for the cell. All others are simulated as by `irregular` with the same seed, until
    their interval is small enough or the hours are spent. A cell too rare to count is carried down from three higher seas with
    30 failures each (`failure_rate_at`), or taken to fail less than the next higher sea: rates rise with height. The sum of
    counts has the interval of Fay and Feuer, exact for a single one; ends of the rest are added. Ending where a count is known
    well enough makes it too high by a failure at most.
    Source: MSC.1/Circ.1627 3.1.2, [Fay97].  Valid: as `irregular`; nothing here shows compliance with any rule.

    Examples
    --------
    >>> import quartering as qt
    >>> table = xr.DataArray([[3.0, 1.0], [0.0, 1.0]], {"hs": [1.0, 2.0], "tz": [6.0, 7.0]}, ("hs", "tz"))
    >>> found = qt.direct_assessment(qt.ship("wigley"), 4.0, [0, 90, 180], table, hours=32)
    >>> float(found["weight"].sum().round(9)), bool(found["long_term_upper"] < 1e-6)
    (1.0, True)
    """
    settings = SeaSettings(spectrum, gamma, spreading, None, "rate", None, 0.0, seed, form)
    told = {name: number(None, key, given) for name, key, given in (
        ("hours", "simulated_hours", hours), ("precision", "precision", precision), ("share", "left_out_share", share),
    )}  # fmt: skip
    table, words = table_of(occurrence)
    table = table.isel(hs=(table.sum("tz") > 0).values, tz=(table.sum("hs") > 0).values)
    usual = np.arange(0.0, 181.0, 15.0)
    first = sea_grid(
        ship, speed, usual if heading is None else heading, table["hs"].values, tz=table["tz"].values, settings=settings,
        factors=factors, values=values, **axes,
    )  # fmt: skip
    weight = _weight(first, table, speed_weight, heading_weight)
    folders = _folders(store)

    def run(grid: Grid, folder: Path | None, begin: int) -> xr.Dataset:
        def said(done: int, _: Counter[str]) -> None:
            if progress is not None:
                progress(begin + done, 2 * first.count)

        if folder is not None:
            return filled(grid, folder, cluster=cluster, told=said)
        return evaluated(grid, cluster=cluster, told=said)

    closed = run(first, folders[0], 0)
    second = _second(first, closed, weight, told)
    found = run(second, folders[1], first.count)
    return summed(found, closed, weight, told["share"], words)


def _weight(
    grid: SeaGrid, table: xr.DataArray, speed_weight: ArrayLike | None, heading_weight: ArrayLike | None
) -> xr.DataArray:
    """Share of time of each cell, over hs, tz, speed and heading."""
    by_heading = weights_of("heading_weight", heading_weight, grid.axes["heading"], round_the_ship=True)
    by_speed = weights_of("speed_weight", speed_weight, grid.axes["speed"])
    each = table.values[:, :, None, None] * by_speed[:, None] * by_heading
    return xr.DataArray(each, dims=("hs", "tz", "speed", "heading"))


def _folders(store: str | Path | None) -> tuple[Path | None, Path | None]:
    """Where the closure and the simulations of a store are put."""
    if store is None:
        return None, None
    folder = Path(store)
    if (folder / MANIFEST).exists():
        raise InputError(f'store "{folder}" holds a sweep; give a new or empty folder for a direct assessment')
    return folder / "closure", folder / "simulation"


def _second(first: SeaGrid, closed: xr.Dataset, weight: xr.DataArray, told: Mapping[str, float]) -> AssessmentGrid:
    """The grid of simulations, by what the closure left of it."""
    shape = (first.loading_count, first.point_count, first.sea_count)
    flat = {
        name: closed[name].transpose("loading", *_POINTS).values.reshape(shape)
        for name in ("status", "rate_lower", "rate_upper")
    }
    shares = weight.transpose(*_POINTS).values.reshape(shape[1:])
    level = constant("operational_guidance.year_rate").value / YEAR
    tasks = tasks_of(flat["status"], flat["rate_lower"], flat["rate_upper"], shares, told["share"], level,
                     failure_rate(0, 3600.0 * told["hours"]).upper)  # fmt: skip
    own: dict[str, Any] = {
        one.name: getattr(first, one.name) for one in fields(SeaGrid) if one.init and one.name not in ("hours", "block_size")
    }  # fmt: skip
    return AssessmentGrid(
        **own, hours=told["hours"], block_size=first.sea_count, weight=shares, task=tasks.task, scale=tasks.scale,
        precision=told["precision"],
    )  # fmt: skip

"""Operational guidance: every speed and heading in seas of several heights and periods."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Unpack

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.doors import takes
from quartering.hull.option_types import StudyAxes
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea, Spectrum
from quartering.loads.sea.spreading import Spreading
from quartering.study.maps.sweep import evaluated, filled
from quartering.study.seas.over_seas.grid import sea_grid
from quartering.study.seas.over_seas.settings import Judge, SeaSettings


@takes(ship="Ship")
def guidance(
    ship: Ship,
    hs: ArrayLike | str,
    tp: ArrayLike | str | None = None,
    *,
    tz: ArrayLike | str | None = None,
    speed: ArrayLike | str = "0..0.24 Fn step 0.04",
    heading: ArrayLike | str | None = None,
    spectrum: Spectrum = "jonswap",
    gamma: float = 3.3,
    spreading: Spreading = None,
    swell: Sea | None = None,
    judge: Judge = "largest",
    threshold: float | None = None,
    hours: float = 0.0,
    seed: int = 0,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
    store: str | Path | None = None,
    cluster: str | None = None,
    factors: Mapping[str, ArrayLike] | None = None,
    values: Mapping[str, ArrayLike] | None = None,
    **axes: Unpack[StudyAxes],
) -> xr.Dataset:
    """Largest motions, failures and advice at every speed and heading, in seas of several heights and periods.

    Parameters
    ----------
    ship : Ship
    hs : (n,) float             significant heights [m]; here and below numbers, text with a unit, or a range ("4..8 m step 2")
    tp, tz : (m,) float         periods of the peak, or mean zero-crossing periods: one of the two [s]
    speed : (u,) float          [m/s]
    heading : (h,) float        the sea goes to, from the bow [deg]; by default 0 to 180 every 5, to 355 beside a swell off it
    spectrum, gamma, spreading  of the seas, as of `Sea`; of "torsethaugen", whose mean period hangs on its height too, tp
    swell : Sea                 beside each of the seas; its heading is the angle off that of the sea [deg]
    judge : str                 "largest": the mean largest motion of three hours against the limit of a failure; "rate": the
                                rate of failures
    threshold : float           factor on that mean, or rate [1/s]; by default 2 and 1e-6, recalled from MSC.1/Circ.1627,
                                unverified
    hours : float               to simulate at most where the closure does not decide; 0: none [h]
    seed : int                  of simulations
    form : str                  of the diffraction force
    progress : function(done, total), optional
    store, cluster, factors, values, **axes    as of `sweep`

    Returns
    -------
    xarray.Dataset    dims loading, hs, tz, speed, heading: roll_rms, roll_mean_3h_max with the ends of its interval [deg],
                      lateral_acceleration_3h_max with its ends [m/s2], failure_rate, rate_lower, rate_upper [1/s], failures and
                      exposure [h] where simulated, n2, k2, exponent, status, rung (how it was answered), recommended. tp along
                      tz, or of Torsethaugen's spectrum tp in its place and tz over hs and tp; pile_up (line) [m/s]: U cos mu of
                      the danger lines that no sea moves

    Raises
    ------
    InputError        an axis that is empty or out of range, both or neither period, seas that all break, what `sweep` refuses

    Warns
    -----
    RangeWarning      conditions that are not valid, seas that break among others

    Notes
    -----
    Each condition is closed (statistical linearisation). Where an interval of what is judged straddles its limit, it is
    simulated until it does not, or it stays undecided. The interval of the closure is the one found beside simulation in
    twelve seas. Headings from 180 to 360 mirror those from 0 to 180, but for a swell from one side.
    Source: `sea_response`, `irregular`. Nothing here shows
    compliance with any rule; sway-roll-yaw motion is none of the five modes of the criteria.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = guidance(ship("wigley"), hs=[1, 2], tp=8, speed=[3.0, 6.0], heading=[30, 90])
    >>> found["recommended"].dims, bool((found["roll_3h_max_lower"] < found["roll_mean_3h_max"]).all())
    (('loading', 'hs', 'tz', 'speed', 'heading'), True)
    """
    settings = SeaSettings(spectrum, gamma, spreading, swell, judge, threshold, hours, seed, form).checked()
    usual = np.arange(0.0, 360.0 if settings.one_sided else 181.0, 5.0)
    wanted = sea_grid(
        ship, speed, usual if heading is None else heading, hs, tp, tz, settings=settings, factors=factors, values=values,
        **axes,
    )  # fmt: skip

    def told(done: int, _: Counter[str]) -> None:
        if progress is not None:
            progress(done, wanted.count)

    if store is not None:
        return filled(wanted, store, cluster=cluster, told=told)
    return evaluated(wanted, cluster=cluster, told=told)

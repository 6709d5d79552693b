"""Failure events of operational guidance: roll beyond an angle, or a capsize, at the motion or on the way to it."""

from __future__ import annotations

from typing import Final

import xarray as xr

from quartering.hull.righting.limit import least_limit
from quartering.motion.status import Status
from quartering.study.maps.query import capsizing

ROLL_LIMIT: Final = 40.0
"""Largest roll angle that is no failure event, whatever the ship [deg]; MSC.1/Circ.1627."""


def failure_angle(vanishing: float, openings: float | None) -> float:
    """Roll angle past which a failure event is foreseen [deg].

    vanishing: angle of vanishing stability in calm water [deg]; infinite where there is none
    openings: heel at which unprotected openings go under in calm water [deg]

    >>> failure_angle(65.0, None), failure_angle(65.0, 25.0)
    (40.0, 25.0)
    """
    return min(ROLL_LIMIT, least_limit(vanishing, openings).angle)


def failure_events(result: xr.Dataset, limit: float) -> xr.DataArray:
    """Conditions with a failure event: roll beyond the limit or past the capsize limit, at the motion or on the way to it.

    result: of `polar` or `sweep`
    limit: [deg]
    """
    past = result["status"] == int(Status.BEYOND_CAPSIZE_LIMIT)
    return (result["roll_peak"] > limit) | past | capsizing(result)

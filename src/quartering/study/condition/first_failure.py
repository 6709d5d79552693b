"""The lowest waves in which a ship fails: over all headings, speeds and wave lengths of a map."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.stability.kind import Kind
from quartering.study.condition.failure_events import failure_events
from quartering.study.maps.sweep import sweep

STEEPNESSES: Final = (1 / 50, 1 / 40, 1 / 30, 1 / 25, 1 / 20, 1 / 17, 1 / 15, 1 / 12, 1 / 10)
"""Steepnesses that are tried, the lowest first; steeper regular waves are rare at sea."""


class FirstFailure(NamedTuple):
    """The condition that fails in the lowest waves.

    Parameters
    ----------
    steepness : float                               H/lambda
    speed, heading, wave_length, wave_height : float    [m/s, deg, m, m]
    failing, conditions : int                       how many of the map fail at that steepness, and how many there are
    unstable : bool                                 an unstable motion, no roll beyond the limit
    """

    steepness: float
    speed: float
    heading: float
    wave_length: float
    wave_height: float
    failing: int
    conditions: int
    unstable: bool


def first_failure(
    ship: Ship,
    speeds: Sequence[float] | NDArray[np.float64],
    headings: Sequence[float] | NDArray[np.float64],
    wave_lengths: Sequence[float] | NDArray[np.float64],
    limit: float,
    *,
    harmonics: int = 1,
    form: Form = "stf",
    steepnesses: Sequence[float] = STEEPNESSES,
) -> FirstFailure | None:
    """The condition that fails first as all waves grow steeper together; None where none does.

    speeds [m/s], headings [deg], wave_lengths [m]: of the map
    limit: roll past which a failure event is foreseen [deg]
    A motion that is unstable, but for the course in calm water, fails too. Of several at one steepness the one that rolls
    furthest is taken, of those past every limit the one with the largest exponent.
    """
    for steepness in steepnesses:
        ds = sweep(
            ship, speeds, headings, wave_lengths, steepness=steepness, harmonics=harmonics, form=form
        ).isel(steepness=0)  # fmt: skip
        kinds = ds["verdict"].values
        unstable = (kinds > int(Kind.STABLE)) & (kinds != int(Kind.COURSE_IN_CALM_WATER))
        failed = failure_events(ds, limit).values | unstable
        if failed.any():
            roll = np.where(failed, np.nan_to_num(ds["roll_peak"].values, nan=-1.0), -2.0)
            at = np.unravel_index(int(roll.argmax()), roll.shape)
            cell = ds.isel(dict(zip(ds["verdict"].dims, map(int, at), strict=True)))
            return FirstFailure(
                steepness, float(cell["speed"]), float(cell["heading"]), float(cell["wave_length"]),
                steepness * float(cell["wave_length"]), int(failed.sum()), int(failed.size), bool(unstable[at]),
            )  # fmt: skip
    return None

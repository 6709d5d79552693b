"""Integrity of the safe basin: what waves leave of the starts from which a ship survives in calm water."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.hydro.coefficients import coefficients
from quartering.loads.waves import Wave
from quartering.motion.of_ship import equations
from quartering.motion.transient.basin import basin

Floats = NDArray[np.float64]
_ANGLES, _RATES = 61, 49


class Integrity(NamedTuple):
    """Safe basins of one ship in waves of rising height.

    Parameters
    ----------
    basins : list of Dataset    of `basin`, one a wave height
    wave_height : (h,) float    ascending, the first is 0 [m]
    safe_share : (h,) float     of all starts
    integrity : (h,) float      of the starts that are safe in calm water; NaN where none is
    """

    basins: list[xr.Dataset]
    wave_height: Floats
    safe_share: Floats
    integrity: Floats

    def at(self, height: float) -> int:
        """Index of a wave height [m]."""
        return int(np.flatnonzero(self.wave_height == height)[0])


def basin_integrity(
    ship: Ship,
    wave: Wave,
    speed: float,
    heading: float,
    heights: Sequence[float],
    *,
    periods: int = 16,
    progress: Callable[[int, int], None] | None = None,
) -> Integrity:
    """Safe basins in a wave, in calm water and in waves of the same length and other heights.

    speed: U [m/s]
    heading: mu [deg]
    heights: further wave heights [m]
    periods: of the wave, to go on for
    progress: called after each wave

    The starts reach from upright to the capsize limit on both sides, and as far in roll rate as a free roll of that size.
    Source: [Thompson89].

    >>> from quartering.hull.file.read import ship
    >>> found = basin_integrity(ship("wigley"), Wave(100.0, 1.0), 5.0, 60.0, [], periods=1)
    >>> found.wave_height.tolist(), float(found.integrity[0])
    ([0.0, 1.0], 1.0)
    """
    limit = capsize_limit(ship).angle
    rate = coefficients(ship, 0.0, 0.0).roll_frequency * limit
    roll, rates = np.linspace(-limit, limit, _ANGLES), np.linspace(-rate, rate, _RATES)
    waves = [Wave(wave.length, height) for height in sorted({0.0, *heights, wave.height})]
    maps = []
    for i, each in enumerate(waves):
        maps.append(basin(equations(ship, each, speed, heading), roll, rates, periods=periods))
        if progress is not None:
            progress(i + 1, len(waves))
    share = np.array([ds.attrs["safe_share"] for ds in maps])
    integrity = share / share[0] if share[0] > 0 else np.full(share.size, np.nan)
    return Integrity(maps, np.array([each.height for each in waves]), share, integrity)

"""All waves that meet a ship at one frequency."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY
from quartering.loads.waves import heading_components

Floats = NDArray[np.float64]


def wave_frequencies_met(frequency: ArrayLike, speed: float, heading: float) -> Floats:
    """Frequencies of all waves that a ship meets at one encounter frequency, of either sign.

    frequency (n,): |omega| > 0 [rad/s]
    speed, heading: [m/s], [deg]
    Returns (n, 3): two waves that overtake the ship and one that it overtakes, NaN where there is none; one alone in
        bow seas, at rest and above the largest frequency g/(4 U cos mu) of waves that overtake it [rad/s]

    Roots of sigma - a sigma^2 = +-|omega|, a = U cos(mu)/g, in a form that holds for a -> 0.
    """
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    a = -float(heading_components(heading)[0]) * speed / GRAVITY
    below = 1.0 - 4.0 * a * w
    root = np.sqrt(np.where(below >= 0.0, below, np.nan))
    found = np.full((w.size, 3), np.nan)
    found[:, 0] = 2.0 * w / (1.0 + root)
    if a > 0.0:
        found[:, 1] = (1.0 + root) / (2.0 * a)
        found[:, 2] = (1.0 + np.sqrt(1.0 + 4.0 * a * w)) / (2.0 * a)
    return found

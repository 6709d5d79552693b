"""Largest values of a Gaussian motion in a time: by Rice's rate of crossings, and by Vanmarcke's for motions in groups."""

# A narrow-banded motion crosses a level several times in one group of large swings, so that crossings are not independent and
# Rice's count of 2 T/Tz of them is a bound. Vanmarcke counts groups: with bandwidth q = sqrt(1 - m1^2/(m0 m2)),
#
#   P(max |x| < b s) = (1 - e^(-b^2/2)) exp{-(2 T/Tz) e^(-b^2/2) (1 - e^(-sqrt(pi/2) q^1.2 b))/(1 - e^(-b^2/2))}
#
# whose mean is the integral of 1 - P over b.

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
EULER: Final = 0.5772156649015329
_LEVELS = np.linspace(0.0, 12.0, 2401)[1:]


def rice_largest(swings: ArrayLike) -> tuple[Floats, Floats]:
    """Most probable and mean largest of independent peaks of a Gaussian motion, over its root mean square.

    swings (...): N, above 1: T/Tz peaks of one sign, 2 T/Tz of both
    Returns most_probable, mean (...): sqrt(2 ln N), and with Euler's constant g sqrt(2 ln N) + g/sqrt(2 ln N)

    Source: [Rice44].  Valid: as a bound where the motion comes in groups.

    >>> [round(float(one), 4) for one in rice_largest(1600.0)]
    [3.8413, 3.9916]
    """
    most = np.sqrt(2.0 * np.log(np.maximum(np.asarray(swings, dtype=float), np.e)))
    return most, most + EULER / most


def vanmarcke_largest(duration: float, period: ArrayLike, bandwidth: ArrayLike) -> tuple[Floats, Floats]:
    """Most probable and mean largest |x| of a Gaussian motion over its root mean square, swings in groups counted once.

    duration: T [s]
    period (...): mean zero-crossing period Tz [s]
    bandwidth (...): sqrt(1 - m1^2/(m0 m2)), 0 to 1
    Returns typical, mean (...): level not passed with probability 1/e, and the mean

    Source: [Vanmarcke75].  Valid: Gaussian motion; within 2 to 6 % of simulated linear roll over 3 h.

    >>> round(float(vanmarcke_largest(10800.0, 15.4871, 0.042698)[1]), 3)  # simulated: 3.458, every swing counted: 3.957
    3.262
    """
    tz, q = (np.asarray(one, dtype=float)[..., None] for one in np.broadcast_arrays(period, bandwidth))
    bell = np.exp(-0.5 * _LEVELS**2)
    groups = -np.expm1(-np.sqrt(np.pi / 2.0) * np.maximum(q, 0.0) ** 1.2 * _LEVELS) / -np.expm1(-0.5 * _LEVELS**2)
    below = -np.expm1(-0.5 * _LEVELS**2) * np.exp(-2.0 * duration / tz * bell * groups)
    step = _LEVELS[1] - _LEVELS[0]
    mean = step * ((1.0 - below).sum(axis=-1) + 0.5)  # the trapezia's first half step, where nothing stays below
    first = (below < 1.0 / np.e).sum(axis=-1).clip(1, _LEVELS.size - 1)
    low, high = (np.take_along_axis(below, k[..., None], axis=-1)[..., 0] for k in (first - 1, first))
    typical = _LEVELS[first - 1] + step * (1.0 / np.e - low) / (high - low)
    return np.asarray(typical), np.asarray(mean)

"""Parametric roll in closed form, from one harmonic of half the encounter frequency.

    phi'' + 2 zeta phi' + (1 + h cos W t) phi = 0

with time in units of the reciprocal of the natural frequency at the mean GM.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def threshold(ratio: ArrayLike, damping: ArrayLike) -> Floats:
    """Least variation h = GM_1/GM_mean with which roll grows near W = 2.

    ratio (...): W, encounter frequency over natural frequency at the mean GM
    damping (...): zeta, of critical at the mean GM
    Returns (...)

    h = 2 sqrt((1 - W^2/4)^2 + (zeta W)^2): 4 zeta at W = 2.  Valid: small h; at W 10 % off, 2 to 3 % off.
    """
    W, zeta = np.asarray(ratio, dtype=float), np.asarray(damping, dtype=float)
    return np.asarray(2.0 * np.sqrt((1.0 - W**2 / 4.0) ** 2 + (zeta * W) ** 2))

"""Second moments of roll and of the lateral acceleration over the cells of a sea, and what follows from them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.study.seas.extremes import rice_largest, vanmarcke_largest

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
_PAIRS = np.triu_indices(4)


class Moments(NamedTuple):
    """Covariance of (v, phi, p, r) (4, 4), and moments 0, 1, 2 over |omega| of roll and of the lateral acceleration."""

    covariance: Floats
    roll: Floats
    acceleration: Floats

    @property
    def roll_period(self) -> float:
        """Mean zero-crossing period of roll [s]."""
        return _period(self.roll)

    def roll_largest(self, hours: float) -> tuple[float, float, float, float]:
        """Most probable and mean largest roll over its root mean square, and the bounds of both."""
        return _largest(self.roll, hours)

    def acceleration_largest(self, hours: float) -> tuple[float, float, float, float]:
        """The same of the lateral acceleration."""
        return _largest(self.acceleration, hours)


def products(motion: Complex, frequency: Floats, speed: float, place: tuple[float, float]) -> Floats:
    """What the energies of the cells are summed with: (n, 16) from phasors (4 .., n) of v, phi, p, r at (n,) frequencies.

    Lateral acceleration as an accelerometer feels it, the deck's own gravity in it: v' + U r + x r' - z p' - g phi, summed as
    phasors and then squared.
    """
    v, phi, p, r = motion[:4]
    x, z = place
    rate = 1j * frequency
    felt = rate * (v + x * r - z * p) + speed * r - GRAVITY * phi
    states = motion[:4]
    columns = [(states[a] * states[b].conj()).real for a, b in zip(*_PAIRS, strict=True)]
    for one in (phi, felt):
        square = np.abs(one) ** 2
        columns += [square, square * frequency, square * frequency**2]
    return np.stack(columns, axis=1)


def moments_of(sums: Floats) -> Moments:
    """Moments from the sums (16,) of energies times `products`."""
    c = np.zeros((4, 4))
    c[_PAIRS] = sums[:10]
    return Moments(c + np.triu(c, 1).T, sums[10:13], sums[13:16])


def _period(m: Floats) -> float:
    return float(2.0 * np.pi * np.sqrt(m[0] / m[2])) if m[2] > 0 else np.nan


def _largest(m: Floats, hours: float) -> tuple[float, float, float, float]:
    duration, period = 3600.0 * hours, _period(m)
    if not np.isfinite(period):
        return 0.0, 0.0, 0.0, 0.0
    bandwidth = float(np.sqrt(max(1.0 - m[1] ** 2 / (m[0] * m[2]), 0.0)))
    typical, mean = vanmarcke_largest(duration, period, bandwidth)
    most, bound = rice_largest(2.0 * duration / period)
    return float(typical), float(mean), float(most), float(bound)

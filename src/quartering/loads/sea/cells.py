"""The grid of wave cells a sea is cut into: frequencies, headings on one side of the ship, and the energy in each."""

# A ship that is alike on both sides is pushed by a wave from port as by its mirror image from starboard: sway, roll and yaw
# change sign, all their products do not. Energy at -mu is therefore put to that at mu, and half the cells do.
#
# How fine: the midpoint sum over a resonance of half width zeta w2 errs in variance by 2 exp(-2 pi zeta w2/d omega) at most,
# d omega = d sigma |1 - 2 a sigma| there. With d omega = 0.8 zeta w2 that is 8e-4. In directions the same holds where the
# line U cos mu = g/(4 w2) runs through the sea: there d mu <= 0.8 zeta/tan mu*.
#
# The spectrum is sampled by the same sum: the narrow peak of a long swell beside a short sea, or the wide cells of a strongly
# damped ship, would else miss it. JONSWAP's peak is 0.07 and 0.09 of its own frequency wide.

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.loads.sea.sea import Sea
from quartering.loads.waves import encounter_frequency

Floats = NDArray[np.float64]

FINENESS: Final = 0.8
"""Width of a cell in half widths of the roll resonance [1]."""
OF_PEAK: Final = 0.06
"""Width of a cell in frequencies of the lowest peak, at the most [1]: it is 3.55/60 where one system has its usual cut."""
_WIDEST, _NARROWEST = 5.0, 2.5
_FEWEST, _MOST = 60, 1000


@dataclass(frozen=True, eq=False)
class Cells:
    """Wave cells of one speed: every frequency with every heading.

    Parameters
    ----------
    sigma : (f,) float      middles of the cells [rad/s]
    step : float            their width [rad/s]
    heading : (d,) float    0 to 180, first those evenly spaced for spread systems, then those of long-crested ones [deg]
    breadth : float         of the evenly spaced ones [deg]; 0 where there are none
    speed : float           [m/s]
    """

    sigma: Floats
    step: float
    heading: Floats
    breadth: float
    speed: float

    @property
    def even(self) -> int:
        """How many headings are evenly spaced."""
        return 0 if self.breadth == 0 else round(180.0 / self.breadth) + 1

    @cached_property
    def flat(self) -> tuple[Floats, Floats]:
        """Frequency and heading of each of f d cells, the headings of one frequency together."""
        sigma, heading = np.meshgrid(self.sigma, self.heading, indexing="ij")
        return sigma.ravel(), heading.ravel()

    @cached_property
    def omega(self) -> Floats:
        """Signed encounter frequency (f d,) [rad/s]."""
        return encounter_frequency(self.flat[0], self.speed, self.flat[1])

    def energy(self, sea: Sea) -> Floats:
        """Energy of a sea in each cell (f d,), both sides of the ship together [m2]."""
        total = np.zeros((self.sigma.size, self.heading.size))
        for one in sea.partitions:
            if one.spreading is None:
                at = int(np.abs(self.heading[self.even :] - abs(one.heading)).argmin()) + self.even
                total[:, [at]] += one.energy(self.sigma, self.step, self.heading[[at]], 0.0)
                continue
            right = self.heading[: self.even]
            total[:, : self.even] += one.energy(self.sigma, self.step, right, self.breadth)
            total[:, 1 : self.even - 1] += one.energy(self.sigma, self.step, -right[1:-1], self.breadth)
        return total.ravel()


def wave_cells(seas: Sequence[Sea], speed: float, roll_frequency: float, damping: float) -> Cells:
    """One grid for several seas at one speed.

    speed: [m/s]
    roll_frequency: w2 of free roll [rad/s]
    damping: zeta of free roll, fraction of critical
    """
    systems = [one for sea in seas for one in sea.partitions]
    low, high = min(one.band[0] for one in systems), max(one.band[1] for one in systems)
    width = FINENESS * damping * roll_frequency / math.sqrt(1.0 + 4.0 * speed * roll_frequency / GRAVITY)
    width = min(width, OF_PEAK * min(one.peak for one in systems))
    count = int(np.clip(math.ceil((high - low) / max(width, 1e-9)), _FEWEST, _MOST))
    step = (high - low) / count
    spread = [one.deviation for one in systems if one.spreading is not None]
    even: Floats = np.empty(0)
    breadth = 0.0
    if spread:
        of_sea = min(_WIDEST, math.degrees(min(spread)) / 3.0)
        wanted = min(of_sea, max(_of_pile_up(speed, roll_frequency, damping), _NARROWEST))
        parts = math.ceil(180.0 / wanted)
        even, breadth = np.linspace(0.0, 180.0, parts + 1), 180.0 / parts
    own = sorted({abs(one.heading) for one in systems if one.spreading is None})
    middles: Floats = low + step * (np.arange(count, dtype=float) + 0.5)
    headings: Floats = np.append(even, own).astype(float)
    return Cells(middles, step, headings, breadth, speed)


def _of_pile_up(speed: float, roll_frequency: float, damping: float) -> float:
    """Width of directions that the line of synchronous roll asks for [deg]."""
    cosine = pile_up_cosine(speed, roll_frequency, 4.0)
    if not 0.0 < cosine < 1.0:
        return _WIDEST
    return math.degrees(FINENESS * damping * cosine / math.sqrt(1.0 - cosine**2))


def pile_up_cosine(speed: float, roll_frequency: float, m: float) -> float:
    """cos mu at which a broad band of waves arrives at one frequency: g/(m w2 U), m 4 for w2 itself and 8 for 2 w2."""
    return GRAVITY / (m * roll_frequency * speed) if speed * roll_frequency > 0 else math.inf

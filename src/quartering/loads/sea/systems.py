"""The parts of a sea: one wave system of a named spectrum, or a measured spectrum over frequency and direction."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.loads.sea.shape import integral, mean_period_ratio, shape
from quartering.loads.sea.spreading import Spreading, directional_density, spread_deviation

Floats = NDArray[np.float64]

TURN: Final = 360.0
JONSWAP_POWER: Final = 5.0


def wrapped(heading: ArrayLike) -> Floats:
    """Headings in (-180, 180] [deg].

    >>> wrapped([190.0, -180.0, 45.0]).tolist()
    [-170.0, 180.0, 45.0]
    """
    return np.asarray(180.0 - np.remainder(180.0 - np.asarray(heading, dtype=float), TURN))


@dataclass(frozen=True)
class WaveSystem:
    """Waves of one origin: a spectrum of the family of `shape`, going one way with some spreading.

    Parameters
    ----------
    hs : float             4 sqrt(m0) [m]
    tp : float             period of the peak [s]
    power : float          n of the tail sigma^-n
    gamma : float          peak enhancement
    heading : float        main direction the waves go to, from the bow [deg]
    spreading : Spreading
    cut : (low, high)      part of the spectrum that acts on a ship, in peak frequencies

    Examples
    --------
    >>> one = WaveSystem(6.0, 11.0)
    >>> round(one.moment(0) * 16 / 36, 12), round(one.tz / one.tp, 6)
    (1.0, 0.777399)
    """

    hs: float
    tp: float
    power: float = JONSWAP_POWER
    gamma: float = 3.3
    heading: float = 0.0
    spreading: Spreading = None
    cut: tuple[float, float] = (0.45, 4.0)

    @property
    def peak(self) -> float:
        """Frequency of the peak [rad/s]."""
        return 2.0 * np.pi / self.tp

    @property
    def tz(self) -> float:
        """Mean zero-crossing period [s]."""
        return self.tp * mean_period_ratio(self.power, self.gamma)

    @property
    def band(self) -> tuple[float, float]:
        """Frequencies between which it acts on a ship [rad/s]."""
        return self.cut[0] * self.peak, self.cut[1] * self.peak

    @property
    def deviation(self) -> float:
        """Circular standard deviation of its directions [rad]."""
        return spread_deviation(self.spreading)

    def density(self, sigma: ArrayLike) -> Floats:
        """Spectrum over all directions at (...) frequencies [m2 s/rad]."""
        x = np.asarray(sigma, dtype=float) / self.peak
        return self.hs**2 / 16.0 / self.peak / integral(self.power, self.gamma) * shape(x, self.power, self.gamma)

    def moment(self, n: float) -> float:
        """Integral of sigma^n times the spectrum from 0 to infinity [m2 (rad/s)^n]."""
        ratio = integral(self.power, self.gamma, n) / integral(self.power, self.gamma)
        return self.hs**2 / 16.0 * self.peak**n * ratio

    def energy(self, sigma: Floats, step: float, heading: Floats, breadth: float) -> Floats:
        """Energy of cells about (f,) frequencies and (d,) headings [m2], those outside the band left out.

        Of a long-crested system ``heading`` is its own one. A cell that the end of the band cuts counts by its part.
        """
        low, high = self.band
        inside = np.clip((np.minimum(sigma + step / 2, high) - np.maximum(sigma - step / 2, low)) / step, 0.0, 1.0)
        by_frequency = step * inside * self.density(sigma)
        if self.spreading is None:
            return by_frequency[:, None]
        angle = np.radians(heading - self.heading)
        return by_frequency[:, None] * (directional_density(angle, self.spreading) * np.radians(breadth))

    def turned(self, by: float) -> WaveSystem:
        """The same waves from another side."""
        return replace(self, heading=float(wrapped(self.heading + by)))


@dataclass(frozen=True, eq=False)
class MeasuredSystem:
    """A spectrum over frequency and direction, as measured or computed elsewhere.

    Parameters
    ----------
    sigma : (f,) float         ascending [rad/s]
    direction : (d,) float     the waves go to, from the bow, ascending and evenly spaced round the circle [deg]
    values : (f, d) float      S(sigma, mu) [m2 s/rad per rad], none below 0

    Examples
    --------
    >>> flat = MeasuredSystem(np.array([0.5, 0.6, 0.7]), np.arange(-170.0, 181.0, 10.0), np.ones((3, 36)))
    >>> round(flat.moment(0) / (2 * np.pi * 0.2), 12)
    1.0
    """

    sigma: Floats
    direction: Floats
    values: Floats

    spreading: Final = "measured"

    @cached_property
    def by_frequency(self) -> Floats:
        """Sum over directions (f,) [m2 s/rad]."""
        return np.asarray(self.values.sum(axis=1) * 2 * np.pi / self.direction.size)

    @property
    def heading(self) -> float:
        """Mean direction, weighted by energy [deg]."""
        width = np.gradient(self.sigma)
        towards = (self.values * width[:, None]).sum(axis=0) @ np.exp(1j * np.radians(self.direction))
        return float(np.degrees(np.angle(towards)))

    @property
    def hs(self) -> float:
        """4 sqrt(m0) [m]."""
        return float(4.0 * np.sqrt(self.moment(0)))

    @property
    def peak(self) -> float:
        """Frequency of the largest density [rad/s]."""
        return float(self.sigma[self.by_frequency.argmax()])

    @property
    def tp(self) -> float:
        """Period of the peak [s]."""
        return 2.0 * np.pi / self.peak

    @property
    def band(self) -> tuple[float, float]:
        """Frequencies between which it acts on a ship: all it holds [rad/s]."""
        return float(self.sigma[0]), float(self.sigma[-1])

    @property
    def deviation(self) -> float:
        """Circular standard deviation of its directions, with that of the straight lines between them [rad]."""
        width = np.gradient(self.sigma)
        by_direction = (self.values * width[:, None]).sum(axis=0)
        r1 = abs(by_direction @ np.exp(1j * np.radians(self.direction))) / by_direction.sum()
        apart = 2.0 * np.pi / self.direction.size
        return float(np.sqrt(max(2.0 * (1.0 - r1), 0.0) + apart**2 / 6.0))  # a triangle of half breadth b: b/sqrt(6)

    def density(self, sigma: ArrayLike) -> Floats:
        """Spectrum over all directions at (...) frequencies, linear between those it holds, 0 outside [m2 s/rad]."""
        return np.asarray(np.interp(np.asarray(sigma, dtype=float), self.sigma, self.by_frequency, 0.0, 0.0))

    def moment(self, n: float) -> float:
        """Integral of sigma^n times the spectrum, by trapezia on its own frequencies [m2 (rad/s)^n]."""
        part = self.sigma**n * self.by_frequency
        return float((0.5 * np.diff(self.sigma) * (part[1:] + part[:-1])).sum())

    def energy(self, sigma: Floats, step: float, heading: Floats, breadth: float) -> Floats:
        """Energy of cells about (f,) frequencies and (d,) headings [m2].

        The integral of straight lines between its directions and between its frequencies, so that every cell has the energy
        that lies in it, whichever cells are asked for.
        """
        edges = np.concatenate([heading - breadth / 2, heading + breadth / 2])
        below = _running_sum_round(self.direction, self.values, edges)
        towards = below[:, heading.size :] - below[:, : heading.size]
        edges = np.append(sigma - step / 2, sigma[-1] + step / 2)
        return np.diff(_running_integral(self.sigma, towards, edges), axis=0)

    def turned(self, by: float) -> MeasuredSystem:
        """The same waves from another side."""
        moved = wrapped(self.direction + by)
        order = np.argsort(moved)
        return MeasuredSystem(self.sigma, moved[order], self.values[:, order])


def _running_sum_round(direction: Floats, values: Floats, at: Floats) -> Floats:
    """Integral round the circle from direction[0] to (m,) angles of straight lines between values (f, d): (f, m) [.. rad]."""
    count = direction.size
    place = (at - direction[0]) / (TURN / count)
    whole = np.floor(place).astype(int)
    share, first = place - whole, whole % count
    following = np.roll(values, -1, axis=1)
    sums = np.concatenate([np.zeros((len(values), 1)), np.cumsum(0.5 * (values + following), axis=1)], axis=1)
    inside = share * (values[:, first] + 0.5 * share * (following[:, first] - values[:, first]))
    return np.asarray((sums[:, first] + (whole // count) * sums[:, [-1]] + inside) * (2.0 * np.pi / count))


def _running_integral(x: Floats, y: Floats, at: Floats) -> Floats:
    """Integral from x[0] to (m,) places of straight lines between values (f, d): (m, d)."""
    steps = 0.5 * np.diff(x)[:, None] * (y[1:] + y[:-1])
    sums = np.concatenate([np.zeros((1, y.shape[1])), np.cumsum(steps, axis=0)])
    place = np.clip(at, x[0], x[-1])
    i = np.clip(np.searchsorted(x, place, side="right") - 1, 0, x.size - 2)
    dx = (place - x[i])[:, None]
    slope = (y[i + 1] - y[i]) / (x[i + 1] - x[i])[:, None]
    return np.asarray(sums[i] + dx * (y[i] + 0.5 * dx * slope))


def checked_cut(cut: object) -> tuple[float, float]:
    """The part of a spectrum that acts, refused where it is none.

    >>> checked_cut((0.5, 3))
    (0.5, 3.0)
    """
    try:
        low, high = (float(part) for part in cut)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        low, high = np.nan, np.nan
    if not 0.05 <= low < 1.0 < high <= 20.0:
        raise InputError(
            f"cut = {cut!r}; it is two numbers in peak frequencies, the first from 0.05 to below 1, the second above 1 to 20;"
            " try (0.45, 4.0)"
        )
    return low, high

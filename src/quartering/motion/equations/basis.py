"""Sampled harmonics: tables that project the balance equations without aliasing."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Basis:
    """Cosines and sines of the chosen harmonics at equally spaced phases.

    Column order: the mean (when harmonic 0 is chosen), then cos and sin of each harmonic in turn.

    Parameters
    ----------
    orders : tuple of int     harmonics, ascending; 0 is the mean
    values : (b, m) float     of sway, roll and yaw displacement
    rates : (b, m) float      d/d(phase); the mean of sway and yaw velocity stands in the mean's row
    factors : (b,) float      h of each row; 0 for the mean, whose rate is not multiplied by the frequency
    weights : (b,) float      projection weights: 2/m, or 1/m for the mean
    phases : (m,) float       [rad]
    """

    orders: tuple[int, ...]
    values: Floats
    rates: Floats
    factors: Floats
    weights: Floats
    phases: Floats

    @property
    def arrays(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Tables in the order the kernels take them."""
        return self.values, self.rates, self.factors, self.weights

    def waves(self, periods: int, inputs: int) -> Floats:
        """The wave's own harmonics (``inputs``, m) at the phases: 1, cos, sin, cos 2, ..; ``periods`` of it in a cycle."""
        return waves_at(periods * self.phases, inputs)


@lru_cache(maxsize=64)
def basis(orders: tuple[int, ...], degree: int, modulus: bool, extra: int = 0, fewest: int = 0) -> Basis:
    """Sampled harmonics, with enough phases for products of a given degree to project without aliasing.

    orders: harmonics; all odd for a motion that is symmetric over half a period
    degree: highest degree of the products
    modulus: products with a modulus present: not band-limited, so many samples are taken
    extra: additional harmonics of a derivative that must come out exact
    fewest: samples a cycle at the least, and a quarter of that for each harmonic: drag |q| q is not band-limited, but
        its harmonics fall with the cube of their order

    Products of degree d of harmonics up to H hold harmonics up to dH; those alias back onto H unless the cycle has more
    than (d + 1) H samples.  For odd harmonics both factors of a projection change sign after half a period, so half the
    samples suffice.  Source: [Krack19] (alternating frequency-time).
    """
    top = max(orders)
    samples = (degree + 1) * top + extra + 1
    if modulus:
        samples = max(samples, 64 * top + extra)
    samples = max(samples, fewest, fewest // 4 * top)
    symmetric = all(h % 2 == 1 for h in orders)
    samples += samples % 2
    phases = 2 * np.pi * np.arange(samples // 2 if symmetric else samples) / samples
    values, rates, factors = harmonics_at(orders, phases)
    weights = np.where(factors > 0, 2.0, 1.0) / phases.size
    for table in (values, rates, factors, weights, phases):
        table.flags.writeable = False
    return Basis(orders, values, rates, factors, weights, phases)


def waves_at(phases: Floats, inputs: int) -> Floats:
    """1 and cos, sin of phases and their multiples.

    phases (m,): of the wave [rad]
    inputs: rows wanted, odd
    Returns (inputs, m)

    >>> waves_at(np.zeros(1), 3).ravel().tolist()
    [1.0, 1.0, 0.0]
    """
    angles = np.multiply.outer(np.arange(1, inputs // 2 + 1), phases)
    out = np.ones((inputs, phases.size))
    out[1::2], out[2::2] = np.cos(angles), np.sin(angles)
    return out


def harmonics_at(orders: tuple[int, ...], phases: Floats) -> tuple[Floats, Floats, Floats]:
    """Cosines and sines of chosen harmonics at any phases.

    orders: harmonics, ascending; 0 is the mean
    phases (m,): [rad]
    Returns values, rates (b, m): as in `Basis`; factors (b,)

    >>> harmonics_at((0, 1), np.array([0.0]))[0].ravel().tolist()
    [1.0, 1.0, 0.0]
    """
    values, rates, factors = [], [], []
    for h in orders:
        if h == 0:
            values.append(np.ones_like(phases))
            rates.append(np.ones_like(phases))
            factors.append(0.0)
            continue
        values += [np.cos(h * phases), np.sin(h * phases)]
        rates += [-h * np.sin(h * phases), h * np.cos(h * phases)]
        factors += [float(h)] * 2
    return np.array(values), np.array(rates), np.array(factors)

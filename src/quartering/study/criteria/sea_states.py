"""Sea states of the criteria: the scatter table, its wave cases, and the effective wave of a ship's length in each."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml
from numpy.typing import ArrayLike, NDArray

from quartering.loads.sea.shape import integral, mean_period_ratio, shape
from quartering.study.criteria.constants import limit

Floats = NDArray[np.float64]

_FILE = Path(__file__).with_name("scatter.yaml")
_FREQUENCIES = 4000
_TAIL = 5.0
"""Power of the tail of Bretschneider's spectrum."""


class Scatter(NamedTuple):
    """Sea states by significant height and zero-crossing period.

    Parameters
    ----------
    hs : (n,)          significant wave heights [m]
    tz : (m,)          zero-crossing periods [s]
    weight : (n, m)    shares of all sea states, sum 1
    status : str       how sure the table is
    """

    hs: Floats
    tz: Floats
    weight: Floats
    status: str


@cache
def scatter() -> Scatter:
    """The scatter table of the North Atlantic.

    Source: IACS Recommendation 34 (recalled).
    """
    data = yaml.safe_load(_FILE.read_text(encoding="utf-8"))
    counts = np.array(data["counts"], dtype=float)
    return Scatter(np.array(data["hs"]), np.array(data["tz"]), counts / counts.sum(), str(data["status"]))


@cache
def wave_cases() -> Floats:
    """The 16 wave cases (16, 3): weight, wave length [m], wave height [m]."""
    return np.array(yaml.safe_load(_FILE.read_text(encoding="utf-8"))["cases"], dtype=float)


def bretschneider(frequency: ArrayLike, hs: ArrayLike, tz: ArrayLike) -> Floats:
    """Spectral density of the wave's elevation [m2 s/rad], written by the zero-crossing period.

    S = (4 pi^3 Hs^2/Tz^4) w^-5 exp(-16 pi^3 w^-4/Tz^4); its m0 is Hs^2/16.
    """
    w, height, period = (np.asarray(one, dtype=float) for one in (frequency, hs, tz))
    peak = 2 * math.pi * mean_period_ratio(_TAIL) / period
    return height**2 / 16 / (peak * integral(_TAIL)) * shape(w / peak, _TAIL)


def effective_deviation(length: float, hs: ArrayLike, tz: ArrayLike) -> Floats:
    """Standard deviation of the effective wave's amplitude [m], for pairs of height [m] and period [s].

    The effective wave is cos(2 pi x/L) fitted to the sea along the ship by least squares. A wave of number k gives
    2 Q sin Q/(pi^2 - Q^2), Q = k L/2, which is 1 at k L = 2 pi. Source: Grim, as in MSC.1/Circ.1627 (recalled).
    """
    height, period = np.broadcast_arrays(np.asarray(hs, dtype=float), np.asarray(tz, dtype=float))
    # In w Tz, in whose terms all Bretschneider spectra are one; 25/Tz leaves 1e-5 of the energy beyond it.
    scaled = np.linspace(1.0, 40.0, _FREQUENCIES)
    w = scaled / period[..., None]
    q = w**2 * length / (2 * limit("general.gravity"))
    near = np.abs(q - math.pi) < 1e-6
    factor = np.where(near, 1.0, 2 * q * np.sin(q) / np.where(near, 1.0, math.pi**2 - q**2))
    density = bretschneider(w, height[..., None], period[..., None])
    return np.sqrt(np.trapezoid(factor**2 * density, w, axis=-1))


def joint_density(length: float, hs: ArrayLike, tz: ArrayLike, ratio: ArrayLike, steepness: ArrayLike) -> Floats:
    """Joint density of wave length over ship length, r, and wave steepness, s, in a sea state [1].

    Source: Longuet-Higgins (1983) for the joint density of period and height, written for r and s in deep water, as in
    MSC.1/Circ.1627 (recalled).
    """
    height, period, r, s = (np.asarray(one, dtype=float) for one in (hs, tz, ratio, steepness))
    width, mean = limit("effective_wave.spectral_width"), limit("effective_wave.mean_over_zero_crossing") * period
    gravity = limit("general.gravity")
    spread = math.sqrt(1 + width**2)
    front = 4 * math.sqrt(gravity) / (math.pi * width) * spread / (1 + spread) * length**2.5 * mean / height**3
    detuned = 1 - np.sqrt(gravity * mean**2 / (2 * math.pi * r * length))
    inside = -2 * (length * r * s / height) ** 2 * (1 + (detuned / width) ** 2)
    return front * s**2 * r**1.5 * np.exp(inside)

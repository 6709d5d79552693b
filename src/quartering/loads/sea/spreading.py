"""How the energy of a sea spreads over directions."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError, as_float
from quartering.option_checks import quoted

Floats = NDArray[np.float64]
Spreading = float | Literal["cos2"] | None
"""s of cos^2s of half the angle; "cos2": cos^2 of the angle over 90 deg to either side; None: long-crested."""

_LARGEST = 5000.0


def checked_spreading(given: object) -> Spreading:
    """A spreading, refused when it is none; an infinite s is long-crested.

    >>> checked_spreading(float("inf")) is None, checked_spreading("cos2"), checked_spreading(8)
    (True, 'cos2', 8.0)
    """
    if given is None:
        return None
    if isinstance(given, str) and given == "cos2":
        return "cos2"
    s = as_float(given)
    if isinstance(s, bool) or not isinstance(s, (int, float, np.number)) or not s > 0:
        raise InputError(
            f'spreading = {quoted(given)}; it is s > 0 of cos^2s of half the angle, "cos2", or None for a long-crested sea; try'
            " 10"
        )
    if math.isinf(s):
        return None
    if s > _LARGEST:
        raise InputError(
            f"spreading = {s:g}; above {_LARGEST:g} all waves go within a degree: give None, a long-crested sea"
        )
    return float(s)


def directional_density(angle: ArrayLike, spreading: float | Literal["cos2"]) -> Floats:
    """Share of the energy per radian at angles from the main direction.

    angle (...): [rad]
    Returns (...): [1/rad], integral 1 over the circle

    D = G(s + 1)/(2 sqrt(pi) G(s + 1/2)) cos^2s(angle/2), with logarithms of the gamma functions G, which overflow at s = 170.
    Source: [LonguetHiggins63]; "cos2", (2/pi) cos^2 over a half circle, is the form of the ITTC.
    """
    theta = np.remainder(np.asarray(angle, dtype=float) + np.pi, 2 * np.pi) - np.pi
    if spreading == "cos2":
        return np.asarray(np.where(np.abs(theta) < np.pi / 2, 2 / np.pi * np.cos(theta) ** 2, 0.0))
    s = float(spreading)
    norm = math.exp(math.lgamma(s + 1.0) - math.lgamma(s + 0.5)) / (2.0 * math.sqrt(math.pi))
    return np.asarray(norm * np.abs(np.cos(0.5 * theta)) ** (2.0 * s))


def spread_deviation(spreading: Spreading) -> float:
    """Circular standard deviation sqrt(2 (1 - r1)) of the directions; 0 of a long-crested sea [rad]."""
    if spreading is None:
        return 0.0
    if spreading == "cos2":
        return math.sqrt(2.0 * (1.0 - 8.0 / (3.0 * math.pi)))
    return math.sqrt(2.0 / (1.0 + float(spreading)))

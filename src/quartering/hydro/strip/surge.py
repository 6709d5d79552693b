"""Surge added mass of an equivalent slender spheroid."""

from __future__ import annotations

import math

from quartering.conventions import InputError


def spheroid_surge(length: float, volume: float) -> float:
    """Added mass in surge over displaced mass, of half a prolate spheroid with the ship's length and volume.

    length: L [m]
    volume: displaced volume, less than that of the half sphere over L [m3]
    Returns k1 [1]

    k1 = alpha/(2 - alpha), alpha = 2 (1 - e^2)/e^3 (artanh e - e), e the eccentricity, free surface a rigid lid.
    Source: [Lamb32] art. 114.  Valid: estimate; independent of frequency and of the shape of the ends.

    Length over breadth 5.01, for which Lamb tabulates 0.059:

    >>> round(spheroid_surge(5.01, 2 * math.pi / 3 * 2.505 * 0.5**2), 3)
    0.059
    """
    if not (math.isfinite(length) and math.isfinite(volume) and length > 0 and volume > 0):
        raise InputError(f"length {length} m and volume {volume} m3 given; both must be positive numbers")
    slenderness = 3 * volume / (math.pi * length) / (length / 2) ** 2  # (b/a)^2: volume = (2/3) pi a b^2, a = L/2
    if slenderness >= 1:
        raise InputError(f"volume {volume:g} m3 is too large for a spheroid of length {length:g} m; it must be slender")
    e = math.sqrt(1 - slenderness)
    alpha = 2 * (1 - e**2) / e**3 * (math.atanh(e) - e)
    return alpha / (2 - alpha)

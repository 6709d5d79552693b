"""The one family behind the named frequency spectra: its density, its integrals, its peak."""

# With x = sigma/sigma_p every spectrum here is
#
#     S(sigma) = m0/(sigma_p I) x^-n exp(-(n/4) x^-4) gamma^b(x),   b = exp(-(x - 1)^2/(2 s^2)),  s = 0.07 (x <= 1), 0.09
#
# n = 5 is JONSWAP, with gamma = 1 Bretschneider; n = 4 the parts of Torsethaugen; n = 4 lambda + 1 those of Ochi and Hubble.
# For gamma = 1 the substitution t = (n/4) x^-4 gives the integral of x^k as a gamma function; what gamma adds is x^-n
# exp(..) (gamma^b - 1), which lives within eight widths s of the peak, where two Gauss rules find it to the last digits.

from __future__ import annotations

from functools import lru_cache
from math import gamma as gamma_function
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError

Floats = NDArray[np.float64]

WIDTHS: Final = (0.07, 0.09)
"""Widths s of the peak before and behind it, in peak frequencies [1]."""
_REACH: Final = 8.0
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(60)


def shape(x: ArrayLike, n: float, gamma: float = 1.0) -> Floats:
    """Spectral shape at frequencies in units of the peak's, not normalised.

    x (...): sigma/sigma_p; 0 where not positive
    n: power of the tail, S ~ x^-n
    gamma: peak enhancement
    Returns (...)

    Source: [Hasselmann73] for n = 5; the family as in [OchiHubble76].
    """
    at = np.asarray(x, dtype=float)
    size = np.where(at > 0.05, at, 1.0)  # below exp(-(n/4) 20^4) is 0
    plain = size**-n * np.exp(-0.25 * n * size**-4)
    return np.asarray(np.where(at > 0.05, plain * _enhanced(size, gamma), 0.0))


def _enhanced(x: Floats, gamma: float) -> Floats:
    width = np.where(x <= 1.0, *WIDTHS)
    return np.asarray(gamma ** np.exp(-0.5 * ((x - 1.0) / width) ** 2))


@lru_cache(maxsize=512)
def integral(n: float, gamma: float = 1.0, power: float = 0.0) -> float:
    """Integral of x^power times the shape, from 0 to infinity.

    n, gamma: as in `shape`
    power: below n - 1
    """
    a = 0.25 * (n - 1.0 - power)
    if a <= 0:
        raise InputError(
            f"moment {power:g} of this spectrum does not exist: its tail falls as sigma^-{n:g}; ask for one below {n - 1:g}"
        )
    plain = 0.25 * (0.25 * n) ** -a * gamma_function(a)
    if gamma == 1.0:
        return plain
    added = 0.0
    for begin, end in ((1.0 - _REACH * WIDTHS[0], 1.0), (1.0, 1.0 + _REACH * WIDTHS[1])):
        x = begin + (end - begin) * 0.5 * (_NODES + 1.0)
        part = x ** (power - n) * np.exp(-0.25 * n * x**-4) * (_enhanced(x, gamma) - 1.0)
        added += float(0.5 * (end - begin) * (_WEIGHTS * part).sum())
    return plain + added


def mean_period_ratio(n: float, gamma: float = 1.0) -> float:
    """Tz/Tp: mean zero-crossing period 2 pi sqrt(m0/m2) over the period of the peak.

    >>> round(mean_period_ratio(5.0, 1.0), 6)
    0.710371
    """
    return float(np.sqrt(integral(n, gamma) / integral(n, gamma, 2.0)))

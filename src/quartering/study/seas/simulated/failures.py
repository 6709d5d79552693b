"""Rates of failures: exact intervals of a count, and a test of whether the waiting times are exponential."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike


class Rate(NamedTuple):
    """Failures in an exposure: the rate, and the ends of its interval [1/s].

    Parameters
    ----------
    rate, lower, upper : float
    """

    rate: float
    lower: float
    upper: float


def failure_rate(failures: int, exposure: float, confidence: float = 0.95) -> Rate:
    """Rate of failures with the exact interval of a Poisson count.

    failures: k
    exposure: time until failure or end, summed [s]
    confidence: of the two-sided interval
    Returns NaN, 0 and infinite where there is no exposure

    chi2 quantiles of 2 k and 2 k + 2 degrees of freedom over twice the exposure.  Source: closed form (Garwood).
    """
    if not exposure > 0:
        return Rate(np.nan, 0.0, np.inf)
    tail = 0.5 * (1.0 - confidence)
    lower = _chi2(tail, 2 * failures) if failures else 0.0
    return Rate(failures / exposure, lower / (2.0 * exposure), _chi2(1.0 - tail, 2 * failures + 2) / (2.0 * exposure))


def _chi2(share: float, freedom: float) -> float:
    """Value that a share of chi2 of some degrees of freedom lies below."""
    from scipy.stats import chi2

    return float(chi2.ppf(share, freedom))


def weighted_rate(weight: ArrayLike, failures: ArrayLike, exposure: ArrayLike, confidence: float = 0.95) -> Rate:
    """Sum of rates by their weights, with an interval that is exact where all count alike.

    weight (n,): of each count [1]
    failures, exposure (n,): k, and time until failure or end [s]
    confidence: of the two-sided interval

    y = sum w k/T, v = sum (w/T)^2 k, m the largest w/T: the ends are v/(2 y) chi2 of 2 y^2/v degrees of freedom, and the same
    of y + m and v + m^2. Of counts with one w/T they are those of `failure_rate`.  Source: [Fay97].
    """
    each, k = np.asarray(weight, dtype=float) / np.asarray(exposure, dtype=float), np.asarray(failures, dtype=float)
    if each.size == 0:
        return Rate(0.0, 0.0, 0.0)
    y, v, m = float(each @ k), float(each**2 @ k), float(each.max())
    tail = 0.5 * (1.0 - confidence)
    lower = v / (2.0 * y) * _chi2(tail, 2.0 * y**2 / v) if y > 0 else 0.0
    more, spread = y + m, v + m**2
    upper = spread / (2.0 * more) * _chi2(1.0 - tail, 2.0 * more**2 / spread) if m > 0 else 0.0
    return Rate(y, lower, upper)


def waiting_times_p(times: ArrayLike, block: float, rate: float) -> float:
    """Probability of waiting times as far from exponential ones as these, by Kolmogorov and Smirnov's test.

    times (k,): of the failures since the begin of their blocks [s]
    block: length of a block, beyond which none is seen [s]
    rate: [1/s]
    Returns NaN of fewer than five failures

    u = (1 - e^(-r t))/(1 - e^(-r T)) is then uniform.
    """
    t = np.asarray(times, dtype=float)
    if t.size < 5 or not rate > 0:
        return float("nan")
    from scipy.stats import kstest

    return float(kstest(np.expm1(-rate * t) / np.expm1(-rate * block), "uniform").pvalue)

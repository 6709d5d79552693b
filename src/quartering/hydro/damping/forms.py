"""Roll damping written as linear, linear + quadratic or linear + cubic, and how one form is made from another.

A harmonic roll rate of amplitude p_a loses the same energy over a cycle to ``B2 |p| p``, to the linear
``(8/(3 pi)) B2 p_a p`` and to the cubic ``(32/(9 pi)) (B2/p_a) p^3``. Only at p_a: elsewhere the three differ.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats

LINEAR_OF_QUADRATIC: Final = 8 / (3 * np.pi)
"""Equal dissipation: |p| p of amplitude p_a loses as much as this times p_a p."""

LINEAR_OF_CUBIC: Final = 3 / 4
"""Equal dissipation: p^3 of amplitude p_a loses as much as this times p_a^2 p."""


class DampingForm(NamedTuple):
    """Linear damping and one nonlinear term, fitted over a range of amplitudes.

    Parameters
    ----------
    linear : float       B1, of p [N m s]
    nonlinear : float    B2, of |p| p [N m s2], or B3, of p^3 [N m s3]
    power : int          of the nonlinear term: 2 or 3
    misfit : float       root mean square of the fit's error over the mean damping of the range [1]
    """

    linear: float
    nonlinear: float
    power: int
    misfit: float

    def equivalent(self, rate: ArrayLike) -> Floats:
        """Linear damping of equal dissipation at a roll rate amplitude.

        rate (...): p_a = omega phi_a [rad/s]
        Returns (...): [N m s]

        B1 + (8/(3 pi)) B2 p_a or B1 + (3/4) B3 p_a^2.  Source: [Himeno81] ch. 2.
        """
        p = np.asarray(rate, dtype=float)
        factor = LINEAR_OF_QUADRATIC * p if self.power == 2 else LINEAR_OF_CUBIC * p**2
        return np.asarray(self.linear + self.nonlinear * factor)


def fitted_form(rate: ArrayLike, equivalent: ArrayLike, power: int) -> DampingForm:
    """Linear + quadratic or linear + cubic damping from equivalent linear damping at several amplitudes.

    rate (n,): amplitudes of the roll rate, n >= 2 [rad/s]
    equivalent (n,): equivalent linear damping at each [N m s]
    power: 2 or 3

    Least squares over the amplitudes given, all weighted alike.  Source: [Himeno81] ch. 2.
    """
    p, b = _positive(rate), np.asarray(equivalent, dtype=float)
    if power not in (2, 3):
        raise InputError(f"power {power} of the damping is unknown; allowed are 2 (quadratic) and 3 (cubic)")
    if p.ndim != 1 or p.shape != b.shape or p.size < 2:
        raise InputError("a damping form needs the equivalent damping at two amplitudes or more, as many of each")
    basis = LINEAR_OF_QUADRATIC * p if power == 2 else LINEAR_OF_CUBIC * p**2
    matrix = np.stack([np.ones_like(p), basis], axis=1)
    (linear, nonlinear), *_ = np.linalg.lstsq(matrix, b, rcond=None)
    misfit = np.sqrt(np.mean((matrix @ (linear, nonlinear) - b) ** 2)) / max(abs(float(np.mean(b))), 1e-300)
    return DampingForm(float(linear), float(nonlinear), power, float(misfit))


def _positive(amplitude_rate: ArrayLike) -> Floats:
    p = np.asarray(amplitude_rate, dtype=float)
    if not (np.isfinite(p).all() and (p > 0).all()):
        raise InputError(f"amplitude of the roll rate {p} rad/s must be a number above 0: frequency times angle")
    return p

"""Inoue's and Kijima's regression: linear and nonlinear sway-yaw derivatives of a merchant hull from its dimensions."""

from __future__ import annotations

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.sense import BLOCK


def inoue_derivatives(length: float, beam: float, draught: float, block: float, trim: float = 0.0) -> dict[str, float]:
    """Sway-yaw velocity derivatives of a merchant hull by the regression of Inoue and Kijima, prime values about midship.

    Parameters
    ----------
    length, beam, draught : float    L, B, mean T [m]
    block : float                    C_B, 0 to 1 [1]
    trim : float                     T aft less T fore [m]

    Returns
    -------
    dict    "Y_v", "Y_r", "N_v", "N_r" and the nonlinear "Y_v|v|", "Y_r|r|", "Y_rvv", "Y_vrr" and N alike: SNAME prime
            values (over L^2) [1], hydrodynamic only (no rigid-body -m U in Y_r)

    Raises
    ------
    InputError    a length that is not positive, a block coefficient outside (0, 1], a trim of more than the draught

    Notes
    -----
    With k = 2 T/L, over L T: Y_v = -(pi k/2 + 1.4 C_B B/L), N_v = -k, N_r = -(0.54 k - k^2) and their trim factors from
    [Inoue81]; Y_r = m' - 1.5 C_B B/L (its m_x' is on the left there) and the nonlinear terms, given for drift angle and
    even keel, from [Kijima90]; beta = -v, so terms odd in v change sign.
    Source: [Inoue81] linear, [Kijima90] Y_r and nonlinear; of N_vrr two readings are about, C_B T/B is used.
    Valid: merchant hulls in deep water; single ships lie tens of per cent off (Y_r of the S-175 by 9 %, N_v of the
    Mariner by 63 %).

    Examples
    --------
    >>> derivatives = inoue_derivatives(175.0, 25.40, 8.50, 0.5617)
    >>> round(derivatives["Y_v"], 5), round(derivatives["N_r"], 5)     # measured: -0.0116, -0.00222
    (-0.01296, -0.00209)
    """
    for name, size in {"length": length, "beam": beam, "draught": draught}.items():
        if not (size > 0 and np.isfinite(size)):
            raise InputError(f"{name} {size:g} m must be a positive number of metres")
    if not 0 < block <= BLOCK[1]:
        raise InputError(
            f"block coefficient {block:g} must lie between 0 and 1 (volume over L B T), or {BLOCK[1]:g} with what stands out"
        )
    if not abs(trim) <= draught:
        raise InputError(f"trim {trim:g} m must be a number of metres, smaller than the draught {draught:g} m")
    linear, nonlinear = _linear(length, beam, draught, block, trim / draught), _nonlinear(length, beam, draught, block)
    return {name: float(value * draught / length) for name, value in (linear | nonlinear).items()}


def _linear(length: float, beam: float, draught: float, block: float, tau: float) -> dict[str, float]:
    """Linear derivatives over L T; tau = trim over mean draught."""
    k, full = 2 * draught / length, block * beam / length
    y_v, n_v = -(np.pi / 2 * k + 1.4 * full), -k
    return {
        "Y_v": y_v * (1 + 2 / 3 * tau),
        "Y_r": (2 * full - 1.5 * full) * (1 + 0.8 * tau),  # m' = 2 C_B B/L over L T
        "N_v": n_v * (1 - 0.27 * tau * y_v / n_v),
        "N_r": -(0.54 * k - k**2) * (1 + 0.30 * tau),
    }


def _nonlinear(length: float, beam: float, draught: float, block: float) -> dict[str, float]:
    """Nonlinear derivatives over L T."""
    full, fine, deep = block * beam / length, (1 - block) * draught / beam, block * draught / beam
    return {
        "Y_v|v|": -(2.5 * fine + 0.5),
        "Y_r|r|": 0.343 * deep - 0.07,
        "Y_rvv": 1.5 * deep - 0.65,
        "Y_vrr": -5.95 * fine,
        "N_v|v|": 0.96 * fine - 0.066,
        "N_r|r|": 0.5 * full - 0.09,
        "N_rvv": -(57.5 * full**2 - 18.4 * full + 1.6),
        "N_vrr": 0.5 * deep - 0.05,
    }

"""Roll damping beyond waves and lift: a fraction of the critical damping at the natural roll frequency."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from quartering.conventions import InputError


def natural_roll_frequency(stiffness: float, inertia: float, added_inertia: Callable[[float], float]) -> float:
    """Frequency n2 of small free roll, with the added inertia taken at that same frequency.

    Parameters
    ----------
    stiffness : float           rho g V GM [N m]
    inertia : float             m k_xx^2 [kg m2]
    added_inertia : callable    a44 about G [kg m2] of the frequency [rad/s]

    Returns
    -------
    float    n2, the root of n2^2 (I_x + a44(n2)) = rho g V GM [rad/s]

    Raises
    ------
    InputError    stiffness or inertia not positive: the ship has no upright roll frequency

    Notes
    -----
    Source: [H71] equation (8) for small motion of roll alone.  Valid: small angles, sway and yaw left out.

    Examples
    --------
    >>> natural_roll_frequency(4.0, 0.5, lambda frequency: 0.5)
    2.0
    """
    if not (stiffness > 0 and inertia > 0 and np.isfinite(stiffness) and np.isfinite(inertia)):
        raise InputError(
            f"roll stiffness {stiffness:g} N m and inertia {inertia:g} kg m2 must be positive; check GM and k_xx"
        )

    def excess(frequency: float) -> float:
        return frequency**2 * (inertia + added_inertia(frequency)) / stiffness - 1

    upper = float(np.sqrt(stiffness / inertia))
    if excess(upper) <= 0:  # no added inertia at all
        return upper
    return float(brentq(excess, 0.0, upper, xtol=1e-14 * upper, rtol=1e-14))


def fraction_of_critical(fraction: float, frequency: float, inertia: float) -> float:
    """Linear roll damping that is a given fraction of the critical damping.

    Parameters
    ----------
    fraction : float     zeta, >= 0; 0.05 is common for a ship with bilge keels [1]
    frequency : float    natural roll frequency n2 [rad/s]
    inertia : float      I_x + a44(n2) [kg m2]

    Returns
    -------
    float    contribution to K_p, <= 0 [kg m2/s]

    Raises
    ------
    InputError    a fraction that is negative or not a number

    Notes
    -----
    K_p = -2 zeta n2 (I_x + a44).  Source: [Himeno81], equivalent linear damping.  Valid: at the amplitude zeta is for.

    Examples
    --------
    >>> fraction_of_critical(0.05, 0.5, 1000.0)
    -50.0
    """
    if not (fraction >= 0 and np.isfinite(fraction)):
        raise InputError(f"roll damping {fraction:g} of critical must be a number >= 0; 0.05 is a common value")
    return -2 * fraction * frequency * inertia

"""Roll damping beyond waves and lift: a fraction of the critical damping at the natural roll frequency."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from quartering.conventions import InputError


def natural_roll_frequency(stiffness: float, inertia: Callable[[float], float], highest: float) -> float:
    """Frequency n2 of small free roll, with the inertia of the water taken at that same frequency.

    Parameters
    ----------
    stiffness : float           rho g V GM [N m]
    inertia : callable          inertia felt in roll [kg m2] of the frequency [rad/s]: 1/(M^-1)_22, sway and yaw free
    highest : float             upper bound of the root [rad/s]

    Returns
    -------
    float    n2, the root of n2^2 I(n2) = rho g V GM [rad/s]

    Raises
    ------
    InputError    stiffness not positive, or no root below the bound: the ship has no upright roll frequency

    Notes
    -----
    Source: [H71] equations (3) and (8): the omega_2 of small motion.  Valid: small angles, no damping.

    Examples
    --------
    >>> round(natural_roll_frequency(4.0, lambda frequency: 1.0, 10.0), 12)
    2.0
    """
    if not (stiffness > 0 and np.isfinite(stiffness)):
        raise InputError(f"roll stiffness {stiffness:g} N m must be positive; check GM")

    def excess(frequency: float) -> float:
        return frequency**2 * inertia(frequency) / stiffness - 1

    if not excess(highest) > 0:
        raise InputError(f"no natural roll frequency below {highest:g} rad/s; check the radius of gyration in roll")
    return float(brentq(excess, 0.0, highest, xtol=1e-14 * highest, rtol=1e-14))


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

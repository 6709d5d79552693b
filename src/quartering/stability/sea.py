"""First-order stability of the motion in a sea: the averages over the wave become covariances."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.hull.autopilot import Autopilot
from quartering.motion.equations.steering import state_matrix, steered
from quartering.motion.equations.system import Floats
from quartering.stability.course import course_matrix, course_rates
from quartering.stability.first_order import roll_mode

Complex = NDArray[np.complex128]
_VELOCITIES = [0, 2, 3]


class SeaStability(NamedTuple):
    """First-order stability of a motion in a sea.

    Parameters
    ----------
    n2 : float           roll frequency about the motion [rad/s]; NaN where the mean stiffness does not right the ship
    k2 : float           index K2 [1/s2], negative is stable
    slow : (2,) float    growth rates of the slow sway-yaw modes, the larger first [1/s]; with an autopilot three or four
    exponents : (s,)     eigenvalues of the mean Jacobian, the largest real part first, complex [1/s]
    """

    n2: float
    k2: float
    slow: Floats
    exponents: Complex


def sea_stability(inertia: Floats, slopes: Floats, rudder: Floats, autopilot: Autopilot | None) -> SeaStability:
    """Stability of a motion in a sea by the mean slopes of all forces over it.

    inertia (3, 3): at the frequency of roll [kg, kg m, kg m2]
    slopes (3, 4): E[d force/d(v, phi, p, r)] [N, N m]
    rudder (3,): forces per radian of rudder

    For a Gaussian motion the gains of the response are those slopes, so one matrix J has both: its eigenvalues are the growth
    rates to first order, and K2 = n2 sum_j rho_j <d p'/d V_j> as in a regular wave, covariances in place of the averages.
    Second order adds growth by the noise in the stiffness, which is not counted.
    Source: [H71] eqs. (8)-(13), [Kazakov54].

    >>> slopes = np.array([[-1.0, 0, 0, 0], [0, -4.0, -0.2, 0], [0, 0, 0, -1.0]])
    >>> found = sea_stability(np.eye(3), slopes, np.zeros(3), None)
    >>> round(found.n2, 6), round(found.k2, 6), found.slow.tolist()
    (2.0, -0.4, [-1.0, -1.0])
    """
    rows: Floats = np.linalg.solve(inertia, slopes)[None].astype(float)
    push: Floats = np.linalg.solve(inertia, rudder)[None].astype(float)
    linear = rows if autopilot is None else steered(rows, push, autopilot)
    values = np.linalg.eigvals(state_matrix(rows, linear)[0]).astype(complex)
    values = values[np.argsort(-values.real, kind="stable")]
    if not rows[0, 1, 1] < 0:
        return SeaStability(np.nan, np.nan, np.full(max(2, linear.shape[2] - 2), np.nan), values)
    n2, rho, rate = roll_mode(rows, linear)
    slow = course_rates(course_matrix(rows[:, :, _VELOCITIES], rho, linear))[0]
    return SeaStability(float(n2[0]), float(2.0 * n2[0] * rate[0]), slow, values)

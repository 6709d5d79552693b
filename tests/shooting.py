"""Periodic motions of one roll equation by shooting: an integrator and a Newton method this library has no part in."""

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp


def shoot(
    restoring: Callable[[float], tuple[float, float]],
    damping: float,
    force: float,
    frequency: float,
    guess: np.ndarray,
    periods: float = 1,
) -> tuple[np.ndarray, np.ndarray]:
    """Start (angle, rate) and multipliers of a periodic motion of x'' + damping x' + r(x) = force sin(frequency t).

    `restoring` gives r(x) and dr/dx. With `periods` 0.5 the motion is one that reverses after half a period, and the
    multipliers are those of that half. Dormand-Prince of order 8, relative tolerance 1e-12; the multipliers are those of the
    variational equations integrated beside the motion.
    """

    def slope(t, y):
        r, stiffness = restoring(y[0])
        phi = y[2:].reshape(2, 2)
        turned = np.array([phi[1], -stiffness * phi[0] - damping * phi[1]])
        return np.concatenate([[y[1], force * np.sin(frequency * t) - damping * y[1] - r], turned.ravel()])

    start = np.array(guess, dtype=float)
    duration = 2 * np.pi * periods / frequency
    sign = -1.0 if periods == 0.5 else 1.0
    for _ in range(12):
        y = np.concatenate([start, np.eye(2).ravel()])
        end = solve_ivp(slope, (0.0, duration), y, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
        monodromy = end[2:].reshape(2, 2)
        step = np.linalg.solve(monodromy - sign * np.eye(2), sign * start - end[:2])
        start = start + step
        if np.abs(step).max() < 1e-11:
            return start, np.linalg.eigvals(monodromy)
    raise AssertionError("shooting did not converge")

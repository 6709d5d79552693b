"""The equation of a free decay, integrated at the times of a record.

phi'' + 2 zeta w0 phi' + d |phi'| phi' + c phi'^3 + w0^2 phi + k3 phi^3 = 0
"""

from __future__ import annotations

import numpy as np

from quartering._machine.compiled import inner, kernel
from quartering.hull.lines.section import Floats


@inner
def _acceleration(x: float, v: float, c1: float, c2: float, c3: float, k1: float, k3: float) -> float:
    return -(c1 + c2 * abs(v) + c3 * v * v) * v - (k1 + k3 * x * x) * x


@kernel
def _integrate(t: Floats, x: float, v: float, c1: float, c2: float, c3: float, k1: float, k3: float) -> Floats:
    out = np.empty(t.size)
    out[0] = x
    step = 0.1 / np.sqrt(k1)
    for n in range(1, t.size):
        span = t[n] - t[n - 1]
        count = int(np.ceil(span / step))
        h = span / count
        for _ in range(count):
            a1 = _acceleration(x, v, c1, c2, c3, k1, k3)
            v2 = v + 0.5 * h * a1
            a2 = _acceleration(x + 0.5 * h * v, v2, c1, c2, c3, k1, k3)
            v3 = v + 0.5 * h * a2
            a3 = _acceleration(x + 0.5 * h * v2, v3, c1, c2, c3, k1, k3)
            v4 = v + h * a3
            a4 = _acceleration(x + h * v3, v4, c1, c2, c3, k1, k3)
            x += h / 6 * (v + 2 * v2 + 2 * v3 + v4)
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            if not abs(x) < 1e3:
                out[n:] = 1e3
                return out
        out[n] = x
    return out


def free_decay(
    time: Floats,
    start: tuple[float, float],
    frequency: float,
    damping_ratio: float,
    *,
    quadratic: float = 0.0,
    cubic: float = 0.0,
    restoring_cubic: float = 0.0,
) -> Floats:
    """Angle of a free decay at given times.

    time (t,): ascending [s]
    start: angle [rad] and rate [rad/s] at the first time
    frequency: w0 > 0 [rad/s]
    damping_ratio: zeta [1]
    quadratic: d, of |phi'| phi' [1/rad]
    cubic: c, of phi'^3 [s/rad2]
    restoring_cubic: k3, of phi^3 [1/(s rad)2]
    Returns (t,): [rad]; 1000 from where it runs away

    Runge-Kutta of fourth order in steps of at most 0.1/w0: good to about 1e-6 of the first amplitude over ten cycles.
    Source: [Himeno81] equation (2.1).
    """
    x, v = start
    damping = (2 * damping_ratio * frequency, quadratic, cubic)
    return np.asarray(_integrate(np.asarray(time, dtype=float), x, v, *damping, frequency**2, restoring_cubic))

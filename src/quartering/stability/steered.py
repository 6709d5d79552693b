"""State transition matrices of a ship with an autopilot: five or six state variables instead of four."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np

from quartering.compiled import kernel
from quartering.motion.equations import Floats, System
from quartering.stability.variation import jacobian_at
from quartering.threads import in_threads


@kernel
def _slope(matrix, linear, phi, out):
    """Derivative of phi (s, s): rows v', p', r' from ``matrix`` (3, 4), all else constant."""
    states = phi.shape[0]
    for c in range(states):
        out[1, c] = phi[2, c]
        out[4, c] = phi[3, c]
        for k in range(3):
            row = 0 if k == 0 else k + 1
            total = 0.0
            for s in range(states):
                total += (matrix[k, s] if s < 4 else linear[k, s]) * phi[s, c]
            out[row, c] = total
        if states > 5:
            out[5, c] = linear[3, 3] * phi[3, c] + linear[3, 4] * phi[4, c] + linear[3, 5] * phi[5, c]


@kernel
def _march(first, last, linear, coefficients, powers, modulus, frequency, orders, u, span, steps, transition):
    """Fourth-order Runge-Kutta solution (n, s, s) of the variational equations over ``span`` cycles."""
    states = linear.shape[2]
    scratch = (np.empty((4, 8)), np.empty(4), np.empty(3))
    rows = np.empty((3, 3, 4))
    phi, stage, k = np.empty((states, states)), np.empty((states, states)), np.empty((4, states, states))
    for i in range(first, last):
        system = (linear[i], coefficients[i], powers, modulus, frequency[i])
        h = 2.0 * np.pi * span / (frequency[i] * steps[i])
        half_angle = np.pi * span / steps[i]
        for a in range(states):
            for b in range(states):
                phi[a, b] = 1.0 if a == b else 0.0
        for n in range(steps[i]):
            for m in range(3):
                angle = (2 * n + m) * half_angle
                jacobian_at(system, orders, u[i], np.cos(angle), np.sin(angle), scratch, rows[m])
            for j in range(4):
                ahead = 0.0 if j == 0 else 0.5 * h if j < 3 else h
                for a in range(states):
                    for b in range(states):
                        stage[a, b] = phi[a, b] + (ahead * k[j - 1, a, b] if j > 0 else 0.0)
                _slope(rows[(j + 1) // 2], linear[i], stage, k[j])
            for a in range(states):
                for b in range(states):
                    phi[a, b] += h / 6.0 * (k[0, a, b] + 2.0 * k[1, a, b] + 2.0 * k[2, a, b] + k[3, a, b])
        for a in range(states):
            for b in range(states):
                transition[i, a, b] = phi[a, b]


def steered_transitions(system: System, u: Floats, orders: tuple[int, ...], span: float, steps: np.ndarray) -> Floats:
    """State transition matrices of the variational equations with an autopilot, from phase zero over part of a cycle.

    Parameters
    ----------
    system, u, orders, span, steps    as in `transition_matrices`; a mean heading in ``u`` taken out (`turning`)

    Returns
    -------
    (n, s, s) float           state order (v, phi, p, r, psi) or (v, phi, p, r, psi, delta)

    Notes
    -----
    Fourth-order Runge-Kutta.  Source: [H71] eq. (8), as a first-order system, with the autopilot's linear terms.

    Examples
    --------
    >>> from quartering.hull.autopilot import Autopilot
    >>> from quartering.motion.equations import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "N_r": -1.0, "N_delta": 1.0}
    >>> model = Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, 0, 0), autopilot=Autopilot(gain=0.0))
    >>> phi = steered_transitions(model.system, np.zeros((1, 3, 2)), (1,), 1.0, np.array([200]))[0]
    >>> bool(np.isclose(phi[3, 3], np.exp(-2 * np.pi))), float(phi[4, 4])
    (True, 1.0)
    """
    transition = np.empty((system.count, system.states, system.states))
    in_threads(
        _march, system.count, *system.kernel_arrays()[:4], system.frequency, np.array(orders, dtype=np.int64), u,
        span, steps.astype(np.int64), transition,
    )  # fmt: skip
    return transition

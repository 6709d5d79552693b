"""Autopilot states: linear terms in heading and rudder angle added to (v, phi, p, r).

The linear part grows a column for the heading psi, and with a lag of the steering gear a row and a column for the rudder
angle delta. The nonlinear products are those of (v, phi, p, r) as before.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner
from quartering.hull.autopilot import Autopilot

Floats = NDArray[np.float64]

HEADING, RUDDER = 4, 5
"""Columns of the heading and the rudder angle in the linear part, and their place in the state."""


def steered(linear: Floats, push: Floats, autopilot: Autopilot) -> Floats:
    """Linear part of the equations of a ship with an autopilot.

    linear (n, 3, 4): without one: rows sway, roll, yaw; columns v, phi, p, r
    push (n, 3): accelerations per radian of rudder
    Returns (n, 3, 5): a column psi added; with a lag (n, 4, 6): columns psi and delta, and the rudder's own equation as
        a row

    delta = -gain psi - rate_gain r, or lag d delta/dt = -gain psi - rate_gain r - delta.  Source: [Lewis89] ch. IX.
    """
    if autopilot.lag == 0.0:
        out = np.concatenate([linear, -autopilot.gain * push[:, :, None]], axis=2)
        out[:, :, 3] -= autopilot.rate_gain * push
        return np.asarray(out)
    out = np.zeros((linear.shape[0], 4, 6))
    out[:, :3, :4] = linear
    out[:, :3, RUDDER] = push
    out[:, 3, 3:] = np.array([-autopilot.rate_gain, -autopilot.gain, -1.0]) / autopilot.lag
    return out


def state_matrix(rows: NDArray[Any], linear: Floats) -> Any:
    """Matrices of the whole state from rows of derivatives by (v, phi, p, r).

    rows (n, 3, 4): d(v', p', r')/d(v, phi, p, r), real or complex
    linear (n, 3 or 4, s): linear part, for the heading and rudder columns
    Returns (n, s, s): rows v', phi', p', r' and, with an autopilot, psi' and delta'

    Source: [H71] eq. (8) as a first-order system; the heading and rudder rows by definition (`Autopilot`).
    """
    states = linear.shape[2]
    matrix = np.zeros((len(rows), states, states), dtype=rows.dtype)
    matrix[:, [0, 2, 3], :4] = rows
    matrix[:, [0, 2, 3], 4:] = linear[:, :3, 4:]
    matrix[:, 1, 2] = 1.0
    if states > HEADING:
        matrix[:, HEADING, 3] = 1.0
    if states > RUDDER:
        matrix[:, RUDDER] = linear[:, 3]
    return matrix


def holds_heading(linear: Floats) -> NDArray[np.bool_]:
    """Does the heading act back on the ship? Not without an autopilot, without gain, or without way on.

    linear (n, 3 or 4, s)
    Returns (n,)

    Source: closed form, from the columns `steered` adds.

    >>> steering = Autopilot(gain=1.0)
    >>> holds_heading(steered(np.zeros((1, 3, 4)), np.array([[0.0, 0.0, 2.0]]), steering)).tolist()
    [True]
    """
    if linear.shape[2] <= HEADING:
        return np.zeros(len(linear), dtype=bool)
    at_once = (linear[:, :3, HEADING] != 0).any(axis=1)
    if linear.shape[2] <= RUDDER:
        return np.asarray(at_once)
    return np.asarray((linear[:, 3, HEADING] != 0) & (linear[:, :3, RUDDER] != 0).any(axis=1))


def turning(linear: Floats, u: Floats, orders: tuple[int, ...]) -> Floats:
    """Motions with zero in place of the mean heading, where the mean's column of yaw holds one: the true mean rate of turn.

    linear (n, 3 or 4, s)
    u (n, 3, b): motions, as from `harmonic_balance`
    orders: their harmonics
    Returns (n, 3, b): the same array where there is nothing to change

    Source: closed form: a heading that is held turns at no mean rate.
    """
    if orders[0] > 0:
        return u
    held = holds_heading(linear)
    if not held.any():
        return u
    out = u.copy()
    out[held, 2, 0] = 0.0
    return out


def feedback(linear: Floats, frequency: Floats) -> NDArray[np.complex128]:
    """Accelerations per unit phasor of the heading that an autopilot answers with, the rate of turn's own column apart.

    linear (n, 3 or 4, s)
    frequency (n,): [1/s]
    Returns (n, 3): sway, roll, yaw; zero without an autopilot

    Source: closed form, the rudder of `Autopilot` at one frequency; with a lag delta = (order)/(1 + i w T).

    >>> at_once = steered(np.zeros((1, 3, 4)), np.array([[0.0, 0.0, 2.0]]), Autopilot(gain=1.0, rate_gain=5.0))
    >>> feedback(at_once, np.array([0.5]))[0].real.tolist()[2]
    -2.0
    """
    if linear.shape[2] <= HEADING:
        return np.zeros((len(linear), 3), dtype=complex)
    if linear.shape[2] <= RUDDER:
        return linear[:, :3, HEADING].astype(complex)
    angle = (linear[:, 3, 4] + 1j * frequency * linear[:, 3, 3]) / (1j * frequency - linear[:, 3, 5])
    return np.asarray(linear[:, :3, RUDDER] * angle[:, None])


@inner
def mean_is_heading(linear, factors):
    """Does the mean's column of yaw hold the mean heading, in place of a mean rate of turn?

    With the heading held, a steady moment leaves a steady heading error and no turning.
    Source: closed form; `holds_heading` for one condition.
    """
    if factors[0] > 0.0 or linear.shape[1] <= 4:
        return False
    for k in range(3):
        if linear[k, 4] != 0.0:
            return True
        if linear.shape[1] > 5 and linear[k, 5] * linear[3, 4] != 0.0:
            return True
    return False


@inner
def add_steering(linear, factors, w, u, residual, matrix):
    """Take what the autopilot answers to the yaw of the motion ``u`` (3, b) off the balance and, if wanted, its derivative.

    Linear: each harmonic of the rudder follows from the same harmonic of the heading.  Source: closed form (`feedback`).
    """
    nb = u.shape[1]
    lagging = linear.shape[1] > 5
    with_matrix = matrix.shape[0] > 0
    held = mean_is_heading(linear, factors)
    b = 0
    while b < nb:
        hw = factors[b] * w
        for k in range(3):
            real, imaginary = linear[k, 4], 0.0
            if lagging:
                rate, angle, decay = linear[3, 3], linear[3, 4], -linear[3, 5]
                if factors[b] > 0.0:
                    size = linear[k, 5] / (decay**2 + hw**2)
                    real = size * (angle * decay + hw**2 * rate)
                    imaginary = size * hw * (rate * decay - angle)
                else:
                    real = linear[k, 5] * (angle if held else rate) / decay
            if factors[b] > 0.0:
                residual[k * nb + b] -= real * u[2, b] + imaginary * u[2, b + 1]
                residual[k * nb + b + 1] -= real * u[2, b + 1] - imaginary * u[2, b]
                if with_matrix:
                    matrix[k * nb + b, 2 * nb + b] -= real
                    matrix[k * nb + b, 2 * nb + b + 1] -= imaginary
                    matrix[k * nb + b + 1, 2 * nb + b] += imaginary
                    matrix[k * nb + b + 1, 2 * nb + b + 1] -= real
            else:
                residual[k * nb + b] -= real * u[2, b]
                if with_matrix:
                    matrix[k * nb + b, 2 * nb + b] -= real
        b += 2 if factors[b] > 0.0 else 1

"""The equations of a row of conditions at once: every operation is done for all of them before the next.

The arrays hold the condition in their last axis, so that a processor's vector units work on several at a time. Nothing a
condition does depends on its neighbours in the row.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np

from quartering.compiled import abreast
from quartering.motion.terms import KNOT, KNOT_CODE

WIDTH = 64
"""Conditions abreast: enough that beginning a loop over them costs little, few enough to stay near the processor."""


@abreast
def rows_abreast(powers, nb):
    """Empty rows abreast: a system's numbers, and what one evaluation of its products needs.

    Notes
    -----
    Source: none needed; memory only.
    """
    own = (np.zeros((3, 4, WIDTH)), np.zeros((3, powers.shape[0], WIDTH)),
           np.zeros((3, WIDTH)), np.zeros((3, WIDTH)), np.zeros((3, WIDTH)), np.zeros(WIDTH))  # fmt: skip
    room = (np.zeros((4, WIDTH)), np.zeros((4, 8, WIDTH)), np.zeros((3, WIDTH)), np.zeros((3, 4, WIDTH)),
            np.zeros((3, 3, nb, WIDTH)))  # fmt: skip
    degrees = np.zeros(4, np.int64)
    for t in range(powers.shape[0]):
        for s in range(4):
            degrees[s] = max(degrees[s], powers[t, s])
    return own, room, degrees


@abreast
def gather(begin, last, source, system):
    """Copy the conditions from ``begin`` on into rows abreast; the last block is filled up with its last condition.

    Notes
    -----
    Source: none needed; a change of order in memory.
    """
    linear, coefficients, _, _, mean, cos, sin, frequency = source
    lin, coef, _, _, f0, fc, fs, w = system
    for l in range(WIDTH):
        i = min(begin + l, last - 1)
        w[l] = frequency[i]
        for k in range(3):
            f0[k, l], fc[k, l], fs[k, l] = mean[i, k], cos[i, k], sin[i, k]
            for s in range(4):
                lin[k, s, l] = linear[i, k, s]
            for t in range(coef.shape[1]):
                coef[k, t, l] = coefficients[i, k, t]


@abreast
def gather_motions(begin, last, u, row):
    """Copy the motions (n, 3, b) from ``begin`` on into a row (3, b, W) abreast.

    Notes
    -----
    Source: none needed; a change of order in memory.
    """
    for l in range(WIDTH):
        i = min(begin + l, last - 1)
        for k in range(3):
            for b in range(row.shape[1]):
                row[k, b, l] = u[i, k, b]


@abreast
def states(tables, n, u, w, state):
    """States (4, W) at sample ``n`` of the motions ``u`` (3, b, W).

    Notes
    -----
    Source: [H71] eq. (A-3), for any set of harmonics; the mean's column holds mean sway and yaw velocity, mean heel.
    """
    values, rates, factors, _ = tables
    for s in range(4):
        for l in range(WIDTH):
            state[s, l] = 0.0
    for b in range(values.shape[0]):
        value, rate = values[b, n], rates[b, n]
        if factors[b] > 0.0:
            for l in range(WIDTH):
                velocity = rate * w[l]
                state[0, l] += u[0, b, l] * velocity
                state[1, l] += u[1, b, l] * value
                state[2, l] += u[1, b, l] * velocity
                state[3, l] += u[2, b, l] * velocity
        else:
            for l in range(WIDTH):
                state[0, l] += u[0, b, l]
                state[1, l] += u[1, b, l]
                state[3, l] += u[2, b, l]


@abreast
def raise_powers(state, degrees, table):
    """table (4, 8, W): powers of each state up to its highest.

    Notes
    -----
    Source: closed form.
    """
    for s in range(4):
        for l in range(WIDTH):
            table[s, 0, l] = 1.0
        for d in range(1, degrees[s] + 1):
            for l in range(WIDTH):
                table[s, d, l] = table[s, d - 1, l] * state[s, l]


@abreast
def forces(linear, coefficients, powers, modulus, state, table, force):
    """Right-hand sides (3, W) without excitation, from the powers of the states.

    Notes
    -----
    Source: [H71] eq. (3).
    """
    for k in range(3):
        for l in range(WIDTH):
            first = linear[k, 0, l] * state[0, l] + linear[k, 1, l] * state[1, l]
            force[k, l] = first + linear[k, 2, l] * state[2, l] + linear[k, 3, l] * state[3, l]
    for t in range(powers.shape[0]):
        a, b, c, d = powers[t, 0], powers[t, 1], powers[t, 2], powers[t, 3]
        bars = modulus[t]
        if bars > KNOT_CODE:
            knot = (bars - KNOT_CODE) * KNOT
            for l in range(WIDTH):
                beyond = max(abs(state[1, l]) - knot, 0.0)
                product = beyond * beyond * (beyond if state[1, l] > 0.0 else -beyond)
                force[0, l] += coefficients[0, t, l] * product
                force[1, l] += coefficients[1, t, l] * product
                force[2, l] += coefficients[2, t, l] * product
            continue
        for l in range(WIDTH):
            product = table[0, a, l] * table[1, b, l] * (table[2, c, l] * table[3, d, l])
            if bars > 0:
                product *= abs(state[bars - 1, l])
            force[0, l] += coefficients[0, t, l] * product
            force[1, l] += coefficients[1, t, l] * product
            force[2, l] += coefficients[2, t, l] * product


@abreast
def slopes(linear, coefficients, powers, modulus, state, table, jacobian):
    """Derivatives (3, 4, W) of the right-hand sides by the state, from the powers of the states.

    Notes
    -----
    Source: [H71] eq. (8).
    """
    for k in range(3):
        for s in range(4):
            for l in range(WIDTH):
                jacobian[k, s, l] = linear[k, s, l]
    for t in range(powers.shape[0]):
        bars = modulus[t]
        if bars > KNOT_CODE:
            knot = (bars - KNOT_CODE) * KNOT
            for l in range(WIDTH):
                beyond = max(abs(state[1, l]) - knot, 0.0)
                slope = 3.0 * beyond * beyond
                jacobian[0, 1, l] += coefficients[0, t, l] * slope
                jacobian[1, 1, l] += coefficients[1, t, l] * slope
                jacobian[2, 1, l] += coefficients[2, t, l] * slope
            continue
        for s in range(4):
            lowered = powers[t, s]
            if lowered == 0 and bars != s + 1:
                continue
            a = powers[t, 0] - (1 if s == 0 and lowered > 0 else 0)
            b = powers[t, 1] - (1 if s == 1 and lowered > 0 else 0)
            c = powers[t, 2] - (1 if s == 2 and lowered > 0 else 0)
            d = powers[t, 3] - (1 if s == 3 and lowered > 0 else 0)
            # x^n |x| has the slope (n + 1) x^(n-1) |x| for n > 0, and sign(x) for n = 0
            factor = float(lowered + (1 if bars == s + 1 and lowered > 0 else 0))
            for l in range(WIDTH):
                slope = (table[0, a, l] * table[1, b, l]) * (table[2, c, l] * table[3, d, l])
                if bars > 0 and lowered > 0:
                    slope *= factor * abs(state[bars - 1, l])
                elif bars > 0:
                    slope *= 1.0 if state[s, l] >= 0.0 else -1.0
                else:
                    slope *= factor
                jacobian[0, s, l] += coefficients[0, t, l] * slope
                jacobian[1, s, l] += coefficients[1, t, l] * slope
                jacobian[2, s, l] += coefficients[2, t, l] * slope


@abreast
def linear_response(linear, l, w, x, y, z, answer):
    """Phasors of sway, roll, yaw under accelerations (x, y, z) at frequency ``w`` without the products; Cramer's rule.

    Notes
    -----
    ``answer`` is what an autopilot does to (sway, roll, yaw) per unit of yaw, as `steering.feedback`.
    Source: [H71] eq. (3), linear part.
    """
    e, s = 1j * w, -w * w
    a, b, c = s - e * linear[0, 0, l], -linear[0, 1, l] - e * linear[0, 2, l], -e * linear[0, 3, l] - answer[0]
    d, f, g = -e * linear[1, 0, l], s - linear[1, 1, l] - e * linear[1, 2, l], -e * linear[1, 3, l] - answer[1]
    h, i, j = -e * linear[2, 0, l], -linear[2, 1, l] - e * linear[2, 2, l], s - e * linear[2, 3, l] - answer[2]
    p, q, r = f * j - g * i, d * j - g * h, d * i - f * h
    det = a * p - b * q + c * r
    if det == 0.0:  # an undamped resonance; a complex division by zero would stop the whole batch
        det = complex(np.nan, np.nan)
    sway = (x * p - b * (y * j - g * z) + c * (y * i - f * z)) / det
    roll = (a * (y * j - g * z) - x * q + c * (d * z - y * h)) / det
    yaw = (a * (f * z - y * i) - b * (d * z - y * h) + x * r) / det
    return sway, roll, yaw


@abreast
def steady_response(linear, l, x, y, z):
    """Mean sway velocity, heel and yaw rate under steady accelerations (x, y, z), and the sign of their determinant.

    Notes
    -----
    Source: [H71] eq. (3), linear part; Cramer's rule.
    """
    a, b, c = -linear[0, 0, l], -linear[0, 1, l], -linear[0, 3, l]
    d, f, g = -linear[1, 0, l], -linear[1, 1, l], -linear[1, 3, l]
    h, i, j = -linear[2, 0, l], -linear[2, 1, l], -linear[2, 3, l]
    p, q, r = f * j - g * i, d * j - g * h, d * i - f * h
    det = a * p - b * q + c * r
    sway = (x * p - b * (y * j - g * z) + c * (y * i - f * z)) / det
    heel = (a * (y * j - g * z) - x * q + c * (d * z - y * h)) / det
    yaw = (a * (f * z - y * i) - b * (d * z - y * h) + x * r) / det
    return sway, heel, yaw, 1.0 if det > 0.0 else -1.0

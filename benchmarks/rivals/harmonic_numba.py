"""Rival: harmonic balance of the cubic system alone, in plain numba, every product and derivative written out.

One condition after another in one compiled loop: Newton's method with the exact matrix at each step, elimination written out
for the small matrix, the Floquet matrix by classical Runge-Kutta steps along the motion, all sines from tables made once. With
``odd`` it knows that such a system keeps odd harmonics alone: 12 unknowns for 21, half a cycle for a whole one.
"""

import numpy as np
from numba import njit, prange

from rivals.balance_numba import eliminate, harmonics, tables_of


@njit(inline="always", fastmath=True)
def _rates(v, phi, p, r, a, d, g):
    m0, m1, m2, m3, m4 = v * v * v, p * p * p, r * r * r, v * p * p, v * r * r
    m5, m6, m7, m8, m9 = p * v * v, p * r * r, r * v * v, r * p * p, v * p * r
    x = -a[0, 0] * v - a[0, 1] * p - a[0, 2] * r
    x += d[0, 0] * m0 + d[0, 1] * m1 + d[0, 2] * m2 + d[0, 3] * m3 + d[0, 4] * m4
    x += d[0, 5] * m5 + d[0, 6] * m6 + d[0, 7] * m7 + d[0, 8] * m8 + d[0, 9] * m9
    y = -a[1, 0] * v - a[1, 1] * p - a[1, 2] * r - phi + g * phi * phi * phi
    y += d[1, 0] * m0 + d[1, 1] * m1 + d[1, 2] * m2 + d[1, 3] * m3 + d[1, 4] * m4
    y += d[1, 5] * m5 + d[1, 6] * m6 + d[1, 7] * m7 + d[1, 8] * m8 + d[1, 9] * m9
    z = -a[2, 0] * v - a[2, 1] * p - a[2, 2] * r
    z += d[2, 0] * m0 + d[2, 1] * m1 + d[2, 2] * m2 + d[2, 3] * m3 + d[2, 4] * m4
    z += d[2, 5] * m5 + d[2, 6] * m6 + d[2, 7] * m7 + d[2, 8] * m8 + d[2, 9] * m9
    return x, y, z


@njit(inline="always", fastmath=True)
def _slopes(v, phi, p, r, a, d, g, j):
    vv, pp, rr, vp, vr, pr = v * v, p * p, r * r, v * p, v * r, p * r
    for k in range(3):
        j[k, 0] = -a[k, 0] + 3.0 * d[k, 0] * vv + d[k, 3] * pp + d[k, 4] * rr
        j[k, 0] += 2.0 * (d[k, 5] * vp + d[k, 7] * vr) + d[k, 9] * pr
        j[k, 1] = 0.0
        j[k, 2] = -a[k, 1] + 3.0 * d[k, 1] * pp + d[k, 5] * vv + d[k, 6] * rr
        j[k, 2] += 2.0 * (d[k, 3] * vp + d[k, 8] * pr) + d[k, 9] * vr
        j[k, 3] = -a[k, 2] + 3.0 * d[k, 2] * rr + d[k, 7] * vv + d[k, 8] * pp
        j[k, 3] += 2.0 * (d[k, 4] * vr + d[k, 6] * pr) + d[k, 9] * vp
    j[1, 1] = -1.0 + 3.0 * g * phi * phi


@njit(inline="always", fastmath=True)
def _slope_of_phi(j, phi, out):
    for c in range(4):
        out[0, c] = j[0, 0] * phi[0, c] + j[0, 2] * phi[2, c] + j[0, 3] * phi[3, c]
        out[1, c] = phi[2, c]
        out[2, c] = j[1, 0] * phi[0, c] + j[1, 1] * phi[1, c] + j[1, 2] * phi[2, c] + j[1, 3] * phi[3, c]
        out[3, c] = j[2, 0] * phi[0, c] + j[2, 2] * phi[2, c] + j[2, 3] * phi[3, c]


@njit(fastmath=True)
def _at(values, rates, n, w, u, state):
    v, phi, p, r = 0.0, 0.0, 0.0, 0.0
    for b in range(values.shape[0]):
        v += u[0, b] * rates[b, n]
        phi += u[1, b] * values[b, n]
        p += u[1, b] * rates[b, n]
        r += u[2, b] * rates[b, n]
    state[0], state[1], state[2], state[3] = v * w, phi, p * w, r * w


@njit(parallel=True, fastmath=True)
def _solve(a, d, g, w, cos, sin, values, rates, factors, weights, along, along_rates, u, mean, floquet):
    nb, samples = values.shape
    size, steps = 3 * nb, along.shape[1] // 2
    first = 1 if factors[0] == 0.0 else 0
    for q in prange(w.size):
        om = w[q]
        x, residual, matrix = np.zeros((3, nb)), np.empty(size), np.empty((size, size))
        j, state, column = np.empty((3, 4)), np.empty(4), np.empty((3, 3, nb))
        for _ in range(30):
            residual[:] = 0.0
            matrix[:, :] = 0.0
            for n in range(samples):
                _at(values, rates, n, om, x, state)
                f0, f1, f2 = _rates(state[0], state[1], state[2], state[3], a, d, g)
                _slopes(state[0], state[1], state[2], state[3], a, d, g, j)
                for b in range(nb):
                    turn = rates[b, n] * om
                    for k in range(3):
                        column[k, 0, b] = j[k, 0] * turn
                        column[k, 1, b] = j[k, 2] * turn + j[k, 1] * values[b, n]
                        column[k, 2, b] = j[k, 3] * turn
                for c in range(nb):
                    project = weights[c] * values[c, n]
                    residual[c] -= project * f0
                    residual[nb + c] -= project * f1
                    residual[2 * nb + c] -= project * f2
                    for k in range(3):
                        for m in range(3):
                            for b in range(nb):
                                matrix[k * nb + c, m * nb + b] -= project * column[k, m, b]
            for k in range(3):
                for b in range(nb):
                    inertia = (factors[b] * om) ** 2
                    residual[k * nb + b] -= inertia * x[k, b]
                    matrix[k * nb + b, k * nb + b] -= inertia
                residual[k * nb + first] -= cos[q, k]
                residual[k * nb + first + 1] -= sin[q, k]
            if first == 1:  # only a mean velocity of sway and yaw means anything, and here it is nil
                for k in range(0, 3, 2):
                    matrix[k * nb, k * nb] += 1.0
            eliminate(matrix, residual)
            largest = 0.0
            for k in range(3):
                for b in range(nb):
                    x[k, b] -= residual[k * nb + b]
                    largest = max(largest, abs(residual[k * nb + b]))
            if largest < 1e-8:  # the next step would be its square
                break
        u[q] = x
        h = (1.0 if first == 1 else 0.5) * 2.0 * np.pi / om / steps
        phi, stage, total, slope = np.eye(4), np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4))
        average = np.zeros((3, 4))
        _at(along, along_rates, 0, om, x, state)
        _slopes(state[0], state[1], state[2], state[3], a, d, g, j)
        for n in range(steps):
            for k in range(3):
                for s in range(4):
                    average[k, s] += j[k, s]
            _slope_of_phi(j, phi, slope)
            for s in range(4):
                for c in range(4):
                    total[s, c] = slope[s, c]
                    stage[s, c] = phi[s, c] + 0.5 * h * slope[s, c]
            _at(along, along_rates, 2 * n + 1, om, x, state)
            _slopes(state[0], state[1], state[2], state[3], a, d, g, j)
            _slope_of_phi(j, stage, slope)
            for s in range(4):
                for c in range(4):
                    total[s, c] += 2.0 * slope[s, c]
                    stage[s, c] = phi[s, c] + 0.5 * h * slope[s, c]
            _slope_of_phi(j, stage, slope)
            for s in range(4):
                for c in range(4):
                    total[s, c] += 2.0 * slope[s, c]
                    stage[s, c] = phi[s, c] + h * slope[s, c]
            _at(along, along_rates, 2 * n + 2, om, x, state)
            _slopes(state[0], state[1], state[2], state[3], a, d, g, j)
            _slope_of_phi(j, stage, slope)
            for s in range(4):
                for c in range(4):
                    phi[s, c] += h / 6.0 * (total[s, c] + slope[s, c])
        mean[q] = average / steps
        floquet[q] = phi


def solved(job, odd, steps):
    """Motions (n, 3, b), mean slopes and Floquet matrices of a `systems.Cubic`; ``steps`` of Runge-Kutta in the span."""
    orders = (1, 3) if odd else (0, 1, 2, 3)
    values, rates, factors, weights, along, along_rates = tables_of(orders, 14 if odd else 16, steps)
    n = job.w.size
    u, mean, floquet = np.empty((n, 3, factors.size)), np.empty((n, 3, 4)), np.empty((n, 4, 4))
    sides = (job.damping, job.products, job.g, job.w, job.cos, job.sin)
    _solve(*sides, values, rates, factors, weights, along, along_rates, u, mean, floquet)
    return u, mean, floquet


def harmonic_balance(job, odd, steps):
    """Amplitudes (n, 3), multipliers (n, 4), K2 and S."""
    return harmonics(*solved(job, odd, steps), odd)


def motion(job, i):
    """State at time 0 of the motion of condition i."""
    u = solved(job.first(i + 1), True, 4)[0][i]
    w = job.w[i]
    rates = u[:, 1] * w + 3 * u[:, 3] * w
    return np.array([rates[0], u[1, 0] + u[1, 2], rates[1], rates[2]])

"""Rival: harmonic balance with cross-flow drag by strips in moving water, in plain numba for this ship alone.

As `harmonic_numba`, odd harmonics over half a cycle. The strips' forms are read once for all conditions, their velocities once
a sample for force and slope together, and the water's velocity is added up without a sine.
"""

import numpy as np
from numba import njit, prange

from rivals.balance_numba import eliminate, harmonics, tables_of


@njit(inline="always", fastmath=True)
def _piece(size, knots):
    b = 0
    while b < knots.size - 1 and size > knots[b + 1]:
        b += 1
    return b


@njit(fastmath=True)
def _slopes_and_rates(state, c, s, linear, push, arm, forms, water, knots, cubics, j, f):
    """Derivatives (3, 4) of the accelerations, and the accelerations (3,) themselves."""
    v, phi, p, r = state[0], state[1], state[2], state[3]
    y, k, n, yy, yk, yn, kk, kn, nn = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for z in range(forms.shape[0]):
        a, b, e = forms[z, 0], forms[z, 1], forms[z, 2]
        q = a * v + b * p + e * r - (c * water[z, 0] + s * water[z, 1])
        size = abs(q)
        push_a, push_b, push_e = size * a, size * b, size * e
        y += q * push_a
        k += q * push_b
        n += q * push_e
        yy += push_a * a
        yk += push_a * b
        yn += push_a * e
        kk += push_b * b
        kn += push_b * e
        nn += push_e * e
    size = abs(phi)
    i = _piece(size, knots)
    x = size - knots[i]
    moment = cubics[i, 0] + x * (cubics[i, 1] + x * (cubics[i, 2] + x * cubics[i, 3]))
    moment = moment if phi >= 0.0 else -moment
    stiffness = cubics[i, 1] + x * (2.0 * cubics[i, 2] + 3.0 * x * cubics[i, 3])
    for m in range(3):
        a, b, e = push[m, 0], push[m, 1], push[m, 2]
        f[m] = linear[m, 0] * v + linear[m, 1] * phi + linear[m, 2] * p + linear[m, 3] * r + arm[m] * moment
        f[m] += a * y + b * k + e * n
        j[m, 0] = linear[m, 0] + 2.0 * (a * yy + b * yk + e * yn)
        j[m, 1] = linear[m, 1] + arm[m] * stiffness
        j[m, 2] = linear[m, 2] + 2.0 * (a * yk + b * kk + e * kn)
        j[m, 3] = linear[m, 3] + 2.0 * (a * yn + b * kn + e * nn)


@njit(inline="always", fastmath=True)
def _slope_of_phi(j, phi, out):
    for c in range(4):
        a, b, d, e = phi[0, c], phi[1, c], phi[2, c], phi[3, c]
        out[0, c] = j[0, 0] * a + j[0, 1] * b + j[0, 2] * d + j[0, 3] * e
        out[1, c] = d
        out[2, c] = j[1, 0] * a + j[1, 1] * b + j[1, 2] * d + j[1, 3] * e
        out[3, c] = j[2, 0] * a + j[2, 1] * b + j[2, 2] * d + j[2, 3] * e


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
def _solve(
    linear, push, arm, forms, water, knots, cubics, w, cos, sin, values, rates, factors, weights, along, along_rates, u,
    mean, floquet,
):  # fmt: skip
    nb, samples = values.shape
    size, steps = 3 * nb, along.shape[1] // 2
    for q in prange(w.size):
        om = w[q]
        x, residual, matrix = np.zeros((3, nb)), np.empty(size), np.empty((size, size))
        j, f, state, column = np.empty((3, 4)), np.empty(3), np.empty(4), np.empty((3, 3, nb))
        for _ in range(40):
            residual[:] = 0.0
            matrix[:, :] = 0.0
            for n in range(samples):
                _at(values, rates, n, om, x, state)
                _slopes_and_rates(
                    state, values[0, n], values[1, n], linear[q], push[q], arm[q], forms, water[q], knots, cubics, j, f
                )
                for b in range(nb):
                    turn = rates[b, n] * om
                    for k in range(3):
                        column[k, 0, b] = j[k, 0] * turn
                        column[k, 1, b] = j[k, 2] * turn + j[k, 1] * values[b, n]
                        column[k, 2, b] = j[k, 3] * turn
                for c in range(nb):
                    project = weights[c] * values[c, n]
                    for k in range(3):
                        residual[k * nb + c] -= project * f[k]
                        for m in range(3):
                            for b in range(nb):
                                matrix[k * nb + c, m * nb + b] -= project * column[k, m, b]
            for k in range(3):
                for b in range(nb):
                    inertia = (factors[b] * om) ** 2
                    residual[k * nb + b] -= inertia * x[k, b]
                    matrix[k * nb + b, k * nb + b] -= inertia
                residual[k * nb] -= cos[q, k]
                residual[k * nb + 1] -= sin[q, k]
            eliminate(matrix, residual)
            largest, scale = 0.0, 1e-300
            for k in range(3):
                for b in range(nb):
                    x[k, b] -= residual[k * nb + b]
                    scale = max(scale, abs(x[k, b]))
                    largest = max(largest, abs(residual[k * nb + b]))
            if largest < 1e-8 * scale:
                break
        u[q] = x
        h = np.pi / om / steps
        phi, stage, total, slope = np.eye(4), np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4))
        average = np.zeros((3, 4))
        for n in range(2 * steps + 1):  # the matrix at half steps: two stages take the middle, one each end
            _at(along, along_rates, n, om, x, state)
            _slopes_and_rates(
                state, along[0, n], along[1, n], linear[q], push[q], arm[q], forms, water[q], knots, cubics, j, f
            )
            if n % 2 == 1:
                for _ in range(2):
                    _slope_of_phi(j, stage, slope)
                    ahead = 0.5 * h if _ == 0 else h
                    for s in range(4):
                        for c in range(4):
                            total[s, c] += 2.0 * slope[s, c]
                            stage[s, c] = phi[s, c] + ahead * slope[s, c]
                continue
            if n > 0:
                _slope_of_phi(j, stage, slope)
                for s in range(4):
                    for c in range(4):
                        phi[s, c] += h / 6.0 * (total[s, c] + slope[s, c])
            if n < 2 * steps:
                for k in range(3):
                    for s in range(4):
                        average[k, s] += j[k, s]
                _slope_of_phi(j, phi, slope)
                for s in range(4):
                    for c in range(4):
                        total[s, c] = slope[s, c]
                        stage[s, c] = phi[s, c] + 0.5 * h * slope[s, c]
        mean[q] = average / steps
        floquet[q] = phi


def harmonic_balance(job, samples, steps):
    """Amplitudes, multipliers, K2 and S of a `systems.ByStrips`; ``samples`` a cycle, ``steps`` in half of it."""
    values, rates, factors, weights, along, along_rates = tables_of((1, 3), samples, steps)
    n = job.w.size
    u, mean, floquet = np.empty((n, 3, factors.size)), np.empty((n, 3, 4)), np.empty((n, 4, 4))
    equations = (job.linear, job.push, job.arm, job.forms, job.water, job.knots, job.cubics, job.w, job.cos, job.sin)
    _solve(*equations, values, rates, factors, weights, along, along_rates, u, mean, floquet)
    return harmonics(u, mean, floquet, odd=True)

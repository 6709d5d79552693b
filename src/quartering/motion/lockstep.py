"""Newton's method on many conditions in step: every operation is done for a row of conditions at once.

The arrays hold the condition in their last axis, so that a processor's vector units work on several at a time. Nothing a
condition does depends on its neighbours. Those that need more care than full Newton steps are left for `harmonic`.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np

from quartering.compiled import abreast, kernel

WIDTH = 32
"""Conditions abreast: enough to fill vector units, few enough for their matrices to stay near the processor."""
_ITERATIONS = 8
_LEFT, _DONE = 1, 2


@abreast
def _powers(state, degrees, table):
    """table (4, 8, W): powers of each state up to its highest."""
    for s in range(4):
        for l in range(WIDTH):
            table[s, 0, l] = 1.0
        for d in range(1, degrees[s] + 1):
            for l in range(WIDTH):
                table[s, d, l] = table[s, d - 1, l] * state[s, l]


@abreast
def _forces(linear, coefficients, powers, modulus, state, table, force):
    """Right-hand sides (3, W) without excitation, from the powers of the states; [H71] eq. (3)."""
    for k in range(3):
        for l in range(WIDTH):
            first = linear[k, 0, l] * state[0, l] + linear[k, 1, l] * state[1, l]
            force[k, l] = first + linear[k, 2, l] * state[2, l] + linear[k, 3, l] * state[3, l]
    for t in range(powers.shape[0]):
        a, b, c, d = powers[t, 0], powers[t, 1], powers[t, 2], powers[t, 3]
        bars = modulus[t]
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
def _inertia_and_waves(tables, mean, cos, sin, w, u, residual):
    """Start of the residual (3 b, W): acceleration less excitation."""
    factors = tables[2]
    nb = factors.size
    first = 1 if factors[0] == 0.0 else 0
    for k in range(3):
        for b in range(nb):
            for l in range(WIDTH):
                rate = factors[b] * w[l]
                residual[k * nb + b, l] = -rate * rate * u[k, b, l]
        for l in range(WIDTH):
            residual[k * nb + first, l] -= cos[k, l]
            residual[k * nb + first + 1, l] -= sin[k, l]
        if first == 1:
            for l in range(WIDTH):
                residual[k * nb, l] -= mean[k, l]


@abreast
def _balance(system, tables, degrees, u, residual, room):
    """Residuals (3 b, W) of the balance equations, as `balance.balance` has them for one condition."""
    linear, coefficients, powers, modulus, mean, cos, sin, w = system
    values, _, _, weights = tables
    state, table, force, _, _ = room
    nb, samples = values.shape
    _inertia_and_waves(tables, mean, cos, sin, w, u, residual)
    for n in range(samples):
        states(tables, n, u, w, state)
        _powers(state, degrees, table)
        _forces(linear, coefficients, powers, modulus, state, table, force)
        for k in range(3):
            for c in range(nb):
                project = weights[c] * values[c, n]
                for l in range(WIDTH):
                    residual[k * nb + c, l] -= project * force[k, l]


@abreast
def _derivative(system, tables, degrees, u, matrix, room):
    """Derivatives (3 b, 3 b, W) of the residuals by the unknowns."""
    linear, coefficients, powers, modulus, _, _, _, w = system
    values, rates, factors, weights = tables
    state, table, _, jacobian, column = room
    nb, samples = values.shape
    for row in range(3 * nb):
        for b in range(3 * nb):
            for l in range(WIDTH):
                matrix[row, b, l] = 0.0
        rate = factors[row % nb]
        for l in range(WIDTH):
            matrix[row, row, l] = -(rate * w[l]) * (rate * w[l])
    for n in range(samples):
        states(tables, n, u, w, state)
        _powers(state, degrees, table)
        slopes(linear, coefficients, powers, modulus, state, table, jacobian)
        for b in range(nb):
            value, rate = values[b, n], rates[b, n]
            turns = 1.0 if factors[b] > 0.0 else 0.0
            for k in range(3):
                for l in range(WIDTH):
                    velocity = rate * (turns * w[l] + (1.0 - turns))
                    column[k, 0, b, l] = -jacobian[k, 0, l] * velocity
                    column[k, 1, b, l] = -jacobian[k, 1, l] * value - jacobian[k, 2, l] * (velocity * turns)
                    column[k, 2, b, l] = -jacobian[k, 3, l] * velocity
        for c in range(nb):
            project = weights[c] * values[c, n]
            for k in range(3):
                for j in range(3):
                    for b in range(nb):
                        for l in range(WIDTH):
                            matrix[k * nb + c, j * nb + b, l] += project * column[k, j, b, l]


@abreast
def _factor(a, pivots, inverse, sign):
    """Factor the matrices ``a`` (m, m, W) in place by rows; ``sign`` (W,) is that of each determinant, 0 if singular."""
    m = a.shape[0]
    for l in range(WIDTH):
        sign[l] = 1.0
    for j in range(m):
        for l in range(WIDTH):
            best, size = j, abs(a[j, j, l])
            for i in range(j + 1, m):
                if abs(a[i, j, l]) > size:
                    best, size = i, abs(a[i, j, l])
            pivots[j, l] = best
            if best != j:
                sign[l] = -sign[l]
                for k in range(m):
                    a[j, k, l], a[best, k, l] = a[best, k, l], a[j, k, l]
            if a[j, j, l] < 0.0:
                sign[l] = -sign[l]
            if not (size > 0.0 and size < 1e300):
                sign[l] = 0.0
                a[j, j, l] = 1.0
            inverse[j, l] = 1.0 / a[j, j, l]
        for i in range(j + 1, m):
            for l in range(WIDTH):
                a[i, j, l] *= inverse[j, l]
            for k in range(j + 1, m):
                for l in range(WIDTH):
                    a[i, k, l] -= a[i, j, l] * a[j, k, l]


@abreast
def _solve(a, pivots, inverse, b):
    """Solve in place for right-hand sides ``b`` (m, W) with what `_factor` left; their signs are reversed first."""
    m = a.shape[0]
    for j in range(m):
        for l in range(WIDTH):
            best = pivots[j, l]
            swapped = b[best, l]
            b[best, l] = b[j, l]
            b[j, l] = -swapped
    for j in range(m):
        for i in range(j + 1, m):
            for l in range(WIDTH):
                b[i, l] -= a[i, j, l] * b[j, l]
    for i in range(m - 1, -1, -1):
        for k in range(i + 1, m):
            for l in range(WIDTH):
                b[i, l] -= a[i, k, l] * b[k, l]
        for l in range(WIDTH):
            b[i, l] *= inverse[i, l]


@abreast
def _move(u, step, out, size):
    """Add a step to the motions; ``size`` (W,) is the largest change relative to its mode's amplitude afterwards.

    As `balance.relative_step`; not a number counts as endless.
    """
    nb = u.shape[1]
    for l in range(WIDTH):
        floor, largest = 1e-300, 0.0
        for k in range(3):
            for b in range(nb):
                out[k, b, l] = u[k, b, l] + step[k * nb + b, l]
                floor = max(floor, 1e-6 * abs(out[k, b, l]))
        for k in range(3):
            own = floor
            for b in range(nb):
                own = max(own, abs(out[k, b, l]))
            for b in range(nb):
                part = abs(step[k * nb + b, l]) / own
                largest = part if not part <= largest else largest
        size[l] = largest


@abreast
def _copy(u, out):
    for k in range(3):
        for b in range(u.shape[1]):
            for l in range(WIDTH):
                out[k, b, l] = u[k, b, l]


@abreast
def _response(linear, l, w, x, y, z):
    """Phasors of sway, roll, yaw under accelerations (x, y, z) at frequency ``w`` without the products; Cramer's rule."""
    e, s = 1j * w, -w * w
    a, b, c = s - e * linear[0, 0, l], -linear[0, 1, l] - e * linear[0, 2, l], -e * linear[0, 3, l]
    d, f, g = -e * linear[1, 0, l], s - linear[1, 1, l] - e * linear[1, 2, l], -e * linear[1, 3, l]
    h, i, j = -e * linear[2, 0, l], -linear[2, 1, l] - e * linear[2, 2, l], s - e * linear[2, 3, l]
    p, q, r = f * j - g * i, d * j - g * h, d * i - f * h
    det = a * p - b * q + c * r
    sway = (x * p - b * (y * j - g * z) + c * (y * i - f * z)) / det
    roll = (a * (y * j - g * z) - x * q + c * (d * z - y * h)) / det
    yaw = (a * (f * z - y * i) - b * (d * z - y * h) + x * r) / det
    return sway, roll, yaw


@abreast
def _steady(linear, l, x, y, z):
    """Mean sway velocity, heel and yaw rate under steady accelerations (x, y, z), and the sign of their determinant."""
    a, b, c = -linear[0, 0, l], -linear[0, 1, l], -linear[0, 3, l]
    d, f, g = -linear[1, 0, l], -linear[1, 1, l], -linear[1, 3, l]
    h, i, j = -linear[2, 0, l], -linear[2, 1, l], -linear[2, 3, l]
    p, q, r = f * j - g * i, d * j - g * h, d * i - f * h
    det = a * p - b * q + c * r
    sway = (x * p - b * (y * j - g * z) + c * (y * i - f * z)) / det
    heel = (a * (y * j - g * z) - x * q + c * (d * z - y * h)) / det
    yaw = (a * (f * z - y * i) - b * (d * z - y * h) + x * r) / det
    return sway, heel, yaw, 1.0 if det > 0.0 else -1.0


@abreast
def _linear(system, factors, u, side):
    """Motion without the products; ``side`` (W,) is the sign of its equations' determinant.

    Each harmonic counts its determinant squared, so the mean's alone decides.
    """
    linear, _, _, _, mean, cos, sin, w = system
    first = 1 if factors[0] == 0.0 else 0
    for l in range(WIDTH):
        side[l] = 1.0
        for k in range(3):
            for b in range(u.shape[1]):
                u[k, b, l] = 0.0
        x, y, z = cos[0, l] - 1j * sin[0, l], cos[1, l] - 1j * sin[1, l], cos[2, l] - 1j * sin[2, l]
        sway, roll, yaw = _response(linear, l, w[l], x, y, z)
        u[0, first, l], u[0, first + 1, l] = sway.real, -sway.imag
        u[1, first, l], u[1, first + 1, l] = roll.real, -roll.imag
        u[2, first, l], u[2, first + 1, l] = yaw.real, -yaw.imag
        if first == 1:
            v, heel, r, side[l] = _steady(linear, l, mean[0, l], mean[1, l], mean[2, l])
            u[0, 0, l], u[1, 0, l], u[2, 0, l] = v, heel, r


@abreast
def _judge(l, sign, sizes, stage):
    """Which of the points after 1, 2, 3 steps with one matrix condition ``l`` goes on from; sets its ``stage``.

    The rules are those of `balance.newton`; a step it would have shortened leaves the condition to it.
    """
    full, left, last = sizes[0, l], sizes[1, l], sizes[2, l]
    if sign[l] == 0.0 or not full < 1e12:
        stage[l] = _LEFT
        return 1
    if not (left <= 0.75 * full or (full < 1e-9 and left < 10.0 * full)):
        stage[l] = _LEFT
        return 1
    if not (last <= 0.75 * left or (left < 1e-9 and last < 10.0 * left)):
        return 1
    if last < 1e-13 or (left < 1e-9 and last > 0.01 * left):
        stage[l] = _DONE
    return 3


@abreast
def _newton(system, tables, degrees, u, stage, sign, work):
    """Newton's method on all conditions whose ``stage`` is 0, each matrix used for three steps."""
    matrix, pivots, inverse, step, points, sizes, room = work
    nb = u.shape[1]
    for _ in range(_ITERATIONS):
        _derivative(system, tables, degrees, u, matrix, room)
        _factor(matrix, pivots, inverse, sign[1])
        _copy(u, points[0])
        for j in range(3):
            _balance(system, tables, degrees, points[j], step, room)
            _solve(matrix, pivots, inverse, step)
            _move(points[j], step, points[j + 1], sizes[j])
        working = False
        for l in range(WIDTH):
            if stage[l] != 0:
                continue
            taken = _judge(l, sign[1], sizes, stage)
            sign[0, l] = sign[1, l]
            for k in range(3):
                for b in range(nb):
                    u[k, b, l] = points[taken, k, b, l]
            working = working or stage[l] == 0
        if not working:
            break


@abreast
def _turned(linear_motion, u, l):
    """Is roll more than twice or less than half of what it was?"""
    old, new = 0.0, 0.0
    for b in range(u.shape[1]):
        old += linear_motion[1, b, l] ** 2
        new += u[1, b, l] ** 2
    return new > 4.0 * old or old > 4.0 * new


@abreast
def _gather(begin, last, source, system):
    """Copy the conditions from ``begin`` on into rows abreast; the last block is filled up with its last condition."""
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
def _room(powers, nb):
    """Empty rows abreast: a system's numbers, and what one evaluation of its products needs."""
    own = (np.zeros((3, 4, WIDTH)), np.zeros((3, powers.shape[0], WIDTH)),
           np.zeros((3, WIDTH)), np.zeros((3, WIDTH)), np.zeros((3, WIDTH)), np.zeros(WIDTH))  # fmt: skip
    room = (np.zeros((4, WIDTH)), np.zeros((4, 8, WIDTH)), np.zeros((3, WIDTH)), np.zeros((3, 4, WIDTH)),
            np.zeros((3, 3, nb, WIDTH)))  # fmt: skip
    degrees = np.zeros(4, np.int64)
    for t in range(powers.shape[0]):
        for s in range(4):
            degrees[s] = max(degrees[s], powers[t, s])
    return own, room, degrees


@kernel
def in_step(first, last, linear, coefficients, powers, modulus, mean, cos, sin, frequency,
            values, rates, factors, weights, given_start, from_rest, start, waiting, error):  # fmt: skip
    """Motions of conditions first..last that full Newton steps find; ``waiting`` of those becomes 0.

    Parameters
    ----------
    linear .. frequency, values .. weights    of a `System` and of a `Basis`
    given_start : bool                        begin at ``start``, not at the linear motion
    from_rest : bool                          leave a condition whose motion is not clearly the one that grows from rest
    start : (n, 3, b)                         in and, where found, out
    waiting : (n,) int8                       1 where a motion is wanted
    error : (n,)                              out: largest imbalance relative to the excitation

    Notes
    -----
    Source: [H71] eqs. (A-10), (A-11), [Krack19].
    """
    nb = values.shape[0]
    size = 3 * nb
    own, room, degrees = _room(powers, nb)
    source = (linear, coefficients, powers, modulus, mean, cos, sin, frequency)
    system = (own[0], own[1], powers, modulus, own[2], own[3], own[4], own[5])
    tables = (values, rates, factors, weights)
    u, linear_motion = np.zeros((3, nb, WIDTH)), np.zeros((3, nb, WIDTH))
    stage, sign, side = np.zeros(WIDTH, np.int64), np.zeros((2, WIDTH)), np.zeros(WIDTH)
    step = np.zeros((size, WIDTH))
    work = (np.zeros((size, size, WIDTH)), np.zeros((size, WIDTH), np.int64), np.zeros((size, WIDTH)), step,
            np.zeros((4, 3, nb, WIDTH)), np.zeros((3, WIDTH)), room)  # fmt: skip
    for begin in range(first, last, WIDTH):
        _gather(begin, last, source, system)
        _linear(system, factors, linear_motion, side)
        for l in range(WIDTH):
            i = min(begin + l, last - 1)
            stage[l] = 0 if waiting[i] == 1 else _LEFT
            for k in range(3):
                for b in range(nb):
                    u[k, b, l] = start[i, k, b] if given_start else linear_motion[k, b, l]
        _newton(system, tables, degrees, u, stage, sign, work)
        _balance(system, tables, degrees, u, step, room)
        for l in range(min(WIDTH, last - begin)):
            i = begin + l
            if stage[l] != _DONE:
                continue
            if from_rest and not given_start and (sign[0, l] != side[l] or _turned(linear_motion, u, l)):
                continue
            waiting[i] = 0
            scale = 1e-300
            for k in range(3):
                scale = max(scale, abs(cos[i, k]), abs(sin[i, k]), abs(mean[i, k]))
                for b in range(nb):
                    start[i, k, b] = u[k, b, l]
            error[i] = 0.0
            for row in range(size):
                error[i] = max(error[i], abs(step[row, l]) / scale)


@kernel
def add_linear_harmonics(first, last, linear, coefficients, powers, modulus, mean, cos, sin, frequency,
                         values, rates, factors, weights, known, u):  # fmt: skip
    """Fill the columns of ``u`` (n, 3, b) after the first ``known`` with their linear response to the products.

    Notes
    -----
    Source: [H71] eq. (A-8).
    """
    nb = values.shape[0]
    own, room, degrees = _room(powers, nb)
    source = (linear, coefficients, powers, modulus, mean, cos, sin, frequency)
    system = (own[0], own[1], powers, modulus, own[2], own[3], own[4], own[5])
    tables = (values, rates, factors, weights)
    row, residual = np.zeros((3, nb, WIDTH)), np.zeros((3 * nb, WIDTH))
    for begin in range(first, last, WIDTH):
        _gather(begin, last, source, system)
        for l in range(WIDTH):
            i = min(begin + l, last - 1)
            for k in range(3):
                for b in range(nb):
                    row[k, b, l] = u[i, k, b] if b < known else 0.0
        _balance(system, tables, degrees, row, residual, room)
        for l in range(min(WIDTH, last - begin)):
            for b in range(known, nb, 2):
                x = 1j * residual[b + 1, l] - residual[b, l]
                y = 1j * residual[nb + b + 1, l] - residual[nb + b, l]
                z = 1j * residual[2 * nb + b + 1, l] - residual[2 * nb + b, l]
                sway, roll, yaw = _response(own[0], l, factors[b] * own[5][l], x, y, z)
                u[begin + l, 0, b], u[begin + l, 0, b + 1] = sway.real, -sway.imag
                u[begin + l, 1, b], u[begin + l, 1, b + 1] = roll.real, -roll.imag
                u[begin + l, 2, b], u[begin + l, 2, b + 1] = yaw.real, -yaw.imag

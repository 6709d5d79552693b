"""Newton's method on many conditions in step, a row of them abreast.

Conditions that need more care than full Newton steps are left for `harmonic`.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np

from quartering.compiled import abreast, kernel
from quartering.motion.abreast import (
    WIDTH,
    forces,
    gather,
    linear_response,
    raise_powers,
    rows_abreast,
    slopes,
    states,
    steady_response,
)
from quartering.motion.dense import factor_abreast, solve_abreast

_ITERATIONS = 8
_LEFT, _DONE = 1, 2
_NO_AUTOPILOT = (0j, 0j, 0j)


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
def balance_abreast(system, tables, degrees, u, residual, room):
    """Residuals (3 b, W) of the balance equations, as `balance.balance` has them for one condition.

    Notes
    -----
    Source: [H71] eqs. (A-10), (A-11), [Krack19].
    """
    linear, coefficients, powers, modulus, mean, cos, sin, w = system
    values, _, _, weights = tables
    state, table, force, _, _ = room
    nb, samples = values.shape
    _inertia_and_waves(tables, mean, cos, sin, w, u, residual)
    for n in range(samples):
        states(tables, n, u, w, state)
        raise_powers(state, degrees, table)
        forces(linear, coefficients, powers, modulus, state, table, force)
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
        raise_powers(state, degrees, table)
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
        sway, roll, yaw = linear_response(linear, l, w[l], x, y, z, _NO_AUTOPILOT)
        u[0, first, l], u[0, first + 1, l] = sway.real, -sway.imag
        u[1, first, l], u[1, first + 1, l] = roll.real, -roll.imag
        u[2, first, l], u[2, first + 1, l] = yaw.real, -yaw.imag
        if first == 1:
            v, heel, r, side[l] = steady_response(linear, l, mean[0, l], mean[1, l], mean[2, l])
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
        factor_abreast(matrix, pivots, inverse, sign[1])
        _copy(u, points[0])
        for j in range(3):
            balance_abreast(system, tables, degrees, points[j], step, room)
            solve_abreast(matrix, pivots, inverse, step)
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
    own, room, degrees = rows_abreast(powers, nb)
    source = (linear, coefficients, powers, modulus, mean, cos, sin, frequency)
    system = (own[0], own[1], powers, modulus, own[2], own[3], own[4], own[5])
    tables = (values, rates, factors, weights)
    u, linear_motion = np.zeros((3, nb, WIDTH)), np.zeros((3, nb, WIDTH))
    stage, sign, side = np.zeros(WIDTH, np.int64), np.zeros((2, WIDTH)), np.zeros(WIDTH)
    step = np.zeros((size, WIDTH))
    work = (np.zeros((size, size, WIDTH)), np.zeros((size, WIDTH), np.int64), np.zeros((size, WIDTH)), step,
            np.zeros((4, 3, nb, WIDTH)), np.zeros((3, WIDTH)), room)  # fmt: skip
    for begin in range(first, last, WIDTH):
        gather(begin, last, source, system)
        _linear(system, factors, linear_motion, side)
        for l in range(WIDTH):
            i = min(begin + l, last - 1)
            stage[l] = 0 if waiting[i] == 1 else _LEFT
            for k in range(3):
                for b in range(nb):
                    u[k, b, l] = start[i, k, b] if given_start else linear_motion[k, b, l]
        _newton(system, tables, degrees, u, stage, sign, work)
        balance_abreast(system, tables, degrees, u, step, room)
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

"""Batched Newton's method for harmonic balance, condition index last (SIMD).

Conditions that need more care than full Newton steps are left for `harmonic`.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np

from quartering._machine.compiled import batch_kernel, kernel
from quartering.motion.equations.rates import WIDTH, enter_inputs, forces, gather, room_for, row_of_lanes, slopes
from quartering.motion.steady.dense import factor_batch, solve_batch

_ITERATIONS = 8
_LEFT, _DONE = 1, 2
FOUND: Final = 0
WAITING: Final = 1
TO_FOLLOW: Final = 2
FOUND_ALTERED: Final = 3
"""Where a condition stands: its motion found, wanted, wanted from following the wave as it rises, found but much unlike the
linear motion that Newton's method set out from."""
ALTERED: Final = 0.1**2
"""Square of the share of roll by which it may differ from the linear motion's without doubt whether it is the one from rest."""
_NO_AUTOPILOT = (0j, 0j, 0j)


@batch_kernel
def gather_motions(begin, last, u, row):
    """Copy the motions (n, 3, b) from ``begin`` on into a row (3, b, W)."""
    for l in range(row.shape[2]):
        i = min(begin + l, last - 1)
        for k in range(3):
            for b in range(row.shape[1]):
                row[k, b, l] = u[i, k, b]


@batch_kernel
def states(program, factors, value, rate, u, w, columns):
    """States of the motions ``u`` (3, b, W) where the harmonics have the values and rates (b,), into the first columns.

    The mean's column holds mean displacements, and mean velocities of modes whose displacement the equations do not hold.
    Source: [H71] eq. (A-3), for any set of harmonics.
    """
    width = columns.shape[1]
    for s in range(program.states):
        for l in range(width):
            columns[s, l] = 0.0
    sway, roll, yaw = program.velocities[0], program.velocities[1], program.velocities[2]
    for b in range(factors.size):
        by_phase, own = rate[b], value[b]
        if factors[b] > 0.0:
            for l in range(width):
                velocity = by_phase * w[l]
                columns[sway, l] += u[0, b, l] * velocity
                columns[roll, l] += u[1, b, l] * velocity
                columns[yaw, l] += u[2, b, l] * velocity
        for k in range(3):
            held = program.displacements[k]
            if held < 0 and factors[b] == 0.0:
                held = program.velocities[k]
            if held >= 0:
                for l in range(width):
                    columns[held, l] += u[k, b, l] * own


@batch_kernel
def at_sample(program, tables, n, u, lanes, columns):
    """Everything ``columns`` need at sample ``n``: states, and the variables that known inputs enter."""
    values, rates, factors, _, waves = tables
    states(program, factors, values[:, n], rates[:, n], u, lanes.frequency, columns)
    enter_inputs(program, lanes, waves[:, n], columns)


@batch_kernel
def _inertia_and_waves(factors, lanes, u, residual):
    """Start of the residual (3 b, W): acceleration less excitation."""
    nb, width = factors.size, lanes.frequency.size
    first = 1 if factors[0] == 0.0 else 0
    for k in range(3):
        for b in range(nb):
            for l in range(width):
                rate = factors[b] * lanes.frequency[l]
                residual[k * nb + b, l] = -rate * rate * u[k, b, l]
        for l in range(width):
            residual[k * nb + first, l] -= lanes.cos[k, l]
            residual[k * nb + first + 1, l] -= lanes.sin[k, l]
        if first == 1:
            for l in range(width):
                residual[k * nb, l] -= lanes.mean[k, l]


@batch_kernel
def balance_batch(program, tables, lanes, u, residual, room):
    """Residuals (3 b, W) of the balance equations, as `balance.balance` has them for one condition.

    Row (k, c) is projection c of acceleration minus right-hand side.  Source: [H71] eqs. (A-10), (A-11), [Krack19].
    """
    values, _, factors, weights, waves = tables
    columns, force, _, sums = room
    nb, samples = values.shape
    width = lanes.frequency.size
    _inertia_and_waves(factors, lanes, u, residual)
    for n in range(samples):
        at_sample(program, tables, n, u, lanes, columns)
        forces(program, lanes, waves[1, n], waves[2, n], columns, sums, force)
        for k in range(3):
            for c in range(nb):
                project = weights[c] * values[c, n]
                for l in range(width):
                    residual[k * nb + c, l] -= project * force[k, l]


@batch_kernel
def derivative_batch(program, tables, lanes, u, matrix, column, room):
    """Derivatives (3 b, 3 b, W) of the residuals by the unknowns.

    With drag from every second sample: there are many for the sake of |q| q alone, and the matrix only leads Newton's steps,
    the residual decides.
    """
    values, rates, factors, weights, waves = tables
    columns, _, jacobian, sums = room
    nb, samples = values.shape
    width, w = lanes.frequency.size, lanes.frequency
    for row in range(3 * nb):
        for b in range(3 * nb):
            for l in range(width):
                matrix[row, b, l] = 0.0
        rate = factors[row % nb]
        for l in range(width):
            matrix[row, row, l] = -(rate * w[l]) * (rate * w[l])
    sway, roll, yaw = program.velocities[0], program.velocities[1], program.velocities[2]
    every = 2 if lanes.strips.shape[0] > 0 and samples % 2 == 0 else 1
    # d residual_(k c)/du_(j b) = -(h w)^2 [same k, c = b] - <phi_c, df_k/dv_j phi_b' w + df_k/dx_j phi_b>, as in
    # `balance`, with the condition as the last index: one instruction works on eight of them.
    for n in range(0, samples, every):
        at_sample(program, tables, n, u, lanes, columns)
        slopes(program, lanes, waves[1, n], waves[2, n], columns, sums, jacobian)
        for b in range(nb):
            value, rate = values[b, n], rates[b, n] if factors[b] > 0.0 else 0.0
            for k in range(3):
                for l in range(width):
                    velocity = rate * w[l]
                    column[k, 0, b, l] = -jacobian[k, sway, l] * velocity
                    column[k, 1, b, l] = -jacobian[k, roll, l] * velocity
                    column[k, 2, b, l] = -jacobian[k, yaw, l] * velocity
            for j in range(3):
                held = program.displacements[j]
                if held < 0 and factors[b] == 0.0:
                    held = program.velocities[j]
                if held >= 0:
                    for k in range(3):
                        for l in range(width):
                            column[k, j, b, l] -= jacobian[k, held, l] * value
        for c in range(nb):
            project = every * weights[c] * values[c, n]
            for k in range(3):
                for j in range(3):
                    for b in range(nb):
                        for l in range(width):
                            matrix[k * nb + c, j * nb + b, l] += project * column[k, j, b, l]


@batch_kernel
def linear_response(linear, l, w, x, y, z, answer):
    """Phasors of sway, roll, yaw under accelerations (x, y, z) at frequency ``w`` without the products; Cramer's rule.

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


@batch_kernel
def steady_response(linear, l, x, y, z):
    """Mean sway velocity, heel and yaw rate under steady accelerations (x, y, z), and the sign of their determinant.

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


@batch_kernel
def _move(u, step, out, size):
    """Add a step to the motions; ``size`` (W,) is the largest change relative to its mode's amplitude afterwards.

    As `balance.relative_step`; not a number counts as endless.
    """
    nb = u.shape[1]
    for l in range(size.size):
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


@batch_kernel
def _copy(u, out):
    for k in range(3):
        for b in range(u.shape[1]):
            for l in range(u.shape[2]):
                out[k, b, l] = u[k, b, l]


@batch_kernel
def _linear(lanes, factors, u, side):
    """Motion without the products; ``side`` (W,) is the sign of its equations' determinant.

    Each harmonic counts its determinant squared, so the mean's alone decides.
    """
    linear, mean, cos, sin, w = lanes.linear, lanes.mean, lanes.cos, lanes.sin, lanes.frequency
    first = 1 if factors[0] == 0.0 else 0
    for l in range(w.size):
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


@batch_kernel
def _judge(l, sign, sizes, stage):
    """Choose the accepted iterate among three chord-Newton steps; update the ``stage`` of condition ``l``.

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


@batch_kernel
def _newton(program, tables, lanes, u, stage, sign, work):
    """Newton's method on all conditions whose ``stage`` is 0, each matrix used for three steps."""
    matrix, pivots, inverse, step, points, sizes, column, room = work
    nb, width = u.shape[1], u.shape[2]
    for _ in range(_ITERATIONS):
        derivative_batch(program, tables, lanes, u, matrix, column, room)
        factor_batch(matrix, pivots, inverse, sign[1])
        _copy(u, points[0])
        for j in range(3):
            balance_batch(program, tables, lanes, points[j], step, room)
            solve_batch(matrix, pivots, inverse, step)
            _move(points[j], step, points[j + 1], sizes[j])
        working = False
        for l in range(width):
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


@batch_kernel
def _altered(linear_motion, u, l):
    """Does the roll differ by more than a tenth of the lesser, in size or phase?"""
    old, new, apart = 0.0, 0.0, 0.0
    for b in range(u.shape[1]):
        old += linear_motion[1, b, l] ** 2
        new += u[1, b, l] ** 2
        apart += (u[1, b, l] - linear_motion[1, b, l]) ** 2
    return apart > ALTERED * min(old, new)


@kernel
def newton_batch(first, last, program, parts, tables, given_start, from_rest, start, waiting, error):
    """Motions of conditions first..last that full Newton steps find, with ``waiting`` set.

    of a `System`, and of a `Basis` with the wave's harmonics
    given_start: begin at ``start``, not at the linear motion
    from_rest: leave a condition whose motion lies beyond a fold, mark one with roll not near the linear one's
    start (n, 3, b): in and, where found, out
    waiting (n,): `WAITING` where a motion is wanted; out: `FOUND`, or `FOUND_ALTERED` where ``from_rest`` asks
    error (n,): out: largest imbalance relative to the excitation

    Source: [H71] eqs. (A-10), (A-11), [Krack19].
    """
    factors = tables[2]
    nb = factors.size
    size = 3 * nb
    lanes = row_of_lanes(parts, WIDTH)
    room = room_for(program, lanes)
    u, linear_motion = np.zeros((3, nb, WIDTH)), np.zeros((3, nb, WIDTH))
    stage, sign, side = np.zeros(WIDTH, np.int64), np.zeros((2, WIDTH)), np.zeros(WIDTH)
    step = np.zeros((size, WIDTH))
    work = (np.zeros((size, size, WIDTH)), np.zeros((size, WIDTH), np.int64), np.zeros((size, WIDTH)), step,
            np.zeros((4, 3, nb, WIDTH)), np.zeros((3, WIDTH)), np.zeros((3, 3, nb, WIDTH)), room)  # fmt: skip
    # Lanes that are not wanted, or fill up the last row, go along with stage _LEFT and are not written.
    for begin in range(first, last, WIDTH):
        gather(begin, last, parts, lanes)
        _linear(lanes, factors, linear_motion, side)
        for l in range(WIDTH):
            i = min(begin + l, last - 1)
            stage[l] = 0 if waiting[i] == 1 else _LEFT
            for k in range(3):
                for b in range(nb):
                    u[k, b, l] = start[i, k, b] if given_start else linear_motion[k, b, l]
        _newton(program, tables, lanes, u, stage, sign, work)
        balance_batch(program, tables, lanes, u, step, room)
        for l in range(min(WIDTH, last - begin)):
            i = begin + l
            if stage[l] != _DONE:
                continue
            from_linear = from_rest and not given_start
            if from_linear and sign[0, l] != side[l]:
                continue
            waiting[i] = FOUND_ALTERED if from_linear and _altered(linear_motion, u, l) else FOUND
            scale = 1e-300
            for k in range(3):
                scale = max(scale, abs(parts.cos[i, k]), abs(parts.sin[i, k]), abs(parts.mean[i, k]))
                for b in range(nb):
                    start[i, k, b] = u[k, b, l]
            error[i] = 0.0
            for row in range(size):
                error[i] = max(error[i], abs(step[row, l]) / scale)

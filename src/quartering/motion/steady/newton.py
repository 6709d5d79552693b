"""Batched Newton's method for harmonic balance, condition index last (SIMD).

Conditions that need more care than full Newton steps are left for `harmonic`.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np

from quartering._machine.compiled import batch_kernel, kernel, maker
from quartering._machine.simd import every, load, size, store, where_less
from quartering.motion.equations.program import PLAIN
from quartering.motion.equations.rates import (
    WIDTH,
    enter_inputs,
    fill_lane,
    forces,
    gather,
    note_equal_lanes,
    room_for,
    row_of_lanes,
    slopes,
)
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
    first = 1 if factors[0] == 0.0 else 0
    for s in range(program.states):
        store(columns, s, every(0.0))
    for k in range(3):
        held, velocity = program.displacements[k], every(0.0)
        for b in range(first, factors.size):
            velocity += rate[b] * load(u, (k, b))
        store(columns, program.velocities[k], velocity * load(w, ()))
        if held >= 0:
            own = every(0.0)
            for b in range(factors.size):
                own += value[b] * load(u, (k, b))
            store(columns, held, own)
        elif first == 1:
            place = program.velocities[k]
            store(columns, place, load(columns, place) + value[0] * load(u, (k, 0)))


@batch_kernel
def _plain_states(program, tables, n, u, w, columns):
    """`states` at sample ``n`` where there is nothing but (v, phi, p, r): the harmonics are gone through once for all four."""
    values, rates, factors, _, _ = tables
    first = 1 if factors[0] == 0.0 else 0
    v, p, r, angle = every(0.0), every(0.0), every(0.0), every(0.0)
    if first == 1:
        angle += values[0, n] * load(u, (1, 0))
    for b in range(first, factors.size):
        roll = load(u, (1, b))
        v += rates[b, n] * load(u, (0, b))
        p += rates[b, n] * roll
        r += rates[b, n] * load(u, (2, b))
        angle += values[b, n] * roll
    own = load(w, ())
    v, p, r = v * own, p * own, r * own
    if first == 1:
        v += values[0, n] * load(u, (0, 0))
        r += values[0, n] * load(u, (2, 0))
    store(columns, program.velocities[0], v)
    store(columns, program.velocities[1], p)
    store(columns, program.velocities[2], r)
    store(columns, program.displacements[1], angle)


@batch_kernel
def at_sample(program, tables, n, u, lanes, columns):
    """Everything ``columns`` need at sample ``n``: states, and the variables that known inputs enter."""
    values, rates, factors, _, waves = tables
    if program.states == PLAIN:
        _plain_states(program, tables, n, u, lanes.frequency, columns)
    else:
        states(program, factors, values[:, n], rates[:, n], u, lanes.frequency, columns)
    enter_inputs(program, lanes, waves[:, n], columns)


@batch_kernel
def balance_batch(program, tables, lanes, u, residual, room):
    """Residuals (3 b, W) of the balance equations, as `balance.balance` has them for one condition.

    Row (k, c) is projection c of acceleration minus right-hand side.  Source: [H71] eqs. (A-10), (A-11), [Krack19].
    """
    values, _, factors, weights, waves = tables
    (columns, _, _, sums), force, _ = room
    nb, samples = values.shape
    first = 1 if factors[0] == 0.0 else 0
    for n in range(samples):
        at_sample(program, tables, n, u, lanes, columns)
        forces(program, lanes, waves[1, n], waves[2, n], columns, sums, force[n])
    w = load(lanes.frequency, ())
    for k in range(3):
        for c in range(nb):
            rate = factors[c] * w
            left = -rate * rate * load(u, (k, c))
            if c == first:
                left -= load(lanes.cos, k)
            elif c == first + 1:
                left -= load(lanes.sin, k)
            elif c < first:
                left -= load(lanes.mean, k)
            for n in range(samples):
                left -= (weights[c] * values[c, n]) * load(force, (n, k))
            store(residual, k * nb + c, left)


@batch_kernel
def derivative_batch(program, tables, lanes, u, matrix, room):
    """Derivatives (3 b, 3 b, W) of the residuals by the unknowns.

    With drag from every second sample: there are many for the sake of |q| q alone, and the matrix only leads Newton's steps,
    the residual decides.
    """
    values, _, factors, weights, waves = tables
    (columns, _, _, sums), _, (jacobian, products, projected) = room
    nb = values.shape[0]
    nth = values.shape[1] // products.shape[1]
    for n in range(products.shape[1]):
        at_sample(program, tables, nth * n, u, lanes, columns)
        slopes(program, lanes, waves[1, nth * n], waves[2, nth * n], columns, sums, jacobian[n])
    project(jacobian, products, projected)
    # d residual_(k c)/du_(j b) = -(h w)^2 [same k, c = b] - <phi_c, df_k/dv_j phi_b' w + df_k/dx_j phi_b>, as in `balance`.
    # All of it are the sums <phi_c, J phi_b>, symmetric in b and c: the rate of a cosine is -h times the sine beside it, that
    # of a sine h times the cosine.
    w = load(lanes.frequency, ())
    first = 1 if factors[0] == 0.0 else 0
    for k in range(3):
        for j in range(3):
            velocity, held = program.velocities[j], program.displacements[j]
            for b in range(nb):
                cosine = (b - first) % 2 == 0
                beside, rate = (b + 1, -factors[b] * w) if cosine else (b - 1, factors[b] * w)
                for c in range(nb):
                    if factors[b] == 0.0:
                        own = load(projected, (k, held if held >= 0 else velocity, _pair(c, b)))
                    else:
                        own = rate * load(projected, (k, velocity, _pair(c, beside)))
                        if held >= 0:
                            own += load(projected, (k, held, _pair(c, b)))
                    own = (-nth * weights[c]) * own
                    if k == j and c == b:
                        own -= (factors[c] * w) * (factors[c] * w)
                    store(matrix, (k * nb + c, j * nb + b), own)


@batch_kernel
def _pair(b, c):
    """Place of a symmetric pair among those of a lower triangle."""
    return b * (b + 1) // 2 + c if b >= c else c * (c + 1) // 2 + b


@batch_kernel
def project(jacobian, products, projected):
    """Sums (k, s, p, W) over samples of the derivatives (n, k, s, W) times functions (p, n), p a multiple of four."""
    for k in range(3):
        for s in range(4):
            for p in range(0, products.shape[0], 4):
                a, b, c, d = every(0.0), every(0.0), every(0.0), every(0.0)
                for n in range(products.shape[1]):
                    own = load(jacobian, (n, k, s))
                    a += products[p, n] * own
                    b += products[p + 1, n] * own
                    c += products[p + 2, n] * own
                    d += products[p + 3, n] * own
                store(projected, (k, s, p), a)
                store(projected, (k, s, p + 1), b)
                store(projected, (k, s, p + 2), c)
                store(projected, (k, s, p + 3), d)


@maker
def room_for_balance(program, lanes, tables):
    """What residuals and their derivatives need: room for one sample, forces at all; and for a derivative its samples, the
    products (pair, n) of two harmonics at them, and the projections on them.
    """
    values = tables[0]
    nb, samples = values.shape
    room = room_for(program, lanes)
    rows, states, width = room[2].shape
    nth = 2 if lanes.strips.shape[0] > 0 and samples % 2 == 0 else 1
    products = np.zeros((4 * ((nb * (nb + 1) // 2 + 3) // 4), samples // nth))
    for c in range(nb):
        for b in range(c + 1):
            for n in range(samples // nth):
                products[_pair(c, b), n] = values[c, nth * n] * values[b, nth * n]
    derivative = np.zeros((samples // nth, rows, states, width)), products, np.zeros((3, 4, products.shape[0], width))
    return room, np.zeros((samples, rows, width)), derivative


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
def _move(u, step, out, largest):
    """Add a step to the motions; ``largest`` (W,) is the largest change relative to its mode's amplitude afterwards.

    As `balance.relative_step`; not a number counts as endless.
    """
    nb = u.shape[1]
    floor, most = every(1e-300), every(0.0)
    for k in range(3):
        for b in range(nb):
            moved = load(u, (k, b)) + load(step, k * nb + b)
            store(out, (k, b), moved)
            own = 1e-6 * size(moved)
            floor = where_less(floor, own, own, floor)
    for k in range(3):
        amplitude = floor
        for b in range(nb):
            own = size(load(out, (k, b)))
            amplitude = where_less(amplitude, own, own, amplitude)
        for b in range(nb):
            change = size(load(step, k * nb + b)) / amplitude
            most = where_less(change, most, most, change)
    store(largest, (), most)


@batch_kernel
def _copy(u, out):
    for k in range(3):
        for b in range(u.shape[1]):
            store(out, (k, b), load(u, (k, b)))


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
    # Steps with one matrix shrink by one factor, last/left: done when the next one would be at rounding, or nil, as
    # it is without excitation.
    if last * last < 1e-13 * left or last == 0.0 or (left < 1e-9 and last > 0.01 * left):
        stage[l] = _DONE
    return 3


@batch_kernel
def _round(program, tables, lanes, u, stage, sign, work):
    """Three steps of Newton's method with one matrix for all lanes, those whose ``stage`` is 0 to remain where they lead."""
    matrix, pivots, inverse, step, points, sizes, room = work
    derivative_batch(program, tables, lanes, u, matrix, room)
    factor_batch(matrix, pivots, inverse, sign[1])
    _copy(u, points[0])
    for j in range(3):
        balance_batch(program, tables, lanes, points[j], step, room)
        solve_batch(matrix, pivots, inverse, step)
        _move(points[j], step, points[j + 1], sizes[j])
    for l in range(u.shape[2]):
        if stage[l] != 0:
            continue
        taken = _judge(l, sign[1], sizes, stage)
        sign[0, l] = sign[1, l]
        for k in range(3):
            for b in range(u.shape[1]):
                u[k, b, l] = points[taken, k, b, l]


@batch_kernel
def _altered(linear_motion, u, l):
    """Does the roll differ by more than a tenth of the lesser, in size or phase?"""
    old, new, apart = 0.0, 0.0, 0.0
    for b in range(u.shape[1]):
        old += linear_motion[1, b, l] ** 2
        new += u[1, b, l] ** 2
        apart += (u[1, b, l] - linear_motion[1, b, l]) ** 2
    return apart > ALTERED * min(old, new)


@batch_kernel
def _imbalance(lanes, residual, l):
    """Largest residual of a lane relative to its excitation."""
    scale, largest = 1e-300, 0.0
    for k in range(3):
        scale = max(scale, abs(lanes.cos[k, l]), abs(lanes.sin[k, l]), abs(lanes.mean[k, l]))
    for row in range(residual.shape[0]):
        largest = max(largest, abs(residual[row, l]))
    return largest / scale


@kernel
def newton_batch(first, last, program, parts, tables, given_start, from_rest, start, waiting):
    """Motions of conditions first..last that full Newton steps find, with ``waiting`` set.

    of a `System`, and of a `Basis` with the wave's harmonics
    given_start: begin at ``start``, not at the linear motion
    from_rest: leave a condition whose motion lies beyond a fold, mark one with roll not near the linear one's
    start (n, 3, b): in and, where found, out
    waiting (n,): `WAITING` where a motion is wanted; out: `FOUND`, or `FOUND_ALTERED` where ``from_rest`` asks

    Source: [H71] eqs. (A-10), (A-11), [Krack19].
    """
    if first >= last:
        return
    factors = tables[2]
    nb = factors.size
    lanes = row_of_lanes(parts, WIDTH)
    room = room_for_balance(program, lanes, tables)
    u, linear_motion = np.zeros((3, nb, WIDTH)), np.zeros((3, nb, WIDTH))
    stage, sign, side = np.full(WIDTH, _LEFT), np.zeros((2, WIDTH)), np.zeros(WIDTH)
    following = from_rest and not given_start
    work = (np.zeros((3 * nb, 3 * nb, WIDTH)), np.zeros((3 * nb, WIDTH)), np.zeros((3 * nb, WIDTH)),
            np.zeros((3 * nb, WIDTH)), np.zeros((4, 3, nb, WIDTH)), np.zeros((3, WIDTH)), room)  # fmt: skip
    # A lane takes the next condition as soon as its own is done, so that none waits for the slowest of its neighbours. The
    # last ones stand beside lanes that have none left and go along without being written.
    held, rounds, ahead = np.full(WIDTH, -1), np.zeros(WIDTH, np.int64), first
    for l in range(WIDTH):
        fill_lane(parts, first, lanes, l)
    while True:
        taken = 0
        for l in range(WIDTH):
            while held[l] < 0 and ahead < last:
                if waiting[ahead] == WAITING:
                    fill_lane(parts, ahead, lanes, l)
                    held[l], rounds[l], stage[l] = ahead, 0, 0
                    taken += 1
                ahead += 1
        if taken > 0:
            note_equal_lanes(parts, lanes)
            _linear(lanes, factors, linear_motion, side)
        working = False
        for l in range(WIDTH):
            working = working or held[l] >= 0
            if held[l] >= 0 and rounds[l] == 0:
                for k in range(3):
                    for b in range(nb):
                        u[k, b, l] = start[held[l], k, b] if given_start else linear_motion[k, b, l]
        if not working:
            break
        _round(program, tables, lanes, u, stage, sign, work)
        for l in range(WIDTH):
            i = held[l]
            rounds[l] += 1
            if i < 0 or (stage[l] == 0 and rounds[l] < _ITERATIONS):
                continue
            if stage[l] == _DONE and not (following and sign[0, l] != side[l]):
                waiting[i] = FOUND_ALTERED if following and _altered(linear_motion, u, l) else FOUND
                for k in range(3):
                    for b in range(nb):
                        start[i, k, b] = u[k, b, l]
            held[l], stage[l] = -1, _LEFT


@kernel
def imbalances(first, last, program, parts, tables, u, waiting, error):
    """Largest imbalance relative to the excitation, into ``error`` (n,), of those motions (n, 3, b) that are found."""
    nb = tables[2].size
    lanes = row_of_lanes(parts, WIDTH)
    room = room_for_balance(program, lanes, tables)
    motion, residual = np.zeros((3, nb, WIDTH)), np.zeros((3 * nb, WIDTH))
    for begin in range(first, last, WIDTH):
        gather(begin, last, parts, lanes)
        gather_motions(begin, last, u, motion)
        balance_batch(program, tables, lanes, motion, residual, room)
        for l in range(min(WIDTH, last - begin)):
            if waiting[begin + l] == FOUND:
                error[begin + l] = _imbalance(lanes, residual, l)

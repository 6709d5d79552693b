"""Motion in time of a row of records of a sea, with its sums, its largest values and its failures."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# Lateral acceleration as an accelerometer feels it at a point (x forward, z down, from G), the deck's own gravity in it:
#
#     f = v' + U r + x r' - z p' - g phi
#
# at the beginning of each step, where Runge-Kutta has the accelerations. Largest values are sought between the steps too: where
# the roll rate changes sign, roll is that of the cubic through both ends where the secant of the rate is zero; the acceleration
# is that at the vertex of the parabola through three steps.

from __future__ import annotations

from typing import Final

import numpy as np

from quartering._machine.compiled import batch_kernel, inner, kernel, maker
from quartering.conventions import GRAVITY
from quartering.motion.equations.rates import WIDTH
from quartering.motion.transient.rk4 import room_to_march, step_sum

SUMS: Final = 16
"""Of each record: ten products of v, phi, p, r, their four sums, the lateral acceleration squared, and steps counted."""
NONE, ROLL, ACCELERATION, RUN_UP = 0, 1, 2, 3
"""How a record ended: without a failure, by roll, by lateral acceleration, or by roll before it counted."""
_CHECK = 32


@kernel
def march(equations, forcing, steps, first, h, speed, x, z, roll_limit, felt_limit, sums, largest, time, cause):
    """Runge-Kutta steps of one row of records from rest, until all have failed or ``steps`` are done.
    forcing (2 steps + 1, 3 + e + z, n): accelerations, known inputs and water at every half step
    steps to do, the first that counts, and their length [s]
    U, and the point of the lateral acceleration from G
    of a failure [rad], [m/s2]
    sums (16, n): see `SUMS`; of what counts
    largest (2, n): |phi| [rad] and |f| [m/s2]
    time, cause (n,): of the failure since the first step that counts [s]; ``steps`` without
    """
    own_sums, own_largest = np.empty((sums.shape[0], WIDTH)), np.empty((2, WIDTH))
    own_time, own_cause = np.empty(WIDTH), np.empty(WIDTH, np.int64)
    check_room(forcing.shape[2], min(sums.shape[1], largest.shape[1], time.size, cause.size))
    for begin in range(0, forcing.shape[2], WIDTH):
        own_sums[:, :], own_largest[:, :] = 0.0, 0.0
        own_time[:], own_cause[:] = time[begin : begin + WIDTH], cause[begin : begin + WIDTH]
        _march_vector(
            equations, forcing, begin, steps, first, h, (speed, x, z), (roll_limit, felt_limit), own_sums, own_largest,
            own_time, own_cause,
        )  # fmt: skip
        sums[:, begin : begin + WIDTH] += own_sums
        for l in range(WIDTH):
            for k in range(2):
                largest[k, begin + l] = max(largest[k, begin + l], own_largest[k, l])
            time[begin + l], cause[begin + l] = own_time[l], own_cause[l]


@maker
def _march_vector(equations, forcing, begin, steps, first, h, at, limits, sums, largest, time, cause):
    """`march` of a vector of records from ``begin`` on."""
    (speed, x, z), (roll_limit, felt_limit) = at, limits
    kinds = forcing.shape[1]
    room, given = room_to_march(equations), np.zeros((3, kinds, WIDTH))
    waves = np.zeros((3, equations.parts.inputs.shape[2]))
    waves[:, 0], waves[:, 1] = 1.0, 1.0  # a series stands where the mean of an input and the cosine of the water would
    program, total, rate = equations.program, room[4], room[5]
    mean = equations.parts.mean[0]
    y, before = np.zeros((program.states, WIDTH)), np.zeros((2, WIDTH))
    felt, going = np.zeros((4, WIDTH)), np.ones(WIDTH)  # three steps of the acceleration, and its size between them
    roll, turning = program.displacements[1], program.velocities[1]
    take(forcing[0], begin, mean, given[0])
    for n in range(steps):
        take(forcing[2 * n + 1], begin, mean, given[1])
        take(forcing[2 * n + 2], begin, mean, given[2])
        step_sum(equations, h, given, waves, y, room)
        _feel(program, rate, y, speed, x, z, felt)
        _peak(felt)
        if n >= first:
            _count(program, y, felt, going, sums, largest)
        before[0], before[1] = y[roll], y[turning]
        _advance(h / 6.0, total, going, y)
        alive = False
        for l in range(WIDTH):
            if going[l] == 0.0:
                continue
            size = abs(y[roll, l])
            if before[1, l] * y[turning, l] < 0.0:
                size = max(size, _between(before[0, l], y[roll, l], h * before[1, l], h * y[turning, l]))
            failed = not size <= roll_limit
            pushed = n >= first and felt[3, l] > felt_limit
            if n >= first:
                largest[0, l] = max(largest[0, l], size)
            if failed or pushed:
                going[l] = 0.0
                y[:, l] = 0.0
                time[l] = (n - first) * h if pushed else (n + 1 - first) * h
                cause[l] = ACCELERATION if pushed else ROLL
                if n < first:
                    time[l], cause[l] = 0.0, RUN_UP
            else:
                alive = True
        for k in range(kinds):
            for l in range(WIDTH):
                given[0, k, l] = given[2, k, l]
        if n % _CHECK == 0 and not alive:
            return


@inner
def check_room(records, room):
    """Refuse outputs with less room than there are records: a vector would be written past their end."""
    if records % WIDTH != 0 or room < records:
        raise ValueError("records come in whole vectors, and outputs have room for all of them")


@batch_kernel
def take(series, begin, mean, given):
    """Known inputs of one time in double precision, the steady acceleration added."""
    for k in range(series.shape[0]):
        more = mean[k] if k < 3 else 0.0
        for l in range(given.shape[1]):
            given[k, l] = series[k, begin + l] + more


@batch_kernel
def _feel(program, rate, y, speed, x, z, felt):
    roll, yaw = program.displacements[1], program.velocities[2]
    for l in range(felt.shape[1]):
        felt[0, l], felt[1, l] = felt[1, l], felt[2, l]
        felt[2, l] = rate[0, l] + speed * y[yaw, l] + x * rate[2, l] - z * rate[1, l] - GRAVITY * y[roll, l]


@batch_kernel
def _peak(felt):
    """Size of the acceleration now, or at the vertex of the parabola where the step before is the largest of three."""
    for l in range(felt.shape[1]):
        a, b, c = felt[0, l], felt[1, l], felt[2, l]
        turns = (b - a) * (b - c) > 0.0
        more = (c - a) * (c - a) / (8.0 * (2.0 * b - a - c)) if turns else 0.0
        felt[3, l] = max(abs(c), abs(b + more))


@batch_kernel
def _count(program, y, felt, going, sums, largest):
    place = (program.velocities[0], program.displacements[1], program.velocities[1], program.velocities[2])
    k = 0
    for a in range(4):
        for b in range(a, 4):
            for l in range(going.size):
                sums[k, l] += going[l] * y[place[a], l] * y[place[b], l]
            k += 1
    for a in range(4):
        for l in range(going.size):
            sums[10 + a, l] += going[l] * y[place[a], l]
    for l in range(going.size):
        sums[14, l] += going[l] * felt[2, l] * felt[2, l]
        sums[15, l] += going[l]
        largest[1, l] = max(largest[1, l], going[l] * felt[3, l])


@batch_kernel
def _advance(by, total, going, y):
    for s in range(y.shape[0]):
        for l in range(y.shape[1]):
            y[s, l] += going[l] * by * total[s, l]


@batch_kernel
def _between(a, b, left, right):
    """|value| of the cubic with ends a, b and slopes left, right of opposite sign over 0..1, where their secant is 0."""
    t = left / (left - right)
    s = 1.0 - t
    return abs(s * s * ((1.0 + 2.0 * t) * a + t * left) + t * t * ((1.0 + 2.0 * s) * b - s * right))

"""Roll of a row of records of a sea step by step, and the growth of small disturbances along them."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# Disturbances follow d' = J(y(t), t) d along the nonlinear motion y. Over a step the classical fourth-order method needs J at
# its begin, middle and end; the state in the middle is that of the cubic through both ends with their slopes,
#
#     y_m = (y_0 + y_1)/2 + h (f_0 - f_1)/8
#
# which errs by h^4, as the step does. The disturbance is brought back to length 1 after each step and the logarithms of what
# it had grown to are summed: their mean over time is the largest Lyapunov exponent, whatever the length is measured in.

from __future__ import annotations

import math

import numpy as np

from quartering._machine.compiled import inner, kernel, maker
from quartering.motion.equations.rates import WIDTH, enter_inputs, fill, forces, room_for, row_of_lanes, slopes
from quartering.motion.sea.march import check_room, take
from quartering.motion.transient.rk4 import hold, room_to_march, step_sum


@kernel
def roll_of_windows(equations, forcing, steps, h, limit, rolls):
    """Roll of a row of records from rest, at every step.

    forcing (2 steps + 1, 3 + e + z, n): accelerations, known inputs and water at every half step, as `march` takes them
    limit: roll beyond which a record stays where it is [rad]
    rolls (steps + 1, n): to write [rad]
    """
    check_room(forcing.shape[2], rolls.shape[1])
    for begin in range(0, forcing.shape[2], WIDTH):
        _roll_of_vector(equations, forcing, begin, steps, h, limit, rolls[:, begin : begin + WIDTH])


@maker
def _roll_of_vector(equations, forcing, begin, steps, h, limit, rolls):
    """`roll_of_windows` of a vector of records from ``begin`` on."""
    kinds = forcing.shape[1]
    room, given = room_to_march(equations), np.zeros((3, kinds, WIDTH))
    waves = np.zeros((3, equations.parts.inputs.shape[2]))
    waves[:, 0], waves[:, 1] = 1.0, 1.0
    program, total, mean = equations.program, room[4], equations.parts.mean[0]
    y, roll = np.zeros((program.states, WIDTH)), program.displacements[1]
    rolls[0] = 0.0
    take(forcing[0], begin, mean, given[0])
    for n in range(steps):
        take(forcing[2 * n + 1], begin, mean, given[1])
        take(forcing[2 * n + 2], begin, mean, given[2])
        step_sum(equations, h, given, waves, y, room)
        for s in range(program.states):
            for l in range(WIDTH):
                y[s, l] += h / 6.0 * total[s, l]
        for l in range(WIDTH):
            if not abs(y[roll, l]) <= limit or abs(rolls[n, l]) >= limit:
                rolls[n + 1, l] = limit if rolls[n, l] > 0.0 else -limit
                y[:, l] = 0.0
            else:
                rolls[n + 1, l] = y[roll, l]
        given[0] = given[2]


@kernel
def growth_of_disturbances(equations, forcing, steps, first, h, limit, start, growth, time):
    """Logarithm of the growth of a small disturbance along each of a row of records.

    forcing, steps, first, h: as `march` takes them; growth counts from step ``first`` on
    limit: roll at which a record ends [rad]
    start (s,): the disturbance at the begin, of length 1
    growth, time (n,): to write; [s]
    """
    check_room(forcing.shape[2], min(growth.size, time.size))
    for begin in range(0, forcing.shape[2], WIDTH):
        end = begin + WIDTH
        _growth_of_vector(equations, forcing, begin, steps, first, h, limit, start, growth[begin:end], time[begin:end])


@maker
def _growth_of_vector(equations, forcing, begin, steps, first, h, limit, start, growth, time):
    """`growth_of_disturbances` of a vector of records from ``begin`` on."""
    kinds = forcing.shape[1]
    room, given = room_to_march(equations), np.zeros((3, kinds, WIDTH))
    waves = np.zeros((3, equations.parts.inputs.shape[2]))
    waves[:, 0], waves[:, 1] = 1.0, 1.0
    program, total, mean = equations.program, room[4], equations.parts.mean[0]
    lanes = row_of_lanes(equations.parts, WIDTH)
    fill(0, 1.0, equations.parts, lanes)
    work = room_for(program, lanes)
    states, roll = program.states, program.displacements[1]
    y, d, going = np.zeros((states, WIDTH)), np.zeros((states, WIDTH)), np.ones(WIDTH)
    rate, before = np.zeros((states, WIDTH)), np.zeros((states, WIDTH))
    middle, y0 = np.zeros((states, WIDTH)), np.zeros((states, WIDTH))
    at = np.zeros((3, states, states, WIDTH))
    for s in range(states):
        d[s, :] = start[s]
    growth[:], time[:] = 0.0, 0.0
    begun, halfway, ended = np.int64(0), np.int64(1), np.int64(2)  # of constants a copy each would be compiled
    take(forcing[0], begin, mean, given[0])
    _linearise(program, lanes, given, begun, waves[0], y, work, before, at[0])
    for n in range(steps):
        take(forcing[2 * n + 1], begin, mean, given[1])
        take(forcing[2 * n + 2], begin, mean, given[2])
        step_sum(equations, h, given, waves, y, room)
        for s in range(states):
            for l in range(WIDTH):
                y0[s, l] = y[s, l]
                y[s, l] += going[l] * h / 6.0 * total[s, l]
        for l in range(WIDTH):
            if not abs(y[roll, l]) <= limit:
                going[l] = 0.0
                y[:, l], y0[:, l] = 0.0, 0.0
        _linearise(program, lanes, given, ended, waves[0], y, work, rate, at[2])
        for s in range(states):
            for l in range(WIDTH):
                middle[s, l] = 0.5 * (y0[s, l] + y[s, l]) + 0.125 * h * (before[s, l] - rate[s, l])
        _linearise(program, lanes, given, halfway, waves[0], middle, work, y0, at[1])
        _carry(at, h, d)
        for l in range(WIDTH):
            size = 0.0
            for s in range(states):
                size += d[s, l] * d[s, l]
            size = math.sqrt(size)
            if n >= first and going[l] > 0.0:
                growth[l] += math.log(size)
                time[l] += h
            for s in range(states):
                d[s, l] /= size
        before[:], at[0], given[0] = rate, at[2], given[2]


@inner
def _linearise(program, lanes, given, time, waves, y, work, rate, matrix):
    """Rates (s, W) of the states at one time, and their derivatives (s, s, W)."""
    columns, force, jacobian, sums = work
    states = program.states
    for s in range(states):
        for l in range(y.shape[1]):
            columns[s, l] = y[s, l]
    hold(given, time, 3, lanes)
    enter_inputs(program, lanes, waves, columns)
    forces(program, lanes, waves[1], waves[2], columns, sums, force)
    slopes(program, lanes, waves[1], waves[2], columns, sums, jacobian)
    for s in range(states):
        row, follows = program.rows[s], program.follows[s]
        for l in range(y.shape[1]):
            more = given[time, row, l] if 0 <= row < 3 else 0.0
            rate[s, l] = columns[follows, l] if follows >= 0 else force[row, l] + more
        for t in range(states):
            for l in range(y.shape[1]):
                matrix[s, t, l] = (1.0 if t == follows else 0.0) if follows >= 0 else jacobian[row, t, l]


@maker
def _carry(at, h, d):
    """One step of d' = J d with J at its begin, middle and end."""
    states, width = d.shape
    total, stage, slope = np.zeros(d.shape), d.copy(), np.zeros(d.shape)
    for j in range(4):
        matrix = at[(j + 1) // 2]
        weight, ahead = (1.0 if j == 0 or j == 3 else 2.0), (0.5 * h if j < 2 else h)
        for s in range(states):
            for l in range(width):
                slope[s, l] = 0.0
            for t in range(states):
                for l in range(width):
                    slope[s, l] += matrix[s, t, l] * stage[t, l]
        for s in range(states):
            for l in range(width):
                total[s, l] += weight * slope[s, l]
                stage[s, l] = d[s, l] + ahead * slope[s, l]
    for s in range(states):
        for l in range(width):
            d[s, l] += h / 6.0 * total[s, l]

"""Batched fixed-step Runge-Kutta integration of one ship, many histories.

The coefficients are alike in all histories, so they stand as numbers beside whole rows of products.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel
from quartering.motion.equations.program import Program
from quartering.motion.equations.rates import (
    WIDTH,
    Parts,
    add_strips_and_table,
    enter_inputs,
    fill,
    multiply,
    room_for,
    row_of_lanes,
)
from quartering.motion.equations.system import Floats, System

_GROUP = 4


class Alike(NamedTuple):
    """The equations of one ship for a row of histories: ``rates = matrix columns``, of the state and its products.

    Parameters
    ----------
    matrix : (g, 4) float    what is not zero, four at a time; a row has as many groups as it needs, filled up with zeros
    columns : (g, 4) int     where the program has their columns
    row : (g,) int           row of the right-hand side, those of one row together
    program, parts           of the `System`
    """

    matrix: Floats
    columns: NDArray[np.int64]
    row: NDArray[np.int64]
    program: Program
    parts: Parts


def alike(system: System) -> Alike:
    """The equations of a system's first condition.

    Source: [H71] eq. (3); no approximation, only the order of multiplications.
    """
    program = system.program
    rows, states = system.linear.shape[1:]
    whole = np.zeros((rows, states + program.products.size))
    whole[:, :states] = system.linear[0]
    whole[:3, states:] = system.coefficients[0]
    columns = np.concatenate([np.arange(states), program.products])
    groups, of = [], []
    for k in range(rows):
        held = np.flatnonzero(whole[k])
        for first in range(0, held.size, _GROUP):
            part = held[first : first + _GROUP]
            fill_up = _GROUP - part.size
            groups.append((np.pad(whole[k, part], (0, fill_up)), np.pad(columns[part], (0, fill_up))))
            of.append(k)
    matrix = np.array([one for one, _ in groups]).reshape(-1, _GROUP)
    at = np.array([one for _, one in groups], dtype=np.int64).reshape(-1, _GROUP)
    parts = Parts(*(array[:1] for array in system.parts))
    return Alike(matrix, at, np.array(of, dtype=np.int64), program, parts)


@batch_kernel
def room_to_march(equations):
    """What `step_sum` works in: lanes, columns and rates, the sum of four rates, and the first of them."""
    lanes = row_of_lanes(equations.parts, WIDTH)
    fill(0, 1.0, equations.parts, lanes)
    columns, rate, _, sums = room_for(equations.program, lanes)
    return lanes, columns, rate, sums, np.zeros((equations.program.states, WIDTH)), np.zeros(rate.shape)


@batch_kernel
def _rates(equations, lanes, c, s, columns, sums, rate):
    """Add to ``rate`` (k, W) what the state and the known inputs in ``columns`` do; the products are made here."""
    matrix, at, program = equations.matrix, equations.columns, equations.program
    multiply(program.links, 0, program.values, columns)
    for g in range(matrix.shape[0]):
        k, m0, m1, m2, m3 = equations.row[g], matrix[g, 0], matrix[g, 1], matrix[g, 2], matrix[g, 3]
        c0, c1, c2, c3 = at[g, 0], at[g, 1], at[g, 2], at[g, 3]
        for l in range(WIDTH):
            first = m0 * columns[c0, l] + m1 * columns[c1, l]
            rate[k, l] += first + (m2 * columns[c2, l] + m3 * columns[c3, l])
    add_strips_and_table(program, lanes, c, s, columns, sums, rate)


@batch_kernel
def hold(series, lanes):
    """Known inputs and the water at the strips as they are at one time (e + z, W), in place of a wave's."""
    inputs = lanes.inputs.shape[0]
    for e in range(inputs):
        for l in range(WIDTH):
            lanes.inputs[e, 0, l] = series[e, l]
        for i in range(1, lanes.inputs.shape[1]):
            for l in range(WIDTH):
                lanes.inputs[e, i, l] = 0.0
    for z in range(lanes.strips.shape[0]):
        for l in range(WIDTH):
            lanes.strips[z, 3, l] = series[inputs + z, l]


@batch_kernel
def step_sum(equations, h, excitation, series, waves, y, room):
    """Sum of the four rates of a Runge-Kutta step from the states ``y`` (4 to 6, W), into the last but one of ``room``.

    The last takes the accelerations at the beginning of the step.

    excitation (3, 3, W): accelerations at the beginning, the middle and the end of the step
    series (3, e + z, W): known inputs and water at the strips at these times; (3, 0, W) where they follow the wave
    waves (3, h): 1 and the wave's cosines and sines at these times; 1, 1, 0 with a series

    The state after the step is ``y + h/6`` times the sum.  Source: [H71] eq. (3), the classical fourth-order method.
    """
    lanes, columns, rate, sums, total, first = room
    program = equations.program
    states = program.states
    for s in range(states):
        for l in range(WIDTH):
            columns[s, l], total[s, l] = y[s, l], 0.0
    for j in range(4):
        at = (j + 1) // 2
        for k in range(rate.shape[0]):
            for l in range(WIDTH):
                rate[k, l] = excitation[at, k, l] if k < 3 else 0.0
        if series.shape[1] > 0:
            hold(series[at], lanes)
        enter_inputs(program, lanes, waves[at], columns)
        _rates(equations, lanes, waves[at, 1], waves[at, 2], columns, sums, rate)
        if j == 0:
            for k in range(rate.shape[0]):
                for l in range(WIDTH):
                    first[k, l] = rate[k, l]
        weight, ahead = (1.0 if j == 0 or j == 3 else 2.0), (0.5 * h if j < 2 else h)
        # a state that follows another first, while that one is still the stage's
        for s in range(states):
            follows = program.follows[s]
            if follows >= 0:
                for l in range(WIDTH):
                    total[s, l] += weight * columns[follows, l]
                    columns[s, l] = y[s, l] + ahead * columns[follows, l]
        for s in range(states):
            row = program.rows[s]
            if row >= 0:
                for l in range(WIDTH):
                    total[s, l] += weight * rate[row, l]
                    columns[s, l] = y[s, l] + ahead * rate[row, l]

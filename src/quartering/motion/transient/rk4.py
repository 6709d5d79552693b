"""Batched fixed-step Runge-Kutta integration of one ship, many histories.

The coefficients are alike in all histories, so they stand as numbers beside whole rows of products.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, maker
from quartering._machine.simd import every, load, store
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


class Alike(NamedTuple):
    """The equations of one ship for a row of histories: ``rates = matrix^T columns``, of the state and its products.

    Parameters
    ----------
    matrix : (c, k) float    a row for each column that any of the k rates takes
    columns : (c,) int       where the program has it
    program, parts           of the `System`
    """

    matrix: Floats
    columns: NDArray[np.int64]
    program: Program
    parts: Parts


def alike(system: System) -> Alike:
    """The equations of a system's first condition.

    Source: [H71] eq. (3); no approximation, only the order of multiplications.

    >>> from quartering.motion.equations.model import Model
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_ppp": -0.2, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> alike(model.system).columns.tolist()  # v, phi, r, and p^3 of roll in column 5
    [0, 1, 3, 5]
    """
    program = system.program
    rows, states = system.linear.shape[1:]
    whole = np.zeros((states + program.products.size, rows))
    whole[:states] = system.linear[0].T
    whole[states:, :3] = system.coefficients[0].T
    held = np.flatnonzero(whole.any(axis=1))
    columns = np.concatenate([np.arange(states), program.products])[held].astype(np.int64)
    parts = Parts(*(array[:1] for array in system.parts))
    return Alike(np.ascontiguousarray(whole[held]), columns, program, parts)


@maker
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
    x, y, z = load(rate, 0), load(rate, 1), load(rate, 2)
    for i in range(at.size):
        own = load(columns, at[i])
        x += matrix[i, 0] * own
        y += matrix[i, 1] * own
        z += matrix[i, 2] * own
    store(rate, 0, x)
    store(rate, 1, y)
    store(rate, 2, z)
    for k in range(3, rate.shape[0]):
        more = load(rate, k)
        for i in range(at.size):
            more += matrix[i, k] * load(columns, at[i])
        store(rate, k, more)
    add_strips_and_table(program, lanes, c, s, columns, sums, rate)


@batch_kernel
def hold(series, at, first, lanes):
    """Known inputs and the water at the strips as they are at one time, in place of a wave's."""
    inputs = lanes.inputs.shape[0]
    for e in range(inputs):
        store(lanes.inputs, (e, 0), load(series, (at, first + e)))
        for i in range(1, lanes.inputs.shape[1]):
            store(lanes.inputs, (e, i), every(0.0))
    for z in range(lanes.strips.shape[0]):
        store(lanes.strips, (z, 3), load(series, (at, first + inputs + z)))


@batch_kernel
def step_sum(equations, h, given, waves, y, room):
    """Sum of the four rates of a Runge-Kutta step from the states ``y`` (4 to 6, W), into the last but one of ``room``.

    The last takes the accelerations at the beginning of the step.

    given (3, 3 + e + z, W): accelerations at the beginning, the middle and the end of the step, then known inputs and water at
        the strips; (3, 3, W) where these follow the wave
    waves (3, h): 1 and the wave's cosines and sines at these times; 1, 1, 0 with a series

    The state after the step is ``y + h/6`` times the sum.  Source: [H71] eq. (3), the classical fourth-order method.
    """
    lanes, columns, rate, sums, total, first = room
    program = equations.program
    states = program.states
    for s in range(states):
        store(columns, s, load(y, s))
        store(total, s, every(0.0))
    for j in range(4):
        at = (j + 1) // 2
        for k in range(rate.shape[0]):
            store(rate, k, load(given, (at, k)) if k < 3 else every(0.0))
        if given.shape[1] > 3:
            hold(given, at, 3, lanes)
        enter_inputs(program, lanes, waves[at], columns)
        _rates(equations, lanes, waves[at, 1], waves[at, 2], columns, sums, rate)
        if j == 0:
            for k in range(rate.shape[0]):
                store(first, k, load(rate, k))
        weight, ahead = (1.0 if j == 0 or j == 3 else 2.0), (0.5 * h if j < 2 else h)
        # a state that follows another first, while that one is still the stage's
        for s in range(states):
            follows = program.follows[s]
            if follows >= 0:
                own = load(columns, follows)
                store(total, s, load(total, s) + weight * own)
                store(columns, s, load(y, s) + ahead * own)
        for s in range(states):
            row = program.rows[s]
            if row >= 0:
                own = load(rate, row)
                store(total, s, load(total, s) + weight * own)
                store(columns, s, load(y, s) + ahead * own)

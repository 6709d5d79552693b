"""State transition matrices of the variational equations by Runge-Kutta steps, conditions of equal steps in a batch."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.simd import every, load, store
from quartering._machine.threads import in_threads
from quartering.motion.equations.rates import (
    WIDTH,
    enter_inputs,
    fill_lane,
    note_equal_lanes,
    room_for,
    row_of_lanes,
    slopes,
)
from quartering.motion.equations.steering import turning
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.newton import states

_OCTAVE = 8


def even_steps(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Numbers of steps raised to one of eight an octave, so that many conditions take equally many.

    >>> even_steps(np.array([100, 101, 500])).tolist()
    [108, 108, 512]
    """
    return np.ceil(2.0 ** (np.ceil(np.log2(steps) * _OCTAVE - 1e-9) / _OCTAVE)).astype(np.int64)


@batch_kernel
def _matrix_at(program, parts_lanes, factors, angle, periods, u, value, rate, waves, columns, sums, jacobian):
    """Rows of the variational matrix (k, s, W) at a phase of the motions."""
    for b in range(factors.size):
        # cosine and sine of a harmonic stand beside each other, the cosine in front
        if factors[b] == 0.0:
            value[b], rate[b] = 1.0, 1.0
        elif b + 1 < factors.size and factors[b + 1] == factors[b] and (b == 0 or factors[b - 1] != factors[b]):
            c, s = math.cos(factors[b] * angle), math.sin(factors[b] * angle)
            value[b], rate[b] = c, -factors[b] * s
            value[b + 1], rate[b + 1] = s, factors[b] * c
    waves[0] = 1.0
    for h in range(1, waves.size // 2 + 1):
        waves[2 * h - 1], waves[2 * h] = math.cos(h * periods * angle), math.sin(h * periods * angle)
    states(program, factors, value, rate, u, parts_lanes.frequency, columns)
    enter_inputs(program, parts_lanes, waves, columns)
    slopes(program, parts_lanes, waves[1], waves[2], columns, sums, jacobian)


@batch_kernel
def _slope(program, jacobian, phi, out):
    """Derivative of phi (s, s, W): a state's row is that of the state it follows, or the right-hand side's."""
    size = phi.shape[0]
    for s in range(size):
        follows, k = program.follows[s], program.rows[s]
        for c in range(size):
            if follows >= 0:
                store(out, (s, c), load(phi, (follows, c)))
                continue
            own = every(0.0)
            for j in range(size):
                own += load(jacobian, (k, j)) * load(phi, (j, c))
            store(out, (s, c), own)


@batch_kernel
def _advance(phi, slope, ahead, weight, stage, total):
    by = load(ahead, ())
    for a in range(phi.shape[0]):
        for b in range(phi.shape[0]):
            own = load(slope, (a, b))
            store(total, (a, b), load(total, (a, b)) + weight * own)
            store(stage, (a, b), load(phi, (a, b)) + by * own)


@kernel
def _march(first, last, program, parts, factors, periods, u, span, steps, rows, transition):
    """Fourth-order Runge-Kutta solution (n, s, s) over ``span`` cycles of the conditions in ``rows`` (r, W)."""
    width, size, nb = rows.shape[1], program.states, factors.size
    lanes = row_of_lanes(parts, width)
    columns, _, matrix, sums = room_for(program, lanes)
    motion, value, rate = np.zeros((3, nb, width)), np.zeros(nb), np.zeros(nb)
    waves = np.zeros(parts.inputs.shape[2])
    phi, stage, slope = np.zeros((size, size, width)), np.zeros((size, size, width)), np.zeros((size, size, width))
    total, h, ahead = np.zeros((size, size, width)), np.zeros(width), np.zeros(width)
    half_angle = np.pi * span / steps
    for r in range(first, last):
        for l in range(width):
            i = rows[r, l]
            fill_lane(parts, i, lanes, l)
            h[l] = 2.0 * np.pi * span / (parts.frequency[i] * steps)
            for k in range(3):
                for b in range(nb):
                    motion[k, b, l] = u[i, k, b]
        note_equal_lanes(parts, lanes)
        for a in range(size):
            for b in range(size):
                for l in range(width):
                    phi[a, b, l] = 1.0 if a == b else 0.0
        # Phi' = J(t) Phi, Phi(0) = 1, by the classical method: slopes at the beginning, twice in the middle, at the end. Step n
        # spans the angles 2n to 2n + 2 half angles: J is evaluated at the odd and at the even ones, once each.
        for n in range(steps):
            for j in range(4):
                if j == 0:
                    for a in range(size):
                        for b in range(size):
                            for l in range(width):
                                stage[a, b, l], total[a, b, l] = phi[a, b, l], 0.0
                if j != 2 and (j > 0 or n == 0):  # the middle stands for two stages, the end for the next beginning
                    angle = (2 * n + (j + 1) // 2) * half_angle
                    _matrix_at(
                        program, lanes, factors, angle, periods, motion, value, rate, waves, columns, sums, matrix
                    )
                _slope(program, matrix, stage, slope)
                for l in range(width):
                    ahead[l] = 0.5 * h[l] if j < 2 else h[l]
                _advance(phi, slope, ahead, 1.0 if j == 0 or j == 3 else 2.0, stage, total)
            for a in range(size):
                for b in range(size):
                    for l in range(width):
                        phi[a, b, l] += h[l] / 6.0 * total[a, b, l]
        for l in range(width):
            for a in range(size):
                for b in range(size):
                    transition[rows[r, l], a, b] = phi[a, b, l]


def transition_matrices(
    system: System, u: Floats, orders: tuple[int, ...], span: float, steps: NDArray[np.int64]
) -> Floats:
    """State transition matrices of the variational equations, from phase zero over part of a cycle.

    system: n conditions
    u (n, 3, b): motions, as from `harmonic_balance`
    orders: their harmonics
    span: fraction of the period: 1 for the monodromy matrix, 0.5 for its symmetric root
    steps (n,): Runge-Kutta steps over the span
    Returns (n, s, s): state order (v, phi, p, r), with an autopilot psi and, with a lag, delta

    Fourth-order Runge-Kutta; the error falls with the fourth power of the number of steps, with drag |q| q with the square at
    worst.  Source: [H71] eq. (8), as a first-order system.
    """
    transition = np.empty((system.count, system.states, system.states))
    moving = np.ascontiguousarray(turning(system.linear, u, orders))
    factors = np.concatenate([[float(h)] * (2 if h else 1) for h in orders])
    given = (system.program, system.parts, factors, system.periods, moving, float(span))
    for count in np.unique(steps):
        own = np.flatnonzero(steps == count)
        rows = np.pad(own, (0, -own.size % WIDTH), mode="edge").reshape(-1, WIDTH)
        in_threads(_march, len(rows), *given, int(count), rows, transition, smallest=1)
    return transition

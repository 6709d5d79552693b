"""The balance equations of one condition, their derivative, and Newton's method on them: compiled kernels.

The right-hand side is that of `rates`, evaluated at all instants of the cycle in a batch.

A single condition is solved first as a row of one by `newton_batch`, as many are; this is the other algorithm, for those which
that leaves: steps are damped, each takes a matrix of its own, the wave may act in part (`follow`), an autopilot may steer, and
the harmonics may be so many that the matrices of a row would fill the memory. Conditions of a batch cannot damp, since each
would take its own number of trials.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np

from quartering._machine.compiled import inner, kernel, maker
from quartering.motion.equations.rates import (
    WIDTH,
    at_instants,
    enter_inputs,
    fill,
    forces,
    room_for,
    row_of_lanes,
    slopes,
)
from quartering.motion.equations.steering import add_steering, mean_is_heading
from quartering.motion.equations.system import FEWEST, Floats, System, kernel_arguments
from quartering.motion.steady.dense import lu_factor, lu_solve


@maker
def room_for_one(program, parts, tables):
    """Lanes for the instants of a cycle, what their evaluation needs, columns of a derivative, and a wave held still."""
    nb = tables[0].shape[0]
    lanes = row_of_lanes(parts, WIDTH)
    still = np.zeros(parts.inputs.shape[2])
    still[0] = 1.0
    return lanes, room_for(program, lanes), np.zeros((3, 3, nb)), still


@inner
def _orbit_states(program, tables, w, u, held, begin, columns):
    """States at the samples from ``begin`` on of the motion ``u`` (3, b), one a lane.

    Source: [H71] eq. (A-3), for any set of harmonics; the mean's column holds mean sway and yaw velocity, mean heel.
    """
    values, rates, factors, _, _ = tables
    count = min(columns.shape[1], values.shape[1] - begin)
    for s in range(program.states):
        for l in range(columns.shape[1]):
            columns[s, l] = 0.0
    for k in range(3):
        velocity, displacement = program.velocities[k], program.displacements[k]
        for b in range(factors.size):
            own = u[k, b]
            if factors[b] == 0.0:
                state = displacement if displacement >= 0 else velocity
                for l in range(count):
                    columns[state, l] += 0.0 if held and k == 2 else own
                continue
            for l in range(count):
                columns[velocity, l] += own * (rates[b, begin + l] * w)
            if displacement >= 0:
                for l in range(count):
                    columns[displacement, l] += own * values[b, begin + l]


@inner
def balance(one, tables, u, residual, matrix, room):
    """Residual of the balance equations at ``u`` and, if asked for, its exact derivative.

    one: program and parts of a `System`, which condition, and the share of the known inputs that acts; the lanes of
        ``room`` hold the condition (`rates.fill`)
    tables: of a `Basis`: values, rates, factors, weights, and the wave's harmonics
    u (3, b): unknowns: mean, cos and sin coefficients of sway, roll, yaw
    residual (3 b,): out, mode by mode; a matrix of (0, 0) is not wanted
    room: from `room_for_one`

    Row (k, c) is projection c of acceleration minus right-hand side.  Source: [H71] eqs. (A-10), (A-11) for one
    harmonic, [Krack19] for more; exact for polynomials by the number of samples in the tables.
    """
    program, parts, i, share = one
    values, rates, factors, weights, waves = tables
    lanes, (columns, force, jacobian, sums), column, still = room
    linear, w = parts.linear[i], parts.frequency[i]
    with_matrix = matrix.shape[0] > 0
    nb, samples = values.shape
    residual[:] = 0.0
    matrix[:] = 0.0
    held = mean_is_heading(linear, factors)
    # With phi_c the basis (1, cos, sin, ..) sampled over a cycle, Galerkin's equations of mode k are
    #   0 = <phi_c, x_k''> - <phi_c, f_k(x, x', t)>,   <phi_c, g> = sum over samples of weight_c phi_c g .
    # x'' = -(h w)^2 x of harmonic h is diagonal and comes last; the sum over samples is that of f.
    for begin in range(0, samples, columns.shape[1]):
        at_instants(i, share, parts, waves, begin, lanes)
        _orbit_states(program, tables, w, u, held, begin, columns)
        enter_inputs(program, lanes, still, columns)
        forces(program, lanes, 1.0, 0.0, columns, sums, force)
        count = min(columns.shape[1], samples - begin)
        for l in range(count):
            for c in range(nb):
                project = weights[c] * values[c, begin + l]
                for k in range(3):
                    residual[k * nb + c] -= project * force[k, l]
        if not with_matrix:
            continue
        slopes(program, lanes, 1.0, 0.0, columns, sums, jacobian)
        for l in range(count):
            n = begin + l
            # df/du_(j b) = df/dv phi_b' w + df/dx phi_b. Sway and yaw have no displacement in f (`holds` is False): the mean is
            # a mean velocity, whose rate is 1; a held heading's mean is an angle, and enters through the autopilot.
            for j in range(3):
                velocity, displacement = program.velocities[j], program.displacements[j]
                for b in range(nb):
                    swings, holds = factors[b] > 0.0, displacement >= 0
                    rate = rates[b, n] * w if swings else 0.0 if holds or (held and j == 2) else 1.0
                    value = values[b, n] if holds else 0.0
                    for k in range(3):
                        by_value = jacobian[k, displacement, l] * value if holds else 0.0
                        column[k, j, b] = -jacobian[k, velocity, l] * rate - by_value
            for c in range(nb):
                project = weights[c] * values[c, n]
                for k in range(3):
                    for j in range(3):
                        for b in range(nb):
                            matrix[k * nb + c, j * nb + b] += project * column[k, j, b]
    if linear.shape[1] > 4:
        add_steering(linear, factors, w, u, residual, matrix)
    # The known force is mean + cos(w t) + sin(w t) and projects onto its own three columns alone.
    first = 1 if factors[0] == 0.0 else 0
    for k in range(3):
        for b in range(nb):
            inertia = (factors[b] * w) ** 2
            residual[k * nb + b] -= inertia * u[k, b]
            if with_matrix:
                matrix[k * nb + b, k * nb + b] -= inertia
        if first == 1:
            residual[k * nb] -= parts.mean[i, k]
        residual[k * nb + first] -= parts.cos[i, k]
        residual[k * nb + first + 1] -= parts.sin[i, k]


@kernel
def balance_at(program, parts, tables, u, residual, matrix):
    """`balance` of the first condition of a system, from Python."""
    room = room_for_one(program, parts, tables)
    fill(0, 1.0, parts, room[0])
    balance((program, parts, 0, 1.0), tables, u, residual, matrix, room)


@inner
def relative_step(step, u):
    """Largest step in any unknown relative to its mode's amplitude, so that metres and radians count alike.

    Source: a norm of this library's choice.
    """
    nb = u.shape[1]
    floor = 1e-300
    for k in range(3):
        for b in range(nb):
            floor = max(floor, 1e-6 * abs(u[k, b]))
    size = 0.0
    for k in range(3):
        own = floor
        for b in range(nb):
            own = max(own, abs(u[k, b]))
        for b in range(nb):
            size = max(size, abs(step[k * nb + b]) / own)
    return size


@inner
def _negative(a, out):
    for i in range(a.size):
        out[i] = -a[i]


@inner
def copy_motion(u, out):
    """Copy coefficients (3, b) from ``u`` into ``out``."""
    for k in range(3):
        for b in range(u.shape[1]):
            out[k, b] = u[k, b]


@inner
def _add(u, step, damping, out):
    nb = u.shape[1]
    for k in range(3):
        for b in range(nb):
            out[k, b] = u[k, b] + damping * step[k * nb + b]


@inner
def newton(one, tables, u, work):
    """Damped Newton from ``u``, in place; returns (0 converged, 1 not converged, 2 singular) and a sign.

    The sign is that of the determinant of the derivative at the solution: it changes from one side of a fold to the other.

    A damped step is taken when the next step, with the old matrix, is shorter (the natural monotonicity test): the
    result does not depend on how the equations are scaled.

    Source: [Krack19] (Newton's method on balance equations).
    """
    residual, no_matrix, factored, pivots, trial, step, after, room = work
    for _ in range(40):
        balance(one, tables, u, residual, factored, room)
        _negative(residual, step)
        sign = lu_factor(factored, pivots)
        if sign == 0:
            return 2, 0
        lu_solve(factored, pivots, step)
        _add(u, step, 1.0, trial)
        full = relative_step(step, trial)
        if not full < 1e12:
            return 1, 0
        damping = 1.0
        while True:
            _add(u, step, damping, trial)
            balance(one, tables, trial, residual, no_matrix, room)
            _negative(residual, after)
            lu_solve(factored, pivots, after)
            left = relative_step(after, trial)
            at_rounding = full < 1e-9 and left < 10.0 * full
            if left <= (1.0 - 0.25 * damping) * full or at_rounding:
                break
            damping *= 0.5
            if damping < 0.01:
                return 1, 0
        copy_motion(trial, u)
        if damping == 1.0 and (left < 1e-13 or (full < 1e-9 and left > 0.01 * full)):
            _add(u, after, 1.0, u)
            return 0, sign
    return 1, 0


_NO_MATRIX = np.empty((0, 0))


class BalanceEquations:
    """The balance equations of one condition, their tables made once for many motions."""

    def __init__(self, system: System, orders: tuple[int, ...]) -> None:
        table = system.basis(orders, fewest=FEWEST)
        self._size = 3 * table.factors.size
        self._arguments = kernel_arguments(system, table)

    def at(self, u: Floats, *, with_matrix: bool = True) -> tuple[Floats, Floats]:
        """Residual and derivative as from `balance_of`."""
        size = self._size
        residual, matrix = np.empty(size), np.empty((size, size)) if with_matrix else _NO_MATRIX
        balance_at(*self._arguments, np.ascontiguousarray(u), residual, matrix)
        return residual, matrix


def balance_of(
    system: System, orders: tuple[int, ...], u: Floats, *, with_matrix: bool = True
) -> tuple[Floats, Floats]:
    """Residual of the balance equations of one condition, and its derivative.

    system: one condition
    orders: harmonics, the wave's own in front (after the mean)
    u (3, b): coefficients
    with_matrix: is the derivative wanted?
    Returns residual (3 b,); matrix (3 b, 3 b)

    Source: [H71] eqs. (A-10), (A-11); [Krack19].
    """
    return BalanceEquations(system, orders).at(u, with_matrix=with_matrix)

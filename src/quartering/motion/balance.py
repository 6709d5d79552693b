"""The balance equations of one condition, their derivative, and Newton's method on them: compiled kernels."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from quartering.compiled import inner, kernel
from quartering.motion.dense import lu_factor, lu_solve
from quartering.motion.polynomial import accelerations
from quartering.motion.steering import add_steering, mean_is_heading


@inner
def orbit_state(values, rates, factors, w, u, n, state):
    """State (v, phi, p, r) at sample ``n`` of the motion ``u`` (3, b), written into ``state``.

    Notes
    -----
    Source: [H71] eq. (A-3), for any set of harmonics; the mean's column holds mean sway and yaw velocity, mean heel.
    """
    state[:] = 0.0
    for b in range(values.shape[0]):
        rate = rates[b, n]
        if factors[b] > 0.0:
            rate = rate * w
            state[2] += u[1, b] * rate
        state[0] += u[0, b] * rate
        state[1] += u[1, b] * values[b, n]
        state[3] += u[2, b] * rate


@kernel
def balance(system, tables, u, strength, residual, matrix, scratch):
    """Residual of the balance equations at ``u`` and, if asked for, its exact derivative.

    Parameters
    ----------
    system : tuple    one condition: linear, coefficients, powers, modulus, mean, cos, sin, frequency
    tables : tuple    of a `Basis`: values, rates, factors, weights
    u : (3, b)        unknowns: mean, cos and sin coefficients of sway, roll, yaw
    strength : float  multiplies the nonlinear products
    residual : (3 b,), matrix : (3 b, 3 b)    out, mode by mode; a matrix of (0, 0) is not wanted
    scratch : tuple   (4, 8), (4,), (3,), (3, 4), (3, 3, b) work arrays

    Notes
    -----
    Row (k, c) is projection c of acceleration minus right-hand side.  Source: [H71] eqs. (A-10), (A-11) for one
    harmonic, [Krack19] for more; exact for polynomials by the number of samples in the tables.
    """
    linear, coefficients, powers, modulus, mean, cos, sin, w = system
    values, rates, factors, weights = tables
    power_table, state, force, jacobian, column = scratch
    with_matrix = matrix.shape[0] > 0
    nb, samples = values.shape
    residual[:] = 0.0
    matrix[:] = 0.0
    held = mean_is_heading(linear, factors)
    for n in range(samples):
        orbit_state(values, rates, factors, w, u, n, state)
        if held:
            state[3] -= u[2, 0]
        accelerations(linear, coefficients, powers, modulus, strength, state, power_table, force, jacobian)
        for c in range(nb):
            project = weights[c] * values[c, n]
            for k in range(3):
                residual[k * nb + c] -= project * force[k]
        if not with_matrix:
            continue
        for b in range(nb):
            value = values[b, n]
            rate = rates[b, n] * w if factors[b] > 0.0 else rates[b, n]
            roll_rate = rate if factors[b] > 0.0 else 0.0
            for k in range(3):
                column[k, 0, b] = -jacobian[k, 0] * rate
                column[k, 1, b] = -jacobian[k, 1] * value - jacobian[k, 2] * roll_rate
                column[k, 2, b] = 0.0 if held and b == 0 else -jacobian[k, 3] * rate
        for c in range(nb):
            project = weights[c] * values[c, n]
            for k in range(3):
                for j in range(3):
                    for b in range(nb):
                        matrix[k * nb + c, j * nb + b] += project * column[k, j, b]
    if linear.shape[1] > 4:
        add_steering(linear, factors, w, u, residual, matrix)
    first = 1 if factors[0] == 0.0 else 0
    for k in range(3):
        for b in range(nb):
            inertia = (factors[b] * w) ** 2
            residual[k * nb + b] -= inertia * u[k, b]
            if with_matrix:
                matrix[k * nb + b, k * nb + b] -= inertia
        if first == 1:
            residual[k * nb] -= mean[k]
        residual[k * nb + first] -= cos[k]
        residual[k * nb + first + 1] -= sin[k]


@inner
def relative_step(step, u):
    """Largest step in any unknown relative to its mode's amplitude, so that metres and radians count alike.

    Notes
    -----
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
    """Copy coefficients (3, b) from ``u`` into ``out``.

    Notes
    -----
    Source: none needed; array assignment would compile to far more code.
    """
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
def newton(system, tables, u, strength, work):
    """Damped Newton from ``u``, in place; returns (0 converged, 1 not converged, 2 singular) and a sign.

    The sign is that of the determinant of the derivative at the solution: it changes from one side of a fold to the other.

    A damped step is taken when the next step, with the old matrix, is shorter (the natural monotonicity test): the
    result does not depend on how the equations are scaled.

    Notes
    -----
    Source: [Krack19] (Newton's method on balance equations).
    """
    residual, no_matrix, factored, pivots, trial, step, after, scratch = work
    for _ in range(40):
        balance(system, tables, u, strength, residual, factored, scratch)
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
            balance(system, tables, trial, strength, residual, no_matrix, scratch)
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

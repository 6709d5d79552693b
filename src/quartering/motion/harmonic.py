"""Harmonic balance of any order: periodic motions of many conditions through one compiled kernel."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.motion.basis import basis
from quartering.motion.dense import lu_factor, lu_solve
from quartering.motion.equations import Floats, System
from quartering.motion.polynomial import accelerations
from quartering.motion.status import Status
from quartering.threads import in_threads

_CONVERGED, _BY_HOMOTOPY = int(Status.CONVERGED), int(Status.CONVERGED_BY_HOMOTOPY)
_NO_MOTION, _SINGULAR, _NOT_FINITE = int(Status.NO_MOTION_FOUND), int(Status.SINGULAR), int(Status.NOT_FINITE)


@njit(cache=True, nogil=True)
def orbit_state(values, rates, factors, w, u, n, state):  # type: ignore[no-untyped-def]
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


@njit(cache=True, nogil=True)
def balance(system, tables, u, strength, with_matrix, residual, matrix, scratch):  # type: ignore[no-untyped-def]
    """Residual of the balance equations at ``u`` and, if asked for, its exact derivative.

    Parameters
    ----------
    system : tuple    one condition: linear, coefficients, powers, modulus, mean, cos, sin, frequency
    tables : tuple    of a `Basis`: values, rates, factors, weights
    u : (3, b)        unknowns: mean, cos and sin coefficients of sway, roll, yaw
    strength : float  multiplies the nonlinear products
    residual : (3 b,), matrix : (3 b, 3 b)    out, mode by mode
    scratch : tuple   (4, 8), (4,), (3,), (3, 4), (3, 3, b) work arrays

    Notes
    -----
    Row (k, c) is projection c of acceleration minus right-hand side.  Source: [H71] eqs. (A-10), (A-11) for one
    harmonic, [Krack19] for more; exact for polynomials by the number of samples in the tables.
    """
    linear, coefficients, powers, modulus, mean, cos, sin, w = system
    values, rates, factors, weights = tables
    power_table, state, force, jacobian, column = scratch
    nb, samples = values.shape
    residual[:] = 0.0
    matrix[:] = 0.0
    for n in range(samples):
        orbit_state(values, rates, factors, w, u, n, state)
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
                column[k, 2, b] = -jacobian[k, 3] * rate
        for c in range(nb):
            project = weights[c] * values[c, n]
            for k in range(3):
                for j in range(3):
                    for b in range(nb):
                        matrix[k * nb + c, j * nb + b] += project * column[k, j, b]
    first = 1 if factors[0] == 0.0 else 0
    for k in range(3):
        for b in range(nb):
            inertia = (factors[b] * w) ** 2
            residual[k * nb + b] -= inertia * u[k, b]
            matrix[k * nb + b, k * nb + b] -= inertia
        if first == 1:
            residual[k * nb] -= mean[k]
        residual[k * nb + first] -= cos[k]
        residual[k * nb + first + 1] -= sin[k]


@njit(cache=True, nogil=True)
def _relative(step, u):  # type: ignore[no-untyped-def]
    """Largest step in any unknown relative to its mode's amplitude, so that metres and radians count alike."""
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


@njit(cache=True, nogil=True)
def _negative(a, out):  # type: ignore[no-untyped-def]
    for i in range(a.size):
        out[i] = -a[i]


@njit(cache=True, nogil=True)
def _copy(u, out):  # type: ignore[no-untyped-def]
    for k in range(3):
        for b in range(u.shape[1]):
            out[k, b] = u[k, b]


@njit(cache=True, nogil=True)
def _add(u, step, damping, out):  # type: ignore[no-untyped-def]
    nb = u.shape[1]
    for k in range(3):
        for b in range(nb):
            out[k, b] = u[k, b] + damping * step[k * nb + b]


@njit(cache=True, nogil=True)
def _newton(system, tables, u, strength, work):  # type: ignore[no-untyped-def]
    """Damped Newton from ``u``, in place; returns 0 converged, 1 not converged, 2 singular.

    A damped step is taken when the next step, with the old matrix, is shorter (the natural monotonicity test): the
    result does not depend on how the equations are scaled.
    """
    residual, matrix, factored, pivots, trial, step, after, scratch = work
    for _ in range(40):
        balance(system, tables, u, strength, True, residual, factored, scratch)
        _negative(residual, step)
        if not lu_factor(factored, pivots):
            return 2
        lu_solve(factored, pivots, step)
        _add(u, step, 1.0, trial)
        full = _relative(step, trial)
        if not full < 1e12:
            return 1
        damping = 1.0
        while True:
            _add(u, step, damping, trial)
            balance(system, tables, trial, strength, False, residual, matrix, scratch)
            _negative(residual, after)
            lu_solve(factored, pivots, after)
            left = _relative(after, trial)
            at_rounding = full < 1e-9 and left < 10.0 * full
            if left <= (1.0 - 0.25 * damping) * full or at_rounding:
                break
            damping *= 0.5
            if damping < 0.01:
                return 1
        _copy(trial, u)
        if damping == 1.0 and (left < 1e-13 or (full < 1e-9 and left > 0.01 * full)):
            _add(u, after, 1.0, u)
            return 0
    return 1


@njit(cache=True, nogil=True)
def _homotopy(system, tables, u, linear_motion, work):  # type: ignore[no-untyped-def]
    """Raise the nonlinear terms from nothing to full strength, in steps that shrink when one fails."""
    reached, advance = 0.0, 0.25
    kept = np.empty(u.shape, u.dtype)
    _copy(linear_motion, u)
    _copy(u, kept)
    while reached < 1.0 and advance > 1e-3:
        target = min(1.0, reached + advance)
        if _newton(system, tables, u, target, work) == 0:
            reached, advance = target, 1.5 * advance
            _copy(u, kept)
        else:
            _copy(kept, u)
            advance *= 0.5
    return reached >= 1.0


@njit(cache=True, nogil=True)
def _solve(first, last, linear, coefficients, powers, modulus, mean, cos, sin, frequency,
           values, rates, factors, weights, given_start, u, status, error):  # type: ignore[no-untyped-def]  # fmt: skip
    """Periodic motions of conditions first..last; u (n, 3, b) holds the start when `given_start`, then the result."""
    nb = values.shape[0]
    size = 3 * nb
    dtype = u.dtype
    scratch = (np.empty((4, 8), dtype), np.empty(4, dtype), np.empty(3, dtype), np.empty((3, 4), dtype),
               np.empty((3, 3, nb), dtype))  # fmt: skip
    work = (np.empty(size, dtype), np.empty((size, size), dtype), np.empty((size, size), dtype),
            np.empty(size, np.int64), np.empty((3, nb), dtype), np.empty(size, dtype), np.empty(size, dtype),
            scratch)  # fmt: skip
    residual, matrix = work[0], work[1]
    tables = (values, rates, factors, weights)
    linear_motion = np.zeros((3, nb), dtype)
    for i in range(first, last):
        system = (linear[i], coefficients[i], powers, modulus, mean[i], cos[i], sin[i], frequency[i])
        if status[i] != _CONVERGED:
            continue
        if given_start:
            outcome = _newton(system, tables, u[i], 1.0, work)
        else:
            linear_motion[:] = 0.0
            outcome = _newton(system, tables, linear_motion, 0.0, work)
            if outcome == 0:
                _copy(linear_motion, u[i])
                outcome = _newton(system, tables, u[i], 1.0, work)
                if outcome != 0 and _homotopy(system, tables, u[i], linear_motion, work):
                    outcome, status[i] = 0, _BY_HOMOTOPY
        if outcome != 0:
            status[i] = _SINGULAR if outcome == 2 else _NO_MOTION
            continue
        balance(system, tables, u[i], 1.0, False, residual, matrix, scratch)
        scale = 1e-300
        for k in range(3):
            scale = max(scale, abs(cos[i, k]), abs(sin[i, k]), abs(mean[i, k]))
        for row in range(size):
            error[i] = max(error[i], abs(residual[row]) / scale)


def orders_for(system: System, harmonics: int) -> tuple[int, ...]:
    """Harmonics that a motion of a system can hold up to a given order.

    Parameters
    ----------
    system : System
    harmonics : int    highest harmonic wanted, 1, 3, 5, ..

    Returns
    -------
    tuple of int    odd ones alone when the system is symmetric; else the mean and all

    Raises
    ------
    InputError    an even or non-positive number

    Notes
    -----
    Source: [H71] eq. (3) is unchanged by (y, t) -> (-y, t + T/2), so a motion that continues from the linear one has odd
    harmonics only; a steady force or an even term breaks this.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}
    >>> orders_for(Model(np.eye(3), terms, 1.0, (0, 1, 0), (0, 0, 0)).system, 5)
    (1, 3, 5)
    >>> orders_for(Model(np.eye(3), terms, 1.0, (0, 1, 0), (0, 0, 0), force_mean=(0, 0.1, 0)).system, 3)
    (0, 1, 2, 3)
    """
    if harmonics < 1 or harmonics % 2 == 0:
        raise InputError(f"harmonics={harmonics}: give an odd number, 1 (the paper's method), 3, 5, 7, ...")
    return tuple(range(1, harmonics + 1, 2)) if system.symmetric else tuple(range(harmonics + 1))


def harmonic_balance(
    system: System, orders: tuple[int, ...], start: Floats | None = None
) -> tuple[Floats, NDArray[np.int8], Floats]:
    """Periodic motions of a batch of conditions by harmonic balance.

    Parameters
    ----------
    system : System                   n conditions
    orders : tuple of int             harmonics kept (see `orders_for`)
    start : (n, 3, b), optional       start of Newton's method; by default the linear solution

    Returns
    -------
    u : (n, 3, b) float       coefficients of sway [m], roll, yaw [rad]: cos and sin of each harmonic in turn; in front of
                              them, when 0 is among the orders, mean sway velocity, heel and yaw rate; NaN where none found
    status : (n,) int8        `Status`
    residual : (n,) float     largest imbalance relative to the excitation

    Notes
    -----
    Source: [H71] eqs. (A-10), (A-11) (one harmonic), [Krack19].  Several motions may exist: this is the one reached by
    damped Newton from the linear solution or, failing that, by raising the nonlinear terms step by step.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}
    >>> u, status, _ = harmonic_balance(Model(np.eye(3), terms, 1.0, (0, 0.01, 0), (0, 0, 0)).system, (1,))
    >>> bool(np.allclose(u[0, 1], [0.0, 0.1])), int(status[0])
    (True, 0)
    """
    table = basis(orders, system.degree, system.has_modulus)
    n = system.count
    u = np.zeros((n, 3, table.factors.size)) if start is None else np.array(start, dtype=float)
    status, residual = np.where(system.finite, _CONVERGED, _NOT_FINITE).astype(np.int8), np.zeros(n)
    in_threads(_solve, n, *system.kernel_arrays(), *table.arrays, start is not None, u, status, residual)
    failed = (status != _CONVERGED) & (status != _BY_HOMOTOPY)
    u[failed], residual[failed] = np.nan, np.nan
    return u, status, residual

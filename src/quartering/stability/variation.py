"""The equations of first variation about a periodic motion: their harmonics and their solution over a cycle."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.compiled import kernel
from quartering.motion.abreast import WIDTH, gather, gather_motions, raise_powers, rows_abreast, slopes, states
from quartering.motion.basis import basis
from quartering.motion.equations import Floats, System
from quartering.motion.polynomial import accelerations
from quartering.motion.steering import turning
from quartering.threads import in_threads

EVEN_HARMONICS = (0, 2, 4, 6)
"""Harmonics of the variational matrix that first-order theory uses."""


@kernel
def _harmonics(first, last, linear, coefficients, powers, modulus, mean, cos, sin, frequency,
               values, rates, factors, weights, u, project, out, along):  # fmt: skip
    """d(acceleration)/d(state) along each motion (n, samples, 3, 4), and its projections (m, samples) in out (n, m, 3, 4)."""
    nb, wanted = values.shape[0], project.shape[0]
    own, room, degrees = rows_abreast(powers, nb)
    source = (linear, coefficients, powers, modulus, mean, cos, sin, frequency)
    system = (own[0], own[1], powers, modulus, own[2], own[3], own[4], own[5])
    tables = (values, rates, factors, weights)
    state, table, _, jacobian, _ = room
    motion, sums = np.empty((3, nb, WIDTH)), np.empty((wanted, 3, 4, WIDTH))
    for begin in range(first, last, WIDTH):
        gather(begin, last, source, system)
        gather_motions(begin, last, u, motion)
        count = min(WIDTH, last - begin)
        for n in range(values.shape[1]):
            states(tables, n, motion, own[5], state)
            raise_powers(state, degrees, table)
            slopes(own[0], own[1], powers, modulus, state, table, jacobian)
            for k in range(3):
                for s in range(4):
                    for l in range(count):
                        along[begin + l, n, k, s] = jacobian[k, s, l]
                    for m in range(wanted):
                        for l in range(WIDTH):
                            before = sums[m, k, s, l] if n > 0 else 0.0
                            sums[m, k, s, l] = before + project[m, n] * jacobian[k, s, l]
        for l in range(count):
            for m in range(wanted):
                for k in range(3):
                    for s in range(4):
                        out[begin + l, m, k, s] = sums[m, k, s, l]


def variational_harmonics(
    system: System, u: Floats, orders: tuple[int, ...], harmonics: tuple[int, ...] = EVEN_HARMONICS
) -> NDArray[np.complex128]:
    """Harmonics of the variational matrix along periodic motions.

    Parameters
    ----------
    system : System           n conditions
    u : (n, 3, b) float       motions, as from `harmonic_balance`
    orders : tuple of int     their harmonics
    harmonics : (m,) int      wanted, 0 first; even ones where all of `orders` are odd (the others vanish)

    Returns
    -------
    (n, m, 3, 4) complex    phasors J_m of d(v', p', r')/d(v, phi, p, r): J(t) = J_0 + Re sum_m J_m e^{i m w t}

    Notes
    -----
    Exact for polynomial terms by the number of samples.  Source: [H71] eqs. (8)-(10), first-order form.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> from quartering.motion.steady import steady_motions
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}
    >>> system = Model(np.eye(3), terms, 1.0, (0, 0.01, 0), (0, 0, 0)).system
    >>> u, orders, *_ = steady_motions(system)
    >>> variational_harmonics(system, u, orders)[0, 0, 1].real.round(12).tolist()
    [0.0, -1.0, -0.1, 0.0]
    """
    return variation_along(system, u, orders, harmonics)[0]


def variation_along(
    system: System, u: Floats, orders: tuple[int, ...], harmonics: tuple[int, ...] = EVEN_HARMONICS
) -> tuple[NDArray[np.complex128], Floats]:
    """Harmonics of the variational matrix along periodic motions, and the matrix itself at equal intervals.

    Parameters
    ----------
    system, u, orders, harmonics    as in `variational_harmonics`

    Returns
    -------
    harmonics : (n, m, 3, 4) complex    as from `variational_harmonics`
    along : (n, s, 3, 4) float          at s equal intervals from phase 0, over half a cycle where all orders are odd

    Notes
    -----
    Source: [H71] eq. (8).

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}
    >>> system = Model(np.eye(3), terms, 1.0, (0, 0.01, 0), (0, 0, 0)).system
    >>> variation_along(system, np.zeros((1, 3, 2)), (1,))[1][0, 0, 1].tolist()
    [0.0, -1.0, -0.1, 0.0]
    """
    u = turning(system.linear, u, orders)
    # The matrix has degree one less than the equations; a margin of harmonics keeps the last one free of aliases.
    table = basis(orders, system.degree - 2, system.has_modulus, extra=2 * max(harmonics) + 2)
    samples = table.values.shape[1]
    half_cycle = all(h % 2 == 1 for h in orders)
    phases = (np.pi if half_cycle else 2 * np.pi) * np.arange(samples) / samples
    rows = [np.full(samples, 1.0 / samples)]
    for m in harmonics[1:]:
        rows += [2.0 / samples * np.cos(m * phases), 2.0 / samples * np.sin(m * phases)]
    out = np.empty((system.count, len(rows), 3, 4))
    along = np.empty((system.count, samples, 3, 4))
    in_threads(
        _harmonics,
        system.count,
        *system.kernel_arrays(),
        *table.arrays,
        np.require(u, requirements=("C", "W")),
        np.array(rows),
        out,
        along,
    )
    phasors = np.empty((system.count, len(harmonics), 3, 4), dtype=complex)
    phasors[:, 0] = out[:, 0]
    phasors[:, 1:] = out[:, 1::2] - 1j * out[:, 2::2]
    return phasors, along


@kernel
def jacobian_at(system, orders, u, cos1, sin1, scratch, matrix):
    """Rows v', p', r' of the variational matrix (3, 4) at the phase whose cosine and sine are given.

    Notes
    -----
    Source: [H71] eq. (8).
    """
    linear, coefficients, powers, modulus, w = system
    power_table, state, force = scratch
    state[:] = 0.0
    column, reached = 0, 0
    c, s = 1.0, 0.0
    for h in orders:
        if h == 0:
            state[0] += u[0, 0]
            state[1] += u[1, 0]
            state[3] += u[2, 0]
            column = 1
            continue
        for _ in range(h - reached):
            c, s = c * cos1 - s * sin1, s * cos1 + c * sin1
        reached = h
        rate = h * w
        state[0] += rate * (c * u[0, column + 1] - s * u[0, column])
        state[1] += c * u[1, column] + s * u[1, column + 1]
        state[2] += rate * (c * u[1, column + 1] - s * u[1, column])
        state[3] += rate * (c * u[2, column + 1] - s * u[2, column])
        column += 2
    accelerations(linear, coefficients, powers, modulus, 1.0, state, power_table, force, matrix)


@kernel
def _slope(matrix, phi, out):
    """Derivative of the state transition matrix phi (4, 4), rows (v, phi, p, r)."""
    for c in range(4):
        out[1, c] = phi[2, c]
        for k in range(3):
            row = 0 if k == 0 else k + 1
            out[row, c] = (
                matrix[k, 0] * phi[0, c]
                + matrix[k, 1] * phi[1, c]
                + matrix[k, 2] * phi[2, c]
                + matrix[k, 3] * phi[3, c]
            )


@kernel
def _transition(first, last, linear, coefficients, powers, modulus, frequency,
                orders, u, span, steps, transition):  # fmt: skip
    """Fourth-order Runge-Kutta solution (n, 4, 4) of the variational equations over ``span`` cycles."""
    scratch = (np.empty((4, 8)), np.empty(4), np.empty(3))
    begin, middle, end = np.empty((3, 4)), np.empty((3, 4)), np.empty((3, 4))
    phi, stage = np.empty((4, 4)), np.empty((4, 4))
    k1, k2, k3, k4 = np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4))
    for i in range(first, last):
        system = (linear[i], coefficients[i], powers, modulus, frequency[i])
        h = 2.0 * np.pi * span / (frequency[i] * steps[i])
        half_angle = np.pi * span / steps[i]
        for a in range(4):
            for b in range(4):
                phi[a, b] = 1.0 if a == b else 0.0
        jacobian_at(system, orders, u[i], 1.0, 0.0, scratch, end)
        for n in range(steps[i]):
            for a in range(3):
                for b in range(4):
                    begin[a, b] = end[a, b]
            angle = (2 * n + 1) * half_angle
            jacobian_at(system, orders, u[i], np.cos(angle), np.sin(angle), scratch, middle)
            angle = (2 * n + 2) * half_angle
            jacobian_at(system, orders, u[i], np.cos(angle), np.sin(angle), scratch, end)
            _slope(begin, phi, k1)
            for a in range(4):
                for b in range(4):
                    stage[a, b] = phi[a, b] + 0.5 * h * k1[a, b]
            _slope(middle, stage, k2)
            for a in range(4):
                for b in range(4):
                    stage[a, b] = phi[a, b] + 0.5 * h * k2[a, b]
            _slope(middle, stage, k3)
            for a in range(4):
                for b in range(4):
                    stage[a, b] = phi[a, b] + h * k3[a, b]
            _slope(end, stage, k4)
            for a in range(4):
                for b in range(4):
                    phi[a, b] += h / 6.0 * (k1[a, b] + 2.0 * k2[a, b] + 2.0 * k3[a, b] + k4[a, b])
        for a in range(4):
            for b in range(4):
                transition[i, a, b] = phi[a, b]


def transition_matrices(system: System, u: Floats, orders: tuple[int, ...], span: float, steps: np.ndarray) -> Floats:
    """State transition matrices of the variational equations, from phase zero over part of a cycle.

    Parameters
    ----------
    system : System           n conditions
    u : (n, 3, b) float       motions, as from `harmonic_balance`
    orders : tuple of int     their harmonics
    span : float              fraction of the wave's period: 1 for the monodromy matrix, 0.5 for its symmetric root
    steps : (n,) int          Runge-Kutta steps over the span

    Returns
    -------
    (n, 4, 4) float           state order (v, phi, p, r)

    Notes
    -----
    Fourth-order Runge-Kutta; the error falls with the fourth power of the number of steps.
    Source: [H71] eq. (8), as a first-order system.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> from quartering.motion.steady import steady_motions
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}
    >>> system = Model(np.eye(3), terms, 1.0, (0, 0.01, 0), (0, 0, 0)).system
    >>> u, orders, *_ = steady_motions(system)
    >>> phi = transition_matrices(system, u, orders, 1.0, np.array([200]))[0]
    >>> bool(np.isclose(phi[0, 0], np.exp(-2 * np.pi)))
    True
    """
    transition = np.empty((system.count, 4, 4))
    in_threads(
        _transition, system.count, *system.kernel_arrays()[:4], system.frequency, np.array(orders, dtype=np.int64), u,
        span, steps.astype(np.int64), transition,
    )  # fmt: skip
    return transition

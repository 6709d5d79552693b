"""Exact derivatives of K2, of the index and of the leading exponent."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.basis import harmonics_at, waves_at
from quartering.motion.equations.steering import HEADING, holds_heading, state_matrix, turning
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.derivative import (
    change_of_states,
    change_of_variables,
    of_states,
    products,
    states_along,
    table_at,
    variables_along,
)
from quartering.stability.first_order import roll_mode
from quartering.stability.variational.floquet import steps_for
from quartering.stability.variational.transition import transition_matrices

Complex = NDArray[np.complex128]

_VELOCITIES = [0, 2, 3]
_PHASES, _PHASES_OF_KINKS = 32, 4096
_ACCURACY = 1e-10
_DEFECTIVE, _SAME = 1e6, 1e-7
_TINY = 1e-30


@dataclass(frozen=True, eq=False)
class StabilityChange:
    """Derivatives of the stability of one motion by m parameters.

    Parameters
    ----------
    k2 : (m,) float          [1/s2]; NaN where first-order theory has no roll mode
    index : (m,) float       S = -K2/(2 n2) [1/s]
    exponent : (m,) float    leading Floquet exponent [1/s]; NaN where it has no derivative
    why : str                why not; empty where it has
    """

    k2: Floats
    index: Floats
    exponent: Floats
    why: str


def change_of_stability(
    system: System, changes: System, u: Floats, du: Floats, orders: tuple[int, ...], rate: float
) -> StabilityChange:
    """Derivatives of K2, index and leading exponent of a periodic motion by parameters of its equations.

    system: one condition
    changes: derivatives of its arrays by each of m parameters, with its products
    u (3, b): the motion
    du (m, 3, b): its derivatives, from `change_of_motion`
    orders: harmonics
    rate: from `fastest_rate`, to choose steps [1/s]

    K2 follows from the mean of the variational matrix A(t), whose derivative along the motion is exact. The exponent is
    lambda with y' = A y = y(t) e^{lambda t}: at phases held, d lambda = <l dA r> + (lambda - <l A r>) d w / w, the mean over
    a cycle, with the right and left periodic vectors r, l and l r = 1. The mean is taken at equal phases: to rounding where
    the products are smooth, to 1e-6 with a modulus, drag by strips or a spline.  Source: [H71] eqs. (8)-(13); perturbation
    of a simple eigenvalue (closed form).  Valid: the leading multiplier is simple.
    """
    u, du = turning(system.linear, u[None], orders)[0], turning(np.repeat(system.linear, len(du), axis=0), du, orders)
    symmetric = all(h % 2 == 1 for h in orders)
    span = 0.5 if symmetric else 1.0
    per_harmonic = _PHASES if system.smooth else _PHASES_OF_KINKS // max(orders)
    count = int(2 * span * per_harmonic * max(orders))
    phases = 2 * np.pi * span * np.arange(count) / count
    rows, moved = _rows(system, changes, u, du, orders, phases)
    k2, index = _first_order(rows.mean(axis=0), moved.mean(axis=1), system.linear, changes.linear)
    value, left, right, why = _leading_mode(system, u, orders, span, count, rate)
    if why:
        return StabilityChange(k2, index, np.full(len(du), np.nan), why)
    whole = state_matrix(rows, np.repeat(system.linear, count, axis=0))
    mean = np.einsum("na,nab,nb->", left, whole, right) / count
    push = left[:, _VELOCITIES]
    slope = np.einsum("nk,mnks,ns->m", push, moved, right[:, :4]) / count
    slope += np.einsum("nk,mks,ns->m", push, changes.linear[:, :3, 4:], right[:, 4:]) / count
    slope += (value - mean) * changes.frequency / system.frequency
    return StabilityChange(k2, index, slope.real, "")


def _rows(
    system: System, changes: System, u: Floats, du: Floats, orders: tuple[int, ...], phases: Floats
) -> tuple[Floats, Floats]:
    """Rows v', p', r' of the variational matrix (s, 3, 4) and their derivatives (m, s, 3, 4)."""
    w = float(system.frequency[0])
    states = states_along(u[None], system.frequency, orders, phases)[0]
    moved = change_of_states(u, du, w, changes.frequency, orders, phases)
    half = 0.5 * (phases[1] - phases[0])
    beside = [(states_along(u[None], system.frequency, orders, at)[0], at) for at in (phases - half, phases + half)]
    rows = system.linear[0, :3, :4] + np.zeros((len(phases), 1, 1))
    changed = changes.linear[:, None, :3, :4] + np.zeros((len(du), len(phases), 1, 1))
    for part in (_by_products, _by_table, _by_strips):
        own, change = part(system, changes, states, moved, phases, beside)
        rows, changed = rows + own, changed + change
    return rows, changed


Beside = list[tuple[Floats, Floats]]
"""States and phases half an interval before and after each phase."""


def _mean_sign(before: Floats, after: Floats) -> Floats:
    """Sign averaged over the interval round a phase: a jump within it keeps its place to second order."""
    return np.asarray((before + after) / np.maximum(np.abs(before) + np.abs(after), _TINY))


def _by_products(
    system: System, changes: System, states: Floats, moved: Floats, phases: Floats, beside: Beside
) -> tuple[Floats, Floats]:
    """Part (s, 3, 4) of the products in the variational matrix, and its derivatives (m, s, 3, 4)."""
    variables = variables_along(system, states, phases)
    by_parameter = change_of_variables(system, changes, moved, phases)
    sign = _mean_sign(*(variables_along(system, *one) for one in beside))
    product, by_state = products(variables, sign, system.powers, system.modulus), of_states(system)
    count = variables.shape[1]
    slope = np.stack([product((v,)) for v in range(count)], axis=2) @ by_state
    rows = np.einsum("kt,nts->nks", system.coefficients[0], slope)
    changed = np.tensordot(changes.coefficients, slope, axes=(2, 1)).transpose(0, 2, 1, 3)
    for q in range(count):
        bend = np.stack([product((v, q)) for v in range(count)], axis=2) @ by_state
        changed = changed + by_parameter[:, :, q, None, None] * np.einsum("kt,nts->nks", system.coefficients[0], bend)
    return rows, changed


def _by_table(
    system: System, changes: System, states: Floats, moved: Floats, _phases: Floats, _beside: Beside
) -> tuple[Floats, Floats]:
    """Part of the table of the restoring moment, as `_by_products`."""
    rows, changed = np.zeros((len(states), 3, 4)), np.zeros((*moved.shape[:2], 3, 4))
    if system.knots.shape[1] == 0:
        return rows, changed
    knots, cubics, arm = system.knots[0], system.cubics[0], system.arm[0]
    slope, bend, piece = table_at(knots, cubics, states[:, 1])
    x, size = np.abs(states[:, 1]) - knots[piece], np.sign(states[:, 1])
    table = changes.cubics[:, piece]  # (m, s, 4)
    by_table = table[:, :, 1] + x * (2 * table[:, :, 2] + 3 * x * table[:, :, 3])
    by_table -= bend * size * changes.knots[:, piece]
    rows[:, :, 1] = slope[:, None] * arm
    changed[..., 1] = (by_table + bend * moved[:, :, 1])[:, :, None] * arm + slope[:, None] * changes.arm[:, None, :]
    return rows, changed


def _by_strips(
    system: System, changes: System, states: Floats, moved: Floats, phases: Floats, beside: Beside
) -> tuple[Floats, Floats]:
    """Part of the drag by strips, as `_by_products`: -2 |q| e e^T with the minus in ``push``."""
    rows, changed = np.zeros((len(states), 3, 4)), np.zeros((*moved.shape[:2], 3, 4))
    if not system.has_drag:
        return rows, changed
    form, water, push = system.strips[0, :, :3], system.strips[0, :, 3:], system.push[0]

    def passing(at: Floats, turn: Floats) -> Floats:
        return np.asarray(at[:, _VELOCITIES] @ form.T - waves_at(system.periods * turn, 3)[1:].T @ water.T)

    q, sign = passing(states, phases), _mean_sign(*(passing(*one) for one in beside))
    rows[:, :, _VELOCITIES] = push @ np.einsum("nz,za,zb->nab", 2 * np.abs(q), form, form)
    turn = waves_at(system.periods * phases, 3)[1:].T
    for i in range(len(moved)):
        by_form, by_water = changes.strips[i, :, :3], changes.strips[i, :, 3:]
        dq = moved[i][:, _VELOCITIES] @ form.T + states[:, _VELOCITIES] @ by_form.T - turn @ by_water.T
        bent = np.einsum("nz,za,zb->nab", 2 * sign * dq, form, form)
        if by_form.any():
            once = np.einsum("nz,za,zb->nab", 2 * np.abs(q), by_form, form)
            bent = bent + once + once.transpose(0, 2, 1)
        plain = np.einsum("nz,za,zb->nab", 2 * np.abs(q), form, form)
        changed[i][:, :, _VELOCITIES] = push @ bent + changes.push[i] @ plain
    return rows, changed


def _first_order(rows: Floats, moved: Floats, linear: Floats, changed: Floats) -> tuple[Floats, Floats]:
    """Derivatives of K2 and of the index from the mean variational matrix (3, 4), by a complex step: exact."""
    if not rows[1, 1] < 0:
        return np.full(len(moved), np.nan), np.full(len(moved), np.nan)
    n2, _, rate = roll_mode(rows + 1j * _TINY * moved, linear + 1j * _TINY * changed)
    return (2 * n2 * rate).imag / _TINY, -rate.imag / _TINY


def _leading_mode(
    system: System, u: Floats, orders: tuple[int, ...], span: float, count: int, rate: float
) -> tuple[complex, Complex, Complex, str]:
    """Leading exponent [1/s], its left and right vectors (count, s) at the phases, and why it has no derivative."""
    maps = _maps(system, u, orders, span, count, rate)
    over = np.eye(system.states)
    for one in maps:
        over = one @ over
    if system.states > HEADING and not holds_heading(system.linear)[0]:
        over[HEADING, HEADING] = 0.0  # neutral: it decides nothing
    values, vectors = np.linalg.eig(over.astype(complex))
    first = int(np.argmax(np.abs(values)))
    mu, rows = values[first], np.linalg.pinv(vectors)
    left, right = np.empty((count, system.states), complex), np.empty((count, system.states), complex)
    others = np.delete(values, first)
    together = np.abs(np.abs(others) - abs(mu)) < _SAME * abs(mu)
    if np.linalg.norm(rows[first]) > _DEFECTIVE or (np.abs(others - mu) < _SAME * abs(mu)).any():
        return 0.0, left, right, "two leading multipliers meet: the exponent has no derivative there"
    if (together & (np.abs(others - mu.conjugate()) > _SAME * abs(mu))).any():
        return 0.0, left, right, "two modes lead together: which of them leads changes here"
    fall = mu ** (-1.0 / count)
    right[0], last = vectors[:, first], rows[first]
    for n in range(count - 1):
        right[n + 1] = maps[n] @ right[n] * fall
    for n in reversed(range(count)):
        last = left[n] = last @ maps[n] * fall
    return complex(np.log(mu)) * float(system.frequency[0]) / (2 * np.pi * span), left, right, ""


def _maps(system: System, u: Floats, orders: tuple[int, ...], span: float, count: int, rate: float) -> Floats:
    """Transition matrices (count, s, s) from each phase to the next: the motion turned to begin there."""
    first = int(orders[0] == 0)
    values, _, _ = harmonics_at(orders, 2 * np.pi * span * np.arange(count) / count)
    cos, sin = values[first::2], values[first + 1 :: 2]
    begun = np.repeat(u[None], count, axis=0)
    a, b = u[:, first::2, None], u[:, first + 1 :: 2, None]
    begun[:, :, first::2] = (a * cos + b * sin).transpose(2, 0, 1)
    begun[:, :, first + 1 :: 2] = (b * cos - a * sin).transpose(2, 0, 1)
    every = system.each(lambda array: np.repeat(array, count, axis=0))
    every = every.begun_at(2 * np.pi * span * np.arange(count) / count)
    total = steps_for(system.frequency, span, np.array([rate]), max(orders), _ACCURACY)
    steps = np.full(count, -(-int(total[0]) // count))
    return transition_matrices(every, begun, orders, span / count, steps)

"""Exact derivatives of a periodic motion by the implicit function theorem."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.basis import harmonics_at, waves_at
from quartering.motion.equations.program import PLAIN
from quartering.motion.equations.system import PER_CONDITION, Floats, System
from quartering.motion.steady.balance import balance_of

OFFSETS = np.array([-2.0, -1.0, 1.0, 2.0])
"""Steps away at which `difference` wants its function."""
_WEIGHTS = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
_STEP = 1e-3
_HIGHEST = 8


def difference(values: Floats, step: float) -> Floats:
    """Derivative of a smooth function by central differences extrapolated to fourth order.

    values (4, ...): of the function at `OFFSETS` times the step
    Returns (...): exact but for rounding for polynomials to the fourth degree

    Source: closed form (Richardson extrapolation).
    """
    return np.asarray(np.tensordot(_WEIGHTS, values, 1) / step)


def change_of_motion(system: System, changes: System, u: Floats, orders: tuple[int, ...]) -> Floats:
    """Derivatives of a periodic motion by parameters of its equations.

    system: one condition
    changes: derivatives of its arrays by each of m parameters, with its products
    u (3, b): the motion, as from `harmonic_balance`
    orders: its harmonics
    Returns (m, 3, b)

    du = -R_u^-1 dR, with the residual R of the balance equations differenced at the motion held: without error where it is a
    polynomial in the parameter, as in every coefficient and in the water's velocity of a cubic.  Singular at a fold.
    Source: implicit function theorem; [Krack19].
    """
    here, matrix = balance_of(system, orders, u)
    by_frequency = np.zeros_like(here)
    if changes.frequency.any():
        others = (replace(system, frequency=system.frequency * (1 + _STEP * offset)) for offset in OFFSETS)
        turned = np.array([balance_of(other, orders, u, with_matrix=False)[0] for other in others])
        by_frequency = difference(turned, _STEP) / system.frequency
    right = np.empty((changes.count, here.size))
    for i in range(changes.count):
        moved = (_moved(system, changes, i, _STEP * offset) for offset in OFFSETS)
        around = np.array([balance_of(one, orders, u, with_matrix=False)[0] for one in moved])
        right[i] = difference(around, _STEP) + changes.frequency[i] * by_frequency
    return np.asarray(-np.linalg.solve(matrix, right.T).T.reshape(-1, *u.shape))


def _moved(system: System, changes: System, i: int, step: float) -> System:
    """The system a step along one of its changes, its frequency held."""
    names = [name for name in PER_CONDITION if name != "frequency"]
    return replace(system, **{name: getattr(system, name) + step * getattr(changes, name)[[i]] for name in names})


def states_along(u: Floats, frequency: Floats, orders: tuple[int, ...], phases: Floats) -> Floats:
    """States of periodic motions at given phases.

    u (n, 3, b): motions, as from `harmonic_balance`
    frequency (n,): [rad/s]
    orders: their harmonics
    phases (s,): [rad]
    Returns (n, s, 4): v, phi, p, r

    Source: [H71] eq. (A-3), for any set of harmonics.
    """
    values, rates, factors = harmonics_at(orders, phases)
    speed = np.where(factors > 0, frequency[:, None], 1.0)
    v, r = ((u[:, k] * speed) @ rates for k in (0, 2))
    p = (u[:, 1] * speed * (factors > 0)) @ rates
    return np.stack([v, u[:, 1] @ values, p, r], axis=2)


def change_of_states(
    u: Floats, du: Floats, frequency: float, turned: Floats, orders: tuple[int, ...], phases: Floats
) -> Floats:
    """Derivatives of the states of one motion at given phases.

    u (3, b): the motion
    du (m, 3, b): its derivatives by m parameters
    frequency: [rad/s]
    turned (m,): derivatives of the frequency
    orders: harmonics
    phases (s,): [rad], held
    Returns (m, s, 4)

    Source: closed form (`states_along`).
    """
    swinging = u.copy()
    if orders[0] == 0:
        swinging[:, 0] = 0.0
    velocities = states_along(swinging[None], np.ones(1), orders, phases)
    velocities[:, :, 1] = 0.0
    return states_along(du, np.full(len(du), frequency), orders, phases) + turned[:, None, None] * velocities


def variables_along(system: System, states: Floats, phases: Floats) -> Floats:
    """What the products of a system's first condition are made of, at given phases.

    states (..., s, 4): v, phi, p, r
    phases (s,): [rad]
    Returns (..., s, 4 + e): with the variables that known inputs enter
    """
    return _with_inputs(system, states, system.inputs[0], phases)


def _with_inputs(system: System, states: Floats, inputs: Floats, phases: Floats) -> Floats:
    series = np.swapaxes(inputs @ waves_at(system.periods * phases, inputs.shape[-1]), -1, -2)  # (..., s, e)
    own = np.where(system.extra >= 0, states[..., np.maximum(system.extra, 0)], 0.0)
    return np.concatenate([states, own + series], axis=-1)


def change_of_variables(system: System, changes: System, moved: Floats, phases: Floats) -> Floats:
    """Derivatives (m, s, 4 + e) of the variables of products, from those of the states ``moved`` (m, s, 4) and the inputs."""
    return _with_inputs(system, moved, changes.inputs, phases)


def of_states(system: System) -> Floats:
    """Derivatives (4 + e, 4) of the variables of products by the states: ones and zeros."""
    return np.concatenate([np.eye(PLAIN), np.equal.outer(system.extra, np.arange(PLAIN)).astype(float)])


def products(
    variables: Floats, sign: Floats, powers: NDArray[np.int64], modulus: NDArray[np.int64]
) -> Callable[[tuple[int, ...]], Floats]:
    """The nonlinear products, and their derivatives of any order by the variables they are made of.

    variables (s, v): v, phi, p, r, then those that known inputs enter
    sign (s, v): of each, or its mean over some neighbourhood
    powers (t, v): of each product, as in `System`

    |x| is sign(x) x: every product is a monomial with a sign.  Source: closed form.
    """
    count = variables.shape[1]
    raised = [_powers(variables[:, v]) for v in range(count)]
    factor = np.ones((len(variables), len(powers)))
    full = powers.copy()
    for v in range(count):
        barred = modulus == v + 1
        factor = np.where(barred, sign[:, [v]] * factor, factor)
        full[barred, v] += 1

    def derivative(by: tuple[int, ...]) -> Floats:
        left, value = full.copy(), factor
        for v in by:
            value = value * left[:, v]
            left[:, v] = np.maximum(left[:, v] - 1, 0)
        for v in range(count):
            value = value * raised[v][left[:, v]].T
        return np.asarray(value)

    return derivative


def _powers(x: Floats) -> Floats:
    """Powers 0 to 7 (8, ...) of an array."""
    return np.cumprod(np.concatenate([np.ones_like(x)[None], np.repeat(x[None], _HIGHEST - 1, axis=0)]), axis=0)


def table_at(knots: Floats, cubics: Floats, angle: Floats) -> tuple[Floats, Floats, NDArray[np.intp]]:
    """Slope and curvature of a table of cubics, odd in the angle, and which of its pieces holds each angle.

    knots (b,): as in `System`
    angle (s,): [rad]
    Returns slope, curvature (s,); piece (s,)

    >>> table_at(np.zeros(1), np.array([[0.0, 0.0, 0.0, 2.0]]), np.array([-0.5]))[:2]
    (array([1.5]), array([-6.]))
    """
    size = np.abs(angle)
    piece = np.clip(np.searchsorted(knots, size, side="left") - 1, 0, None)
    x, (_, b, c, d) = size - knots[piece], cubics[piece].T
    return b + x * (2 * c + 3 * x * d), np.sign(angle) * (2 * c + 6 * x * d), piece

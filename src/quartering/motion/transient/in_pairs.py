"""Histories of a ship whose equations are linear terms and products alone, two rows of realisations at a time.

What is read to find out which two columns a product is made of takes as long as the product; and a product waits for the one
before it. Two rows at a time share the reading, and the one goes on while the other waits.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.simd import all_at_most, every, load, size, store, where_less
from quartering.motion.equations.rates import WIDTH
from quartering.motion.equations.system import Floats, System
from quartering.motion.transient.excitation import excitation_at

ROWS = 2
"""Rows that go together."""


class Products(NamedTuple):
    """Accelerations of (v, p, r): ``linear^T state + by^T products`` of the state v, phi, p, r, whose columns stand in front.

    Parameters
    ----------
    linear : (4, 3) float    a row for each state
    factors : (m, 3) int     column to make, and the two it is made from, of what products are made of
    products : (t, 3) int    the same of what acts, and of what is made of it; column -1 where nothing is made of it
    by : (t, 3) float        what each of them does
    width : int              columns
    """

    linear: Floats
    factors: NDArray[np.int64]
    products: NDArray[np.int64]
    by: Floats
    width: int


def goes_in_pairs(system: System) -> bool:
    """Are there but linear terms and products of the state, without modulus, autopilot, known inputs, strips and table?"""
    beside = (system.inputs, system.strips, system.knots)
    return system.plain and not system.has_kinked_slopes and not any(array.shape[1] for array in beside)


def products_of(system: System) -> Products:
    """The equations of a system's first condition, for which `goes_in_pairs`.

    Source: [H71] eq. (3); no approximation, only the order of sums.

    >>> from quartering.motion.equations.model import Model
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_ppp": -0.2, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> made = products_of(model.system)  # p p in column 4 is a factor of p p p, which acts on roll
    >>> made.factors.tolist(), made.products.tolist(), made.by.tolist()
    ([[4, 2, 2]], [[-1, 4, 2]], [[0.0, -0.2, 0.0]])
    """
    program, linear = system.program, system.linear[0].T.copy()
    acts = dict[int, Floats]()
    for column, row in zip(program.products.tolist(), system.coefficients[0].T, strict=True):
        if column < program.states:  # a product that is a state itself
            linear[column] += row
        elif row.any():
            acts[column] = row
    links = program.links[: program.values, 1:].tolist()
    factors, products = list[list[int]](), list[list[int]]()
    for link in links:
        late = link[0] in acts or any(made[0] in link[1:] for made in products)
        (products if late else factors).append(link)
    by = np.array([acts.get(made[0], np.zeros(3)) for made in products]).reshape(-1, 3)
    taken = {column for link in links for column in link[1:]}
    return Products(
        np.ascontiguousarray(linear),
        np.array(factors, dtype=np.int64).reshape(-1, 3),
        np.array([[to if to in taken else -1, a, b] for to, a, b in products], dtype=np.int64).reshape(-1, 3),
        by,
        program.width,
    )


@batch_kernel
def _accelerations(equations, given, at, columns):
    """Accelerations of both rows by the waves, ``given``, and the states in ``columns`` (c, 2, W); products are made here."""
    linear, factors, products, by = equations.linear, equations.factors, equations.products, equations.by
    x, y, z = load(given, (at, 0, 0)), load(given, (at, 1, 0)), load(given, (at, 2, 0))
    u, v, w = load(given, (at, 0, 1)), load(given, (at, 1, 1)), load(given, (at, 2, 1))
    for s in range(4):
        one, two = load(columns, (s, 0)), load(columns, (s, 1))
        x += linear[s, 0] * one
        y += linear[s, 1] * one
        z += linear[s, 2] * one
        u += linear[s, 0] * two
        v += linear[s, 1] * two
        w += linear[s, 2] * two
    for i in range(factors.shape[0]):
        to, a, b = factors[i, 0], factors[i, 1], factors[i, 2]
        store(columns, (to, 0), load(columns, (a, 0)) * load(columns, (b, 0)))
        store(columns, (to, 1), load(columns, (a, 1)) * load(columns, (b, 1)))
    for i in range(products.shape[0]):
        a, b = products[i, 1], products[i, 2]
        one = load(columns, (a, 0)) * load(columns, (b, 0))
        x += by[i, 0] * one
        y += by[i, 1] * one
        z += by[i, 2] * one
        two = load(columns, (a, 1)) * load(columns, (b, 1))
        u += by[i, 0] * two
        v += by[i, 1] * two
        w += by[i, 2] * two
        if products[i, 0] >= 0:
            store(columns, (products[i, 0], 0), one)
            store(columns, (products[i, 0], 1), two)
    return x, y, z, u, v, w


@batch_kernel
def _onward(rate, s, r, weight, ahead, y, columns, total):
    """Add a stage's rate of state ``s`` of row ``r`` to the sum, and put the state of the next stage in the columns."""
    store(total, (s, r), load(total, (s, r)) + weight * rate)
    store(columns, (s, r), load(y, (s, r)) + ahead * rate)


@batch_kernel
def _step_sum(equations, h, given, y, columns, total):
    """Sum of the four rates of a Runge-Kutta step from the states ``y`` (4, 2, W), into ``total``.

    ``given`` (3, 3, 2, W): accelerations by the waves at the beginning, the middle and the end of the step
    """
    for s in range(4):
        for r in range(2):
            store(columns, (s, r), load(y, (s, r)))
            store(total, (s, r), every(0.0))
    for j in range(4):
        weight, ahead = (1.0 if j == 0 or j == 3 else 2.0), (0.5 * h if j < 2 else h)
        sway, roll, yaw, other_sway, other_roll, other_yaw = _accelerations(equations, given, (j + 1) // 2, columns)
        for r in range(2):  # the angle first, while its rate is still the stage's
            _onward(load(columns, (2, r)), 1, r, weight, ahead, y, columns, total)
        _onward(sway, 0, 0, weight, ahead, y, columns, total)
        _onward(roll, 2, 0, weight, ahead, y, columns, total)
        _onward(yaw, 3, 0, weight, ahead, y, columns, total)
        _onward(other_sway, 0, 1, weight, ahead, y, columns, total)
        _onward(other_roll, 2, 1, weight, ahead, y, columns, total)
        _onward(other_yaw, 3, 1, weight, ahead, y, columns, total)


@kernel
def march_in_pairs(first, last, equations, forcing, weights, h, begin, steps, limit, states, peak, square, capsize):
    """Runge-Kutta steps for pairs first..last of rows of realisations.

    As `_march` of `irregular`, ``states`` (rows, 4, W), an even number of rows in each group.
    """
    together, apart = forcing.shape[3], weights.shape[0] // 2
    given, columns = np.zeros((3, 3, 2, WIDTH)), np.zeros((equations.width, 2, WIDTH))
    y, total = np.zeros((4, 2, WIDTH)), np.zeros((4, 2, WIDTH))
    still, highest, sums = np.zeros((2, WIDTH)), np.zeros((2, WIDTH)), np.zeros((2, WIDTH))
    for pair in range(first, last):
        row = 2 * pair
        group, own = row // together, row % together
        for r in range(2):
            for l in range(WIDTH):
                still[r, l] = 1.0 if np.isnan(capsize[row + r, l]) else 0.0
            store(highest, r, load(peak, row + r))
            store(sums, r, load(square, row + r))
            for s in range(4):
                store(y, (s, r), load(states, (row + r, s)))
            for k in range(3):
                store(given, (2, k, r), excitation_at(forcing, weights, group, 0, 0, k, own + r))
        for n in range(steps):
            sample, place = n // apart, 2 * (n % apart)
            for k in range(3):
                for r in range(2):
                    store(given, (0, k, r), load(given, (2, k, r)))
                    for j in range(1, 3):
                        found = excitation_at(forcing, weights, group, sample, place + j, k, own + r)
                        store(given, (j, k, r), found)
            _step_sum(equations, h, given, y, columns, total)
            for r in range(2):
                going = load(still, r)
                for s in range(4):
                    store(y, (s, r), load(y, (s, r)) + going * (h / 6.0) * load(total, (s, r)))
                roll = size(load(y, (1, r)))
                most = load(highest, r)
                store(highest, r, where_less(most, roll, roll, most))
                store(sums, r, load(sums, r) + going * roll * roll)
                if not all_at_most(roll, limit):
                    for l in range(WIDTH):
                        if still[r, l] > 0.0 and not abs(y[1, r, l]) <= limit:
                            capsize[row + r, l], still[r, l] = begin + (n + 1) * h, 0.0
        for r in range(2):
            store(peak, row + r, load(highest, r))
            store(square, row + r, load(sums, r))
            for s in range(4):
                store(states, (row + r, s), load(y, (s, r)))

"""One ship, many histories: a fixed step in time for a row of them at once.

The coefficients are alike in all histories and the products of the state are made as a chain, each from two columns before it:
of 13 cubic products 7 squares serve all. So a step costs few operations, and they run over whole rows.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.compiled import abreast
from quartering.motion.abreast import WIDTH
from quartering.motion.equations import Floats, System
from quartering.motion.steering import HEADING, RUDDER
from quartering.motion.terms import KNOT, KNOT_CODE

TIMES, TIMES_MODULUS, BEYOND_KNOT = 0, 1, 2
_GROUP = 4
_ROLL, _ROLL_RATE, _YAW_RATE = 1, 2, 3


class Chain(NamedTuple):
    """The equations of one ship: ``rates = matrix columns``, the columns being the state and its products.

    Parameters
    ----------
    matrix : (3 or 4, c) float    rows sway, roll, yaw, and the rudder's where it lags; c a multiple of 4
    links : (m, 4) int            kind, column to make, and the two columns it is made from
    knots : (m,) float            of a righting spline [rad], where the kind is BEYOND_KNOT
    width : int                   columns, with those that only lead to others
    states : int                  4, with an autopilot 5 or 6
    """

    matrix: Floats
    links: NDArray[np.int64]
    knots: Floats
    width: int
    states: int


class _Columns:
    """Columns as they are asked for: powers of (v, phi, p, r) -> where their product stands."""

    def __init__(self, states: int) -> None:
        self.of = {tuple(int(i == s) for i in range(4)): s for s in range(4)}
        self.links: list[tuple[int, int, int, int]] = []
        self.next = states

    def place(self) -> int:
        self.next += 1
        return self.next - 1

    def make(self, powers: tuple[int, ...], column: int | None = None) -> int:
        """The column of a product, made from two smaller ones where it is not there yet."""
        if powers not in self.of:
            last = max(s for s in range(4) if powers[s])
            off = 2 if powers[last] > 3 else 1  # phi^5 and phi^7 step by phi^2
            rest = tuple(n - off * (s == last) for s, n in enumerate(powers))
            factor = tuple(off * (s == last) for s in range(4))
            made_from = self.make(rest), self.make(factor)
            self.of[powers] = self.place() if column is None else column
            self.links.append((TIMES, self.of[powers], *made_from))
        return self.of[powers]


def chain(system: System) -> Chain:
    """The chain of products of a system's first condition.

    Parameters
    ----------
    system : System

    Returns
    -------
    Chain

    Notes
    -----
    Source: [H71] eq. (3); no approximation, only the order of multiplications.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_ppp": -0.2, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> chain(model.system).links.tolist()  # p^2 into column 8, p p^2 into column 4
    [[0, 8, 2, 2], [0, 4, 8, 2]]
    """
    linear, coefficients = system.linear[0], system.coefficients[0]
    rows, states = linear.shape
    kinds = [(*(int(n) for n in powers), int(bars)) for powers, bars in zip(system.powers, system.modulus, strict=True)]
    column = {kind: states + i for i, kind in enumerate(dict.fromkeys(kinds))}
    matrix = np.zeros((rows, -(-(states + len(column)) // _GROUP) * _GROUP))
    matrix[:, :states] = linear
    for t, kind in enumerate(kinds):
        matrix[:3, column[kind]] += coefficients[:, t]
    columns = _Columns(matrix.shape[1])
    knots = {}
    for kind in sorted(column, key=sum):
        powers, bars = kind[:4], kind[4]
        if bars > KNOT_CODE:
            knots[len(columns.links)] = (bars - KNOT_CODE) * KNOT
            columns.links.append((BEYOND_KNOT, column[kind], _ROLL, _ROLL))
        elif bars > 0:
            columns.links.append((TIMES_MODULUS, column[kind], columns.make(powers), bars - 1))
        else:
            columns.make(powers, column[kind])
    links = np.array(columns.links, dtype=np.int64).reshape(-1, 4)
    at = np.zeros(len(links))
    at[list(knots)] = list(knots.values())
    return Chain(matrix, links, at, columns.next, states)


@abreast
def _rates(chain, columns, rate):
    """Add to ``rate`` (3 or 4, W) what the state in the first of ``columns`` (width, W) does; the products are made here."""
    matrix, links, knots = chain.matrix, chain.links, chain.knots
    for i in range(links.shape[0]):
        kind, made, a, b = links[i, 0], links[i, 1], links[i, 2], links[i, 3]
        if kind == TIMES:
            for l in range(WIDTH):
                columns[made, l] = columns[a, l] * columns[b, l]
        elif kind == TIMES_MODULUS:
            for l in range(WIDTH):
                columns[made, l] = columns[a, l] * abs(columns[b, l])
        else:
            for l in range(WIDTH):
                beyond = max(abs(columns[a, l]) - knots[i], 0.0)
                columns[made, l] = beyond * beyond * (beyond if columns[a, l] > 0.0 else -beyond)
    for k in range(matrix.shape[0]):
        for c in range(0, matrix.shape[1], _GROUP):
            m0, m1, m2, m3 = matrix[k, c], matrix[k, c + 1], matrix[k, c + 2], matrix[k, c + 3]
            for l in range(WIDTH):
                first = m0 * columns[c, l] + m1 * columns[c + 1, l]
                rate[k, l] += first + (m2 * columns[c + 2, l] + m3 * columns[c + 3, l])


@abreast
def room_for(chain):
    """What `step_sum` works in: columns, rates, and the sum of four rates.

    Notes
    -----
    Source: none needed; memory only.
    """
    return np.zeros((chain.width, WIDTH)), np.zeros((4, WIDTH)), np.zeros((chain.states, WIDTH))


@abreast
def _advance(rate, source, weight, ahead, y, s, columns, total):
    for l in range(WIDTH):
        total[s, l] += weight * rate[source, l]
        columns[s, l] = y[s, l] + ahead * rate[source, l]


@abreast
def _advance_by_rate_of(state, weight, ahead, y, s, columns, total):
    for l in range(WIDTH):
        total[s, l] += weight * columns[state, l]
        columns[s, l] = y[s, l] + ahead * columns[state, l]


@abreast
def step_sum(chain, h, excitation, y, room):
    """Sum of the four rates of a Runge-Kutta step from the states ``y`` (4 to 6, W), into the last of ``room``.

    ``excitation`` (3, 3, W): accelerations at the beginning, the middle and the end of the step; the state after the step is
    ``y + h/6`` times the sum.

    Notes
    -----
    Source: [H71] eq. (3), the classical fourth-order method.
    """
    columns, rate, total = room
    states = chain.states
    for s in range(states):
        for l in range(WIDTH):
            columns[s, l], total[s, l] = y[s, l], 0.0
    for j in range(4):
        for k in range(4):
            for l in range(WIDTH):
                rate[k, l] = excitation[(j + 1) // 2, k, l] if k < 3 else 0.0
        _rates(chain, columns, rate)
        weight, ahead = (1.0 if j == 0 or j == 3 else 2.0), (0.5 * h if j < 2 else h)
        # a heading or an angle first, while the rate it follows is still that of the stage
        if states > HEADING:
            _advance_by_rate_of(_YAW_RATE, weight, ahead, y, HEADING, columns, total)
        _advance_by_rate_of(_ROLL_RATE, weight, ahead, y, _ROLL, columns, total)
        _advance(rate, 0, weight, ahead, y, 0, columns, total)
        _advance(rate, 1, weight, ahead, y, _ROLL_RATE, columns, total)
        _advance(rate, 2, weight, ahead, y, _YAW_RATE, columns, total)
        if states > RUDDER:
            _advance(rate, 3, weight, ahead, y, RUDDER, columns, total)

"""Evaluation order of the products of the right-hand side: each from two already computed."""

from __future__ import annotations

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.layout import Layout

TIMES: Final = 0
SIZE: Final = 1
SIGN: Final = 2
ONE: Final = 3
"""Kinds of link: a b, |a|, sign a, 1."""

PLAIN: Final = 4
"""States a product may be made of: v, phi, p, r. Its further factors are variables that known inputs enter."""

Key = tuple[tuple[int, ...], int, int]
"""Powers of each variable, the variable of a modulus or sign, and which of the two: SIZE, SIGN, or TIMES for neither."""


class Program(NamedTuple):
    """How columns are made from the state and the known inputs, and which of them are products and their slopes.

    Columns: the states, one variable for each known input (``extra``), then what the links make.

    Parameters
    ----------
    links : (m, 4) int      kind, column to make, and the two columns it is made from
    values : int            how many links, from the first, the products themselves need
    products : (t,) int     column of each product
    slopes : (d, 3) int     product, state to differentiate by, column of the derivative but for its factor;
                            in the order of the states
    factors : (d,) float
    extra : (e,) int        state that each known input is added to; -1 where it stands alone
    width : int             columns
    states : int            of them states
    rows, follows, velocities, displacements : (..) int    of the `Layout`
    """

    links: NDArray[np.int64]
    values: int
    products: NDArray[np.int64]
    slopes: NDArray[np.int64]
    factors: NDArray[np.float64]
    extra: NDArray[np.int64]
    width: int
    states: int
    rows: NDArray[np.int64]
    follows: NDArray[np.int64]
    velocities: NDArray[np.int64]
    displacements: NDArray[np.int64]


class _Columns:
    """Columns as they are asked for."""

    def __init__(self, states: int, variables: int) -> None:
        units = [tuple(int(i == v) for i in range(variables)) for v in range(variables)]
        self.of: dict[Key, int] = {
            (unit, -1, TIMES): v if v < PLAIN else states + v - PLAIN for v, unit in enumerate(units)
        }
        self.links: list[tuple[int, int, int, int]] = []
        self.next = states + variables - PLAIN

    def make(self, key: Key) -> int:
        """The column of a product, made from two smaller ones where it is not there yet."""
        if key not in self.of:
            self.links.append(self._link(key))
            self.of[key] = self.links[-1][1]
        return self.of[key]

    def _link(self, key: Key) -> tuple[int, int, int, int]:
        powers, barred, kind = key
        none = tuple(0 for _ in powers)
        if kind != TIMES and not any(powers):
            unit = tuple(int(i == barred) for i in range(len(powers)))
            of = self.make((unit, -1, TIMES))
            made_from = (kind, of, of)
        elif not any(powers):
            made_from = (ONE, 0, 0)
        elif kind != TIMES:
            made_from = (TIMES, self.make((powers, -1, TIMES)), self.make((none, barred, kind)))
        else:
            last = max(v for v, power in enumerate(powers) if power)
            off = 2 if powers[last] > 3 else 1  # phi^5 and phi^7 step by phi^2
            rest = tuple(power - off * (v == last) for v, power in enumerate(powers))
            factor = tuple(off * (v == last) for v in range(len(powers)))
            made_from = (TIMES, self.make((rest, -1, TIMES)), self.make((factor, -1, TIMES)))
        self.next += 1
        return made_from[0], self.next - 1, made_from[1], made_from[2]


def program(powers: NDArray[np.int64], modulus: NDArray[np.int64], extra: NDArray[np.int64], layout: Layout) -> Program:
    """The program of a system's products.

    powers (t, 4 + e): of v, phi, p, r and of the variables that known inputs enter
    modulus (t,): variable (from 1) between modulus bars; 0 for none
    extra (e,): state that each known input is added to; -1 where it stands alone
    layout: v, phi, p, r in front
    """
    arrays = (np.ascontiguousarray(array, dtype=np.int64) for array in (powers, modulus, extra))
    return _program(*(array.tobytes() for array in arrays), layout)


@lru_cache(maxsize=256)
def _program(powers: bytes, modulus: bytes, extra: bytes, layout: Layout) -> Program:
    states = len(layout.states)
    bars = np.frombuffer(modulus, dtype=np.int64)
    of = np.frombuffer(extra, dtype=np.int64).copy()
    terms = [tuple(row) for row in np.frombuffer(powers, dtype=np.int64).reshape(bars.size, PLAIN + of.size).tolist()]
    columns = _Columns(states, PLAIN + of.size)
    keys: list[Key] = [(term, bar - 1, SIZE if bar else TIMES) for term, bar in zip(terms, bars.tolist(), strict=True)]
    products = [columns.make(key) for key in keys]
    values = len(columns.links)
    slopes, factors = [], []
    for t, (term, barred, kind) in enumerate(keys):
        for v, power in enumerate(term):
            state = v if v < PLAIN else int(of[v - PLAIN])
            if state < 0 or (power == 0 and barred != v):
                continue
            # x^n |x| has the slope (n + 1) x^(n-1) |x| for n > 0, and sign(x) for n = 0
            lowered = tuple(n - (i == v) for i, n in enumerate(term)) if power else term
            key = (lowered, barred, kind if power else SIGN)
            slopes.append((t, state, columns.make(key)))
            factors.append(float(power + (power > 0 and barred == v)) if power else 1.0)
    order = sorted(range(len(slopes)), key=lambda i: slopes[i][1])
    return Program(
        np.array(columns.links, dtype=np.int64).reshape(-1, 4),
        values,
        np.array(products, dtype=np.int64),
        np.array([slopes[i] for i in order], dtype=np.int64).reshape(-1, 3),
        np.array([factors[i] for i in order]),
        of,
        columns.next,
        states,
        *layout.arrays,
    )

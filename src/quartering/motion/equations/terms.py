"""Names of the terms on the right-hand side, and what they mean as powers of (v, phi, p, r).

A name is the row (Y, K or N), an underscore, and the factors: ``K_ppp``, ``N_vpr``, ``K_phiphiphi``, ``Y_v|r|``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import STATE, InputError
from quartering.names import ROWS, barred, term


@dataclass(frozen=True)
class Factors:
    """Powers of (v, phi, p, r) in one term, and which variable (1-4, 0 for none) stands between modulus bars."""

    powers: tuple[int, int, int, int]
    modulus: int

    @property
    def degree(self) -> int:
        """Number of factors, the modulus included."""
        return sum(self.powers) + (self.modulus > 0)

    @property
    def odd(self) -> bool:
        """Does the term change sign when the motion does? A modulus does not."""
        return sum(self.powers) % 2 == 1


@lru_cache(maxsize=1024)
def parse(name: str) -> tuple[int, Factors]:
    """Row and factors of a term name.

    name: such as "Y_v", "K_phi5", "N_rvv", "K_p|p|"
    Returns (int, Factors): row (0 sway, 1 roll, 2 yaw) and powers

    The order of the factors does not matter.  Source: [H71] eq. (2), [Abkowitz64].
    Valid: polynomials to third degree, phi^5, phi^7, and one modulus factor beside one plain factor.
    """
    row, factors = term(name)
    bars = barred(name)
    powers = [factors.count(one) for one in STATE]
    for one in bars:
        powers[STATE.index(one)] -= 1
    plain = sum(powers)
    polynomial = 1 <= plain <= 3 or (plain in (5, 7) and powers[1] == plain)
    if len(bars) > 1 or not (plain == 1 if bars else polynomial):
        raise InputError(
            f"term {name!r} is not carried by the equations: give one to three of v, phi, p, r, or K_phi5, K_phi7 for"
            " the righting moment, or one |.| factor beside one plain factor as in K_p|p|"
        )
    v, phi, p, r = powers
    return ROWS.index(row), Factors((v, phi, p, r), STATE.index(bars[0]) + 1 if bars else 0)


@dataclass(frozen=True, eq=False)
class TermTable:
    """Right-hand-side coefficients as arrays: linear part, and one column for each nonlinear product.

    Parameters
    ----------
    linear : (..., 3, 4) float    rows Y, K, N; columns v, phi, p, r; leading dimension: conditions, where they differ
    powers : (t, 4) int           powers of (v, phi, p, r) in each nonlinear product
    modulus : (t,) int            1-4 for the variable between modulus bars, 0 for none
    coefficients : (..., 3, t)    rows Y, K, N
    """

    linear: NDArray[np.float64]
    powers: NDArray[np.int64]
    modulus: NDArray[np.int64]
    coefficients: NDArray[np.float64]


def checked_number(name: str, value: float) -> float:
    """The value of a term, refused when it is not a finite number."""
    if not np.isfinite(value):
        raise InputError(f"term {name!r} is {value}; every coefficient must be a finite number (leave out what is 0)")
    return value


def term_table(terms: Mapping[str, float]) -> TermTable:
    """Arrays of the named terms.

    terms: as in [H71] eq. (2), every term on the right with its own sign [SI]

    Source: [H71] eq. (2); complete coefficients, not Taylor derivatives (a cubic in one variable is 1/6 of its derivative).
    """
    linear = np.zeros((3, 4))
    columns: dict[Factors, NDArray[np.float64]] = {}
    for name, value in terms.items():
        checked_number(name, value)
        row, factors = parse(name)
        if factors.degree == 1:
            linear[row, factors.powers.index(1)] += value
        else:
            columns.setdefault(factors, np.zeros(3))[row] += value
    return TermTable(
        linear,
        np.array([f.powers for f in columns], dtype=np.int64).reshape(-1, 4),
        np.array([f.modulus for f in columns], dtype=np.int64),
        np.array(list(columns.values())).reshape(-1, 3).T,
    )

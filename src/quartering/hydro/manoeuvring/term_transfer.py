"""Moving named terms of any degree from a point O to G.

The velocity of O is ``v_O = v - z p + x r``; a product of velocities at O becomes a sum of products at G, and the force at
O has the moments ``-z Y`` in roll and ``x Y`` in yaw about G.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

from quartering.names import canonical, term


def moved_terms(terms: Mapping[str, float], x: float, z: float) -> dict[str, float]:
    """Named coefficients about O as coefficients about G.

    terms: name -> value about O: linear, inertia, cubic, products with phi, modulus terms
    x, z: position of O from G, + forward and + down [m]
    Returns the same forces about G; names that move into others are added up

    Exact for polynomials. A modulus term keeps the velocities it names: only its force is moved, since |v + x r| has no
    such form; the error is of the order x r/v inside the modulus.
    Source: [Abkowitz64], rigid-body kinematics.
    """
    moved: dict[str, float] = {}
    for name, value in terms.items():
        row, factors = term(name)
        rows = {"Y": (("Y", 1.0), ("K", -z), ("N", x))}.get(row, ((row, 1.0),))
        tails = [(name.partition("_")[2], 1.0)] if "|" in name else _products(factors, x, z)
        for (to_row, force), (tail, share) in product(rows, tails):
            if force * share == 0.0:
                continue
            to_name = canonical(f"{to_row}_{tail}")
            moved[to_name] = moved.get(to_name, 0.0) + value * force * share
    return moved


def _products(factors: tuple[str, ...], x: float, z: float) -> list[tuple[str, float]]:
    """A product of velocities (or accelerations) at O as products at G: tail of the name and share."""
    kinematics = {
        "v": (("v", 1.0), ("p", -z), ("r", x)),
        "vdot": (("vdot", 1.0), ("pdot", -z), ("rdot", x)),
    }
    choices = [kinematics.get(factor, ((factor, 1.0),)) for factor in factors]
    order = ("v", "p", "r", "phi", "vdot", "pdot", "rdot").index
    found = []
    for choice in product(*choices):
        share = 1.0
        for _, part in choice:
            share *= part
        found.append(("".join(sorted((name for name, _ in choice), key=order)), share))
    return found

"""User overrides of coefficients: values that replace computed ones, and factors on them."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.terms import Term
from quartering.names import canonical


def with_given(ship: Ship, terms: Mapping[str, Term], count: int) -> dict[str, Term]:
    """Coefficients after the ship's own values and factors.

    terms: of all sources together
    count: number of conditions
    Returns a given value stands in place of every source of it; a factor multiplies what is there

    >>> from dataclasses import replace
    >>> from quartering.hull.file.read import ship
    >>> own = replace(ship("wigley"), overrides={"K_p|p|": -2.0}, multipliers={"K_p|p|": 0.5})
    >>> with_given(own, {}, 1)["K_p|p|"][:3]
    (array([-1.]), 'given', 'given; times 0.5')
    """
    made = dict(terms)
    for name, value in ship.overrides.items():
        source = ship.provenance.get(name, "given")
        kind = "measured" if source.startswith(("measured", "published")) else "given"
        made[canonical(name)] = Term(np.full(count, float(value)), kind, source)  # type: ignore[arg-type]
    for name, factor in _factors(ship).items():
        if name not in made:
            near = get_close_matches(name, list(made), n=1, cutoff=0.0)
            raise InputError(
                f'{ship.name}: a multiplier is given for "{name}", which this ship has no value of; '
                f'give its value first, or multiply "{near[0]}"'
            )
        was = made[name]
        made[name] = was._replace(value=was.value * factor, source=f"{was.source}; times {factor:g}")
    return made


def with_given_alone(ship: Ship, name: str, value: Floats) -> Floats:
    """One coefficient (n,) by canonical name after the ship's own value of it, or factor on it."""
    own = {canonical(key): one for key, one in ship.overrides.items()}
    start = np.full_like(value, own[name]) if name in own else value
    return np.asarray(start * _factors(ship).get(name, 1.0))


def given_names(ship: Ship) -> set[str]:
    """Canonical names of the coefficients a ship gives a value of or a factor on."""
    return {canonical(name) for name in (*ship.overrides, *ship.multipliers)}


def _factors(ship: Ship) -> dict[str, float]:
    """Multipliers by canonical name; two spellings of one name multiply."""
    factors: dict[str, float] = {}
    for name, factor in ship.multipliers.items():
        factors[canonical(name)] = factor * factors.get(canonical(name), 1.0)
    return factors

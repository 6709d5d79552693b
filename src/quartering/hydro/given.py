"""The coefficients a ship file or a user gives: values in place of the computed ones, and factors on them."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches

import numpy as np

from quartering.conventions import InputError
from quartering.hull.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.coefficient_sources import Kind
from quartering.names import canonical


class Given:
    """The ship's overrides and multipliers by canonical name, applied one coefficient at a time and recorded."""

    def __init__(self, ship: Ship, sources: dict[str, tuple[Kind, str]]) -> None:
        self.sources = sources
        self.values = {canonical(name): value for name, value in ship.overrides.items()}
        self.factors: dict[str, float] = {}
        for name, factor in ship.multipliers.items():
            self.factors[canonical(name)] = factor * self.factors.get(canonical(name), 1.0)
        self.provenance = {canonical(name): ship.provenance.get(name, "given") for name in ship.overrides}
        for name in self.values:
            measured = self.provenance[name].startswith(("measured", "published"))
            sources[name] = ("measured" if measured else "given", self.provenance[name])
        missing = [name for name in self.factors if name not in sources]
        if missing:
            near = get_close_matches(missing[0], list(sources), n=1, cutoff=0.0)
            raise InputError(
                f'{ship.name}: a multiplier is given for "{missing[0]}", which this ship has no value of; '
                f'give its value first, or multiply "{near[0]}"'
            )
        for name, factor in self.factors.items():
            kind, source = sources[name]
            sources[name] = (kind, f"{source}; times {factor:g}")

    def applied(self, name: str, value: Floats) -> Floats:
        """Value of one coefficient after override and multiplier."""
        start = np.full_like(value, self.values[name]) if name in self.values else value
        return start * self.factors.get(name, 1.0)

    def matrix(self, names: tuple[tuple[str, ...], ...], matrix: Floats) -> Floats:
        """Matrix (..., rows, columns) of coefficients after overrides and multipliers."""
        rows = [
            np.stack([self.applied(name, matrix[..., i, j]) for j, name in enumerate(row)], axis=-1)
            for i, row in enumerate(names)
        ]
        return np.stack(rows, axis=-2)

    def varying(self, terms: Mapping[str, Floats]) -> dict[str, Floats]:
        """Terms that vary with the speed after multipliers; one that is overridden is dropped."""
        return {n: value * self.factors.get(n, 1.0) for n, value in terms.items() if n not in self.values}

    def further(self, known: set[str]) -> dict[str, float]:
        """Overrides that name no coefficient of the standard set."""
        return {name: value * self.factors.get(name, 1.0) for name, value in self.values.items() if name not in known}

"""Judgements of the criteria: numbers with units and limits, vulnerable or not, or why not judged."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final, Literal, NamedTuple

from quartering.conventions import InputError
from quartering.study.criteria.constants import Constant, constants

Mode = Literal["parametric_rolling", "pure_loss", "surf_riding", "dead_ship", "excessive_acceleration"]
MODES: Final[tuple[Mode, ...]] = (
    "parametric_rolling",
    "pure_loss",
    "surf_riding",
    "dead_ship",
    "excessive_acceleration",
)

LABELS: Final[dict[str, str]] = {
    "parametric_rolling": "parametric rolling", "pure_loss": "pure loss of stability", "surf_riding": "surf-riding",
    "dead_ship": "dead ship", "excessive_acceleration": "excessive acceleration",
}  # fmt: skip
"""Failure modes in the words of the circular."""
FORM: Final = "Prepared in the form of MSC.1/Circ.1627, whose constants are recalled"


class Quantity(NamedTuple):
    """One number of a judgement.

    Parameters
    ----------
    name : str       as in ``Criteria.value``
    value : float
    unit : str
    meaning : str
    """

    name: str
    value: float
    unit: str
    meaning: str


@dataclass(frozen=True)
class Judgement:
    """One level of one failure mode.

    Parameters
    ----------
    mode : str
    level : int                           1 or 2
    quantities : tuple of Quantity        the decisive ones first
    vulnerable : bool or None             None: not judged
    applies : bool                        does the mode concern this ship at all
    reason : str                          why it does not apply, or was not judged; or the comparison that decides
    notes : tuple of str                  what was assumed
    cases : tuple of dict                 numbers a case, where a sum is made of cases
    """

    mode: Mode
    level: int
    quantities: tuple[Quantity, ...]
    vulnerable: bool | None
    reason: str
    applies: bool = True
    notes: tuple[str, ...] = ()
    cases: tuple[dict[str, float], ...] = field(default=(), repr=False)

    def value(self, name: str) -> float:
        """A quantity by its name."""
        for one in self.quantities:
            if one.name == name:
                return one.value
        raise KeyError(name)

    @property
    def verdict(self) -> str:
        """The judgement in words."""
        if not self.applies:
            return "does not apply"
        if self.vulnerable is None:
            return "not judged"
        return "vulnerable" if self.vulnerable else "not vulnerable"


def not_judged(mode: Mode, level: int, names: tuple[str, ...], reason: str) -> Judgement:
    """A level that lacks something: its numbers are NaN, and the reason says what it needs."""
    return Judgement(mode, level, tuple(Quantity(name, math.nan, "1", "") for name in names), None, reason)


class Row(NamedTuple):
    """One line of the table of a judgement."""

    mode: str
    level: int
    quantity: str
    value: float
    unit: str
    verdict: str
    reason: str


@dataclass(frozen=True)
class Criteria:
    """All five failure modes of one loading.

    Parameters
    ----------
    ship : str
    loading : str                     draught, GM, speed and roll period in words
    judgements : tuple of Judgement
    """

    ship: str
    loading: str
    judgements: tuple[Judgement, ...]

    def of(self, mode: str, level: int) -> Judgement:
        """The judgement on one mode at one level."""
        for one in self.judgements:
            if (one.mode, one.level) == (mode, level):
                return one
        raise InputError(f"{mode}.level{level} is no judgement; modes are {', '.join(MODES)}, levels 1 and 2")

    def value(self, name: str) -> float:
        """A number by its name, whether or not its mode applies to the ship.

        name: "parametric_rolling.level2.c1"
        Returns NaN where it could not be computed
        """
        mode, _, rest = name.partition(".")
        level, _, quantity = rest.partition(".")
        if level not in ("level1", "level2"):
            raise InputError(f'"{name}": a number is named mode.level.quantity, such as pure_loss.level2.cr1')
        judgement = self.of(mode, int(level[-1]))
        try:
            return judgement.value(quantity)
        except KeyError:
            known = ", ".join(one.name for one in judgement.quantities) or f"none: {judgement.reason}"
            raise InputError(f'"{name}": {mode} level {level[-1]} has {known}') from None

    def table(self) -> list[Row]:
        """Every number of every level, with the verdict of its level."""
        return list(self._rows())

    def _rows(self) -> Iterator[Row]:
        for one in self.judgements:
            for quantity in one.quantities or (Quantity("", math.nan, "", ""),):
                yield Row(one.mode, one.level, *quantity[:3], one.verdict, one.reason)

    @property
    def constants(self) -> list[Constant]:
        """Every constant used, with its place and status."""
        return [one for mode in ("general", "effective_wave", *MODES) for one in constants(mode)]

    @property
    def sentence(self) -> str:
        """What the five modes come to, each at the highest level that decides it."""
        return f"{self.ship}, {self.loading}: " + "; ".join(self._words(mode) for mode in MODES) + f". {FORM}."

    def _words(self, mode: str) -> str:
        name, first, second = LABELS[mode], self.of(mode, 1), self.of(mode, 2)
        if not first.applies:
            return f"{name} does not apply ({first.reason})"
        if first.vulnerable is False:
            return f"{name} not vulnerable at level 1"
        if second.vulnerable is None and first.vulnerable is None:
            return f"{name} not judged ({first.reason})"
        if second.vulnerable is None:
            return f"{name} vulnerable at level 1, level 2 not judged ({second.reason})"
        return f"{name} {second.verdict} at level 2"

    def __repr__(self) -> str:
        verdicts = ", ".join(f"{one.mode} {one.level} {one.verdict}" for one in self.judgements)
        return f"<Criteria {self.ship}: {verdicts}>"

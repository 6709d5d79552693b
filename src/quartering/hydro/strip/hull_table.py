"""Section coefficients and potentials of a hull by its section method and end correction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hydro.strip.ends import ENDS_WORDS, end_effect, with_ends
from quartering.hydro.strip.table import SectionTable, radiation_table


class EndMethod(NamedTuple):
    """How the ends of a hull are allowed for.

    Parameters
    ----------
    solve : callable             hull, frequencies [rad/s], density [kg/m3] -> SectionTable
    words : str                  what follows the words for strips; empty for strips alone
    references : tuple of str    keys of the papers behind it
    """

    solve: Callable[[Hull, Floats, float], SectionTable]
    words: str
    references: tuple[str, ...]


def hull_table(hull: Hull, frequency: ArrayLike, density: float) -> SectionTable:
    """Section coefficients in sway and roll of a hull, by its own choice of section method and ends.

    hull: at its draught
    frequency (f,): w >= 0, ascending [rad/s]
    density: of the water, > 0 [kg/m3]

    Three-dimensional ends need the potentials at w = 0, which are solved beside those asked for.
    Source: [Tasai61] or [Frank67] sections; [Morino74] ends.  Valid: as `radiation_table` and `end_effect`.
    """
    return end_method(hull).solve(hull, np.atleast_1d(np.asarray(frequency, dtype=float)), density)


def end_method(hull: Hull) -> EndMethod:
    """How a hull's ends are allowed for; nothing else asks `hull.ends`."""
    return _ENDS[hull.ends]


def _strips_alone(hull: Hull, frequency: Floats, density: float) -> SectionTable:
    return radiation_table(strips(hull), frequency, density, method=hull.section_method)


def _three_dimensional(hull: Hull, frequency: Floats, density: float) -> SectionTable:
    """The ends' effect is found at w = 0, which is solved beside what is asked for."""
    immersed = strips(hull)
    with_still = frequency if frequency.size and frequency[0] == 0.0 else np.append(0.0, frequency)
    table = radiation_table(immersed, with_still, density, method=hull.section_method)
    table = with_ends(table, immersed, end_effect(hull), hull.draught)
    kept = slice(with_still.size - frequency.size, None)
    return replace(table, frequency=table.frequency[kept], a=table.a[kept], b=table.b[kept], psi=table.psi[kept])


def section_words(hull: Hull) -> str:
    """How the sections of a hull are solved, in words."""
    return f"sections on their {'Lewis forms' if hull.section_method == 'lewis' else 'own contours'}"


def section_references(hull: Hull) -> tuple[str, ...]:
    """Sources of the solution of a hull's sections."""
    return ("Ursell49", "Tasai61", "Lewis29") if hull.section_method == "lewis" else ("Frank67", "Kress90")


_ENDS: Final[dict[str, EndMethod]] = {
    "strips": EndMethod(_strips_alone, "", ()),
    "three-dimensional": EndMethod(_three_dimensional, ENDS_WORDS, ("Morino74",)),
}

"""Coefficient terms: values by name, each with kind, source and references.

Sources are added up by name. Each says its own part in words, so that the table's line of a coefficient is the parts' lines
one after the other; what counts as an estimate follows from the kind, here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Final, Literal, NamedTuple

import numpy as np

from quartering.hull.lines.section import Floats

if TYPE_CHECKING:
    from quartering.hydro.coefficient_table import Entry

Kind = Literal["given", "estimated", "measured", "regression", "cross-flow", "database", "strip", "derived"]

KINDS: Final[tuple[Kind, ...]] = (
    "given", "estimated", "measured", "regression", "cross-flow", "database", "strip", "derived",
)  # fmt: skip
"""Kinds of source; the kind of a sum is the first of these among its parts."""

ESTIMATES: Final[dict[Kind, str]] = {"regression": "regression", "cross-flow": "cross-flow drag", "estimated": ""}
"""Kinds that are estimates, and the method's name; without one the source's own words name it."""

_ANNOUNCED = "estimated: "


class Term(NamedTuple):
    """What one source, or all of them together, give of one coefficient.

    Parameters
    ----------
    value : (n,) float          at the conditions [SI]
    kind : str                  one of `KINDS`
    source : str                in words; "estimated: .." for an estimate
    references : tuple of str   keys of the papers behind it
    """

    value: Floats
    kind: Kind
    source: str
    references: tuple[str, ...] = ()


Terms = Mapping[str, Term]


def added(sources: Iterable[Terms]) -> dict[str, Term]:
    """Coefficients of several sources, added up by name.

    sources: by canonical name, values of one length
    Returns the kind of a sum is the first of `KINDS` among its parts, its words are theirs in that order
    """
    parts: dict[str, list[Term]] = {}
    for terms in sources:
        for name, part in terms.items():
            parts.setdefault(name, []).append(part)
    return {name: _sum(sorted(each, key=lambda part: KINDS.index(part.kind))) for name, each in parts.items()}


def _sum(parts: list[Term]) -> Term:
    if len(parts) == 1:
        return parts[0]
    papers = tuple(dict.fromkeys(key for part in parts for key in part.references))
    said = "; and ".join(part.source for part in parts)
    return Term(np.sum([part.value for part in parts], axis=0), parts[0].kind, said, papers)


def named(names: Iterable[Iterable[str]], values: Floats) -> dict[str, Floats]:
    """Entries of matrices (n, rows, columns) by the names of rows and columns."""
    return {name: values[:, i, j] for i, row in enumerate(names) for j, name in enumerate(row)}


def estimates(entries: Iterable[Entry]) -> dict[str, list[str]]:
    """Names of the coefficients that are estimated, by the method that estimates them.

    entries: of `Coefficients.table`
    Returns "regression", "cross-flow drag", or the first clause of an estimate's own words -> names
    """
    found: dict[str, list[str]] = {}
    for entry in entries:
        if entry.estimated:
            found.setdefault(ESTIMATES[entry.kind] or _method(entry.source), []).append(entry.name)
    return found


def _method(source: str) -> str:
    """The first clause after "estimated: ", or of the whole."""
    words = source.partition(_ANNOUNCED)[2] or source
    for mark in (",", ";", ":"):
        words = words.partition(mark)[0]
    return words.strip()

"""The five failure modes of intact stability as a section of the report."""

from __future__ import annotations

import math
from typing import NamedTuple

from quartering.hull.ship import Ship
from quartering.study.criteria.judged import criteria
from quartering.study.criteria.record import FORM, LABELS, MODES, Judgement
from quartering.view.report.tables import Row, Table


class Section(NamedTuple):
    """What a report says of the failure modes: a sentence, every level, what was assumed, and what the numbers rest on."""

    sentence: str
    table: Table
    notes: list[str]
    form: str


def criteria_section(ship: Ship, speed: float) -> Section:
    """Every level of every failure mode at a service speed [m/s]."""
    found = criteria(ship, speed)
    rows = [_row(found.of(mode, level)) for mode in MODES for level in (1, 2)]
    notes = dict.fromkeys(note for one in found.judgements for note in one.notes)
    recalled = sum(one.status.startswith("recalled") for one in found.constants)
    form = f"{FORM}: {recalled} of {len(found.constants)}. It shows no compliance."
    columns = ("failure mode", "level", "verdict", "why", "numbers")
    return Section(
        found.sentence, Table(columns, rows, (1,)), [f"{note[0].upper()}{note[1:]}." for note in notes], form
    )


def _row(one: Judgement) -> Row:
    """A level; marked where it was not judged, or rests on an estimate."""
    finite = [q for q in one.quantities if math.isfinite(q.value)]
    numbers = ", ".join(f"{q.name} {q.value:.3g}{'' if q.unit in ('', '1') else f' {q.unit}'}" for q in finite)
    cells = (LABELS[one.mode], str(one.level), one.verdict, one.reason, numbers)
    return Row(cells, one.verdict == "not judged" or any("estimated" in note for note in one.notes))

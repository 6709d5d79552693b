"""Judgements of the criteria in words and numbers: what a command, a page and the service say of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from quartering.study.criteria.record import Criteria, Judgement


def numbers_words(judgement: Judgement) -> str:
    """The numbers of a judgement with their units, those that are known."""
    return ", ".join(
        f"{one.name} {one.value:.3g}{'' if one.unit in ('', '1') else f' {one.unit}'}"
        for one in judgement.quantities
        if math.isfinite(one.value)
    )


def recalled_words(found: Criteria) -> str:
    """In which form results are, and how many of the constants nobody has checked."""
    from quartering.study.criteria.record import FORM

    recalled = [constant for constant in found.constants if constant.status.startswith("recalled")]
    return f"{FORM}: {len(recalled)} of {len(found.constants)}"


def criteria_facts(found: Criteria) -> dict[str, object]:
    """Everything for programs, the cases of sums and the constants with their status among it; no sentence of level 1 alone."""
    whole = any(one.level == 2 for one in found.judgements)
    return {
        "ship": found.ship, "loading": found.loading, "sentence": found.sentence if whole else None,
        "judgements": [
            {
                "mode": one.mode, "level": one.level, "verdict": one.verdict, "vulnerable": one.vulnerable,
                "applies": one.applies, "reason": one.reason, "notes": one.notes, "cases": one.cases,
                "quantities": {q.name: {"value": q.value, "unit": q.unit, "meaning": q.meaning} for q in one.quantities},
            }
            for one in found.judgements
        ],
        "constants": [constant._asdict() for constant in found.constants],
    }  # fmt: skip

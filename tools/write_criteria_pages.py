"""Write the pages of five ships under the five failure modes, from the library: docs/criteria/<ship>.md.

    python tools/write_criteria_pages.py [ship ..]

`tests/study/criteria/test_pages.py` compares the pages with what this would write.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import NamedTuple

import quartering as qt
from quartering.study.criteria.record import FORM, LABELS, MODES, Criteria, Judgement

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "criteria"


class Case(NamedTuple):
    """A ship as it is judged; what its file does not hold is assumed for the page."""

    title: str
    speed: str
    windage: str
    highest: str
    note: str


CASES = {
    "fishing-30m": Case("Fishing vessel of 30 m", "10.5kn", "110,4", "4,9.5", "an invented ship of the library"),
    "coaster-90m": Case("Coaster of 90 m", "12.5kn", "520,6", "-35,19", "an invented ship of the library"),
    "dtc": Case("Duisburg Test Case", "25kn", "11000,27", "60,62", "a container ship of 355 m with lines published"),
    "s175": Case("S-175", "0.275Fn", "3300,14", "40,34", "a container ship of 175 m with lines published"),
    "dtmb5415": Case("DTMB 5415", "0.41Fn", "1500,9", "10,23", "a naval combatant of 142 m with lines published"),
}


def options(case: Case) -> dict[str, str]:
    """Options of the ship beside its file."""
    return {"windage": case.windage, "highest_position": case.highest, "propulsion": "estimated"}


def judged(name: str) -> Criteria:
    """The criteria of one case."""
    return qt.criteria(qt.ship(name).with_(**options(CASES[name])), speed=CASES[name].speed)


def page(name: str, found: Criteria | None = None) -> str:
    """Text of the page of a ship."""
    case = CASES[name]
    found = judged(name) if found is None else found
    typed = " ".join(f"--{key.replace('_', '-')} {value}" for key, value in options(case).items())
    rows = "\n".join(_row(found.of(mode, level)) for mode in MODES for level in (1, 2))
    notes = dict.fromkeys(note for one in found.judgements for note in one.notes)
    area, lever = case.windage.split(",")
    x, height = case.highest.split(",")
    assumed = (
        f"a side of {area} m2 in the wind, its centre {lever} m over half the draught; people up to {height} m over the keel, "
        f"{x} m forward of midship; service speed {case.speed}"
    )
    return f"""# {case.title}: the five failure modes

`quartering criteria {name} --speed {case.speed} {typed}`

{case.note[0].upper()}{case.note[1:]}; {found.loading}.
Assumed for this page: {assumed}.

| failure mode | level | verdict | why | numbers |
|---|---|---|---|---|
{rows}

{_ends(found)}

{chr(10).join(f"- {note[0].upper()}{note[1:]}." for note in notes)}

{_FOOT}
"""


_FOOT = (
    f"{FORM}; it shows no compliance ([what is recalled](../intact_stability.md)). "
    "This page is written by `tools/write_criteria_pages.py`."
)


def _row(one: Judgement) -> str:
    numbers = ", ".join(
        f"{q.name} {q.value:.3g}{'' if q.unit in ('', '1') else f' {q.unit}'}"
        for q in one.quantities
        if math.isfinite(q.value)
    )
    return f"| {LABELS[one.mode]} | {one.level} | {one.verdict} | {one.reason} | {numbers} |"


def _ends(found: Criteria) -> str:
    """Where each mode ends, in a sentence."""
    return found.sentence.partition(": ")[2].removesuffix(f". {FORM}.").replace("; ", ";\n") + "."


def main(names: list[str]) -> None:
    """Write the pages asked for, or all."""
    FOLDER.mkdir(exist_ok=True)
    for name in names or CASES:
        (FOLDER / f"{name}.md").write_text(page(name), encoding="utf-8")
        print(FOLDER / f"{name}.md")


if __name__ == "__main__":
    main(sys.argv[1:])

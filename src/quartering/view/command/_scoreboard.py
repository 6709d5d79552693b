"""`quartering figures --scoreboard`: the claims of the paper, measured."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from quartering.view.console.answer import Answer
from quartering.view.console.files import File, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import bar

if TYPE_CHECKING:
    from quartering.view.console.printed import Table


def measure_claims(output: str | None) -> Answer:
    """Measure every claim.

    Parameters
    ----------
    output : str or None    page to write (.md)

    Returns
    -------
    Answer
    """
    from quartering.stability.precompile import announce_compilation
    from quartering.study.paper.scoreboard import CLAIMS, scoreboard, scoreboard_page, tally

    path = reserve_path(output, (".md",))
    announce_compilation()
    with bar("claims", len(CLAIMS)) as report:
        found = scoreboard(report)

    def page(part: Path) -> None:
        part.write_text(scoreboard_page(found), encoding="utf-8")

    def lines() -> Iterator[Table | str]:
        rows = [(one.claim.text, one.claim.where, *one.over_ground, *(one.through_water or ("", ""))) for one in found]
        yield table(
            "Claims of the paper", ("claim", "where", "over ground", "evidence", "through the water", "evidence"), rows
        )
        yield tally(found)

    def facts() -> dict[str, object]:
        rows = [
            {
                "claim": one.claim.text,
                "where": one.claim.where,
                **one.over_ground._asdict(),
                "through_water": None if one.through_water is None else one.through_water._asdict(),
            }
            for one in found
        ]
        return {"claims": rows, "written": None if path is None else str(path)}

    files = () if path is None else (File(path, page),)
    return Answer(lines(), facts, files, next_steps=["quartering figures"])

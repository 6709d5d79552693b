"""`quartering figures --scoreboard`: the claims of the paper, measured."""

from __future__ import annotations

from quartering.stability.ahead import announce_compilation
from quartering.study.paper.scoreboard import CLAIMS, scoreboard, scoreboard_page, tally
from quartering.view.output import claim as claim_path
from quartering.view.output import write
from quartering.view.progress import bar
from quartering.view.terminal import next_steps, show, show_json, table


def print_scoreboard(output: str | None, as_json: bool) -> None:
    """Measure every claim, print the table, write the page where asked.

    Parameters
    ----------
    output : str       page to write (.md), or None
    as_json : bool
    """
    path = claim_path(output, (".md",)) if output is not None else None
    announce_compilation()
    with bar("claims", len(CLAIMS)) as report:
        found = scoreboard(report)
    if path is not None:
        write((path, lambda part: part.write_text(scoreboard_page(found), encoding="utf-8")))
    if as_json:
        rows = [
            {"claim": claim.text, "where": claim.where, "answer": finding.answer, "evidence": finding.evidence}
            for claim, finding in found
        ]
        show_json({"claims": rows, "written": None if path is None else str(path)})
        return
    rows_of_text = [(claim.text, claim.where, finding.answer, finding.evidence) for claim, finding in found]
    show(table("Claims of the paper", ("claim", "where", "answer", "evidence"), rows_of_text), tally(found))
    if path is not None:
        show(f"Wrote {path}")
    show(next_steps("quartering figures"))

"""`quartering report`: one page to print about a ship and its map."""

from __future__ import annotations

from pathlib import Path

from quartering.conventions import InputError
from quartering.stability.ahead import announce_compilation
from quartering.units import quantity
from quartering.view.output import claim, stem, write
from quartering.view.report.page import guidance_page, report_page, write_pdf
from quartering.view.report.source import Source, report_source
from quartering.view.terminal import next_steps, show, show_json, table

KINDS = ("report", "guidance")


def make_report(
    what: str, kind: str, output: str | None, ship: str | None, openings: str | None, as_json: bool
) -> None:
    """Write the page, print what it is about."""
    if kind not in KINDS:
        raise InputError(f'--form "{kind}": give {" or ".join(KINDS)}')
    if openings is not None and kind != "guidance":
        raise InputError("--openings is for the failure event of --form guidance; add it, or leave --openings out")
    heel = quantity(openings, "angle", what="--openings") if openings is not None else None
    path = claim(f"{stem(what.rstrip('/'))}-{kind}.html" if output is None else output, (".html", ".pdf"))
    announce_compilation()
    source = report_source(what, ship, kind)
    page = report_page(source) if kind == "report" else guidance_page(source, heel)
    if path.suffix.lower() == ".pdf":
        write((path, lambda part: write_pdf(page, part)))
    else:
        write((path, lambda part: part.write_text(page, encoding="utf-8")))
    if as_json:
        show_json(_facts(source, kind, path))
        return
    rows = [(key, str(value)) for key, value in _facts(source, kind, path).items()]
    show(table(f"Report on {source.ship.name}", ("what", "value"), rows))
    other = "guidance" if kind == "report" else "report"
    steps = [f"quartering report {what} --form {other}"]
    if path.suffix.lower() == ".html":
        steps.append(f"quartering report {what} --form {kind} -o {path.stem}.pdf")
    show(next_steps(*steps))


def _facts(source: Source, kind: str, path: Path) -> dict[str, object]:
    return {
        "file": str(path),
        "form": kind,
        "ship": source.ship.name,
        "source": source.origin,
        "conditions": int(source.result["verdict"].size),
        "fingerprint": source.digest,
    }

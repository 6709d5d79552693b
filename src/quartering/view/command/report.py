"""`quartering report`: one page to print about a ship and its map."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.units import quantity
from quartering.view.console.answer import Answer
from quartering.view.console.files import File, reserve_path, ship_stem
from quartering.view.console.printed import table

if TYPE_CHECKING:
    from rich.table import Table

    from quartering.view.report.source import Source

KINDS = ("report", "guidance")


def report(
    result: Annotated[
        str, typer.Argument(help="A .nc file, the folder of a sweep, or a ship, whose map is then made.")
    ],
    form: Annotated[
        str, typer.Option(help="report: all about the ship and its map; guidance: polar diagrams for every wave.")
    ] = "report",
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Page to write: .html, or .pdf (extra pdf).")
    ] = None,
    ship: Annotated[str | None, typer.Option(help="Ship file of the result, where it is not a built-in ship.")] = None,
    openings: Annotated[
        str | None, typer.Option(help="With --form guidance: heel at which unprotected openings go under [deg].")
    ] = None,
) -> Answer:
    """A report to print: one page that holds everything, or polar diagrams in the form of operational guidance."""
    from quartering.stability.precompile import announce_compilation
    from quartering.view.report.page import guidance_page, report_page, write_pdf
    from quartering.view.report.source import report_source

    if form not in KINDS:
        raise InputError(f'--form "{form}": give {" or ".join(KINDS)}')
    if openings is not None and form != "guidance":
        raise InputError("--openings is for the failure event of --form guidance; add it, or leave --openings out")
    heel = quantity(openings, "angle", what="--openings") if openings is not None else None
    usual = f"{ship_stem(result.rstrip('/'))}-{form}.html"
    path = reserve_path(usual if output is None else output, (".html", ".pdf"))
    announce_compilation()
    source = report_source(result, ship, form)
    page = report_page(source) if form == "report" else guidance_page(source, heel)
    printed = path.suffix.lower() == ".pdf"

    def write(part: Path) -> None:
        if printed:
            write_pdf(page, part)
        else:
            part.write_text(page, encoding="utf-8")

    def lines() -> Iterator[Table]:
        rows = [(key, str(value)) for key, value in _facts(source, form, path).items()]
        yield table(f"Report on {source.ship.name}", ("what", "value"), rows)

    other = "guidance" if form == "report" else "report"
    steps = [f"quartering report {result} --form {other}"]
    if not printed:
        steps.append(f"quartering report {result} --form {form} -o {path.stem}.pdf")
    return Answer(lines(), lambda: _facts(source, form, path), [File(path, write)], written="", next_steps=steps)


def _facts(source: Source, kind: str, path: Path) -> dict[str, object]:
    return {
        "file": str(path),
        "form": kind,
        "ship": source.ship.name,
        "source": source.origin,
        "conditions": int(source.result["verdict"].size),
        "fingerprint": source.digest,
    }

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
    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.view.console.printed import Table
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
    service_speed: Annotated[
        str | None,
        typer.Option(help="With --form report: judge the five failure modes at this speed too, 15kn or 0.25Fn."),
    ] = None,
    openings: Annotated[
        str | None, typer.Option(help="With --form guidance: heel at which unprotected openings go under [deg].")
    ] = None,
) -> Answer:
    """A report to print: one page that holds everything, or polar diagrams in the form of operational guidance."""
    from quartering.stability.precompile import announce_compilation
    from quartering.view.report.page import guidance_page, report_page, write_pdf
    from quartering.view.report.pictures import pictures_for
    from quartering.view.report.source import report_source

    if form not in KINDS:
        raise InputError(f'--form "{form}": give {" or ".join(KINDS)}')
    if openings is not None and form != "guidance":
        raise InputError("--openings is for the failure event of --form guidance; add it, or leave --openings out")
    if service_speed is not None and form != "report":
        raise InputError("--service-speed is for the failure modes of --form report; leave it out")
    heel = quantity(openings, "angle", what="--openings") if openings is not None else None
    usual = f"{ship_stem(result.rstrip('/'))}-{form}.html"
    path = reserve_path(usual if output is None else output, (".html", ".pdf"))
    announce_compilation()
    seas = _of_seas(result)
    if seas is not None:
        return _sea_report(seas, result, path)
    source = report_source(result, ship, form)
    service = None if service_speed is None else _speed(source.ship, service_speed)
    with pictures_for(path):
        page = report_page(source, service) if form == "report" else guidance_page(source, heel)
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


def _of_seas(result: str) -> xr.Dataset | None:
    """The map over irregular seas that a name stands for; None where it stands for something else."""
    from quartering.view.stored import opened

    if not (Path(result).is_dir() or Path(result).suffix.lower() == ".nc"):
        return None
    ds = opened(result)
    return ds.load() if "recommended" in ds else None


def _sea_report(ds: xr.Dataset, result: str, path: Path) -> Answer:
    """The report on a map over irregular seas, which is in the form of guidance."""
    from quartering.view.report.page import write_pdf
    from quartering.view.report.pictures import pictures_for
    from quartering.view.report.seas import seas_page

    with pictures_for(path):
        page = seas_page(ds, result)
    facts = {"file": str(path), "form": "guidance in seas", "ship": ds.attrs["ship"], "source": result,
             "conditions": int(ds["recommended"].size)}  # fmt: skip

    def write(part: Path) -> None:
        if path.suffix.lower() == ".pdf":
            write_pdf(page, part)
        else:
            part.write_text(page, encoding="utf-8")

    rows = [(key, str(value)) for key, value in facts.items()]
    return Answer(
        [table(f"Report on {ds.attrs['ship']}", ("what", "value"), rows)], lambda: facts, [File(path, write)], written="",
        next_steps=[f"quartering show {result} -o guidance.png"],
    )  # fmt: skip


def _speed(ship: Ship, text: str) -> float:
    """Service speed as typed [m/s]."""
    from quartering.options import OPTIONS
    from quartering.view.console.typed_values import value

    return value(text, OPTIONS["speed"], ship.sizes, "--service-speed")


def _facts(source: Source, kind: str, path: Path) -> dict[str, object]:
    return {
        "file": str(path),
        "form": kind,
        "ship": source.ship.name,
        "source": source.origin,
        "conditions": int(source.result["verdict"].size),
        "fingerprint": source.digest,
    }

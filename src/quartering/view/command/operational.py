"""`quartering operational`: operational guidance in its three forms, to print and as a table."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.files import File, reserve_path
from quartering.view.console.printed import table

if TYPE_CHECKING:
    import xarray as xr

    from quartering.view.console.printed import Table


def operational(
    result: Annotated[
        str, typer.Argument(help="A .nc file of rates and largest motions over seas, speeds and headings.")
    ],
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Page to write: .html, or .pdf (extra pdf).")
    ] = None,
    table_file: Annotated[str | None, typer.Option("--csv", help="Table of every condition to write: .csv.")] = None,
    rate_limit: Annotated[
        float | None,
        typer.Option(help="Rate of failures [1/s] above which a condition is not recommended; that recalled."),
    ] = None,
    safety_factor: Annotated[
        float | None, typer.Option(help="On the mean largest motion of 3 h; that recalled.")
    ] = None,
) -> Answer:
    """Operational guidance in three forms, one A4 page a loading: by rates, by largest motions, by speeds alone."""
    from quartering.study.criteria.operational import guidance_csv, operational_guidance
    from quartering.view.report.operational import operational_page
    from quartering.view.report.pictures import pictures_for

    page, csv = reserve_path(output, (".html", ".pdf")), reserve_path(table_file, (".csv",))
    ds = operational_guidance(_opened(result), rate_limit, safety_factor)
    files = []
    if page is not None:
        with pictures_for(page):
            text = operational_page(ds)
        files.append(File(page, lambda part: _write(text, page, part)))
    if csv is not None:
        rows = guidance_csv(ds)
        files.append(File(csv, lambda part: part.write_text(rows, encoding="utf-8")))
    return Answer(
        _lines(ds), lambda: _facts(ds) | {"page": str(page) if page else None, "csv": str(csv) if csv else None}, files,
        next_steps=[] if files else [f"quartering operational {result} -o guidance.html --csv guidance.csv"],
    )  # fmt: skip


def _opened(name: str) -> xr.Dataset:
    import xarray as xr

    path = Path(name)
    if not path.is_file():
        raise InputError(f"{name} is no file; give a .nc file of a map over seas")
    try:
        with xr.open_dataset(path) as found:
            return found.load()
    except (ValueError, OSError) as error:
        raise InputError(f"{name} is no netCDF file ({error}); give a .nc file of a map over seas") from None


def _write(text: str, page: Path, part: Path) -> None:
    if page.suffix.lower() == ".pdf":
        from quartering.view.report.page import write_pdf

        write_pdf(text, part)
    else:
        part.write_text(text, encoding="utf-8")


def _lines(ds: xr.Dataset) -> Iterator[Table | str]:
    from quartering.study.criteria.operational import ADVICE, FORMS
    from quartering.study.seas.over_seas.map_axes import dims_of

    rows = [
        (
            form,
            *(f"{100 * float((ds[form] == code).mean()):.1f} %" for code in range(len(ADVICE))),
            str(ds.attrs[f"rule_{form}"]),
        )
        for form in FORMS
    ]
    size = ", ".join(f"{ds.sizes[name]} {name}" for name in dims_of(ds))
    yield table(
        f"{ds.attrs.get('ship', '')}: operational guidance over {size}", ("form", *ADVICE, "rule"), rows, (1, 2, 3, 4)
    )
    yield "Prepared in the form of MSC.1/Circ.1627, whose numbers are recalled and unverified. It shows no compliance."


def _facts(ds: xr.Dataset) -> dict[str, object]:
    from quartering.study.criteria.operational import ADVICE, FORMS

    shares = {form: {words: float((ds[form] == code).mean()) for code, words in enumerate(ADVICE)} for form in FORMS}
    rules = {form: str(ds.attrs[f"rule_{form}"]) for form in FORMS}
    return {
        "ship": ds.attrs.get("ship"),
        "sizes": {str(k): v for k, v in ds.sizes.items()},
        "shares": shares,
        "rules": rules,
    }

"""`quartering long-term`: failures over all seas, by a map of guidance and a table of how often seas occur."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

from quartering.view.console.answer import Answer
from quartering.view.console.arguments import DataOrTables
from quartering.view.console.files import TABLES, dataset_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.sea_options import SeaTable
from quartering.view.console.tables import data_table

if TYPE_CHECKING:
    import xarray as xr

    from quartering.view.console.printed import Table

_MOST_ROWS: Final = 10


def long_term(
    result: Annotated[str, typer.Argument(help="Map over seas: a .nc file, or the folder of a sweep.")],
    seas: SeaTable = None,
    output: DataOrTables = None,
) -> Answer:
    """Failures a year over all seas a ship meets: rates of a map, weighted by how often seas and headings occur."""
    from quartering.study.seas.failure_rates.long_term import long_term as sum_over
    from quartering.study.seas.failure_rates.occurrence import read_table
    from quartering.view.stored import opened

    path = reserve_path(output, (".nc", *TABLES))
    found = opened(result)
    ds = sum_over(found, None if seas is None else read_table(seas))
    return Answer(
        _lines(ds),
        lambda: _facts(ds) | {"file": str(path) if path else None},
        dataset_files(path, ds),
        output=path,
        data=lambda: [
            data_table(ds.isel(_first(ds)), "Seas: contribution and share of time", ("contribution", "weight"))
        ],
        next_steps=[f"quartering operational {result} -o guidance.html --csv guidance.csv"],
    )


def _first(ds: xr.Dataset) -> dict[str, int]:
    return {"loading": 0} if "loading" in ds.dims else {}


def _lines(ds: xr.Dataset) -> Iterator[Table | str]:
    import numpy as np

    from quartering.study.seas.failure_rates.long_term import YEAR
    from quartering.study.seas.over_seas.map_axes import period_of

    rate, lower, upper = (np.atleast_1d(ds[name].values) for name in ("failure_rate", "rate_lower", "rate_upper"))
    rows = [
        (f"{i + 1}", f"{rate[i]:.3g}", f"{lower[i]:.2g} to {upper[i]:.2g}", f"{rate[i] * YEAR:.3g}",
         f"{lower[i] * YEAR:.2g} to {upper[i] * YEAR:.2g}")
        for i in range(rate.size)
    ]  # fmt: skip
    heads = ("loading", "failures [1/s]", "ends of the rates added", "failures [1/year]", "ends added")
    yield table(f"{ds.attrs['ship']}: failures over all seas, {ds.attrs['sea']}", heads, rows, (0, 1, 2, 3, 4))
    part, period = ds.isel(_first(ds)), period_of(ds)
    flat = part["contribution"].stack(sea=("hs", period))
    order = np.argsort(-flat.fillna(-1.0).values, kind="stable")[:_MOST_ROWS]
    total = max(float(rate[0]), 1e-300)
    weight = part["weight"].stack(sea=("hs", period))
    parts = [
        (f"{float(flat['hs'][i]):.3g}", f"{float(flat[period][i]):.3g}", f"{float(flat[i]) / total:.1%}",
         f"{float(weight[i]):.2g}")
        for i in order
        if float(flat[i]) > 0
    ]  # fmt: skip
    seas = ("Hs [m]", f"T{period[1]} [s]", "of the sum", "share of time")
    yield table("Seas that failures come from", seas, parts, (0, 1, 2, 3))
    yield f"Not covered by the map: {float(ds['not_covered']):.2%} of the time. Table of seas: {ds.attrs['table']}."
    yield f"Safety level of the circular: {ds.attrs['safety_level']}. Nothing here shows compliance with any rule."


def _facts(ds: xr.Dataset) -> dict[str, Any]:
    about = ("ship", "sea", "table", "safety_level")
    return {**{name: ds.attrs[name] for name in about}, **{str(name): ds[name].values for name in ds.data_vars}}

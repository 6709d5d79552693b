"""`quartering worst`: the worst conditions of a stored result."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

from quartering.view.console.answer import Answer
from quartering.view.console.arguments import TableFile
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import table

if TYPE_CHECKING:
    import xarray as xr

    from quartering.study.maps.query import Measure
    from quartering.view.console.printed import Table


def worst(
    result: Annotated[str, typer.Argument(help="Folder of a sweep, or a .nc file.")],
    by: Annotated[str, typer.Option(help="roll: largest roll; margin: least stable.")] = "roll",
    count: Annotated[int, typer.Option(help="How many conditions.")] = 10,
    output: TableFile = None,
) -> Answer:
    """The worst conditions of a stored result."""
    import numpy as np

    from quartering.study.maps.query import OTHER, other_rolls
    from quartering.study.maps.query import worst as worst_of
    from quartering.view.stored import head_of, opened, short_words
    from quartering.view.wording import edge_words

    measure: Measure = by  # type: ignore[assignment]  # worst_of refuses an unknown one
    path = reserve_path(output, TABLES)
    ds = opened(result)
    found = worst_of(ds, measure, count)

    def lines() -> Iterator[Table | str]:
        rows, heads = _rows(found), [head_of(name, found) for name in _names(found)]
        texts = [[v if isinstance(v, str) else f"{v:.4g}" for v in row.values()] for row in rows]
        what = "Largest roll" if by == "roll" else "Least stable margin"
        yield table(f"{what} of {found.attrs['ship']}", [*heads, "verdict"], texts, tuple(range(len(heads))))
        yield from short_words(found)
        if by == "roll":
            yield from edge_words(ds, "further values of {}")

    def facts() -> dict[str, Any]:
        rows = _rows(found)
        for i, row in enumerate(rows):
            row[OTHER] = [float(v) for v in other_rolls(found.isel(rank=i)).values if np.isfinite(v)]
        return {"by": by, "worst": rows}

    return Answer(lines(), facts, next_steps=[f"quartering show {result}"], output=path)


def _names(found: xr.Dataset) -> list[str]:
    """What is told of each condition: where it is, how far it rolls, how fast it grows."""
    return [*(str(name) for name in found.coords if name != "rank"), "roll_peak", "exponent"]


def _rows(found: xr.Dataset) -> list[dict[str, Any]]:
    """The conditions, the worst first; a choice of the ship by its word."""
    from quartering.study.loadings import CHOICE_AXES
    from quartering.view.wording import value_words, verdict_words

    return [
        {
            name: value_words(name, float(found[name][i]), "1") if name in CHOICE_AXES else float(found[name][i])
            for name in _names(found)
        }
        | {"verdict": verdict_words(found.isel(rank=i))}
        for i in range(found.sizes["rank"])
    ]

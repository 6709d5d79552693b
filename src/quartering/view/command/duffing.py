"""`quartering duffing`: the paper's Appendix C against the exact motions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from quartering.conventions import InputError
from quartering.units import Sizes, quantity
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Picture
from quartering.view.console.files import PICTURES, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.typed_values import values

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

_LEAST_RANGE = 0.5
"""Frequencies drawn on either side of a table of one frequency."""
_TITLE = "Duffing's equation: exact motions and the formulas of Haddara (1971), Appendix C"


def duffing(
    beta: Annotated[str, typer.Option(help="Cubic stiffness: x'' + d x' + x + beta x^3 = X0 cos(w t).")] = "0.2",
    force: Annotated[str, typer.Option(help="Force X0.")] = "0.3",
    damping: Annotated[str, typer.Option(help="Damping d.")] = "0",
    frequency: Annotated[
        str, typer.Option(help="Frequencies w of the table: from:to:count or a list; their range is drawn.")
    ] = "0.6,0.8,1,1.2,1.4,1.6",
    output: Picture = None,
) -> Answer:
    """Duffing's equation: the paper's formulas C-3, C-4, C-5 against the exact motions, their folds and stability."""
    import numpy as np

    from quartering.stability.precompile import announce_compilation
    from quartering.study.paper.duffing import duffing_curves, duffing_table
    from quartering.study.paper.duffing_formulas import FORMULAS
    from quartering.view.wording import duffing_words

    stiffness, excitation, friction = (
        quantity(text, "ratio", what=name)
        for text, name in ((beta, "--beta"), (force, "--force"), (damping, "--damping"))
    )
    frequencies = _frequencies(frequency)
    path = reserve_path(output, PICTURES)
    announce_compilation()
    rows = [row for w in frequencies for row in duffing_table(stiffness, excitation, w, friction)]
    low, high = frequencies[0], frequencies[-1]
    if high - low < 1e-9:
        low, high = max(0.5 * low, low - _LEAST_RANGE), high + _LEAST_RANGE
    curves = duffing_curves(stiffness, excitation, friction, (low, high))
    at = curves.isel(point=np.flatnonzero(curves["fold"]))
    names = ("frequency", "fundamental", "peak")
    folds = [dict(zip(names, map(float, row), strict=True)) for row in zip(*(at[n].values for n in names), strict=True)]

    def draw() -> Figure:
        from quartering.view.plots.duffing import duffing_picture

        return duffing_picture(curves, _TITLE)

    def facts() -> dict[str, object]:
        equation = {"beta": stiffness, "force": excitation, "damping": friction}
        return equation | {"formulas": FORMULAS, "motions": rows, "folds": folds}

    return Answer(
        _lines(duffing_words(stiffness, excitation, friction), rows, folds),
        facts,
        picture_files(path, draw),
        next_steps=["quartering duffing --damping 0.05 -o duffing.png", "quartering figures 23"],
    )


def _lines(
    equation: str, rows: Sequence[Mapping[str, Any]], folds: Sequence[Mapping[str, float]]
) -> Iterator[Table | str]:
    """The exact motions at some frequencies, and what each formula says."""
    from quartering.study.paper.duffing_formulas import FORMULAS

    columns = ("ω", "fundamental", "peak", "stable", *(f"{name} (error)" for name in FORMULAS), "C-5 against peak")
    words = [
        (
            f"{row['frequency']:.4g}", f"{row['fundamental']:+.4f}", f"{row['peak']:+.4f}", "yes" if row["stable"] else "no",
            *(f"{row[name]:+.4f} ({_error(row[name], row['fundamental'])})" for name in FORMULAS),
            _error(row["C-5"], row["peak"]),
        )
        for row in rows
    ]  # fmt: skip
    yield table(equation, columns, words, (0, 1, 2, 4, 5, 6, 7))
    yield from (f"Fold at ω = {f['frequency']:.5f}, fundamental {f['fundamental']:+.4f}." for f in folds)
    yield (
        "Negative: opposite in phase to the force. C-3 and C-4 give the fundamental; P of C-5 is the peak away from resonance "
        "and the fundamental on the backbone curve. The formulas leave damping out."
    )


def _frequencies(text: str) -> list[float]:
    """Frequencies above 0 and off the pole of C-5."""
    found = values([text], "ratio", Sizes(1.0, 1.0, 1.0), "--frequency", 6)
    if min(found) <= 0:
        raise InputError(f"--frequency {min(found):g}: a frequency is above 0; the natural one is 1; try 0.6:1.6:6")
    return found


def _error(formula: float, exact: float) -> str:
    import numpy as np

    return f"{100 * (formula / exact - 1):+.2f} %" if np.isfinite(formula) else "none"

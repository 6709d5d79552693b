"""`quartering duffing`: the paper's Appendix C against the exact motions."""

from __future__ import annotations

import numpy as np

from quartering.conventions import InputError
from quartering.stability.ahead import announce_compilation
from quartering.study.paper.duffing import duffing_curves, duffing_table
from quartering.study.paper.duffing_formulas import FORMULAS
from quartering.units import quantity
from quartering.view.options import Sizes, values
from quartering.view.output import PICTURES, claim, write
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import duffing_words

_LEAST_RANGE = 0.5
"""Frequencies drawn on either side of a table of one frequency."""


def compare_formulas(equation: tuple[str, str, str], frequency: str, output: str | None, as_json: bool) -> None:
    """Print the exact motions at some frequencies and what each formula says; draw the curves where asked."""
    beta, force, damping = (
        quantity(text, "ratio", what=name)
        for text, name in zip(equation, ("--beta", "--force", "--damping"), strict=True)
    )
    frequencies = _frequencies(frequency)
    path = claim(output, PICTURES) if output is not None else None
    announce_compilation()
    rows = [row for w in frequencies for row in duffing_table(beta, force, w, damping)]
    low, high = frequencies[0], frequencies[-1]
    if high - low < 1e-9:
        low, high = max(0.5 * low, low - _LEAST_RANGE), high + _LEAST_RANGE
    curves = duffing_curves(beta, force, damping, (low, high))
    at = curves.isel(point=np.flatnonzero(curves["fold"]))
    names = ("frequency", "fundamental", "peak")
    folds = [dict(zip(names, map(float, row), strict=True)) for row in zip(*(at[n].values for n in names), strict=True)]
    title = "Duffing's equation: exact motions and the formulas of Haddara (1971), Appendix C"
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.duffing import duffing_picture

        write((path, lambda part: style.save(duffing_picture(curves, title), part)))
    if as_json:
        show_json(
            {"beta": beta, "force": force, "damping": damping, "formulas": FORMULAS, "motions": rows, "folds": folds}
        )
        return
    columns = ("ω", "fundamental", "peak", "stable", *(f"{name} (error)" for name in FORMULAS), "C-5 against peak")
    words = [
        (
            f"{row['frequency']:.4g}", f"{row['fundamental']:+.4f}", f"{row['peak']:+.4f}", "yes" if row["stable"] else "no",
            *(f"{row[name]:+.4f} ({_error(row[name], row['fundamental'])})" for name in FORMULAS),
            _error(row["C-5"], row["peak"]),
        )
        for row in rows
    ]  # fmt: skip
    show(table(duffing_words(beta, force, damping), columns, words, (0, 1, 2, 4, 5, 6, 7)))
    show(*(f"Fold at ω = {f['frequency']:.5f}, fundamental {f['fundamental']:+.4f}." for f in folds))
    show(
        "Negative: opposite in phase to the force. C-3 and C-4 give the fundamental; P of C-5 is the peak away from resonance "
        "and the fundamental on the backbone curve. The formulas leave damping out."
    )
    if path is not None:
        show(f"Wrote {path}")
    show(next_steps("quartering duffing --damping 0.05 -o duffing.png", "quartering figures 23"))


def _frequencies(text: str) -> list[float]:
    """Frequencies above 0 and off the pole of C-5."""
    found = values([text], "ratio", Sizes(1.0, 1.0, 1.0), "--frequency", 6)
    if min(found) <= 0:
        raise InputError(f"--frequency {min(found):g}: a frequency is above 0; the natural one is 1; try 0.6:1.6:6")
    return found


def _error(formula: float, exact: float) -> str:
    return f"{100 * (formula / exact - 1):+.2f} %" if np.isfinite(formula) else "none"

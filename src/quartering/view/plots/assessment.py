"""A direct assessment drawn: which seas and headings the failures of a ship's life come from."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from quartering.study.seas.failure_rates.assessment_grid import Assessed
from quartering.study.seas.failure_rates.long_term import YEAR
from quartering.view.plots import style
from quartering.view.plots.sea_polar import limit_words

Floats = NDArray[np.float64]
_LEAST_SHARE: Final = 1e-4
"""Share of the largest contribution that the colours end at [1]."""
_SIMULATED: Final = (Assessed.COUNTED, Assessed.BUDGET_SPENT)
_NOTHING: Final = "#ececec"


def assessment_picture(ds: xr.Dataset, loading: int = 0) -> Figure:
    """Draw the contributions of a direct assessment.

    ds: from `quartering.direct_assessment`
    loading: which of its loadings
    Returns by sea on the left, by heading on the right
    """
    one = ds.isel(loading=loading)
    made = style.figure(style.PAGE, 5.4)
    left, right = made.subplots(1, 2, width_ratios=(1.35, 1.0))
    _by_sea(made, left, one)
    _by_heading(right, one)
    style.title(made, f"{ds.attrs['ship']}: failures over all seas, {ds.attrs['sea']}\n{sum_words(one)}")
    style.footnote(made, "\n".join(_notes(ds, one)))
    return made


def sum_words(one: xr.Dataset) -> str:
    """The sum with its interval."""
    rate, lower, upper = (float(one[f"long_term_{end}"]) for end in ("rate", "lower", "upper"))
    if rate == 0.0:
        return f"no failure counted; at most {_few(upper * YEAR)} failures a year"
    return f"{_few(rate * YEAR)} failures a year, 95 % interval {_few(lower * YEAR)} to {_few(upper * YEAR)}"


def _few(number: float) -> str:
    """A number in two digits."""
    return f"{float(f'{number:.1e}'):,.0f}" if 10.0 <= number < 1e9 else f"{number:.2g}"


def _by_sea(made: Figure, ax: Axes, one: xr.Dataset) -> None:
    """Contribution of each height and period."""
    part = one["contribution"].sum(("speed", "heading")).transpose("hs", "tz").values
    hs, tz = one["hs"].values, one["tz"].values
    known = (
        np.isin(one["status"].transpose("hs", "tz", ...).values, _SIMULATED).reshape(hs.size, tz.size, -1).any(axis=2)
    )
    met = one["weight"].sum(("speed", "heading")).transpose("hs", "tz").values > 0
    ax.pcolormesh(
        _edges(tz), _edges(hs), np.where(met, 1.0, np.nan), cmap="Greys", vmin=0.0, vmax=14.0, rasterized=True
    )
    top = part.max()
    if top > 0:
        shown = np.where(part > 0, np.maximum(part, _LEAST_SHARE * top), np.nan)
        mesh = ax.pcolormesh(_edges(tz), _edges(hs), shown, norm=LogNorm(_LEAST_SHARE * top, top), cmap=style.SEQUENTIAL,
                             rasterized=True)  # fmt: skip
        made.colorbar(mesh, ax=ax, location="bottom", shrink=0.9, aspect=30).set_label(
            f"failures [1/s], share of time times rate; from {_LEAST_SHARE:g} of the largest"
        )
    for i, j in np.argwhere(known):
        ax.plot(tz[j], hs[i], **_DOT)
    lost = (
        np.isin(one["status"].transpose("hs", "tz", ...).values, Assessed.NOT_KNOWN)
        .reshape(hs.size, tz.size, -1)
        .any(axis=2)
    )
    for i, j in np.argwhere(lost & met):
        ax.plot(tz[j], hs[i], marker="x", color=style.WARNING_INK, markersize=7)
    handles: list[Line2D | Patch] = [
        Line2D([], [], label="simulated at some heading", **_DOT),
        Patch(facecolor=_NOTHING, label="met, but cannot matter, or no failure"),
    ]
    if (lost & met).any():
        cross: dict[str, Any] = {"linestyle": "", "marker": "x", "color": style.WARNING_INK}
        handles.append(Line2D([], [], label="no answer at some heading: fails in every run-up", **cross))
    ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False)
    ax.set(xlabel="mean period Tz [s]", ylabel="significant height Hs [m]")
    ax.set_xticks(tz[:: -(-tz.size // 9)])
    ax.set_yticks(hs[:: -(-hs.size // 9)])
    ax.grid(visible=False)


_DOT: Final[dict[str, Any]] = {
    "color": "white", "linestyle": "", "marker": ".", "markeredgecolor": "black", "markersize": 5, "markeredgewidth": 0.5,
}  # fmt: skip


def _by_heading(ax: Axes, one: xr.Dataset) -> None:
    """Contribution of each heading, and what it may be at most."""
    weight = one["weight"]
    over = ("hs", "tz", "speed")
    value, most = one["contribution"].sum(over).values, (weight * one["rate_upper"]).sum(over).values
    heading = one["heading"].values
    width = 0.8 * float(np.diff(np.sort(heading)).min(initial=15.0)) if heading.size > 1 else 10.0
    ax.bar(heading, value, width, color=style.CONTRAST[0], label="found")
    ax.plot(heading, most, linestyle="", marker="_", markersize=12, markeredgewidth=2, color=style.CONTRAST[1],
            label="at most: upper ends added")  # fmt: skip
    if (value > 0).any() or (most > 0).any():
        ax.set_yscale("log")
        ax.set_ylim(bottom=max(most.max() * 1e-6, 1e-18))
    level = float(one.attrs["safety_level_rate"])
    ax.axhline(
        level, linestyle="--", linewidth=1.0, color=style.INK, label=f"safety level of all together, {level:.2g} 1/s"
    )
    ax.set(xlabel="heading [deg]: 0 following, 180 head sea", ylabel="failures [1/s]")
    ax.set_xticks(np.arange(0, max(heading.max(), 1) + 1, 30 if heading.max() > 60 else 15))
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False)


def _edges(values: Floats) -> Floats:
    """Edges of cells about values."""
    if values.size == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def _notes(ds: xr.Dataset, one: xr.Dataset) -> list[str]:
    status = one["status"].values
    counts = ", ".join(f"{n} {kind.label}" for kind in Assessed if (n := int((status == kind).sum())))
    said = [
        f"Simulated {float(one['hours_spent']):,.0f} h, seed {ds.attrs['seed']}, {float(ds.attrs['hours']):g} h a cell at most:"
        f" {limit_words(ds)}. Cells: {counts}.",
        f"Left out: at most {float(one['left_out']):.2g} 1/s by their upper ends; carried down in height"
        f" {float(one['carried_down']):.2g} 1/s; not judged {float(one['not_judged']):.2%} of the time.",
        f"Table of seas: {ds.attrs['table']}. Safety level {ds.attrs['safety_level']}. No compliance with any rule is shown.",
    ]
    if one.attrs.get("estimated_coefficients"):
        said.append(f"Estimated: {one.attrs['estimated_by']}.")
    return said

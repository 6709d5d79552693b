"""Operational polar diagrams: radius is speed, angle is heading, one diagram for each sea."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.projections.polar import PolarAxes
from numpy.typing import NDArray

from quartering.study.seas.over_seas.advice import Advice
from quartering.study.seas.over_seas.map_axes import mirrors, period_of
from quartering.units import quantity
from quartering.view.plots import style
from quartering.view.plots.guidance import round_knots
from quartering.view.plots.polar_map import GREY, HATCHES, OUTLINE, Mark, edges, paint_cells

Floats = NDArray[np.float64]
MOST_ROWS, MOST_COLUMNS = 3, 4
"""Heights and periods that are drawn; of more, some from all over."""
_LEAST_RATE: Final = 1e-12
_FILL: Final = "#31688e"
_UNDECIDED_INK: Final = "#ffb38a"
_DASHES: Final = {"synchronous": "-", "parametric": "--"}


def sea_polar(ds: xr.Dataset, loading: int = 0) -> Figure:
    """Draw operational guidance: one diagram for each height and period of the sea.

    ds: from `quartering.guidance`
    loading: which of its loadings
    Returns bow up, the sea from the side of the cell; colour is the mean largest roll of three hours, or the rate of failures
    """
    part = ds.isel(loading=loading)
    rows, columns = _some(part.sizes["hs"], MOST_ROWS), _some(part.sizes[period_of(part)], MOST_COLUMNS)
    lying = len(columns) == 1  # heights of one period stand side by side
    down, across = (1, len(rows)) if lying else (len(rows), len(columns))
    made = style.figure(max(2.9 * across + 1.3, 7.4), 3.25 * down + 2.1)
    made.get_layout_engine().set(hspace=0.08)  # type: ignore[union-attr, call-arg]  # "following" and the next title apart
    panels = made.subplots(down, across, subplot_kw={"projection": "polar"}, squeeze=False)
    at = panels.T if lying else panels
    values, colours, words = _coloured(part)
    for i, row in enumerate(rows):
        for j, column in enumerate(columns):
            where = {"hs": row, period_of(part): column}
            one = part.isel(where)
            mesh = _panel(at[i, j], one, values.isel(where), colours)
    style.title(made, f"{ds.attrs['ship']} in irregular seas, {ds.attrs['sea']}\n{ds.attrs['loading']}")
    scale = made.colorbar(mesh, ax=list(panels.ravel()), shrink=0.8, pad=0.03, aspect=28)
    scale.set_label(words)
    told, wide = list(_legend(part)), 3 if across > 2 else 2
    high = 0.1 + 0.2 * -(-len(told) // wide)
    end = style.footnote(made, "\n".join(_notes(ds, part, rows, columns)), above=high)
    made.legend(handles=told, loc="lower left", bbox_to_anchor=(0.008, end), ncols=wide, **_DARK)
    return made


_DARK: Final[dict[str, Any]] = {
    "facecolor": "#4a4063", "edgecolor": "none", "labelcolor": "white", "framealpha": 1.0, "handlelength": 2.8, "fontsize": 8,
}  # fmt: skip


def _some(count: int, most: int) -> list[int]:
    return sorted(set(np.linspace(0, count - 1, min(count, most)).round().astype(int).tolist()))


def _coloured(part: xr.Dataset) -> tuple[xr.DataArray, Normalize, str]:
    """What the colours show, their scale, and its label."""
    if part.attrs["judge"] == "rate":
        rate = part["failure_rate"].where(part["recommended"] != int(Advice.NOT_VALID)).clip(min=_LEAST_RATE)
        top = max(float(rate.max()), 1e-3)
        return rate, LogNorm(_LEAST_RATE, top), "failures [1/s]: counted, or of a Gaussian motion"
    limit = float(part.attrs["roll_limit"])
    return (
        part["roll_mean_3h_max"],
        Normalize(0.0, limit),
        f"mean largest roll of 3 h [deg], up to the limit of {limit:.3g}",
    )


def _panel(ax: PolarAxes, one: xr.Dataset, values: xr.DataArray, colours: Normalize) -> Any:
    heading, speed = one["heading"].values, one["speed"].values
    mirrored = mirrors(one)
    theta = np.radians(edges(heading, 5.0))
    theta = np.clip(theta, 0.0, np.pi) if mirrored else theta
    r = np.maximum(edges(speed, 1.0), 0.0)
    ax.set_theta_zero_location("S")
    ax.set_theta_direction(-1)
    advice = one["recommended"].transpose("heading", "speed").values
    marks: list[Mark] = [
        ("not valid", advice == Advice.NOT_VALID, {"facecolor": GREY, "edgecolor": GREY}),
        ("not recommended", advice == Advice.NOT_RECOMMENDED, {"facecolor": "none", "edgecolor": "white"}),
        ("undecided", advice == Advice.UNDECIDED, {"facecolor": "none", "edgecolor": _UNDECIDED_INK}),
    ]
    for side in (1.0, -1.0) if mirrored else (1.0,):
        shown = values.transpose("heading", "speed").values
        mesh = paint_cells(ax, side * theta, r, shown, marks, colours, style.SEQUENTIAL)
    _danger_lines(ax, one, r[-1])
    _dress(ax, one, r[-1])
    return mesh


def _danger_lines(ax: PolarAxes, one: xr.Dataset, largest: float) -> None:
    """The lines U cos mu = constant: at right angles to the way of the ship."""
    for name, speed in zip(one["line"].values.tolist(), one["pile_up"].values.tolist(), strict=True):
        if speed < largest:
            end = np.arccos(speed / largest)
            at = np.linspace(-end, end, 181)
            ax.plot(at, speed / np.cos(at), _DASHES[name], color="white", linewidth=1.4, path_effects=OUTLINE, gid=name)


def _dress(ax: PolarAxes, one: xr.Dataset, largest: float) -> None:
    ax.set_rlim(0.0, largest)
    knots = quantity("1 kn", "speed")
    rings = round_knots(largest / knots)
    ax.set_rgrids([ring * knots for ring in rings], [f"{ring:g} kn" for ring in rings], angle=157.5, fontsize=7)
    for label in ax.get_yticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.6})
    words = {0: "0° following", 180: "180° head"}
    angles = range(0, 360, 30)
    ax.set_thetagrids(
        angles, [words.get(a, f"{360 - a if a > 180 and mirrors(one) else a}°") for a in angles], fontsize=7
    )
    ax.grid(visible=True, color="white", alpha=0.3, linewidth=0.5)
    ax.set_title(f"Hs {float(one['hs']):.3g} m, Tp {float(one['tp']):.3g} s", fontsize=9, pad=8)


def _legend(part: xr.Dataset) -> Iterator[Line2D | Patch]:
    advice = part["recommended"].values
    dark = {"path_effects": OUTLINE, "linewidth": 1.4, "color": "white"}
    line, half = part["pile_up"].values
    yield Line2D([], [], linestyle="-", label=f"U cos μ = {line:.3g} m/s: roll in step, any period", **dark)
    yield Line2D([], [], linestyle="--", label=f"U cos μ = {half:.3g} m/s: parametric roll", **dark)
    if (advice == Advice.NOT_RECOMMENDED).any():
        yield Patch(facecolor=_FILL, edgecolor="white", hatch=HATCHES["not recommended"], label="not recommended")
    if (advice == Advice.UNDECIDED).any():
        yield Patch(
            facecolor=_FILL,
            edgecolor=_UNDECIDED_INK,
            hatch=HATCHES["undecided"],
            label="undecided: the interval straddles",
        )
    if (advice == Advice.NOT_VALID).any():
        yield Patch(facecolor=GREY, label="not valid: the sea breaks, or surf-riding")


def _notes(ds: xr.Dataset, part: xr.Dataset, rows: list[int], columns: list[int]) -> Iterator[str]:
    sides = " The two sides mirror each other." if mirrors(ds) else ""
    yield f"Bow up, the sea comes from the side of the cell; radius is speed.{sides}"
    yield f"{ds.attrs['threshold_words'].capitalize()} ({ds.attrs['threshold_source']}): {limit_words(ds)}."
    hours = float(ds.attrs["hours"])
    simulated = (
        f"Where that does not decide, up to {hours:g} h were simulated (seed {ds.attrs['seed']})."
        if hours > 0
        else "Where that does not decide, nothing was simulated."
    )
    yield f"By statistical linearisation; {ds.attrs['interval_of_closure']}. {simulated}"
    if ds.sizes["loading"] > 1 or len(rows) < part.sizes["hs"] or len(columns) < part.sizes[period_of(part)]:
        yield (
            f"Drawn: loading 1 of {ds.sizes['loading']}, {len(rows)} of {part.sizes['hs']} heights, {len(columns)} of"
            f" {part.sizes['tz']} periods."
        )
    if part.attrs.get("estimated_coefficients"):
        yield f"Estimated: {part.attrs['estimated_by']}."


def limit_words(ds: xr.Dataset) -> str:
    """What a failure is."""
    felt = ds.attrs["acceleration_limit"]
    other = f" or {felt:.3g} m/s² across the deck" if isinstance(felt, (int, float)) else ""
    return f"a failure is a roll of {float(ds.attrs['roll_limit']):.3g} deg{other}"

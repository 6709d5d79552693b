"""The paper's curves: response (Figs. 5-10), effect of loading (14-21) and coefficients (22)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from quartering.conventions import SYMBOLS, written
from quartering.stability.kind import Kind
from quartering.study.condition.resonance import resonant_headings
from quartering.view.plots import style
from quartering.view.plots.paper_caption import caption

_SIZES: Final = {"gm": "B", "gyradius_roll": "B", "gyradius_yaw": "L"}
_EVERY: Final = 18.0
"""Degrees of heading between markers on a line."""


def response_picture(ds: xr.Dataset, name: str, title: str) -> Figure:
    """One response over heading for several wave lengths, unstable motions and the roll resonance marked.

    ds: of `response_curves`
    name: "sway", "roll" or "yaw"
    """
    made = style.figure(9.5, 5.6)
    ax = made.subplots()
    looks = style.looks(ds.sizes["wave_length"])
    for i, look in enumerate(looks):
        one = ds.isel(wave_length=i)
        ax.plot(ds["heading"], one[name], **look, markevery=_points_in(_EVERY, ds), markersize=4)
        _mark_unstable(ax, one, name)
        for heading in resonant_headings(one):
            ax.plot(heading, 0.0, color=look["color"], marker=look["marker"], markersize=9, clip_on=False, zorder=4)
    style.headings(ax)
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel(f"{name} amplitude [{SYMBOLS[name].unit}]")
    ax.set_gid(name)
    _legend(made, looks, [f"λ/L = {x:.3g}" for x in _ratio(ds)], _unstable_handles([ds]))
    style.title(made, title)
    marks = "Large marks on the heading axis: encounter at the natural roll frequency."
    style.footnote(made, caption(ds, marks))
    return made


def loading_picture(sets: Mapping[str, xr.Dataset], name: str, title: str, note: str = "") -> Figure:
    """One response over heading for several values of each loading quantity.

    sets: of `loading_curves`
    name: "sway", "roll" or "yaw"
    """
    made = style.figure(_width(sets), 5.6)
    panels = np.atleast_1d(made.subplots(1, len(sets), sharey=True))
    for ax, (quantity, ds) in zip(panels, sets.items(), strict=True):
        looks = style.looks(ds.sizes["loading"])
        for i, (look, label) in enumerate(zip(looks, _loading_labels(ds, quantity), strict=True)):
            one = ds.isel(loading=i)
            ax.plot(ds["heading"], one[name], **look, markevery=_points_in(_EVERY, ds), markersize=4, label=label)
            _mark_unstable(ax, one, name)
        style.headings(ax)
        ax.set_gid(name)
        ax.legend(frameon=False, loc="upper right")
    panels[0].set_ylim(bottom=0.0)
    panels[0].set_ylabel(f"{name} amplitude [{SYMBOLS[name].unit}]")
    style.title(made, title)
    one = next(iter(sets.values()))
    style.footnote(made, caption(one, note, *_marked(list(sets.values())), loading=_other_loading(one)))
    return made


def stability_picture(sets: Mapping[str, xr.Dataset], title: str, note: str = "") -> Figure:
    """K2, and beside its growth rate the largest Floquet exponent, over heading for several values of each quantity.

    sets: of `loading_curves`
    """
    made = style.figure(_width(sets), 8.4)
    panels = made.subplots(2, len(sets), sharex=True, sharey="row", squeeze=False)
    for (upper, lower), (quantity, ds) in zip(panels.T, sets.items(), strict=True):
        looks = style.looks(ds.sizes["loading"])
        for i, (look, label) in enumerate(zip(looks, _loading_labels(ds, quantity), strict=True)):
            _stability_lines(upper, lower, ds["heading"], ds.isel(loading=i), look, label, _points_in(_EVERY / 2, ds))
        upper.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
        style.headings(lower)
    _stability_axes(panels)
    style.title(made, title)
    one = next(iter(sets.values()))
    style.footnote(made, caption(one, note, *_told(list(sets.values())), loading=_other_loading(one)))
    return made


def coefficient_picture(sets: Mapping[str, xr.Dataset], title: str) -> Figure:
    """K2, and beside its growth rate the largest Floquet exponent, against the change of one coefficient at a time.

    sets: of `coefficient_curves`, a column each
    """
    made = style.figure(13.6, 8.0)
    panels = made.subplots(2, len(sets), sharex=True, squeeze=False)
    for (upper, lower), (words, ds) in zip(panels.T, sets.items(), strict=True):
        looks = style.looks(ds.sizes["coefficient"])
        for i, (look, label) in enumerate(zip(looks, ds["coefficient"].values, strict=True)):
            _stability_lines(upper, lower, ds["change"], ds.isel(coefficient=i), look, str(label), 2)
        upper.set_title(words)
        lower.set_xlabel("change of the coefficient [%]")
    _stability_axes(panels)
    labels = [str(name) for name in next(iter(sets.values()))["coefficient"].values]
    _legend(made, style.looks(len(labels)), labels)
    style.title(made, title)
    one = next(iter(sets.values()))
    style.footnote(made, caption(one, *_told(list(sets.values()))))
    return made


def _width(sets: Mapping[str, xr.Dataset]) -> float:
    return 9.5 if len(sets) == 1 else 13.2


def _ratio(ds: xr.Dataset) -> np.ndarray:
    return np.asarray(ds["wave_length"]) / float(ds.attrs["ship_length"])


def _legend(
    made: Figure,
    looks: Sequence[dict[str, object]],
    labels: Sequence[str],
    more: Sequence[Line2D] = (),
) -> None:
    handles = [Line2D([], [], **look, label=label) for look, label in zip(looks, labels, strict=True)]
    made.legend(handles=[*handles, *more], loc="outside right center", frameon=False)


def _points_in(degrees: float, ds: xr.Dataset) -> int:
    """Headings of a dataset in so many degrees, at least one."""
    heading = np.asarray(ds["heading"], dtype=float)
    return max(1, round(degrees * (heading.size - 1) / (float(np.ptp(heading)) or 1.0)))


def _is_unstable(ds: xr.Dataset) -> np.ndarray:
    return np.asarray(ds["verdict"]) > Kind.STABLE


def _mark_unstable(ax: Axes, ds: xr.Dataset, name: str) -> None:
    here = _is_unstable(ds)
    look = {"color": style.WARNING_INK, "marker": "x", "linestyle": "none", "markersize": 6}
    ax.plot(ds["heading"].values[here], ds[name].values[here], **look)


def _unstable_handles(sets: Sequence[xr.Dataset]) -> list[Line2D]:
    if not any(_is_unstable(ds).any() for ds in sets):
        return []
    return [Line2D([], [], color=style.WARNING_INK, marker="x", linestyle="none", label="unstable (Floquet)")]


def _marked(sets: Sequence[xr.Dataset]) -> list[str]:
    return ["Crosses: unstable by Floquet."] if any(_is_unstable(ds).any() for ds in sets) else []


def _stability_lines(
    upper: Axes, lower: Axes, along: xr.DataArray, ds: xr.Dataset, look: dict[str, object], label: str, every: int
) -> None:
    """K2 above; below, the largest Floquet exponent as a line and K2/(2 n2) as open marks of the same colour."""
    upper.plot(along, ds["k2"], **look, markevery=2 * every, markersize=4, label=label)
    lower.plot(along, ds["exponent"], color=look["color"], linestyle=look["linestyle"])
    marks = {"color": look["color"], "marker": look["marker"], "markerfacecolor": "none", "linestyle": "none"}
    lower.plot(along, -ds["index"], **marks, markevery=every, markersize=5)


def _stability_axes(panels: np.ndarray) -> None:
    for ax in panels.flat:
        ax.axhline(0.0, color=style.INK, linewidth=0.8)
    for upper, lower in panels.T:
        upper.set_gid("k2")
        lower.set_gid("growth")
        lower.set_title("line: largest Floquet exponent; open marks: K2/(2 n2)", fontsize=9)
    panels[0, 0].set_ylabel("K2 [1/s²], positive is unstable")
    panels[1, 0].set_ylabel("growth rate [1/s]")


def _told(sets: Sequence[xr.Dataset]) -> list[str]:
    """How often the index told the truth."""
    kinds = np.concatenate([np.asarray(ds["verdict"]).ravel() for ds in sets])
    k2 = np.concatenate([np.asarray(ds["k2"]).ravel() for ds in sets])
    judged = (kinds >= Kind.STABLE) & np.isfinite(k2)
    unstable, alarm = kinds[judged] > Kind.STABLE, k2[judged] > 0
    agree = int((unstable == alarm).sum())
    words = f"Of {judged.sum()} motions {unstable.sum()} are unstable by Floquet, {alarm.sum()} by K2; they agree in {agree}."
    silent = int((kinds >= Kind.STABLE).sum() - judged.sum())
    return [words + (f" {silent} more have no K2 (the mean roll stiffness is negative)." if silent else "")]


def _loading_labels(ds: xr.Dataset, quantity: str) -> list[str]:
    symbol, unit = written(quantity), _SIZES[quantity]
    size = float(ds.attrs["ship_beam" if unit == "B" else "ship_length"])
    return [f"{symbol} = {v:.3g} m ({v / size:.3g} {unit})" for v in np.asarray(ds[quantity], dtype=float)]


def _other_loading(ds: xr.Dataset) -> str:
    return f"unless said otherwise {ds.attrs['loading']}"

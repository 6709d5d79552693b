"""Duffing's equation over frequency (Fig. 23 of the paper): exact motions, their stability, and the three formulas."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from quartering.study.paper.duffing import nearest_root
from quartering.study.paper.duffing_formulas import duffing_amplitudes
from quartering.view.plots import style
from quartering.view.wording import duffing_words

_FORMULAS = {"C-3": ("Struble", ":"), "C-4": ("modified method", "-."), "C-5": ("Hsu", "--")}
_FREQUENCIES = 600
_POLE = 0.02
_WORST = 6.0
"""Largest error shown [%]."""


def duffing_picture(ds: xr.Dataset, title: str) -> Figure:
    """Fundamental and peak over frequency.

    ds: of `duffing_curves`
    """
    made = style.figure(12.5, 8.0)
    panels, errors = made.subplots(2, 2, sharex=True, sharey="row", height_ratios=(2.0, 1.0))
    top = 1.05 * float(np.abs(ds["peak"]).max())
    for ax, quantity, words in zip(
        panels, ("fundamental", "peak"), ("amplitude of the fundamental |P|", "largest value |x|"), strict=True
    ):
        _exact(ax, ds, quantity)
        for name, colour in zip(_FORMULAS, style.CONTRAST[:3], strict=True):
            _formula(ax, ds, name, colour)
        ax.set_ylim(0.0, top)
        ax.set_xlim(float(ds["frequency"].min()), float(ds["frequency"].max()))
        ax.set_ylabel(words)
        ax.set_title(quantity)
        ax.set_gid(quantity)
    for ax, quantity in zip(errors, ("fundamental", "peak"), strict=True):
        for name, colour in zip(_FORMULAS, style.CONTRAST[:3], strict=True):
            _error(ax, ds, quantity, name, colour)
        ax.axhline(0.0, color=style.INK, linewidth=0.8)
        ax.set_ylim(-_WORST, _WORST)
        ax.set_xlabel("frequency ω (natural frequency 1)")
        ax.set_ylabel(f"formula minus {quantity} [%],\nmotion in phase")
        ax.set_gid(f"{quantity}_error")
    handles, labels = panels[0].get_legend_handles_labels()
    made.legend(handles, labels, loc="outside right center", frameon=False)
    a = ds.attrs
    style.title(made, title)
    style.footnote(
        made,
        f"{duffing_words(a['beta'], a['force'], a['damping'])}. Exact: harmonic balance to harmonic {a['harmonics']}, "
        "its curves followed through their folds, stability by Floquet multipliers (without damping stable means neutral). "
        "The formulas (undamped) are the same in both panels: C-3 and C-4 are of the fundamental; P of C-5 is the peak away "
        "from resonance and the fundamental on the backbone curve.",
    )
    return made


def _error(ax: Axes, ds: xr.Dataset, quantity: str, name: str, colour: str) -> None:
    """How far a formula is from the exact motion in phase with the force."""
    here = ds[quantity].values > 0
    order = np.argsort(ds["frequency"].values[here], kind="stable")
    frequency, exact = ds["frequency"].values[here][order], ds[quantity].values[here][order]
    keep = np.abs(frequency - 1 / 3) > (_POLE if name == "C-5" else 0.0)
    frequency, exact = frequency[keep], exact[keep]
    found = [
        nearest_root(duffing_amplitudes(name, ds.attrs["beta"], ds.attrs["force"], float(w)), float(p))
        for w, p in zip(frequency, exact, strict=True)
    ]
    ax.plot(frequency, 100 * (np.array(found) / exact - 1), color=colour, linestyle=_FORMULAS[name][1], linewidth=1.4)


def _exact(ax: Axes, ds: xr.Dataset, quantity: str) -> None:
    """Stable parts in full, unstable ones thin, folds as points."""
    frequency, size = ds["frequency"].values, np.abs(ds[quantity].values)
    stable, curve = ds["stable"].values, ds["curve"].values
    for chosen, words, width in ((stable, "exact, stable", 2.6), (~stable, "exact, unstable", 1.0)):
        label: str | None = words
        for index in np.unique(curve):
            here = curve == index
            shown = np.where(chosen[here] | np.roll(chosen[here], 1) & ds["fold"].values[here], size[here], np.nan)
            if np.isfinite(shown).any():
                ax.plot(frequency[here], shown, color=style.INK, linewidth=width, label=label)
                label = None
    fold = ds["fold"].values
    if fold.any():
        look = {"color": style.WARNING_INK, "marker": "o", "linestyle": "none"}
        ax.plot(frequency[fold], size[fold], **look, label="fold", zorder=5)


def _turns(name: str, ds: xr.Dataset, grid: NDArray[np.float64]) -> list[float]:
    """Frequencies closer and closer to those where roots of a formula meet, so that its curves are drawn to their turn."""

    def count(w: float) -> int:
        return int(duffing_amplitudes(name, ds.attrs["beta"], ds.attrs["force"], w).size)

    found, counts = [], [count(float(w)) for w in grid]
    for i in np.flatnonzero(np.diff(counts)):
        ends = [float(grid[i]), float(grid[i + 1])]
        for _ in range(30):
            middle = 0.5 * sum(ends)
            found.append(middle)
            ends[0 if count(middle) == counts[i] else 1] = middle
    return found


def _formula(ax: Axes, ds: xr.Dataset, name: str, colour: str) -> None:
    """All roots of a formula, a branch each: by side of the force and by size."""
    low, high = float(ds["frequency"].min()), float(ds["frequency"].max())
    words, dash = _FORMULAS[name]
    grid = np.linspace(low, high, _FREQUENCIES)
    grid = grid[np.abs(grid - 1 / 3) > _POLE] if name == "C-5" else grid
    grid = np.sort(np.concatenate([grid, _turns(name, ds, grid)]))
    roots = np.full((grid.size, 4), np.nan)
    for i, w in enumerate(grid):
        found = duffing_amplitudes(name, ds.attrs["beta"], ds.attrs["force"], float(w))
        ahead, behind = found[found > 0], found[found <= 0]
        for group, first in ((ahead, 0), (behind, 2)):
            roots[i, first : first + min(group.size, 2)] = np.sort(np.abs(group))[:2]
    for k, branch in enumerate(roots.T):
        label = f"{name}, {words}" if k == 0 else None
        ax.plot(grid, branch, color=colour, linestyle=dash, linewidth=1.4, label=label)

"""The paper's motions: approximate solution beside integration (Fig. 11), growing disturbances (Figs. 12, 13)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from quartering.study.paper.sets import Growth, roll_rate
from quartering.view.plots import style

_SOLUTIONS = {
    "struble": ("modified Struble: one harmonic, linear third", {"color": style.CONTRAST[0], "linestyle": "-"}),
    "balance": ("harmonic balance, 9 harmonics", {"color": style.CONTRAST[2], "linestyle": "--"}),
    "integration": ("full equations integrated", {"color": style.CONTRAST[1], "linestyle": "none", "marker": "o",
                                                   "markerfacecolor": "none"}),
}  # fmt: skip


def integration_picture(ds: xr.Dataset, time: xr.Dataset, at: float, title: str, note: str) -> Figure:
    """Largest roll over heading by each method, and one motion in time.

    ds: of `integration_check`
    time: of `time_check`
    at: its heading [deg]
    """
    made = style.figure(12.0, 7.0)
    panels = made.subplot_mosaic([["roll", "time"], ["error", "time"]], height_ratios=(1.6, 1.0))
    upper, lower, right = panels["roll"], panels["error"], panels["time"]
    exact = ds["roll_peak"].sel(solution="integration")
    for name, (words, look) in _SOLUTIONS.items():
        own = ds["roll_peak"].sel(solution=name)
        upper.plot(ds["heading"], own, **look, label=words)
        if name != "integration":
            lower.plot(ds["heading"], 100 * (own / exact - 1), **look)
    for ax in (upper, lower):
        style.headings(ax)
    upper.set_xlabel("")
    upper.set_ylim(bottom=0.0)
    upper.set_ylabel("largest roll [deg]")
    upper.set_gid("roll_peak")
    upper.legend(frameon=False)
    lower.set_ylabel("difference from\nintegration [%]")
    right.plot(time["time"], time["approximate"], **_SOLUTIONS["struble"][1], label=_SOLUTIONS["struble"][0])
    every = slice(None, None, 5)
    right.plot(
        time["time"][every], time["integrated"][every], **_SOLUTIONS["integration"][1], label="integrated from rest"
    )
    right.set_xlabel("time after 60 periods [s]")
    right.set_ylabel("roll [deg]")
    right.set_title(f"heading {at:g} deg")
    right.legend(frameon=False, loc="upper right")
    right.set_gid("roll")
    top = float(np.abs(time["integrated"]).max())
    right.set_ylim(-1.15 * top, 1.5 * top)
    style.title(made, title)
    style.footnote(made, note)
    return made


def growth_picture(cases: Sequence[Growth], linear: bool, title: str, note: str) -> Figure:
    """Roll in time of a stable and an unstable case, under each other.

    linear: a disturbance by the variational equations, with the envelopes of the exponents; or the motion itself
    """
    made = style.figure(11.0, 3.1 * len(cases) + 1.0)
    panels = np.atleast_1d(made.subplots(len(cases), 1, sharex=True))
    for ax, case in zip(panels, cases, strict=True):
        time, roll = case.trace["time"].values, case.trace["roll"].values
        ax.plot(time, roll, color=style.CONTRAST[0], linewidth=1.0, label="roll")
        if linear:
            _envelopes(ax, case, time, float(roll[0]))
        else:
            for side in (1, -1):
                words = f"steady motion, ±{case.steady_roll:.3g}°" if side > 0 else None
                ax.axhline(side * case.steady_roll, color=style.INK, linestyle="--", linewidth=0.9, label=words)
        ax.set_ylabel("disturbance of roll [deg]" if linear else "roll [deg]")
        ax.set_title(
            f"{case.words}: {'stable' if case.verdict.stable else f'unstable ({case.verdict.kind})'}; "
            f"K2 {case.verdict.k2:+.4f} 1/s², largest Floquet exponent {case.verdict.exponents[0].real:+.4f} 1/s",
            loc="left",
        )
        ax.legend(frameon=False, loc="upper left", ncols=3)
        low, high = ax.get_ylim()
        ax.set_ylim(low, high + 0.25 * (high - low))
    panels[-1].set_xlabel("time [s]")
    panels[-1].set_xlim(0.0, float(time[-1]))
    panels[-1].set_gid("roll")
    style.title(made, title)
    style.footnote(made, note)
    return made


def _envelopes(ax: object, case: Growth, time: np.ndarray, start: float) -> None:
    rates = (("Floquet, roll pair", roll_rate(case.verdict), "--"), ("K2/(2 n2)", -case.verdict.index, ":"))
    for words, rate, dash in rates:
        curve = start * np.exp(rate * time)
        ax.plot(time, curve, color=style.INK, linestyle=dash, label=f"{words}: {rate:+.4f} 1/s")  # type: ignore[attr-defined]
        ax.plot(time, -curve, color=style.INK, linestyle=dash)  # type: ignore[attr-defined]

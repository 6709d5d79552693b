"""The righting arm: heeled sections, the polynomial fitted to them, and the tangent GM."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from quartering.hull.lines.section import Floats
from quartering.hull.righting.arm import RightingFit
from quartering.view.plots import style


def draw_righting_arm(
    ax: Axes,
    angles: Floats,
    arms: Floats,
    fit: RightingFit,
    used: bool = True,
    waves: Mapping[str, Floats] | None = None,
) -> None:
    """Draw GZ over heel with its fit and its slope at 0.

    angles (n,): heel, from 0 up [deg]
    arms (n,): GZ [m]
    used: is the fit what the equations carry? Otherwise it is for comparison
    waves: arms on waves by what they are called; the fit then gives way to them
    """
    ax.axhline(0.0, color=style.QUIET, linewidth=0.8)
    if waves:
        _draw_waves(ax, angles, arms, waves)
        return
    ax.plot(angles, arms, color=style.INK, linewidth=1.8, label="GZ of the heeled sections")
    fitted = np.linspace(0.0, fit.max_angle, 60)
    order = 7 if fit.gz7 else 5 if fit.gz5 else 3
    words = f"fit to φ{'³⁵⁷'[(order - 3) // 2]}, up to {fit.max_angle:g}° (misses by {100 * fit.residual:.1f} %)"
    words += "" if used else ", not used"
    ax.plot(fitted, fit.arm(fitted), color=style.CONTRAST[1], linewidth=1.4, linestyle="--", label=words)
    one = np.degrees(1.0)
    ax.plot([0.0, one], [0.0, fit.gm], color=style.CONTRAST[0], linewidth=1.0, label=f"GM = {fit.gm:.3g} m at 1 rad")
    ax.plot(one, fit.gm, marker="o", markersize=4, color=style.CONTRAST[0])
    if np.isfinite(fit.deck_angle) and fit.deck_angle < angles[-1]:
        ax.axvline(fit.deck_angle, color=style.QUIET, linewidth=0.9, linestyle=":", label="deck edge goes under")
    top = max(float(np.max(arms)), fit.gm)
    ax.set(xlim=(0, angles[-1]), ylim=(min(0.0, float(np.min(arms))) - 0.03 * top, 1.08 * top))
    ax.set_xlabel("heel angle φ [deg]")
    ax.set_ylabel("righting arm GZ [m]")
    ax.set_title("Righting arm in calm water")
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", loc="best")


def _draw_waves(ax: Axes, angles: Floats, arms: Floats, waves: Mapping[str, Floats]) -> None:
    """Calm water beside the positions of a wave."""
    ax.plot(angles, arms, color=style.INK, linewidth=1.8, label="calm water")
    for (words, on_wave), colour, dashes in zip(waves.items(), style.CONTRAST, ("--", "-.", ":", "-"), strict=False):
        ax.plot(angles, on_wave, color=colour, linestyle=dashes, linewidth=1.6, label=words)
    every = np.concatenate([arms, *waves.values()])
    top = float(np.nanmax(every))
    ax.set(xlim=(0, angles[-1]), ylim=(min(0.0, float(np.nanmin(every))) - 0.03 * top, 1.08 * top))
    ax.set_xlabel("heel angle φ [deg]")
    ax.set_ylabel("righting arm GZ [m]")
    ax.set_title("Righting arm in calm water and on the wave")
    ax.legend(frameon=True, framealpha=0.9, edgecolor="none", loc="best")

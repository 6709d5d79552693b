"""The body plan: sections of the fore body on the right, of the aft body on the left."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.contour import along, contour_curve
from quartering.hull.ship import Ship
from quartering.view.plots import style

MOST_SECTIONS = 26
"""More sections than this are thinned out."""


def draw_body_plan(ax: Axes, ship: Ship) -> None:
    """Draw the sections of a ship, its waterline, and the points G and M.

    ax: one with room for the beam and the depth
    """
    hull = ship.hull
    step = -(-len(hull.x) // MOST_SECTIONS)
    middle = int(np.argmin(np.abs(hull.x)))
    for i in range(len(hull.x)):
        if (i - middle) % step:
            continue
        curve = contour_curve(*hull.contours[i], hull.outline)
        y, height, *_ = along(curve, np.linspace(curve.chord[0], curve.chord[-1], 120))
        bold = {"color": style.INK, "linewidth": 1.6} if i == middle else {}
        for side in (1, -1) if i == middle else (1 if hull.x[i] > 0 else -1,):
            look = {"color": style.CONTRAST[0] if side > 0 else style.CONTRAST[1], "linewidth": 1.0} | bold
            ax.plot(side * y, height, **look)
    floating = hydrostatics(ship)
    ax.axhline(hull.draught, color=style.QUIET, linewidth=0.9, linestyle="--")
    words, at_right = f"T = {hull.draught:.3g} m", ax.get_yaxis_transform()
    ax.text(1.0, hull.draught, words, fontsize=8, color=style.QUIET, ha="right", va="bottom", transform=at_right)
    ax.axvline(0.0, color=style.QUIET, linewidth=0.6)
    for name, level in (("G", floating.kg), ("M", floating.km)):
        ax.plot(0.0, level, marker="o", markersize=4, color=style.INK)
        ax.text(-0.02 * hull.beam, level, name, fontsize=9, ha="right", va="center", fontweight="bold")
    widest = max(float(y.max()) for y, _ in hull.contours)
    ax.set_xlim(-1.4 * widest, 1.4 * widest)
    ax.set_aspect("equal")
    ax.set_xlabel("aft body  ←  half breadth [m]  →  fore body")
    ax.set_ylabel("height above the baseline [m]")
    ax.set_title("Body plan")

"""Fig. 1 of the paper: body axes, positive motions, and the heading to the waves."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc

from quartering.hull.lines.immersed import strips
from quartering.hull.ship import Ship
from quartering.loads.waves import heading_components
from quartering.view.plots import style

_ARROW = {"arrowstyle": "-|>", "color": style.INK, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0}
_WAVE = _ARROW | {"color": style.CONTRAST[0], "linewidth": 2.2}


def axes_picture(ship: Ship, heading: float, title: str) -> Figure:
    """Plan and section of a ship with its axes, and a wave train that meets it.

    heading: mu, 0 following, 180 head [deg]
    """
    made = style.figure(11.0, 6.2)
    plan, section = made.subplots(1, 2, width_ratios=(1.25, 1.0))
    _plan(plan, ship, heading)
    _section(section, ship)
    for ax in (plan, section):
        ax.set_aspect("equal")
        ax.axis("off")
    style.title(made, title)
    words = (
        f"Waterline and midship section of {ship.name}, the breadth of the plan enlarged twice. Body axes: x to the bow, y to "
        "starboard, z down, origin at G. The heading μ is the angle from the bow to the way the wave runs, clockwise seen from "
        "above: 0 following, 90 beam (from port), 180 head; the paper's δ = 180° − μ is the angle from its axis x̄, "
        "against which the wave runs, to the bow. Frequency of encounter ω = σ + k U cos δ = σ − k U cos μ."
    )
    style.footnote(made, words)
    return made


def wave_direction(heading: float) -> tuple[float, float]:
    """Unit vector along which the wave runs on the page of the plan: (to the right = starboard, up = to the bow)."""
    along, across = (float(part) for part in heading_components(heading))
    return across, -along


def _plan(ax: Axes, ship: Ship, heading: float) -> None:
    hull = strips(ship.hull)
    length = ship.hull.length
    x, half = hull.x / length, 2.0 * hull.half_breadth / length
    ax.fill(np.concatenate([half, -half[::-1]]), np.concatenate([x, x[::-1]]), color="#ececec", zorder=1)
    ax.plot(
        np.concatenate([half, -half[::-1], half[:1]]), np.concatenate([x, x[::-1], x[:1]]), color=style.INK, zorder=2
    )
    right, up = wave_direction(heading)
    for crest in (0.30, 0.45, 0.60):
        centre = -crest * np.array([right, up])
        ends = np.outer((-0.33, 0.33), (up, -right)) + centre
        ax.plot(*ends.T, color=style.CONTRAST[0], linewidth=1.2, linestyle="--", zorder=0)
    start, end = -0.85 * np.array([right, up]), -0.32 * np.array([right, up])
    ax.annotate("", end, start, arrowprops=_WAVE)
    ax.text(start[0] - 0.03, start[1], "wave", color=style.CONTRAST[0], ha="right", va="center")
    for vector, words, place in (
        ((0.0, 0.78), "x (bow), U", (0.02, 0.78)),
        ((0.42, 0.0), "y (starboard)", (0.24, -0.07)),
    ):
        ax.annotate("", vector, (0.0, 0.0), arrowprops=_ARROW, zorder=3)
        ax.text(*place, words, va="bottom")
    ax.plot([0.0, 0.46 * right], [0.0, 0.46 * up], color=style.CONTRAST[0], linewidth=0.9, linestyle=":")
    ax.plot([0.0, -0.3 * right], [0.0, -0.3 * up], color=style.CONTRAST[0], linewidth=0.9, linestyle=":")
    ax.text(-0.22 * right + 0.02, -0.22 * up, "x̄", va="top", color=style.CONTRAST[0])
    ax.add_patch(Arc((0.0, 0.0), 0.9, 0.9, theta1=90.0 - heading, theta2=90.0, color=style.CONTRAST[1], linewidth=1.6))
    middle = np.radians(90.0 - heading / 2)
    ax.text(
        0.5 * np.cos(middle),
        0.49 * np.sin(middle),
        f"μ = {heading:g}°",
        ha="center",
        va="bottom",
        color=style.CONTRAST[1],
    )
    ax.add_patch(Arc((0.0, 0.0), 0.5, 0.5, theta1=90.0, theta2=270.0 - heading, color=style.CONTRAST[2], linewidth=1.6))
    middle = np.radians(180.0 - heading / 2)
    ax.text(0.28 * np.cos(middle), 0.28 * np.sin(middle), "δ = 180° − μ", color=style.CONTRAST[2], ha="right")
    ax.annotate("", (0.10, 0.66), (-0.10, 0.66), arrowprops=_ARROW | {"connectionstyle": "arc3,rad=-0.5"})
    ax.text(-0.12, 0.66, "yaw ψ, r", ha="right", va="center")
    ax.plot(0.0, 0.0, marker="o", color=style.INK, markersize=4)
    ax.text(-0.02, 0.02, "G", ha="right", va="bottom")
    ax.set_title("seen from above")
    ax.set_xlim(-0.75, 0.75)
    ax.set_ylim(-0.9, 0.9)


def _section(ax: Axes, ship: Ship) -> None:
    hull, beam = strips(ship.hull, 240), ship.hull.beam
    middle = int(np.argmin(np.abs(hull.x)))
    centre = ship.loading.kg - ship.hull.draught
    y = np.concatenate([[0.0], hull.y[middle], [hull.half_breadth[middle]]]) / beam
    z = np.concatenate([[hull.draught[middle]], hull.z[middle], [0.0]]) / beam
    ax.fill(np.concatenate([y, -y[::-1]]), -np.concatenate([z, z[::-1]]), color="#ececec")
    ax.plot(np.concatenate([y, -y[::-1]]), -np.concatenate([z, z[::-1]]), color=style.INK)
    ax.axhline(0.0, color=style.CONTRAST[0], linewidth=1.0, linestyle="--")
    ax.text(-0.8, 0.02, "calm water", color=style.CONTRAST[0], va="bottom")
    g = centre / beam
    for vector, words, place in (
        ((0.62, g), "y (starboard)", (0.52, g - 0.07)),
        ((0.0, g - 0.55), "z (down)", (0.03, g - 0.55)),
    ):
        ax.annotate("", vector, (0.0, g), arrowprops=_ARROW)
        ax.text(*place, words)
    ax.plot(0.0, g, marker="o", color=style.INK, markersize=4)
    ax.text(-0.03, g - 0.02, "G", ha="right", va="top")
    ax.annotate("", (0.26, g - 0.2), (0.2, g + 0.22), arrowprops=_ARROW | {"connectionstyle": "arc3,rad=-0.4"})
    ax.text(0.3, g + 0.16, "roll φ, p")
    ax.set_title("seen from aft")
    ax.set_xlim(-0.85, 0.85)
    ax.set_ylim(-0.7, 0.5)

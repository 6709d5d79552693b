"""Polar diagrams for the bridge: radius is speed, angle is heading, one diagram for each wave."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.projections.polar import PolarAxes
from numpy.typing import NDArray

from quartering.units import quantity
from quartering.view.plots import style
from quartering.view.plots.polar_map import (
    COURSE_INK,
    GREY,
    HATCHES,
    OUTLINE_OF_MARK,
    RING,
    also_label,
    draw_cells,
    edges,
)

Floats = NDArray[np.float64]
CROSS: Final = "#d4004b"
"""Colour of a cell with a failure event, beside its cross."""


class Diagram(NamedTuple):
    """What one diagram shows.

    Parameters
    ----------
    title : str
    speed : (u,) float          [m/s]
    heading : (h,) float        [deg]
    roll : (u, h) float         largest roll angle, NaN where there is no answer [deg]
    verdict : (u, h) int        `Kind` values
    failure : (u, h) bool       a failure event
    other : (u, h) float        largest roll of another stable motion in the same wave, NaN for none [deg]
    """

    title: str
    speed: Floats
    heading: Floats
    roll: Floats
    verdict: NDArray[np.int8]
    failure: NDArray[np.bool_]
    other: Floats


def guidance_picture(diagrams: list[Diagram], limit: float) -> Figure:
    """Draw some polar diagrams beside each other.

    diagrams: up to six
    limit: largest roll angle allowed: the end of the colours [deg]
    Returns bow up; waves come from the side of the cell
    """
    columns = min(len(diagrams), 3)
    rows = -(-len(diagrams) // columns)
    made = style.figure((style.PAGE - 1.0) / 3 * columns + 1.0, 3.1 * rows + 0.55)
    style.foot(made, 0.45)
    panels = made.subplots(rows, columns, subplot_kw={"projection": "polar"}, squeeze=False).ravel()
    colours = Normalize(0.0, limit)
    for panel in panels[len(diagrams) :]:
        panel.set_visible(False)
    for panel, diagram in zip(panels, diagrams, strict=False):
        mesh = _panel(panel, diagram, colours)
    scale = made.colorbar(mesh, ax=list(panels[: len(diagrams)]), shrink=0.6, pad=0.04, aspect=30)
    scale.set_label(f"largest roll angle over a cycle [deg],\nup to the limit of {limit:.3g} deg")
    made.legend(
        handles=_legend(diagrams),
        loc="lower left",
        bbox_to_anchor=(0.01, 0.005),
        ncols=4 if columns > 1 else 2,
        frameon=False,
    )
    return made


def _panel(ax: PolarAxes, d: Diagram, colours: Normalize) -> object:
    theta = np.radians(np.clip(edges(d.heading, 5.0), 0.0, 180.0))
    r = np.maximum(edges(d.speed, 1.0), 0.0)
    ax.set_theta_zero_location("S")
    ax.set_theta_direction(-1)
    centre, ring = np.meshgrid(np.radians(d.heading), d.speed, indexing="ij")
    failed = d.failure.T
    for side in (1.0, -1.0):
        mesh = draw_cells(ax, side * theta, r, d.roll.T, d.verdict.T, colours)
        also = np.isfinite(d.other.T)
        ax.plot(side * centre[also], ring[also], path_effects=OUTLINE_OF_MARK, zorder=5, **RING)
        ax.plot(side * centre[failed], ring[failed], "x", color=CROSS, markersize=3.2, markeredgewidth=1.0, zorder=5)
    ax.set_rlim(0.0, r[-1])
    knots = quantity("1 kn", "speed")
    rings = round_knots(r[-1] / knots)
    ax.set_rgrids(
        [ring * knots for ring in rings], [f"{ring:g} kn" for ring in rings], angle=157.5, fontsize=7.5, color=style.INK
    )
    for label in ax.get_yticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.8})
    words = {0: "0° following", 90: "90°", 180: "180° head", 270: "90°"}
    angles = range(0, 360, 30)
    ax.set_thetagrids(angles, [words.get(a, f"{a if a <= 180 else 360 - a}°") for a in angles], fontsize=7.5)
    ax.grid(visible=True, color="white", alpha=0.3, linewidth=0.5)
    ax.set_title(d.title, fontsize=9, pad=8)
    return mesh


def round_knots(largest: float) -> list[float]:
    """Rings in knots.

    >>> round_knots(17.0), round_knots(33.0)
    ([5.0, 10.0, 15.0], [10.0, 20.0, 30.0])
    """
    step = next((s for s in (1.0, 2.0, 5.0, 10.0) if largest / s < 5), 20.0)
    return [float(ring) for ring in np.arange(step, largest, step)]


def _legend(diagrams: list[Diagram]) -> list[Line2D | Patch]:
    others = np.concatenate([d.other.ravel() for d in diagrams])
    made: list[Line2D | Patch] = [
        Line2D([], [], color=CROSS, marker="x", linestyle="none", label="failure event"),
        Patch(facecolor="#31688e", edgecolor="white", hatch=HATCHES["unstable"], label="unstable motion"),
        Patch(
            facecolor="#31688e",
            edgecolor=COURSE_INK,
            hatch=HATCHES["course"],
            label="course-unstable in calm water too",
        ),
        Patch(facecolor=GREY, label="no answer"),
    ]
    if np.isfinite(others).any():
        made.append(Line2D([], [], label=also_label(others), path_effects=OUTLINE_OF_MARK, **RING))
    return made

"""Points of the printed figures over the recomputed curves."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from quartering.conventions import InputError
from quartering.study.paper.points import Point
from quartering.view.plots import style


def panels(made: Figure) -> list[str]:
    """Names of the panels of a figure that points can be drawn in."""
    return list(dict.fromkeys(str(ax.get_gid()) for ax in made.axes if ax.get_gid()))


def draw_points(made: Figure, points: Sequence[Point], number: int) -> None:
    """Draw points into the panels they belong to.

    number: of the figure, for messages
    """
    for quantity, series in dict.fromkeys((p.quantity, p.series) for p in points):
        axes = [ax for ax in made.axes if ax.get_gid() == quantity]
        if not axes:
            raise InputError(
                f'points of figure {number}: it has no panel "{quantity}"; it has {", ".join(panels(made))}'
            )
        own = [p for p in points if (p.quantity, p.series) == (quantity, series)]
        for ax in axes:
            mark = style.MARKERS[len(ax.containers) % len(style.MARKERS)]
            ax.errorbar(
                [p.x for p in own], [p.y for p in own], [p.y_error for p in own], [p.x_error for p in own],
                linestyle="none", marker=mark, color=style.INK, markerfacecolor="white", capsize=2, zorder=5,
                label=f"paper: {series}",
            )  # fmt: skip
            ax.legend(loc="best", frameon=False)

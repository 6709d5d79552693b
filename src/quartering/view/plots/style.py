"""How pictures look: sizes, colours that colour-blind people tell apart, footnotes."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

RESOLUTION: Final = 130
"""Dots per inch of a PNG."""

PAGE: Final = 8.8
"""Width of a figure for a page of A4 [inches]: over its 180 mm of text 7.5 pt become 6."""

SEQUENTIAL: Final = "viridis"
CONTRAST: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
"""Colours for things that are not in an order (Okabe and Ito)."""

INK, QUIET, WARNING_INK = "#1a1a1a", "#6b6b6b", "#c2185b"
DASHES: Final = ("-", "--", ":", "-.")

_RULES: Final = {
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.labelsize": 9.0,
    "legend.fontsize": 8.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#d9d9d9",
    "grid.linewidth": 0.6,
    "hatch.linewidth": 0.8,
}


def figure(width: float, height: float) -> Figure:
    """Empty figure in this library's style.

    width, height: [inches]
    """
    mpl.rcParams.update(_RULES)
    made = Figure(figsize=(width, height), layout="constrained")
    made.get_layout_engine().set(w_pad=0.1)  # type: ignore[union-attr, call-arg]  # "head" and the next "following" apart
    return made


def foot(made: Figure, inches: float) -> None:
    """Keep a strip at the foot of a figure free of axes."""
    share = inches / made.get_figheight()
    made.get_layout_engine().set(rect=(0.0, share, 1.0, 1.0 - share))  # type: ignore[union-attr, call-arg]


def sequence(count: int) -> list[tuple[float, ...]]:
    """Colours for ``count`` things in an order, dark to light but never too light for a line."""
    colours: NDArray[np.float64] = mpl.colormaps[SEQUENTIAL](np.linspace(0.0, 0.85, count))
    return [tuple(colour) for colour in colours]


MARKERS: Final = ("o", "s", "^", "D", "v", "P", "X", "<")


def looks(count: int) -> list[dict[str, object]]:
    """Colour, dashes and marker of each of ``count`` lines in an order, told apart in grey too."""
    return [
        {"color": colour, "linestyle": DASHES[i % len(DASHES)], "marker": MARKERS[i % len(MARKERS)]}
        for i, colour in enumerate(sequence(count + 1)[:count])
    ]


def headings(ax: Axes, largest: float = 180.0) -> None:
    """Heading axis of a plot from 0 to at least 180 deg, with the sectors named."""
    names = {0: "0\nfollowing", 90: "90\nbeam", 180: "180\nhead", 270: "270\nbeam", 360: "360\nfollowing"}
    end = 180 if largest <= 180.0 else 360
    ticks = range(0, end + 1, 30 if end == 180 else 90)
    ax.set_xlim(0, end)
    ax.set_xticks(ticks, [names.get(tick, str(tick)) for tick in ticks])
    ax.set_xlabel("heading [deg]")


def title(made: Figure, text: str) -> None:
    """Title of a figure, wrapped to its width."""
    characters = int(12.2 * made.get_figwidth())
    lines = "\n".join(textwrap.fill(line, characters) for line in text.splitlines())
    made.suptitle(lines, x=0.01, ha="left", fontsize=11)


def footnote(made: Figure, text: str, above: float = 0.0) -> float:
    """Small print at the foot of a figure, wrapped to its width; the axes make room for it.

    above: strip kept free above the print, for a legend [inches]
    Returns where the print ends, as a share of the height
    """
    characters = int(17.8 * made.get_figwidth())
    lines = [part for line in text.splitlines() for part in textwrap.wrap(line, characters)]
    top = 0.14 + 0.13 * len(lines)
    made.text(0.01, 0.06 / made.get_figheight(), "\n".join(lines), ha="left", va="bottom", fontsize=7.5, color=QUIET)
    foot(made, top + above)
    return top / made.get_figheight()


def shown(made: Figure) -> None:
    """Hand a figure to pyplot, so that ``plt.show()``, notebooks and galleries find it."""
    from matplotlib import pyplot

    manager = pyplot.figure(figsize=made.get_size_inches()).canvas.manager
    assert manager is not None  # pyplot gives every figure one
    manager.canvas.figure = made
    made.set_canvas(manager.canvas)


def lay_out(made: Figure) -> None:
    """Place the axes of a figure that is then written once.

    A figure that places its own is drawn twice whenever it is written, the first time for the places alone.
    """
    engine = made.get_layout_engine()
    if engine is not None:
        engine.execute(made)
        made.set_layout_engine(None)


def save(made: Figure, path: Path) -> None:
    """Write a figure as the kind of picture its path names."""
    made.set_dpi(RESOLUTION)
    lay_out(made)
    made.savefig(path, dpi=RESOLUTION, format=path.suffix.lstrip(".").lower())

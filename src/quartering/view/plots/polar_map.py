"""The polar map: largest roll over heading and wave length, unstable cells hatched, resonance lines drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib.patheffects as effects
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.path import Path
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from quartering.motion.status import OnTheWay, Status
from quartering.stability.kind import Kind
from quartering.study.condition.resonance import resonance_fields
from quartering.study.maps.query import capsizing, coexisting, other_rolls
from quartering.view.plots import style
from quartering.view.wording import notes, speed_words, wave_words

Floats = NDArray[np.float64]
Mark = tuple[str, NDArray[np.bool_], dict[str, Any]]
FINEST_STEP = 2.5
"""Cells wider than this are drawn in slices, so that their edges are arcs [deg]."""


HOW_TO_READ = "Bow up: waves come from the side of the cell, port on the left; radius is wave length over ship length."
MIRRORED = " The right half mirrors the left."
GREY, PACE_INK = "#b8b8b8", "#ff9d5c"
LOST = "#d98aa4"
"""Colour of unstable cells beyond which no stable roll was found."""
COURSE_INK = "#ffb38a"
HATCHES = {"unstable": "/////", "course": "...", "not recommended": "/////", "undecided": "..."}
"""Hatch of cells unstable because of the wave, of those where the ship is course-unstable without waves, and of advice."""

_OVER_HEAD_SEAS = 27.507
"""From the outermost circle of a panel to its title [points]: the label of head seas, and 10 points over it."""
_NARROW = 4.0
"""Inches of width in which the title of a panel would meet the next one's."""

SCALE = "largest roll over a cycle [deg]"
_DARK: dict[str, Any] = {
    "facecolor": "#4a4063", "edgecolor": "none", "labelcolor": "white", "framealpha": 1.0, "handlelength": 2.8,
}  # fmt: skip
CROSS: dict[str, Any] = {
    "marker": "x", "linestyle": "none", "color": "#ff4f79", "markersize": 4.2, "markeredgewidth": 1.3,
}  # fmt: skip
RING: dict[str, Any] = {
    "marker": "o", "linestyle": "none", "markerfacecolor": "none", "markeredgecolor": "#1a1a1a", "markersize": 5.2,
    "markeredgewidth": 1.2,
}  # fmt: skip
OUTLINE_OF_MARK = [effects.withStroke(linewidth=2.8, foreground="white")]
OUTLINE = [effects.withStroke(linewidth=2.6, foreground=style.INK)]


def polar_map(ds: xr.Dataset, columns: int | None = None, width: float | None = None) -> Figure:
    """Draw the dataset of `quartering.polar`, one panel a speed; the key stands in an empty corner where there is one.

    ds: with dims speed, heading, wave_length
    columns: panels beside each other; by default 3, of four panels 2
    width: of the figure [inches]; by default what the panels want
    Returns head seas on top, waves from port on the left; radius = wave length / ship length; colour = largest roll
        over a cycle
    """
    count = ds.sizes["speed"]
    columns = min(count, columns or (2 if count == 4 else 3))
    rows = -(-count // columns)
    corner = count < rows * columns
    beside, titles = (0.0, 0.0) if corner else (1.2, 0.25)  # inches for the scale at the side, and between the rows
    width = width or max(4.7 * columns + beside, 7.4)
    made = style.figure(width, min((width - beside) / columns + titles, 4.9) * rows + 1.8)
    panels = made.subplots(rows, columns, subplot_kw={"projection": "polar"}, squeeze=False).ravel()
    amplitude = ds["roll_peak"].values
    top = float(np.nanmax(amplitude)) if np.isfinite(amplitude).any() else 0.0
    colours = Normalize(0.0, top if top > 0 else 1.0)
    for panel in panels[count:]:
        panel.set_visible(False)
    for i, panel in enumerate(panels[:count]):
        mesh = _panel(panel, ds.isel(speed=i), colours)
        if width / columns < _NARROW:
            panel.title.set_fontsize(8.0)
    style.title(made, _title(ds))
    words = "\n".join([HOW_TO_READ + (MIRRORED if mirrors(ds) else ""), *notes(ds)])
    if corner:
        style.footnote(made, words)
        _key(panels[-1], ds, mesh)
    else:
        scale = made.colorbar(mesh, ax=list(panels), shrink=0.75, pad=0.03, aspect=28)
        scale.set_label(SCALE)
        made.legend(
            handles=_legend(ds), loc="lower left", bbox_to_anchor=(0.008, style.footnote(made, words, above=0.4)),
            ncols=int(width / 2.6), **_DARK,
        )  # fmt: skip
    return made


def _key(empty: Axes, ds: xr.Dataset, mesh: Any) -> None:
    """Scale of the colours and legend in place of a panel without a speed."""
    made = empty.figure
    box = made.add_subplot(empty.get_subplotspec())
    box.set_axis_off()
    scale = made.colorbar(mesh, cax=box.inset_axes((0.08, 0.8, 0.84, 0.06)), orientation="horizontal")
    scale.set_label(SCALE)
    scale.ax.grid(visible=False)
    box.legend(handles=_legend(ds), loc="upper center", bbox_to_anchor=(0.5, 0.62), **_DARK)


def _panel(ax: PolarAxes, ds: xr.Dataset, colours: Normalize) -> Any:
    """One speed."""
    length = float(ds.attrs["ship_length"])
    mirrored = mirrors(ds)
    theta, r = cell_edges(ds, length)
    roll, kind = np.asarray(ds["roll_peak"]), np.asarray(ds["verdict"])
    for side in (1.0, -1.0) if mirrored else (1.0,):
        mesh = draw_cells(ax, side * theta, r, roll, kind, colours)
        _resonances(ax, ds, side * theta, r)
        _marks(ax, ds, side)
    dress(ax, r, mirrored)
    head(ax, f"{speed_words(float(ds['speed']), length)}\n{_counts(ds)}")
    return mesh


def cell_edges(ds: xr.Dataset, length: float) -> tuple[Floats, Floats]:
    """Edges of the cells of a map: angle [rad], and wave length over that of the ship."""
    radius = np.asarray(ds["wave_length"]) / length
    theta, r = np.radians(edges(np.asarray(ds["heading"]), 5.0)), edges(radius, 0.1 * radius[0])
    r[0] = max(r[0], 0.0)
    return (np.clip(theta, 0.0, np.pi) if mirrors(ds) else theta), r


def mirrors(ds: xr.Dataset) -> bool:
    """Do the headings lie on one side of the ship, so that the other side follows by symmetry?"""
    return bool((ds["heading"] >= 0).all() and (ds["heading"] <= 180).all())


def draw_cells(
    ax: PolarAxes, theta: Floats, r: Floats, roll: Floats, kind: NDArray[np.int8], colours: Normalize
) -> Any:
    """Colour of every cell, grey where there is no answer, hatched where unstable."""
    calm = kind == Kind.COURSE_IN_CALM_WATER
    marks: list[Mark] = [
        ("no answer", kind == Kind.NO_ANSWER, {"facecolor": GREY, "edgecolor": GREY}),
        ("lost", (kind > Kind.STABLE) & np.isnan(roll), {"facecolor": LOST, "edgecolor": LOST}),
        ("unstable", (kind > Kind.STABLE) & ~calm, {"facecolor": "none", "edgecolor": "white"}),
        ("course", calm, {"facecolor": "none", "edgecolor": COURSE_INK}),
    ]
    return paint_cells(ax, theta, r, roll, marks, colours, style.SEQUENTIAL)


def paint_cells(
    ax: PolarAxes, theta: Floats, r: Floats, values: Floats, marks: Sequence[Mark], colours: Normalize, scale: str
) -> Any:
    """Colour of every cell, and marks over some: name, which, how they look.

    All cells of a mark are one path, so that a file holds its hatch once.
    """
    slices = max(1, int(np.ceil(np.degrees(np.abs(np.diff(theta)).max()) / FINEST_STEP - 1e-9)))
    fine = np.interp(np.arange((theta.size - 1) * slices + 1) / slices, np.arange(theta.size), theta)
    wide = np.ma.masked_invalid(np.repeat(values, slices, axis=0).T)
    mesh = ax.pcolormesh(fine, r, wide, cmap=scale, norm=colours, rasterized=True)
    for name, cells, look in marks:
        if cells.any():
            whole = _region(_outlines(fine, r, cells, slices))
            marked = PathCollection([whole], linewidth=0.0, hatch=HATCHES.get(name), **look)
            marked.set_gid(name)
            ax.add_collection(marked, autolim=False)
    return mesh


def _region(outlines: Sequence[Floats]) -> Path:
    """One path of many closed outlines."""
    points = [np.concatenate([outline, outline[:1]]) for outline in outlines]
    codes = [np.array([Path.MOVETO, *[Path.LINETO] * (len(one) - 2), Path.CLOSEPOLY], Path.code_type) for one in points]
    return Path(np.concatenate(points), np.concatenate(codes))


def _outlines(fine: Floats, r: Floats, cells: NDArray[np.bool_], slices: int) -> list[Floats]:
    """Outlines (theta, r) of the marked cells (h, w), those that follow one another on a heading in one."""
    made = []
    for i, row in enumerate(cells):
        arc = fine[i * slices : (i + 1) * slices + 1]
        edges_of_runs = np.flatnonzero(np.diff(np.concatenate([[0], row.astype(np.int8), [0]])))
        for first, last in edges_of_runs.reshape(-1, 2):
            inner, outer = (np.stack([arc, np.full_like(arc, r[j])], 1) for j in (first, last))
            made.append(np.concatenate([inner, outer[::-1]]))
    return made


def _resonances(ax: PolarAxes, ds: xr.Dataset, theta: Floats, r: Floats) -> None:
    """Lines where the encounter frequency equals n2, 2 n2 and zero."""
    theta, lengths = np.linspace(theta[0], theta[-1], 181), np.linspace(r[0] or r[1] / 10, r[-1], 120)
    n2, wave_length = float(ds.attrs["natural_roll_frequency"]), lengths[:, None] * float(ds.attrs["ship_length"])
    fields = resonance_fields(wave_length, float(ds["speed"]), np.degrees(theta), n2)
    for name, dash, colour in (("resonance", "-", "white"), ("twice", "--", "white"), ("pace", ":", PACE_INK)):
        field, level = fields[name]
        if field.min() < level < field.max() and (name != "pace" or _overtakes(ds)):
            drawn = ax.contour(theta, lengths, field, levels=[level], colors=colour, linestyles=dash, linewidths=1.5)
            drawn.set(path_effects=OUTLINE)


def _marks(ax: PolarAxes, ds: xr.Dataset, side: float) -> None:
    """A ring on each cell with another stable motion, a cross where the ship capsizes before it comes to its own."""
    for name, cells, look in (
        ("another stable motion", coexisting(ds), RING),
        ("capsizes on the way", capsizing(ds), CROSS),
    ):
        mark_cells(ax, cells, float(ds.attrs["ship_length"]), side, name, look)


def mark_cells(ax: PolarAxes, cells: xr.DataArray, length: float, side: float, name: str, look: dict[str, Any]) -> None:
    """A sign in the middle of each of some cells; length: of the ship [m]."""
    i, j = np.nonzero(cells.transpose("heading", "wave_length").values)
    if i.size:
        theta, r = np.radians(cells["heading"].values[i]), cells["wave_length"].values[j] / length
        ax.plot(side * theta, r, gid=name, path_effects=OUTLINE_OF_MARK, zorder=3, **look)


def also_label(rolls: Floats) -> str:
    """Legend of the rings: how far the other motions of a picture roll [deg].

    >>> also_label(np.array([27.71, np.nan, 41.0])), also_label(np.array([27.71]))
    ('another stable motion too, of 27.7 to 41 deg', 'another stable motion too, of 27.7 deg')
    """
    known = np.sort(rolls[np.isfinite(rolls)])
    ends = dict.fromkeys(f"{roll:.3g}" for roll in known[[0, -1]])
    return f"another stable motion too, of {' to '.join(ends)} deg"


def _overtakes(ds: xr.Dataset) -> bool:
    """Does the ship overtake the wave in some cell?"""
    return bool(ds["encounter_frequency"].min() < 0)


def dress(ax: PolarAxes, r: Floats, mirrored: bool) -> None:
    """Axes and labels of a panel: head seas on top."""
    ax.set_theta_zero_location("S")
    ax.set_theta_direction(-1)
    ax.set_facecolor("white")
    ax.set_rlim(0.0, r[-1])
    ticks = [tick for tick in MaxNLocator(5, steps=[1, 2, 5, 10]).tick_values(0.0, r[-1]) if r[0] < tick < 0.97 * r[-1]]
    words = [f"{tick:g}" for tick in ticks[:-1]] + [f"λ/L = {tick:g}" for tick in ticks[-1:]]
    ax.set_rgrids(ticks, words, angle=202.5, color="white", fontsize=8)
    ax.grid(visible=True, color="white", alpha=0.25, linewidth=0.5)
    for label in ax.get_yticklabels():
        label.set(path_effects=OUTLINE, ha="center", va="center")
    names = {0: "0° following", 90: "90°\nbeam", 180: "180° head"}
    if mirrored:
        names[270] = "90°\nbeam"
    angles = range(0, 360, 30)
    labels = [names.get(angle, f"{angle if angle <= 180 or not mirrored else 360 - angle}°") for angle in angles]
    ax.set_thetagrids(angles, labels, fontsize=8)
    ax.tick_params(axis="x", pad=3)
    if r[0] > 0.1 * r[-1]:
        _ship(ax, min(0.8 * r[0], 0.22 * r[-1]))


def head(ax: PolarAxes, words: str) -> None:
    """Title of a panel that is dressed; told its place, since to find it takes a tenth of the time of a drawing."""
    ax.set_title(words, y=1.0, pad=_OVER_HEAD_SEAS)


def _counts(ds: xr.Dataset) -> str:
    """How many cells of a panel are stable, unstable, ..."""
    stable = int((ds["verdict"] == Kind.STABLE).sum())
    unanswered = int((ds["verdict"] == Kind.NO_ANSWER).sum())
    unstable = ds["verdict"].size - stable - unanswered
    lost = int(capsizing(ds).sum())
    calm = int((ds["verdict"] == Kind.COURSE_IN_CALM_WATER).sum())
    stable_words = f"{stable} cells stable" + (f" ({lost} capsize on the way)" if lost else "")
    counts = f"{stable_words}, {unstable - calm} unstable" + (f", {calm} course-unstable" if calm else "")
    return counts + (f", {unanswered} no answer" if unanswered else "")


def _ship(ax: PolarAxes, half: float) -> None:
    """Outline of a ship in the middle, bow up."""
    x = half * np.array([0.0, 0.16, 0.2, 0.2, 0.14, -0.14, -0.2, -0.2, -0.16, 0.0])
    y = half * np.array([1.0, 0.6, 0.3, -0.75, -0.95, -0.95, -0.75, 0.3, 0.6, 1.0])
    ax.fill(np.arctan2(-x, -y), np.hypot(x, y), facecolor=style.QUIET, edgecolor=style.INK, linewidth=0.6, zorder=4)


def _title(ds: xr.Dataset) -> str:
    return f"{ds.attrs['ship']}: roll in regular waves, {wave_words(ds)}\n{ds.attrs['loading']}"


def _legend(ds: xr.Dataset) -> Sequence[Any]:
    """What lines and hatches mean, those that occur."""
    dark = {"path_effects": OUTLINE, "linewidth": 1.5}
    n2 = float(ds.attrs["natural_roll_frequency"])
    verdict = np.asarray(ds["verdict"])
    calm = verdict == Kind.COURSE_IN_CALM_WATER
    unstable = (verdict > Kind.STABLE) & ~calm
    kinds = ", ".join(Kind(k).label for k in np.unique(verdict[unstable]))
    made: list[Any] = [
        Line2D([], [], color="white", linestyle="-", label=f"ω = n₂ = {n2:.3f} rad/s (roll resonance)", **dark),
        Line2D([], [], color="white", linestyle="--", label="ω = 2 n₂", **dark),
    ]
    if _overtakes(ds):
        made.append(
            Line2D([], [], color=PACE_INK, linestyle=":", label="ω = 0 (ship keeps pace with the wave)", **dark)
        )
    if unstable.any():
        made.append(
            Patch(facecolor="#31688e", edgecolor="white", hatch=HATCHES["unstable"], label=f"unstable: {kinds}")
        )
    if (unstable & np.isnan(np.asarray(ds["roll_peak"]))).any():
        made.append(
            Patch(facecolor=LOST, edgecolor="white", hatch=HATCHES["unstable"], label="and no stable roll found")
        )
    if calm.any():
        label = "course-unstable even in calm water: not the waves' doing"
        made.append(Patch(facecolor="#31688e", edgecolor=COURSE_INK, hatch=HATCHES["course"], label=label))
    if capsizing(ds).any():
        made.append(Line2D([], [], label=OnTheWay.BOTH.label, path_effects=OUTLINE_OF_MARK, **CROSS))
    if coexisting(ds).any():
        made.append(Line2D([], [], label=also_label(other_rolls(ds).values), path_effects=OUTLINE_OF_MARK, **RING))
    if (verdict == Kind.NO_ANSWER).any():
        why = [Status(s).name.lower().replace("_", " ") for s in np.unique(ds["status"]) if not Status(s).ok]
        made.append(Patch(facecolor=GREY, label=f"no answer: {', '.join(why)}" if why else "no answer"))
    return made


def edges(centres: Floats, width: float) -> Floats:
    """Edges of cells round their centres; one cell alone gets a width."""
    if centres.size == 1:
        return np.array([centres[0] - width / 2, centres[0] + width / 2])
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])

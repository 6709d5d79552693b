"""Wave forces over heading: the forms side by side, a row a wave length, a column a mode."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from quartering.view.plots import style
from quartering.view.wording import metric_prefix

WORDS: Final = {
    "sway": ("sway_force", "sway force |Y| / A", "N/m"),
    "roll": ("roll_moment", "roll moment |K| / A", "N m/m"),
    "yaw": ("yaw_moment", "yaw moment |N| / A", "N m/m"),
}
"""Mode -> name of its panels, what is drawn, and its unit."""
_SKY = "#56B4E9"
LOOKS: Final[dict[str, dict[str, Any]]] = {
    "froude-krylov": {"color": style.QUIET, "linestyle": ":", "linewidth": 2.0},
    "paper": {"color": style.CONTRAST[1], "linestyle": "-.", "linewidth": 1.4},
    "paper-corrected": {"color": style.CONTRAST[3], "linestyle": (0, (6, 2)), "linewidth": 1.4},
    "relative-motion": {"color": _SKY, "linestyle": (0, (4, 1, 1, 1, 1, 1)), "linewidth": 1.4},
    "stf": {"color": style.CONTRAST[0], "linestyle": "-", "linewidth": 1.8},
    "bem": {"color": style.INK, "linestyle": "none", "marker": "o", "markersize": 3.5, "markerfacecolor": "none"},
    "database": {
        "color": style.INK, "linestyle": "none", "marker": "s", "markersize": 3.5, "markerfacecolor": "none",
    },
}  # fmt: skip
"""Form -> how it is drawn: told apart by dash and mark alone."""


def forces_picture(
    compared: xr.Dataset, title: str, note: str, modes: Sequence[str] = ("sway", "roll", "yaw")
) -> Figure:
    """Amplitude of the wave forces per metre of wave amplitude, over heading.

    compared: of `compare_forces`; choose forms by ``compared.sel(form=[..])``
    modes: one column each; a single mode has its wave lengths side by side
    Returns one axes for each wave length and mode, lines are the forms; all wave lengths of a mode on one scale
    """
    count = compared.sizes["wave_length"]
    rows, columns = (1, count) if len(modes) == 1 else (count, len(modes))
    made = style.figure(max(4.2 * columns, 8.5), 2.3 * rows + 1.9)
    cells = np.asarray(made.subplots(rows, columns, squeeze=False, sharex=True))
    cells = cells.T if len(modes) == 1 else cells
    for mode, column in zip(modes, cells.T, strict=True):
        name, words, unit = WORDS[mode]
        values = compared["amplitude"].sel(mode=mode)
        scale, prefix = metric_prefix(float(values.max()))
        top = 1.06 * float(values.max()) / scale
        for i, ax in enumerate(column):
            _draw(ax, values.isel(wave_length=i) / scale)
            ax.set_ylim(0.0, top or 1.0)
            ax.set_title(f"{mode}, λ/L = {float(compared['ratio'][i]):.3g}")
            ax.set_ylabel(f"{words} [{prefix}{unit}]")
            ax.set_gid(name)
    for ax in cells[-1] if len(modes) > 1 else cells[:, 0]:
        style.headings(ax)
    made.legend(*cells[0, 0].get_legend_handles_labels(), loc="outside right center", frameon=False)
    style.title(made, title)
    style.footnote(made, note)
    return made


def _draw(ax: Axes, values: xr.DataArray) -> None:
    """The forms of one mode in one wave."""
    heading = np.asarray(values["heading"])
    for form in values["form"].to_numpy():
        ax.plot(heading, values.sel(form=form), label=str(form), **LOOKS[str(form)])

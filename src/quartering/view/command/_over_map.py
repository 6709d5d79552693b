"""`quartering vary --over-map`: what one or two values do to a whole map."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from quartering.conventions import InputError, headed
from quartering.options import OPTIONS
from quartering.view.command._varied import is_range, option
from quartering.view.console.answer import Answer
from quartering.view.console.files import dataset_or_picture
from quartering.view.console.printed import Table, table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_values import value, values

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.view.console.typed_ship import Typed

MAP_AXES = {"heading": ("0:180", 19), "wave_length": ("0.4L:2.3L", 20)}
"""What the map is over where no range is typed, and how many values a range that does not say has."""
_MOST_ROWS = 50
_SHARES = {
    "unstable": "unstable [%]", "capsizing": "capsizes on the way [%]", "without_answer": "no answer [%]",
    "course_unstable": "course-unstable [%]",
}  # fmt: skip


def map_conditions(one: Ship, typed: Mapping[str, str]) -> dict[str, list[float]]:
    """The map: headings, wave lengths, and waves as steep as the one typed."""
    if is_range(typed["wave_height"]):
        raise InputError(
            "--over-map takes one --wave-height: all waves are as steep as that of --wave-length; give one"
        )
    axes = {}
    for key, (usual, count) in MAP_AXES.items():
        text = typed[key] if is_range(typed[key]) else usual
        axes[key] = values([text], OPTIONS[key], one.sizes, option(key), count)
    length = typed["wave_length"] if not is_range(typed["wave_length"]) else "1L"
    high, long = (
        value(text, OPTIONS[key], one.sizes, option(key))
        for key, text in (("wave_height", typed["wave_height"]), ("wave_length", length))
    )
    speed = values([typed["speed"]], OPTIONS["speed"], one.sizes, option("speed"), 2)
    return {"speed": speed, **axes, "steepness": [high / long]}


def whole_map_varied(
    typed: Typed,
    one: Ship,
    told: Mapping[str, str],
    parameters: Mapping[str, list[float]],
    unfitted: Sequence[str],
    harmonics: int,
    form: Form,
    path: Path | None,
) -> Answer:
    """Answer of `quartering vary --over-map`.

    told: options of the ship that are not varied
    parameters: values of what is varied
    unfitted: those of them that have no present value
    """
    import numpy as np

    from quartering.stability.precompile import announce_compilation
    from quartering.study.effects.over_map import over_map
    from quartering.view.wording import notes

    map_of = {key: np.array(axis) for key, axis in map_conditions(one, typed.condition).items()}
    if "speed" in parameters:
        map_of["speed"] = map_of["speed"][:1]
    announce_compilation()
    count = int(np.prod([len(v) for v in parameters.values()]) * np.prod([axis.size for axis in map_of.values()]))
    with bar("conditions", count) as progress:
        ds = over_map(one, map_of, parameters, harmonics=harmonics, form=form, progress=progress)
    for key in unfitted:
        ds[key].attrs.pop("user_value", None)
    said = _map_words(one, map_of, "speed" in parameters)

    def draw() -> Figure:
        from quartering.view.plots.over_map import over_map_picture

        return over_map_picture(ds, said)

    def lines() -> Iterator[Table | str]:
        yield f"{said}."
        yield _table(ds)
        yield from notes(ds)

    return Answer(
        lines(),
        lambda: _facts(ds) | {"written": None if path is None else str(path)},
        dataset_or_picture(path, ds, draw),
        output=path,
        data=lambda: [data_table(ds, str(ds.attrs["title"]))],
        next_steps=[f"quartering polar {typed.ship}{option_words(told)}"],
    )


def _map_words(one: Ship, axes: Mapping[str, np.ndarray], speed_varied: bool) -> str:
    """What the map is over, in words."""
    from quartering.view.wording import speed_words

    heading, ratio = axes["heading"], axes["wave_length"] / one.hull.length
    speeds = "" if speed_varied else ", " + "; ".join(speed_words(float(u), one.hull.length) for u in axes["speed"])
    return (
        f"The map of {heading.size} headings from {heading.min():g} to {heading.max():g} deg and {ratio.size} wave lengths "
        f"from {ratio.min():.3g} to {ratio.max():.3g} L, H/λ = {float(axes['steepness'][0]):.3g}{speeds}"
    )


def _table(ds: xr.Dataset) -> Table:
    """A line for each value: shares, largest roll and where."""
    import numpy as np

    names = [str(name) for name in ds["roll_peak"].dims]
    stacked = ds.stack(line=names)
    shown = np.unique(np.linspace(0, stacked.sizes["line"] - 1, _MOST_ROWS).round().astype(int))
    length = float(ds.attrs["ship_length"])
    told = [key for key in _SHARES if key == "unstable" or float(ds[key].max()) > 0]
    rows = []
    for i in shown:
        line = stacked.isel(line=int(i))
        place = ("no answer", "")
        if np.isfinite(float(line["roll_peak"])):
            at = f"{float(line['worst_heading']):g} deg, λ/L {float(line['worst_wave_length']) / length:.3g}"
            place = (f"{float(line['roll_peak']):.3g}", at)
        shares = [f"{100 * float(line[key]):.3g}" for key in told]
        rows.append((*(f"{float(line[name]):.4g}" for name in names), *shares, *place))
    columns = (
        *(headed(name, str(ds[name].attrs["units"])) for name in names),
        *(_SHARES[key] for key in told), "largest roll [deg]", "where",
    )  # fmt: skip
    return table(str(ds.attrs["title"]), columns, rows, right=range(len(columns) - 1))


def _facts(ds: xr.Dataset) -> dict[str, object]:
    """Everything, for programs."""
    names = [str(name) for name in ds["roll_peak"].dims]
    facts: dict[str, object] = {key: ds.attrs[key] for key in ("ship", "loading", "conditions_of_a_map")}
    facts["parameters"] = {
        name: {"now": ds[name].attrs.get("user_value"), "unit": ds[name].attrs["units"], "values": ds[name].values}
        for name in names
    }
    return facts | {str(key): ds[key].values for key in ds.data_vars}

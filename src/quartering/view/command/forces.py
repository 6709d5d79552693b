"""`quartering forces`: the forms of the wave force side by side, over heading."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Picture, ShipName, Speed
from quartering.view.console.files import PICTURES, TABLES, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import typed_ship, typed_value
from quartering.view.console.typed_values import values

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.view.console.printed import Table

_HEADING_STEP = 5.0
_UNITS = {"sway": "N/m", "roll": "N m/m", "yaw": "N m/m"}


def forces(
    ship: ShipName,
    changes: Changes,
    speed: Speed = "0.2Fn",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: 0.5L,1L,2L or from:to:count.")] = "0.5L,1L,1.5L,2L",
    form: Annotated[
        list[str] | None,
        typer.Option(help="Form to show beside stf, repeatable; by default all but bem (Capytaine, at --speed 0)."),
    ] = None,
    output: Picture = None,
) -> Answer:
    """Wave force and moments over heading, for several wave lengths, the forms side by side."""
    import numpy as np

    from quartering.loads.comparison import PANELS, compare_forces
    from quartering.view.wording import forces_note, speed_words

    one = typed_ship(ship, changes)
    chosen = _chosen(form or [], one)
    path = reserve_path(output, (*PICTURES, *TABLES))
    u = typed_value("speed", speed, one.sizes)
    lengths = values([wave_lengths], OPTIONS["wave_length"], one.sizes, "--wave-lengths", 5)
    if PANELS in chosen and u != 0:
        raise InputError(f"--form {PANELS} with --speed {speed}: the panels are at zero speed; give --speed 0")
    headings = np.arange(0.0, 180.0 + _HEADING_STEP, _HEADING_STEP)
    panels = _panels(one, lengths, headings) if PANELS in chosen else None
    compared = compare_forces(one, lengths, headings, u, bem=panels).sel(form=chosen)
    title = f"{one.name}: wave forces per metre of wave amplitude, {speed_words(u, one.hull.length)}"

    def draw() -> Figure:
        from quartering.view.plots.forces import forces_picture

        return forces_picture(compared, title, forces_note(compared))

    def lines() -> Iterator[Table | str]:
        yield _by_wave(compared, title)
        yield forces_note(compared)

    step = f"quartering verdict {ship} --heading 60 --speed {speed} --wave-length 1L --wave-height 2"
    return Answer(
        lines(),
        lambda: _facts(compared) | {"picture": str(path) if path else None},
        picture_files(path, draw),
        output=path,
        data=lambda: [data_table(compared, title, ["amplitude"])],
        next_steps=[f"{step}{option_words(changes)}"],
    )


def _chosen(forms: Sequence[str], one: Ship) -> list[str]:
    """The forms named and the one they are measured by, in their usual order; without names all but the panels.

    A ship without a database of its own has no form of that name.
    """
    from quartering.loads.comparison import MEANINGS, MEASURE, OWN, PANELS
    from quartering.loads.source import wave_source

    unknown = [form for form in forms if form not in MEANINGS]
    if unknown:
        raise InputError(f"form {unknown[0]!r} given; allowed: {', '.join(MEANINGS)}; try '{MEASURE}'")
    without_own = wave_source(one).source is None
    if OWN in forms and without_own:
        raise InputError(
            f"--form {OWN}: {one.name} has no database of its own; give one in the ship file (database:), or write "
            "hydrodynamics: panels"
        )
    without = {PANELS, OWN} if without_own else {PANELS}
    return [form for form in MEANINGS if (form in (*forms, MEASURE) if forms else form not in without)]


def _panels(one: Ship, lengths: Sequence[float], headings: np.ndarray) -> xr.Dataset:
    """Forces by panels, wave by wave."""
    import xarray as xr

    from quartering.hydro.source.capytaine_run import bem_forces

    parts: list[xr.Dataset] = []
    with bar("wave lengths by panels", len(lengths)) as report:
        for length in lengths:
            parts.append(bem_forces(one, [length], headings))
            report(len(parts), len(lengths))
    return xr.concat(parts, "wave_length", data_vars="minimal", combine_attrs="override")


def _by_wave(compared: xr.Dataset, title: str) -> Table:
    """Largest amplitude over heading and largest difference, by wave length and form."""
    import numpy as np

    from quartering.loads.comparison import MEASURE
    from quartering.view.wording import metric_prefix

    columns, cells = ["lambda/L", "form"], []
    for mode, unit in _UNITS.items():
        largest = compared["amplitude"].sel(mode=mode).max("heading").transpose("wave_length", "form").to_numpy()
        apart = compared["largest_difference"].sel(mode=mode).transpose("wave_length", "form").to_numpy()
        scale, prefix = metric_prefix(float(np.nanmax(largest)))
        columns += [f"{mode} [{prefix}{unit}]", f"from {MEASURE}"]
        cells += [
            [["none" if np.isnan(v) else f"{v / scale:.4g}" for v in row] for row in largest],
            [["none" if np.isnan(v) else f"{v:.1%}" for v in row] for row in apart],
        ]
    rows = [
        (f"{ratio:.3g}", str(form), *(column[i][j] for column in cells))
        for i, ratio in enumerate(compared["ratio"].to_numpy())
        for j, form in enumerate(compared["form"].to_numpy())
    ]
    return table(
        f"{title}; largest over heading, and largest difference in % of it", columns, rows, (0, *range(2, len(columns)))
    )


def _facts(compared: xr.Dataset) -> dict[str, object]:
    """Everything, with where it stands and what it rests on."""
    from quartering.loads.comparison import MEANINGS

    keys = ("ship", "speed", "reference_point", "heading_convention", "references", "panels")
    difference = compared["largest_difference"].transpose("form", "mode", "wave_length")
    amplitude = compared["amplitude"].transpose("form", "mode", "wave_length", "heading")

    def by_mode(values: xr.DataArray) -> dict[str, object]:
        return {mode: values.sel(mode=mode).to_numpy() for mode in _UNITS}

    return {
        **{key: compared.attrs[key] for key in keys if key in compared.attrs},
        "heading": compared["heading"].to_numpy(),
        "wave_length": compared["wave_length"].to_numpy(),
        "unit": _UNITS,
        "meaning": {str(form): MEANINGS[str(form)] for form in compared["form"].to_numpy()},
        "forms": {str(form): by_mode(amplitude.sel(form=form)) for form in compared["form"].to_numpy()},
        "largest_difference_from_stf": {
            str(form): by_mode(difference.sel(form=form)) for form in compared["form"].to_numpy()
        },
    }

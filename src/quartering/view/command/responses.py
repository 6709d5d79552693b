"""`quartering responses`: linear responses in all six modes over wave length and heading."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import GRAVITY
from quartering.options import OPTIONS
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, ShipName, Speed
from quartering.view.console.files import TABLES, File, is_table, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import typed_ship, typed_value
from quartering.view.console.typed_values import values

if TYPE_CHECKING:
    import xarray as xr

    from quartering.view.console.printed import Table

_NOTHING = 1e-9


def responses(
    ship: ShipName,
    changes: Changes,
    speed: Speed = "0.2Fn",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: 0.5L,1L,2L or from:to:count.")] = "0.4L:3L:27",
    headings: Annotated[str, typer.Option(help="Headings [deg]: 0:180:13 or a list.")] = "0:180:7",
    place: Annotated[
        str | None,
        typer.Option(
            help="Of accelerations: x forward of midship, y to starboard, height over the baseline; G by default."
        ),
    ] = None,
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Table (.csv, .xlsx) or dataset (.nc) to write.")
    ] = None,
) -> Answer:
    """Linear responses in all six modes per metre of wave amplitude, over wave length and heading."""
    import numpy as np

    from quartering.loads.validity import warn_of_conditions
    from quartering.study.six_modes.responses import response_grid
    from quartering.view.wording import speed_words

    one = typed_ship(ship, changes)
    path = reserve_path(output, (*TABLES, ".nc"))
    u = typed_value("speed", speed, one.sizes)
    lengths = values([wave_lengths], OPTIONS["wave_length"], one.sizes, "--wave-lengths", 27)
    mu = values([headings], OPTIONS["heading"], one.sizes, "--headings", 13)
    warn_of_conditions(one, np.array([u]), min(lengths))
    where = None if place is None else [part.strip() for part in place.split(",")]
    found = response_grid(one, lengths, np.array([u]), np.array(mu), place=where)

    def lines() -> Iterator[Table | str]:
        said = speed_words(u, one.hull.length)
        title = f"{one.name}: linear responses per metre of wave amplitude, {said}; largest, and in which wave length"
        yield _largest(found, title, one.hull.length)
        yield f"Gyradius of pitch {found.attrs['gyradius_pitch']:.4g} m ({found.attrs['gyradius_pitch_source']})."

    again = f"{ship}{option_words(changes)}"
    return Answer(
        lines(),
        lambda: _facts(found) | {"file": str(path) if path else None},
        () if path is None or is_table(path) else (File(path, lambda part: found.to_netcdf(part)),),
        output=path,
        data=lambda: [data_table(found, f"{one.name}: linear responses per metre of wave amplitude")],
        next_steps=[f"quartering verdict {again}", f"quartering hull {again}"],
    )


def _largest(found: xr.Dataset, title: str, length: float) -> Table:
    """Largest amplitude of each mode over wave length, and where, by heading."""
    import numpy as np

    from quartering.study.six_modes.responses import MODES

    columns = ["heading [deg]"]
    cells = []
    for name, (unit, _, _) in MODES.items():
        columns.append(f"{name.removesuffix('_amplitude')} [{unit}/m]")
        amplitude = found[name].isel(speed=0).to_numpy()
        at = np.where(np.isfinite(amplitude), amplitude, -1.0).argmax(axis=0)
        ratios = found["wave_length"].to_numpy()[at] / length
        largest = [(amplitude[i, j], ratios[j]) for j, i in enumerate(at)]
        cells.append([f"{size:.4g} at {ratio:.3g} L" if size > _NOTHING else "0" for size, ratio in largest])
    rows = [(f"{float(mu):g}", *row) for mu, row in zip(found["heading"], zip(*cells, strict=True), strict=True)]
    return table(title, columns, rows, tuple(range(len(columns))))


def _facts(found: xr.Dataset) -> dict[str, object]:
    """Everything, dims in the order of the attribute."""
    names = (*found.coords, *found.data_vars)
    return dict(found.attrs) | {
        "dims": ["wave_length", "speed", "heading"],
        "gravity": GRAVITY,
        "units": {str(name): found[name].attrs.get("units", "1") for name in names},
        **{str(name): found[name].to_numpy() for name in names},
    }

"""`quartering responses`: linear responses in all six modes over wave length and heading."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from rich.table import Table

from quartering.conventions import GRAVITY
from quartering.loads.validity import warn_of_conditions
from quartering.options import OPTIONS
from quartering.study.responses import MODES, response_grid
from quartering.view.commands.conditions import sizes, typed_ship, typed_value
from quartering.view.options import values
from quartering.view.output import claim, write
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import speed_words

TABLES = (".csv", ".nc")
"""Kinds of table that can be written."""
_NOTHING = 1e-9


def list_responses(
    name: str, typed: tuple[str, str, str, str | None], changes: Mapping[str, str], output: str | None, as_json: bool
) -> None:
    """Print the largest response of each mode over wave length; write all of them where asked."""
    one = typed_ship(name, changes)
    path = claim(output, TABLES) if output is not None else None
    speed, lengths_typed, headings_typed, place = typed
    u = typed_value("speed", speed, one.sizes)
    lengths = values([lengths_typed], OPTIONS["wave_length"], sizes(one), "--wave-lengths", 27)
    headings = values([headings_typed], OPTIONS["heading"], sizes(one), "--headings", 13)
    warn_of_conditions(one, np.array([u]), min(lengths))
    where = None if place is None else [part.strip() for part in place.split(",")]
    found = response_grid(one, lengths, np.array([u]), np.array(headings), place=where)
    if path is not None:
        write((path, lambda part: _save(found, part, path.suffix.lower())))
    if as_json:
        show_json(_facts(found) | {"file": str(path) if path else None})
        return
    speed_said = speed_words(u, one.hull.length)
    title = f"{one.name}: linear responses per metre of wave amplitude, {speed_said}; largest, and in which wave length"
    show(_largest(found, title, one.hull.length))
    show(f"Gyradius of pitch {found.attrs['gyradius_pitch']:.4g} m ({found.attrs['gyradius_pitch_source']}).")
    if path is not None:
        show(f"Wrote {path}")
    show(
        next_steps(
            f"quartering verdict {name}{option_words(changes)}", f"quartering hull {name}{option_words(changes)}"
        )
    )


def _largest(found: xr.Dataset, title: str, length: float) -> Table:
    """Largest amplitude of each mode over wave length, and where, by heading."""
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


def _save(found: xr.Dataset, part: object, suffix: str) -> None:
    """Write the dataset as netCDF, or as a table of one condition a line with units in its head."""
    if suffix == ".nc":
        found.to_netcdf(str(part))
        return
    frame = found.to_dataframe().reset_index()
    units = {str(name): str(found[name].attrs.get("units", "1")) for name in frame.columns}
    head = [f"# {key}: {value}" for key, value in found.attrs.items()]
    head.append("# " + "; ".join(f"{name} [{unit}]" for name, unit in units.items()))
    with open(str(part), "w", encoding="utf-8", newline="") as file:
        file.write("\n".join(head) + "\n")
        frame.to_csv(file, index=False, lineterminator="\n")


def _facts(found: xr.Dataset) -> dict[str, object]:
    """Everything, dims in the order of the attribute."""
    names = (*found.coords, *found.data_vars)
    return dict(found.attrs) | {
        "dims": ["wave_length", "speed", "heading"],
        "gravity": GRAVITY,
        "units": {str(name): found[name].attrs.get("units", "1") for name in names},
        **{str(name): found[name].to_numpy() for name in names},
    }

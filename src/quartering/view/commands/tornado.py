"""`quartering vary --tornado`: by how much each value matters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from rich.table import Table

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.options import OPTIONS
from quartering.stability.ahead import announce_compilation
from quartering.stability.kind import Kind
from quartering.study.effects.tornado import MEASURES, tornado
from quartering.units import quantity
from quartering.view.commands.conditions import condition
from quartering.view.commands.vary import condition_option_words, is_range, option, store
from quartering.view.output import PICTURES, claim
from quartering.view.progress import bar
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import MOST_ROWS, condition_words, estimated_names, flip_words, notes, row_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FLIPS = "Right: the nearest value, within a fifth to five times, at which the verdict flips when it alone is changed."
KG = "GM and KG are one value: GM = KM - KG."


def draw_tornado(
    name: str,
    typed: Mapping[str, str],
    ranges: Mapping[str, str],
    coefficients: Sequence[str],
    change: str,
    harmonics: int,
    form: str,
    output: str | None,
    as_json: bool,
) -> None:
    """Change every value by a share, print the largest effects, draw or store them where asked."""
    if (
        coefficients
        or any(is_range(text) for key, text in ranges.items() if OPTIONS[key].axis)
        or any(is_range(text) for text in typed.values())
    ):
        raise InputError("--tornado changes every value itself; leave the ranges out, or leave out --tornado")
    words = (typed["heading"], typed["speed"], typed["wave_length"], typed["wave_height"])
    one, wave, speed, heading = condition(name, words, ranges)
    path = claim(output, (*PICTURES, ".nc")) if output is not None else None
    share = quantity(change, "ratio", what="--tornado")
    chosen: Form = form  # type: ignore[assignment]  # tornado refuses an unknown one
    announce_compilation()
    with bar("changes", 1) as report:
        ds = tornado(one, wave, speed, heading, change=share, harmonics=harmonics, form=chosen, progress=report)
    base = xr.Dataset(
        coords={"heading": heading, "speed": speed, "wave_length": wave.length, "wave_height": wave.height},
        attrs=ds.attrs,
    )
    title = f"{one.name}: each value changed by {100 * share:g} %\n{condition_words(base)}; {ds.attrs['loading']}"
    note = "\n".join([f"{FLIPS} {KG}", *notes(ds)])

    def draw() -> Figure:
        from quartering.view.plots.tornado import tornado_picture

        return tornado_picture(ds, title, note)

    store(path, ds, draw)
    if as_json:
        show_json(_tornado_facts(ds) | {"written": None if path is None else str(path)})
        return
    show(f"{condition_words(base)}. Now: {_measures(ds)}.")
    show(_tornado_table(ds), FLIPS, KG, *notes(ds))
    if path is not None:
        show(f"Wrote {path}")
    first = str(ds["parameter"].values[0])
    options = condition_option_words(typed) + option_words(ranges)
    show(next_steps(f"quartering vary {name}{options} {_range_words(one, ds, first)} -o {first}.png"))


def _measures(ds: xr.Dataset) -> str:
    roll, index, exponent = (ds.attrs[f"base_{name}"] for name in MEASURES)
    label = Kind(int(ds.attrs["base_verdict"])).label
    return f"roll {roll:.3g} deg, S {index:.3g} 1/s, Floquet {exponent:.3g} 1/s, {label}"


def _tornado_table(ds: xr.Dataset) -> Table:
    def cells(row: xr.Dataset) -> tuple[str, ...]:
        pairs = (f"{float(row[name][0]):.3g} / {float(row[name][1]):.3g}" for name in MEASURES)
        return (row_words(row), *pairs, flip_words(row))

    rows = [cells(ds.isel(parameter=i)) for i in range(min(MOST_ROWS, ds.sizes["parameter"]))]
    title = f"{ds.attrs['ship']}: {100 * ds.attrs['change']:g} % less / more of each, the largest effects first"
    return table(title, ("value", "roll [deg]", "S [1/s]", "Floquet [1/s]", "verdict flips"), rows, right=(1, 2, 3))


def _tornado_facts(ds: xr.Dataset) -> dict[str, object]:
    rows = [
        {
            "parameter": str(row["parameter"].values), "now": float(row["value"]), "unit": str(row["unit"].values),
            **{name: {side: float(row[name].sel(side=side)) for side in ("less", "more")} for name in MEASURES},
            "flip": float(row["flip"]),
            "beyond": Kind(int(row["verdict_beyond"])).label if np.isfinite(row["flip"]) else None,
        }
        for row in (ds.isel(parameter=i) for i in range(ds.sizes["parameter"]))
    ]  # fmt: skip
    base = {name: ds.attrs[f"base_{name}"] for name in MEASURES}
    now = base | {"verdict": Kind(int(ds.attrs["base_verdict"])).label}
    return {
        "ship": ds.attrs["ship"],
        "change": ds.attrs["change"],
        "now": now,
        "estimated": estimated_names(ds),
        "parameters": rows,
    }


def _range_words(one: Ship, ds: xr.Dataset, name: str) -> str:
    now = float(ds["value"].sel(parameter=name))
    if name == "kg":  # as far as half of GM: not above the metacentre
        return f"--kg {now - one.loading.gm / 2:.3g}:{now + one.loading.gm / 2:.3g}"
    if name in OPTIONS:
        return f"{option(name)} {0.8 * now:.3g}:{1.2 * now:.3g}"
    return f"--coefficient {name}=0.2:2"

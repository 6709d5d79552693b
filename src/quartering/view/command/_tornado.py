"""`quartering vary --tornado`: by how much each value matters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.units import quantity
from quartering.view.command._varied import is_range, option, unvaried_words
from quartering.view.console.answer import Answer
from quartering.view.console.files import PICTURES, TABLES, dataset_or_picture, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import Typed

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.view.console.printed import Table

FLIPS = "Right: the nearest value, within a fifth to five times, at which the verdict flips when it alone is changed."
KG = "GM and KG are one value: GM = KM - KG."


def each_value_changed(
    typed: Typed, coefficients: Sequence[str], change: str, harmonics: int, form: Form, output: str | None
) -> Answer:
    """Change every value by a share, one at a time.

    Parameters
    ----------
    typed : Typed
    coefficients : sequence of str    ranges of coefficients, which are refused here
    change : str                      the share, "10%"
    harmonics : int
    form : str
    output : str or None              picture or dataset to write

    Returns
    -------
    Answer

    Raises
    ------
    InputError                        a range
    """
    import xarray as xr

    from quartering.stability.precompile import announce_compilation
    from quartering.study.effects.tornado import tornado
    from quartering.view.wording import condition_words, notes

    if coefficients or _holds_ranges(typed):
        raise InputError("--tornado changes every value itself; leave the ranges out, or leave out --tornado")
    one, wave, speed, heading = typed.read()
    path = reserve_path(output, (*PICTURES, ".nc", *TABLES))
    share = quantity(change, "ratio", what="--tornado")
    announce_compilation()
    with bar("changes", 1) as progress:
        ds = tornado(one, wave, speed, heading, change=share, harmonics=harmonics, form=form, progress=progress)
    at = {"heading": heading, "speed": speed, "wave_length": wave.length, "wave_height": wave.height}
    said = condition_words(xr.Dataset(coords=at, attrs=ds.attrs))

    def draw() -> Figure:
        from quartering.view.plots.tornado import tornado_picture

        title = f"{one.name}: each value changed by {100 * share:g} %\n{said}; {ds.attrs['loading']}"
        return tornado_picture(ds, title, "\n".join([f"{FLIPS} {KG}", *notes(ds)]))

    def lines() -> Iterator[Table | str]:
        yield f"{said}. Now: {_measures(ds)}."
        yield _tornado_table(ds)
        yield from (FLIPS, KG, *notes(ds))

    first = str(ds["parameter"].values[0])
    words = unvaried_words(typed) + option_words(typed.changes)
    return Answer(
        lines(),
        lambda: _tornado_facts(ds) | {"written": None if path is None else str(path)},
        dataset_or_picture(path, ds, draw),
        output=path,
        next_steps=[f"quartering vary {typed.ship}{words} {_range_words(one, ds, first)} -o {first}.png"],
    )


def _holds_ranges(typed: Typed) -> bool:
    """Is a range typed for the condition, or for an option that a study may vary?"""
    axes = [text for key, text in typed.changes.items() if OPTIONS[key].axis]
    return any(is_range(text) for text in (*axes, *typed.condition.values()))


def _measures(ds: xr.Dataset) -> str:
    from quartering.stability.kind import Kind
    from quartering.study.effects.tornado import MEASURES

    roll, index, exponent = (ds.attrs[f"base_{name}"] for name in MEASURES)
    label = Kind(int(ds.attrs["base_verdict"])).label
    return f"roll {roll:.3g} deg, S {index:.3g} 1/s, Floquet {exponent:.3g} 1/s, {label}"


def _tornado_table(ds: xr.Dataset) -> Table:
    from quartering.study.effects.tornado import MEASURES
    from quartering.view.wording import MOST_ROWS, flip_words, row_words

    def cells(row: xr.Dataset) -> tuple[str, ...]:
        pairs = (f"{float(row[name][0]):.3g} / {float(row[name][1]):.3g}" for name in MEASURES)
        return (row_words(row), *pairs, flip_words(row))

    rows = [cells(ds.isel(parameter=i)) for i in range(min(MOST_ROWS, ds.sizes["parameter"]))]
    title = f"{ds.attrs['ship']}: {100 * ds.attrs['change']:g} % less / more of each, the largest effects first"
    return table(title, ("value", "roll [deg]", "S [1/s]", "Floquet [1/s]", "verdict flips"), rows, right=(1, 2, 3))


def _tornado_facts(ds: xr.Dataset) -> dict[str, object]:
    import numpy as np

    from quartering.stability.kind import Kind
    from quartering.study.effects.tornado import MEASURES
    from quartering.view.wording import estimated_names

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

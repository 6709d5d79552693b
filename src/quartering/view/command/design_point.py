"""`quartering design-point`: a roll too rare to count, by the likeliest sea that leads to it."""

from __future__ import annotations

from collections.abc import Iterator
from time import process_time
from typing import TYPE_CHECKING, Annotated, Any

import typer

from quartering.arguments import ARGUMENTS
from quartering.conventions import NORMAL_95
from quartering.units import NO_SHIP
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, Heading, PictureOrData, ShipName, Speed
from quartering.view.console.files import PICTURES, TABLES, dataset_or_picture, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import working
from quartering.view.console.sea_options import (
    Gamma,
    Hs,
    Seed,
    SpectrumName,
    SpreadingWords,
    SwellWords,
    Tp,
    TypedSea,
    Tz,
    told,
)
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import typed_ship, typed_value
from quartering.view.console.typed_values import value

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.view.console.printed import Table


def design_point(
    ship: ShipName,
    hs: Hs,
    heading: Heading,
    speed: Speed,
    changes: Changes,
    roll: Annotated[str, told("roll_level", ": 30")],
    tp: Tp = None,
    tz: Tz = None,
    spectrum: SpectrumName = "jonswap",
    gamma: Gamma = "3.3",
    spreading: SpreadingWords = "none",
    swell: SwellWords = None,
    windows: Annotated[int, typer.Option(help="Windows to sample about the likeliest, 64 or more.")] = 4096,
    seed: Seed = 0,
    form: FormName = "stf",
    output: PictureOrData = None,
) -> Answer:
    """Probability and rate of a roll too rare to count, sampled about the likeliest sea that leads to it."""
    from quartering.study.seas.simulated.design_point import design_point as found_about

    one, typed = typed_ship(ship, changes), TypedSea(heading, hs, tp, tz, spectrum, gamma, spreading, swell)
    path = reserve_path(output, (*PICTURES, ".nc", *TABLES))
    sea, u = typed.read(one.sizes), typed_value("speed", speed, one.sizes)
    level = value(roll, ARGUMENTS["roll_level"], NO_SHIP, "--roll")
    begun = process_time()
    with working("searching the likeliest sea"):
        ds = found_about(one, sea, u, level, windows=windows, seed=seed, form=form)  # type: ignore[arg-type]  # refuses an unknown form
    took = process_time() - begun

    def draw() -> Figure:
        from quartering.view.plots.design_point import design_point_picture

        return design_point_picture(ds)

    return Answer(
        _lines(ds, took),
        lambda: _facts(ds) | {"processor_time": took, "file": str(path) if path else None},
        dataset_or_picture(path, ds, draw),
        output=path,
        data=lambda: [data_table(ds, "Roll of the likeliest window", ("roll",))],
        next_steps=[f"quartering sea {ship} --speed {speed}{typed.words} --hours 256{option_words(changes)}"],
    )


def _lines(ds: xr.Dataset, took: float) -> Iterator[Table | str]:
    rows = []
    for words, name, unit in (
        ("probability at an instant, to one side", "probability", ""),
        ("up-crossings, to one side", "crossing_rate", " 1/s"),
    ):
        best, error = float(ds[name]), float(ds[f"{name}_error"])
        low, high = max(best - NORMAL_95 * error, 0.0), best + NORMAL_95 * error
        rows.append((words, f"{best:.3g}{unit}", f"{error:.2g}", f"{low:.3g} to {high:.3g}"))
    rows.append(("probability by the distance alone", f"{float(ds['probability_form']):.3g}", "-", "-"))
    title = f"Roll of {ds.attrs['level']:.3g} deg: {ds.attrs['ship']}, {ds.attrs['speed']:.4g} m/s, {ds.attrs['seas']}"
    yield table(title, ("quantity", "value", "standard error", "95 % interval"), rows, (1, 2, 3))
    yield (
        f"The likeliest window is {float(ds['beta']):.3g} deviations from rest, of the linear ship"
        f" {float(ds['linear_beta']):.3g}. {float(ds['effective']):.3g} of {ds.attrs['windows']} windows count effectively."
    )
    yield (
        f"Found in {ds.attrs['iterations']} steps in {ds.attrs['variables']} variables, windows of {ds.attrs['window']:.0f} s,"
        f" seed {ds.attrs['seed']}; {took:.3g} s of processor time, compiling included."
    )
    yield "Crossings come in groups: first passages to either side come at one to two times their rate."


def _facts(ds: xr.Dataset) -> dict[str, Any]:
    numbers = {str(name): float(ds[name]) for name in ds.data_vars if not ds[name].dims}
    about = ("ship", "seas", "speed", "seed", "windows", "level", "iterations", "variables", "window")
    return {**{name: ds.attrs[name] for name in about}, **numbers}

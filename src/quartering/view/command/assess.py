"""`quartering assess`: direct assessment, the rate of failures over all the seas a ship meets."""

from __future__ import annotations

from collections.abc import Iterator
from time import process_time
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

from quartering.arguments import ARGUMENTS
from quartering.options import OPTIONS
from quartering.units import NO_SHIP
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, PictureOrData, ShipName
from quartering.view.console.files import PICTURES, TABLES, dataset_or_picture, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.sea_options import Gamma, SeaTable, Seed, SpreadingWords, told, typed_spreading
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import typed_ship
from quartering.view.console.typed_values import value, values

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.view.console.printed import Table

_MOST_ROWS: Final = 12
_CELL: Final = (
    "failure_rate", "rate_lower", "rate_upper", "contribution", "failures", "exposure", "waiting_time_p", "lost", "status",
    "weight",
)  # fmt: skip


def assess(
    ship: ShipName,
    changes: Changes,
    speed: Annotated[list[str], typer.Option(help="Forward speeds, all alike in time: 15kn, repeatable, or 0:15kn:4.")],
    seas: SeaTable = None,
    headings: Annotated[str, typer.Option(help="Headings the sea goes to: 0:180:13.")] = "0:180:13",
    spectrum: Annotated[
        str, typer.Option(help="Spectrum: bretschneider, jonswap or pierson-moskowitz.")
    ] = "bretschneider",
    gamma: Gamma = "3.3",
    spreading: SpreadingWords = "cos2",
    hours: Annotated[str, typer.Option(help="Budget of a cell [h], 32 at a time.")] = "1000",
    precision: Annotated[str, told("precision")] = "0.2",
    share: Annotated[str, told("left_out_share")] = "0.01",
    seed: Seed = 0,
    store: Annotated[
        str | None, typer.Option(help="Folder that keeps finished blocks: the same command goes on from there.")
    ] = None,
    cluster: Annotated[str | None, typer.Option(help="local:4 or tcp://host:8786: by workers of dask.")] = None,
    form: FormName = "stf",
    output: PictureOrData = None,
) -> Answer:
    """Direct assessment: failures over all seas a ship meets, every cell that can matter simulated."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.maps.assessment import direct_assessment
    from quartering.study.seas.failure_rates.occurrence import read_table

    one = typed_ship(ship, changes)
    path = reserve_path(output, (*PICTURES, ".nc", *TABLES))
    given: dict[str, Any] = {
        "occurrence": None if seas is None else read_table(seas),
        "speed": values(speed, OPTIONS["speed"], one.sizes, "--speed", 4),
        "heading": values([headings], OPTIONS["heading"], one.sizes, "--headings", 13),
        "spectrum": spectrum,
        "spreading": typed_spreading(spreading),
        "gamma": value(gamma, ARGUMENTS["gamma"], NO_SHIP, "--gamma"),
        "hours": value(hours, ARGUMENTS["simulated_hours"], NO_SHIP, "--hours"),
        "precision": value(precision, ARGUMENTS["precision"], NO_SHIP, "--precision"),
        "share": value(share, ARGUMENTS["left_out_share"], NO_SHIP, "--share"),
    }
    announce_compilation()
    begun = process_time()
    with bar("cells", 1) as progress:
        ds = direct_assessment(one, **given, seed=seed, form=form, progress=progress, store=store, cluster=cluster)  # type: ignore[arg-type]  # refuses an unknown form
    took = process_time() - begun
    ds.attrs["ship_argument"] = ship

    def draw() -> Figure:
        from quartering.view.plots.assessment import assessment_picture

        return assessment_picture(ds)

    return Answer(
        _lines(ds, took),
        lambda: _facts(ds) | {"processor_time": took, "file": str(path) if path else None},
        dataset_or_picture(path, ds, draw),
        output=path,
        data=lambda: [data_table(ds, f"{ds.attrs['title']}: cells", _CELL)],
        next_steps=[f"quartering sea {ship} {_worst(ds)} --hours 256{option_words(changes)}"],
    )


def _lines(ds: xr.Dataset, took: float) -> Iterator[Table | str]:
    yield _cells(ds)
    yield _statuses(ds)
    yield _verdict(ds)
    yield (
        f"Left out: at most {float(ds['left_out'][0]):.2g} 1/s by their upper ends ({ds.attrs['interval_of_closure']});"
        f" carried down from higher seas {float(ds['carried_down'][0]):.2g} 1/s; not judged"
        f" {float(ds['not_judged'][0]):.2%} of the time."
    )
    yield (
        f"Simulated {float(ds['hours_spent'][0]):,.0f} ship-hours, seed {ds.attrs['seed']}, {float(ds.attrs['hours']):g} h a"
        f" cell at most; {took:.3g} s of processor time. Seas: {ds.attrs['table']}."
    )
    yield "Sway-roll-yaw motion is none of the five modes of the criteria, and nothing here shows compliance with any rule."


def _ordered(ds: xr.Dataset) -> xr.Dataset:
    """Cells with a rate, the largest contribution first."""
    import numpy as np

    flat = ds.isel(loading=0).stack(cell=("hs", "tz", "speed", "heading"))
    order = np.argsort(-flat["contribution"].fillna(-1.0).values, kind="stable")
    return flat.isel(cell=order)


def _cells(ds: xr.Dataset) -> Table:
    from quartering.study.seas.failure_rates.assessment_grid import Assessed

    flat = _ordered(ds)
    total = max(float(ds["long_term_rate"][0]), 1e-300)
    rows = []
    for i in range(min(_MOST_ROWS, flat.sizes["cell"])):
        at = flat.isel(cell=i)
        if not float(at["contribution"]) > 0:
            break
        ends = f"{float(at['rate_lower']):.2g} to {float(at['rate_upper']):.2g}"
        hours = float(at["exposure"])
        rows.append((
            f"{float(at['hs']):.3g}", f"{float(at['tz']):.3g}", f"{float(at['speed']):.3g}", f"{float(at['heading']):g}",
            f"{float(at['failure_rate']):.2g}", ends, f"{float(at['weight']):.2g}", f"{float(at['contribution']) / total:.1%}",
            f"{hours:.0f} h" if hours > 0 else "-", Assessed(int(at["status"])).label,
        ))  # fmt: skip
    heads = ("Hs [m]", "Tz [s]", "U [m/s]", "heading", "failures [1/s]", "95 % interval", "share of time", "of the sum",
             "exposure", "answered")  # fmt: skip
    return table(
        f"{ds.attrs['ship']}: cells that failures come from, {ds.attrs['sea']}",
        heads,
        rows,
        (0, 1, 2, 3, 4, 5, 6, 7, 8),
    )


def _statuses(ds: xr.Dataset) -> Table:
    from quartering.study.seas.failure_rates.assessment_grid import Assessed

    one = ds.isel(loading=0)
    weight, upper = one["weight"].transpose(*one["status"].dims), one["rate_upper"].fillna(0.0)
    rows = []
    for kind in Assessed:
        own = one["status"] == int(kind)
        if number := int(own.sum()):
            time, most = float(weight.where(own, 0.0).sum()), float((weight * upper).where(own, 0.0).sum())
            added = float(one["contribution"].fillna(0.0).where(own, 0.0).sum())
            rows.append((kind.label, f"{number}", f"{time:.3%}", f"{added:.2g}", f"{most:.2g}"))
    heads = ("cells", "number", "share of time", "failures [1/s]", "upper ends added [1/s]")
    return table("How cells were answered, or why they were left out", heads, rows, (1, 2, 3, 4))


def _verdict(ds: xr.Dataset) -> str:
    from quartering.study.seas.failure_rates.assessment_grid import Assessed
    from quartering.view.plots.assessment import sum_words

    low, high = (float(ds[f"long_term_{end}"][0]) for end in ("lower", "upper"))
    level = float(ds.attrs["safety_level_rate"])
    blind = bool((ds["status"][0] == int(Assessed.NOT_KNOWN)).any())
    side = "above" if low > level else "not decided against" if blind or high > level else "below"
    words = sum_words(ds.isel(loading=0))
    return f"{words[0].upper()}{words[1:]}: {side} the safety level of {ds.attrs['safety_level']}."


def _worst(ds: xr.Dataset) -> str:
    at = _ordered(ds).isel(cell=0)
    return (
        f"--hs {float(at['hs']):.4g} --tz {float(at['tz']):.4g} --heading {float(at['heading']):g} --speed"
        f" {float(at['speed']):.4g} --spectrum {ds.attrs['spectrum']} --spreading {ds.attrs['spreading']}"
    )


def _facts(ds: xr.Dataset) -> dict[str, Any]:
    """Everything about an assessment, for programs."""
    from quartering.study.seas.failure_rates.assessment_grid import Assessed

    sums = [name for name in ds.data_vars if ds[name].dims == ("loading",)]
    status = ds["status"].values
    about = ("ship", "loading", "sea", "seed", "hours", "precision", "share_left_out", "table", "safety_level", "roll_limit",
             "safety_level_rate")  # fmt: skip
    names = ("hs", "tz", "speed", "heading", "failure_rate", "rate_lower", "rate_upper", "contribution", "weight", "exposure",
             "failures", "status")  # fmt: skip
    return {
        **{name: ds.attrs[name] for name in about},
        **{str(name): ds[name].values for name in sums},
        "cells": {kind.name.lower(): int((status == kind).sum()) for kind in Assessed},
        **{name: ds[name].values for name in names},
    }

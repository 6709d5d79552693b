"""`quartering polar --hs`: operational guidance, speed over heading in irregular seas."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from time import process_time
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from quartering.arguments import ARGUMENTS
from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.units import NO_SHIP
from quartering.view.console.answer import Answer
from quartering.view.console.files import File, picture_files, reserve_path, ship_stem
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.sea_options import typed_spreading, typed_swell
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship
from quartering.view.console.typed_values import value, values
from quartering.view.sea_words import guidance_facts

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.view.console.printed import Table

SPEEDS: Final = "0:0.24Fn:7"
_SEVERAL: Final = 3
_MOST: Final = 100_000
"""Conditions of one map: a quarter of an hour or so."""


class Typed(NamedTuple):
    """What was typed of the seas of a map."""

    hs: str
    tp: str | None
    tz: str | None
    spectrum: str
    gamma: str
    spreading: str
    swell: str | None
    judge: str
    threshold: str | None
    hours: str


def sea_polar_answer(
    ship: str,
    changes: Mapping[str, str],
    speed: Sequence[str] | None,
    headings: str,
    typed: Typed,
    form: str,
    output: str | None,
) -> Answer:
    """Compute, draw and tell a map over seas."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.maps.guidance import guidance

    one = typed_ship(ship, changes)
    data = reserve_path(f"{ship_stem(ship)}-guidance.nc" if output is None else output, (".nc",))
    picture = reserve_path(data.with_suffix(".png"), (".png",))
    given: dict[str, Any] = {
        "speed": values(speed or [SPEEDS], OPTIONS["speed"], one.sizes, "--speed", 7),
        "heading": values([headings], OPTIONS["heading"], one.sizes, "--headings", 37),
        **_seas(typed),
    }
    count = math.prod(len(given[name]) for name in ("speed", "heading", "hs", "tp", "tz") if given[name] is not None)
    if count > _MOST:
        raise InputError(
            f"{count:,} conditions are asked for; a map takes up to {_MOST:,}: take fewer values, or a case file with `sea:`"
            " (quartering new --case), which is kept block by block"
        )
    announce_compilation()
    begun = process_time()
    with bar("conditions", count) as progress:
        ds = guidance(one, **given, form=form, progress=progress)  # type: ignore[arg-type]  # refuses an unknown form
    took = process_time() - begun
    ds.attrs["ship_argument"] = ship

    def draw() -> Figure:
        from quartering.view.plots.sea_polar import sea_polar

        return sea_polar(ds)

    return Answer(
        _lines(ds, took),
        lambda: guidance_facts(ds) | {"processor_time": took, "dataset": str(data), "picture": str(picture)},
        [File(data, lambda part: ds.to_netcdf(part)), *picture_files(picture, draw)],
        written=f"Wrote {data} and {picture}",
        next_steps=[f"quartering sea {ship} {_worst(ds, typed)}{option_words(changes)}", f"quartering report {data}"],
    )


def _seas(typed: Typed) -> dict[str, Any]:
    """What was typed of the seas, as `guidance` takes it."""
    found: dict[str, Any] = {
        name: None if text is None else values([text], ARGUMENTS[name], NO_SHIP, ARGUMENTS[name].command, _SEVERAL)
        for name, text in (("hs", typed.hs), ("tp", typed.tp), ("tz", typed.tz))
    }
    spreading = typed_spreading(typed.spreading)
    limit = "rate_limit" if typed.judge == "rate" else "safety_factor"
    none = typed.hours.strip() in ("0", "none")
    return found | {
        "spectrum": typed.spectrum,
        "gamma": value(typed.gamma, ARGUMENTS["gamma"], NO_SHIP, "--gamma"),
        "spreading": spreading,
        "swell": typed_swell(typed.swell, spreading),
        "judge": typed.judge,
        "threshold": None
        if typed.threshold is None
        else value(typed.threshold, ARGUMENTS[limit], NO_SHIP, "--threshold"),
        "hours": 0.0 if none else value(typed.hours, ARGUMENTS["simulated_hours"], NO_SHIP, "--hours"),
    }


def _lines(ds: xr.Dataset, took: float) -> Iterator[Table | str]:
    yield from guidance_lines(ds)
    yield f"{ds['recommended'].size:,} conditions in {took:.3g} s of processor time."


def guidance_lines(ds: xr.Dataset) -> Iterator[Table | str]:
    """What guidance says of each sea, its danger lines, and what it rests on."""
    from quartering.study.seas.over_seas.advice import Advice
    from quartering.study.seas.over_seas.map_axes import period_of

    rows = []
    for i in range(ds.sizes["hs"]):
        for j in range(ds.sizes[period_of(ds)]):
            one = ds.isel({"hs": i, period_of(ds): j})
            counts = [f"{int((one['recommended'] == int(kind)).sum())}" for kind in Advice]
            rows.append((f"{float(one['hs']):.3g}", f"{float(one['tp']):.3g}", _largest(one), *counts))
    heads = ("Hs [m]", "Tp [s]", "largest roll of 3 h, mean", *(kind.label for kind in Advice))
    yield table(f"{ds.attrs['ship']} in irregular seas, {ds.attrs['sea']}", heads, rows, (0, 1, 3, 4, 5, 6))
    line, half = ds["pile_up"].values
    yield (
        f"Danger lines whatever the sea: speed times cosine of the heading {line:.3g} m/s (roll in step with the waves) and"
        f" {half:.3g} m/s (parametric roll)."
    )
    yield f"{ds.attrs['threshold_words'].capitalize()} ({ds.attrs['threshold_source']})."
    yield "Undecided: the interval straddles the limit" + (
        "." if float(ds.attrs["hours"]) > 0 else "; --hours simulates there."
    )
    yield "Sway-roll-yaw motion is none of the five modes of the criteria, and nothing here shows compliance with any rule."


def _largest(one: xr.Dataset) -> str:
    """Largest roll of one sea, and where it is."""
    place = _place(one)
    if place is None:
        return "not valid"
    at = one.isel(place)
    return f"{float(at['roll_mean_3h_max']):.3g} deg at {float(at['heading']):g} deg, {float(at['speed']):.3g} m/s"


def _place(one: xr.Dataset) -> dict[Any, int] | None:
    """Where the largest roll stands; None without any answer."""
    import numpy as np

    roll = one["roll_mean_3h_max"]
    if not np.isfinite(roll).any():
        return None
    where = np.unravel_index(int(np.nanargmax(roll.values)), roll.shape)
    return {dim: int(i) for dim, i in zip(roll.dims, where, strict=True)}


def _worst(ds: xr.Dataset, typed: Typed) -> str:
    """Options of the condition with the largest roll."""
    from quartering.study.seas.over_seas.map_axes import period_of

    place = _place(ds)
    at = ds.isel(place or dict.fromkeys(("hs", period_of(ds), "speed", "heading"), 0))
    return (
        f"--hs {float(at['hs']):.4g} --tp {float(at['tp']):.4g} --heading {float(at['heading']):g} --speed"
        f" {float(at['speed']):.4g} --spectrum {typed.spectrum} --spreading {typed.spreading}"
        + (f" --swell {typed.swell}" if typed.swell else "")
    )

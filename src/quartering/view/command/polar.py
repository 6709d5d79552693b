"""`quartering polar`: the map of roll and stability."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from quartering.conventions import InputError
from quartering.options import OPTIONS, line_of
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, Harmonics, ShipName
from quartering.view.console.files import File, picture_files, reserve_path, ship_stem
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship
from quartering.view.console.typed_values import value, values

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from matplotlib.figure import Figure
    from rich.table import Table

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.loads.waves import Wave

MOST_CONDITIONS = 1_000_000
"""Largest map: about 1 GB of results."""

_NEUTRAL = 1e-9
_STEEPNESS = "1/50"
_FURTHER = "--{} .."
_RINGS = 3
"""With fewer wave lengths than this the picture is lines over heading."""


def polar(
    ship: ShipName,
    changes: Changes,
    speed: Annotated[list[str] | None, typer.Option(help="Speeds: 5,7.5 [m/s], 15kn, 0.25Fn; repeatable.")] = None,
    headings: Annotated[str, typer.Option(help="Headings [deg]: from:to:count or a list.")] = "0:180:37",
    wave_lengths: Annotated[str, typer.Option(help="Wave lengths: from:to:count or a list, m or L.")] = "0.4L:2.3L:20",
    steepness: Annotated[
        str | None, typer.Option(help="Wave height over wave length; 1/50 where nothing is given.")
    ] = None,
    wave_height: Annotated[
        str | None, typer.Option(help="One wave height for all lengths [m], instead of a steepness.")
    ] = None,
    harmonics: Harmonics = 1,
    form: FormName = "stf",
    output: Annotated[
        str | None, typer.Option("-o", "--output", help="Dataset to write (.nc); a .png goes beside it.")
    ] = None,
    extend: Annotated[bool, typer.Option("--extend", help=f"{line_of(OPTIONS['extend']).partition(':')[0]}.")] = False,
) -> Answer:
    """Map of roll and stability over headings, wave lengths and speeds."""
    import numpy as np

    from quartering.stability.precompile import announce_compilation
    from quartering.study.maps.polar import polar as polar_map_of
    from quartering.view.wording import edge_words, notes

    one = typed_ship(ship, changes)
    data = reserve_path(f"{ship_stem(ship)}-polar.nc" if output is None else output, (".nc",))
    picture = reserve_path(data.with_suffix(".png"), (".png",))
    speeds = values(speed or ["0.15Fn,0.2Fn,0.25Fn"], OPTIONS["speed"], one.sizes, "--speed", 3)
    mu = values([headings], OPTIONS["heading"], one.sizes, "--headings", 37)
    waves = _waves(one, wave_lengths, steepness, wave_height)
    chosen: Form = form  # type: ignore[assignment]  # polar refuses an unknown one
    count = len(speeds) * len(mu) * len(waves)
    if count > MOST_CONDITIONS:
        raise InputError(
            f"{len(speeds)} speeds, {len(mu)} headings and {len(waves)} wave lengths make {count} conditions; a map takes up "
            f"to {MOST_CONDITIONS}; make several maps, or call quartering.sweep from Python"
        )
    announce_compilation()
    with bar("conditions", count) as progress:
        ds = polar_map_of(one, waves, speeds, mu, harmonics=harmonics, form=chosen, extend=extend, progress=progress)
    ds.attrs["ship_argument"] = ship
    if not np.isfinite(ds["roll_peak"]).any():
        raise InputError("no condition of this map has an answer; choose other speeds, headings or wave lengths")
    summary = [_summary(one, ds.isel(speed=i)) for i in range(ds.sizes["speed"])]

    def lines() -> Iterator[Table | str]:
        yield from _lines(one, ds, summary)
        yield from edge_words(ds, _FURTHER, "" if extend else ", or --extend")
        yield from notes(ds)

    step = f"quartering verdict {ship} {_worst_words(ds, summary)}{option_words(changes)}"
    return Answer(
        lines(),
        lambda: _facts(ds, summary) | {"dataset": str(data), "picture": str(picture)},
        [File(data, lambda part: ds.to_netcdf(part)), *picture_files(picture, lambda: _picture(ds))],
        written=f"Wrote {data} and {picture}",
        next_steps=[step, f"quartering report {data}"],
    )


def _waves(one: Ship, lengths: str, steepness: str | None, height: str | None) -> list[Wave]:
    """The waves of the map, of one steepness or of one height."""
    from quartering.loads.waves import Wave

    found = values([lengths], OPTIONS["wave_length"], one.sizes, "--wave-lengths", 20)
    if steepness is not None and height is not None:
        raise InputError("--steepness and --wave-height are two ways to say one thing; leave one out")
    if height is not None:
        high = value(height, OPTIONS["wave_height"], one.sizes, "--wave-height")
        return [Wave(length, high) for length in found]
    slope = value(steepness or _STEEPNESS, OPTIONS["steepness"], one.sizes, "--steepness")
    return [Wave(length, slope * length) for length in found]


def _picture(ds: xr.Dataset) -> Figure:
    """A polar map, or lines over heading where there are few wave lengths."""
    from quartering.view.plots.polar_map import polar_map
    from quartering.view.plots.response import response_picture

    return (polar_map if ds.sizes["wave_length"] >= _RINGS else response_picture)(ds)


def _worst_words(ds: xr.Dataset, summary: Sequence[Summary]) -> str:
    """Options of the condition with the largest roll."""
    import numpy as np

    worst = max((s for s in summary if np.isfinite(s.worst_roll)), key=lambda s: s.worst_roll)
    height = float(ds["wave_height"].sel(wave_length=worst.wave_length))
    condition = f"--heading {worst.heading:g} --speed {worst.speed:.4g} --wave-length {worst.wave_length:.4g}"
    return f"{condition} --wave-height {height:.3g}"


class Summary(NamedTuple):
    """What stands out at one speed: where roll is largest over a cycle, and where the motion is least stable but for the course
    in calm water; NaN without any answer."""

    speed: float
    worst_roll: float
    heading: float
    wave_length: float
    least_stable: float
    least_stable_heading: float
    least_stable_wave_length: float
    verdicts: dict[str, int]
    no_answer: dict[str, int]
    calm_water: np.ndarray
    capsize_on_the_way: int
    more_harmonics: int
    several_stable: int


def _summary(one: Ship, ds: xr.Dataset) -> Summary:
    import numpy as np

    from quartering.hydro.calm_water import calm_water_exponents
    from quartering.motion.status import Status
    from quartering.stability.kind import Kind
    from quartering.study.maps.query import capsizing, coexisting, needing_more

    kinds, counts = np.unique(ds["verdict"].values, return_counts=True)
    statuses, failures = np.unique(ds["status"].values, return_counts=True)
    return Summary(
        float(ds["speed"]),
        *_largest(ds["roll_peak"]),
        *_largest(ds["exponent"].where(ds["verdict"] != int(Kind.COURSE_IN_CALM_WATER))),
        {Kind(int(k)).label: int(n) for k, n in zip(kinds, counts, strict=True)},
        {Status(int(s)).name.lower(): int(n) for s, n in zip(statuses, failures, strict=True) if not Status(int(s)).ok},
        calm_water_exponents(one, float(ds["speed"])),
        int(capsizing(ds).sum()),
        int(needing_more(ds).sum()),
        int(coexisting(ds).sum()),
    )


def _facts(ds: xr.Dataset, summary: Sequence[Summary]) -> dict[str, object]:
    from quartering.study.maps.extension import edges_of_largest
    from quartering.view.wording import estimated_names

    about = ("ship", "loading", "natural_roll_frequency", "steady_motion", "diffraction")
    return {key: ds.attrs[key] for key in about} | {
        "estimated": estimated_names(ds),
        "sizes": {str(name): size for name, size in ds.sizes.items() if name in ("speed", "heading", "wave_length")},
        "wave_length": ds["wave_length"].values,
        "wave_height": ds["wave_height"].values,
        "speeds": [s._asdict() for s in summary],
        "largest_on_edge": [edge._asdict() for edge in edges_of_largest(ds)],
    }


def _largest(field: xr.DataArray) -> tuple[float, float, float]:
    """Largest value of a map at one speed, and the heading and wave length it stands at; NaN where there is no answer."""
    import numpy as np

    if not np.isfinite(field).any():
        return math.nan, math.nan, math.nan
    i, j = np.unravel_index(int(np.nanargmax(field.values)), field.shape)
    cell = field[i, j]
    return float(cell), float(cell["heading"]), float(cell["wave_length"])


def _place(value: str, heading: float, ratio: float) -> str:
    """A largest value and where it is, in words."""
    return f"{value} at {heading:g} deg, lambda/L {ratio:.3g}" if math.isfinite(heading) else "no answer"


def _lines(one: Ship, ds: xr.Dataset, summary: Sequence[Summary]) -> Iterator[Table | str]:
    """What stands out at each speed, and what has no answer, is not reached, or wants more harmonics."""
    import numpy as np

    from quartering.hydro.capsize import capsize_limit
    from quartering.motion.status import Status
    from quartering.motion.steady.motion import capsize_advice
    from quartering.study.condition.beside import also_words
    from quartering.study.maps.query import other_rolls
    from quartering.view.wording import (
        CALM_WORDS,
        WAY_WORDS,
        exponents_words,
        harmonics_of,
        more_harmonics_words,
        speed_words,
        wave_words,
    )

    length = one.hull.length
    rows = [
        (
            speed_words(s.speed, length),
            _place(f"{s.worst_roll:.3g} deg", s.heading, s.wave_length / length),
            _place(f"{s.least_stable:+.3g} 1/s", s.least_stable_heading, s.least_stable_wave_length / length),
            ", ".join(f"{n} {kind}" for kind, n in s.verdicts.items()),
            exponents_words(s.calm_water),
        )
        for s in summary
    ]
    columns = ("speed", "largest roll over a cycle", "least stable", "cells", "calm-water exponents [1/s]")
    size = f"{ds.sizes['heading']} headings, {ds.sizes['wave_length']} wave lengths"
    yield table(f"{ds.attrs['ship']} in regular waves, {wave_words(ds)}: {size}", columns, rows)
    yield f"Calm-water exponents: {CALM_WORDS}."
    failed: dict[str, int] = {}
    for s in summary:
        for status, n in s.no_answer.items():
            failed[status] = failed.get(status, 0) + n
    for status, n in failed.items():
        advice = Status[status.upper()].advice
        if Status[status.upper()] is Status.BEYOND_CAPSIZE_LIMIT:
            advice = capsize_advice(capsize_limit(one))
        yield f"{n} cells without an answer: {advice}."
    if lost := sum(s.capsize_on_the_way for s in summary):
        yield f"{lost} cells with a stable motion that is not reached: {WAY_WORDS}."
    if short := sum(s.more_harmonics for s in summary):
        yield more_harmonics_words(short, ds["verdict"].size, harmonics_of(ds))
    if several := sum(s.several_stable for s in summary):
        known = np.sort(other_rolls(ds).values.ravel())
        ends = known[np.isfinite(known)][[0, -1]]
        yield f"{several} cells with other stable motions in the same wave: {also_words(dict.fromkeys(ends.tolist()))}."
    yield from _course_words(ds, summary, length)


def _course_words(ds: xr.Dataset, summary: Sequence[Summary], length: float) -> list[str]:
    """Course instability of calm water, in a sentence of its own."""
    from quartering.stability.kind import Kind
    from quartering.view.wording import CALM_COURSE, speed_words

    unsteady = [speed_words(s.speed, length) for s in summary if s.calm_water.real.max() > _NEUTRAL]
    if not unsteady:
        return []
    cells = int((ds["verdict"] == int(Kind.COURSE_IN_CALM_WATER)).sum())
    marked = f"; in {cells} cells nothing else grows, and they are marked so" if cells else ""
    return [f"Course-unstable in calm water, rudder amidships: at {'; '.join(unsteady)}{marked}. {CALM_COURSE}"]

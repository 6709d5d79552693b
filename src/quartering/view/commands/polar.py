"""`quartering polar`: the map of roll and stability."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.capsize import capsize_limit
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.status import Status
from quartering.motion.steady.motion import capsize_advice
from quartering.options import OPTIONS
from quartering.stability.ahead import announce_compilation
from quartering.stability.kind import Kind
from quartering.study.maps.extension import edges_of_largest
from quartering.study.maps.polar import polar
from quartering.study.maps.query import capsizing, coexisting, needing_more, other_rolls
from quartering.view.commands.conditions import sizes, typed_ship
from quartering.view.options import value, values
from quartering.view.output import claim, stem, write
from quartering.view.progress import bar
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import (
    CALM_COURSE,
    CALM_WORDS,
    WAY_WORDS,
    also_words,
    edge_words,
    estimated_names,
    exponents_words,
    harmonics_of,
    more_harmonics_words,
    notes,
    speed_words,
    wave_words,
)

MOST_CONDITIONS = 1_000_000
"""Largest map: about 1 GB of results."""

_NEUTRAL = 1e-9
_STEEPNESS = "1/50"
_FURTHER = "--{} .."
_RINGS = 3
"""With fewer wave lengths than this the picture is lines over heading."""


def draw_map(
    name: str,
    speeds: Sequence[str],
    headings: str,
    waves: tuple[str, str | None, str | None],
    harmonics: int,
    form: str,
    changes: Mapping[str, str],
    output: str | None,
    as_json: bool,
    extend: bool = False,
) -> None:
    """Compute the map, write dataset and picture, print what stands out."""
    one = typed_ship(name, changes)
    units = sizes(one)
    data = claim(f"{stem(name)}-polar.nc" if output is None else output, (".nc",))
    picture = claim(data.with_suffix(".png"), (".png",))
    speed = values(speeds, OPTIONS["speed"], units, "--speed", 3)
    mu = values([headings], OPTIONS["heading"], units, "--headings", 37)
    sea = _waves(one, waves)
    chosen: Form = form  # type: ignore[assignment]  # polar refuses an unknown one
    count = len(speed) * len(mu) * len(sea)
    if count > MOST_CONDITIONS:
        raise InputError(
            f"{len(speed)} speeds, {len(mu)} headings and {len(sea)} wave lengths make {count} conditions; a map takes up "
            f"to {MOST_CONDITIONS}; make several maps, or call quartering.sweep from Python"
        )
    announce_compilation()
    with bar("conditions", count) as report:
        ds = polar(one, sea, speed, mu, harmonics=harmonics, form=chosen, extend=extend, progress=report)
    ds.attrs["ship_argument"] = name
    if not np.isfinite(ds["roll_peak"]).any():
        raise InputError("no condition of this map has an answer; choose other speeds, headings or wave lengths")
    _write(ds, data, picture)
    summary = [_summary(one, ds.isel(speed=i)) for i in range(ds.sizes["speed"])]
    if as_json:
        show_json(_facts(ds, summary) | {"dataset": str(data), "picture": str(picture)})
        return
    _print(one, ds, summary)
    show(*edge_words(ds, _FURTHER, "" if extend else ", or --extend"))
    show(*notes(ds))
    show(f"Wrote {data} and {picture}")
    worst = max((s for s in summary if np.isfinite(s.worst_roll)), key=lambda s: s.worst_roll)
    height = float(ds["wave_height"].sel(wave_length=worst.wave_length))
    condition = f"--heading {worst.heading:g} --speed {worst.speed:.4g} --wave-length {worst.wave_length:.4g}"
    again = option_words(changes)
    step = f"quartering verdict {name} {condition} --wave-height {height:.3g}{again}"
    show(next_steps(step, f"quartering report {data}"))


def _waves(one: Ship, typed: tuple[str, str | None, str | None]) -> list[Wave]:
    lengths = values([typed[0]], OPTIONS["wave_length"], sizes(one), "--wave-lengths", 20)
    if typed[1] is not None and typed[2] is not None:
        raise InputError("--steepness and --wave-height are two ways to say one thing; leave one out")
    if typed[2] is not None:
        height = value(typed[2], OPTIONS["wave_height"], sizes(one), "--wave-height")
        return [Wave(length, height) for length in lengths]
    slope = value(typed[1] or _STEEPNESS, OPTIONS["steepness"], sizes(one), "--steepness")
    return [Wave(length, slope * length) for length in lengths]


def _write(ds: xr.Dataset, data: Path, picture: Path) -> None:
    from quartering.view.plots import style
    from quartering.view.plots.polar_map import polar_map
    from quartering.view.plots.response import response_picture

    draw = polar_map if ds.sizes["wave_length"] >= _RINGS else response_picture
    write((data, lambda part: ds.to_netcdf(part)), (picture, lambda part: style.save(draw(ds), part)))


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
    if not np.isfinite(field).any():
        return math.nan, math.nan, math.nan
    i, j = np.unravel_index(int(np.nanargmax(field.values)), field.shape)
    cell = field[i, j]
    return float(cell), float(cell["heading"]), float(cell["wave_length"])


def _place(value: str, heading: float, ratio: float) -> str:
    """A largest value and where it is, in words."""
    return f"{value} at {heading:g} deg, lambda/L {ratio:.3g}" if math.isfinite(heading) else "no answer"


def _print(one: Ship, ds: xr.Dataset, summary: Sequence[Summary]) -> None:
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
    show(table(f"{ds.attrs['ship']} in regular waves, {wave_words(ds)}: {size}", columns, rows))
    show(f"Calm-water exponents: {CALM_WORDS}.")
    failed: dict[str, int] = {}
    for s in summary:
        for status, n in s.no_answer.items():
            failed[status] = failed.get(status, 0) + n
    for status, n in failed.items():
        advice = Status[status.upper()].advice
        if Status[status.upper()] is Status.BEYOND_CAPSIZE_LIMIT:
            advice = capsize_advice(capsize_limit(one))
        show(f"{n} cells without an answer: {advice}.")
    if lost := sum(s.capsize_on_the_way for s in summary):
        show(f"{lost} cells with a stable motion that is not reached: {WAY_WORDS}.")
    if short := sum(s.more_harmonics for s in summary):
        show(more_harmonics_words(short, ds["verdict"].size, harmonics_of(ds)))
    if several := sum(s.several_stable for s in summary):
        known = np.sort(other_rolls(ds).values.ravel())
        ends = known[np.isfinite(known)][[0, -1]]
        show(f"{several} cells with other stable motions in the same wave: {also_words(dict.fromkeys(ends.tolist()))}.")
    show(*_course_words(ds, summary, length))


def _course_words(ds: xr.Dataset, summary: Sequence[Summary], length: float) -> list[str]:
    """Course instability of calm water, in a sentence of its own."""
    unsteady = [speed_words(s.speed, length) for s in summary if s.calm_water.real.max() > _NEUTRAL]
    if not unsteady:
        return []
    cells = int((ds["verdict"] == int(Kind.COURSE_IN_CALM_WATER)).sum())
    marked = f"; in {cells} cells nothing else grows, and they are marked so" if cells else ""
    return [f"Course-unstable in calm water, rudder amidships: at {'; '.join(unsteady)}{marked}. {CALM_COURSE}"]

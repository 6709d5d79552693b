"""`quartering polar`: the map of roll and stability."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.options import OPTIONS, line_of
from quartering.view.command._map_axes import (
    ALL_HEADINGS,
    ALL_LENGTHS,
    Headings,
    OneHeight,
    Speeds,
    Steepness,
    WaveLengths,
    mapped,
    typed_axes,
)
from quartering.view.command._sea_polar import Typed, sea_polar_answer
from quartering.view.command._side_by_side import side_by_side
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, Harmonics, Modes, ShipName
from quartering.view.console.files import TABLES, File, is_table, picture_files, reserve_path, ship_stem
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.sea_options import Gamma, SpectrumName, SpreadingWords, SwellWords, told
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import map_table
from quartering.view.console.typed_ship import typed_ship
from quartering.view.map_summary import Summary, place_words, summary_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.motion.modes import Modes as ModesOf
    from quartering.view.console.printed import Table

_NEUTRAL = 1e-9
_FURTHER = "--{} .."
_RINGS = 3
"""With fewer wave lengths than this the picture is lines over heading."""


def polar(
    ship: ShipName,
    changes: Changes,
    beside: Annotated[
        str | None,
        typer.Argument(help="Another ship, or a loading case of this one: the difference of the two maps."),
    ] = None,
    speed: Speeds = None,
    headings: Headings = ALL_HEADINGS,
    wave_lengths: WaveLengths = ALL_LENGTHS,
    steepness: Steepness = None,
    wave_height: OneHeight = None,
    harmonics: Harmonics = 1,
    form: FormName = "stf",
    output: Annotated[
        str | None,
        typer.Option("-o", "--output", help="Dataset to write (.nc), a .png goes beside it; or tables (.csv, .xlsx)."),
    ] = None,
    modes: Modes = "three",
    extend: Annotated[bool, typer.Option("--extend", help=f"{line_of(OPTIONS['extend']).partition(':')[0]}.")] = False,
    hs: Annotated[str | None, told("hs", "s: 4:8; makes a map over irregular seas, radius speed")] = None,
    tp: Annotated[str | None, told("tp", "s: 8:14")] = None,
    tz: Annotated[str | None, told("tz", "s, in place of --tp")] = None,
    spectrum: SpectrumName = "jonswap",
    gamma: Gamma = "3.3",
    spreading: SpreadingWords = "none",
    swell: SwellWords = None,
    judge: Annotated[
        str, typer.Option(help="What is judged in seas: largest (motion of 3 h) or rate (of failures).")
    ] = "largest",
    threshold: Annotated[
        str | None, typer.Option(help="Factor on the largest motion, 2, or rate of failures [1/s], 1e-6.")
    ] = None,
    hours: Annotated[str, typer.Option(help="Hours to simulate at most where the closure does not decide.")] = "0",
) -> Answer:
    """Map of roll and stability; of two ships or loadings, the difference; of irregular seas by --hs and --tp, over speed."""
    from quartering.stability.precompile import announce_compilation

    if hs is not None:
        _refuse_waves(wave_lengths, steepness, wave_height, harmonics, extend, beside, modes)
        seas = Typed(hs, tp, tz, spectrum, gamma, spreading, swell, judge, threshold, hours)
        return sea_polar_answer(ship, changes, speed, headings, seas, form, output)
    if tp is not None or tz is not None:
        raise InputError("--tp and --tz are of irregular seas; give --hs too, such as --hs 4:8")
    one = typed_ship(ship, changes)
    usual = f"{ship_stem(ship)}-polar.nc" if beside is None else f"{ship_stem(ship)}-and-{ship_stem(beside)}.nc"
    path = reserve_path(usual if output is None else output, (".nc", *TABLES))
    picture = None if is_table(path) else reserve_path(path.with_suffix(".png"), (".png",))
    axes = typed_axes(one, speed, headings, wave_lengths, steepness, wave_height)
    chosen: Form = form  # type: ignore[assignment]  # polar refuses an unknown one
    asked: ModesOf = modes  # type: ignore[assignment]  # and unknown modes
    announce_compilation()
    if beside is not None:
        if extend or modes == "six":
            raise InputError(
                "--extend and --modes six are of one map; of two maps give the axes, such as --wave-lengths 0.4L:3L:27"
            )
        return side_by_side(one, ship, beside, changes, axes, harmonics, chosen, (path, picture))
    with bar("conditions", axes.conditions) as progress:
        ds = mapped(one, axes, harmonics, chosen, modes=asked, extend=extend, progress=progress)
    ds.attrs["ship_argument"] = ship
    more = " --modes six" if modes == "six" else ""
    return _answer(one, ds, (path, picture), f"{option_words(changes)}{more}", extended=extend)


def _answer(one: Ship, ds: xr.Dataset, files: tuple[Path, Path | None], typed: str, *, extended: bool) -> Answer:
    """The map of one ship as the command gives it.

    typed: the options of the ship and of its modes, to be typed again
    """
    from quartering.view.wording import edge_words, notes

    path, picture = files
    ship = ds.attrs["ship_argument"]
    summary = [summary_of(one, ds.isel(speed=i)) for i in range(ds.sizes["speed"])]

    def lines() -> Iterator[Table | str]:
        yield from _lines(one, ds, summary)
        yield from edge_words(ds, _FURTHER, "" if extended else ", or --extend")
        yield from notes(ds)

    written: list[File] = []
    if picture is not None:
        written = [File(path, lambda part: ds.to_netcdf(part)), *picture_files(picture, lambda: _picture(ds))]
    reported = [] if picture is None or "--modes" in typed else [f"quartering report {path}"]
    return Answer(
        lines(),
        lambda: _facts(ds, summary) | _written(path, picture),
        written,
        written=f"Wrote {path}" + ("" if picture is None else f" and {picture}"),
        next_steps=[f"quartering verdict {ship} {_worst_words(ds, summary)}{typed}", *reported],
        output=path,
        data=lambda: [map_table(ds)],
    )


def _written(path: Path, picture: Path | None) -> dict[str, str | None]:
    """The files, for programs."""
    if picture is None:
        return {"dataset": None, "picture": None, "table": str(path)}
    return {"dataset": str(path), "picture": str(picture)}


def _refuse_waves(
    lengths: str,
    steepness: str | None,
    height: str | None,
    harmonics: int,
    extend: bool,
    beside: str | None,
    modes: str,
) -> None:
    """Refuse what is of regular waves, beside a sea."""
    given = {
        "--wave-lengths": lengths != ALL_LENGTHS,
        "--steepness": steepness is not None,
        "--wave-height": height is not None,
        "--harmonics": harmonics != 1,
        "--extend": extend,
        "a second ship": beside is not None,
        "--modes six": modes == "six",
    }
    for name, there in given.items():
        if there:
            raise InputError(f"{name} is of regular waves and --hs of irregular seas; leave out the one or the other")


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
            place_words(f"{s.worst_roll:.3g} deg", s.heading, s.wave_length / length),
            place_words(f"{s.least_stable:+.3g} 1/s", s.least_stable_heading, s.least_stable_wave_length / length),
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

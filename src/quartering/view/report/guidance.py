"""Polar diagrams for every wave, in the form of operational guidance: where a failure event is foreseen, and where not."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from markupsafe import Markup

from quartering.conventions import InputError
from quartering.hydro.capsize import vanishing_of_equations
from quartering.stability.kind import Kind
from quartering.study.condition.failure_events import ROLL_LIMIT, failure_angle, failure_events
from quartering.study.maps.query import other_rolls, sea_of
from quartering.view.plots.guidance import Diagram, guidance_picture
from quartering.view.report.pictures import inline_svg
from quartering.view.report.source import Source
from quartering.view.report.tables import Row, Table
from quartering.view.wording import sea_words

_LENGTHS_OF_A_SHEET, _MOST_HEIGHTS = 6, 10
"""Diagrams of a page, and wave heights that are drawn: a sweep may have a hundred."""


class Guidance(NamedTuple):
    """What a page of guidance shows.

    Parameters
    ----------
    limit : float               roll angle of the failure event [deg]
    limits : list of str        the angles it is the least of, in words
    sheets : list               of (title, picture), a sheet for each wave height
    summary : Table             for each wave: share of speeds and headings with a failure event
    left_out : str              waves of the result that have no diagram, in words; empty when all have one
    """

    limit: float
    limits: list[str]
    sheets: list[tuple[str, Markup]]
    summary: Table
    left_out: str


def guidance(source: Source, openings: float | None) -> Guidance:
    """Diagrams and summary of a result.

    openings: heel at which unprotected openings go under in calm water [deg]; None: that of the ship, if any
    """
    result = source.result
    if openings is not None and not 0 < openings <= 90:
        raise InputError(f"--openings {openings:g}: give the heel at which openings go under, above 0 up to 90 deg")
    if "loading" in result.dims:
        raise InputError("guidance is for one loading; this result holds several, make one for each")
    if result["speed"].size < 2:
        raise InputError("a polar diagram of speed and heading needs two speeds or more; this result holds one")
    if float(result["heading"].min()) < 0 or float(result["heading"].max()) > 180:
        raise InputError(
            "the diagrams mirror headings of 0 to 180 deg; this result holds others, make it again with those"
        )
    openings = source.ship.value("openings") if openings is None else openings
    vanishing = vanishing_of_equations(source.ship)
    limit = failure_angle(vanishing, openings)
    failure = failure_events(result, limit)
    sheets, rows = [], []
    heights = _waves(result)
    shown = _spread(len(heights), _MOST_HEIGHTS)
    for i, (title, waves) in enumerate(heights):
        diagrams = [_diagram(cut, failure, words) for words, cut in waves]
        rows += [_summary(title, d, words) for d, (words, _) in zip(diagrams, waves, strict=True)]
        if i in shown:
            sheets += _sheets(title, diagrams, limit)
    drawn = sum(len(heights[i][1]) for i in shown)
    left_out = f"{len(rows) - drawn} of {len(rows)} waves have no diagram" if drawn < len(rows) else ""
    return Guidance(limit, _limits(vanishing, openings), sheets, _summary_table(rows), left_out)


def _sheets(title: str, diagrams: list[Diagram], limit: float) -> list[tuple[str, Markup]]:
    """Every diagram of one wave height, a page of them at a time."""
    made = []
    pages = range(0, len(diagrams), _LENGTHS_OF_A_SHEET)
    for number, first in enumerate(pages, 1):
        words = title if len(pages) == 1 else f"{title}, sheet {number} of {len(pages)}"
        chosen = diagrams[first : first + _LENGTHS_OF_A_SHEET]
        made.append((words, inline_svg(guidance_picture(chosen, limit), f"Polar diagrams, {words}")))
    return made


def _limits(vanishing: float, openings: float | None) -> list[str]:
    gone = f"{vanishing:.3g} deg" if np.isfinite(vanishing) else "none up to 90 deg"
    return [
        f"{ROLL_LIMIT:g} deg",
        f"angle of vanishing stability in calm water: {gone}",
        "angle at which unprotected openings go under in calm water: "
        + (f"{openings:g} deg" if openings is not None else "not given, not considered"),
    ]


def _waves(result: xr.Dataset) -> list[tuple[str, list[tuple[str, xr.Dataset]]]]:
    """Wave heights or steepnesses, and for each its wave lengths with their part of the result."""

    def lengths(cut: xr.Dataset, height: bool) -> list[tuple[str, xr.Dataset]]:
        made = []
        for i in range(cut.sizes["wave_length"]):
            one = cut.isel(wave_length=i)
            words = f"wave length {float(one['wave_length']):.4g} m"
            made.append((words + (f", height {float(one['wave_height']):.3g} m" if height else ""), one))
        return made

    sea = sea_of(result)
    if sea:
        parts = [result.isel({sea: i}) for i in range(result.sizes[sea])]
        return [(sea_words(sea, float(part[sea])), lengths(part, sea != "wave_height")) for part in parts]
    height, length = result["wave_height"].values, result["wave_length"].values
    if np.ptp(height) == 0:
        return [(f"wave height {height[0]:.3g} m", lengths(result, False))]
    steepness = height / length
    words = "one steepness of the waves" if np.ptp(steepness) < 1e-9 else "each wave length with its height"
    return [(f"{words}, H/λ {steepness.min():.3g}" if np.ptp(steepness) < 1e-9 else words, lengths(result, True))]


def _spread(count: int, most: int) -> list[int]:
    """Indices of up to `most` of `count` things, evenly, the ends among them.

    >>> _spread(20, 6), _spread(3, 6)
    ([0, 4, 8, 11, 15, 19], [0, 1, 2])
    """
    return sorted({round(i) for i in np.linspace(0, count - 1, min(count, most))})


def _diagram(cut: xr.Dataset, failure: xr.DataArray, title: str) -> Diagram:
    where = {name: cut[name] for name in ("wave_length", "wave_height", "steepness") if name in failure.dims}
    order = ("speed", "heading")
    return Diagram(
        title,
        cut["speed"].values,
        cut["heading"].values,
        cut["roll_peak"].transpose(*order).values,
        cut["verdict"].transpose(*order).values,
        failure.sel(where).transpose(*order).values,
        other_rolls(cut).max("other_motion").transpose(*order).values,
    )


def _summary(height: str, d: Diagram, words: str) -> tuple[str, str, float, float, float, float]:
    answered = d.verdict != Kind.NO_ANSWER
    return (
        height,
        words,
        float(np.nanmax(d.roll)) if np.isfinite(d.roll).any() else float("nan"),
        float(d.failure.mean()),
        float(((d.verdict > Kind.STABLE) & (d.verdict != Kind.COURSE_IN_CALM_WATER)).mean()),
        float((~answered & ~d.failure).mean()),
    )


def _summary_table(rows: list[tuple[str, str, float, float, float, float]]) -> Table:
    """Shares of each wave; the heights have a column where there are several."""
    several = len({height for height, *_ in rows}) > 1
    columns = ("wave", "", "largest roll [deg]", "failure event", "unstable motion", "no answer")
    texts = [
        (height, words, f"{roll:.1f}", *(f"{100 * share:.1f} %" for share in shares))
        for height, words, roll, *shares in rows
    ]
    if several:
        return Table(columns, [Row(cells) for cells in texts], (2, 3, 4, 5))
    return Table((columns[0], *columns[2:]), [Row(cells[1:]) for cells in texts], (1, 2, 3, 4))

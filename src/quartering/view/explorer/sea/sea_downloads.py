"""Files of an irregular sea to take home: the case that gives the map again, the map as picture and dataset, the report."""

from __future__ import annotations

import importlib
import json
from collections.abc import Callable

import xarray as xr

from quartering.view.explorer.computing.computations import HEADINGS
from quartering.view.explorer.computing.job_queue import Take
from quartering.view.explorer.downloads import dataset_bytes, figure_bytes, loading_lines, stem, with_its_lines
from quartering.view.explorer.sea.sea_scene import SeaScene, map_pieces
from quartering.view.explorer.state import State

_REPORT = "quartering.view.report.seas"

File = Callable[[State, SeaScene, xr.Dataset | None], tuple[str, bytes]]
"""Makes a file of a state, its scene and its map: name and content."""


def files() -> dict[str, File]:
    """What can be taken home, by the words of the menu, which are those of a regular wave."""

    def of_map(ending: str, content: Callable[[xr.Dataset], bytes]) -> File:
        def made(_: State, of: SeaScene, whole: xr.Dataset | None) -> tuple[str, bytes]:
            assert whole is not None
            return f"{stem(of.known)}-guidance.{ending}", content(whole.assign_attrs(ship_argument=of.known.key))

        return made

    return {
        "Case file that gives this view": case_file,
        "Map, PNG": of_map("png", lambda whole: picture(whole, "png")),
        "Map, SVG": of_map("svg", lambda whole: picture(whole, "svg")),
        "Map, netCDF": of_map("nc", dataset_bytes),
        "Report, HTML": of_map("html", report),
    }


async def made(make: File, state: State, of: SeaScene, whole: xr.Dataset | None, take: Take) -> tuple[str, bytes]:
    """A file, the map it needs computed piece by piece where it is not at hand.

    whole: the map, if it is there already
    """
    pieces = iter(()) if make is case_file or whole is not None else map_pieces(state, of)
    while True:
        step, _notes = await take(lambda: next(pieces, None))
        if step is None:
            break
        whole = step[1]
    content, _notes = await take(lambda: make(state, of, whole))
    return content


def picture(whole: xr.Dataset, ending: str) -> bytes:
    """The map as a picture, "png" or "svg"."""
    from quartering.view.plots.sea_polar import sea_polar

    return figure_bytes(sea_polar(whole), ending)


def report(whole: xr.Dataset) -> bytes:
    """The report on the map, in the form of guidance, one HTML file."""
    page: str = importlib.import_module(_REPORT).seas_page(whole, "computed for this report")
    return page.encode()


def case_file(state: State, of: SeaScene, _: xr.Dataset | None = None) -> tuple[str, bytes]:
    """Name and content of the case that gives the map again; a zip with the lines for a hull that was uploaded."""
    return with_its_lines(of.known, "sea", lambda ship: case_text(state, of, ship))


def case_text(state: State, of: SeaScene, ship: str) -> str:
    """Case file with the map, and the chosen condition among its speeds and headings."""
    lines = [
        "# From the explorer: the map of an irregular sea, and the chosen condition.",
        "# Run it:  quartering sweep <this file> -o result    then    quartering show result -o guidance.png",
        f"# Chosen: heading {of.heading!r} deg, speed {of.speed!r} m/s.",
        f"ship: {json.dumps(ship)}",
        f"speed: {json.dumps(sorted({*of.speeds, of.speed}))}    # m/s",
        f"heading: {json.dumps(sorted({*HEADINGS.tolist(), of.heading}))}    # deg",
        "sea:",
        *(f"  {name}: {value!r}    # {'m' if name == 'hs' else 's'}" for name, value in of.told.items()),
        f"  spectrum: {state.spectrum}",
        f"  spreading: {json.dumps(state.spreading)}",
        *loading_lines(state),
    ]
    return "\n".join(lines) + "\n"

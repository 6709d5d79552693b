"""Files to take home: the map as picture and dataset, the case file that gives it again, and the report."""

from __future__ import annotations

import importlib
import importlib.util
import io
import json
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import xarray as xr

from quartering.view.explorer.computing.computations import HEADINGS, Scene, joined, map_blocks
from quartering.view.explorer.hulls.ship_registry import Known
from quartering.view.explorer.state import LOADING, State

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_REPORT = "quartering.view.report"


File = Callable[[State, Scene], tuple[str, bytes]]
"""Makes a file of a state and its scene: name and content."""


def files() -> dict[str, File]:
    """What can be taken home, by the words of the menu."""

    def of_map(ending: str, made: Callable[[Scene], bytes]) -> File:
        return lambda _, of: (f"{stem(of.known)}-polar.{ending}", made(of))

    made = {
        "Case file that gives this view": case_file,
        "Map, PNG": of_map("png", lambda of: picture(of, "png")),
        "Map, SVG": of_map("svg", lambda of: picture(of, "svg")),
        "Map, netCDF": of_map("nc", netcdf),
    }
    return made | ({"Report, HTML": of_map("html", report)} if has_report() else {})


def map_dataset(of: Scene) -> xr.Dataset:
    """The whole map of a page."""
    return joined([block() for block in map_blocks(of)])


def picture(of: Scene, ending: str) -> bytes:
    """The map as a picture, "png" or "svg"."""
    from quartering.view.plots.polar_map import polar_map

    return figure_bytes(polar_map(map_dataset(of)), ending)


def netcdf(of: Scene) -> bytes:
    """The map as netCDF."""
    return dataset_bytes(map_dataset(of))


def figure_bytes(figure: Figure, ending: str) -> bytes:
    """A figure as a file, "png" or "svg"."""
    from quartering.view.plots import style

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"map.{ending}"
        style.save(figure, path)
        return path.read_bytes()


def dataset_bytes(whole: xr.Dataset) -> bytes:
    """A dataset as netCDF."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "map.nc"
        whole.to_netcdf(path)
        return path.read_bytes()


def case_file(state: State, of: Scene) -> tuple[str, bytes]:
    """Name and content of the case that gives the view again; a zip with the lines for a hull that was uploaded."""
    return with_its_lines(of.known, "case", lambda ship: case_text(state, of, ship))


def with_its_lines(known: Known, kind: str, text: Callable[[str], str]) -> tuple[str, bytes]:
    """Name and content of a case: its text, of the name of its ship, or a zip of it with the lines of an uploaded hull."""
    if not known.files:
        return f"{stem(known)}-{kind}.yaml", text(known.key).encode()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as bundle:
        for name, data in {"case.yaml": text("ship.yaml").encode(), **known.files}.items():
            bundle.writestr(name, data)
    return f"{stem(known)}-{kind}.zip", packed.getvalue()


def case_text(state: State, of: Scene, ship: str) -> str:
    """Case file with the map and the chosen condition."""
    heading = sorted({*HEADINGS.tolist(), of.heading})
    lengths = sorted({*(wave.length for wave in of.waves), of.wave.length})
    sea = f"steepness: {state.steepness!r}" if state.wave_height is None else f"wave_height: {state.wave_height!r}"
    lines = [
        "# From the explorer: the map, and the chosen condition.",
        "# Run it:  quartering sweep <this file> -o result    then    quartering worst result",
        f"# Chosen: heading {of.heading!r} deg, wave length {of.wave.length!r} m.",
        f"ship: {json.dumps(ship)}",
        f"speed: {of.speed!r}                # m/s",
        f"heading: {json.dumps(heading)}     # deg",
        f"wave_length: {json.dumps(lengths)} # m",
        sea + ("    # height over length" if state.wave_height is None else "    # m"),
        *loading_lines(state),
        f"harmonics: {of.harmonics}",
    ]
    return "\n".join(lines) + "\n"


def loading_lines(state: State) -> list[str]:
    """The dials of the loading that are turned, as a case file has them."""
    own = {name: getattr(state, name) for name in LOADING if getattr(state, name) is not None}
    lines = [f'  {name}: "{value!r}{"" if name == "roll_damping" else " m"}"' for name, value in own.items()]
    return ["loading:", *lines] if lines else []


def has_report() -> bool:
    """Can a report be written?"""
    return importlib.util.find_spec(_REPORT) is not None


def report(of: Scene) -> bytes:
    """The report on the map of a page, one HTML file."""
    page: str = importlib.import_module(_REPORT).report_html(of.ship, map_dataset(of))
    return page.encode()


def stem(known: Known) -> str:
    """Short name of a ship, to name files with."""
    return Path(known.label).stem or "ship"

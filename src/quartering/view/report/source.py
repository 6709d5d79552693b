"""What a report is about: a stored result and its ship, or a ship whose map is computed for the purpose."""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import NamedTuple, cast

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering._machine.digest import fingerprint
from quartering.conventions import InputError
from quartering.hull.file.built_in import available_ships
from quartering.hull.file.read import ship
from quartering.hull.option_types import Velocities
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.study.dataset import heading_of
from quartering.study.loadings import base_of
from quartering.study.maps.polar import polar
from quartering.study.maps.stored.store import read_store
from quartering.study.maps.sweep import sweep
from quartering.units import quantity
from quartering.view.console.progress import bar
from quartering.view.stored import opened

_SAME = (
    "ship", "ship_length", "ship_beam", "ship_draught", "loading", "autopilot", "righting_curve", "provenance",
    "coefficient_sources",
)  # fmt: skip
"""Attributes of a result that must be those of the ship it is reported with."""

_FROUDE_NUMBERS = {"report": (0.15, 0.2, 0.25), "guidance": (0.04, 0.07, 0.1, 0.13, 0.16, 0.19, 0.22, 0.25)}
_STEEPNESS = 1 / 50


class Source(NamedTuple):
    """A ship and its result.

    Parameters
    ----------
    ship : Ship
    result : Dataset    of `polar` or `sweep`
    origin : str        the file, folder or ship it comes from
    digest : str        fingerprint of the file, or of what decides the numbers
    """

    ship: Ship
    result: xr.Dataset
    origin: str
    digest: str

    @property
    def harmonics(self) -> int:
        """Order of the steady motion, 1 for the paper's method."""
        words = str(self.result.attrs["steady_motion"]).split()
        return int(words[-1]) if words[-1].isdigit() else 1

    @property
    def form(self) -> Form:
        """Diffraction form of the result."""
        return cast(Form, self.result.attrs["diffraction_form"])


def report_source(what: str, ship_given: str | None, kind: str) -> Source:
    """Open a result with its ship, or compute the usual map of a ship.

    what: a .nc file, the folder of a sweep, a built-in ship or a ship file
    ship_given: ship of the result, where it does not say itself
    kind: "report" or "guidance": which map a ship gets
    """
    path = Path(what)
    if not (path.is_dir() or path.suffix.lower() == ".nc"):
        one = ship(what)
        result = _usual_map(one) if kind == "report" else _usual_sweep(one)
        return Source(one, result, f"computed for this report from {what}", digest_of(one, result))
    result = opened(what)
    if not {"roll_peak", "verdict", "speed", "heading", "wave_length"} <= set(result.variables):
        raise InputError(f'"{what}" is not a result of `quartering polar` or `quartering sweep`; give one, or a ship')
    if "ship" not in result.attrs or "steady_motion" not in result.attrs:
        raise InputError(f'"{what}" does not say which ship it is of; make it again with `quartering polar`')
    if not np.isfinite(result["roll_peak"]).any():
        raise InputError(f'no condition of "{what}" has an answer; choose other speeds, headings or wave lengths')
    one = _ship_of(result, what, ship_given)
    if not path.is_dir():
        return Source(one, result, what, hashlib.sha256(path.read_bytes()).hexdigest())
    content = read_store(path).content
    if content["case"]["ship"]["digest"] != fingerprint(base_of(one, _loadings(result))):
        raise InputError(f'"{what}" is of another "{one.name}" than the one at hand; give that ship with --ship')
    return Source(one, result, what, str(content["hash"]))


def digest_of(one: Ship, result: xr.Dataset) -> str:
    """Fingerprint of a ship and the axes of its map: what decides the numbers."""
    return fingerprint(
        [fingerprint(one), axes_of(result), str(result.attrs["steady_motion"]), result.attrs["diffraction"]]
    )


def _ship_of(result: xr.Dataset, what: str, given: str | None) -> Ship:
    """The ship given, or the one the result names, or the built-in one that is equal."""
    named = given or str(result.attrs.get("ship_argument", ""))
    if named and (given or Path(named).is_file() or named in {entry.name for entry in available_ships()}):
        one = _as_recorded(ship(named), result)
        wrong = _difference(one, result)
        if wrong:
            raise InputError(f'ship "{named}" is not the one of "{what}": {wrong}; give that ship with --ship')
        return one
    for entry in available_ships():
        one = _as_recorded(ship(entry.name), result)
        if one.name == result.attrs["ship"] and not _difference(one, result):
            return one
    raise InputError(
        f'"{what}" is of "{result.attrs["ship"]}" with {result.attrs["loading"]}; no built-in ship is that; '
        "name its ship file with --ship my.yaml"
    )


def _as_recorded(one: Ship, result: xr.Dataset) -> Ship:
    """The ship with lift as in a result; one that does not say is older than the choice, and absolute."""
    velocities = cast(Velocities, result.attrs.get("velocities", "absolute"))
    return one if one.velocities == velocities else one.with_(velocities=velocities)


def _difference(one: Ship, result: xr.Dataset) -> str:
    """First value in which a ship is not the one of a result; empty when it is that one."""
    own, recorded = heading_of(base_of(one, _loadings(result)), form="stf", harmonics=1), result.attrs
    for key in _SAME:
        there = recorded.get(key, "not said")
        if str(own[key]) != str(there):
            name = key.replace("_", " ")
            return name if "source" in key or key == "provenance" else f"{name} {own[key]}, there {there}"
    n2, there = (float(str(each["natural_roll_frequency"])) for each in (own, recorded))
    return "" if math.isclose(n2, there, rel_tol=1e-6) else f"natural roll frequency {n2:.6g} rad/s, there {there:.6g}"


def _loadings(result: xr.Dataset) -> dict[str, NDArray[np.float64]]:
    """Values of the loadings of a result, by name."""
    return {str(name): values.values for name, values in result.coords.items() if values.dims == ("loading",)}


def _speeds(one: Ship, kind: str) -> list[float]:
    return [quantity(f"{fn} Fn", "speed", length=one.hull.length) for fn in _FROUDE_NUMBERS[kind]]


def _usual_map(one: Ship) -> xr.Dataset:
    """The map `quartering polar` draws when nothing is said."""
    lengths = np.linspace(0.4, 2.3, 20) * one.hull.length
    speeds = _speeds(one, "report")
    with bar("conditions", len(speeds) * 37 * lengths.size) as told:
        return polar(one, [Wave(each, each * _STEEPNESS) for each in lengths], speeds, progress=told)


def _usual_sweep(one: Ship) -> xr.Dataset:
    """Eight speeds, all headings, waves of 0.5 to 2 ship lengths, three heights of about L/50, L/33 and L/25."""
    heights = [max(0.5, round(2 * share * one.hull.length) / 2) for share in (0.02, 0.03, 0.04)]
    lengths = np.array([0.5, 0.75, 1.0, 1.25, 1.5, 2.0]) * one.hull.length
    return sweep(one, _speeds(one, "guidance"), np.arange(0.0, 181.0, 5.0), lengths, sorted(set(heights)))


def axes_of(result: xr.Dataset) -> dict[str, list[float]]:
    """The axes of a result, for the record.

    >>> axes_of(xr.Dataset(coords={"speed": [5.0], "heading": [0.0, 90.0]}))
    {'heading': [0.0, 90.0], 'speed': [5.0]}
    """
    return {str(name): result[name].values.tolist() for name in sorted(map(str, result.coords)) if name != "resonance"}

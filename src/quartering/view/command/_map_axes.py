"""The conditions of a map as typed, and the map of a ship over them: what all commands that make maps share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.view.console.typed_values import value, values

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.loads.waves import Wave
    from quartering.motion.modes import Modes

MOST_CONDITIONS = 1_000_000
"""Largest map: about 1 GB of results."""
_STEEPNESS = "1/50"

Speeds = Annotated[list[str] | None, typer.Option("--speed", help="Speeds: 5,7.5 [m/s], 15kn, 0.25Fn; repeatable.")]
Headings = Annotated[str, typer.Option(help="Headings [deg]: from:to:count or a list.")]
WaveLengths = Annotated[str, typer.Option(help="Wave lengths: from:to:count or a list, m or L.")]
Steepness = Annotated[str | None, typer.Option(help="Wave height over wave length; 1/50 where nothing is given.")]
OneHeight = Annotated[str | None, typer.Option(help="One wave height for all lengths [m], instead of a steepness.")]
ALL_HEADINGS, ALL_LENGTHS = "0:180:37", "0.4L:2.3L:20"


class MapAxes(NamedTuple):
    """What a map is over: speeds [m/s], headings [deg], waves."""

    speeds: list[float]
    headings: list[float]
    waves: list[Wave]

    @property
    def conditions(self) -> int:
        """Number of conditions."""
        return len(self.speeds) * len(self.headings) * len(self.waves)


def typed_axes(
    one: Ship, speed: Sequence[str] | None, headings: str, wave_lengths: str, steepness: str | None, height: str | None
) -> MapAxes:
    """The conditions of a map as typed; values in L and Fn are those of the ship.

    Raises
    ------
    InputError    what cannot be read, more conditions than a map takes
    """
    speeds = values(speed or ["0.15Fn,0.2Fn,0.25Fn"], OPTIONS["speed"], one.sizes, "--speed", 3)
    mu = values([headings], OPTIONS["heading"], one.sizes, "--headings", 37)
    axes = MapAxes(speeds, mu, _waves(one, wave_lengths, steepness, height))
    if axes.conditions > MOST_CONDITIONS:
        raise InputError(
            f"{len(speeds)} speeds, {len(mu)} headings and {len(axes.waves)} wave lengths make {axes.conditions} conditions; "
            f"a map takes up to {MOST_CONDITIONS}; make several maps, or call quartering.sweep from Python"
        )
    return axes


def mapped(
    one: Ship,
    axes: MapAxes,
    harmonics: int,
    form: Form,
    *,
    modes: Modes = "three",
    extend: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """The map of a ship.

    Raises
    ------
    InputError    no condition has an answer
    """
    import numpy as np

    from quartering.study.maps.polar import polar

    ds = polar(
        one,
        axes.waves,
        axes.speeds,
        axes.headings,
        harmonics=harmonics,
        form=form,
        extend=extend,
        modes=modes,
        progress=progress,
    )
    if not np.isfinite(ds["roll_peak"]).any():
        raise InputError("no condition of this map has an answer; choose other speeds, headings or wave lengths")
    return ds


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

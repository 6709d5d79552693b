"""Equilibria of a ship that a wave carries along, over the heading ordered or the revolutions."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.hydro.propulsion import Drive, drive_of
from quartering.loads.waves import Wave
from quartering.motion.wave_equilibria import Equilibrium, Over, Search
from quartering.motion.wave_riding import PLACE, ROLL, YAW, U
from quartering.study.dataset import made_by
from quartering.study.six_modes.broaching import FURTHEST, OnTheWave, rider_of, straight_ahead

_VARIABLES: Final = {
    "heading": ("deg", "heading ordered off the wave's direction"),
    "revolutions": ("s-1", "of the propeller"),
    "place": ("deg", "k xi of G from a trough"),
    "yaw": ("deg", "heading off the wave's direction"),
    "heel": ("deg", "heel"),
    "rudder": ("deg", "rudder angle"),
    "speed_along": ("m s-1", "speed along the ship"),
    "growth": ("s-1", "of the fastest growing disturbance"),
    "frequency": ("rad s-1", "of that disturbance; 0: it grows or decays without swinging"),
}


@takes(ship="Ship", wave="Wave", over="word", propulsion="Propulsion, None")
def broaching_branch(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    over: Over = "heading",
    end: float | None = None,
    propulsion: Propulsion | None = None,
) -> xr.Dataset:
    """Equilibria of a ship carried along by a wave, over the heading ordered or the revolutions, through folds.

    Parameters
    ----------
    ship, wave, speed, propulsion    as for `broaching`
    over : str                       "heading", from 0 on, or "revolutions", from those of the speed on
    end : float                      heading [deg] or revolutions [1/s] to go to; None: 60 deg, or half the revolutions

    Returns
    -------
    Dataset    over ``point``, in the order of the branch: heading, revolutions, place, yaw, heel, rudder, speed_along, growth,
               frequency, and ``event`` (int8 flags: fold, where the wave lets the ship go; hopf, where swings begin)

    Raises
    ------
    InputError    no equilibrium to begin with, and what `broaching` refuses

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> steered = ship("s175").with_(autopilot="1,10s")
    >>> ds = broaching_branch(steered, Wave(175.0, 6.0), "0.35 Fn", end=10.0)
    >>> bool(ds.heading[-1] >= 10.0), bool((ds.growth < 0).all())
    (True, True)
    """
    if over not in ("heading", "revolutions"):
        raise InputError(f'over = {over!r}; it is "heading" or "revolutions"')
    if over == "heading" and (ship.autopilot is None or ship.autopilot.gain == 0):
        raise InputError(
            'over = "heading" needs an autopilot, or no heading is held; give one, such as autopilot="1,10s"'
        )
    drive = drive_of(ship, propulsion, estimate=True)
    assert drive is not None  # an estimate was asked for
    n = drive.propulsion.revolutions(number(ship, "speed", speed), ship.loading.density)
    rider = rider_of(ship, wave, drive)
    search = Search(rider, "heading", n)
    start = straight_ahead(rider, search, n)
    if start is None:
        raise InputError(f"{ship.name}: {OnTheWave.PASSED.advice}")
    if over == "revolutions":
        search = Search(rider, over, 0.0)
        start = np.append(start[:5], n)
    last = (FURTHEST if over == "heading" else 0.5 * n) if end is None else float(end)
    points = search.branch(start, math.radians(last) if over == "heading" else last)
    judged = [search.judged(one) for one in points]
    return _branch_dataset(ship, wave, drive, over, points, judged)


def _branch_dataset(
    ship: Ship, wave: Wave, drive: Drive, over: Over, points: list[Any], judged: list[Equilibrium]
) -> xr.Dataset:
    """Points of a branch as a dataset, with folds and the beginnings of swings."""
    y = np.array([one.state for one in judged])
    fastest = np.array([one.eigenvalues[0] for one in judged])
    values = {
        "heading": np.degrees([one.ordered for one in judged]), "revolutions": np.array([one.revolutions for one in judged]),
        "place": np.degrees(y[:, PLACE]), "yaw": np.degrees(y[:, YAW]), "heel": np.degrees(y[:, ROLL]),
        "rudder": np.degrees([one.rudder for one in judged]), "speed_along": y[:, U], "growth": fastest.real,
        "frequency": np.abs(fastest.imag),
    }  # fmt: skip
    event = np.zeros(len(points), np.int8)
    steps = np.diff([one[5] for one in points])
    event[1:-1][steps[:-1] * steps[1:] < 0] = 1
    swings = (fastest.real[:-1] * fastest.real[1:] < 0) & (np.abs(fastest.imag[1:]) > 1e-9)
    event[1:][swings] = 2
    fields: dict[str, Any] = {
        name: ("point", values[name], {"units": unit, "long_name": meaning})
        for name, (unit, meaning) in _VARIABLES.items()
    }
    flags = {"flag_values": np.array([0, 1, 2], np.int8), "flag_meanings": "none fold hopf", "units": "1"}
    fields["event"] = ("point", event, flags | {"long_name": "what happens to the branch here"})
    about = {
        "title": f"Equilibria of {ship.name} on a wave", "ship": ship.name, "wave_length": wave.length,
        "wave_height": wave.height, "over": over, "propulsion": drive.source, "source": made_by(),
        "autopilot": "none" if ship.autopilot is None else ship.autopilot.words,
    }  # fmt: skip
    return xr.Dataset(fields, attrs=about)

"""A ship simulated in an irregular sea: the doors of `irregular`."""

from __future__ import annotations

import os
import warnings
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Final, overload

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering._machine.digest import fingerprint, source_digest
from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import count, number
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea
from quartering.motion.equations.model import Model
from quartering.motion.modes import Modes, in_six
from quartering.motion.sea.equations import Force
from quartering.motion.transient.irregular import irregular as irregular_by_components
from quartering.option_checks import quoted
from quartering.study.seas.response import (
    MOST_NEAR,
    warn_of_steepness,
)
from quartering.study.seas.simulated.asked import Asked, asked_of, felt_limit_of
from quartering.study.seas.simulated.blocks import Tally, error_below, run_blocks
from quartering.study.seas.simulated.planned import Ready, known_of, memory_words, planned
from quartering.study.seas.simulated.simulated_dataset import simulated_dataset

Floats = NDArray[np.float64]

NOTEWORTHY: Final = 0.05
"""Change of the closure with the coefficients of a simulation that is warned of [1]."""
OFF_COURSE: Final = 5e-3
"""Growth of slow deviations from the course that is warned of [1/s]: e^9 in half an hour."""


@overload
def irregular(
    ship: Model,
    sea: ArrayLike,
    speed: ArrayLike,
    heading: ArrayLike,
    duration: float | str,
    *,
    step: float | str = ...,
    limit: float | str | None = ...,
    water: ArrayLike | None = ...,
) -> xr.Dataset: ...
@overload
def irregular(
    ship: Ship | Model,
    sea: Sea,
    speed: float | str,
    heading: float | str | None = None,
    *,
    hours: float = ...,
    seed: int = ...,
    until: float | None = ...,
    force: Force | None = ...,
    place: tuple[float | str, float | str] | None = ...,
    form: Form = ...,
    limit: float | str | None = ...,
    acceleration_limit: float | None = ...,
    step: float | str | None = ...,
    strips: int | None = ...,
    memory: bool = ...,
    store: str | os.PathLike[str] | None = ...,
    modes: Modes = ...,
) -> xr.Dataset: ...
def irregular(ship: Any, sea: Any = None, *given: Any, **named: Any) -> xr.Dataset:
    """A ship simulated in an irregular sea: nonlinear motion in time, its extremes and its rate of failures.

    ``irregular(ship, sea, speed, heading=None, *, hours=32, seed=0, ...)``.

    Parameters
    ----------
    ship : Ship or Model
    sea : Sea
    speed : float or str          U >= 0 [m/s]
    heading : float, optional     in place of the sea's own: of its first system, the others turned with it [deg]
    hours : float                 to simulate at the least, in blocks of half an hour with a seed each; 64 of them, 32 hours,
                                  are run at a time
    seed : int                    0 or above; with it and the condition everything is drawn
    until : float, optional       stop before where the standard error of roll's root mean square, measured between blocks, is
                                  below this share of it
    force : callable              of a `Model`, as of `sea_response`
    place : (x, height)           of the lateral acceleration, as of `sea_response`
    form : str                    of the diffraction force of a ship
    limit : float, optional       roll of a failure [rad]; by default the least of 40 deg and the ``capsize_limit``, which knows
                                  the vanishing angle and `openings`
    acceleration_limit : float    lateral acceleration of a failure [m/s2], 9.81, at the place given or the ship's
                                  ``highest_position``; where neither is known only roll fails
    step : float, optional        of time [s]; by default 0.3 rad of free roll
    strips : int, optional        of the drag and of the water's velocity; by default as few as change roll of the closure by
                                  less than 0.3 %
    memory : bool                 of the radiated waves, by a rational fit of added mass and damping over frequency; without it
                                  both are those of free roll. A `Model` has none
    store : path, optional        a file that keeps finished blocks: an interrupted or shorter run goes on from there
    modes : str                   "three": sway, roll and yaw; "six": surge, heave and pitch too, the pressure of all waves on
                                  the whole wetted hull of a ship, with hours, seed and limit alone: heave_rms, pitch_rms,
                                  roll_rms, failures and their rate; see `irregular_six`

    Returns
    -------
    xarray.Dataset    covariance (state, state_2) of v, phi, p, r [SI]; roll_rms, roll_mean [deg], lateral_acceleration_rms
                      [m/s2]; roll_mean_largest, lateral_acceleration_mean_largest of 3 h; each with ``_error``, its standard
                      error. exposure [h], failures, failure_rate, rate_lower, rate_upper [1/s], waiting_time_p. Over block:
                      roll_largest [deg], lateral_acceleration_largest, failure_time [s], failure_cause. cut_off, overtaken,
                      near_zero energy

    Raises
    ------
    InputError        no sea; what `sea_response` refuses; hours, seed, step or strips out of range; a store of something else

    Warns
    -----
    RangeWarning      blocks that failed in their run-up; energy near omega = 0; a run-up shorter than slow modes ask; waiting
                      times that are not exponential

    Notes
    -----
    Gaussian records by Fourier transform from the cross-spectra of forces and of the water's velocity at the strips, of half an
    hour and a run-up each, with random amplitudes; classical Runge-Kutta. The wave forces, lift in them, are those
    of each wave. A block ends with its failure. Results are the same for any number of threads, and a longer run begins with
    the blocks of a shorter one. Numbers of failures have the exact interval of a Poisson count.
    The form with arrays, ``irregular(model, frequency, force, phase, duration, *, step, limit, water)``, adds up waves of given
    amplitudes: see `quartering.motion.transient.irregular`.
    Source: [Tucker84] random amplitudes; MSC.1/Circ.1627 for the failures.  Valid: linear waves, constant speed, mean heading,
    drag on as many strips as the attribute ``strips``. ``closure_change`` says what the closure's roll and lateral acceleration
    are in these equations over what they are with coefficients at each frequency and every strip.

    Examples
    --------
    >>> import quartering as qt
    >>> sea = qt.Sea(hs=1, tp=9, heading=60)
    >>> found = qt.irregular(qt.ship("wigley"), sea, 5.0, hours=32, seed=1)
    >>> closed = qt.sea_response(qt.ship("wigley"), sea, 5.0, method="closure")
    >>> bool(abs(found["roll_rms"] / closed["roll_rms"] - 1) < 0.05), float(found["exposure"])
    (True, 32.0)
    """
    modes = named.pop("modes", "three")
    if in_six(modes):
        return _in_six_modes(ship, sea, *given, **named)
    if isinstance(sea, Sea):
        return _in_a_sea(ship, sea, *given, **named)
    if {"model", "frequency", "phase"} & named.keys() or (isinstance(ship, Model) and len(given) > 1):
        if sea is not None:
            given = (sea, *given)
        return irregular_by_components(ship, *given, **named)
    raise InputError(
        f"sea = {quoted(sea)} is no Sea; give one, such as quartering.Sea(hs=6, tp=11), or arrays: frequency, force, phase,"
        " duration"
    )


def _in_six_modes(ship: Any, sea: Any, *given: Any, **named: Any) -> xr.Dataset:
    """The same in six modes: what they cannot be asked is refused."""
    from quartering.study.six_modes.irregular import irregular_six

    if not isinstance(ship, Ship) or not isinstance(sea, Sea):
        raise InputError(
            "modes = six takes a ship and a Sea; try irregular(ship, quartering.Sea(hs=6, tp=11), 5, modes='six')"
        )
    other = sorted(named.keys() - {"speed", "heading", "hours", "seed", "limit"})
    if other:
        raise InputError(f"modes = six takes hours, seed and limit; leave {', '.join(other)} out")
    return irregular_six(ship, sea, *given, **named)


@takes(ship="Ship, Model")
def _in_a_sea(
    ship: Ship | Model,
    sea: Sea,
    speed: float | str,
    heading: float | str | None = None,
    *,
    hours: float = 32.0,
    seed: int = 0,
    until: float | None = None,
    force: Force | None = None,
    place: tuple[float | str, float | str] | None = None,
    form: Form = "stf",
    limit: float | str | None = None,
    acceleration_limit: float | None = None,
    step: float | str | None = None,
    strips: int | None = None,
    memory: bool = True,
    store: str | os.PathLike[str] | None = None,
) -> xr.Dataset:
    asked = asked_of(ship, sea, speed, heading, seed, memory, force, form, limit=limit, place=place)
    asked = replace(
        asked,
        limits=(asked.limits[0], felt_limit_of(ship, place, acceleration_limit)),
        step=None if step is None else number(None, "step", step),
        strips=None if strips is None else count("strips", strips, 1, 6, 1000),
    )
    duration = number(None, "simulated_hours", hours)
    wanted = None if until is None else number(None, "until", until)
    ready = planned(asked)
    key = fingerprint(
        [source_digest("hull", "hydro", "loads", "motion"), ready.plan.condition, asked.seed, asked.limits, place]
    )
    enough = None if wanted is None else partial(error_below, share=wanted)
    tally = run_blocks(ready.plan, duration, enough, None if store is None else _file(store), key)
    result = simulated_dataset(tally, known_of(asked, ready))
    _warn(asked, ready, tally, result)
    return result


def _file(store: Any) -> Path:
    try:
        file = Path(store)
    except TypeError:
        raise InputError(f"store = {quoted(store)}; give the name of a file, such as 'blocks.npz'") from None
    if file.is_dir() or not file.parent.is_dir():
        raise InputError(f"store {file}: give the name of a file in a folder that exists")
    return file


def _warn(asked: Asked, ready: Ready, tally: Tally, result: xr.Dataset) -> None:
    warn_of_steepness([asked.sea])
    said = []
    blocks = tally.blocks
    lost = blocks.cause.size - blocks.counted
    if lost:
        said.append(
            f"{lost} of {blocks.cause.size} blocks failed in their run-up from rest and do not count: the sea is too much for"
            " this ship, or its motion grows; see sea_response"
        )
    if ready.shares[1] > MOST_NEAR:
        said.append(
            f"{ready.shares[1]:.0%} of the wave energy is near encounter frequency 0: surf-riding and broaching, this model is"
            " not valid; change speed or heading"
        )
    if not lost and ready.run_up < 0.99 * ready.run_up_wanted:
        said.append(
            f"the run-up of {ready.run_up:.0f} s is shorter than slow modes of the ship ask for ({ready.run_up_wanted:.0f} s):"
            " sway and yaw keep some of their start from rest"
        )
    if ready.off_course > OFF_COURSE and getattr(asked.ship, "autopilot", None) is None:
        said.append(
            f"nobody steers, and slow deviations from the course grow by {ready.off_course:.2g} 1/s: the ship turns and heels"
            " in the simulation, which coefficients at the frequency of roll (the closure, memory=False) do not see; give it"
            " an autopilot"
        )
    if max(np.abs(np.nan_to_num(ready.errors))) > NOTEWORTHY:
        said.append(
            f"the closure changes by {ready.errors[0]:+.0%} in roll and {ready.errors[1]:+.0%} in lateral acceleration with the"
            f" coefficients of this simulation ({memory_words(ready.memory)}) in place of those at each frequency"
        )
    p = float(result["waiting_time_p"])
    if p < 0.01:
        said.append(
            f"the times to failure are not exponential (p = {p:.2g}): the rate is not that of rare, independent failures; it"
            " changes along the half hour"
        )
    for one in said:
        warnings.warn(f"{asked.sea.words}: {one}", RangeWarning, stacklevel=5)

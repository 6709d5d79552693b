"""A ship simulated in an irregular sea: what is asked, the plan of its blocks, and the doors of `irregular`."""

from __future__ import annotations

import math
import os
import warnings
from dataclasses import dataclass, replace
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
from quartering.loads.sea.cells import Cells, wave_cells
from quartering.loads.sea.sea import Sea
from quartering.motion.equations.model import Model
from quartering.motion.sea.closure import Solution, closure_solutions
from quartering.motion.sea.equations import Force, SeaEquations, angle_of_largest_arm, free_roll_of, roll_mode_of
from quartering.motion.sea.frozen import frozen_equations, with_few_strips
from quartering.motion.sea.memory import Memory, memory_of
from quartering.motion.sea.synthesis import record_of
from quartering.motion.transient.irregular import irregular as irregular_by_components
from quartering.motion.transient.rk4 import alike
from quartering.option_checks import quoted
from quartering.study.seas.blocks import BLOCK, Plan, Tally, error_below, run_blocks
from quartering.study.seas.moments import moments_of, products
from quartering.study.seas.response import (
    LEAST_DAMPING,
    MOST_NEAR,
    limit_of,
    place_of,
    sea_equations,
    shares_of,
    warn_of_steepness,
)
from quartering.study.seas.simulated import simulated_dataset

Floats = NDArray[np.float64]

FAILURE_ROLL: Final = 40.0
"""Roll angle of a failure where the capsize limit is larger [deg]: MSC.1/Circ.1627, 3.2.1."""
FAILURE_FELT: Final = 9.81
"""Lateral acceleration of a failure [m/s2]: the same place."""
_RADIANS_A_STEP: Final = 0.3
_RUN_UP, _LONGEST_RUN_UP, _TIMES = 200.0, 900.0, 6.0
_STRIPS: Final = (6, 9, 13)
STRIPS_ERROR: Final = 0.003
"""Change of the closure's roll that fewer strips may make [1]."""
NOTEWORTHY: Final = 0.05
"""Change of the closure with the coefficients of a simulation that is warned of [1]."""
_FASTEST: Final = 2.0


@dataclass(frozen=True, eq=False)
class Asked:
    """What a simulation is of, checked."""

    ship: Ship | Model
    sea: Sea
    speed: float
    place: tuple[float, float]
    limits: tuple[float, float]
    reason: str
    step: float | None
    strips: int | None
    memory: bool
    seed: int
    form: Form
    force: Force | None


@dataclass(frozen=True, eq=False)
class Ready:
    """The plan of a simulation, and what is to be said of it."""

    plan: Plan
    cells: Cells
    strips: int
    memory: Memory | None
    errors: tuple[float, float]
    run_up: float
    run_up_wanted: float
    largest_arm: float
    shares: tuple[float, float, float]
    roll_frequency: float
    damping: float
    channels: NDArray[np.complex128]
    equations: SeaEquations
    solution: Solution


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
        strips=None if strips is None else count("strips", strips, 1, 6),
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


def asked_of(
    ship: Ship | Model,
    sea: Sea,
    speed: float | str,
    heading: float | str | None,
    seed: int,
    memory: bool,
    force: Force | None,
    form: Form,
    *,
    limit: float | str | None = None,
    place: Any = None,
) -> Asked:
    """What is asked, checked: arguments as of `irregular`."""
    if not isinstance(sea, Sea):
        raise InputError(f"sea = {quoted(sea)} is no Sea; give one, such as quartering.Sea(hs=6, tp=11)")
    of = ship if isinstance(ship, Ship) else None
    roll, reason = roll_limit_of(ship, limit)
    return Asked(
        ship=ship,
        sea=sea if heading is None else sea.turned_to(number(of, "heading", heading)),
        speed=number(of, "speed", speed),
        place=place_of(ship, place),
        limits=(roll, felt_limit_of(ship, place, None)),
        reason=reason,
        step=None,
        strips=None,
        memory=_yes_or_no("memory", memory),
        seed=count("seed", seed, 0, 6),
        form=form,
        force=force,
    )


def _yes_or_no(name: str, given: Any) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise InputError(f"{name} = {quoted(given)}; it is True or False")
    return bool(given)


def _file(store: Any) -> Path:
    try:
        file = Path(store)
    except TypeError:
        raise InputError(f"store = {quoted(store)}; give the name of a file, such as 'blocks.npz'") from None
    if file.is_dir() or not file.parent.is_dir():
        raise InputError(f"store {file}: give the name of a file in a folder that exists")
    return file


def roll_limit_of(ship: Ship | Model, limit: float | str | None) -> tuple[float, str]:
    """Roll of a failure [rad], and why that."""
    if limit is not None:
        return number(None, "limit", limit), "given"
    own = limit_of(ship)
    if own.angle < FAILURE_ROLL:
        return own.radians, own.reason
    return math.radians(FAILURE_ROLL), f"{FAILURE_ROLL:g} deg"


def felt_limit_of(ship: Ship | Model, place: Any, given: float | None) -> float:
    """Lateral acceleration of a failure [m/s2]; infinite where no place is known."""
    if given is not None:
        return number(None, "felt_limit", given)
    known = place is not None or (isinstance(ship, Ship) and ship.value("highest_position_height") is not None)
    return FAILURE_FELT if known else math.inf


def planned(asked: Asked) -> Ready:
    """Cells, equations, records and step of a simulation."""
    frequency, damping = free_roll_of(asked.ship, asked.speed)
    cells = wave_cells([asked.sea], asked.speed, frequency, max(damping, LEAST_DAMPING))
    everything = sea_equations(asked.ship, cells, asked.force, asked.form)
    energy = cells.energy(asked.sea)
    memory = memory_of(everything, energy) if asked.memory else None
    shared = _in_time(everything, memory)
    equations, solution = _with_strips_for(shared, energy, asked.strips)
    exact = solution if equations is everything else closure_solutions(everything, energy)[0]
    errors = _changes((equations, solution), (everything, exact), asked)
    frozen = frozen_equations(equations, solution.statistics.variance, memory)
    _, _, slow = roll_mode_of(*everything.at_roll)
    wanted = max(_RUN_UP, _TIMES / max(min(slow, max(damping, 0.0) * frequency), 1e-9))
    step = _step_for(frequency, memory) if asked.step is None else asked.step
    if step > BLOCK / 100:
        raise InputError(f"step = {step:g} s; it is at most {BLOCK / 100:g} s; try {_RADIANS_A_STEP / frequency:.2g} s")
    step = BLOCK / math.ceil(BLOCK / step * (1.0 - 1e-12))
    first = math.ceil(min(wanted, _LONGEST_RUN_UP) / step)
    duration = first * step + BLOCK
    record = record_of(cells, asked.sea, frozen.channels, duration + step, 0.5 * step)
    plan = Plan(
        equations=alike(frozen.system),
        record=record,
        step=step,
        first=first,
        speed=asked.speed,
        place=asked.place,
        limits=asked.limits,
        seed=asked.seed,
        condition=_condition(asked, step, first, equations.terms.drag.size),
    )
    shares = shares_of(cells, asked.sea, frequency)
    arm = math.degrees(angle_of_largest_arm(everything))
    return Ready(
        plan, cells, equations.terms.drag.size, memory, errors, first * step, wanted, arm, shares, frequency, damping,
        frozen.channels,
        equations,
        solution,
    )  # fmt: skip


def _in_time(equations: SeaEquations, memory: Memory | None) -> SeaEquations:
    """Equations over cells with the coefficients that a simulation has."""
    if memory is not None:
        return memory.in_cells(equations)
    if len(equations.linear) == 1:
        return equations
    inertia, linear = equations.at_roll
    return replace(equations, inertia=inertia[None], linear=linear[None])


def _step_for(roll_frequency: float, memory: Memory | None) -> float:
    """Step of time [s]: 0.3 rad of free roll, and short enough for the fastest state of the memory."""
    step = _RADIANS_A_STEP / roll_frequency
    return step if memory is None else min(step, _FASTEST / float(np.abs(memory.fit.poles).max()))


def _memory_words(memory: Memory | None) -> str:
    if memory is None:
        return "no memory, coefficients of free roll"
    passive = "passive" if memory.passive else "not passive"
    return f"memory of {memory.fit.drive.size} poles, {passive}, misfit {memory.misfit:.2g}"


def _with_strips_for(equations: SeaEquations, energy: Floats, strips: int | None) -> tuple[SeaEquations, Solution]:
    """Equations with few strips, and their closure."""
    whole = closure_solutions(equations, energy)[0]
    if equations.terms.drag.size == 0 or equations.terms.matched is not None:
        return equations, whole
    for points in _STRIPS if strips is None else (strips,):
        fewer = with_few_strips(equations, points)
        if fewer is equations:
            break
        found = closure_solutions(fewer, energy)[0]
        near = whole.converged and found.converged and abs(found.roll - whole.roll) <= STRIPS_ERROR * whole.roll
        if strips is not None or near:
            return fewer, found
    return equations, whole


def _changes(
    own: tuple[SeaEquations, Solution], exact: tuple[SeaEquations, Solution], asked: Asked
) -> tuple[float, float]:
    """Roll and lateral acceleration of one closure over those of another, less 1; NaN where one did not converge."""
    found = []
    for equations, solution in (own, exact):
        if not solution.converged:
            return math.nan, math.nan
        at = equations.frequency[solution.cells]
        moments = moments_of(solution.energy @ products(solution.motion, at, asked.speed, asked.place))
        found.append(np.sqrt([moments.roll[0], moments.acceleration[0]]))
    if not found[1].all():
        return math.nan, math.nan
    roll, felt = found[0] / found[1] - 1.0
    return float(roll), float(felt)


def _condition(asked: Asked, step: float, first: int, strips: int) -> int:
    """Number of the condition, which with the seed and a block's number decides what is drawn."""
    parts = [asked.ship, asked.sea, asked.speed, asked.form, asked.memory, step, first, strips]
    return int(fingerprint(parts)[:16], 16)


def known_of(asked: Asked, ready: Ready) -> dict[str, Any]:
    """What is to be said of a simulation beside its numbers."""
    felt, (x, z) = asked.limits[1], asked.place
    record = ready.plan.record
    return {
        "ship": asked.ship,
        "sea": asked.sea,
        "speed": asked.speed,
        "shares": ready.shares,
        "roll_frequency": ready.roll_frequency,
        "attributes": {
            "seed": asked.seed,
            "roll_limit": math.degrees(asked.limits[0]),
            "roll_limit_reason": asked.reason,
            "acceleration_limit": felt if math.isfinite(felt) else "none: no highest position is known",
            "place": f"{x:.4g} m forward of G, {z:.4g} m below it",
            "block": BLOCK,
            "run_up": ready.run_up,
            "run_up_of_slow_modes": ready.run_up_wanted,
            "step": ready.plan.step,
            "strips": ready.strips,
            "memory": _memory_words(ready.memory),
            "largest_arm": ready.largest_arm,
            "closure_change": f"roll {ready.errors[0]:+.2%}, lateral acceleration {ready.errors[1]:+.2%}",
            "frequencies": len(record.roots),
            "highest_frequency": len(record.roots) * 2.0 * math.pi / (record.samples * record.interval),
            "force_left_out": record.left_out,
            "roll_damping_ratio": ready.damping,
            "diffraction": asked.form,
        },
    }


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
    if max(np.abs(np.nan_to_num(ready.errors))) > NOTEWORTHY:
        said.append(
            f"the closure changes by {ready.errors[0]:+.0%} in roll and {ready.errors[1]:+.0%} in lateral acceleration with the"
            f" coefficients of this simulation ({_memory_words(ready.memory)}) in place of those at each frequency"
        )
    p = float(result["waiting_time_p"])
    if p < 0.01:
        said.append(
            f"the times to failure are not exponential (p = {p:.2g}): the rate is not that of rare, independent failures; it"
            " changes along the half hour"
        )
    for one in said:
        warnings.warn(f"{asked.sea.words}: {one}", RangeWarning, stacklevel=5)

"""Many realisations of an irregular sea at once: motion in time under a sum of waves."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.compiled import kernel
from quartering._machine.simd import all_at_most, load, size, store, where_less
from quartering._machine.threads import in_threads
from quartering.conventions import STATE, InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.told import number, numbers
from quartering.motion.equations.model import Model
from quartering.motion.equations.rates import WIDTH
from quartering.motion.equations.system import Floats
from quartering.motion.transient.excitation import excitation_at, in_chunks, steps_apart, weights_between
from quartering.motion.transient.in_pairs import ROWS, goes_in_pairs, march_in_pairs, products_of
from quartering.motion.transient.rk4 import alike, room_to_march, step_sum
from quartering.option_checks import quoted

if TYPE_CHECKING:
    import xarray as xr

_TOGETHER = 8
"""Rows whose excitation stands together."""

_COMPONENTS, _UNITS = [*STATE, "psi", "delta"], ["m/s", "rad", "rad/s", "rad/s", "rad", "rad"]
"""Of the state; the heading and the rudder angle where an autopilot steers."""


@kernel
def _march(first, last, equations, forcing, weights, h, begin, steps, limit, states, peak, square, capsize):
    """Runge-Kutta steps for rows first..last of realisations, a row being a batch.

    ``forcing``, ``weights``: as `excitation_at` takes them, of accelerations, known inputs and water.
    ``states`` (rows, 4 to 6, W), ``peak``, ``square`` (the sum of roll squared) and ``capsize`` (time, NaN before) (rows, W)
    go on from where they are; a realisation past ``limit`` stands still.
    """
    kinds, together, apart = forcing.shape[2], forcing.shape[3], weights.shape[0] // 2
    room, given, still = room_to_march(equations), np.zeros((3, kinds, WIDTH)), np.zeros(WIDTH)
    waves, total, roll_angle = (
        np.zeros((3, equations.parts.inputs.shape[2])),
        room[4],
        equations.program.displacements[1],
    )
    waves[:, 0], waves[:, 1] = 1.0, 1.0  # a series stands where the mean of an input and the cosine of the water would
    for row in range(first, last):
        y, group, own = states[row], row // together, row % together
        for l in range(WIDTH):
            still[l] = 1.0 if np.isnan(capsize[row, l]) else 0.0
        highest, total_square = load(peak, row), load(square, row)
        for k in range(kinds):
            store(given, (2, k), excitation_at(forcing, weights, group, 0, 0, k, own))
        for n in range(steps):
            sample, place = n // apart, 2 * (n % apart)
            for k in range(kinds):
                store(given, (0, k), load(given, (2, k)))
                for j in range(1, 3):
                    store(given, (j, k), excitation_at(forcing, weights, group, sample, place + j, k, own))
            step_sum(equations, h, given, waves, y, room)
            going = load(still, ())
            for s in range(y.shape[0]):
                store(y, s, load(y, s) + going * (h / 6.0) * load(total, s))
            roll = size(load(y, roll_angle))
            highest = where_less(highest, roll, roll, highest)
            total_square += going * roll * roll
            if not all_at_most(roll, limit):
                for l in range(WIDTH):
                    if still[l] > 0.0 and not abs(y[roll_angle, l]) <= limit:
                        capsize[row, l], still[l] = begin + (n + 1) * h, 0.0
        store(peak, row, highest)
        store(square, row, total_square)


@takes(model="Model")
def irregular(
    model: Model,
    frequency: ArrayLike,
    force: ArrayLike,
    phase: ArrayLike,
    duration: float | str,
    *,
    step: float | str = 0.2,
    limit: float | str | None = None,
    water: ArrayLike | None = None,
) -> xr.Dataset:
    """Largest roll of many realisations of an irregular sea, from rest.

    model: its terms, inertia and steady force; its regular wave is left out
    frequency (c,): encounter frequencies of the components [rad/s]; here and below numbers, or text with a unit: "0.1
        Hz", "30 deg", "2 min" (forces and velocities: numbers)
    force (c, 3): amplitude and phase of sway force [N], roll and yaw moment [N m] of each component: the real part of
        force exp(i (w t + phase)) acts
    phase (n, c): phases of the components in each of n realisations [rad]
    duration: [s]
    step: of time [s]
    limit: roll angle that counts as capsize [rad], by default the model's ``capsize_limit``; a realisation stops there
    water (c, m): velocity of the water in each component, as `force`, of a model that has it: w0 [m/s] and w1 [1/s] of
        `Model.water`, then that at each of `Model.strips` [m/s]
    Returns over realisation: roll_peak, roll_rms [deg] (until a capsize), capsize_time [s] (NaN where none), and state
        at the end (realisation, component: v [m/s], phi [rad], p, r [rad/s]; with an autopilot psi and, with a lag,
        delta [rad])

    Fourth-order Runge-Kutta with a fixed step. The excitation at every second or fourth step is one matrix product for all
    realisations, and between these the polynomial through eight of them, where it so errs by a millionth at most; else that
    at every step, and the polynomial errs by (w step)^8/936, far less than the method.
    Source: [H71] eq. (3), superposition of components.  Valid: coefficients taken at one frequency stand for all
    components (they are those of ``model``); long waves and small steepness, so that components add.
    """
    w, phases = numbers(None, "signed_frequency", frequency), numbers(None, "phase", phase)
    duration, step = number(None, "duration", duration), number(None, "step", step)
    angle_of_capsize = model.capsize_limit.radians if limit is None else number(None, "limit", limit)
    try:
        f = np.asarray(force, complex)
    except (TypeError, ValueError):
        raise InputError(f"force = {quoted(force)}; it is complex numbers (c, 3) [N, N m]") from None
    if w.ndim != 1 or f.shape != (w.size, 3) or phases.ndim != 2 or phases.shape[1] != w.size or phases.shape[0] == 0:
        raise InputError(
            f"frequency {w.shape}, force {f.shape} and phase {phases.shape} do not fit together: give c frequencies, (c, 3)"
            " forces and (n, c) phases"
        )
    if not np.isfinite(f).all():
        raise InputError("force must be finite numbers")
    if step > duration:
        raise InputError(
            f"step = {step:g} s and duration = {duration:g} s; the step is at most the duration; try 0.2 s"
        )
    period = repeat_period(w)
    if period < duration:
        warnings.warn(
            f"frequency: {w.size} equally spaced components repeat their groups of waves every {period:.4g} s, and the duration"
            f" is {duration:.4g} s: the largest rolls are too small and scatter too little; give a quartering.Sea instead",
            RangeWarning,
            stacklevel=4,
        )
    known = _known_inputs(model, w.size, water)
    count, steps = phases.shape[0], round(duration / step)
    in_pairs = goes_in_pairs(model.system)
    together = min(_TOGETHER, -(-count // WIDTH))
    if in_pairs:
        together += together % ROWS
    rows = -(-count // (WIDTH * together)) * together
    acceleration = np.concatenate([np.linalg.solve(model.inertia, f.T), known])  # (3 + m, c)
    apart = steps_apart(w, np.abs(acceleration), step)
    turned = acceleration[:, None, :] * np.exp(1j * phases)  # (3 + m, n, c)
    states = np.zeros((rows, model.system.states, WIDTH))
    peak, square = np.zeros((rows, WIDTH)), np.zeros((rows, WIDTH))
    capsize = np.full((rows, WIDTH), np.nan)
    equations = products_of(model.system) if in_pairs else alike(model.system)
    march, each = (march_in_pairs, ROWS) if in_pairs else (_march, 1)
    weights, mean = weights_between(apart), model.system.mean[0]
    for begin, some, forcing in in_chunks(w, turned, mean, step, steps, apart, together):
        at = (step, begin * step, some, angle_of_capsize)
        in_threads(march, rows // each, equations, forcing, weights, *at, states, peak, square, capsize, smallest=1)
    result = _dataset(model, states, peak, square, capsize, count, steps * step, step)
    reason = model.capsize_limit.reason if limit is None else "given"
    return result.assign_attrs(capsize_angle=float(np.degrees(angle_of_capsize)), capsize_reason=reason)


def repeat_period(frequency: Floats) -> float:
    """Time after which the groups of waves of equally spaced frequencies repeat [s]; infinite of others, and of two or one.

    >>> round(repeat_period(np.linspace(0.2, 1.2, 50)), 1)
    307.9
    """
    gaps = np.diff(np.unique(frequency))
    gaps = gaps[gaps > 1e-9]
    if gaps.size < 2:
        return np.inf
    parts = gaps / gaps.min()
    return float(2.0 * np.pi / gaps.min()) if np.abs(parts - np.round(parts)).max() < 1e-6 else np.inf


def _known_inputs(model: Model, components: int, water: ArrayLike | None) -> NDArray[np.complex128]:
    """Phasors (m, c) of the model's known inputs, -w0 and -w1, then of the water at its strips as the equations take it."""
    own = 0 if model.water is None else 2
    strips = 0 if model.strips is None else model.strips.x.size
    given = np.zeros((components, 0), complex) if water is None else np.asarray(water, complex)
    if given.shape != (components, own + strips) or not np.isfinite(given).all():
        raise InputError(
            f"water {given.shape}: this model has {own} velocities of the water (w0, w1) and {strips} strips; give finite"
            f" numbers ({components}, {own + strips}), one row a component"
            + ("" if own + strips else ", or leave it out")
        )
    scale = np.concatenate([-np.ones(own), np.cbrt(model.strips.c) if model.strips is not None else np.empty(0)])
    return (given * scale).T


def _dataset(
    model: Model,
    states: Floats,
    peak: Floats,
    square: Floats,
    capsize: Floats,
    count: int,
    duration: float,
    step: float,
) -> xr.Dataset:
    import xarray as xr

    time = capsize.ravel()[:count]
    past = np.where(np.isnan(time), duration, time)
    data = {
        "roll_peak": (np.degrees(peak.ravel()[:count]), "deg", "largest roll angle"),
        "roll_rms": (np.degrees(np.sqrt(square.ravel()[:count] * step / past)), "deg", "root mean square roll angle"),
        "capsize_time": (time, "s", "time of capsize"),
    }
    ends = states.transpose(0, 2, 1).reshape(-1, states.shape[1])[:count]
    described = {"units": ", ".join(_UNITS[: ends.shape[1]]), "long_name": "state at the end"}
    return xr.Dataset(
        {
            name: ("realisation", values, {"units": unit, "long_name": words})
            for name, (values, unit, words) in data.items()
        }
        | {"state": (("realisation", "component"), ends, described)},
        coords={"component": _COMPONENTS[: ends.shape[1]]},
        attrs={"duration": duration, "step": step, "references": ", ".join(model.references)},
    )

"""Direct integration of the full equations in time."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from quartering._machine.compiled import inner, kernel
from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.autopilot import Autopilot
from quartering.hull.told import number
from quartering.motion.equations.model import Model
from quartering.motion.equations.rates import WIDTH, enter_inputs, fill, forces, room_for, row_of_lanes
from quartering.motion.equations.steering import HEADING, RUDDER
from quartering.motion.equations.system import Floats
from quartering.motion.modes import Modes, in_six
from quartering.motion.of_ship import equations

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.loads.waves import Wave


MOST_SAMPLES = 5_000_000
"""Longest result: about 300 MB."""

# Dormand and Prince's nodes, stage weights, error weights and dense-output weights.
_STATES = ("sway_velocity", "roll", "roll_rate", "yaw_rate", "yaw", "rudder_angle")
_NODES = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
_STAGES = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
_ERROR = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
_DENSE = np.array(
    [
        -12715105075 / 11282082432, 0, 87487479700 / 32700410799, -10690763975 / 1880347072,
        701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423,
    ]
)  # fmt: skip


@inner
def _derivative(program, lanes, time, y, waves, room, out):
    columns, force, _, sums = room
    w = lanes.frequency[0]
    for s in range(y.size):
        columns[s, 0] = y[s]
    waves[0] = 1.0
    for h in range(1, waves.size // 2 + 1):
        waves[2 * h - 1], waves[2 * h] = math.cos(h * w * time), math.sin(h * w * time)
    enter_inputs(program, lanes, waves, columns)
    forces(program, lanes, waves[1], waves[2], columns, sums, force)
    for k in range(3):
        force[k, 0] += lanes.mean[k, 0] + lanes.cos[k, 0] * waves[1] + lanes.sin[k, 0] * waves[2]
    for s in range(y.size):
        out[s] = y[program.follows[s]] if program.follows[s] >= 0 else force[program.rows[s], 0]


@kernel
def _integrate(program, parts, times, start, tolerance, scale, limit, nodes, stages, error, dense, out):
    """Dormand-Prince 5(4) with fourth-order dense output at ``times``; returns the number of samples written."""
    lanes = row_of_lanes(parts, WIDTH)
    fill(0, 1.0, parts, lanes)
    room, waves = room_for(program, lanes), np.empty(parts.inputs.shape[2])
    states = start.size
    k = np.empty((7, states))
    y, stage, new = start.copy(), np.empty(states), np.empty(states)
    time, written = times[0], 0
    h = 0.01 / parts.frequency[0]
    _derivative(program, lanes, time, y, waves, room, k[0])
    # Seven stages k_j = f(t + c_j h, y + h sum a_ji k_i); the last one stands at the new point and is the next step's first.
    # h sum e_j k_j is the difference of the orders 5 and 4: the step is taken when it is within the tolerance and h is changed
    # by 0.9 (tolerance/difference)^(1/5), within a fifth and five times.
    while written < times.size:
        if h < 1e-12 * (1.0 + abs(time)):
            return written
        for j in range(1, 7):
            for s in range(states):
                stage[s] = y[s]
                for i in range(j):
                    stage[s] += h * stages[j, i] * k[i, s]
            _derivative(program, lanes, time + nodes[j] * h, stage, waves, room, k[j])
        size = 0.0
        for s in range(states):
            new[s] = stage[s]
            estimate = 0.0
            for j in range(7):
                estimate += h * error[j] * k[j, s]
            allowed = tolerance * max(scale[s], abs(y[s]), abs(new[s]))
            size = max(size, abs(estimate) / allowed)
        if not size <= 1.0:
            h *= max(0.2, 0.9 * size**-0.2) if size < 1e300 else 0.2
            continue
        while written < times.size and times[written] <= time + h * (1.0 + 1e-12):
            # Between the ends y + x (D + (1 - x)(b + x (t + (1 - x) c))): the cubic of Hermite of both ends and slopes, and a
            # quartic term c from the stages [DormandPrince80].
            x = (times[written] - time) / h
            for s in range(states):
                difference = new[s] - y[s]
                bspl = h * k[0, s] - difference
                tail = difference - h * k[6, s] - bspl
                curve = 0.0
                for j in range(7):
                    curve += h * dense[j] * k[j, s]
                out[written, s] = y[s] + x * (difference + (1 - x) * (bspl + x * (tail + (1 - x) * curve)))
            written += 1
        time += h
        for s in range(states):
            y[s] = new[s]
            k[0, s] = k[6, s]
        if abs(y[program.displacements[1]]) > limit:
            return written
        h *= min(5.0, max(0.2, 0.9 * (size + 1e-10) ** -0.2))
    return written


def _rudder_angle(autopilot: Autopilot, states: Floats) -> Floats:
    """Rudder angle (t,) along a history (t, 5 or 6) [rad]."""
    if autopilot.lag > 0:
        return states[:, RUDDER]
    return np.asarray(-autopilot.gain * states[:, HEADING] - autopilot.rate_gain * states[:, 3])


@takes(model="Model, Ship", wave="Wave, None")
def simulate(
    model: Model | Ship,
    duration: float | str,
    state0: Sequence[float | str] = (0.0, 0.0, 0.0, 0.0),
    step: float | str | None = None,
    tolerance: float = 1e-9,
    *,
    wave: Wave | None = None,
    speed: float | str = 0.0,
    heading: float | str = 180.0,
    modes: Modes = "three",
) -> xr.Dataset:
    """Motion in time from a given start, by integrating the full equations.

    Parameters
    ----------
    model : Model or Ship  of a ship give the wave, speed and heading beside it
    duration : float       [s]; here and below numbers, or text with a unit: "5min", "10 deg"
    state0 : (4,) float    v [m/s], phi [rad], p, r [rad/s] at time 0; with an autopilot psi and, with a lag, delta may follow
                           [rad], 0 when left out
    step : float           between output samples [s]; by default 1/60 of the wave's period
    tolerance : float      relative error allowed in one step
    wave, speed, heading   of a ship: a `Wave`, U [m/s] and mu [deg]
    modes : str            "three": sway, roll and yaw as `equations` has them; "six": with heave and pitch, the pressure of the
                           wave on the whole hull; see `simulate_on_course`

    Returns
    -------
    xarray.Dataset         sway_velocity [m/s], roll [deg], roll_rate, yaw_rate [deg/s] over time [s], with an
                           autopilot heading and rudder [deg] off course and amidships; NaN after a capsize,
                           whose time, to a sample, is in the attribute ``capsize_time`` [s]; ``capsize_angle`` [deg]
                           and ``capsize_reason`` say which limit it passed

    Raises
    ------
    InputError             a duration, step or tolerance that is not positive, a start of finite numbers too few or many

    Notes
    -----
    Explicit Runge-Kutta of order 5 with an embedded error estimate and dense output of order 4; stops at the model's
    ``capsize_limit``.  Source: [H71] eq. (3), [DormandPrince80].  Valid: small yaw, roll below the vanishing angle.

    Examples
    --------
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "N_r": -1.0}, 0.8, (0, 0, 0), (0, 0, 0))
    >>> trace = simulate(model, duration=2 * np.pi, state0=(0, 0.1, 0, 0), step=np.pi)
    >>> trace["roll"].values.round(4).tolist()
    [5.7296, -5.7296, 5.7296]
    """
    six = in_six(modes)
    if not isinstance(model, Model):
        if wave is None:
            raise InputError(
                "wave is missing; of a ship give one, such as wave=quartering.Wave(100.0, 2.0), with speed and heading"
            )
        if six:
            from quartering.motion.transient.simulate_six import simulate_on_course

            return simulate_on_course(model, wave, speed, heading, duration, state0, step)
        model = equations(model, wave, speed, heading)
    elif wave is not None or six or np.any(speed != 0.0) or np.any(heading != 180.0):
        raise InputError(
            "a Model has its wave, speed and heading, and three modes; give a ship in its place, such as "
            'simulate(ship, 300, wave=wave, speed=5, heading=180, modes="six")'
        )
    duration, tolerance = number(None, "duration", duration), number(None, "tolerance", tolerance)
    import xarray as xr

    interval = 2 * np.pi / model.frequency / 60 if step is None else number(None, "step", step)
    if not tolerance > 0:
        raise InputError("tolerance = 0; it is above 0; try 1e-9")
    if duration / interval > MOST_SAMPLES:
        raise InputError(
            f"duration {duration:g} s with a sample every {interval:.3g} s makes {duration / interval:.3g} samples; at most"
            f" {MOST_SAMPLES:,} are kept: give a duration of at most {MOST_SAMPLES * interval:.3g} s, or a longer step"
        )
    states = model.system.states
    if not isinstance(state0, (list, tuple, np.ndarray)) or len(state0) not in {4, states}:
        more = f", or {states} with the autopilot's (psi rad, delta rad)" if states > 4 else ""
        raise InputError(f"state0 needs four numbers (v m/s, phi rad, p rad/s, r rad/s){more}; given {state0!r}")
    start = np.array([number(None, name, given) for name, given in zip(_STATES, state0, strict=False)])
    start = np.append(start, np.zeros(states - start.size))
    times = np.arange(0.0, duration * (1 + 1e-12), interval)
    out = np.full((times.size, states), np.nan)
    # Rates in the scale of one degree; sway velocity in that of a slow walk.
    scale = np.array([0.1, 0.01, 0.01, 0.01, 0.01, 0.01])[:states]
    limit = model.capsize_limit
    given = (times, start, tolerance, scale, limit.radians, _NODES, _STAGES, _ERROR, _DENSE, out)
    written = _integrate(model.system.program, model.system.parts, *given)
    beyond = np.flatnonzero(np.abs(out[:written, 1]) > limit.radians)
    if beyond.size:
        written = int(beyond[0]) + 1
        out[written:] = np.nan
    columns = {
        "sway_velocity": (out[:, 0], "m/s", "sway velocity, positive to starboard", "v"),
        "roll": (np.degrees(out[:, 1]), "deg", "roll angle, positive starboard side down", "phi"),
        "roll_rate": (np.degrees(out[:, 2]), "deg/s", "roll rate", "p"),
        "yaw_rate": (np.degrees(out[:, 3]), "deg/s", "yaw rate, positive bow to starboard", "r"),
    }
    if model.autopilot is not None:
        angle = _rudder_angle(model.autopilot, out)
        columns["heading"] = (np.degrees(out[:, 4]), "deg", "heading off course, positive bow to starboard", "psi")
        columns["rudder"] = (np.degrees(angle), "deg", "rudder angle, positive turns bow to starboard", "delta")
    data = {
        name: ("time", values, {"units": unit, "long_name": long_name, "symbol": symbol})
        for name, (values, unit, long_name, symbol) in columns.items()
    }
    attributes: dict[str, object] = {"references": ", ".join((*model.references, "DormandPrince80"))}
    if written < times.size or beyond.size:
        attributes |= {"capsize_time": float(times[max(written - 1, 0)])}
        attributes |= {"capsize_angle": limit.angle, "capsize_reason": limit.reason}
    return xr.Dataset(data, {"time": ("time", times, {"units": "s", "long_name": "time"})}, attributes)

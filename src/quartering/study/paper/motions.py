"""The paper's motions in time: the approximate solution beside integration (Fig. 11), growing disturbances (Figs. 12, 13)."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats
from quartering.motion.of_ship import equations
from quartering.motion.steady.motion import Motion, steady_motion
from quartering.motion.transient.simulate import simulate
from quartering.stability.variational.variation import variational_harmonics

SETTLING_PERIODS = 60
"""Periods integrated before a motion counts as steady: the slowest disturbance here dies out by e^-10 and more."""

_SAMPLES = 240
"""Samples a period: a peak read from them is at most 1e-4 too low."""


def integration_check(ship: Ship, wave: Wave, speed: float, headings: ArrayLike) -> xr.Dataset:
    """Largest roll, and yaw amplitude, by the approximate solution and by integration of the full equations.

    speed: [m/s]
    headings (h,): [deg]
    Returns ``roll_peak`` [deg] and ``yaw_rate_peak`` [deg/s] over (solution, heading); "struble" (one harmonic and a
        linear third), "balance" (nine harmonics), "integration" (after 60 periods from the approximate motion's own
        start)

    Source: [H71] Fig. 11, eqs. (A-8), (A-11); integration of eq. (3).
    """
    angles = np.atleast_1d(np.asarray(headings, dtype=float))
    solutions = ("struble", "balance", "integration")
    peaks = np.full((2, len(solutions), angles.size), np.nan)
    for i, heading in enumerate(angles):
        model = equations(ship, wave, speed, float(heading))
        struble, balance = (steady_motion(model, harmonics, start="rest") for harmonics in (1, 9))
        if not struble.status.ok:
            continue
        peaks[:, 0, i], peaks[:, 1, i] = _peaks(struble), _peaks(balance)
        period = 2 * np.pi / model.frequency
        step = period / _SAMPLES
        trace = simulate(model, (SETTLING_PERIODS + 1) * period, tuple(struble.state(0.0)), step)
        last = trace.isel(time=slice(-_SAMPLES, None))
        peaks[:, 2, i] = [float(np.abs(last[name]).max()) for name in ("roll", "yaw_rate")]
    names = (("roll_peak", "deg", "largest roll"), ("yaw_rate_peak", "deg/s", "largest yaw rate"))
    data = {
        name: (("solution", "heading"), peaks[k], {"units": unit, "long_name": words})
        for k, (name, unit, words) in enumerate(names)
    }
    return xr.Dataset(data, {"solution": list(solutions), "heading": angles})


def _peaks(motion: Motion) -> Floats:
    """Largest roll [deg] and yaw rate [deg/s] of a periodic motion."""
    period = 2 * np.pi / motion.frequency
    states = motion.state(np.linspace(0.0, period, 257))
    return np.asarray(np.degrees(np.abs(states[:, [1, 3]]).max(axis=0)))


def time_check(model: Model, motion: Motion, periods: int = 3) -> xr.Dataset:
    """Roll in time by the approximate solution and by integration from rest, once that has settled.

    motion: the approximate one
    periods: shown, after the settling
    Returns ``approximate``, ``integrated`` roll [deg] over time [s], counted from the end of the settling

    The settling takes whole periods, so both have the wave's phase.  Source: [H71] Fig. 11.
    """
    period = 2 * np.pi / model.frequency
    settled = simulate(model, (SETTLING_PERIODS + periods) * period, step=period / 60)
    late = settled["roll"].isel(time=slice(60 * SETTLING_PERIODS, None))
    time = late["time"].values - SETTLING_PERIODS * period
    units = {"units": "deg"}
    return xr.Dataset(
        {
            "approximate": ("time", np.degrees(motion.state(time)[:, 1]), units | {"long_name": "approximate roll"}),
            "integrated": ("time", late.values, units | {"long_name": "integrated roll"}),
        },
        {"time": ("time", time, {"units": "s"})},
    )


def disturbance(model: Model, motion: Motion, duration: float, roll: float) -> xr.Dataset:
    """A small disturbance of a periodic motion in time, by the variational equations.

    duration: [s]
    roll: disturbance of the roll at the start [deg]; the equations are linear in it
    Returns ``sway_velocity`` [m/s], ``roll`` [deg], ``roll_rate``, ``yaw_rate`` [deg/s] over time [s]

    d/dt xi = J(t) xi, J from its exact harmonics along the motion, by an explicit Runge-Kutta method of order 8.
    Source: [H71] eq. (8), Fig. 12.
    """
    from scipy.integrate import solve_ivp

    if not (motion.status.ok and np.isfinite(duration) and duration > 0):
        raise InputError(
            f"a disturbance needs a motion (this one: {motion.status.advice}) and a duration above 0 ({duration} s given)"
        )
    system = model.system
    step = 2 if system.symmetric else 1
    highest = (system.degree - 1) * max(motion.orders)
    harmonics = tuple(range(0, highest + 1, step))
    phasors = variational_harmonics(system, motion.coefficients[None], motion.orders_with_mean, harmonics)[0]
    rates = 1j * model.frequency * np.array(harmonics)

    def slope(time: float, xi: Floats) -> Floats:
        rows = np.tensordot(np.exp(rates * time), phasors, axes=1).real @ xi
        return np.array([rows[0], xi[2], rows[1], rows[2]])

    times = np.arange(0.0, duration * (1 + 1e-12), 2 * np.pi / model.frequency / 60)
    start = np.array([0.0, np.radians(roll), 0.0, 0.0])
    found = solve_ivp(slope, (0.0, times[-1]), start, "DOP853", times, rtol=1e-9, atol=1e-12 * abs(roll)).y
    scaled = found * np.array([1.0, *np.degrees(np.ones(3))])[:, None]
    names = (("sway_velocity", "m/s"), ("roll", "deg"), ("roll_rate", "deg/s"), ("yaw_rate", "deg/s"))
    data = {
        name: ("time", scaled[i], {"units": unit, "long_name": f"disturbance of {name.replace('_', ' ')}"})
        for i, (name, unit) in enumerate(names)
    }
    return xr.Dataset(data, {"time": ("time", times, {"units": "s"})}, {"references": ", ".join(motion.references)})

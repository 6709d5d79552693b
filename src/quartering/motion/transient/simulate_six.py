"""Motion in time of a ship on a steady course with surge, heave and pitch, the wave's pressure on its whole hull."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Final

import numpy as np

from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hull.lines.section import Floats
from quartering.hull.told import condition, number
from quartering.hydro.capsize import capsize_limit
from quartering.loads.validity import warn_of_conditions
from quartering.loads.wetted_hull.floating import floating_hull
from quartering.loads.wetted_hull.pressure import Waves, immersion
from quartering.motion.steady_course.course import Course, course, surge_at, warn_across, warn_of_surge
from quartering.motion.steady_course.march import STATES, UNDER, march_in_steps

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.loads.waves import Wave

RISE: Final = 2.0
"""Periods of encounter over which the wave rises from nothing."""
_STEPS: Final = 48
_MOST: Final = 5_000_000
_COLUMNS: Final = {
    "surge": ("m", "surge of G about the place of its mean speed, positive forward", "eta1"),
    "heave": ("m", "heave of G, positive down", "eta3"),
    "pitch": ("deg", "pitch, positive bow up", "theta"),
    "sway": ("m/s", "sway velocity, positive to starboard", "v"),
    "roll": ("deg", "roll angle, positive starboard side down", "phi"),
    "roll_rate": ("deg/s", "roll rate", "p"),
    "yaw_rate": ("deg/s", "yaw rate, positive bow to starboard", "r"),
    "yaw": ("deg", "heading off course, positive bow to starboard", "psi"),
}


def simulate_on_course(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    duration: float | str,
    state0: Sequence[float | str] = (0.0, 0.0, 0.0, 0.0),
    step: float | str | None = None,
) -> xr.Dataset:
    """Surge, heave, pitch, sway, roll and yaw in time of a ship on a steady course.

    speed, heading: U [m/s], mu [deg]
    duration: [s]
    state0 (4,): v [m/s], phi [rad], p, r [rad/s] at time 0; heave and pitch begin at rest in calm water, and the wave
        rises over `RISE` periods
    step: between output samples [s]; by default 1/48 of a period
    Returns surge, heave [m], pitch [deg], sway_velocity [m/s], roll, yaw [deg], roll_rate, yaw_rate [deg/s] over time [s]; NaN
        after a capsize, as `simulate`

    Nonlinear restoring and Froude-Krylov force from the pressure over the instantaneous wetted hull; radiation at the encounter
    frequency in heave and pitch, or at the lowest above it with which they die out in calm water (low waves move the ship as
    `responses` says all the same), at half of it in sway, roll and yaw in head and following seas and at it elsewhere; linear
    diffraction; lift, drag and roll damping as `equations` has them. The mean speed is constant, surge about it that of linear
    theory.
    Source: [STF70] radiation and diffraction.  Valid: as `parametric_roll`; small yaw.
    """
    import xarray as xr

    U, mu = condition(ship, speed, heading)
    seconds = number(None, "duration", duration)
    warn_of_conditions(ship, U, wave.length)
    one = _course(ship, wave, U, mu)
    if isinstance(state0, str) or np.ndim(state0) != 1 or len(state0) != 4:
        raise InputError(f"state0 needs four numbers (v m/s, phi rad, p rad/s, r rad/s); given {state0!r}")
    start = np.zeros(len(STATES))
    told = zip((4, 5, 6, 7), ("sway_velocity", "roll", "roll_rate", "yaw_rate"), state0, strict=True)
    for place, name, given in told:
        start[place] = number(None, name, given)
    period = 2 * math.pi / float(one.numbers.omega[0])
    longest = min(period, 2 * math.pi * math.sqrt(2 * ship.hull.draught / GRAVITY)) / _STEPS
    sampled = period / _STEPS if step is None else number(None, "step", step)
    inner = max(1, math.ceil(sampled / longest))
    count = math.floor(seconds / sampled * (1 + 1e-12))
    if count * inner > _MOST:
        raise InputError(
            f"duration {seconds:g} s makes {count * inner:.3g} steps; at most {_MOST:,}: give a shorter one"
        )
    limit = capsize_limit(ship)
    history = march_in_steps(
        one, start, sampled / inner, count * inner, limit=limit.radians, half=mu in (0.0, 180.0), rise=RISE * period
    )
    state = history.state[::inner]
    times = np.asarray(sampled * np.arange(len(state)), dtype=float)
    surge = np.where(np.isfinite(state[:, 5]), np.clip(times / (RISE * period), 0, 1) * surge_at(one, times), np.nan)
    _warn_of_deck(one, times, surge, state)
    data = {}
    for name, (unit, meaning, symbol) in _COLUMNS.items():
        values = surge if name == "surge" else state[:, STATES.index(name)]
        shown = np.degrees(values) if unit.startswith("deg") else values
        key = "sway_velocity" if name == "sway" else name
        data[key] = ("time", shown, {"units": unit, "long_name": meaning, "symbol": symbol})
    said: dict[str, object] = {
        "title": f"{ship.name} on a steady course, pressure on the whole hull",
        "references": "STF70",
    }
    said |= {"speed": U, "heading": mu, "wave_length": wave.length, "wave_height": wave.height}
    ended = np.flatnonzero(~np.isfinite(state[:, 5]))
    if ended.size:
        said |= {"capsize_time": float(sampled * max(ended[0] - 1, 0)), "capsize_angle": limit.angle}
        said["capsize_reason"] = "under water" if history.outcome == UNDER else limit.reason
    return xr.Dataset(data, {"time": ("time", times, {"units": "s", "long_name": "time"})}, said)


def _warn_of_deck(one: Course, times: Floats, surge: Floats, state: Floats) -> None:
    """Say how far the water comes over the top of the offsets, looked at in 2,000 samples at the most."""
    some = np.flatnonzero(np.isfinite(state[:, 5]))[:: max(1, len(state) // 2000)]
    along, across, way = one.numbers.wave[0]
    rises = np.clip(times[some] * float(one.numbers.omega[0]) / (2 * math.pi * RISE), 0.0, 1.0)
    ones = np.ones(some.size)
    met = way * float(one.numbers.omega[0]) * times[some] - along * surge[some]
    waves = Waves(float(one.numbers.amplitude[0]) * rises, along * ones, across * ones, met)
    over = immersion(floating_hull(one.ship).hull, state[some, 5], state[some, 0], state[some, 1], waves)
    if over.size and over.max() > 0.0:
        warnings.warn(
            f"{one.ship.name}: the water comes up to {over.max():.3g} m over the top of the offsets; from there on the hull is "
            f"a watertight box; carry the sides up with depth, such as depth={1.2 * one.ship.hull.depth:.3g}, where the ship "
            "has them",
            RangeWarning,
            stacklevel=6,
        )


def _course(ship: Ship, wave: Wave, speed: float, heading: float) -> Course:
    one = course(ship, wave.wavenumber, np.array([wave.amplitude]), np.array([speed]), np.array([heading]))
    if one.slow[0]:
        raise InputError(
            f"heading {heading:g} deg, speed {speed:g} m/s, wave {wave.length:g} m: the ship keeps pace with the wave, and "
            "radiation and diffraction have no frequency; change speed or heading"
        )
    warn_across(ship, wave.wavenumber, heading)
    warn_of_surge(one)
    return one

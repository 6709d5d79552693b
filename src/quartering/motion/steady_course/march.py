"""Motion in time of a ship on a steady course, the wave's pressure on its whole hull: compiled Runge-Kutta steps.

An integration holds one matrix of the water a mode: that at the encounter frequency in heave and pitch, or at the lowest above
it with which free motion dies out (`free_heave`), and in sway, roll and yaw at the frequency they are expected to move with,
half of it in head and following seas.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner, kernel
from quartering.motion.steady_course.course import Course
from quartering.motion.steady_course.free_heave import free_course
from quartering.motion.steady_course.pressure_and_drag import instant, rooms

Floats = NDArray[np.float64]

STATES: Final = ("heave", "pitch", "heave_rate", "pitch_rate", "sway", "roll", "roll_rate", "yaw_rate", "yaw", "rudder")
"""State of a history: displacements [m, rad] and rates; sway is the velocity v, yaw the heading off course."""
AFLOAT, CAPSIZED, UNDER = range(3)
"""How a history ends: it goes on, passes the roll allowed, or leaves the tables of the sections."""


class History(NamedTuple):
    """A history of one condition.

    Parameters
    ----------
    time : (t,) float        [s]
    state : (t, 10) float    as `STATES`; NaN after its end
    outcome : int            `AFLOAT`, `CAPSIZED` or `UNDER`
    """

    time: Floats
    state: Floats
    outcome: int


def march(
    course: Course, start: Floats, periods: float, steps: int = 48, *, limit: float = np.pi / 2, half: bool = True,
    rise: float = 0.0, condition: int = 0,
) -> History:  # fmt: skip
    """Motion in time from a given state.

    start (10,): as `STATES`
    periods: of the encounter
    steps: of a period, each one kept
    limit: roll at which it ends [rad]
    half: sway, roll and yaw with the water's coefficients at half the encounter frequency
    rise: periods over which the wave rises from nothing
    condition: which of the course's conditions

    Runge-Kutta of order 4; at 48 steps a period a roll of two periods is right to 0.1 %.
    """
    h = 2 * np.pi / course.numbers.omega[condition] / steps
    return march_in_steps(
        course, start, h, round(periods * steps), limit=limit, half=half, rise=rise * steps * h, condition=condition
    )


def march_in_steps(
    course: Course, start: Floats, h: float, count: int, *, limit: float = np.pi / 2, half: bool = True, rise: float = 0.0,
    condition: int = 0,
) -> History:  # fmt: skip
    """`march` by ``count`` steps of ``h`` seconds; the wave rises over ``rise`` seconds."""
    out = np.full((count + 1, len(STATES)), np.nan)
    out[0] = start
    numbers = course.numbers._replace(amplitude=course.numbers.amplitude.copy(), force=course.numbers.force.copy())
    at = 1 if half else 2
    mass, damping, force = free_course(course.rows(np.array([condition])))
    numbers.force[condition] = force[0]
    up, across = np.linalg.inv(mass[0]), np.linalg.inv(numbers.mass[condition, at, 2:, 2:])
    damp_across = numbers.damping[condition, at, 2:, 2:].copy()
    outcome = _march(course.tables, numbers, condition, up, across, damping[0], damp_across, h, limit, rise, out)
    return History(np.asarray(h * np.arange(count + 1), dtype=float), out, int(outcome))


@kernel
def _march(tables, numbers, i, up, across, damp_up, damp_across, h, limit, rise, out):
    """Steps from row to row; returns how it ends."""
    room, force, slope, x = rooms(tables), np.empty(5), np.empty((5, 6)), np.empty(5)
    size = out.shape[1]
    y, stage, rate, total = np.empty(size), np.empty(size), np.empty(size), np.empty(size)
    full = numbers.amplitude[i]
    for n in range(out.shape[0] - 1):
        y[:] = out[n]
        total[:] = 0.0
        for j in range(4):
            ahead = 0.0 if j == 0 else h if j == 3 else 0.5 * h
            time = n * h + ahead
            for s in range(size):
                stage[s] = y[s] + ahead * rate[s] if j > 0 else y[s]
            numbers.amplitude[i] = full * min(1.0, time / rise) if rise > 0.0 else full
            x[0], x[1], x[2], x[3], x[4] = stage[0], stage[1], stage[4], stage[5], stage[7]
            if not instant(tables, numbers, i, numbers.omega[i] * time, x, stage[6], room, force, slope):
                numbers.amplitude[i] = full
                return UNDER
            motion_rates(numbers, i, up, across, damp_up, damp_across, stage, force, rate)
            for s in range(size):
                total[s] += (1.0 if j == 0 or j == 3 else 2.0) * rate[s]
        for s in range(size):
            out[n + 1, s] = y[s] + h / 6.0 * total[s]
        if not abs(out[n + 1, 5]) <= limit:
            numbers.amplitude[i] = full
            return CAPSIZED
    numbers.amplitude[i] = full
    return AFLOAT


# The state is heave, pitch, their rates, v, roll, p, r, yaw, rudder. Newton's law for two groups that exchange forces through
# the pressure alone: (heave, pitch) and (v, p, r), each with the inverse of its mass and added mass, ``up`` and ``across``, and
# the damping of radiation and lift, ``damp_up`` and ``damp_across``; ``force`` is all else. The rudder takes its order at once,
# or follows it: lag rudder' = order - rudder.
@inner
def motion_rates(numbers, i, up, across, damp_up, damp_across, y, force, rate):
    """Derivative of the state."""
    gain, yaw_gain, lag = numbers.gains[0], numbers.gains[1], numbers.gains[2]
    order = -gain * y[8] - yaw_gain * y[7]
    rudder = y[9] if lag > 0.0 else order
    for m in range(2):
        force[m] -= damp_up[m, 0] * y[2] + damp_up[m, 1] * y[3]
    for m in range(3):
        damped = damp_across[m, 0] * y[4] + damp_across[m, 1] * y[6] + damp_across[m, 2] * y[7]
        force[2 + m] += numbers.rudder[i, m] * rudder - damped
    rate[0], rate[1], rate[5], rate[8] = y[2], y[3], y[6], y[7]
    for m in range(2):
        rate[2 + m] = up[m, 0] * force[0] + up[m, 1] * force[1]
    rate[4] = across[0, 0] * force[2] + across[0, 1] * force[3] + across[0, 2] * force[4]
    rate[6] = across[1, 0] * force[2] + across[1, 1] * force[3] + across[1, 2] * force[4]
    rate[7] = across[2, 0] * force[2] + across[2, 1] * force[3] + across[2, 2] * force[4]
    rate[9] = (order - y[9]) / lag if lag > 0.0 else 0.0

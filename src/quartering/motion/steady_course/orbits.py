"""The symmetric motion of a ship in head and following seas: heave and pitch without roll, and its metacentric height."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import kernel
from quartering.motion.status import Status
from quartering.motion.steady_course.balance import (
    FOUND,
    NO_MOTION,
    OUTSIDE,
    SINGULAR,
    Harmonics,
    columns,
    periodic_harmonics,
    solved,
    symmetric_harmonics,
)
from quartering.motion.steady_course.course import HEAVE, PITCH, Course
from quartering.motion.steady_course.pressure_and_drag import instant, rooms

Floats = NDArray[np.float64]

STEPS: Final = (4, 16)
"""Into how many steps a wave is divided that Newton's method does not reach at once."""
POINTS: Final = 64
"""Points of a period at which the metacentric height is taken."""


class Orbits(NamedTuple):
    """Periodic motions of n conditions.

    Parameters
    ----------
    course : Course
    basis : Harmonics
    x : (n, m) float        Fourier coefficients; NaN where there is no motion
    status : (n,) int       `Status`
    """

    course: Course
    basis: Harmonics
    x: Floats
    status: NDArray[np.int8]

    @property
    def found(self) -> NDArray[np.bool_]:
        """Which conditions have a motion."""
        return np.isin(self.status, (Status.CONVERGED, Status.CONVERGED_BY_FOLLOWING))

    def slopes(self, phase: Floats) -> Floats:
        """Derivatives (n, t, 5, 6) of the forces by heave, pitch, sway, roll, yaw and rate of roll, at phases of the encounter.

        phase (t,): [rad]
        """
        return slopes(self.course, self.basis, self.x, phase)

    def metacentric_height(self, phase: Floats) -> Floats:
        """-dK/dphi over the weight (n, t) [m] at phases of the encounter (t,) [rad]."""
        weight = self.course.numbers.scale.prod()
        return np.asarray(-self.slopes(phase)[:, :, 3, 3] / weight)


def symmetric_orbits(course: Course, order: int = 7, samples: int = 32) -> Orbits:
    """Heave and pitch of a ship that does not roll, in head and following seas.

    order: harmonics of the encounter frequency, even and odd
    samples: of the forces in a period

    Newton's method from the linear motion; where it fails the wave is raised in steps.  Head and following seas leave port and
    starboard alike, so this motion exists whether or not it is stable.
    """
    return followed_up(course, symmetric_harmonics(order, samples))


def forced_motions(course: Course, order: int = 5, samples: int = 32) -> Orbits:
    """Motions of one wave period in all five modes: those an oblique sea forces.

    order: harmonics of the encounter frequency, even and odd
    samples: of the forces in a period

    As `symmetric_orbits`; the course is held: an autopilot finds a mean heading, and without one a mean moment in yaw
    stands for the rudder.
    """
    return followed_up(course, periodic_harmonics(order, samples))


def followed_up(course: Course, basis: Harmonics) -> Orbits:
    """Motions of all conditions: from the linear one, or by raising the wave."""
    start = linear_start(course, basis)
    x, outcome = solved(course, basis, start)
    status = np.full(course.count, Status.CONVERGED, dtype=np.int8)
    for i in np.flatnonzero((outcome != FOUND) & ~course.slow):
        x[i], outcome[i], status[i] = _raised(course.rows(np.array([i])), basis)
    status = _status(outcome, course.slow, status)
    x[~np.isin(status, (Status.CONVERGED, Status.CONVERGED_BY_FOLLOWING))] = np.nan
    return Orbits(course, basis, x, status)


def climbed(course: Course, amplitudes: Floats, basis: Harmonics) -> Orbits:
    """Motions of every condition at rising amplitudes of the wave, each from the one before: conditions times amplitudes rows.

    course: n conditions
    amplitudes (k,): rising [m]
    Returns n k rows, the amplitudes of one condition beside each other; where a motion is not reached from the one
        before or from the linear one, the status says so
    """
    n, count = course.count, amplitudes.size
    linear = linear_start(course.at_amplitude(np.ones(n)), basis)
    x, outcome = np.empty((count, n, linear.shape[1])), np.empty((count, n), dtype=np.int64)
    for k, a in enumerate(amplitudes):
        at = course.at_amplitude(np.full(n, a))
        start = a * linear
        if k > 0:
            before = outcome[k - 1] == FOUND
            start[before] = x[k - 1][before] * (a / amplitudes[k - 1])
        x[k], outcome[k] = solved(at, basis, start)
        again = np.flatnonzero(outcome[k] != FOUND)
        if k > 0 and again.size:
            x[k][again], outcome[k][again] = solved(at.rows(again), basis, a * linear[again])
    grid = course.rows(np.repeat(np.arange(n), count)).at_amplitude(np.tile(amplitudes, n))
    coefficients = np.ascontiguousarray(x.transpose(1, 0, 2).reshape(n * count, -1))
    status = _status(outcome.T.ravel(), grid.slow, np.full(n * count, Status.CONVERGED_BY_FOLLOWING, dtype=np.int8))
    coefficients[~np.isin(status, (Status.CONVERGED, Status.CONVERGED_BY_FOLLOWING))] = np.nan
    return Orbits(grid, basis, coefficients, status)


def _status(outcome: NDArray[np.int64], slow: NDArray[np.bool_], found: NDArray[np.int8]) -> NDArray[np.int8]:
    """What Newton's method came to, in the words of every door."""
    status = found.copy()
    for code, said in (
        (NO_MOTION, Status.NO_MOTION_FOUND),
        (OUTSIDE, Status.BEYOND_THE_DECK),
        (SINGULAR, Status.SINGULAR),
    ):
        status[outcome == code] = said
    status[slow] = Status.ENCOUNTER_FREQUENCY_NEAR_ZERO
    return status


def _raised(one: Course, basis: Harmonics) -> tuple[Floats, int, Status]:
    """One condition's motion with the wave raised in steps from nothing."""
    a = float(one.numbers.amplitude[0])
    outcome = np.array([FOUND])
    x = np.zeros((1, basis.sizes[0] * 2 + basis.sizes[1] * 3))
    for steps in STEPS:
        x = np.zeros_like(x)
        for k in range(1, steps + 1):
            x, outcome = solved(one.at_amplitude(np.array([a * k / steps])), basis, x * (k / max(k - 1, 1)))
            if outcome[0] != FOUND:
                break
        if outcome[0] == FOUND:
            return x[0], FOUND, Status.CONVERGED_BY_FOLLOWING
    return x[0], int(outcome[0]), Status.NO_MOTION_FOUND


def linear_start(course: Course, basis: Harmonics) -> Floats:
    """Heave and pitch of a low wave, scaled to each height: coefficients (n, m)."""
    low = course.at_amplitude(np.full(course.count, 1e-3 * course.draught))
    width = 2 * basis.sizes[0] + 3 * basis.sizes[1]
    x, outcome = solved(low, basis, np.zeros((course.count, width)))
    x[outcome != FOUND] = 0.0
    return np.asarray(x * (course.numbers.amplitude / low.numbers.amplitude)[:, None])


def slopes(course: Course, basis: Harmonics, x: Floats, phase: Floats) -> Floats:
    """Derivatives (n, t, 5, 6) of the forces along motions (n, m) at phases (t,)."""
    up, (across, rate) = columns(basis.vertical, phase)[0], columns(basis.lateral, phase)
    out = np.empty((course.count, phase.size, 5, 6))
    if 0 in basis.lateral:  # the mean of yaw is no rate of turn
        x = x.copy()
        x[:, 2 * basis.sizes[0] + 2 * basis.sizes[1]] = 0.0
    _slopes(course.tables, course.numbers, up, across, rate, phase, np.ascontiguousarray(x), out)
    return out


@kernel
def _slopes(tables, numbers, up, across, rate, phase, x, out):  # type: ignore[no-untyped-def]
    """Slopes of the forces of n motions at t phases; NaN outside the tables."""
    room, state, force = rooms(tables), np.empty(5), np.empty(5)
    ups, sides = up.shape[1], across.shape[1]
    for i in range(x.shape[0]):
        for n in range(phase.size):
            state[:] = 0.0
            p = 0.0
            for c in range(ups):
                state[0] += up[n, c] * x[i, c]
                state[1] += up[n, c] * x[i, ups + c]
            for c in range(sides):
                state[2] += across[n, c] * x[i, 2 * ups + c]
                state[3] += across[n, c] * x[i, 2 * ups + sides + c]
                state[4] += across[n, c] * x[i, 2 * ups + 2 * sides + c]
                p += numbers.omega[i] * rate[n, c] * x[i, 2 * ups + sides + c]
            if not instant(tables, numbers, i, phase[n], state, p, room, force, out[i, n]):
                out[i, n, :, :] = np.nan


def amplitudes(orbits: Orbits) -> Floats:
    """Amplitudes (n, 2, h) of the harmonics of heave [m] and pitch [rad]; the mean comes first, with its sign."""
    parts = orbits.basis.parts(orbits.x)
    made = []
    for mode in (HEAVE, PITCH):
        pairs = parts[mode][:, 1:].reshape(orbits.course.count, -1, 2)
        made.append(np.concatenate([parts[mode][:, :1], np.hypot(pairs[..., 0], pairs[..., 1])], axis=1))
    return np.stack(made, axis=1)

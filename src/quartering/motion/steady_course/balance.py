"""Harmonic balance of a ship on a steady course: residual, Jacobian and Newton's method on many conditions, compiled.

The unknowns are Fourier coefficients of the five modes, every mode over harmonics of its own: heave and pitch over those of
the encounter, sway, roll and yaw over none (the symmetric motion), over odd multiples of half the encounter frequency (the
motion of two periods, phi(t + T) = -phi(t), h(t + T) = h(t): half of the unknowns that a motion of two periods would have, and
samples of one period suffice) or over all of them (an oblique sea). Forces are sampled; each harmonic takes the water's
coefficients at its own frequency.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner, kernel, maker, summing
from quartering.motion.steady_course.course import Course
from quartering.motion.steady_course.pressure_and_drag import instant, rooms

Floats = NDArray[np.float64]

FOUND, NO_MOTION, OUTSIDE, SINGULAR = range(4)
"""What Newton's method comes to: a motion, none, a section deeper than its table or heeled beyond it, no way on."""
TOLERANCE: Final = 1e-10
"""Residual over the forces of the ship's own size at which a motion is found."""
_ITERATIONS: Final = 40
_LONGEST: Final = np.array([0.3, 0.05, 3.0, 0.15, 0.05])
"""Longest step of a coefficient: in heave of the draught, in pitch, roll and yaw in rad and rad/s, in sway in m/s."""


class Harmonics(NamedTuple):
    """Which harmonics the modes have, and their samples.

    Parameters
    ----------
    vertical, lateral : (h,) int        of heave and pitch, and of sway, roll and yaw, in halves of the encounter frequency
    phase : (n,) float                  samples of the encounter's phase [rad]
    up, across, turn : (n, c) float     harmonics of heave and pitch, of sway and roll, and of yaw, at the samples
    rate : (n, c) float                 derivative of those of roll by the phase
    onto_up, onto_across : (c, n)       projections onto them
    by_rows : of (c, n)                 up, across, turn and rate, a harmonic a row
    odd : (m,) bool                     unknowns of odd multiples of half the encounter: of a motion of two periods alone
    """

    vertical: NDArray[np.int64]
    lateral: NDArray[np.int64]
    phase: Floats
    up: Floats
    across: Floats
    turn: Floats
    rate: Floats
    onto_up: Floats
    onto_across: Floats
    by_rows: tuple[Floats, Floats, Floats, Floats]
    odd: NDArray[np.bool_]

    @property
    def sizes(self) -> tuple[int, int]:
        """Unknowns of a vertical and of a lateral mode."""
        return self.up.shape[1], self.across.shape[1]

    @property
    def of_one_period(self) -> Harmonics:
        """The harmonics of the encounter alone, at as many samples of a period."""
        vertical, lateral = (tuple(int(o) for o in orders if o % 2 == 0) for orders in (self.vertical, self.lateral))
        return harmonics(vertical, lateral, round(2 * np.pi / float(self.phase[1] - self.phase[0])))

    def parts(self, x: Floats) -> tuple[Floats, ...]:
        """Coefficients of heave, pitch, sway, roll and yaw in one motion (m,) or many (n, m)."""
        up, across = self.sizes
        return tuple(np.split(x, [up, 2 * up, 2 * up + across, 2 * up + 2 * across], axis=-1))


def columns(orders: NDArray[np.int64], phase: Floats) -> tuple[Floats, Floats]:
    """1, cos and sin of multiples of half a phase, and their derivatives by the phase."""
    values: list[Floats] = []
    rates: list[Floats] = []
    for order in orders:
        nu = 0.5 * float(order)
        c, s = np.cos(nu * phase), np.sin(nu * phase)
        values += [c] if order == 0 else [c, s]
        rates += [0 * c] if order == 0 else [-nu * s, nu * c]
    shape = (phase.size, len(values))
    empty = np.zeros(shape)
    return (np.stack(values, axis=1), np.stack(rates, axis=1)) if values else (empty, empty)


@lru_cache(maxsize=32)
def harmonics(vertical: tuple[int, ...], lateral: tuple[int, ...], samples: int) -> Harmonics:
    """Harmonics of the modes, in halves of the encounter frequency.

    vertical, lateral: (0, 2, 4, ..) and () for the symmetric motion; with lateral (1, 3, ..) the motion of two periods;
        (0, 2, 4, ..) twice for one period without symmetry, (0, 1, 2, ..) for two
    samples: of one period of the encounter
    """
    mixed = any(o % 2 for o in vertical) or len({o % 2 for o in lateral}) == 2
    count = samples * (2 if mixed else 1)
    phase = 2 * np.pi * np.arange(count) / samples
    first, second = np.array(vertical, dtype=np.int64), np.array(lateral, dtype=np.int64)
    (up, _), (across, rate) = columns(first, phase), columns(second, phase)
    turn = across.copy()
    if 0 in lateral:  # on a steady course the mean of yaw is a heading, or a moment that holds it
        turn[:, 0] = 0.0

    def onto(values: Floats, orders: NDArray[np.int64]) -> Floats:
        share = np.concatenate([np.full(1 if o == 0 else 2, 1.0 if o == 0 else 2.0) for o in orders] or [np.empty(0)])
        return np.ascontiguousarray((values * share / count).T)

    projections = onto(up, first), onto(across, second)
    up_rows, across_rows, turn_rows, rate_rows = (np.ascontiguousarray(part.T) for part in (up, across, turn, rate))
    by_rows = up_rows, across_rows, turn_rows, rate_rows
    up_odd, across_odd = (np.repeat(orders % 2 == 1, np.where(orders == 0, 1, 2)) for orders in (first, second))
    odd = np.concatenate([up_odd, up_odd, across_odd, across_odd, across_odd])
    return Harmonics(first, second, phase, up, across, turn, rate, *projections, by_rows, odd)


def symmetric_harmonics(order: int = 7, samples: int = 32) -> Harmonics:
    """Heave and pitch over harmonics 0 to ``order`` of the encounter.

    >>> symmetric_harmonics(3).vertical.tolist()
    [0, 2, 4, 6]
    """
    return harmonics(tuple(range(0, 2 * order + 1, 2)), (), samples)


def doubled_harmonics(order: int = 7, lateral: int = 5, samples: int = 48) -> Harmonics:
    """Heave and pitch as in the symmetric motion, with odd multiples of half the encounter in sway, roll and yaw."""
    return harmonics(tuple(range(0, 2 * order + 1, 2)), tuple(range(1, 2 * lateral, 2)), samples)


def periodic_harmonics(order: int = 5, samples: int = 32) -> Harmonics:
    """All harmonics of the encounter in every mode: the forced motion of an oblique sea.

    >>> periodic_harmonics(2).lateral.tolist()
    [0, 2, 4]
    """
    orders = tuple(range(0, 2 * order + 1, 2))
    return harmonics(orders, orders, samples)


def oblique_doubled_harmonics(order: int = 4, samples: int = 32) -> Harmonics:
    """All multiples of half the encounter in every mode: motions of two periods in an oblique sea.

    Examples
    --------
    >>> oblique_doubled_harmonics(2).lateral.tolist()
    [0, 1, 2, 3, 4]
    """
    orders = tuple(range(2 * order + 1))
    return harmonics(orders, orders, samples)


def force_scale(course: Course) -> Floats:
    """Forces of the ship's own size (5,): what a residual is measured by."""
    weight = float(course.numbers.scale[0] * course.numbers.scale[1])
    return weight * np.array([1.0, course.length, 1.0, course.draught, course.length])


def solved(course: Course, basis: Harmonics, start: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """Motions of all conditions by Newton's method.

    start (n, m): first guess
    Returns x (n, m): coefficients; where none is found the last try; outcome (n,): `FOUND`, `NO_MOTION`, `OUTSIDE` or
        `SINGULAR`
    """
    x = np.array(start, dtype=float)
    outcome = np.zeros(course.count, dtype=np.int64)
    longest = _LONGEST * np.array([course.draught, 1.0, 1.0, 1.0, 1.0])
    _solve(course.tables, course.numbers, basis, force_scale(course), longest, TOLERANCE, x, outcome)
    return x, outcome


def balance(course: Course, i: int, basis: Harmonics, x: Floats, derive: bool = True) -> tuple[Floats, Floats, bool]:
    """Residual (m,) and Jacobian (m, m) of one condition over `force_scale`, and whether the hull stays in its tables.

    derive: with the Jacobian, which is left unfinished otherwise
    """
    residual, jacobian = np.zeros(x.size), np.zeros((x.size, x.size))
    arguments = (course.tables, course.numbers, i, basis, np.ascontiguousarray(x), force_scale(course))
    inside = _balance(*arguments, residual, jacobian, derive)
    return residual, jacobian, bool(inside)


@kernel
def _balance(tables, numbers, i, basis, x, scale, residual, jacobian, derive):
    """Residual and Jacobian of one condition."""
    room = (
        rooms(tables),
        np.empty((5, basis.phase.size)),
        np.empty((5, 6, basis.phase.size)),
        np.empty((basis.phase.size,)),
    )
    return _assemble(tables, numbers, i, basis, x, scale, room, residual, jacobian, derive)


@kernel
def _solve(tables, numbers, basis, scale, longest, tolerance, x, outcome):
    """Newton's method on each condition, steps no longer than ``longest``, halved where the hull leaves its tables."""
    m = x.shape[1]
    residual, jacobian, trial, step = np.empty(m), np.empty((m, m)), np.empty(m), np.empty(m)
    samples = basis.phase.size
    room = (rooms(tables), np.empty((5, samples)), np.empty((5, 6, samples)), np.empty((samples,)))
    for i in range(x.shape[0]):
        if not _assemble(tables, numbers, i, basis, x[i], scale, room, residual, jacobian, True):
            outcome[i] = OUTSIDE
            continue
        outcome[i] = NO_MOTION
        for _ in range(_ITERATIONS):
            if np.abs(residual).max() < tolerance:
                outcome[i] = FOUND
                break
            step[:] = residual
            if not _solved_in_place(jacobian, step):
                outcome[i] = SINGULAR
                break
            by = _shortened(basis, step, longest)
            inside = False
            for _ in range(6):
                trial[:] = x[i] - by * step
                inside = _assemble(tables, numbers, i, basis, trial, scale, room, residual, jacobian, True)
                if inside:
                    break
                by *= 0.5
            if not inside:
                outcome[i] = OUTSIDE
                break
            x[i] = trial


@inner
def _shortened(basis, step, longest):
    """Factor that brings the largest coefficient of a step to what is allowed."""
    up, across = basis.up.shape[1], basis.across.shape[1]
    by, at = 1.0, 0
    for mode in range(5):
        for _ in range(up if mode < 2 else across):
            by = min(by, longest[mode] / max(abs(step[at]), 1e-300))
            at += 1
    return by


# With u(t) = c cos nu t + s sin nu t, a phasor c - i s, and an impedance Z the force is  (Zr c + Zi s) cos + (Zr s - Zi c) sin.
# Z = (i nu M + B) i nu for a displacement, i nu M + B for a velocity. The rudder turns with
# -(gain + i nu rate)/(1 + i nu lag) psi.
@inner
def _assemble(tables, numbers, i, basis, x, scale, room, residual, jacobian, derive):
    """Residual (m,) and Jacobian (m, m) over the scale; False where a section leaves its table."""
    places, force, slope, weighted = room
    up, across = basis.up.shape[1], basis.across.shape[1]
    lateral = 3 if across > 0 else 0
    if not _sampled(tables, numbers, i, basis, x, places, force, slope):
        return False
    residual[:] = 0.0
    jacobian[:] = 0.0
    _linear(numbers, i, basis.vertical, 0, 2, up, 0, jacobian)
    _linear(numbers, i, basis.lateral, 2, 3, across, 2 * up, jacobian)
    for a in range(x.size):
        total = 0.0
        for b in range(x.size):
            total += jacobian[a, b] * x[b]
        residual[a] = total
    for row in range(2 + lateral):
        first = row * up if row < 2 else 2 * up + (row - 2) * across
        onto = basis.onto_up if row < 2 else basis.onto_across
        for a in range(onto.shape[0]):
            for n in range(onto.shape[1]):
                residual[first + a] -= onto[a, n] * force[row, n]
        for column in range(2 + lateral if derive else 0):
            at = column * up if column < 2 else 2 * up + (column - 2) * across
            values = basis.by_rows[0] if column < 2 else basis.by_rows[2] if column == 4 else basis.by_rows[1]
            _project(onto, slope[row, column], 1.0, values, first, at, weighted, jacobian)
            if column == 3:
                _project(onto, slope[row, 5], numbers.omega[i], basis.by_rows[3], first, at, weighted, jacobian)
        for a in range(onto.shape[0]):
            residual[first + a] /= scale[row]
            for b in range(x.size):
                jacobian[first + a, b] /= scale[row]
    return True


@summing
def _project(onto, slope, by, values, first, at, weighted, jacobian):
    """Subtract from a block of the Jacobian what a slope at the samples does to one mode with the harmonics of another."""
    for a in range(onto.shape[0]):
        for n in range(onto.shape[1]):
            weighted[n] = onto[a, n] * slope[n] * by
        for b in range(values.shape[0]):
            total = 0.0
            for n in range(onto.shape[1]):
                total += weighted[n] * values[b, n]
            jacobian[first + a, at + b] -= total


@maker
def _sampled(tables, numbers, i, basis, x, places, force, slope):
    """Forces and slopes at all samples of a motion."""
    up, across = basis.up.shape[1], basis.across.shape[1]
    state, one, change = np.zeros(5), np.empty(5), np.empty((5, 6))
    for n in range(basis.phase.size):
        state[:] = 0.0
        rate = 0.0
        for c in range(up):
            state[0] += basis.up[n, c] * x[c]
            state[1] += basis.up[n, c] * x[up + c]
        for c in range(across):
            state[2] += basis.across[n, c] * x[2 * up + c]
            state[3] += basis.across[n, c] * x[2 * up + across + c]
            state[4] += basis.turn[n, c] * x[2 * up + 2 * across + c]
            rate += numbers.omega[i] * basis.rate[n, c] * x[2 * up + across + c]
        if not instant(tables, numbers, i, basis.phase[n], state, rate, places, one, change):
            return False
        for m in range(5):
            force[m, n] = one[m]
            for c in range(6):
                slope[m, c, n] = change[m, c]
    return True


@inner
def _linear(numbers, i, orders, mode, modes, width, first, jacobian):
    """Impedances of a block of modes, each over its harmonics."""
    at = 0
    for o in range(orders.size):
        nu = 0.5 * orders[o] * numbers.omega[i]
        for row in range(modes):
            for column in range(modes):
                m, c = mode + row, mode + column
                z = 1j * nu * numbers.mass[i, orders[o], m, c] + numbers.damping[i, orders[o], m, c]
                if c != 2 and c != 4:
                    z *= 1j * nu
                if c == 4 and numbers.gains[0] + numbers.gains[1] > 0.0:
                    z += _rudder(numbers, i, m, nu)
                if (
                    c == 4 and orders[o] == 0
                ):  # no mean rate of turn: a heading under an autopilot, or a moment that holds it
                    z = 0.0j
                    if numbers.gains[0] > 0.0:
                        z = numbers.rudder[i, m - 2] * numbers.gains[0] + 0.0j
                    elif m == 4:
                        z = numbers.scale[0] * numbers.scale[1] + 0.0j
                a, b = first + row * width + at, first + column * width + at
                if orders[o] == 0:
                    jacobian[a, b] = z.real
                else:
                    jacobian[a, b], jacobian[a, b + 1] = z.real, z.imag
                    jacobian[a + 1, b], jacobian[a + 1, b + 1] = -z.imag, z.real
        at += 1 if orders[o] == 0 else 2


@inner
def _rudder(numbers, i, mode, nu):
    """What the rudder holds against a rate of turn."""
    heading = numbers.gains[0] / (1j * nu) if nu > 0.0 else 0.0j
    return numbers.rudder[i, mode - 2] * (heading + numbers.gains[1]) / (1.0 + 1j * nu * numbers.gains[2])


@inner
def _solved_in_place(matrix, right):
    """Gauss' elimination with the largest pivot of each column, columns in their own size; False where there is none."""
    n = right.size
    for k in range(n):
        best, size = k, abs(matrix[k, k])
        for r in range(k + 1, n):
            if abs(matrix[r, k]) > size:
                best, size = r, abs(matrix[r, k])
        if not size > 0.0:
            return False
        if best != k:
            for c in range(k, n):
                matrix[k, c], matrix[best, c] = matrix[best, c], matrix[k, c]
            right[k], right[best] = right[best], right[k]
        for r in range(k + 1, n):
            by = matrix[r, k] / matrix[k, k]
            if by != 0.0:
                for c in range(k + 1, n):
                    matrix[r, c] -= by * matrix[k, c]
                right[r] -= by * right[k]
    for k in range(n - 1, -1, -1):
        for c in range(k + 1, n):
            right[k] -= matrix[k, c] * right[c]
        right[k] /= matrix[k, k]
    return True

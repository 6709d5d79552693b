"""Motions of two wave periods beyond the loss of stability in roll: where they begin, and every one of them by continuation.

In head and following seas a motion of two periods has phi(t + T) = -phi(t) and h(t + T) = h(t), so it holds odd multiples of
half the encounter frequency in sway, roll and yaw beside the harmonics of the encounter in heave and pitch; in an oblique sea
every mode holds both. On a motion of one period the Jacobian falls apart into even and odd multiples, and a motion of two
periods begins where the block of the odd ones is singular, which is a multiplier -1. From there the branch is followed
through its folds over the height of the wave: a march in time finds one of several stable motions, or lingers near one that
has just ceased to be.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.piecewise import zero
from quartering.motion.steady_course.balance import FOUND, Harmonics, balance, doubled_harmonics, solved
from quartering.motion.steady_course.course import ROLL, Course
from quartering.motion.steady_course.orbits import climbed

Floats = NDArray[np.float64]

LARGEST_ROLL: Final = np.radians(60.0)
"""Roll at which a branch is left [rad]."""
_SIZES: Final = np.array([0.3, 0.1, 2.0, 0.3, 0.1])
"""Coefficients of one unit of length along a branch: heave in draughts, pitch [rad], sway [m/s], roll [rad], yaw [rad/s]."""
_FIRST, _LONGEST, _SHORTEST = 0.03, 0.25, 1e-4
_MOST: Final = 250
_ONSET: Final = np.radians(0.5)


@dataclass(frozen=True, eq=False)
class Doubled:
    """A branch of motions of two periods over the amplitude of the wave.

    Parameters
    ----------
    course : Course          one condition
    basis : Harmonics
    amplitude : (k,) float   of the wave, in the order of the branch; the first is where it begins [m]
    x : (k, m) float         Fourier coefficients
    """

    course: Course
    basis: Harmonics
    amplitude: Floats
    x: Floats

    @property
    def roll(self) -> Floats:
        """Largest roll of each motion (k,) [rad]."""
        return largest_roll(self.basis, self.x)

    @property
    def ends_small(self) -> bool:
        """Does it come back to a motion of one period?"""
        return bool(doubled_roll(self.basis, self.x[-1])[0] < 0.05)

    def at(self, amplitude: float) -> Floats:
        """Motions (j, m) of the branch in one wave, in the order of the branch."""
        beyond = self.amplitude - amplitude
        found: list[Floats] = []
        for k in np.flatnonzero(beyond[:-1] * beyond[1:] <= 0.0):
            t = beyond[k] / (beyond[k] - beyond[k + 1]) if beyond[k] != beyond[k + 1] else 0.0
            guess = (1 - t) * self.x[k] + t * self.x[k + 1]
            x, outcome = solved(self.course.at_amplitude(np.array([amplitude])), self.basis, guess[None])
            new = outcome[0] == FOUND and doubled_roll(self.basis, x)[0] > 1e-4
            if new and not any(np.abs(x[0] - one).max() < 1e-6 for one in found):
                found.append(x[0])
        return np.array(found).reshape(-1, self.x.shape[1])


def largest_roll(basis: Harmonics, x: Floats) -> Floats:
    """Largest roll (k,) of motions (k, m) [rad]."""
    roll = basis.parts(np.atleast_2d(x))[ROLL]
    mixed = {int(o) % 2 for o in basis.lateral} == {0, 1}
    phase = np.linspace(0.0, 4 * np.pi if mixed else 2 * np.pi, 361 if mixed else 181)
    values = np.zeros((roll.shape[0], phase.size))
    at = 0
    for order in basis.lateral:
        nu = 0.5 * float(order)
        if order == 0:
            values += roll[:, [at]]
            at += 1
            continue
        values += roll[:, [at]] * np.cos(nu * phase) + roll[:, [at + 1]] * np.sin(nu * phase)
        at += 2
    return np.asarray(np.abs(values).max(axis=1))


def doubled_roll(basis: Harmonics, x: Floats) -> Floats:
    """Size (k,) of the roll of two periods in motions (k, m): root of the sum of squares of its odd coefficients [rad]."""
    rolls = basis.parts(np.where(basis.odd, np.atleast_2d(x), 0.0))[ROLL]
    return np.asarray(np.sqrt((rolls**2).sum(axis=1)))


def onsets(course: Course, amplitudes: Floats, basis: Harmonics | None = None) -> list[tuple[float, Floats, Floats]]:
    """Wave amplitudes at which motions of two periods begin, of one condition.

    course: one condition
    amplitudes (n,): rising, between which a change of the determinant's sign is looked for [m]
    basis: of two periods
    Returns amplitude, motion of one period (m,) and direction (m,), coefficients of two periods
    """
    basis = doubled_harmonics() if basis is None else basis
    orbits = climbed(course, amplitudes, basis.of_one_period)
    ladder, odd = orbits.course, basis.odd
    whole = np.zeros((amplitudes.size, odd.size))
    whole[:, ~odd] = orbits.x
    signs = np.array([_sign(ladder, i, basis, whole[i]) if orbits.found[i] else 0.0 for i in range(amplitudes.size)])
    begun = []
    for i in np.flatnonzero(signs[:-1] * signs[1:] < 0):
        a = _root(course, basis, (amplitudes[i], amplitudes[i + 1]), (whole[i], whole[i + 1]))
        x = _one_period_at(course, basis, a, whole[i])
        if x is None:
            continue
        block = _odd_block(course.at_amplitude(np.array([a])), 0, basis, x)
        direction = np.zeros(x.size)
        direction[odd] = np.linalg.svd(block)[2][-1]
        begun.append((a, x, direction))
    return begun


def _odd_block(course: Course, i: int, basis: Harmonics, x: Floats) -> Floats:
    odd = basis.odd
    return balance(course, i, basis, x)[1][np.ix_(odd, odd)]


def _sign(course: Course, i: int, basis: Harmonics, x: Floats) -> float:
    return float(np.linalg.slogdet(_odd_block(course, i, basis, x))[0])


def _one_period_at(course: Course, basis: Harmonics, amplitude: float, guess: Floats) -> Floats | None:
    """The motion of one period in a wave, as coefficients of two."""
    odd = basis.odd
    x, outcome = solved(course.at_amplitude(np.array([amplitude])), basis.of_one_period, guess[None, ~odd])
    if outcome[0] != FOUND:
        return None
    whole = np.zeros(odd.size)
    whole[~odd] = x[0]
    return whole


def _root(course: Course, basis: Harmonics, between: tuple[float, float], ends: tuple[Floats, Floats]) -> float:
    """Amplitude at which the odd block is singular, by its determinant over that at one end."""
    low, high = between
    reference = np.linalg.slogdet(_odd_block(course.at_amplitude(np.array([low])), 0, basis, ends[0]))[1]

    def determinant(a: float) -> float:
        t = (a - low) / (high - low)
        x = _one_period_at(course, basis, a, (1 - t) * ends[0] + t * ends[1])
        if x is None:
            return float("nan")
        sign, size = np.linalg.slogdet(_odd_block(course.at_amplitude(np.array([a])), 0, basis, x))
        return float(sign * np.exp(np.clip(size - reference, -60.0, 60.0)))

    return zero(determinant, low, high, xtol=1e-7 * high, rtol=1e-10)


def doubled_branch(
    course: Course, onset: tuple[float, Floats, Floats], top: float, basis: Harmonics | None = None
) -> Doubled:
    """The branch of motions of two periods that begins at one onset.

    course: one condition
    one of `onsets`
    top: amplitude of the wave up to which it is followed [m]
    basis: of two periods
    Returns followed until the wave is higher than ``top`` or lower than nothing, the roll exceeds `LARGEST_ROLL`, or
        the hull leaves its tables

    Steps along the arc length of the branch, each corrected at right angles to its tangent; a step whose correction fails is
    halved.  Source: [Krack19] (arclength continuation).
    """
    basis = doubled_harmonics() if basis is None else basis
    path = _Path(course, basis, top)
    a, x, direction = onset
    points = [np.append(x, a)]
    roll = doubled_roll(basis, direction)[0]
    tangent = np.append(direction, 0.0) / path.sizes
    tangent /= np.linalg.norm(tangent)
    by = _ONSET / max(roll, 1e-12)
    start = path.corrected(points[0] + np.append(by * direction, 0.0), tangent)
    if start is None:
        return Doubled(course, basis, np.array([a]), x[None])
    points.append(start)
    step, tangent = _FIRST, path.tangent(start, tangent)
    while len(points) < _MOST and step > _SHORTEST:
        found = path.corrected(points[-1] + step * tangent * path.sizes, tangent)
        if found is None:
            step *= 0.5
            continue
        turned = path.tangent(found, tangent)
        if turned @ tangent < 0.8:
            step *= 0.5
            continue
        if _odd_roll(basis, found) @ _odd_roll(basis, points[-1]) < 0.0:  # back through the motion of one period
            break
        points.append(found)
        tangent, step = turned, min(_LONGEST, 1.4 * step)
        if not 0.0 < found[-1] < top or largest_roll(basis, found[:-1])[0] > LARGEST_ROLL:
            break
    made = np.array(points)
    return Doubled(course, basis, made[:, -1], made[:, :-1])


def _odd_roll(basis: Harmonics, point: Floats) -> Floats:
    return basis.parts(np.where(basis.odd, point[:-1], 0.0))[ROLL]


class _Path:
    """Points (x, a) on a branch, in units of their own."""

    def __init__(self, course: Course, basis: Harmonics, top: float) -> None:
        numbers = course.numbers._replace(amplitude=course.numbers.amplitude.copy())
        self.course, self.basis = replace(course, numbers=numbers), basis
        up, across = basis.sizes
        one = _SIZES * np.array([course.draught, 1, 1, 1, 1])
        self.sizes = np.append(np.repeat(one, [up, up, across, across, across]), 0.25 * top)
        self.small = 1e-5 * top

    def balance(self, point: Floats) -> tuple[Floats, Floats, bool]:
        """Residual (m,) and its derivatives (m, m + 1) by the scaled point."""
        self.course.numbers.amplitude[0] = point[-1]
        residual, jacobian, inside = balance(self.course, 0, self.basis, point[:-1])
        self.course.numbers.amplitude[0] = point[-1] + self.small
        higher, _, inside_too = balance(self.course, 0, self.basis, point[:-1])
        whole = np.column_stack([jacobian, (higher - residual) / self.small])
        return residual, whole * self.sizes, inside and inside_too

    def corrected(self, guess: Floats, tangent: Floats) -> Floats | None:
        """The point of the branch on the plane through a guess at right angles to the tangent."""
        point = guess.copy()
        for _ in range(8):
            residual, jacobian, inside = self.balance(point)
            if not inside:
                return None
            if np.abs(residual).max() < 1e-9:
                return point
            try:
                change = np.linalg.solve(np.vstack([jacobian, tangent]), np.append(residual, 0.0))
            except np.linalg.LinAlgError:
                return None
            if np.abs(change).max() > 2.0:
                return None
            point = point - change * self.sizes
        return None

    def tangent(self, point: Floats, before: Floats) -> Floats:
        """Unit tangent that goes on as the one before."""
        _, jacobian, _ = self.balance(point)
        found = np.linalg.solve(np.vstack([jacobian, before]), np.append(np.zeros(jacobian.shape[0]), 1.0))
        return np.asarray(found / np.linalg.norm(found))


def doubled_motions(
    course: Course, amplitude: float, top: float, rungs: int = 12, basis: Harmonics | None = None
) -> tuple[Floats, list[Doubled]]:
    """All motions of two periods in one wave, on branches that begin in waves up to a given amplitude.

    course: one condition
    amplitude: of the wave [m]
    top: amplitude up to which onsets are looked for, and branches followed [m]
    rungs: heights between nothing and the top at which the motion of one period is looked at
    basis: of two periods; None: those of head and following seas
    Returns x (j, m): coefficients of each motion, least roll first
    """
    basis = doubled_harmonics() if basis is None else basis
    begun = onsets(course, top * np.append(0.01, np.arange(1, rungs + 1)) / rungs, basis)
    branches: list[Doubled] = []
    found: list[Floats] = []
    for onset in begun:
        if any(abs(one.amplitude[-1] - onset[0]) < 0.02 * top and one.ends_small for one in branches):
            continue  # the other end of a branch already followed
        branches.append(doubled_branch(course, onset, 1.02 * top, basis))
        for x in branches[-1].at(amplitude):
            if not any(np.abs(largest_roll(basis, x)[0] - largest_roll(basis, one)[0]) < 1e-5 for one in found):
                found.append(x)
    width = 2 * basis.sizes[0] + 3 * basis.sizes[1]
    found.sort(key=lambda x: float(largest_roll(basis, x)[0]))
    return np.array(found).reshape(-1, width), branches

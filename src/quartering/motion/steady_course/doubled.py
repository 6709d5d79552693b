"""Motions of two wave periods beyond the loss of stability in roll: where they begin, and every one of them by continuation.

In head and following seas a motion of two periods has phi(t + T) = -phi(t) and h(t + T) = h(t), so it holds odd multiples of
half the encounter frequency in sway, roll and yaw beside the harmonics of the encounter in heave and pitch; in an oblique sea
every mode holds both. On a motion of one period the Jacobian falls apart into even and odd multiples, and a motion of two
periods begins where the block of the odd ones is singular, which is a multiplier -1. From there the branch is followed
through its folds over the height of the wave: a march in time finds one of several stable motions, or lingers near one that
has just ceased to be.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.piecewise import zero
from quartering.motion.steady_course.balance import FOUND, Harmonics, balance, doubled_harmonics, solved
from quartering.motion.steady_course.continuation import Family, OfAmplitude, Path
from quartering.motion.steady_course.course import ROLL, Course
from quartering.motion.steady_course.orbits import climbed

Floats = NDArray[np.float64]

LARGEST_ROLL: Final = np.radians(60.0)
"""Roll at which a branch is left [rad]."""
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
    family = OfAmplitude(course)
    begun = [
        onset_between(family, basis, (amplitudes[i], amplitudes[i + 1]), (whole[i], whole[i + 1]))
        for i in np.flatnonzero(signs[:-1] * signs[1:] < 0)
    ]
    return [onset for onset in begun if onset is not None]


def onset_between(
    family: Family, basis: Harmonics, between: tuple[float, float], ends: tuple[Floats, Floats]
) -> tuple[float, Floats, Floats] | None:
    """Where motions of two periods begin between two motions of one, or None where those do not meet.

    between: values of the parameter, at which the sign of the determinant differs
    ends: the motions there, coefficients (m,) of two periods
    Returns as `onsets`
    """
    value = _root(family, basis, between, ends)
    t = (value - between[0]) / (between[1] - between[0])
    x = _one_period_at(family.at(value), basis, (1 - t) * ends[0] + t * ends[1])
    if x is None:
        return None
    direction = np.zeros(x.size)
    direction[basis.odd] = np.linalg.svd(_odd_block(family.at(value), 0, basis, x))[2][-1]
    return value, x, direction


def doubling_sign(course: Course, basis: Harmonics, x: Floats) -> float:
    """Sign of the determinant that changes where motions of two periods begin, of a motion of one (m,)."""
    return _sign(course, 0, basis, x)


def _odd_block(course: Course, i: int, basis: Harmonics, x: Floats) -> Floats:
    odd = basis.odd
    return balance(course, i, basis, x)[1][np.ix_(odd, odd)]


def _sign(course: Course, i: int, basis: Harmonics, x: Floats) -> float:
    return float(np.linalg.slogdet(_odd_block(course, i, basis, x))[0])


def _one_period_at(course: Course, basis: Harmonics, guess: Floats) -> Floats | None:
    """The motion of one period of a condition, as coefficients of two."""
    odd = basis.odd
    x, outcome = solved(course, basis.of_one_period, guess[None, ~odd])
    if outcome[0] != FOUND:
        return None
    whole = np.zeros(odd.size)
    whole[~odd] = x[0]
    return whole


def _root(family: Family, basis: Harmonics, between: tuple[float, float], ends: tuple[Floats, Floats]) -> float:
    """Value at which the odd block is singular, by its determinant over that at one end."""
    low, high = between
    reference = np.linalg.slogdet(_odd_block(family.at(low), 0, basis, ends[0]))[1]

    def determinant(value: float) -> float:
        t = (value - low) / (high - low)
        x = _one_period_at(family.at(value), basis, (1 - t) * ends[0] + t * ends[1])
        if x is None:
            return float("nan")
        sign, size = np.linalg.slogdet(_odd_block(family.at(value), 0, basis, x))
        return float(sign * np.exp(np.clip(size - reference, -60.0, 60.0)))

    return zero(determinant, low, high, xtol=1e-7 * abs(high), rtol=1e-10)


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
    path = Path(OfAmplitude(course), basis, course.draught, 0.25 * top, 1e-5 * top)
    made = np.array(branch_from(path, onset, lambda point: 0.0 < point[-1] < top))
    return Doubled(course, basis, made[:, -1], made[:, :-1])


def branch_from(path: Path, onset: tuple[float, Floats, Floats], inside: Callable[[Floats], bool]) -> list[Floats]:
    """Points (x, parameter) of the branch that begins at an onset, which is the first of them.

    onset: value of the parameter, motion of one period and direction, as `onsets` has them
    inside: is the parameter where the branch is looked for? The last point may lie outside, or be back at small roll
    """
    basis = path.basis
    value, x, direction = onset
    first = np.append(x, value)
    roll = doubled_roll(basis, direction)[0]
    tangent = np.append(direction, 0.0) / path.sizes
    start = path.corrected(
        first + np.append(_ONSET / max(roll, 1e-12) * direction, 0.0), tangent / np.linalg.norm(tangent)
    )
    if start is None:
        return [first]

    def go_on(point: Floats, before: Floats) -> bool:
        there = bool(
            _odd_roll(basis, point) @ _odd_roll(basis, before) >= 0.0
        )  # else back through the motion of one period
        return there and inside(point) and bool(largest_roll(basis, point[:-1])[0] <= LARGEST_ROLL)

    points = path.followed(start, tangent, _MOST, go_on)
    if _odd_roll(basis, points[-1]) @ _odd_roll(basis, points[0]) < 0.0:
        points = points[:-1]
    return [first, *points]


def _odd_roll(basis: Harmonics, point: Floats) -> Floats:
    return basis.parts(np.where(basis.odd, point[:-1], 0.0))[ROLL]


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

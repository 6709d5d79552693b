"""The Gaussian closure: gains from the covariance, the covariance from the gains, until they agree."""

# The unknowns are the statistics x = (covariances of the variables, variances of the strips' velocities, means). One pass maps
# them to gains (`averages`), through the linear response of every cell, to new statistics. The map contracts slowly and may
# oscillate where the damping is drag alone; Anderson's acceleration finds its fixed point in about ten passes in place of
# thirty to sixty: the next x is the combination of the last few passes that leaves the least residual.

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.motion.sea.averages import averages, drag_averages
from quartering.motion.sea.equations import SeaEquations, Terms
from quartering.motion.sea.response import covariances, respond

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

KAPPA: Final = 32.0 / (9.0 * np.pi)
"""Factor of the cubic that stands for |q| q at its reference velocity [1]."""
_MEMORY, _ACCELERATED, _MOST_PASSES = 5, 40, 200
TOLERANCE: Final = 1e-6
"""Change of one pass, relative, at which the statistics are taken to agree with their gains."""
_SAME: Final = 0.01
_NEGLIGIBLE: Final = 1e-8
_MANY: Final = 1000
"""Cells of which every second one tells whether a start far from rest leads to the motion that is known."""
LARGE: Final = 0.5
"""Roll of a start far from rest [rad]."""
_TAKEN = [0, 2, 3]


@dataclass(frozen=True, eq=False)
class Statistics:
    """Second moments and means of a motion in a sea.

    Parameters
    ----------
    c : (m, m) float        covariance of v, phi, p, r and of the variables the water enters
    variance : (z,) float   of the strips' velocity through the water [m2/s2]
    mean : (3,) float       of v, phi and r; with an autopilot that holds the heading, of v, phi and the heading
    """

    c: Floats
    variance: Floats
    mean: Floats

    @property
    def flat(self) -> Floats:
        """All in one vector, the upper half of the covariance."""
        return np.concatenate([self.c[np.triu_indices(len(self.c))], self.variance, self.mean])

    def like(self, flat: Floats) -> Statistics:
        """Statistics of such a vector, variances at least 0."""
        m, c = len(self.c), np.zeros_like(self.c)
        upper = np.triu_indices(m)
        c[upper] = flat[: upper[0].size]
        c = c + np.triu(c, 1).T
        np.fill_diagonal(c, np.maximum(np.diag(c), 0.0))
        z = self.variance.size
        return Statistics(c, np.maximum(flat[upper[0].size : upper[0].size + z], 0.0), flat[upper[0].size + z :])


@dataclass(frozen=True, eq=False)
class Gains:
    """In place of the nonlinear terms: forces by the variables (3, m), by the strips' velocity (z,), and mean forces (3,)."""

    by_variable: Floats
    by_strip: Floats
    force: Floats

    def by_state(self, terms: Terms) -> Floats:
        """Forces (3, 4) by v, phi, p, r."""
        total = self.by_variable[:, :4].copy()
        for j, state in enumerate(terms.extra):
            if state >= 0:
                total[:, state] += self.by_variable[:, 4 + j]
        total[:, _TAKEN] -= np.einsum("s,sk,sj->kj", self.by_strip, terms.forms, terms.forms)
        return total


@dataclass(frozen=True, eq=False)
class Solution:
    """A motion in a sea: its statistics, the gains that go with them, and the response of each cell.

    Parameters
    ----------
    statistics : Statistics
    gains : Gains
    cells : (n,) int             cells that take part, of those of the equations
    energy : (n,) float          in each [m2]
    motion : (m, n) complex      phasors per metre in each
    passes : int
    converged : bool
    """

    statistics: Statistics
    gains: Gains
    cells: NDArray[np.int64]
    energy: Floats
    motion: Complex
    passes: int
    converged: bool

    @property
    def roll(self) -> float:
        """Root mean square roll about its mean [rad]."""
        return float(np.sqrt(self.statistics.c[1, 1]))


def gains_of(terms: Terms, at: Statistics, held: bool) -> Gains:
    """Gains and mean forces of all nonlinear terms at the statistics of a motion.

    held: is the mean rate of turn zero, a heading being held?
    """
    m, z = terms.powers.shape[1], terms.drag.size
    mean = np.zeros(m)
    mean[0], mean[1], mean[3] = at.mean[0], at.mean[1], 0.0 if held else at.mean[2]
    for j, state in enumerate(terms.extra):
        mean[4 + j] = mean[state] if state >= 0 else 0.0
    gain, force, drag_force, by_strip = np.zeros((3, m)), np.zeros(3), np.zeros(3), np.zeros(z)
    coefficients = coefficients_at(terms, at.variance)
    averages(terms.powers, terms.modulus, coefficients, terms.knots, terms.cubics, mean, at.c, gain, force)
    if terms.matched is None:
        drag_averages(terms.forms, terms.drag, mean[_TAKEN], at.variance, by_strip, drag_force)
    return Gains(gain, by_strip, force + drag_force)


def coefficients_at(terms: Terms, variance: Floats) -> Floats:
    """Coefficients (3, t) of the products, cubic drag matched at variances (z,) of the strips' velocity [m2/s2]."""
    if terms.matched is None:
        return terms.coefficients
    share, scale = terms.matched
    return np.asarray(terms.coefficients + share * (scale / _matched_velocity(terms, variance, scale) - 1.0))


def _matched_velocity(terms: Terms, variance: Floats, scale: float) -> float:
    """Reference velocity u0 at which cubic drag takes the energy of |q| q out of a Gaussian motion [m/s].

    E|q|^3 = 2 sqrt(2/pi) s^3 and E q^4 = 3 s^4, so that sum c 2 sqrt(2/pi) s^3 = (kappa/u0) sum c 3 s^4.
    """
    s = np.sqrt(variance)
    cube = float((terms.drag * s**3).sum())
    if not cube > 0:
        return scale
    return float(3.0 * KAPPA / (2.0 * np.sqrt(2.0 / np.pi)) * (terms.drag * s**4).sum() / cube)


class _Passes:
    """One pass after another over the cells of one sea."""

    def __init__(self, equations: SeaEquations, energy: Floats) -> None:
        self.equations, self.terms = equations, equations.terms
        self.held = equations.autopilot is not None and equations.autopilot.gain > 0 and bool(equations.rudder.any())
        self.cells = np.flatnonzero(energy > 0.0)
        self.energy = np.ascontiguousarray(energy[self.cells])
        self.motion: Complex = np.zeros((0, 0), dtype=complex)
        self.count = 0

    @property
    def nothing(self) -> Statistics:
        m, z = self.terms.powers.shape[1], self.terms.drag.size
        return Statistics(np.zeros((m, m)), np.zeros(z), np.zeros(3))

    def respond(self, gains: Gains) -> Statistics:
        """Statistics of the response with some gains."""
        e, terms = self.equations, self.terms
        m, z = terms.powers.shape[1], terms.drag.size
        self.motion = np.zeros((m, self.cells.size), dtype=complex)
        respond(
            self.cells, e.frequency, e.inertia, e.linear, e.steering, gains.by_variable, terms.extra, e.force, e.inputs,
            terms.forms, gains.by_strip, e.water, self.motion,
        )  # fmt: skip
        c, variance = np.zeros((m, m)), np.zeros(z)
        covariances(self.cells, self.energy, self.motion, terms.forms, e.water, c, variance)
        self.count += 1
        return Statistics(c, variance, np.zeros(3))

    def keep_what_counts(self) -> None:
        """Leave out cells that add less than 1e-8 of every variance, by the response just found."""
        part = self.energy * np.abs(self.motion) ** 2
        whole = part.sum(axis=1, keepdims=True)
        counts = (part > _NEGLIGIBLE * whole).any(axis=0)
        if self.terms.drag.size:
            water = self.energy * (self.equations.water[self.cells] ** 2).sum(axis=(1, 2))
            counts |= water > _NEGLIGIBLE * water.sum()
        self.cells, self.energy = self.cells[counts], np.ascontiguousarray(self.energy[counts])

    def halved(self) -> _Passes:
        """Every second cell, with twice its energy."""
        other = _Passes(self.equations, np.zeros(0))
        other.cells = np.ascontiguousarray(self.cells[::2])
        other.energy = np.ascontiguousarray(2.0 * self.energy[::2])
        return other

    def next(self, at: Statistics) -> Statistics:
        """Statistics one pass on, the mean by one step of Newton."""
        gains = gains_of(self.terms, at, self.held)
        found = self.respond(gains)
        return replace(found, mean=self._mean(at, gains)) if self.terms.biased else found

    def _mean(self, at: Statistics, gains: Gains) -> Floats:
        """Means that balance the steady forces: B m + E[f] + F = 0, linearised about those of before."""
        e = self.equations
        slowest = 0 if len(e.linear) == 1 else int(e.frequency.argmin())
        linear, slope = e.linear[slowest][:, [0, 1, 3]].copy(), gains.by_state(self.terms)[:, [0, 1, 3]]
        if self.held and e.autopilot is not None:  # the third mean is a heading, which the rudder answers
            linear[:, 2], slope[:, 2] = -e.autopilot.gain * e.rudder, 0.0
        rest = linear @ at.mean + gains.force + self.terms.mean
        scale = np.abs(linear).max(axis=1)
        matrix = (linear + slope) / scale[:, None]
        if not np.linalg.cond(matrix) < 1e12:
            return np.full(3, np.nan)
        return np.asarray(at.mean - np.linalg.solve(matrix, rest / scale))


def linear_response(equations: SeaEquations) -> Complex:
    """Phasors per metre (m, c) of the linear equations, the nonlinear terms left out, in every cell.

    Returns (m, c)
    """
    passes = _Passes(equations, np.ones(equations.frequency.size))
    passes.respond(_no_gains(equations.terms))
    return passes.motion


def linear_solution(equations: SeaEquations, energy: Floats, motion: Complex) -> Solution:
    """Response of the linear equations to one sea; its statistics hold the means alone, the sums are the caller's.

    energy (c,): of the sea in each cell [m2]
    motion (m, c): from `linear_response`
    """
    passes, gains = _Passes(equations, energy), _no_gains(equations.terms)
    nothing = passes.nothing
    mean = passes._mean(nothing, gains) if equations.terms.mean.any() else nothing.mean
    c = np.zeros_like(nothing.c)
    c[1, 1] = float(energy @ np.abs(motion[1]) ** 2)
    return Solution(Statistics(c, nothing.variance, mean), gains, passes.cells, passes.energy, motion, 1, True)


def _no_gains(terms: Terms) -> Gains:
    return Gains(np.zeros((3, terms.powers.shape[1])), np.zeros(terms.drag.size), np.zeros(3))


def closure_solutions(equations: SeaEquations, energy: Floats) -> list[Solution]:
    """All motions the Gaussian closure finds in one sea, from rest, from the linear response and from large roll.

    energy (c,): of the sea in each cell [m2]
    Returns the first from rest; further ones differ from it by 1 % of roll or more. One that did not converge is the
        only one and says so

    Source: [Kazakov54]; the fixed point by Anderson's acceleration.
    """
    passes = _Passes(equations, energy)
    linear = passes.next(passes.nothing)
    passes.keep_what_counts()
    found = [_solve(passes, linear, [])]
    known = [one.roll for one in found if one.converged]
    coarse = _solve(passes.halved() if passes.cells.size > _MANY else passes, _raised(linear, LARGE), known)
    if coarse.converged and not _among(coarse.roll, known, 5 * _SAME):
        solution = _solve(passes, coarse.statistics, known)
        if solution.converged and not _among(solution.roll, known, _SAME):
            found = [*found, solution] if found[0].converged else [solution]
    return found


def _among(roll: float, known: list[float], within: float) -> bool:
    return any(abs(roll - one) <= within * one for one in known)


def _raised(at: Statistics, roll: float) -> Statistics:
    """The statistics with the roll of a large motion, everything else in proportion."""
    factor = roll**2 / at.c[1, 1] if at.c[1, 1] > 0 else 1.0
    return (
        Statistics(factor * at.c, factor * at.variance, at.mean)
        if factor > 1.0
        else Statistics(4.0 * at.c, 4.0 * at.variance, at.mean)
    )


def _solve(passes: _Passes, start: Statistics, known: list[float]) -> Solution:
    """The fixed point that a start leads to; ends early where it comes to a motion that is known."""
    begun, scale = passes.count, _scale_of(start)
    at, x, converged = start, start.flat / scale, False
    history: list[tuple[Floats, Floats]] = []
    for turn in range(_MOST_PASSES):
        at = start.like(x * scale)
        found = passes.next(at)
        new = found.flat / scale
        residual = new - x
        size = float(np.abs(residual).max()) / max(float(np.abs(new).max()), 1e-300)
        if not np.isfinite(size):
            break
        roll = float(np.sqrt(max(found.c[1, 1], 0.0)))
        # back at a motion that is known: no need to polish it
        converged = size < TOLERANCE or (size < 0.05 and _among(roll, known, _SAME))
        if converged:
            break
        history = [*history[-_MEMORY:], (x, residual)]
        x = _accelerated(history) if 2 <= turn < _ACCELERATED else x + _step(turn) * residual
    gains = gains_of(passes.terms, at, passes.held)
    at = replace(passes.respond(gains), mean=at.mean)
    return Solution(at, gains, passes.cells, passes.energy, passes.motion, passes.count - begun, converged)


def _scale_of(start: Statistics) -> Floats:
    """What each of the statistics is measured by, so that what is zero but for rounding does not count."""
    deviation = np.sqrt(np.maximum(np.diag(start.c), 0.0))
    deviation = np.maximum(deviation, max(1e-6 * float(deviation.max()), 1e-150))
    variance = np.maximum(start.variance, max(1e-6 * float(start.variance.max(initial=0.0)), 1e-300))
    covariance = np.outer(deviation, deviation)[np.triu_indices(len(start.c))]
    return np.concatenate([covariance, variance, deviation[[0, 1, 3]]])


def _step(turn: int) -> float:
    """Share of the residual that a plain step takes: shorter and shorter where the acceleration has failed."""
    return 0.5 if turn < 2 else max(0.5 * 0.98 ** (turn - _ACCELERATED), 0.1)


def _accelerated(history: list[tuple[Floats, Floats]]) -> Floats:
    """Next statistics: Anderson's combination of the last passes."""
    x, residual = history[-1]
    differences = np.array([residual - one for _, one in history[:-1]]).T
    steps = np.array([x - one for one, _ in history[:-1]]).T
    weights = np.linalg.lstsq(differences, residual, rcond=1e-8)[0]
    return np.asarray(x + 0.7 * residual - (steps + 0.7 * differences) @ weights)

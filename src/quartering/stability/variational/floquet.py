"""Floquet multipliers: what decides whether a periodic motion is stable."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner, kernel, summing
from quartering._machine.threads import in_threads
from quartering.motion.equations.batch import rows
from quartering.motion.equations.steering import HEADING, RUDDER, holds_heading
from quartering.motion.equations.system import Floats, System
from quartering.stability.first_order import Detail
from quartering.stability.variational.eigenvalues import eigenvalues
from quartering.stability.variational.magnus import FINEST, magnus_steps, magnus_transition, modulus
from quartering.stability.variational.transition import even_steps, transition_matrices

Complex = NDArray[np.complex128]

_SMALLEST_DETERMINANT = 1e-9
_NEARLY_UNSTABLE = 0.999


@dataclass(frozen=True, eq=False)
class Floquet:
    """Floquet analysis of n motions, modes ordered by the modulus of their multipliers, the largest first.

    There are s = 4 modes; with an autopilot 5, with a rudder that lags 6. A heading that nothing holds is neutral: its
    multiplier 1 stands last and decides nothing.

    Parameters
    ----------
    multipliers : (n, s) complex    of one wave period, states (v, phi, p, r) and, with an autopilot, psi and delta
    half : (n, s) complex           of the half-period map with sign reversal removed: multipliers = half^2 when the motion
                                    is symmetric; NaN when it is not
    exponents : (n, s) complex      w/(2 pi) ln(multiplier) [1/s]
    share : (n, s, s) float         participation of the states (last axis) in each mode, summing to 1; NaN if not asked for
    liouville : (n,) float          relative difference of the product of multipliers and exp(integral of the trace); NaN
                                    where the product is too small to be told from rounding
    """

    multipliers: Complex
    half: Complex
    exponents: Complex
    share: Floats
    liouville: Floats

    @property
    def growth(self) -> Floats:
        """Largest real part (n,) of the exponents [1/s]; positive is unstable."""
        return np.asarray(self.exponents[:, 0].real)

    @property
    def roll_share(self) -> Floats:
        """Participation (n, s) of roll angle and roll rate in each mode."""
        return np.asarray(self.share[:, :, 1] + self.share[:, :, 2])


def steps_for(frequency: Floats, span: float, rate: Floats, highest: int, accuracy: float) -> NDArray[np.int64]:
    """Runge-Kutta steps that keep the error of the multipliers near a given accuracy.

    frequency (n,): w [rad/s]
    span: fraction of the period integrated
    rate (n,): fastest rate in the variational equations, see `fastest_rate` [1/s]
    highest: highest harmonic of the motion
    accuracy: relative to the larger of 1 and the multiplier
    Returns (n,)

    The local error of the fourth-order method is (rate h)^5/120.  Source: closed form.

    >>> steps_for(np.array([0.5]), 0.5, np.array([0.5]), 3, 1e-6).tolist()
    [84]
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = 2 * np.pi * span * 1.8 * np.nan_to_num(np.maximum(rate / frequency, 1.0), nan=1.0, posinf=1.0)
    steps = np.ceil(turn * (turn / (120 * accuracy)) ** 0.25)
    return np.asarray(np.clip(steps, 12 + 8 * highest * span, 200_000)).astype(np.int64)


def fastest_rate(phasors: Complex, mean_jacobian: Complex) -> Floats:
    """Upper bound on the eigenvalue modulus of the variational matrix over a cycle.

    phasors (n, m, 3, 4): harmonics of the variational matrix, the mean first
    mean_jacobian (n, 4): eigenvalues of its mean [1/s]; NaN where they are not known: a bound takes their place
    Returns (n,): [1/s]

    Largest of the mean's eigenvalues, the root of the largest stiffness, and the largest dampings on the diagonal.
    Source: Gershgorin-type estimate; used to choose steps only.

    >>> stiff = np.zeros((1, 2, 3, 4), complex)
    >>> stiff[0, :, 1, 1] = [-1.0, 3.0]
    >>> fastest_rate(stiff, np.zeros((1, 4))).tolist()
    [2.0]
    """
    rate = np.empty(len(phasors))
    in_threads(_fastest, len(phasors), np.require(phasors, requirements=("C", "W")), np.asarray(mean_jacobian), rate)
    return rate


@kernel
def _fastest(first, last, phasors, mean_jacobian, rate):
    """Fastest rates (n,) of `fastest_rate`."""
    power, other = np.empty((4, 4)), np.empty((4, 4))
    for i in range(first, last):
        largest = 0.0
        for s in range(mean_jacobian.shape[1]):
            own = abs(mean_jacobian[i, s])
            largest = own if own > largest or np.isnan(own) else largest
        rate[i] = rate_of_one(phasors[i], largest, power, other)


@inner
def rate_of_one(phasors, largest, power, other):
    """Fastest rate of a condition with harmonics (m, 3, 4) and eigenvalues of the mean up to ``largest``; NaN: not known."""
    stiffness, sway, roll, yaw = 0.0, 0.0, 0.0, 0.0
    for m in range(phasors.shape[0]):
        stiffness += modulus(phasors[m, 1, 1])
        sway += modulus(phasors[m, 0, 0])
        roll += modulus(phasors[m, 1, 2])
        yaw += modulus(phasors[m, 2, 3])
    if np.isnan(largest):
        largest = _spectral_bound(phasors[0], power, other)
    for own in (math.sqrt(stiffness), sway, roll, yaw):
        largest = own if own > largest or np.isnan(own) else largest
    return largest


@inner
def _spectral_bound(mean, power, other):
    """Bound on the moduli of the eigenvalues of the mean matrix (3, 4): |A^8|^(1/8)."""
    for c in range(4):
        power[0, c], power[1, c] = mean[0, c].real, 1.0 if c == 2 else 0.0
        power[2, c], power[3, c] = mean[1, c].real, mean[2, c].real
    total = 0.0
    for n in range(3):
        total = 0.0
        for a in range(4):
            for b in range(4):
                own = power[a, 0] * power[0, b] + power[a, 1] * power[1, b]
                other[a, b] = own + power[a, 2] * power[2, b] + power[a, 3] * power[3, b]
                total += other[a, b] * other[a, b]
        if n < 2:
            for a in range(4):
                for b in range(4):
                    power[a, b] = other[a, b]
    return math.sqrt(math.sqrt(math.sqrt(math.sqrt(total))))


def floquet(
    system: System,
    u: Floats,
    orders: tuple[int, ...],
    rate: Floats,
    trace: Floats,
    accuracy: float = 1e-6,
    *,
    variation: tuple[Complex, Floats] | None = None,
    transition: Floats | None = None,
    detail: Detail = "full",
) -> Floquet:
    """Floquet multipliers of periodic motions by integrating their variational equations.

    system: n conditions
    u (n, 3, b): motions, as from `harmonic_balance`; NaN rows come back as NaN
    orders: their harmonics
    rate (n,): from `fastest_rate`, to choose the steps [1/s]
    trace (n,): mean trace of the variational matrix, for the Liouville check [1/s]
    accuracy: of the multipliers
    variation: from `variation_along`; where it is given, the equations are smooth and the accuracy is moderate, long
        steps of Magnus' series are taken in place of Runge-Kutta's
    transition (n, 4, 4): from `in_one_pass`, where that has been found already
    detail: "full", or what a "map" needs: shares of unstable motions alone

    A motion with odd harmonics only has a variational matrix of half the period, so half a cycle suffices: a half-period
    multiplier of -1 is a fold, +1 symmetry breaking, a complex pair on the unit circle a growing oscillation.
    Source: [H71] eq. (8) and Liouville's formula; [Blanes09].
    """
    symmetric = all(h % 2 == 1 for h in orders)
    span = 0.5 if symmetric else 1.0
    found = np.isfinite(u).all(axis=(1, 2)) & system.finite
    moving = u if found.all() else np.where(found[:, None, None], u, 0.0)
    if transition is None:
        phi = _transitions(system, moving, orders, span, found, rate, accuracy, variation)
    else:
        phi = _completed(system, moving, orders, span, found, rate, accuracy, transition)
    found &= np.isfinite(phi).all(axis=(1, 2))
    free = system.states > HEADING and ~holds_heading(system.linear)
    if not found.all():
        phi = np.where(found[:, None, None], phi, np.eye(system.states))
    if np.any(free):
        phi[free, HEADING, HEADING] = 0.0  # its column is empty now: a mode of multiplier 0, which stands last
    values, share = _modes(phi, detail)
    if np.any(free):
        values[free, -1] = 1.0
    frequency = np.where(found, system.frequency, 1.0)
    full, exponents = np.empty_like(values), np.empty_like(values)
    liouville = np.empty(system.count)
    in_threads(_of_cycle, system.count, values, symmetric, frequency, trace, full, exponents, liouville)
    gone = ~found
    for array in (full, values, exponents, share, liouville):
        array[gone] = np.nan
    half = values if symmetric else np.full_like(values, np.nan)
    return Floquet(full, half, exponents, share, liouville)


@summing
def _of_cycle(first, last, values, symmetric, frequency, trace, full, exponents, liouville):
    """Multipliers of a whole cycle from those of the integrated span, their exponents, and how far Liouville's formula misses.

    A multiplier too small for the number range is zero: its exponent is -inf.
    """
    for i in range(first, last):
        turns, product = frequency[i] / (2.0 * np.pi), 1.0 + 0.0j
        for s in range(values.shape[1]):
            own = values[i, s] * values[i, s] if symmetric else values[i, s]
            full[i, s] = own
            product *= own
            size = abs(own)
            growth = math.log(size) * turns if size > 0.0 else -np.inf
            exponents[i, s] = complex(growth, math.atan2(own.imag, own.real) * turns)
        expected = math.exp(trace[i] / turns)
        large = expected > _SMALLEST_DETERMINANT
        liouville[i] = abs(product.real - expected) / expected if large else np.nan


FINEST_WITH_KINKS: Final = 1e-6
"""Smallest error of the multipliers for which the samples of a variation with kinks, or with jumps of curvature, suffice."""
_STEPS_WITH_KINKS = 8


def finest(system: System) -> float:
    """Smallest error of the multipliers that Magnus' series is taken for."""
    return FINEST_WITH_KINKS if system.has_drag or system.has_table else FINEST


def least_steps(system: System) -> int:
    """Fewest steps that it takes."""
    return _STEPS_WITH_KINKS if system.has_drag or system.has_table else 1


def _transitions(
    system: System,
    u: Floats,
    orders: tuple[int, ...],
    span: float,
    found: NDArray[np.bool_],
    rate: Floats,
    accuracy: float,
    variation: tuple[Complex, Floats] | None,
) -> Floats:
    """State transition matrices (n, s, s), each by the method that reaches the accuracy at the least cost."""
    if system.states > RUDDER:
        rate = np.maximum(rate, -system.linear[:, 3, RUDDER])
    if variation is None or accuracy < finest(system) or system.has_kinked_slopes or not system.plain:
        steps = np.where(found, even_steps(steps_for(system.frequency, span, rate, max(orders), accuracy)), 1)
        return transition_matrices(system, u, orders, span, steps)
    phasors, along = variation
    steps, scale = magnus_steps(system.frequency, phasors, rate, span, accuracy)
    cycle = 2 * np.pi * span / np.where(found, system.frequency, 1.0)
    steps = np.where(found & (steps > 0), np.maximum(steps, least_steps(system)), 0)
    phi = magnus_transition(along, cycle, steps, scale, kinks=system.has_drag or system.has_table)
    return _completed(system, u, orders, span, found, rate, accuracy, phi)


def _completed(
    system: System,
    u: Floats,
    orders: tuple[int, ...],
    span: float,
    found: NDArray[np.bool_],
    rate: Floats,
    accuracy: float,
    phi: Floats,
) -> Floats:
    """Transition matrices (n, 4, 4), those that Magnus' series has not found by Runge-Kutta steps."""
    rest = np.flatnonzero(found & ~np.isfinite(phi).all(axis=(1, 2)))
    if rest.size:
        few = rows(system, rest)
        many = even_steps(steps_for(few.frequency, span, rate[rest], max(orders), accuracy))
        phi[rest] = transition_matrices(few, u[rest], orders, span, many)
    return phi


def _modes(phi: Floats, detail: Detail) -> tuple[Complex, Floats]:
    """Eigenvalues (n, s) by falling modulus, and the share (n, s, s) of each state in each mode."""
    if detail == "full":
        wanted = np.arange(phi.shape[0])
        values, share = np.empty(phi.shape[:2], complex), np.empty(phi.shape)
    else:
        values = eigenvalues(phi)
        order = np.argsort(-np.abs(values), axis=1, kind="stable")
        values = np.take_along_axis(values, order, axis=1)
        share = np.full(phi.shape, np.nan)
        wanted = np.flatnonzero(np.abs(values[:, 0]) > _NEARLY_UNSTABLE)
    if wanted.size:
        own, vectors = np.linalg.eig(phi[wanted])
        order = np.argsort(-np.abs(own), axis=1, kind="stable")
        values[wanted] = np.take_along_axis(own.astype(complex), order, axis=1)
        share[wanted] = _participation(np.take_along_axis(vectors.astype(complex), order[:, None, :], axis=2))
    return values, share


def _participation(vectors: Complex) -> Floats:
    """Share (n, mode, state) of each state in each mode: |right eigenvector x left eigenvector|, free of units."""
    defective = np.abs(np.linalg.det(vectors)) < 1e-13
    left = np.linalg.inv(np.where(defective[:, None, None], np.eye(vectors.shape[1]), vectors))
    share = np.abs(vectors.transpose(0, 2, 1) * left)
    share[defective] = np.abs(vectors[defective].transpose(0, 2, 1)) ** 2
    return np.asarray(share / share.sum(axis=2, keepdims=True))

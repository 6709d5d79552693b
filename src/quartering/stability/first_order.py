"""The paper's first-order stability analysis, complete: index K2, resonances, slow modes, combination.

Everything here is algebra on the harmonics of the variational matrix, vectorised over conditions (n,).
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import kernel
from quartering._machine.rowwise import contracted
from quartering._machine.threads import in_threads
from quartering.motion.equations.steering import HEADING, RUDDER, feedback, state_matrix
from quartering.motion.equations.system import Floats, System
from quartering.stability.course import combination_rate, course_matrix, course_rates
from quartering.stability.short_index import roll_cubics, short_index, through_water
from quartering.stability.variational.eigenvalues import eigenvalues

Complex = NDArray[np.complex128]
Detail = Literal["full", "map"]
_VELOCITIES = [0, 2, 3]
_CLEARLY = 0.3
RESONANCES = (2, 4, 6)
"""Values of m at which the paper looks for a resonance n2 = m omega/2."""


@dataclass(frozen=True, eq=False)
class FirstOrder:
    """First-order stability quantities of n motions.

    Parameters
    ----------
    n2 : (n,)                natural roll frequency about the motion [rad/s]; NaN when the mean stiffness is negative
    rho : (n, 3)             shape (sway [m/rad], roll, yaw) of the free roll mode
    k2, k2_rho, k2_paper : (n,)    index [1/s2]: full; from I1, I2, I3 with the ship's rho and amplitudes through the water;
                             with the paper's 0.3 and 0.1 and amplitudes over ground
    through_water : (n, 3)   amplitudes P1, P2, P3 relative to the water: sway [m], roll, yaw [rad]
    roll_rate : (n,)         growth rate of the roll mode away from resonance, K2/(2 n2) [1/s]
    q_paper, q : (n, 3)      largest growth rate at the resonances m = 2, 4, 6 [1/s]: restoring modulation alone; complete
    slow : (n, 2)            growth rates of the sway-yaw modes averaged over the wave [1/s], the larger first; with an
                             autopilot (n, 3) or (n, 4), heading and rudder among them
    combination : (n,)       largest growth rate when roll and slow modes combine (n2 near 2 omega) [1/s]
    averaged : (n, 2)        roll pair of the averaged equations (A-10), complex [1/s]
    mean_jacobian : (n, s)   eigenvalues of the mean variational matrix, complex [1/s]
    """

    n2: Floats
    rho: Floats
    k2: Floats
    k2_rho: Floats
    k2_paper: Floats
    through_water: Floats
    roll_rate: Floats
    q_paper: Floats
    q: Floats
    slow: Floats
    combination: Floats
    averaged: Complex
    mean_jacobian: Complex

    @property
    def index(self) -> Floats:
        """Stability index S = -K2/(2 n2) [1/s], positive is stable."""
        return -self.roll_rate

    @property
    def growth(self) -> Floats:
        """Largest growth rate any first-order quantity predicts, the averaged system deciding near m = 2 [1/s].

        NaN where the mean roll stiffness is negative: first-order theory has no roll mode there, and no answer.
        """
        rates = np.column_stack(
            [self.roll_rate, self.averaged.real.max(axis=1), self.slow.max(axis=1), self.combination]
        )
        return np.asarray(rates.max(axis=1))


def _averaged_roll_pair(system: System, phasors: Complex, detail: Detail) -> Complex:
    """Roll pair (n, 2) of d(A', B')/d(A, B) from the averaged equations (A-10).

    For a map the eigenvalues nearest to those of roll alone are taken where they are clearly the nearest.
    """
    frequency = np.where(system.finite, system.frequency, 1.0)
    matrix = np.empty((system.count, 6, 6))
    given = np.require(phasors, requirements=("C", "W")), frequency, feedback(system.linear, frequency)
    in_threads(_averaged, system.count, *given, matrix)
    if detail == "full":
        return _in_roll(matrix)
    pair, clear = np.empty((system.count, 2), dtype=complex), np.empty(system.count, dtype=bool)
    in_threads(_nearest_to_roll, system.count, matrix, eigenvalues(matrix), pair, clear)
    doubtful = np.flatnonzero(~clear)
    if doubtful.size:
        pair[doubtful] = _in_roll(matrix[doubtful])
    return pair


@kernel
def _averaged(first, last, phasors, frequency, steering, matrix):
    """Averaged equations (n, 6, 6): derivatives of the rates of A and B of sway, roll, yaw by themselves.

    ``steering`` (n, 3): an autopilot's answer to the heading
    """
    for i in range(first, last):
        w = frequency[i]
        for column in range(6):
            j, displacement = column % 3, (1.0 + 0.0j if column < 3 else -1j)
            velocity, swing = j if j == 0 else j + 1, 1j * w * displacement
            for k in range(3):
                force = phasors[i, 0, k, velocity] * swing
                other = phasors[i, 1, k, velocity] * np.conj(swing)
                if j == 1:
                    force += phasors[i, 0, k, 1] * displacement
                    other += phasors[i, 1, k, 1] * np.conj(displacement)
                error = -(force + 0.5 * other)
                if j == 2:
                    error -= displacement * steering[i, k]
                if j == k:
                    error -= w * w * displacement
                matrix[i, k, column] = -error.imag / (2.0 * w)
                matrix[i, 3 + k, column] = -error.real / (2.0 * w)


@kernel
def _nearest_to_roll(first, last, matrix, values, pair, clear):
    """The two of the eigenvalues (n, 6) nearest to those of roll alone, sway and yaw at rest; are they clearly the nearest?"""
    for i in range(first, last):
        a, b, c, d = matrix[i, 1, 1], matrix[i, 1, 4], matrix[i, 4, 1], matrix[i, 4, 4]
        middle, root = 0.5 * (a + d), np.sqrt(0.25 * (a - d) ** 2 + b * c + 0.0j)
        nearest, second, third = np.inf, np.inf, np.inf
        pair[i, 0] = pair[i, 1] = complex(np.nan, np.nan)
        for s in range(6):
            own = values[i, s]
            away = min(abs(own - (middle + root)), abs(own - (middle - root)))
            if away < nearest:
                nearest, second, third = away, nearest, second
                pair[i, 0], pair[i, 1] = own, pair[i, 0]
            elif away < second:
                second, third = away, second
                pair[i, 1] = own
            elif away < third:
                third = away
        clear[i] = second < _CLEARLY * third


def _in_roll(matrix: Floats) -> Complex:
    """The two eigenvalues (n, 2) of matrices (n, 6, 6) in whose modes roll, variables 1 and 4, takes part most."""
    values, vectors = np.linalg.eig(matrix)
    left = np.linalg.inv(vectors)
    share = np.abs(vectors * left.transpose(0, 2, 1))
    in_roll = share[:, 1] + share[:, 4]
    order = np.argsort(-in_roll, axis=1)[:, :2]
    return np.asarray(np.take_along_axis(values, order, axis=1).astype(complex))


def roll_mode(rows: Any, linear: Any) -> tuple[Any, Any, Any]:
    """Free roll about a motion: frequency, shape, and growth rate away from resonance.

    rows (n, 3, 4): mean of d(v', p', r')/d(v, phi, p, r) over the motion; a stiffness that rights the ship
    linear (n, 3 or 4, s): linear part of the equations, for what an autopilot answers
    Returns n2 (n,): [rad/s]; rho (n, 3): sway [m/rad], roll, yaw; rate (n,): K2/(2 n2) [1/s]

    Analytic in all its arguments, so complex ones give derivatives.  An autopilot without lag answers the heading in
    quadrature with the roll rate; with one, it damps roll through its yaw.  Source: [H71] eqs. (9)-(13).
    """
    stiffness = rows[:, :, 1]
    n2, rho = np.sqrt(-stiffness[:, 1]), stiffness / stiffness[:, [1]]
    rate = 0.5 * contracted(rho, rows[:, 1][:, _VELOCITIES])
    if linear.shape[2] > RUDDER:
        turn_rate, angle, decay = linear[:, 3, 3:].T
        rate = rate - 0.5 * rho[:, 2] * linear[:, 1, RUDDER] * (angle + turn_rate * decay) / (n2**2 + decay**2)
    return n2, rho, rate


def first_order(system: System, phasors: Complex, displacement: Complex, detail: Detail = "full") -> FirstOrder:
    """First-order stability of periodic motions from the harmonics of their variational matrix.

    system: n conditions
    phasors (n, 4, 3, 4): from `variational_harmonics`
    displacement (n, 3): fundamental of sway [m], roll, yaw [rad]: phasors of e^{i w t}
    detail: "full", or what a "map" needs: mean_jacobian stays NaN
    Returns rows of NaN where the motion is NaN; where the mean roll stiffness is negative, n2 and what rests on it

    K2 = n2 sum_j rho_j <d p'/d V_j>; q = K2/(2 n2) +- sqrt(|k_m - i n2 d_m|^2/(16 n2^2) - (m omega/2 - n2)^2) with k_m, d_m
    the modulation of stiffness and damping at m omega (the paper keeps k_m alone).  Source: [H71] eqs. (8)-(15), with n2 t
    in every phase, restoring in all rows, cross averages and rho_3 kept; slow modes and combination are additions.
    Valid: damping small against omega and n2, n2 not near omega (use ``averaged``) unless stated.
    """
    finite = np.isfinite(phasors).reshape(system.count, -1).all(axis=1) & system.finite
    if not finite.all():
        phasors = np.where(finite[:, None, None, None], phasors, 0.0)
    w = np.where(finite, system.frequency, 1.0)
    rows = phasors[:, 0].real.copy()
    mean = rows[:, :, _VELOCITIES]
    oscillates = finite & (rows[:, 1, 1] < 0)
    rows[~oscillates, 1, 1] = -1.0
    own = np.where(finite[:, None, None], system.linear, 0.0)
    n2, rho, rate = roll_mode(rows, own)
    detuning = 0.5 * np.array(RESONANCES) * w[:, None] - n2[:, None]
    kappa = phasors[:, 1:, 1, 1]
    damping = contracted(rho[:, None], phasors[:, 1:, 1][:, :, _VELOCITIES])

    def growth(modulation: Complex) -> Floats:
        root = np.abs(modulation) ** 2 / (16 * n2[:, None] ** 2) - detuning**2
        return rate[:, None] + np.sqrt(np.maximum(root, 0.0))

    course = course_matrix(mean, rho, own)
    slow = course_rates(course)
    spectrum = np.full((w.size, system.states), np.nan, dtype=complex)
    if detail == "full" or system.states > HEADING:
        spectrum[:] = eigenvalues(state_matrix(phasors[:, 0].real, own))
    linear = contracted(rho, system.linear[:, 1][:, _VELOCITIES])
    moved = np.where(finite[:, None], displacement, 0.0)
    cubics, relative = roll_cubics(system, moved), np.abs(through_water(system, moved))
    by_rho = short_index(cubics, relative, w, n2, rho[:, 0]).sum(axis=1) + n2 * linear
    literal = short_index(cubics, np.abs(moved), w, n2, None).sum(axis=1) + n2 * linear

    def known(values: Any, where: Any = oscillates) -> Any:
        if where.all():
            return values
        return np.where(where.reshape(-1, *[1] * (values.ndim - 1)), values, np.nan)

    return FirstOrder(
        n2=known(n2),
        rho=known(rho),
        k2=known(2 * n2 * rate),
        k2_rho=known(by_rho),
        k2_paper=known(literal),
        through_water=known(relative, finite),
        roll_rate=known(rate),
        q_paper=known(growth(kappa)),
        q=known(growth(kappa - 1j * n2[:, None] * damping)),
        slow=known(slow),
        combination=known(combination_rate(w, n2, rho, rate, course, phasors)),
        averaged=known(_averaged_roll_pair(system, phasors, detail), finite),
        mean_jacobian=known(spectrum, finite),
    )

"""Stability of roll in head and following seas: Floquet exponents on the symmetric motion, and on motions of two periods.

On the symmetric motion the variational equations fall apart into those of heave and pitch and those of sway, roll and yaw. With
sway and yaw locked the latter are Hill's equation

    phi'' + 2 zeta omega_0 phi' + omega_0^2 (GM(t)/GM) phi = 0 ,    omega_0^2 = rho g V GM/(I44 + A44(omega/2)) .

A multiplier -1 is a doubling of the period: parametric roll. One of +1 is that of a restoring moment lost for a time.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from quartering._machine.compiled import kernel
from quartering.motion.steady_course.balance import Harmonics
from quartering.motion.steady_course.course import ROLL, SWAY, YAW, Course, roll_inertia
from quartering.motion.steady_course.free_heave import free_matrices
from quartering.motion.steady_course.orbits import POINTS, Orbits, slopes

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

STEPS: Final = 128
"""Runge-Kutta steps of an encounter period no longer than two of roll, with multipliers to 1e-8. Longer ones have more."""


class RollGrowth(NamedTuple):
    """Growth of small roll on symmetric motions of n conditions; NaN where there is none.

    Parameters
    ----------
    growth : (n,) float            largest real part of the exponents of roll, with sway and yaw [1/s]
    multiplier : (n,) complex      over an encounter period, that belongs to it
    course : (n,) float            largest real part of the other exponents: of the course [1/s]
    growth_roll_only : (n,) float  with sway and yaw locked and `roll_damping` as the whole damping [1/s]
    multiplier_roll_only : (n,)    that belongs to it
    gm : (n, t) float              -dK/dphi over the weight along the motion, at equal phases [m]
    """

    growth: Floats
    multiplier: Complex
    course: Floats
    growth_roll_only: Floats
    multiplier_roll_only: Complex
    gm: Floats


def roll_growth(orbits: Orbits, damping: float) -> RollGrowth:
    """Growth of small roll on symmetric motions.

    orbits: symmetric motions
    damping: zeta, fraction of critical at the ship's GM: the whole damping of ``growth_roll_only``

    Sway, roll and yaw have the water's coefficients at half the encounter frequency, where parametric roll lives, and the
    ship's own lift and damping; drag |q| q has no part in a small motion.  Source: Floquet's theorem, closed form.
    """
    course, n = orbits.course, orbits.course.count
    phase = 2 * np.pi * np.arange(POINTS) / POINTS
    by_angle = orbits.slopes(phase)
    gm = -by_angle[:, :, ROLL, ROLL] / course.numbers.scale.prod()
    period = 2 * np.pi / course.numbers.omega
    good = np.isfinite(gm).all(axis=1)
    calm_gm, weight = course.ship.loading.gm, course.numbers.scale.prod()
    inertia = roll_inertia(course.ship, 0.5 * course.numbers.omega)
    w0 = np.sqrt(weight * max(calm_gm, 1e-9) / inertia)
    steps = STEPS * max(1, int(np.ceil((0.5 * w0 / course.numbers.omega).max(initial=0.0))))
    stiffness = np.where(good[:, None], weight * gm / inertia[:, None], 0.0)
    alone = hill_multipliers(stiffness, 2 * damping * w0, period, steps)
    best = np.abs(alone).argmax(axis=1)
    largest = alone[np.arange(n), best]
    rest = _lateral_multipliers(course, np.where(good[:, None, None, None], by_angle, 0.0), period, steps)
    nan = np.where(good, 1.0, np.nan)
    growth, multiplier, off_course = rest
    only = np.log(np.abs(largest)) / period
    return RollGrowth(nan * growth, nan * multiplier, nan * off_course, nan * only, nan * largest, gm)


def hill_multipliers(stiffness: Floats, damping: Floats, period: Floats, steps: int = STEPS) -> Complex:
    """Multipliers (n, 2) of x'' + damping x' + stiffness(t) x = 0 over one period.

    stiffness (n, t): at t equal steps of the period, the first at its beginning [1/s2]
    damping (n,): [1/s]
    period (n,): [s]
    steps: of its integration

    The stiffness is its Fourier series between the samples; Runge-Kutta of order 4.
    """
    nodes = _nodes(stiffness, steps)
    matrix = np.zeros((*nodes.shape, 2, 2))
    matrix[:, :, 0, 1] = 1.0
    matrix[:, :, 1, 0] = -nodes
    matrix[:, :, 1, 1] = -np.asarray(damping)[:, None]
    return _eigenvalues(transition(matrix, np.asarray(period)))


def _eigenvalues(matrices: Floats) -> Complex:
    """Eigenvalues (n, s) of transition matrices (n, s, s); inf where growth over a period is beyond any number."""
    found = np.full(matrices.shape[:2], np.inf, dtype=complex)
    finite = np.isfinite(matrices).all(axis=(1, 2))
    found[finite] = np.linalg.eigvals(matrices[finite])
    return found


def _nodes(values: Floats, steps: int) -> Floats:
    """Samples (n, t, ..) of one period at the 2 steps + 1 nodes of its integration, by their Fourier series."""
    t = values.shape[1]
    spectrum = np.fft.rfft(values, axis=1)
    if t % 2 == 0 and t < 2 * steps:
        spectrum[:, -1] *= 0.5
    fine = np.fft.irfft(spectrum, n=2 * steps, axis=1) * (2 * steps / t)
    return np.concatenate([fine, fine[:, :1]], axis=1)


def transition(matrix: Floats, period: Floats) -> Floats:
    """Transition matrices (n, s, s) over a period of y' = matrix y, given at 2 m + 1 nodes (n, 2 m + 1, s, s)."""
    out = np.empty((matrix.shape[0], *matrix.shape[2:]))
    _transition(np.ascontiguousarray(matrix), np.ascontiguousarray(period, dtype=float), out)
    return out


@kernel
def _transition(matrix, period, out):
    """Runge-Kutta of order 4, a step from node to node but one."""
    steps = (matrix.shape[1] - 1) // 2
    for i in range(matrix.shape[0]):
        h = period[i] / steps
        y = np.eye(matrix.shape[2])
        for n in range(steps):
            a, b, c = matrix[i, 2 * n], matrix[i, 2 * n + 1], matrix[i, 2 * n + 2]
            k1 = a @ y
            k2 = b @ (y + 0.5 * h * k1)
            k3 = b @ (y + 0.5 * h * k2)
            k4 = c @ (y + h * k3)
            y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        out[i] = y


def _lateral_matrices(course: Course, by: Floats) -> Floats:
    """Matrices (n, t, s, s) of (v, phi, p, r), with an autopilot (.., psi[, delta]), from slopes of the forces (n, t, 5, 6)."""
    numbers = course.numbers
    lag = numbers.gains[2] > 0
    states = 4 if not course.steered else 6 if lag else 5
    inverse = np.linalg.inv(numbers.mass[:, 1, SWAY:, SWAY:])
    rows = np.zeros((*by.shape[:2], 3, states))
    rows[..., [0, 2, 3]] = -numbers.damping[:, 1, SWAY:, SWAY:][:, None]
    rows[..., :4] += by[:, :, SWAY:, :][..., [SWAY, ROLL, 5, YAW]]
    if course.steered:
        gain, rate, _ = numbers.gains
        if lag:
            rows[..., 5] += numbers.rudder[:, None, :]
        else:
            rows[..., 4] -= gain * numbers.rudder[:, None, :]
            rows[..., 3] -= rate * numbers.rudder[:, None, :]
    matrix = np.zeros((*by.shape[:2], states, states))
    matrix[:, :, [0, 2, 3]] = inverse[:, None] @ rows
    matrix[:, :, 1, 2] = 1.0
    if course.steered:
        matrix[:, :, 4, 3] = 1.0
    if lag:
        matrix[:, :, 5, 3:] = np.array([-rate, -gain, -1.0]) / numbers.gains[2]
    return matrix


def _lateral_multipliers(course: Course, by: Floats, period: Floats, steps: int) -> tuple[Floats, Complex, Floats]:
    """Largest growth of roll with its multiplier, and of the course."""
    along = _eigenvalues(transition(_nodes(_lateral_matrices(course, by), steps), period))
    still = np.zeros((course.count, 3, *by.shape[2:]))
    weight = course.numbers.scale.prod()
    still[:, :, ROLL, ROLL] = -weight * course.ship.loading.gm
    calm = _lateral_matrices(course, still)[:, 0]
    growth, course_growth = np.full((2, course.count), np.nan)
    multiplier = np.full(course.count, np.nan, dtype=complex)
    beyond = ~np.isfinite(along).all(axis=1)
    growth[beyond], multiplier[beyond] = np.inf, np.inf
    for i in np.flatnonzero(~beyond):
        exponents = np.linalg.eigvals(calm[i])
        expected = np.exp(exponents * period[i])
        of_roll = _roll_pair(calm[i])
        pick = linear_sum_assignment(np.abs(along[i][:, None] - expected[None, :]))[1]
        mine = np.isin(pick, of_roll)
        roll = along[i][mine]
        multiplier[i] = roll[np.abs(roll).argmax()]
        growth[i] = np.log(np.abs(multiplier[i])) / period[i]
        course_growth[i] = np.log(np.abs(along[i][~mine]).max()) / period[i]
    return growth, multiplier, course_growth


def _roll_pair(matrix: Floats) -> NDArray[np.int64]:
    """Which two eigenvalues of the calm-water matrix are of roll: the pair nearest to the frequency of roll."""
    exponents = np.linalg.eigvals(matrix)
    natural = np.sqrt(max(-matrix[2, 1], 0.0))
    distance = np.hypot(exponents.real, np.abs(exponents.imag) - natural)
    return np.argsort(distance)[:2]


def forced_growth(orbits: Orbits) -> tuple[float, complex]:
    """Growth [1/s] of a disturbance of the forced motion of one condition, that of the course left out, and its multiplier.

    The multipliers nearest to those of the course in calm water are left out. Coefficients as in `doubled_multipliers`.
    """
    rates, multipliers = growths(orbits.course, orbits.basis, orbits.x, 1)
    return float(rates[0]), complex(multipliers[0])


def growths(course: Course, basis: Harmonics, x: Floats, periods: int) -> tuple[Floats, Complex]:
    """Growth (n,) [1/s] of disturbances of motions (n, m) of one condition and their multipliers over one or two periods.

    Notes
    -----
    The multipliers nearest to those of the course in calm water are left out. Coefficients as in `doubled_multipliers`.
    """
    time = periods * 2 * np.pi / float(course.numbers.omega[0])
    found = doubled_multipliers(course, basis, x, mirrored=False, periods=periods)
    still = np.zeros((1, 1, 5, 6))
    still[0, 0, ROLL, ROLL] = -course.numbers.scale.prod() * course.ship.loading.gm
    calm = _lateral_matrices(course, still)[0, 0]
    expected = np.exp(np.delete(np.linalg.eigvals(calm), _roll_pair(calm)) * time)
    largest = np.full(len(x), np.inf, dtype=complex)
    for i in np.flatnonzero(np.isfinite(found).all(axis=1)):
        kept = np.delete(found[i], linear_sum_assignment(np.abs(expected[:, None] - found[i][None, :]))[1])
        largest[i] = kept[np.abs(kept).argmax()]
    return np.asarray(np.log(np.abs(largest)) / time), largest


def doubled_multipliers(
    course: Course, basis: Harmonics, x: Floats, mirrored: bool = True, periods: int = 1
) -> Complex:
    """Multipliers (n, s) of motions of two periods (n, m) of one condition, each over one period and a mirror.

    course: one condition, in the wave of the motions
    basis: of two periods
    x (n, m)
    mirrored: False: over periods alone, without the mirror
    periods: one, or two of motions without symmetry
    Returns (n, s): of heave, pitch, their rates, v, phi, p, r and the autopilot's states; a motion whose largest is
        below 1 in size is stable; infinite where the hull leaves its tables

    phi(t + T) = -phi(t), h(t + T) = h(t), so a disturbance after one period, port and starboard exchanged, meets the equations
    it met before. The water's coefficients are those at omega in heave and pitch, or at the lowest frequency above with which
    they die out in calm water, and at omega/2 in sway, roll and yaw.
    """
    many = course.at_amplitude(np.full(len(x), course.numbers.amplitude[0]))
    natural = np.sqrt(
        course.numbers.scale.prod() * max(course.ship.loading.gm, 0.0) / course.numbers.mass[0, 1, ROLL, ROLL]
    )
    steps = periods * STEPS // 2 * max(1, int(np.ceil(0.5 * natural / course.numbers.omega[0])))
    phase = periods * 2 * np.pi * np.arange(2 * steps + 1) / (2 * steps)
    by = slopes(many, basis, x, phase)
    lateral = _lateral_matrices(many, by)
    s = lateral.shape[2]
    matrix = np.zeros((len(x), phase.size, 4 + s, 4 + s))
    matrix[:, :, 4:, 4:] = lateral
    mass, damping, _ = free_matrices(course.ship, course.numbers.omega, course.speed)
    up = np.linalg.inv(mass)
    across = np.linalg.inv(many.numbers.mass[:, 1, SWAY:, SWAY:])
    matrix[:, :, [0, 1], [2, 3]] = 1.0
    matrix[:, :, 2:4, 0:2] = up[:, None] @ by[:, :, :2, :2]
    matrix[:, :, 2:4, 2:4] = -(up @ damping)[:, None]
    matrix[:, :, 2:4, 4:8] = up[:, None] @ by[:, :, :2, :][..., [SWAY, ROLL, 5, YAW]]
    coupled = across[:, None] @ by[:, :, SWAY:, :2]
    for row, state in enumerate((4, 6, 7)):
        matrix[:, :, state, 0:2] = coupled[:, :, row]
    mirror = np.concatenate([np.ones(4), np.full(s, -1.0 if mirrored else 1.0)])
    whole = transition(matrix, periods * 2 * np.pi / many.numbers.omega)
    inside = np.asarray(np.isfinite(whole).all(axis=(1, 2)))
    found = np.linalg.eigvals(mirror[:, None] * np.where(inside[:, None, None], whole, 0.0))
    return np.where(inside[:, None], found, np.inf).astype(np.complex128)

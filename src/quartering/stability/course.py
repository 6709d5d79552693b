"""First-order stability of the course: the slow sway-yaw modes averaged over the wave, alone and combined with roll."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import kernel
from quartering._machine.threads import in_threads
from quartering.motion.equations.steering import HEADING, RUDDER
from quartering.motion.equations.system import Floats
from quartering.stability.variational.eigenvalues import eigenvalues

Complex = NDArray[np.complex128]
_OF_MODE = (0, 2, 3)
"""State that is the velocity of sway, roll, yaw."""


def course_matrix(mean: Floats, rho: Floats, linear: Floats) -> Floats:
    """Averaged equations of the sway-yaw modes; with an autopilot the heading and the rudder are added.

    mean (n, 3, 3): mean of d(v', p', r')/d(v, p, r) over the motion
    rho (n, 3): shape of the free roll mode
    linear (n, 3 or 4, s): linear part of the equations, for what an autopilot answers
    Returns (n, 2, 2): rows and columns v, r; (n, 3, 3) with psi, (n, 4, 4) with psi and delta

    The modes are e_k = v_k - rho_k p of k = sway, yaw, which do not oscillate.
    Source: [H71] eq. (8), averaged over the wave (an addition).  Valid: as `first_order`.

    >>> course_matrix(np.diag([-0.1, -0.2, -0.3])[None], np.array([[0.0, 1.0, 0.0]]), np.zeros((1, 3, 4)))[0].tolist()
    [[-0.1, 0.0], [0.0, -0.3]]
    """
    sway_yaw = mean[:, [0, 2]][:, :, [0, 2]] - rho[:, [0, 2], None] * mean[:, 1][:, None, [0, 2]]
    states = linear.shape[2]
    if states <= HEADING:
        return np.asarray(sway_yaw)
    matrix = np.zeros((len(mean), states - 2, states - 2))
    matrix[:, :2, :2] = sway_yaw
    matrix[:, :2, 2:] = linear[:, [0, 2], HEADING:] - rho[:, [0, 2], None] * linear[:, [1], HEADING:]
    matrix[:, 2, 1] = 1.0
    if states > RUDDER:
        matrix[:, 3, 1:] = linear[:, 3, 3:]
    return matrix


def course_rates(course: Floats) -> Floats:
    """Growth rates of the averaged sway-yaw modes.

    course (n, s, s): from `course_matrix`
    Returns (n, s): real parts of the eigenvalues, the largest first [1/s]

    Source: closed form for two modes, eigenvalues for more.

    >>> course_rates(np.diag([-0.5, -0.25])[None]).tolist()
    [[-0.25, -0.5]]
    """
    if course.shape[1] == 2:
        return _real_parts(course)
    return np.asarray(-np.sort(-eigenvalues(course).real, axis=1))


def _real_parts(matrix: Floats) -> Floats:
    """Real parts (n, 2) of the eigenvalues of 2 x 2 matrices, the larger first."""
    (a, b), (c, d) = matrix.transpose(1, 2, 0)
    middle, apart = 0.5 * (a + d), np.sqrt(np.maximum(0.25 * (a - d) ** 2 + b * c, 0.0))
    return np.stack([middle + apart, middle - apart], axis=1)


def combination_rate(w: Floats, n2: Floats, rho: Floats, rate: Floats, slow: Floats, phasors: Complex) -> Floats:
    """Largest growth rate of roll combined with the slow modes through modulation at 2 omega, near n2 = 2 omega.

    w (n,): omega [rad/s]
    from `roll_mode`
    slow (n, s, s): from `course_matrix`
    phasors (n, 4, 3, 4): from `variational_harmonics`
    Returns (n,): [1/s]

    Source: [H71] eq. (8), averaged as its eqs. (13)-(15) are, for the combination the paper leaves out (an addition).
    Valid: as `first_order`.
    """
    states = 2 + slow.shape[1]
    matrix = np.zeros((w.size, states, states))
    given = (np.require(a, requirements=("C", "W")) for a in (w, n2, rho, rate, slow, phasors))
    in_threads(_combined, w.size, *given, matrix)
    return np.asarray(eigenvalues(matrix).real.max(axis=1))


@kernel
def _combined(first, last, w, n2, rho, rate, slow, phasors, matrix):
    """Matrices (n, s, s) of roll's slowly varying amplitude and the slow modes."""
    for i in range(first, last):
        by = 4j * n2[i]
        damping = 0.0j
        for j in range(3):
            damping += rho[i, j] * phasors[i, 2, 1, _OF_MODE[j]]
        c = (phasors[i, 2, 1, 1] - 1j * n2[i] * damping) / by
        diagonal = rate[i] - 1j * (2.0 * w[i] - n2[i])
        matrix[i, 0, 0], matrix[i, 0, 1] = (diagonal + c).real, -(diagonal - c).imag
        matrix[i, 1, 0], matrix[i, 1, 1] = (diagonal + c).imag, (diagonal - c).real
        of_roll = 0.0j
        for j in range(3):
            of_roll += phasors[i, 1, 1, _OF_MODE[j]] * rho[i, j]
        for m in range(2):
            k = 2 * m  # sway, yaw
            into_roll = phasors[i, 1, 1, _OF_MODE[k]] / by
            own = 0.0j
            for j in range(3):
                own += phasors[i, 1, k, _OF_MODE[j]] * rho[i, j]
            drive = 1j * n2[i] * np.conj(own - rho[i, k] * of_roll)
            matrix[i, 0, 2 + m], matrix[i, 1, 2 + m] = into_roll.real, into_roll.imag
            matrix[i, 2 + m, 0], matrix[i, 2 + m, 1] = drive.real, -drive.imag
        for a in range(slow.shape[1]):
            for b in range(slow.shape[1]):
                matrix[i, 2 + a, 2 + b] = slow[i, a, b]

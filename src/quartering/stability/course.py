"""First-order stability of the course: the slow sway-yaw modes averaged over the wave, alone and combined with roll."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering._machine.rowwise import contracted
from quartering.motion.equations.steering import HEADING, RUDDER
from quartering.motion.equations.system import Floats
from quartering.stability.variational.eigenvalues import eigenvalues

Complex = NDArray[np.complex128]
_VELOCITIES = [0, 2, 3]


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
    n = w.size
    two, four = phasors[:, 1], phasors[:, 2]
    d2, d4 = two[:, :, _VELOCITIES], four[:, :, _VELOCITIES]
    c = (four[:, 1, 1] - 1j * n2 * contracted(rho, d4[:, 1])) / (4j * n2)
    diagonal = rate - 1j * (2 * w - n2)
    into_roll = d2[:, 1][:, [0, 2]] / (4j * n2)[:, None]
    modulation = contracted(d2, rho[:, None])
    drive = 1j * n2[:, None] * np.conj(modulation - rho * modulation[:, [1]])[:, [0, 2]]
    states = 2 + slow.shape[1]
    matrix = np.zeros((n, states, states))
    matrix[:, 0, 0] = (diagonal + c).real
    matrix[:, 0, 1] = -(diagonal - c).imag
    matrix[:, 1, 0] = (diagonal + c).imag
    matrix[:, 1, 1] = (diagonal - c).real
    matrix[:, 0, 2:4], matrix[:, 1, 2:4] = into_roll.real, into_roll.imag
    matrix[:, 2:4, 0], matrix[:, 2:4, 1] = drive.real, -drive.imag
    matrix[:, 2:, 2:] = slow
    return np.asarray(eigenvalues(matrix).real.max(axis=1))

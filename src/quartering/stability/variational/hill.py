"""Floquet exponents from Hill's infinite determinant: independent of any integration in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.motion.equations.model import Model
from quartering.motion.equations.steering import state_matrix
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.motion import Motion
from quartering.motion.steady.subharmonic import slowed
from quartering.stability.variational.variation import variational_harmonics

_CANDIDATES, _SAME, _FARTHEST = 16, 1e-7, 200


@takes(model="Model", motion="Motion")
def hill_exponents(model: Model, motion: Motion, reach: int = 10) -> tuple[NDArray[np.complex128], float]:
    """Floquet exponents of a periodic motion by Hill's determinant: a check that integrates nothing in time.

    Parameters
    ----------
    model : Model
    motion : Motion
    reach : int        harmonics of the disturbance kept on each side, 1 to 200; of a symmetric motion even ones alone

    Returns
    -------
    exponents : (s,) complex    [1/s], the largest real part first; imaginary parts modulo the frequency
    defect : float              |sum of the exponents - mean trace| over the largest exponent: beside 1e-6 a wrong eigenvalue
                                was taken; then raise `reach`, or trust the verdict's multipliers

    Raises
    ------
    InputError    a motion without an answer, or `reach` out of its range

    Notes
    -----
    Source: Hill (1886), as in [Krack19].  Valid: smooth terms; with |p| p or strip-wise drag the harmonics fall off slowly.

    Examples
    --------
    >>> from quartering.motion.steady.motion import steady_motion
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -0.5}
    >>> model = Model(np.eye(3), terms, 0.8, (0, 0.01, 0), (0, 0, 0))
    >>> hill_exponents(model, steady_motion(model))[0].real.round(9).tolist()
    [-0.05, -0.05, -0.5, -1.0]
    """
    if not motion.status.ok:
        raise InputError(f"hill_exponents: this motion is no answer ({motion.status.advice}); give one that is")
    if not (isinstance(reach, int) and 1 <= reach <= _FARTHEST):
        raise InputError(f"reach = {reach!r}; it is a whole number of harmonics from 1 to {_FARTHEST}, such as 10")
    system = slowed(model.system, motion.periods)  # of a subharmonic motion, at the frequency of its own period
    exponents, defect = exponents_of_batch(system, motion.coefficients[None], motion.orders_with_mean, reach)
    return exponents[0], float(defect[0])


def exponents_of_batch(
    system: System, u: Floats, orders: tuple[int, ...], reach: int = 10
) -> tuple[NDArray[np.complex128], Floats]:
    """Floquet exponents of periodic motions from the harmonics of their variational matrix.

    system: n conditions
    u (n, 3, b): motions, as from `harmonic_balance`
    orders: their harmonics
    reach: harmonics of the disturbance kept on each side (even ones alone for a symmetric motion)
    Returns exponents (n, s): [1/s], the largest real part first; imaginary parts modulo the frequency; defect (n,):
        |sum of the exponents - mean trace|, relative to the largest exponent: large when a wrong eigenvalue was taken;
        then raise `reach` or trust `floquet`

    With J(t) = sum_m J_m e^{i m w t} and a disturbance e^{lambda t} sum_m y_m e^{i m w t}, lambda is an eigenvalue of the
    block matrix J_{m-n} - i m w. Each true exponent appears many times, shifted by multiples of i w; the s whose
    eigenvectors are centred on m = 0 are the converged ones.  Source: Hill (1886), as in [Krack19].
    Valid: smooth products; with a modulus the harmonics fall off slowly.
    """
    stride = 2 if all(h % 2 == 1 for h in orders) else 1
    wanted = tuple(range(0, 2 * reach * stride + 1, stride))
    phasors = variational_harmonics(system, u, orders, wanted)
    states = system.states
    blocks = np.zeros((system.count, len(wanted), states, states), dtype=complex)
    blocks[:, 1:, [0, 2, 3], :4] = 0.5 * phasors[:, 1:]
    blocks[:, 0] = state_matrix(phasors[:, 0], system.linear)
    rows = 2 * reach + 1
    matrix = np.zeros((system.count, rows, states, rows, states), dtype=complex)
    for m in range(rows):
        for n in range(rows):
            block = blocks[:, abs(m - n)]
            matrix[:, m, :, n] = block if m >= n else block.conj()
    orders_kept = stride * np.arange(-reach, reach + 1)
    for m, order in enumerate(orders_kept):
        matrix[:, m, range(states), m, range(states)] -= 1j * order * system.frequency[:, None]
    values, vectors = np.linalg.eig(matrix.reshape(system.count, states * rows, states * rows))
    weight = (np.abs(vectors.reshape(system.count, rows, states, -1)) ** 2).sum(axis=2)
    centre = np.abs((orders_kept[:, None] * weight).sum(axis=1) / weight.sum(axis=1))
    best = np.argsort(centre, axis=1, kind="stable")[:, :_CANDIDATES]
    exponents = _distinct(np.take_along_axis(values, best, axis=1), stride * system.frequency, states)
    exponents = np.take_along_axis(exponents, np.argsort(-exponents.real, axis=1, kind="stable"), axis=1)
    trace = np.einsum("nii->n", blocks[:, 0]).real
    defect = np.abs(exponents.sum(axis=1).real - trace) / np.abs(exponents).max(axis=1)
    return exponents, defect


def _distinct(candidates: NDArray[np.complex128], shift: Floats, count: int) -> NDArray[np.complex128]:
    """First `count` (n, count) of the candidates (n, c) that are no copies of each other, shifted by multiples of i shift."""
    rows = np.arange(len(candidates))
    free = np.ones(candidates.shape, dtype=bool)
    found = np.empty((len(candidates), count), dtype=complex)
    for k in range(count):
        pick = free.argmax(axis=1)
        found[:, k] = candidates[rows, pick]
        turns = (candidates - found[:, [k]]) / (1j * shift[:, None])
        copies = np.abs(turns - np.round(turns.real)) < _SAME
        free &= ~copies
        free[rows, pick] = False
    return found

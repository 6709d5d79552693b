"""Kinds of instability, and how a verdict is assigned to one."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.steering import state_matrix
from quartering.motion.equations.system import System
from quartering.stability.variational.eigenvalues import eigenvalues
from quartering.stability.variational.floquet import Floquet

_MOSTLY_ROLL, _HARDLY_ROLL = 0.6, 0.25
_NEAR = 0.5


class Kind(IntEnum):
    """Mechanism of an instability, decided by the Floquet multipliers and who takes part in the growing mode.

    Notes
    -----
    Stored as int8 in datasets, with CF ``flag_values`` and ``flag_meanings``.

    Examples
    --------
    >>> Kind.COURSE_IN_CALM_WATER.label
    'course-in-calm-water'
    """

    NO_ANSWER = -1
    STABLE = 0
    ROLL = 1
    FOLD = 2
    SYMMETRY_BREAKING = 3
    COURSE = 4
    COURSE_IN_CALM_WATER = 5
    COMBINATION = 6
    PERIOD_DOUBLING = 7
    PURE_LOSS = 8

    @property
    def label(self) -> str:
        """Name as shown to people and stored in datasets."""
        return self.name.lower().replace("_", "-")

    @property
    def meaning(self) -> str:
        """One clause: what grows and why."""
        return _MEANING[self]


_MEANING = {
    Kind.NO_ANSWER: "no periodic motion to judge",
    Kind.STABLE: "every small disturbance dies out",
    Kind.ROLL: "roll grows beside the wave-driven motion, fed by sway and yaw",
    Kind.FOLD: "roll locked to the wave grows until the motion jumps to another one",
    Kind.SYMMETRY_BREAKING: "the ship leans to one side more and more",
    Kind.COURSE: "the ship leaves its course: a slow sway-yaw motion grows because of the wave",
    Kind.COURSE_IN_CALM_WATER: "the ship is unstable on course without any wave; the wave is not to blame",
    Kind.COMBINATION: "roll and the slow sway-yaw motion grow together",
    Kind.PERIOD_DOUBLING: "roll at half the encounter frequency grows",
    Kind.PURE_LOSS: "the righting moment is lost for a part of each wave, and roll grows",
}


def linear_exponents(system: System) -> NDArray[np.complex128]:
    """Exponents of the linear motion without waves, with the coefficients of each condition.

    system: n conditions
    Returns (n, s): [1/s], the largest real part first; NaN where a coefficient is

    Eigenvalues of the linear part in (v, phi, p, r), psi and delta of an autopilot.  Source: [H71] eq. (3), linear terms.

    >>> from quartering.motion.equations.model import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -0.5}
    >>> linear_exponents(Model(np.eye(3), terms, 0.8, (0, 0, 0), (0, 0, 0)).system)[0].real.round(3).tolist()
    [-0.05, -0.05, -0.5, -1.0]
    """
    finite = system.finite
    linear = np.where(finite[:, None, None], system.linear, 0.0)
    # The heights of one condition stand together and share their coefficients.
    fresh = np.ones(system.count, dtype=bool)
    fresh[1:] = (linear[1:] != linear[:-1]).any(axis=(1, 2))
    different = linear[fresh]
    values = eigenvalues(state_matrix(different[:, :3, :4], different))
    values = np.take_along_axis(values, np.argsort(-values.real, axis=1, kind="stable"), axis=1)
    values = values[np.cumsum(fresh) - 1]
    values[~finite] = np.nan
    return np.asarray(values)


def growing_mode(result: Floquet, calm: NDArray[np.complex128]) -> NDArray[np.int64]:
    """Index of the mode that names the instability.

    calm (n, s): calm-water exponents [1/s]
    Returns (n,): the largest multiplier; but where the ship is course-unstable without waves, an unstable mode that is
        not the course mode goes first, because that one is the wave's doing

    Source: participation of eigenvectors; a choice of this library.
    """
    unstable = np.abs(np.nan_to_num(result.multipliers)) > 1.0
    by_wave = unstable & (result.roll_share >= _MOSTLY_ROLL) & (calm[:, :1].real > 0)
    return np.where(by_wave.any(axis=1), by_wave.argmax(axis=1), 0)


def kinds(result: Floquet, calm: NDArray[np.complex128]) -> NDArray[np.int8]:
    """Mechanism of each motion's instability, or that it is stable.

    result: n motions
    calm (n, s): calm-water exponents [1/s]
    Returns (n,): values of `Kind`

    Symmetric motions: half-period multiplier real negative, a fold; real positive, symmetry breaking when roll carries it
    and course when sway and yaw do; complex, roll, combination or course by the share of roll.  Others: a negative
    multiplier is period doubling, a positive one a fold.  Source: symmetry of [H71] eq. (3); shares are this library's.
    """
    modulus = np.abs(result.multipliers[:, 0])
    kind = np.where(np.isfinite(modulus), Kind.STABLE, Kind.NO_ANSWER).astype(np.int8)
    grows = np.flatnonzero(modulus >= 1.0)
    if grows.size:
        kind[grows] = _mechanisms(result, calm, grows)
    return kind


def _mechanisms(result: Floquet, calm: NDArray[np.complex128], rows: NDArray[np.intp]) -> NDArray[np.int8]:
    """Mechanisms of some of the motions, all of them unstable."""
    mode, calm = growing_mode(result, calm)[rows], calm[rows]
    multiplier, half = result.multipliers[rows, mode], result.half[rows, mode]
    share = result.roll_share[rows, mode]
    symmetric = np.isfinite(half)
    deciding = np.where(symmetric, half, multiplier)
    real = np.abs(deciding.imag) <= 1e-9 * np.abs(deciding)
    negative = real & (deciding.real < 0)
    by_share = np.where(share >= _MOSTLY_ROLL, Kind.ROLL, np.where(share < _HARDLY_ROLL, Kind.COURSE, Kind.COMBINATION))
    positive = np.where(symmetric, Kind.SYMMETRY_BREAKING, Kind.FOLD)
    kind = np.where(real, np.where(share >= _HARDLY_ROLL, positive, Kind.COURSE), by_share)
    kind = np.where(negative, np.where(symmetric, Kind.FOLD, Kind.PERIOD_DOUBLING), kind)
    kind = np.where((kind == Kind.COURSE) & (calm[:, 0].real > 0), Kind.COURSE_IN_CALM_WATER, kind)
    return np.asarray(kind.astype(np.int8))


def near_fold(result: Floquet) -> NDArray[np.bool_]:
    """Stable motions on whose branch a fold is near.

    result: n motions
    Returns (n,)

    At a fold of symmetric motions a half-period multiplier is -1, as the disturbance follows the motion into its mirror image;
    away from folds roll's two are complex.  Here: one that is real, below -1/2.  Only symmetric motions are told.
    Source: [Krack19]; the half is this library's.
    """
    half = np.nan_to_num(result.half)
    return np.asarray(((np.abs(half.imag) <= 1e-9 * np.abs(half)) & (half.real < -_NEAR)).any(axis=1))

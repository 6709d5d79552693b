"""Contribution of each coefficient to the growth rate."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from quartering.motion.equations.basis import waves_at
from quartering.motion.equations.model import Model
from quartering.motion.equations.program import PLAIN
from quartering.motion.equations.steering import state_matrix
from quartering.motion.equations.system import System
from quartering.motion.equations.terms import parse
from quartering.motion.equations.water import SWAY, YAW
from quartering.motion.steady.derivative import variables_along
from quartering.motion.steady.motion import Motion
from quartering.motion.steady.subharmonic import slowed
from quartering.names import RUDDER_NAMES

_ROWS_OF_STATE = (0, 2, 3)
_SAMPLES = 128


def contributions(model: Model, motion: Motion, oscillating: bool) -> dict[str, float]:
    """Share of every named coefficient in the growth rate of the roll mode or of the slowest course mode.

    motion: its steady motion
    oscillating: True for the roll mode, False for the non-oscillating (course) mode that grows most
    Returns term name -> part of the growth rate [1/s], the most destabilising first; with the share of phi' = p and
        psi' = r (none in roll alone) they add up to the mode's growth rate by the mean variational matrix

    With l and r the left and right eigenvectors of the mean variational matrix (l r = 1), its eigenvalue is l J r, which is
    linear in the coefficients.  Source: first-order perturbation of eigenvalues; [H71] eq. (13) is its small-damping limit.
    """
    inverse = np.linalg.inv(model.inertia)
    phases = 2 * np.pi * np.arange(_SAMPLES) / _SAMPLES
    states = motion.state(phases / motion.frequency)
    system = slowed(model.system, motion.periods)
    passing = states.copy()  # velocities through the water
    if model.water is not None:
        passing[:, [SWAY, YAW]] = variables_along(system, states, phases)[:, PLAIN:]
    parts: dict[str, np.ndarray] = {}
    for name, value in model.terms.items():
        if name in RUDDER_NAMES:
            continue  # together with the gains, below
        row, factors = parse(name)
        own = states if factors.degree == 1 or "phi" in name else passing
        gradient = _mean_gradient(own, np.array(factors.powers), factors.modulus)
        matrix = np.zeros((4, 4))
        matrix[list(_ROWS_OF_STATE)] = value * np.outer(inverse[:, row], gradient)
        parts[name] = matrix
    if model.restoring is not None:
        gradient = np.array([0.0, np.mean(model.restoring.derivative(states[:, 1])), 0.0, 0.0])
        matrix = np.zeros((4, 4))
        matrix[list(_ROWS_OF_STATE)] = np.outer(inverse[:, 1], gradient)
        parts["K_phi spline"] = matrix
    if model.strips is not None:
        parts["cross-flow drag"] = _by_strips(system, states, phases)
    kinematic = state_matrix(np.zeros((1, 3, 4)), np.zeros_like(model.system.linear))[0]
    if model.autopilot is not None:
        parts = {name: np.pad(matrix, (0, len(kinematic) - 4)) for name, matrix in parts.items()}
        parts["autopilot"] = _by_autopilot(model) - kinematic
    values, vectors = np.linalg.eig(sum(parts.values(), kinematic))
    vectors = vectors.astype(complex)
    left = np.linalg.inv(vectors)
    share = np.abs(vectors.T * left)
    roll_share = (share[:, 1] + share[:, 2]) / share.sum(axis=1)
    mode = (
        int(np.argmax(roll_share)) if oscillating else int(np.argmax(np.where(roll_share < 0.5, values.real, -np.inf)))
    )
    rates = {name: float((left[mode] @ matrix @ vectors[:, mode]).real) for name, matrix in parts.items()}
    return dict(sorted(rates.items(), key=lambda item: -item[1]))


def _by_strips(system: System, states: np.ndarray, phases: np.ndarray) -> np.ndarray:
    """What drag by strips adds to the mean matrix of the state (4, 4): push of the mean of 2 |q| e e^T."""
    form, water = system.strips[0, :, :3], system.strips[0, :, 3:]
    still = waves_at(system.periods * phases, 3)[1:].T @ water.T
    size = np.abs(states[:, _ROWS_OF_STATE] @ form.T - still).mean(axis=0)
    matrix = np.zeros((4, 4))
    where = np.ix_(_ROWS_OF_STATE, _ROWS_OF_STATE)
    matrix[where] = system.push[0] @ np.einsum("z,za,zb->ab", 2 * size, form, form)
    return matrix


def _by_autopilot(model: Model) -> np.ndarray:
    """What the autopilot adds to the matrix of the state (s, s), kinematics included."""
    steered, bare = model.system.linear, replace(model, autopilot=None).system.linear
    return np.asarray(state_matrix(steered[:, :3, :4] - bare, steered)[0])


def _mean_gradient(states: np.ndarray, powers: np.ndarray, modulus: int) -> np.ndarray:
    """Average over the motion of the gradient (4,) of one product by (v, phi, p, r)."""
    size = np.abs(states[:, modulus - 1]) if modulus else np.ones(len(states))
    gradient = np.zeros(4)
    for s in range(4):
        if powers[s] > 0:
            lower = powers - np.eye(4, dtype=int)[s]
            gradient[s] = np.mean(powers[s] * np.prod(states**lower, axis=1) * size)
    if modulus:
        sign = np.sign(states[:, modulus - 1])
        gradient[modulus - 1] += np.mean(np.prod(states**powers, axis=1) * sign)
    return gradient

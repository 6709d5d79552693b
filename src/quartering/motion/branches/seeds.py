"""Starting points of the search for motions: roll amplitudes, phases and heels up to the range of the restoring moment."""

from __future__ import annotations

import numpy as np

from quartering.motion.equations.system import Floats, System

_HEELED_STARTS = (2, 3, 6)
_LARGEST = 1e3
_BEYOND = 1.3


def largest_roll(system: System) -> float:
    """Roll amplitude up to which motions are sought: well beyond the last one that the frequency could keep up by itself.

    system: one condition
    Returns [rad]

    At least twice the angle where the cubic restoring equals the linear, up to 2 (1.5 without a cubic); and 1.3 times the
    largest amplitude up to 1000 (pi with a righting curve) of which the free motion has the wave's frequency, where that is
    further.
    Source: closed form, K_phi phi = K_phiphiphi phi^3; describing function of the restoring moment. The bounds are ours.
    """
    stiffness = np.abs(system.linear[0, 1, 1])
    cubic = (system.powers[:, 1] == 3) & (system.powers.sum(axis=1) == 3) & (system.modulus == 0)
    hard: float = np.abs(system.coefficients[0, 1, cubic]).sum()
    if system.knots.shape[1]:
        table = system.arm[0, 1] * system.cubics[0, :, 3]
        hard += np.abs(np.diff(table, prepend=0.0)).sum()
    plain = float(min(2.0, 2.0 * np.sqrt(stiffness / hard))) if hard > 0 else 1.5
    return max(plain, _BEYOND * _free_roll(system))


def _free_roll(system: System) -> float:
    """Largest amplitude whose free roll, alone, has the frequency of the wave; 0 where there is none.

    The moment at A cos s has the first harmonic -N(A) A, N its describing function; the free motion of that amplitude has
    the frequency sqrt(N(A)).
    """
    sizes = np.geomspace(1e-2, np.pi if system.knots.shape[1] else _LARGEST, 400)
    cosine = np.cos((np.arange(64) + 0.5) * np.pi / 64)
    stiffness = -2.0 * (_restoring(system, sizes[:, None] * cosine) @ cosine) / (64 * sizes)
    excess = stiffness - system.frequency[0] ** 2
    crossings = np.flatnonzero(excess[:-1] * excess[1:] <= 0)
    return float(sizes[crossings[-1] + 1]) if crossings.size else 0.0


def _restoring(system: System, roll: Floats) -> Floats:
    """Roll acceleration by roll alone, from the linear term, the products and the table."""
    total = system.linear[0, 1, 1] * roll
    alone = system.powers.sum(axis=1) == system.powers[:, 1]
    for power, bars, a in zip(
        system.powers[alone, 1], system.modulus[alone], system.coefficients[0, 1, alone], strict=True
    ):
        if bars in (0, 2):
            total = total + a * roll**power * (np.abs(roll) if bars == 2 else 1.0)
    if system.knots.shape[1]:
        size = np.abs(roll)
        piece = np.clip(np.searchsorted(system.knots[0], size, side="right") - 1, 0, None)
        x = size - system.knots[0][piece]
        a, b, c, d = system.cubics[0][piece].transpose(2, 0, 1)
        total = total + system.arm[0, 1] * np.sign(roll) * (a + x * (b + x * (c + x * d)))
    return np.asarray(total)


def grid_of_roll(largest: float, sizes: int, angles: int, column: int, width: int) -> Floats:
    """Starts (n, 3, width) with roll alone: amplitudes times phases, in the two columns from `column`."""
    amplitude = largest * (np.arange(sizes) + 1) / sizes
    phase = 2 * np.pi * np.arange(angles) / angles
    start = np.zeros((sizes * angles, 3, width))
    start[:, 1, column] = np.outer(amplitude, np.cos(phase)).ravel()
    start[:, 1, column + 1] = np.outer(amplitude, np.sin(phase)).ravel()
    return start


def heeled_starts(system: System) -> list[Floats]:
    """Starts with harmonics (0, 1, 2) that heel to either side."""
    heels, sizes, angles = _HEELED_STARTS
    largest, starts = largest_roll(system), []
    for heel in largest * np.arange(-heels, heels + 1) / (2 * heels):
        if heel != 0:
            some = grid_of_roll(largest, sizes, angles, 1, 5)
            some[:, 1, 0] = heel
            starts += list(some)
    return starts

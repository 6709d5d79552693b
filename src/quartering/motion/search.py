"""All periodic motions that coexist in one condition: along the branch from rest, and from grids of starts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from quartering.conventions import InputError
from quartering.motion.batch import copies
from quartering.motion.branch import balance_of, follow_branch, start_of_branch
from quartering.motion.equations import Floats, Model, System
from quartering.motion.harmonic import harmonic_balance, orders_for
from quartering.motion.status import Status
from quartering.motion.steady import Motion, motion_record
from quartering.motion.subharmonic import ascending, columns, orders_of, rearranged, slowed
from quartering.motion.switching import disturbance

_ANGLES, _SIZES = 12, 12
_FEW = 4
_OFFSETS, _ITERATIONS = (0.1, 0.3), 10
_HEELED_STARTS = (2, 3, 6)
_SAME, _ZERO = 1e-6, 1e-5
_LOW = 3


def periodic_motions(model: Model, harmonics: int = 9) -> list[Motion]:
    """Every periodic motion found in one condition, from the smallest roll to the largest.

    Parameters
    ----------
    model : Model
    harmonics : int    of the motions returned, odd

    Returns
    -------
    list of Motion     of the wave's period, leaning ones among them, and of twice that (``periods`` is 2)

    Raises
    ------
    InputError         `harmonics` even, not positive or above 199

    Notes
    -----
    Motions of the wave's period: from the linear solution, along the branch from rest to twice the excitation, and by Newton's
    method from grids of roll amplitudes, phases and heels; leaning ones also beside the symmetric ones, each with its
    mirror image.  Motions of two periods: from those of one, disturbed at half the frequency.  Nothing proves that no
    further motion exists.
    Source: [Krack19]; [H71] eq. (A-11) has up to as many roots as its cubics allow.

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.2, (0, 0.1, 0), (0, 0, 0))
    >>> [round(float(m.amplitude[1]), 2) for m in periodic_motions(model, 5)]
    [0.23, 1.63, 1.76]
    """
    system = model.system
    orders, whole = orders_for(system, harmonics), orders_of(harmonics, 1)
    low, seeds = from_grid(system)
    begun = _polished(system, _heeled_starts(system), (0, 1, 2), orders_of(_LOW, 1))
    heeled = [rearranged(u[None], orders_of(_LOW, 1), whole)[0] for u, _, _ in begun]
    starts = [rearranged(u[None], low, orders)[0] for u in (*_from_branch(model), *seeds)]
    leaning: list[tuple[Floats, int, float]] = []
    if not system.symmetric:
        plain = _polished(system, starts + heeled, orders, orders)
    else:
        plain = _polished(system, starts, orders, orders)
        heeled += _beside(system, [rearranged(u[None], orders, whole)[0] for u, _, _ in plain], whole, 1)
        heeled += [_turned(u, whole, 0) for u in heeled]  # the mirror image (y, t) -> (-y, t + T/2) is a motion too
        leaning = [found for found in _polished(system, heeled, whole, whole) if _has(found[0], whole, 0)]
    of_one = [rearranged(u[None], orders, whole)[0] for u, _, _ in plain] + [u for u, _, _ in leaning]
    doubled = _doubled(system, of_one, whole, harmonics)
    records = [_record(model, found, used, periods) for group, used, periods in (
        (plain, orders, 1), (leaning, whole, 1), (doubled, orders_of(harmonics, 2), 2)
    ) for found in group]  # fmt: skip
    return sorted(records, key=lambda m: float(m.amplitude[1]))


def _record(model: Model, found: tuple[Floats, int, float], orders: tuple[int, ...], periods: int) -> Motion:
    u, code, error = found
    rising, used = ascending(u[None], orders)
    motion = motion_record(model, rising[0], used, code, error, "harmonic balance")
    return motion if periods == 1 else replace(motion, frequency=model.frequency / periods, periods=periods)


def _polished(
    system: System, starts: Sequence[Floats], low: tuple[int, ...], orders: tuple[int, ...]
) -> list[tuple[Floats, int, float]]:
    """Different motions of the given harmonics that Newton's method reaches: coefficients, status, residual."""
    if not starts:
        return []
    u = rearranged(np.array(starts), low, orders)
    u, status, residual = harmonic_balance(copies(system, len(u)), orders, start=u)
    found: list[tuple[Floats, int, float]] = []
    for one, code, error in zip(u, status, residual, strict=True):
        if Status(code).ok and not any(_same(one, known) for known, _, _ in found):
            found.append((one, int(code), float(error)))
    return found


def _same(a: Floats, b: Floats) -> bool:
    size = np.maximum(np.abs(a).max(axis=1), np.abs(b).max(axis=1)) + 1e-12
    return bool((np.abs(a - b).max(axis=1) < _SAME * size + 1e-12).all())


def _has(u: Floats, orders: tuple[int, ...], parity: int) -> bool:
    """Does a motion have even (0) or odd (1) harmonics, beyond rounding?"""
    own = [c for h, where in columns(orders).items() if h % 2 == parity for c in range(where.start, where.stop)]
    return bool(np.abs(u[:, own]).max() > _ZERO * np.abs(u).max())


def _from_branch(model: Model) -> list[Floats]:
    """One-harmonic motions where the branch over the excitation passes its full value, and the linear start's."""
    low = orders_for(model.system, 1)
    direct, status, _ = harmonic_balance(model.system, low)
    found = [direct[0]] if Status(status[0]).ok else []

    def raised(share: float) -> System:
        return model.system.raised(np.array([2.0 * share]))

    try:
        curve, start = start_of_branch(raised, 1)
    except InputError:
        return found
    path, _ = follow_branch(curve, start, 1500, (-1.0, 1.0))
    for a, b in pairwise(path.points):
        if (a[-1] - 0.5) * (b[-1] - 0.5) <= 0 and a[-1] != b[-1]:
            part = (0.5 - a[-1]) / (b[-1] - a[-1])
            found.append(curve.coefficients(a + part * (b - a)))
    return found


def from_grid(system: System) -> tuple[tuple[int, ...], list[Floats]]:
    """One-harmonic motions reached by Newton's method from a grid of roll amplitudes and phases.

    Parameters
    ----------
    system : System    one condition

    Returns
    -------
    orders : tuple of int              harmonics of the motions
    motions : list of (3, b) float     different from each other

    Notes
    -----
    Source: none needed; amplitudes to twice the angle where the cubic restoring equals the linear, at most 2 rad.

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> len(from_grid(Model(np.eye(3), terms, 1.2, (0, 0.1, 0), (0, 0, 0)).system)[1])
    3
    """
    low = orders_for(system, 1)
    starts = _grid(largest_roll(system), _SIZES, _ANGLES, columns(low)[1].start, 3 if low[0] == 0 else 2)
    return low, [u for u, _, _ in _polished(system, list(starts), low, low)]


def largest_roll(system: System) -> float:
    """Roll amplitude up to which motions are sought: twice that where the cubic restoring equals the linear.

    Parameters
    ----------
    system : System    one condition

    Returns
    -------
    float              at most 2; 1.5 without a cubic restoring [rad]

    Notes
    -----
    Source: closed form, K_phi phi = K_phiphiphi phi^3; the bounds are ours.

    Examples
    --------
    >>> largest_roll(Model(np.eye(3), {"K_phi": -1.0, "K_phiphiphi": -4.0}, 0.8, (0, 1, 0), (0, 0, 0)).system)
    1.0
    """
    stiffness = np.abs(system.linear[0, 1, 1])
    cubic = (system.powers[:, 1] == 3) & (system.powers.sum(axis=1) == 3) & (system.modulus == 0)
    hard: float = np.abs(system.coefficients[0, 1, cubic]).sum()
    if system.knots.shape[1]:
        table = system.arm[0, 1] * system.cubics[0, :, 3]
        hard += np.abs(np.diff(table, prepend=0.0)).sum()
    return float(min(2.0, 2.0 * np.sqrt(stiffness / hard))) if hard > 0 else 1.5


def _grid(largest: float, sizes: int, angles: int, column: int, width: int) -> Floats:
    """Starts (n, 3, width) with roll alone: amplitudes times phases, in the two columns from `column`."""
    amplitude = largest * (np.arange(sizes) + 1) / sizes
    phase = 2 * np.pi * np.arange(angles) / angles
    start = np.zeros((sizes * angles, 3, width))
    start[:, 1, column] = np.outer(amplitude, np.cos(phase)).ravel()
    start[:, 1, column + 1] = np.outer(amplitude, np.sin(phase)).ravel()
    return start


def _heeled_starts(system: System) -> list[Floats]:
    """Starts with harmonics (0, 1, 2) that heel to either side."""
    heels, sizes, angles = _HEELED_STARTS
    largest, starts = largest_roll(system), []
    for heel in largest * np.arange(-heels, heels + 1) / (2 * heels):
        if heel != 0:
            some = _grid(largest, sizes, angles, 1, 5)
            some[:, 1, 0] = heel
            starts += list(some)
    return starts


def _doubled(
    system: System, motions: list[Floats], orders: tuple[int, ...], harmonics: int
) -> list[tuple[Floats, int, float]]:
    """Motions of two wave periods reached from those of one by a disturbance at half the frequency."""
    low, full, slow, starts = orders_of(_LOW, 2), orders_of(harmonics, 2), slowed(system, 2), []
    first = columns(low)[1].start
    for u in motions:
        start = np.repeat(rearranged(u[None], orders, low, factor=2), _FEW * 2 * _FEW, axis=0)
        start += _grid(float(np.abs(u[1]).max()), _FEW, 2 * _FEW, first, start.shape[2])
        starts += list(start)
    begun = [rearranged(u[None], low, full)[0] for u, _, _ in _polished(slow, starts, low, low) if _has(u, low, 1)]
    begun += _beside(slow, [rearranged(u[None], orders, full, factor=2)[0] for u in motions], full, 2)
    found: list[tuple[Floats, int, float]] = []
    for one in _polished(slow, begun, full, full):
        if _has(one[0], full, 1) and not any(_same(_turned(one[0], full, 1), u) for u, _, _ in found):
            found.append(one)
    return found


def _beside(system: System, motions: list[Floats], orders: tuple[int, ...], periods: int) -> list[Floats]:
    """Starts beside motions, in the shape in which each is closest to losing its symmetry or its period."""
    starts = []
    for u in motions:
        size = np.abs(u).max(axis=1)
        # A mode that hardly moves must not look easy to disturb.
        scale = np.repeat(np.where(size > 1e-3 * size.max(), size, size.max()), u.shape[1])
        shape = disturbance(system, u, orders, scale, periods) * scale
        reached = [_undamped(system, u + offset * shape.reshape(u.shape), orders) for offset in _OFFSETS]
        starts += [one for one in reached if one is not None]
    return starts


def _undamped(system: System, u: Floats, orders: tuple[int, ...]) -> Floats | None:
    """Where Newton's whole steps lead: beside a bifurcation its damped ones fall back on the motion that was left."""
    for _ in range(_ITERATIONS):
        residual, matrix = balance_of(system, orders, u)
        try:
            step = np.linalg.solve(matrix, -residual).reshape(u.shape)
        except np.linalg.LinAlgError:
            return None
        u = u + step
        size = np.abs(u).max()
        if not np.abs(step).max() < 10.0 * size:
            return None
        if np.abs(step).max() < 1e-9 * size:
            return u
    return None


def _turned(u: Floats, orders: tuple[int, ...], parity: int) -> Floats:
    """A motion with the sign of its even (0) or odd (1) harmonics changed: odd ones of half the frequency, a period later."""
    turned = u.copy()
    for h, where in columns(orders).items():
        if h % 2 == parity:
            turned[:, where] *= -1.0
    return turned

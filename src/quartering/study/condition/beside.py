"""Checks of a stable verdict: capsize during the approach, and other stable motions in the same wave."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Final, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from quartering._machine.threads import small_matrices
from quartering.motion.branches.homotopy import carried, distinct, same
from quartering.motion.branches.search import from_grid
from quartering.motion.branches.seeds import grid_of_roll
from quartering.motion.equations.batch import rows
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats, System
from quartering.motion.status import OnTheWay, Status
from quartering.motion.steady.harmonic import harmonic_balance, orders_for, quick_motions
from quartering.motion.steady.motion import Motion, roll_peaks, steady_motions
from quartering.motion.steady.subharmonic import rearranged
from quartering.motion.transient.approach import capsizes_before
from quartering.stability.assessment import Assessment, assess
from quartering.stability.kind import Kind, near_fold

Way = Literal["upright", "raised"]
"""How a ship comes to its motion: met upright by the whole wave, or by a wave raised in three steps."""

_STEEP: Final = 0.5
"""Share of the capsize limit past which a stable motion is asked for the way to it."""
_SAME_ROLL, _NEAR = 0.02, 0.15
OTHERS: Final = 2
"""Other stable motions that a cell of a map has room for: of more, those that roll most."""
_SIZES, _ANGLES = 8, 3
"""Starts of a cell: on conditions drawn at random they find 96 of 100 motions that the 144 of one condition find."""
_BEYOND, _ALIKE = 1.1, 0.02


def capsizes_on_the_way(model: Model) -> dict[Way, float]:
    """From which beginnings the ship capsizes before it comes to a steady motion, and after how long.

    Returns "upright", from rest in the whole wave, ten periods; "raised", from rest in a third of the wave, two thirds
        and the whole, ten periods each: the time of the capsize from the beginning [s]; empty when there is none

    A stable motion attracts only what is near it: a transient may pass the model's ``capsize_limit`` first.
    Source: [H71] eq. (3), integrated; [Thompson89] for the use.
    """
    times = capsizes_before(model.system, np.array([model.capsize_limit.radians]))[0]
    return {way: float(time) for way, time in zip(get_args(Way), times, strict=True) if np.isfinite(time)}


class _Known(NamedTuple):
    """The motion of a condition that others stand beside.

    Parameters
    ----------
    u : (3, b)       coefficients
    orders : tuple   their harmonics
    peak : float     largest roll over a cycle [rad]
    """

    u: Floats
    orders: tuple[int, ...]
    peak: float


class Asked(NamedTuple):
    """What maps are told of their stable motions beside the verdict.

    Parameters
    ----------
    way : (n,) int8                values of `OnTheWay`
    other_rolls : (n, o) float     largest roll over a cycle of other stable motions, the smallest first; NaN for none [rad]
    """

    way: NDArray[np.int8]
    other_rolls: Floats


def beside_motions(
    system: System, judged: Assessment, u: Floats, orders: tuple[int, ...], peaks: Floats, limit: Floats | float
) -> Asked:
    """Whether ships capsize before they come to their stable motions, and which others exist, asked where it may be.

    system: n conditions
    judged: of their motions
    u (n, 3, b): the motions, as from `steady_motions`
    orders: their harmonics
    peaks (n,): largest roll over a cycle [rad]
    limit (n,): roll angle that counts as a capsize [rad], or one for all

    Asked of stable motions that roll past half the limit, and of those near a fold (`near_fold`), beside which a larger motion
    stands or none.  Source: [Thompson89] for the use; [Krack19].

    See `judged` of `quartering.study.conditions`, which calls this.
    """
    way = np.full(system.count, int(OnTheWay.NOT_ASKED), dtype=np.int8)
    rolls = np.full((system.count, OTHERS), np.nan)
    steep = np.nan_to_num(peaks) > _STEEP * limit
    asked = np.flatnonzero((judged.kind == Kind.STABLE) & (steep | near_fold(judged.floquet)))
    if asked.size:
        some, limits = rows(system, asked), np.broadcast_to(limit, peaks.shape)[asked]
        times = capsizes_before(some, limits)
        way[asked] = np.isfinite(times) @ [int(OnTheWay.FROM_UPRIGHT), int(OnTheWay.WAVE_RAISED)]
        many = orders_for(some, max(3, *orders))
        of: list[int] = []
        others: list[Floats] = []
        for i, low, seeds in _seeds_beside(some, u[asked], orders, limits):
            known = _Known(u[asked[i]], orders, float(peaks[asked[i]]))
            found = _others(rows(some, np.array([i])), low, seeds, known, float(limits[i]), many)
            of += [i] * len(found)
            others += found
        for i, each in _stable_rolls(some, of, others, many).items():
            largest = each[-OTHERS:]
            rolls[asked[i], : len(largest)] = largest
    return Asked(way, rolls)


def _seeds_beside(
    system: System, u: Floats, orders: tuple[int, ...], limits: Floats
) -> Iterator[tuple[int, tuple[int, ...], list[Floats]]]:
    """One-harmonic motions of conditions that have others than the known one: which condition, harmonics, motions.

    From a grid of starts each, as far as 1.1 times its limit (n,), all conditions in one batch.
    """
    low, first = orders_for(system, 1), 1 if orders[0] == 0 else 0
    column, width = (1, 3) if low[0] == 0 else (0, 2)
    each = _SIZES * _ANGLES
    different, of = np.unique(limits, return_inverse=True)
    grids = np.array([grid_of_roll(_BEYOND * limit, _SIZES, _ANGLES, column, width) for limit in different])
    starts = grids[of].reshape(-1, 3, width)
    found, status = quick_motions(rows(system, np.repeat(np.arange(system.count), each)), low, starts)
    usable = (status == 0) & (roll_peaks(np.nan_to_num(found), low) <= _BEYOND * np.repeat(limits, each))
    known = u[:, 1, first : first + 2]
    away = found[:, 1, column : column + 2] - np.repeat(known, each, axis=0)
    others = usable & (np.hypot(*away.T) > _ALIKE * np.repeat(np.hypot(*known.T), each))
    for i in np.flatnonzero(others.reshape(-1, each).any(axis=1)):
        own = slice(i * each, (i + 1) * each)
        yield int(i), low, distinct(found[own][usable[own]])


def other_stable_motions(model: Model, motion: Motion, harmonics: int = 3) -> list[float]:
    """Largest roll over a cycle of the other stable motions of the wave's period in one condition.

    motion: the one that is known
    harmonics: of the motions sought, odd; at least 3
    Returns the smallest first, below the model's ``capsize_limit`` [rad]

    From the grid of one-harmonic starts and its motions carried over to more harmonics, as in `all_motions`, which looks
    further: for leaning motions and such of two periods too.  Source: [Krack19].
    """
    system = model.system
    with small_matrices():
        low, seeds = from_grid(system)
        known = _Known(motion.coefficients, motion.orders_with_mean, float(motion.peak[1]))
        as_a_map = _seeds_beside(system, known.u[None], known.orders, np.array([model.capsize_limit.radians]))
        for _, _, found in as_a_map:  # closer starts, up to the limit: a cell and its verdict look in the same places
            seeds += [one for one in found if not any(same(one, known) for known in seeds)]
        many = orders_for(system, max(3, harmonics))
        found = _others(system, low, seeds, known, model.capsize_limit.radians, many)
        return _stable_rolls(system, [0] * len(found), found, many).get(0, [])


def _others(
    system: System, low: tuple[int, ...], seeds: list[Floats], known: _Known, limit: float, many: tuple[int, ...]
) -> list[Floats]:
    """Motions of many harmonics of one condition that one-harmonic ones lead to and are not known.

    The motion that is known may be one of few harmonics, which rolls otherwise than the same one with more of them: both are
    left out.
    """
    already = [known.peak, _with_more(system, known, many)]
    ends = [one for one in carried(system, seeds, low, many) if one is not None]
    peaks = [float(roll_peaks(u[None], many)[0]) for u in ends]
    return [u for u, peak in zip(ends, peaks, strict=True) if peak <= limit and not _alike(peak, already)]


def _stable_rolls(
    system: System, of: list[int], motions: list[Floats], many: tuple[int, ...]
) -> dict[int, list[float]]:
    """Largest roll of those motions that are stable, by the condition they are of, each once, the smallest first."""
    rolls: dict[int, list[float]] = {}
    if not motions:
        return rolls
    u = np.array(motions)
    kind = assess(rows(system, np.array(of)), u, many, 1e-9, detail="map").kind
    for i, peak, stands in zip(of, roll_peaks(u, many), kind == Kind.STABLE, strict=True):
        known = rolls.setdefault(i, [])
        if stands and not _alike(peak, known):
            known.append(float(peak))
    return {i: sorted(each) for i, each in rolls.items()}


def _alike(peak: float, others: list[float]) -> bool:
    """Is a largest roll within 2 % of it among others?"""
    return any(abs(peak - one) <= _SAME_ROLL * peak for one in others)


def _with_more(system: System, known: _Known, many: tuple[int, ...]) -> float:
    """Largest roll of the known motion with more harmonics, or else of the one from rest with them [rad]."""
    start = rearranged(known.u[None], known.orders, many)
    u, status, _ = harmonic_balance(system, many, start)
    peak = float(roll_peaks(u, many)[0])
    if Status(status[0]).ok and abs(peak - known.peak) <= _NEAR * known.peak:
        return peak
    return float(roll_peaks(steady_motions(system, max(many), start="rest")[0], many)[0])


def also_words(rolls: Iterable[float]) -> str:
    """Other stable motions in one wave by their largest roll over a cycle [deg]; nothing where there are none.

    >>> also_words([27.71, 41.0]), also_words([math.nan])
    ('also 27.7, 41 deg', '')
    """
    sizes = [f"{roll:.3g}" for roll in rolls if math.isfinite(roll)]
    return f"also {', '.join(sizes)} deg" if sizes else ""

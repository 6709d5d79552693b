"""Checks of a stable verdict: capsize during the approach, and other stable motions in the same wave."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Final, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from quartering._machine.threads import small_matrices
from quartering.motion.branches.homotopy import carried, same
from quartering.motion.branches.search import from_grid
from quartering.motion.branches.seeds import grid_of_roll
from quartering.motion.equations.batch import rows
from quartering.motion.equations.system import Floats, Model, System
from quartering.motion.status import OnTheWay
from quartering.motion.steady.harmonic import orders_for, quick_motions
from quartering.motion.steady.motion import Motion, roll_peaks, steady_motions
from quartering.motion.transient.approach import capsizes_before
from quartering.stability.assessment import Assessment, assess
from quartering.stability.kind import Kind, near_fold

Way = Literal["upright", "raised"]
"""How a ship comes to its motion: met upright by the whole wave, or by a wave raised in three steps."""

_STEEP: Final = 0.5
"""Share of the capsize limit past which a stable motion is asked for the way to it."""
_SAME_ROLL = 0.02
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
    system: System, judged: Assessment, u: Floats, orders: tuple[int, ...], peaks: Floats, limit: float
) -> Asked:
    """Whether ships capsize before they come to their stable motions, and which others exist, asked where it may be.

    system: n conditions
    judged: of their motions
    u (n, 3, b): the motions, as from `steady_motions`
    orders: their harmonics
    peaks (n,): largest roll over a cycle [rad]
    limit: roll angle that counts as a capsize [rad]

    Asked of stable motions that roll past half the limit, and of those near a fold (`near_fold`), beside which a larger motion
    stands or none.  Source: [Thompson89] for the use; [Krack19].

    See `judged` of `quartering.study.conditions`, which calls this.
    """
    way = np.full(system.count, int(OnTheWay.NOT_ASKED), dtype=np.int8)
    rolls = np.full((system.count, OTHERS), np.nan)
    steep = np.nan_to_num(peaks) > _STEEP * limit
    asked = np.flatnonzero((judged.kind == Kind.STABLE) & (steep | near_fold(judged.floquet)))
    if asked.size:
        some = rows(system, asked)
        times = capsizes_before(some, np.full(asked.size, limit))
        way[asked] = np.isfinite(times) @ [int(OnTheWay.FROM_UPRIGHT), int(OnTheWay.WAVE_RAISED)]
        for i, low, seeds in _seeds_beside(some, u[asked], orders, limit):
            one = rows(some, np.array([i]))
            found = _stable_rolls(one, low, seeds, [float(peaks[asked[i]])], limit, max(3, *orders))[-OTHERS:]
            rolls[asked[i], : len(found)] = found
    return Asked(way, rolls)


def _seeds_beside(
    system: System, u: Floats, orders: tuple[int, ...], limit: float
) -> Iterator[tuple[int, tuple[int, ...], list[Floats]]]:
    """One-harmonic motions of conditions that have others than the known one: which condition, harmonics, motions.

    From a grid of starts each, as far as 1.1 times the limit, all conditions in one batch.
    """
    low, first = orders_for(system, 1), 1 if orders[0] == 0 else 0
    column, width = (1, 3) if low[0] == 0 else (0, 2)
    each = _SIZES * _ANGLES
    starts = np.tile(grid_of_roll(_BEYOND * limit, _SIZES, _ANGLES, column, width), (system.count, 1, 1))
    found, status = quick_motions(rows(system, np.repeat(np.arange(system.count), each)), low, starts)
    usable = (status == 0) & (roll_peaks(np.nan_to_num(found), low) <= _BEYOND * limit)
    for i in range(system.count):
        known = u[i, 1, first : first + 2]
        seeds: list[Floats] = []
        for j in np.flatnonzero(usable[i * each : (i + 1) * each]) + i * each:
            if not any(same(found[j], one) for one in seeds):
                seeds.append(found[j])
        if any(np.hypot(*(one[1, column : column + 2] - known)) > _ALIKE * np.hypot(*known) for one in seeds):
            yield i, low, seeds


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
        as_a_map = _seeds_beside(
            system, motion.coefficients[None], motion.orders_with_mean, model.capsize_limit.radians
        )
        for _, _, found in as_a_map:  # closer starts, up to the limit: a cell and its verdict look in the same places
            seeds += [one for one in found if not any(same(one, known) for known in seeds)]
        return _stable_rolls(
            system, low, seeds, [float(motion.peak[1])], model.capsize_limit.radians, max(3, harmonics)
        )


def _stable_rolls(
    system: System, low: tuple[int, ...], seeds: list[Floats], known: list[float], limit: float, harmonics: int
) -> list[float]:
    """Largest roll of the stable motions of one condition that one-harmonic ones lead to and are not known, the smallest first.

    The motion that is known may be one of one harmonic, which rolls otherwise than the same one with more of them: both are
    left out.
    """
    own, many, _, _ = steady_motions(system, harmonics, start="rest")
    known = [*known, float(roll_peaks(own, many)[0])]
    ends = [one for one in carried(system, seeds, low, many) if one is not None]
    rolls: list[float] = []
    for u in ends:
        peak = float(roll_peaks(u[None], many)[0])
        if peak > limit or any(abs(peak - one) <= _SAME_ROLL * peak for one in [*rolls, *known]):
            continue
        if assess(system, u[None], many, 1e-9).kind[0] == Kind.STABLE:
            rolls.append(peak)
    return sorted(rolls)


def also_words(rolls: Iterable[float]) -> str:
    """Other stable motions in one wave by their largest roll over a cycle [deg]; nothing where there are none.

    >>> also_words([27.71, 41.0]), also_words([math.nan])
    ('also 27.7, 41 deg', '')
    """
    sizes = [f"{roll:.3g}" for roll in rolls if math.isfinite(roll)]
    return f"also {', '.join(sizes)} deg" if sizes else ""

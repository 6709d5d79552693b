"""Harmonics of the variational matrix along many motions, and their transition matrices, in one pass.

What a map asks of a motion's stability rests on the matrix along it: a hundred samples of twelve numbers, ten thousand bytes a
condition. Some conditions at a time go all the way from the motion to the transition matrix while those stand near the
processor. How many they are does not show in any condition's numbers.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.simd import load, store
from quartering._machine.threads import in_threads
from quartering.motion.equations.batch import rows
from quartering.motion.equations.rates import WIDTH, gather, room_for, row_of_lanes
from quartering.motion.equations.system import Floats, System, kernel_arguments
from quartering.motion.steady.newton import gather_motions, project
from quartering.stability.variational.floquet import finest, least_steps, rate_of_one
from quartering.stability.variational.magnus import (
    AROUND,
    BEFORE,
    STEPS,
    TIERS,
    by_accuracy,
    magnus_transition,
    march,
    room_for_steps,
    steps_of_one,
    tables,
)
from quartering.stability.variational.variation import EVEN_HARMONICS, matrices_along, sampled, variation_along

_NEAR: Final = 40_000
"""Numbers of matrices that stand near the processor at a time: 320 kB."""


class Passed(NamedTuple):
    """What one pass finds.

    Parameters
    ----------
    phasors : (n, m, 3, 4) complex    harmonics of the variational matrix, as from `variational_harmonics`
    rate : (n,)                       fastest rate, as from `fastest_rate` without eigenvalues [1/s]
    transition : (n, 4, 4)            over a cycle, or half of one where all harmonics are odd; NaN where none was found
    """

    phasors: NDArray[np.complex128]
    rate: Floats
    transition: Floats


def goes_in_one_pass(system: System, accuracy: float) -> bool:
    """Are the equations such that Magnus' series reaches the accuracy, without an autopilot?"""
    return system.plain and not system.has_kinked_slopes and accuracy >= finest(system)


def in_one_pass(system: System, u: Floats, orders: tuple[int, ...], accuracy: float) -> Passed:
    """Harmonics of the variational matrix along periodic motions, and transition matrices.

    system: n conditions for which `goes_in_one_pass`
    u (n, 3, b): motions, as from `harmonic_balance`; NaN where there is none
    orders: their harmonics
    accuracy: of the multipliers

    Source: [H71] eq. (8); [Blanes09].
    """
    table, functions = sampled(system, orders, EVEN_HARMONICS)
    kinks, span = system.has_drag or system.has_table, 0.5 if all(h % 2 == 1 for h in orders) else 1.0
    found = Passed(
        np.empty((system.count, len(EVEN_HARMONICS), 3, 4), dtype=complex),
        np.empty(system.count),
        np.full((system.count, 4, 4), np.nan),
    )
    steps, scale = np.empty(system.count, dtype=np.int64), np.empty(system.count)
    in_threads(
        _pass,
        system.count,
        *kernel_arguments(system, table),
        np.require(u, requirements=("C", "W")),
        functions,
        (span, by_accuracy(accuracy), least_steps(system)),
        tables(table.values.shape[1], TIERS[0], kinks),
        np.array([*STEPS, 0], dtype=np.int64),
        *found,
        steps,
        scale,
    )
    left = np.flatnonzero(steps > STEPS[TIERS[0] - 1])  # one in hundreds: for so many steps the tables are large
    if left.size:
        few = rows(system, left)
        along = variation_along(few, u[left], orders)[1]
        cycle = 2 * np.pi * span / few.frequency
        found.transition[left] = magnus_transition(along, cycle, steps[left], scale[left], kinks=kinks)
    return found


@kernel
def _pass(
    first, last, program, parts, samples, u, functions, wanted, of_steps, kinds, phasors, rate, transition, steps, scale
):
    """Harmonics, fastest rates, steps and units of sway velocity, and transition matrices of conditions first..last."""
    span, accuracy, least = wanted
    weights, starts, widths = of_steps
    nb, count = samples[0].shape
    lanes = row_of_lanes(parts, WIDTH)
    columns, _, _, strips = room_for(program, lanes)
    motion, sums = np.empty((3, nb, WIDTH)), np.empty((3, 4, functions.shape[0], WIDTH))
    together = WIDTH * max(1, _NEAR // (12 * WIDTH * count))
    block = np.empty((together // WIDTH, count, 3, 4, WIDTH))
    place, chosen = np.empty(together, np.int64), np.empty(WIDTH, np.int64)
    power, other = np.empty((4, 4)), np.empty((4, 4))
    values, room, unit = np.zeros((count + AROUND + 2, 12, WIDTH)), room_for_steps(), np.empty((12, WIDTH))
    phi, h = np.empty((4, 4, WIDTH)), np.empty(WIDTH)
    for begin in range(first, last, together):
        these = min(together, last - begin)
        for r in range((these + WIDTH - 1) // WIDTH):
            at = begin + r * WIDTH
            gather(at, last, parts, lanes)
            gather_motions(at, last, u, motion)
            matrices_along(program, samples, motion, lanes, columns, strips, block[r])
            project(block[r], functions, sums)
            for l in range(min(WIDTH, last - at)):
                i = at + l
                _put_phasors(sums, l, phasors[i])
                rate[i] = rate_of_one(phasors[i], np.nan, power, other)
                own, scale[i] = steps_of_one(phasors[i], lanes.frequency[l], rate[i], span, accuracy, kinds)
                while kinds[own] > 0 and kinds[own] < least:
                    own += 1
                place[r * WIDTH + l], steps[i] = own, kinds[own]
        # Conditions of equal numbers of steps go side by side; the last one of a number fills up what is empty.
        for kind in range(starts.size):
            taken = 0
            for c in range(these + 1):
                if c < these and place[c] == kind:
                    chosen[taken] = c
                    taken += 1
                if taken < WIDTH and (c < these or taken == 0):
                    continue
                for l in range(taken, WIDTH):
                    chosen[l] = chosen[taken - 1]
                for l in range(WIDTH):
                    i = begin + chosen[l]
                    h[l] = 2.0 * np.pi * span / (parts.frequency[i] * kinds[kind])
                    for e in range(12):  # sway velocity in units of g, so that all entries are of one size
                        unit[e, l] = (scale[i] if e % 4 == 0 else 1.0) / (scale[i] if e < 4 else 1.0)
                _lay_side_by_side(block, chosen, unit, values)
                march(values, count, weights, starts[kind], widths[kind], kinds[kind], h, phi, room)
                for l in range(taken):
                    i = begin + chosen[l]
                    for a in range(4):
                        for b in range(4):
                            own_unit = (scale[i] if a == 0 else 1.0) / (scale[i] if b == 0 else 1.0)
                            transition[i, a, b] = phi[a, b, l] * own_unit
                taken = 0


@batch_kernel
def _put_phasors(sums, l, phasors):
    """Harmonics (m, 3, 4) of lane ``l`` from projections (3, 4, p, W) on 1, cos, sin, cos 2, .."""
    for k in range(3):
        for s in range(4):
            phasors[0, k, s] = sums[k, s, 0, l]
            for m in range(1, phasors.shape[0]):
                phasors[m, k, s] = complex(sums[k, s, 2 * m - 1, l], -sums[k, s, 2 * m, l])


@batch_kernel
def _lay_side_by_side(block, chosen, unit, values):
    """Matrices of the chosen conditions of a block (r, n, 3, 4, W) times ``unit`` (12, W), as `march` takes them."""
    count = block.shape[1]
    straight = chosen[0] % WIDTH == 0
    for l in range(WIDTH):
        straight = straight and chosen[l] == chosen[0] + l
    if straight:
        for n in range(count):
            for e in range(12):
                store(values, (n + BEFORE, e), load(block, (chosen[0] // WIDTH, n, e // 4, e % 4)) * load(unit, e))
    else:
        for n in range(count):
            for l in range(WIDTH):
                own, lane = block[chosen[l] // WIDTH, n], chosen[l] % WIDTH
                for e in range(12):
                    values[n + BEFORE, e, l] = own[e // 4, e % 4, lane] * unit[e, l]
    for e in range(12):
        for n in range(BEFORE):
            store(values, (n, e), load(values, (count + n, e)))
        for n in range(AROUND - BEFORE):
            store(values, (count + BEFORE + n, e), load(values, (BEFORE + n, e)))

"""Transient approach to a steady motion: capsizes on the way, for many conditions in a batch.

All histories stand at the same phase of their waves: with theta = omega t the equations are d(state)/d(theta) = f/omega, and
the wave's cosine and sine are numbers alike in all lanes. A row takes as many steps a cycle as its conditions need.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.simd import every, load, size, store, where_less
from quartering._machine.threads import in_threads
from quartering.motion.equations.basis import waves_at
from quartering.motion.equations.rates import WIDTH, enter_inputs, forces, gather, room_for, row_of_lanes
from quartering.motion.equations.system import Floats, System

RAISED_IN: Final = 3
"""Steps in which a wave is raised."""

PERIODS: Final = 10
"""Of the wave, at each of its heights."""

STEPS: Final = 32
"""Runge-Kutta steps a cycle, in proportion more where the ship itself is faster than the wave, by halves of it."""

SETTLED: Final = 1e-4
"""Change of every state over a cycle, as a share of its largest size in it, at which a history has come to its motion."""


@batch_kernel
def _step(program, lanes, h, waves, begin, y, room, total):
    """Sum of the four rates of a Runge-Kutta step over the phase ``h`` (W,) from the states ``y`` (s, W), into ``total``.

    ``waves`` (i, m): the wave's harmonics every half step; the step begins at column ``begin``.
    """
    columns, rate, _, sums = room
    step = load(h, ())
    for s in range(y.shape[0]):
        store(columns, s, load(y, s))
        store(total, s, every(0.0))
    for j in range(4):
        at = (begin + (j + 1) // 2) % waves.shape[1]
        c, d = waves[1, at], waves[2, at]
        enter_inputs(program, lanes, waves[:, at], columns)
        forces(program, lanes, c, d, columns, sums, rate)
        for k in range(3):
            known = load(lanes.mean, k) + load(lanes.cos, k) * c + load(lanes.sin, k) * d
            store(rate, k, load(rate, k) + known)
        weight, ahead = (1.0 if j == 0 or j == 3 else 2.0), (0.5 if j < 2 else 1.0)
        # a state that follows another first, while that one is still the stage's
        for s in range(y.shape[0]):
            if program.follows[s] >= 0:
                own = load(columns, program.follows[s])
                store(total, s, load(total, s) + weight * own)
                store(columns, s, load(y, s) + ahead * step * own)
        for s in range(y.shape[0]):
            if program.rows[s] >= 0:
                own = load(rate, program.rows[s])
                store(total, s, load(total, s) + weight * own)
                store(columns, s, load(y, s) + ahead * step * own)


# A history is over when it capsizes, and when it has come to a periodic motion: when its state at the end of a cycle is that at
# the beginning to SETTLED. What is left to go is then less than SETTLED/(1 - m), m the modulus of the slowest multiplier; with
# m up to 0.99 that is 1 % of the motion.


@kernel
def _march(first, last, program, parts, waves, cycles, limit, states, times):
    """Histories of rows first..last of conditions over some cycles of the wave.

    ``states`` (rows, s, W) go on until |roll| passes ``limit`` (rows, W), or until they repeat, and stay there; ``times``
    (rows, W) is when the limit was passed, in cycles, NaN before.
    """
    width, count = limit.shape[1], states.shape[1]
    lanes, h = row_of_lanes(parts, width), np.empty(width)
    room, total = room_for(program, lanes), np.empty((count, width))
    begun, most, still = np.empty((count, width)), np.empty((count, width)), np.empty(width)
    roll, steps = program.displacements[1], waves.shape[1] // 2
    for row in range(first, last):
        gather(row * width, parts.frequency.size, parts, lanes)
        y, going = states[row], 0
        for l in range(width):
            h[l] = 2 * np.pi / steps / lanes.frequency[l]
            still[l] = 1.0 if np.isnan(times[row, l]) else 0.0
            going += still[l] == 1.0
        for n in range(cycles * steps):
            if going == 0:
                break
            if n % steps == 0:
                for s in range(count):
                    store(begun, s, load(y, s))
                    store(most, s, every(1e-12))
            _step(program, lanes, h, waves, 2 * n, y, room, total)
            for s in range(count):
                before, largest = load(y, s), load(most, s)
                own = where_less(0.5, load(still, ()), before + load(h, ()) / 6.0 * load(total, s), before)
                store(y, s, own)
                store(most, s, where_less(largest, size(own), size(own), largest))
            for l in range(width):
                if still[l] == 1.0 and not abs(y[roll, l]) <= limit[row, l]:
                    times[row, l] = (n + 1) / steps
                    still[l] = 0.0
                    going -= 1
            if (n + 1) % steps == 0:
                for l in range(width):
                    change = 0.0
                    for s in range(count):
                        change = max(change, abs(y[s, l] - begun[s, l]) / most[s, l])
                    if still[l] == 1.0 and change < SETTLED:
                        still[l] = 0.0
                        going -= 1


def capsizes_before(system: System, limit: Floats) -> Floats:
    """When ships capsize that meet their wave upright, and such whose wave is raised in three steps.

    system: n conditions, all numbers finite
    limit (n,): roll angle that counts as a capsize [rad]
    Returns (n, 2): time from the beginning: at rest in the whole wave, ten periods; at rest in a third of it, then two
        thirds and the whole, ten periods each; NaN where the ship does not capsize [s]

    The first thirty periods of a wave, not all time: what capsizes later is not told.
    Source: [H71] eq. (3), the classical fourth-order method; [Thompson89] for the use.
    """
    times = np.full((system.count, 2), np.nan)
    steps = _steps(system)
    for each in np.unique(steps):
        chosen = np.flatnonzero(steps == each)
        some = system.each(lambda array, chosen=chosen: array[chosen])  # type: ignore[misc]
        times[chosen] = _capsizes(some, np.asarray(limit, dtype=float)[chosen], int(each))
    return times * (2 * np.pi / system.frequency)[:, None]


def _capsizes(system: System, limit: Floats, steps: int) -> Floats:
    """`capsizes_before` in cycles, with a number of steps each."""
    rows = -(-system.count // WIDTH)
    lanes = np.minimum(np.arange(rows * WIDTH), system.count - 1).reshape(rows, WIDTH)
    waves = waves_at(np.pi * np.arange(2 * steps) / steps, system.inputs.shape[2])
    angle = np.ascontiguousarray(limit[lanes])

    def further(share: float, states: Floats, times: Floats) -> None:
        at = system.raised(np.array([share]))
        in_threads(_march, rows, at.program, at.parts, waves, PERIODS, angle, states, times, smallest=1)

    found = np.full((2, rows, WIDTH), np.nan)
    further(1.0, np.zeros((rows, system.states, WIDTH)), found[0])
    states = np.zeros((rows, system.states, WIDTH))
    for i in range(RAISED_IN):
        before = np.isfinite(found[1])
        further((i + 1) / RAISED_IN, states, found[1])
        found[1] += np.where(before, 0.0, i * PERIODS)
    return np.asarray(found.reshape(2, -1)[:, : system.count].T)


def _steps(system: System) -> NDArray[np.int64]:
    """Steps a cycle (n,): the fastest of roll, damping and steering takes at least `STEPS` over 2 pi of its own phase."""
    linear = np.abs(system.linear)
    rates = [np.sqrt(linear[:, 1, 1]), linear[:, 0, 0], linear[:, 1, 2], linear[:, 2, 3]]
    if system.states > 4:
        rates.append(np.sqrt(linear[:, 2, 4]))
    if system.states > 5:
        rates.append(linear[:, 3, 5])
    turns = np.maximum(np.max(rates, axis=0) / system.frequency, 1.0)
    return np.asarray(STEPS // 2 * np.ceil(2 * turns).astype(np.int64))

"""The plan of a simulation in a sea: wave cells, strips, memory, step and run-up, and what is said of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.digest import fingerprint
from quartering.conventions import InputError
from quartering.loads.sea.cells import Cells, wave_cells
from quartering.motion.sea.closure import Solution, closure_solutions
from quartering.motion.sea.equations import SeaEquations, angle_of_largest_arm, free_roll_of, roll_mode_of
from quartering.motion.sea.frozen import frozen_equations, with_few_strips
from quartering.motion.sea.memory import Memory, eigenvalues, memory_of
from quartering.motion.sea.synthesis import record_of
from quartering.motion.transient.rk4 import alike
from quartering.study.seas.moments import moments_of, products
from quartering.study.seas.response import (
    LEAST_DAMPING,
    sea_equations,
    shares_of,
)
from quartering.study.seas.simulated.asked import Asked
from quartering.study.seas.simulated.blocks import BLOCK, Plan

Floats = NDArray[np.float64]

_RADIANS_A_STEP: Final = 0.3
_RUN_UP, _LONGEST_RUN_UP, _TIMES = 200.0, 900.0, 6.0
_STRIPS: Final = (6, 9, 13)
STRIPS_ERROR: Final = 0.003
"""Change of the closure's roll that fewer strips may make [1]."""
_FASTEST: Final = 2.0
_STABLE: Final = 2.5
"""Step times the fastest eigenvalue of the motion with its memory: Runge-Kutta of order 4 runs away beyond 2.78 [1]."""


@dataclass(frozen=True, eq=False)
class Ready:
    """The plan of a simulation, and what is to be said of it."""

    plan: Plan
    cells: Cells
    strips: int
    memory: Memory | None
    errors: tuple[float, float]
    run_up: float
    run_up_wanted: float
    largest_arm: float
    shares: tuple[float, float, float]
    roll_frequency: float
    damping: float
    channels: NDArray[np.complex128]
    equations: SeaEquations
    solution: Solution
    off_course: float
    """Growth of small deviations from the course in slow motion [1/s]; NaN without a memory, which alone tells."""


def planned(asked: Asked) -> Ready:
    """Cells, equations, records and step of a simulation."""
    frequency, damping = free_roll_of(asked.ship, asked.speed)
    cells = wave_cells([asked.sea], asked.speed, frequency, max(damping, LEAST_DAMPING))
    everything = sea_equations(asked.ship, cells, asked.force, asked.form)
    energy = cells.energy(asked.sea)
    memory = memory_of(everything, energy) if asked.memory else None
    shared = _in_time(everything, memory)
    equations, solution = _with_strips_for(shared, energy, asked.strips)
    exact = solution if equations is everything else closure_solutions(everything, energy)[0]
    errors = _changes((equations, solution), (everything, exact), asked)
    frozen = frozen_equations(equations, solution.statistics.variance, memory)
    _, _, slow = roll_mode_of(*everything.at_roll)
    wanted = max(_RUN_UP, _TIMES / max(min(slow, max(damping, 0.0) * frequency), 1e-9))
    values = None if memory is None else eigenvalues(memory, everything.at_roll[1])
    step = _step_for(frequency, memory, values) if asked.step is None else asked.step
    if step > BLOCK / 100:
        raise InputError(f"step = {step:g} s; it is at most {BLOCK / 100:g} s; try {_RADIANS_A_STEP / frequency:.2g} s")
    step = BLOCK / math.ceil(BLOCK / step * (1.0 - 1e-12))
    first = math.ceil(min(wanted, _LONGEST_RUN_UP) / step)
    duration = first * step + BLOCK
    record = record_of(cells, asked.sea, frozen.channels, duration + step, 0.5 * step)
    plan = Plan(
        equations=alike(frozen.system),
        record=record,
        step=step,
        first=first,
        speed=asked.speed,
        place=asked.place,
        limits=asked.limits,
        seed=asked.seed,
        condition=_condition(asked, step, first, equations.terms.drag.size),
    )
    shares = shares_of(cells, asked.sea, frequency)
    arm = math.degrees(angle_of_largest_arm(everything))
    return Ready(
        plan, cells, equations.terms.drag.size, memory, errors, first * step, wanted, arm, shares, frequency, damping,
        frozen.channels,
        equations,
        solution,
        math.nan if values is None else float(values.real.max()),
    )  # fmt: skip


def _in_time(equations: SeaEquations, memory: Memory | None) -> SeaEquations:
    """Equations over cells with the coefficients that a simulation has."""
    if memory is not None:
        return memory.in_cells(equations)
    if len(equations.linear) == 1:
        return equations
    inertia, linear = equations.at_roll
    return replace(equations, inertia=inertia[None], linear=linear[None])


def _step_for(roll_frequency: float, memory: Memory | None, values: NDArray[np.complex128] | None) -> float:
    """Step of time [s]: 0.3 rad of free roll, and short enough for the fastest state of the memory and what it makes faster."""
    step = _RADIANS_A_STEP / roll_frequency
    if memory is None or values is None:
        return step
    return min(step, _FASTEST / float(np.abs(memory.fit.poles).max()), _STABLE / float(np.abs(values).max()))


def memory_words(memory: Memory | None) -> str:
    """What memory a simulation has."""
    if memory is None:
        return "no memory, coefficients of free roll"
    passive = "passive" if memory.passive else "not passive"
    return f"memory of {memory.fit.drive.size} poles, {passive}, misfit {memory.misfit:.2g}"


def _with_strips_for(equations: SeaEquations, energy: Floats, strips: int | None) -> tuple[SeaEquations, Solution]:
    """Equations with few strips, and their closure."""
    whole = closure_solutions(equations, energy)[0]
    if equations.terms.drag.size == 0 or equations.terms.matched is not None:
        return equations, whole
    for points in _STRIPS if strips is None else (strips,):
        fewer = with_few_strips(equations, points)
        if fewer is equations:
            break
        found = closure_solutions(fewer, energy)[0]
        near = whole.converged and found.converged and abs(found.roll - whole.roll) <= STRIPS_ERROR * whole.roll
        if strips is not None or near:
            return fewer, found
    return equations, whole


def _changes(
    own: tuple[SeaEquations, Solution], exact: tuple[SeaEquations, Solution], asked: Asked
) -> tuple[float, float]:
    """Roll and lateral acceleration of one closure over those of another, less 1; NaN where one did not converge."""
    found = []
    for equations, solution in (own, exact):
        if not solution.converged:
            return math.nan, math.nan
        at = equations.frequency[solution.cells]
        moments = moments_of(solution.energy @ products(solution.motion, at, asked.speed, asked.place))
        found.append(np.sqrt([moments.roll[0], moments.acceleration[0]]))
    if not found[1].all():
        return math.nan, math.nan
    roll, felt = found[0] / found[1] - 1.0
    return float(roll), float(felt)


def _condition(asked: Asked, step: float, first: int, strips: int) -> int:
    """Number of the condition, which with the seed and a block's number decides what is drawn."""
    parts = [asked.ship, asked.sea, asked.speed, asked.form, asked.memory, step, first, strips]
    return int(fingerprint(parts)[:16], 16)


def known_of(asked: Asked, ready: Ready) -> dict[str, Any]:
    """What is to be said of a simulation beside its numbers."""
    felt, (x, z) = asked.limits[1], asked.place
    record = ready.plan.record
    return {
        "ship": asked.ship,
        "sea": asked.sea,
        "speed": asked.speed,
        "shares": ready.shares,
        "roll_frequency": ready.roll_frequency,
        "attributes": {
            "seed": asked.seed,
            "roll_limit": math.degrees(asked.limits[0]),
            "roll_limit_reason": asked.reason,
            "acceleration_limit": felt if math.isfinite(felt) else "none: no highest position is known",
            "place": f"{x:.4g} m forward of G, {z:.4g} m below it",
            "block": BLOCK,
            "run_up": ready.run_up,
            "run_up_of_slow_modes": ready.run_up_wanted,
            "step": ready.plan.step,
            "strips": ready.strips,
            "memory": memory_words(ready.memory),
            "largest_arm": ready.largest_arm,
            "closure_change": f"roll {ready.errors[0]:+.2%}, lateral acceleration {ready.errors[1]:+.2%}",
            "frequencies": len(record.roots),
            "highest_frequency": len(record.roots) * 2.0 * math.pi / (record.samples * record.interval),
            "force_left_out": record.left_out,
            "roll_damping_ratio": ready.damping,
            "diffraction": asked.form,
        },
    }

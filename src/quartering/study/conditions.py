"""Response and stability of a ship at many conditions: the one path every map and sweep goes through."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.threads import spread
from quartering.conventions import RangeWarning
from quartering.hull.righting.arm import fitted_to, warn_of_polynomial
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.loads.forces import Form
from quartering.loads.validity import warn_of_conditions, warn_outside_database
from quartering.motion.of_ship import ShipSystem
from quartering.motion.status import OnTheWay, Status
from quartering.motion.steady.missed import missed_roll
from quartering.motion.steady.motion import roll_peaks, steady_motions, within_limits
from quartering.stability.assessment import assess
from quartering.stability.kind import Kind
from quartering.stability.precompile import announce_compilation
from quartering.study.condition.beside import OTHERS, beside_motions
from quartering.study.grid import Grid
from quartering.study.loading_systems import in_batches, part_of, systems

Floats = NDArray[np.float64]
BLOCK = 1024
"""Conditions of a map worked on at once by one core: bounds the memory, and how often progress is told."""
_OF_A_BLOCK: Final = 8192
"""The same where a block of a larger grid is, of which each core has several, loadings beside each other: what is done once
for them all, some 5 ms, weighs less."""

ACCURACY = 5e-6
"""Error of the Floquet multipliers in a map."""

RESULTS: dict[str, tuple[int, ...]] = {
    "sway": (), "roll": (), "yaw": (), "roll_peak": (), "missed": (), "n2": (), "k2": (), "k2_rho": (), "k2_paper": (),
    "index": (), "q": (3,), "q_paper": (3,), "slow": (2,), "first_order": (), "exponent": (), "calm_exponent": (),
    "multiplier_modulus": (4,), "verdict": (), "status": (), "capsizes_on_the_way": (),
    "other_roll_peak": (OTHERS,),
}  # fmt: skip
"""Name of every result and the shape it adds to the shape of the conditions; of more modes, with an autopilot, the largest."""

FLAGS: Final[dict[str, type[Kind] | type[Status] | type[OnTheWay]]] = {
    "verdict": Kind,
    "status": Status,
    "capsizes_on_the_way": OnTheWay,
}
"""Results that are small integers, and what these mean."""
UNKNOWN: Final[dict[str, Kind | Status | OnTheWay]] = {
    "verdict": Kind.NO_ANSWER,
    "status": Status.NOT_FINITE,
    "capsizes_on_the_way": OnTheWay.NOT_ASKED,
}
"""What stands there where nothing is known."""


def evaluate(
    ship: Ship,
    speed: Floats,
    heading: Floats,
    wave_length: Floats,
    wave_height: Floats,
    *,
    harmonics: int = 1,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
) -> dict[str, NDArray[np.generic]]:
    """Response, first-order stability, Floquet exponents and verdict at many conditions.

    speed (m,): U [m/s]
    heading (m,): mu [deg]
    wave_length (m,): [m]
    wave_height (m, h): h heights at each of the m conditions, which share forces and coefficients [m]
    harmonics: of the steady motion, as in `steady_motion`
    form: of the diffraction force
    progress: called after each block
    Returns `RESULTS` with leading shape (m, h), and encounter_frequency (m,); angles in degrees

    Where several motions exist, the one that a wave raised slowly from nothing leads to is judged.
    Source: [H71]; every number of a condition without an answer is NaN and its ``status`` says why.
    """
    announce_compilation()
    m, heights = wave_height.shape
    results: dict[str, NDArray[np.generic]] = {name: np.full((m, heights, *s), np.nan) for name, s in RESULTS.items()}
    results["encounter_frequency"] = np.full(m, np.nan)
    results |= {name: np.full((m, heights), int(UNKNOWN[name]), dtype=np.int8) for name in FLAGS}
    limit = capsize_limit(ship).angle
    rows = max(1, BLOCK // heights)
    parts = [slice(start, min(start + rows, m)) for start in range(0, m, rows)]

    def block(part: slice) -> dict[str, NDArray[np.generic]]:
        equations = next(systems([ship], 2 * np.pi / wave_length[part], speed[part], heading[part], form))
        found = judged(equations, wave_height[part], harmonics, limit)
        return found | {"encounter_frequency": equations.encounter_frequency}

    done = 0
    for i, found in spread(block, parts):
        for name, values in found.items():
            results[name][parts[i]] = values.reshape(results[name][parts[i]].shape)
        done += (parts[i].stop - parts[i].start) * heights
        if progress is not None:
            progress(done, m * heights)
    warn_of_conditions(ship, speed, wave_length)
    peaks = np.nan_to_num(results["roll_peak"].astype(float))
    warn_of_polynomial(ship, float(peaks.max(initial=0.0)))
    warn_outside_database(ship, int((results["status"] == Status.OUTSIDE_DATABASE).sum()), m * heights)
    fitted = fitted_to(ship)
    warn_outside_range(ship.name, int((peaks > fitted).sum()), fitted)
    return results


def evaluate_block(grid: Grid, index: int) -> dict[str, NDArray[np.generic]]:
    """Response and stability of one block of a grid: a function of nothing but the two.

    index: of the block
    Returns `RESULTS` with leading shape (loadings, points, heights); encounter_frequency (points,); and beyond (), the
        number of conditions that roll beyond the fit of the righting arm

    Source: [H71]; forces are shared by the loadings, see `systems`.
    """
    block = grid.blocks[index]
    u, mu, length = grid.points(block.points)
    ships = [grid.loaded(i) for i in range(block.loadings.start, block.loadings.stop)]
    height = grid.heights(block.points)
    shape = (len(ships), *height.shape)
    results: dict[str, NDArray[np.generic]] = {
        name: np.empty((*shape, *s), np.int8 if name in FLAGS else np.float64) for name, s in RESULTS.items()
    }
    limits, most = [capsize_limit(ship).angle for ship in ships], max(1, _OF_A_BLOCK // height.shape[1])
    for loadings, equations in in_batches(systems(ships, 2 * np.pi / length, u, mu, grid.form), most):
        count = loadings.stop - loadings.start
        heights, limit = np.tile(height, (count, 1)), np.repeat(limits[loadings], u.size)
        for start in range(0, len(heights), most):
            part = slice(start, start + most)
            for name, values in judged(part_of(equations, part), heights[part], grid.harmonics, limit[part]).items():
                whole = results[name][loadings].reshape(len(heights), -1)  # a view
                whole[part] = values.reshape(len(whole[part]), -1)
        results["encounter_frequency"] = equations.encounter_frequency[: u.size]
    beyond = 0
    for i, ship in enumerate(ships):
        beyond += int((np.nan_to_num(results["roll_peak"][i].astype(float)) > fitted_to(ship)).sum())
    return results | {"beyond": np.array(beyond)}


def judged(
    equations: ShipSystem, height: Floats, harmonics: int, limit: Floats | float
) -> dict[str, NDArray[np.generic]]:
    """Results of some conditions, flat: the heights of one condition beside each other.

    equations: m conditions per metre of wave amplitude
    height (m, h): wave heights [m]
    harmonics: of the steady motion
    limit (m,): roll angle that counts as a capsize [deg], or one for all
    Returns `RESULTS`
    """
    limit = np.repeat(np.broadcast_to(limit, len(height)), height.shape[1])
    system = equations.at_amplitude(0.5 * height)
    u, orders, status, _ = steady_motions(system, harmonics, start="rest", with_residual=False)
    largest = np.degrees(roll_peaks(u, orders))
    status = np.where(np.repeat(equations.slow, height.shape[1]), Status.ENCOUNTER_FREQUENCY_NEAR_ZERO, status)
    status = np.where(np.repeat(equations.outside, height.shape[1]), Status.OUTSIDE_DATABASE, status)
    u, status = within_limits(u, status, largest, limit)
    result = assess(system, u, orders, ACCURACY, detail="map")
    f = result.first_order
    beside = beside_motions(system, result, u, orders, np.radians(largest), np.radians(limit))
    first = 1 if orders[0] == 0 else 0
    sway, roll, yaw = np.hypot(u[:, :, first], u[:, :, first + 1]).T
    growth = np.where(np.isfinite(u).all(axis=(1, 2)), f.growth, np.nan)
    return {
        "sway": sway, "roll": np.degrees(roll), "yaw": np.degrees(yaw),
        "roll_peak": np.where(np.isfinite(roll), largest, np.nan), "missed": missed_roll(system, u, orders),
        "n2": f.n2, "k2": f.k2, "k2_rho": f.k2_rho, "k2_paper": f.k2_paper, "index": f.index,
        "q": f.q, "q_paper": f.q_paper, "slow": f.slow[:, :2], "first_order": growth,
        "exponent": result.floquet.growth, "calm_exponent": result.calm[:, 0].real,
        "multiplier_modulus": np.abs(result.floquet.multipliers[:, :4]), "verdict": result.kind, "status": status,
        "capsizes_on_the_way": beside.way, "other_roll_peak": np.degrees(beside.other_rolls),
    }  # fmt: skip


def warn_outside_range(name: str, beyond: int, fitted: float) -> None:
    """Say that some conditions roll beyond the angle up to which the righting arm is fitted [deg].

    name: of the ship
    beyond: number of such conditions; nothing is said of none
    fitted: [deg]
    """
    if beyond:
        warnings.warn(
            f"{name}: {beyond} conditions roll beyond {fitted:g} deg, where the fit of the righting arm ends;"
            " their size and verdict are extrapolated",
            RangeWarning,
            stacklevel=3,
        )

"""Response and stability of a ship at many conditions: the one path every map and sweep goes through."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import RangeWarning
from quartering.hull.righting import righting_polynomial
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.motion.of_ship import ShipSystem, ship_system
from quartering.motion.status import Status
from quartering.motion.steady import roll_peaks, steady_motions
from quartering.stability.assessment import assess
from quartering.stability.kind import Kind
from quartering.threads import spread

Floats = NDArray[np.float64]
BLOCK = 512
"""Conditions worked on at once by one core: bounds the memory, and how often progress is told."""

RESULTS: dict[str, tuple[int, ...]] = {
    "sway": (), "roll": (), "yaw": (), "roll_peak": (), "n2": (), "k2": (), "k2_rho": (), "k2_paper": (), "index": (),
    "q": (3,), "q_paper": (3,), "slow": (2,), "first_order": (), "exponent": (), "calm_exponent": (),
    "multiplier_modulus": (4,), "verdict": (), "status": (),
}  # fmt: skip
"""Name of every result and the shape it adds to the shape of the conditions."""


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

    Parameters
    ----------
    ship : Ship
    speed : (m,) float            U [m/s]
    heading : (m,) float          mu [deg]
    wave_length : (m,) float      [m]
    wave_height : (m, h) float    h heights at each of the m conditions, which share forces and coefficients [m]
    harmonics : int               of the steady motion, as in `steady_motion`
    form : str                    of the diffraction force
    progress : function(done, total), optional    called after each block

    Returns
    -------
    dict of str to array          `RESULTS` with leading shape (m, h), and encounter_frequency (m,); angles in degrees

    Notes
    -----
    Where several motions exist, the one that a wave raised slowly from nothing leads to is judged.
    Source: [H71]; every number of a condition without an answer is NaN and its ``status`` says why.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> one = np.array([100.0])
    >>> found = evaluate(ship("wigley"), np.array([5.0]), np.array([60.0]), one, np.array([[1.0, 2.0]]))
    >>> found["verdict"].tolist(), found["exponent"].shape
    ([[0, 0]], (1, 2))
    """
    m, heights = wave_height.shape
    results: dict[str, NDArray[np.generic]] = {name: np.full((m, heights, *s), np.nan) for name, s in RESULTS.items()}
    results["encounter_frequency"] = np.full(m, np.nan)
    results["verdict"] = np.full((m, heights), int(Kind.NO_ANSWER), dtype=np.int8)
    results["status"] = np.zeros((m, heights), dtype=np.int8)
    limit = _vanishing_angle(ship)
    rows = max(1, BLOCK // heights)
    parts = [slice(start, min(start + rows, m)) for start in range(0, m, rows)]

    def block(part: slice) -> dict[str, NDArray[np.generic]]:
        equations = ship_system(ship, 2 * np.pi / wave_length[part], speed[part], heading[part], form=form)
        found = _block(equations, wave_height[part], harmonics, limit)
        return found | {"encounter_frequency": equations.encounter_frequency}

    done = 0
    for i, found in spread(block, parts):
        for name, values in found.items():
            results[name][parts[i]] = values.reshape(results[name][parts[i]].shape)
        done += (parts[i].stop - parts[i].start) * heights
        if progress is not None:
            progress(done, m * heights)
    _warn_outside_range(ship, results)
    return results


def _block(equations: ShipSystem, height: Floats, harmonics: int, limit: float) -> dict[str, NDArray[np.generic]]:
    """Results of one block of conditions, flat."""
    system = equations.at_amplitude(0.5 * height)
    u, orders, status, _ = steady_motions(system, harmonics, start="rest")
    largest = np.degrees(roll_peaks(u, orders))
    status = np.where(np.repeat(equations.slow, height.shape[1]), Status.ENCOUNTER_FREQUENCY_NEAR_ZERO, status)
    status = np.where(largest > limit, Status.BEYOND_VANISHING_ANGLE, status).astype(np.int8)
    u = np.where((status > Status.CONVERGED_BY_FOLLOWING)[:, None, None], np.nan, u)
    result = assess(system, u, orders)
    f = result.first_order
    first = 1 if orders[0] == 0 else 0
    sway, roll, yaw = np.hypot(u[:, :, first], u[:, :, first + 1]).T
    growth = np.where(np.isfinite(u).all(axis=(1, 2)), f.growth, np.nan)
    return {
        "sway": sway, "roll": np.degrees(roll), "yaw": np.degrees(yaw),
        "roll_peak": np.where(np.isfinite(roll), largest, np.nan),
        "n2": f.n2, "k2": f.k2, "k2_rho": f.k2_rho, "k2_paper": f.k2_paper, "index": f.index,
        "q": f.q, "q_paper": f.q_paper, "slow": f.slow, "first_order": growth,
        "exponent": result.floquet.growth, "calm_exponent": result.calm[:, 0].real,
        "multiplier_modulus": np.abs(result.floquet.multipliers), "verdict": result.kind, "status": status,
    }  # fmt: skip


def _vanishing_angle(ship: Ship) -> float:
    """Angle at which the fitted righting arm vanishes [deg]; infinite when it does not below 90 degrees."""
    angles = np.linspace(0.5, 90.0, 180)
    gone = righting_polynomial(ship).arm(angles) <= 0
    return float(angles[gone.argmax()]) if gone.any() else float("inf")


def _warn_outside_range(ship: Ship, results: dict[str, NDArray[np.generic]]) -> None:
    fit = righting_polynomial(ship)
    beyond = int((np.nan_to_num(results["roll_peak"].astype(float)) > fit.max_angle).sum())
    if beyond:
        warnings.warn(
            f"{ship.name}: {beyond} conditions roll beyond {fit.max_angle:g} deg, where the fit of the righting arm ends;"
            " their size and verdict are extrapolated",
            RangeWarning,
            stacklevel=3,
        )

"""What each figure of the paper is drawn from: ships, axes and conditions put together, computed once."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from quartering.hull.ship import Ship
from quartering.loads.comparison import compare_forces
from quartering.loads.waves import Wave
from quartering.motion.of_ship import equations
from quartering.motion.steady.motion import steady_motion
from quartering.motion.transient.simulate import simulate
from quartering.stability.verdict import Verdict, stability
from quartering.study.paper.conditions import (
    HEADINGS,
    INSTABILITY_HEADING,
    INSTABILITY_RATIO,
    INSTABILITY_STEEPNESS,
    RATIOS,
    speed_of,
    wave_of,
)
from quartering.study.paper.curves import coefficient_curves, loading_curves, response_curves
from quartering.study.paper.model import FEEDING, PAPER_SHIP, feeding_model, modified_model, paper_ship
from quartering.study.paper.motions import disturbance, integration_check, time_check
from quartering.units import quantity

CB60: Final = PAPER_SHIP
CB70: Final = "series60-cb70"
MARINER: Final = "mariner"
GYRADII_ROLL: Final = ("0.30 B", "0.35 B", "0.40 B", "0.45 B")
GYRADII_YAW: Final = ("0.22 L", "0.25 L", "0.28 L")
HEIGHTS: Final = ("0.03 B", "0.05 B", "0.075 B", "0.10 B")
COEFFICIENTS: Final = ("K_p", "K_ppp", "K_vpp", "K_pvv", "K_prr", "K_vrr")
CHANGES: Final = np.linspace(-100.0, 100.0, 41)
CHECK_HEADING, CHECK_STEEPNESS = 60.0, 1 / 30
DUFFING: Final = {"beta": 0.2, "force": 0.3}
DISTURBANCE, START_ROLL, DURATION = 0.01, 5.0, 300.0
"""Disturbance of roll in Fig. 12, roll at the start of Fig. 13 (the paper's) [deg], and how long both are followed [s]."""


@lru_cache(maxsize=4)
def forces_of(name: str) -> xr.Dataset:
    """Wave forces of a built-in ship with and without the strip correction, in the figures' conditions (Figs. 2-4)."""
    one = paper_ship(name)
    found = compare_forces(one, one.hull.length * np.array(RATIOS), HEADINGS, speed_of(one))
    return found.sel(form=["froude-krylov", "paper", "paper-corrected", "stf"])


@lru_cache(maxsize=4)
def responses_of(name: str) -> xr.Dataset:
    """Response of a built-in ship in the figures' conditions (Figs. 5-10)."""
    return response_curves(paper_ship(name))


def integration_of(name: str) -> tuple[xr.Dataset, xr.Dataset, Wave]:
    """Approximate motion and integration over heading, one motion in time, and their wave (Fig. 11)."""
    one = paper_ship(name)
    wave, speed = wave_of(one, 1.0, CHECK_STEEPNESS), speed_of(one)
    model = equations(one, wave, speed, CHECK_HEADING)
    time = time_check(model, steady_motion(model, 1, start="rest"))
    return integration_check(one, wave, speed, np.arange(15.0, 166.0, 2.5)), time, wave


class Growth(NamedTuple):
    """One motion followed in time: its words, its trace, its verdict, its steady peak of roll [deg]."""

    words: str
    trace: xr.Dataset
    verdict: Verdict
    steady_roll: float


def growing_cases(linear: bool) -> list[Growth]:
    """The modified model, and the one in which yaw feeds roll, followed in time (Figs. 12, 13).

    linear: a disturbance by the variational equations; or the full equations started with a roll angle
    """
    cases = []
    for words, one in (
        ("Table I ratios on the estimated coefficients", modified_model()),
        (f"the same with K_prr × {FEEDING:g} (invented)", feeding_model()),
    ):
        model = equations(one, instability_wave(one), speed_of(one), INSTABILITY_HEADING)
        motion = steady_motion(model, 9, start="rest")
        if linear:
            trace = disturbance(model, motion, DURATION, DISTURBANCE)
        else:
            trace = simulate(model, DURATION, (0.0, float(np.radians(START_ROLL)), 0.0, 0.0))
        cases.append(Growth(words, trace, stability(model, motion), float(np.degrees(motion.peak[1]))))
    return cases


def roll_rate(verdict: Verdict) -> float:
    """Growth rate of the oscillating pair of exponents, the one a disturbance of roll shows [1/s]."""
    pair = verdict.exponents[np.abs(verdict.exponents.imag) > 1e-6]
    return float(pair[0].real) if pair.size else float(verdict.exponents[0].real)


def instability_wave(one: Ship) -> Wave:
    """Wave of the unstable case."""
    return wave_of(one, INSTABILITY_RATIO, INSTABILITY_STEEPNESS)


@lru_cache(maxsize=4)
def gyradii_of(name: str, froude: float) -> Mapping[str, xr.Dataset]:
    """Response and stability of a built-in ship for several radii of gyration (Figs. 14-19)."""
    one = paper_ship(name)
    return {
        axis: loading_curves(one, axis, _lengths(one, axis, values), froude=froude)
        for axis, values in (("gyradius_roll", GYRADII_ROLL), ("gyradius_yaw", GYRADII_YAW))
    }


@lru_cache(maxsize=4)
def heights_of(name: str) -> Mapping[str, xr.Dataset]:
    """Response and stability of a built-in ship for several metacentric heights (Figs. 20, 21)."""
    one = paper_ship(name)
    return {"gm": loading_curves(one, "gm", _lengths(one, "gm", HEIGHTS))}


def _lengths(one: Ship, name: str, values: tuple[str, ...]) -> list[float]:
    hull = one.hull
    sizes = {"length": hull.length, "beam": hull.beam, "draught": hull.draught}
    return [quantity(value, "length", **sizes, what=name) for value in values]


def coefficients_of(name: str) -> dict[str, xr.Dataset]:
    """K2 and exponents against the change of each coefficient, the ship as estimated and where yaw feeds roll (Fig. 22)."""
    one = paper_ship(name)
    cases = {
        "as estimated, heading 30 deg": (one, 30.0),
        f"Table I ratios, K_prr × {FEEDING:g} (invented), heading 15 deg": (feeding_model(one), INSTABILITY_HEADING),
    }
    return {
        words: coefficient_curves(each, COEFFICIENTS, CHANGES, instability_wave(each), speed_of(each), heading)
        for words, (each, heading) in cases.items()
    }

"""The motion of a ship for pictures that move: samples in time, without the drift that leaves a picture."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_SHOWN_PERIOD = 3.0
"""Seconds one wave period takes to watch."""


class Moves(NamedTuple):
    """What moves, over time [s]: roll, yaw, pitch [rad], sway and heave (up) [m]."""

    time: Floats
    roll: Floats
    sway: Floats
    yaw: Floats
    heave: Floats
    pitch: Floats


def moves_of(trace: xr.Dataset, period: float) -> Moves:
    """The motion of `quartering.simulate` for a picture: drift off the course and to the side is left out.

    period: of encounter [s], over which what drifts is averaged
    """
    known = np.isfinite(trace["roll"].values)
    time = trace["time"].values[known]

    def of(name: str) -> Floats:
        return np.asarray(trace[name].values[known], dtype=float)

    yaw = np.radians(
        of("yaw") if "yaw" in trace else of("heading") if "heading" in trace else _summed(time, of("yaw_rate"))
    )
    still = np.zeros_like(time)
    return Moves(
        time,
        np.radians(of("roll")),
        _without_drift(time, _summed(time, of("sway_velocity")), period),
        _without_drift(time, yaw, period),
        -of("heave") if "heave" in trace else still,
        np.radians(of("pitch")) if "pitch" in trace else still,
    )


def _summed(time: Floats, rate: Floats) -> Floats:
    """Integral of a rate by the trapezoidal rule."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])


def _without_drift(time: Floats, values: Floats, period: float) -> Floats:
    """Values less their mean over a period round each."""
    if time.size < 3:
        return values - values.mean() if values.size else values
    half = max(1, round(0.5 * period / (time[1] - time[0])))
    if time.size <= 2 * half:
        return values - np.linspace(values[0], values[-1], values.size)
    total = np.concatenate([[0.0], np.cumsum(values)])
    middle = np.clip(np.arange(values.size), half, values.size - 1 - half)
    return values - (total[middle + half + 1] - total[middle - half]) / (2 * half + 1)


def pace_of(period: float) -> float:
    """How much faster than in nature the motion is shown: a wave period takes about three seconds to watch.

    >>> pace_of(12.0), pace_of(3.1)
    (4.0, 1.0)
    """
    return float(max(1, round(period / _SHOWN_PERIOD)))

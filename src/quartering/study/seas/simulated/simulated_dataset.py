"""Simulations of a sea as one labelled dataset: numbers with their errors, units and meanings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import HEADING_CONVENTION, REFERENCE_POINT
from quartering.motion.sea.march import ACCELERATION, NONE, ROLL, RUN_UP
from quartering.study.dataset import made_by
from quartering.study.seas.dataset import MEANINGS, name_of, pile_up_lines, scalars, sea_coordinates
from quartering.study.seas.simulated.blocks import BLOCK, ROLL_SQUARED, Blocks, Tally
from quartering.study.seas.simulated.failures import failure_rate, waiting_times_p

Floats = NDArray[np.float64]

LARGEST_OF: Final = 3.0
"""Hours that a mean largest value is of."""
_CAUSES: Final = {NONE: "none", ROLL: "roll", ACCELERATION: "lateral_acceleration", RUN_UP: "failed_in_run_up"}
_FELT_SQUARED: Final = 14


def simulated_dataset(tally: Tally, known: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a simulation; see `irregular`."""
    data = _second_moments(tally) | _largest(tally.blocks) | _failures(tally)
    for name, value in zip(("overtaken", "near_zero", "cut_off"), known["shares"], strict=True):
        data[name] = _meant(name, value)
    data |= pile_up_lines(known["roll_frequency"], known["speed"])
    sea, ship = known["sea"], known["ship"]
    attributes = {
        "title": "Simulation in an irregular sea",
        "method": "simulation",
        "method_meaning": "nonlinear motion in time, Gaussian records by Fourier transform",
        "seas": sea.words,
        "cut": "; ".join(dict.fromkeys(f"{one.band[0]:.3g} to {one.band[1]:.3g} rad/s" for one in sea.partitions)),
        "speed": known["speed"],
        "hours": tally.state[0] * BLOCK / 3600.0,
        "hours_of_largest": LARGEST_OF,
        **known["attributes"],
        "roll_frequency": known["roll_frequency"],
        "heading_convention": HEADING_CONVENTION,
        "reference_point": REFERENCE_POINT,
        "references": "H71, STF70, Tucker84",
        "source": made_by(),
        "ship": name_of(ship),
    }
    return xr.Dataset(data, sea_coordinates([sea], {}, {}), attributes)


def _meant(name: str, value: Any) -> xr.Variable:
    """A variable that a response to a sea has too, with the same unit and meaning."""
    unit, meaning, dims = MEANINGS[name]
    return xr.Variable(dims, value, {"units": unit, "long_name": meaning})


def _error_of(dims: tuple[str, ...], value: Any, unit: str, words: str = "its standard error") -> xr.Variable:
    return xr.Variable(dims, value, {"units": unit, "long_name": words})


def _second_moments(tally: Tally) -> dict[str, xr.Variable]:
    """Root mean squares and the covariance with their standard errors between blocks."""
    c, error = np.zeros((4, 4)), np.zeros((4, 4))
    means = np.array([tally.mean(10 + k)[0] for k in range(4)])
    for k, (a, b) in enumerate(zip(*np.triu_indices(4), strict=True)):
        value, wrong = tally.mean(k)
        c[a, b] = c[b, a] = value - means[a] * means[b]
        error[a, b] = error[b, a] = wrong
    roll = math.sqrt(max(c[1, 1], 0.0)) if c[1, 1] == c[1, 1] else math.nan
    felt, felt_error = tally.mean(_FELT_SQUARED)
    felt_rms = math.sqrt(felt) if felt >= 0 else math.nan
    degrees = math.degrees(1.0)
    mean_error = tally.mean(11)[1]
    squared_error = tally.mean(ROLL_SQUARED)[1]
    between = "its standard error, measured between blocks"
    return {
        "covariance": _meant("covariance", c),
        "covariance_error": _error_of(("state", "state_2"), error, "SI", between),
        "roll_rms": _meant("roll_rms", degrees * roll),
        "roll_rms_error": _error_of((), _half(degrees * squared_error, roll), "deg"),
        "roll_mean": _meant("roll_mean", degrees * means[1]),
        "roll_mean_error": _error_of((), degrees * mean_error, "deg"),
        "lateral_acceleration_rms": _meant("lateral_acceleration_rms", felt_rms),
        "lateral_acceleration_rms_error": _error_of((), _half(felt_error, felt_rms), "m s-2"),
    }


def _half(error: float, root: float) -> float:
    """Error of a root from that of its square."""
    return 0.5 * error / root if root > 0 else math.nan


def _largest(blocks: Blocks) -> dict[str, xr.Variable]:
    """Largest values of each block, and mean largest of three hours of counted blocks one after another."""
    data = {}
    each = round(LARGEST_OF * 3600.0 / BLOCK)
    counted = blocks.cause != RUN_UP
    for name, values, factor, unit, words in (
        ("roll", blocks.roll, math.degrees(1.0), "deg", "largest |roll|"),
        ("lateral_acceleration", blocks.felt, 1.0, "m s-2", "largest lateral acceleration"),
    ):
        own = factor * values.astype(float)
        groups = own[counted][: counted.sum() // each * each].reshape(-1, each).max(axis=1)
        mean = groups.mean() if groups.size else math.nan
        error = groups.std(ddof=1) / math.sqrt(groups.size) if groups.size > 1 else math.nan
        more = f"{words} of {LARGEST_OF:g} h, mean of {groups.size}; a failure ends a block, what would follow is not in it"
        data[f"{name}_mean_largest"] = xr.Variable((), mean, {"units": unit, "long_name": more})
        data[f"{name}_mean_largest_error"] = xr.Variable((), error, {"units": unit, "long_name": "its standard error"})
        own[~counted] = math.nan
        data[f"{name}_largest"] = xr.Variable(("block",), own, {"units": unit, "long_name": f"{words} of each block"})
    return data


def _failures(tally: Tally) -> dict[str, xr.Variable]:
    """Failures, exposure and rate with its interval."""
    blocks = tally.blocks
    counted = blocks.cause != RUN_UP
    failed = counted & (blocks.cause != NONE)
    times = blocks.until.astype(float)
    exposure = float(times[counted].sum())
    count = int(failed.sum())
    rate = failure_rate(count, exposure)
    flags = {
        "flag_values": np.array(list(_CAUSES), dtype=np.int8),
        "flag_meanings": " ".join(_CAUSES.values()),
        "long_name": "what ended each block",
    }
    rows = {
        "exposure": (exposure / 3600.0, "h", "time until failure or end of a block, summed, run-up left out"),
        "failures": (count, "1", "failures by roll or by lateral acceleration"),
        "failures_by_acceleration": (int((blocks.cause == ACCELERATION).sum()), "1", "of them by lateral acceleration"),
        "failure_rate": (rate.rate, "s-1", "failures over exposure"),
        "rate_lower": (rate.lower, "s-1", "lower end of its exact 95 % interval"),
        "rate_upper": (rate.upper, "s-1", "upper end of its exact 95 % interval"),
        "waiting_time_p": (
            waiting_times_p(times[failed], BLOCK, rate.rate),
            "1",
            "probability of times to failure as far from exponential ones; NaN of fewer than five",
        ),
    }
    data = scalars(rows)
    data["failure_time"] = xr.Variable(
        ("block",),
        np.where(failed, times, math.nan),
        {"units": "s", "long_name": "time of failure in each block; NaN without"},
    )
    data["failure_cause"] = xr.Variable(("block",), blocks.cause.copy(), flags)
    return data

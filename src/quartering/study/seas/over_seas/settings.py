"""What a study in irregular seas is told beside its axes: spectrum, spreading, swell, and what is judged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hull.told import count, number
from quartering.loads.forces import FORMS, Form
from quartering.loads.sea.sea import Sea, Spectrum
from quartering.loads.sea.shape import mean_period_ratio
from quartering.loads.sea.spreading import Spreading, checked_spreading
from quartering.loads.sea.systems import JONSWAP_POWER
from quartering.loads.sea.torsethaugen import torsethaugen
from quartering.option_checks import quoted
from quartering.study.criteria.constants import constant

Floats = NDArray[np.float64]
Judge = Literal["largest", "rate"]
"""What guidance goes by: the mean largest motion of three hours, or the rate of failures."""
TWO_PEAKED: Final = "torsethaugen"
"""Spectrum whose mean period hangs on its height too: its axis is the period of the peak."""


@dataclass(frozen=True)
class SeaSettings:
    """What is alike for all conditions of a study in irregular seas.

    Parameters
    ----------
    spectrum : str          of hs and tz, or hs and tp
    gamma : float           peak enhancement of "jonswap"
    spreading : Spreading
    swell : Sea             beside each sea of the study; its heading is the angle off that sea's [deg]
    judge : str             what guidance goes by
    threshold : float       factor on the mean largest motion of three hours, or rate of failures [1/s]; None: the circular's
    hours : float           to simulate at most where the closure does not decide; 0: none [h]
    seed : int              of simulations
    form : str              of the diffraction force
    """

    spectrum: Spectrum = "jonswap"
    gamma: float = 3.3
    spreading: Spreading = None
    swell: Sea | None = None
    judge: Judge = "largest"
    threshold: float | None = None
    hours: float = 0.0
    seed: int = 0
    form: Form = "stf"

    def checked(self) -> SeaSettings:
        """The same with every value in its range and none left out."""
        _check_words(self.spectrum, self.judge, self.form)
        if self.swell is not None and not isinstance(self.swell, Sea):
            raise InputError(
                f"swell = {quoted(self.swell)} is no Sea; give one, its heading the angle off the sea's, such as"
                " quartering.Sea(hs=2, tp=14, heading=40)"
            )
        name, own = ("safety_factor", "safety_factor") if self.judge == "largest" else ("rate_limit", "failure_rate")
        usual = constant(f"operational_guidance.{own}").value
        return replace(
            self,
            gamma=number(None, "gamma", self.gamma),
            spreading=checked_spreading(self.spreading),
            threshold=usual if self.threshold is None else number(None, name, self.threshold),
            hours=0.0 if self.hours == 0 else number(None, "simulated_hours", self.hours),
            seed=count("seed", self.seed, 0, 6),
        )

    @property
    def one_sided(self) -> bool:
        """Does a swell come from one side, so that headings to port and to starboard differ?"""
        return self.swell is not None and any(abs(one.heading) % 180.0 > 1e-9 for one in self.swell.partitions)


def _check_words(spectrum: Any, judge: Any, form: Any) -> None:
    if spectrum not in get_args(Spectrum):
        raise InputError(
            f"spectrum = {quoted(spectrum)}; allowed in maps: {', '.join(get_args(Spectrum))}; try 'jonswap'"
        )
    if judge not in get_args(Judge):
        raise InputError(
            f"judge = {quoted(judge)}; allowed: largest (motion of three hours), rate (of failures); try 'largest'"
        )
    if form not in get_args(Form):
        raise InputError(f"form {form!r} given; allowed: {', '.join(FORMS)}; try 'stf'")


def period_ratio(spectrum: str, gamma: float) -> float:
    """Mean zero-crossing period over that of the peak, of a spectrum with one peak."""
    return mean_period_ratio(JONSWAP_POWER, gamma if spectrum == "jonswap" else 1.0)


def mean_periods(spectrum: str, gamma: float, hs: ArrayLike, tp: ArrayLike) -> Floats:
    """Mean zero-crossing periods (n, m) of seas of n heights and m peak periods [s].

    >>> mean_periods("bretschneider", 1.0, [2.0, 4.0], [10.0]).round(3).tolist()
    [[7.104], [7.104]]
    """
    heights, peaks = np.atleast_1d(np.asarray(hs, dtype=float)), np.atleast_1d(np.asarray(tp, dtype=float))
    if spectrum != TWO_PEAKED:
        return np.ones((heights.size, 1)) * peaks * period_ratio(spectrum, gamma)
    found = np.empty((heights.size, peaks.size))
    for place in np.ndindex(found.shape):
        systems = torsethaugen(float(heights[place[0]]), float(peaks[place[1]]))[0]
        m0, m2 = (sum(one.moment(n) for one in systems) for n in (0, 2))
        found[place] = 2.0 * np.pi * np.sqrt(m0 / m2)
    return found


def steepness(hs: ArrayLike, tz: ArrayLike) -> Floats:
    """Heights over the lengths g Tz^2/(2 pi) of the mean periods [1]."""
    return np.asarray(np.asarray(hs) * 2.0 * np.pi / (GRAVITY * np.asarray(tz) ** 2))

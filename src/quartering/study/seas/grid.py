"""Conditions of a study in irregular seas: speed, heading, period and height of the sea, and any loading."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.digest import fingerprint
from quartering.conventions import GRAVITY, InputError
from quartering.hull.ship import Ship
from quartering.hull.told import count, number
from quartering.loads.forces import FORMS, Form
from quartering.loads.sea.sea import STEEPEST_SEA, Sea, Spectrum
from quartering.loads.sea.shape import mean_period_ratio
from quartering.loads.sea.spreading import Spreading, checked_spreading
from quartering.loads.sea.systems import JONSWAP_POWER
from quartering.option_checks import quoted
from quartering.study.criteria.constants import constant
from quartering.study.grid import Grid, axis, check_count, combinations, loading_columns

Floats = NDArray[np.float64]
Judge = Literal["largest", "rate"]
"""What guidance goes by: the mean largest motion of three hours, or the rate of failures."""
_SMALLEST, _LARGEST, _PARTS = 16, 256, 64


@dataclass(frozen=True, eq=False)
class SeaGrid(Grid):
    """Every condition of a study in irregular seas; its axes are speed, heading, tz and hs.

    Parameters
    ----------
    spectrum : str         of two parameters, hs and tz; "torsethaugen" of one height and one peak period
    gamma : float          peak enhancement of "jonswap"
    spreading : Spreading
    judge : str            what guidance goes by
    threshold : float      factor on the mean largest motion of three hours, or rate of failures [1/s]
    hours : float          to simulate at most where the closure does not decide; 0: none
    seed : int             of simulations
    period_ratio : float   mean zero-crossing period over that of the peak [1]
    """

    spectrum: Spectrum = "jonswap"
    gamma: float = 3.3
    spreading: Spreading = None
    judge: Judge = "largest"
    threshold: float = 2.0
    hours: float = 0.0
    seed: int = 0
    period_ratio: float = 1.0

    @property
    def usual_block_size(self) -> int:
        """Conditions of one block, by their number alone."""
        return min(max(self.count // _PARTS, _SMALLEST), _LARGEST)

    @cached_property
    def described(self) -> dict[str, Any]:
        """What decides the results, in types JSON knows."""
        return {
            "kind": "seas",
            "ship": {"name": self.ship.name, "digest": fingerprint(self.ship)},
            **{name: values.tolist() for name, values in self.axes.items()},
            "loadings": {name: values.tolist() for name, values in self.loadings.items()},
            **{name: getattr(self, name) for name in _SETTINGS},
            **({"tp": self.peak_periods.tolist()} if self.spectrum == "torsethaugen" else {}),
            "form": self.form,
        }

    @cached_property
    def digest(self) -> str:
        """Digest of what decides the results."""
        return fingerprint(self.described)

    @property
    def peak_periods(self) -> Floats:
        """Periods of the peak of each tz [s]."""
        return np.asarray(self.axes["tz"] / self.period_ratio)

    def sea_at(self, hs: float, tz: float, heading: float) -> Sea | None:
        """The sea of one condition; None where it breaks."""
        if breaks(hs, tz):
            return None
        # two peaks have no mean period that tells them: the one sea of such a grid is given by its peak
        by_peak = self.spectrum == "torsethaugen"
        return Sea(
            hs=hs, tp=tz / self.period_ratio if by_peak else None, tz=None if by_peak else tz, spectrum=self.spectrum,
            gamma=self.gamma, heading=heading, spreading=self.spreading,
        )  # fmt: skip


_SETTINGS: Final = ("spectrum", "gamma", "spreading", "judge", "threshold", "hours", "seed")


def breaks(hs: ArrayLike, tz: ArrayLike) -> NDArray[np.bool_]:
    """Is a sea of these heights and mean periods too steep to be one?"""
    return np.asarray(steepness(hs, tz) > STEEPEST_SEA)


def steepness(hs: ArrayLike, tz: ArrayLike) -> Floats:
    """Heights over the lengths g Tz^2/(2 pi) of the mean periods [1]."""
    return np.asarray(np.asarray(hs) * 2.0 * np.pi / (GRAVITY * np.asarray(tz) ** 2))


def _period_ratio(spectrum: Spectrum, gamma: float, height: Floats, tp: Any, ship: Ship) -> float:
    """Mean zero-crossing period over that of the peak; of two peaks that of the one sea there is."""
    if spectrum != "torsethaugen":
        return mean_period_ratio(JONSWAP_POWER, gamma if spectrum == "jonswap" else 1.0)
    peak = None if tp is None else axis("tp", tp, ship)
    if peak is None or peak.size != 1 or height.size != 1:
        raise InputError(
            f"spectrum = {quoted(spectrum)}: its mean period follows from height and peak together; a map takes one hs and one"
            " tp of it, or one of jonswap, bretschneider, pierson-moskowitz"
        )
    return Sea(hs=float(height[0]), tp=float(peak[0]), spectrum=spectrum).tz / float(peak[0])


def sea_grid(
    ship: Ship,
    speed: ArrayLike,
    heading: ArrayLike,
    hs: ArrayLike,
    tp: ArrayLike | None = None,
    tz: ArrayLike | None = None,
    *,
    spectrum: Spectrum = "jonswap",
    gamma: float = 3.3,
    spreading: Spreading = None,
    judge: Judge = "largest",
    threshold: float | None = None,
    hours: float = 0.0,
    seed: int = 0,
    form: Form = "stf",
    factors: Mapping[str, ArrayLike] | None = None,
    values: Mapping[str, ArrayLike] | None = None,
    **axes: ArrayLike,
) -> SeaGrid:
    """All combinations of seas, speeds, headings and loadings, checked; see `quartering.guidance` for what each is.

    >>> from quartering.hull.file.read import ship
    >>> sea_grid(ship("wigley"), [5.0, 7.0], [30, 60], [2, 3], tp=[8, 10], gm=[1.0, 1.2]).shape
    (2, 2, 2, 2, 2)
    """
    _check_words(spectrum, judge, form)
    peak = number(None, "gamma", gamma)
    conditions = {"speed": axis("speed", speed, ship), "heading": axis("heading", heading, ship)}
    height = axis("hs", hs, ship)
    _one_period(tp, tz)
    ratio = _period_ratio(spectrum, peak, height, tp, ship)
    mean = axis("tp", tp, ship) * ratio if tp is not None else axis("tz", tz, ship)  # type: ignore[arg-type]  # one is given
    conditions |= {"tz": mean, "hs": height}
    if breaks(conditions["hs"].min(), conditions["tz"].max()):
        raise InputError(
            f"every sea asked for breaks: Hs {conditions['hs'].min():g} m at Tz {conditions['tz'].max():.3g} s is steeper than"
            f" {STEEPEST_SEA:g}; give lower heights or longer periods"
        )
    ship, extra = loading_columns(ship, axes, factors, values)
    check_count({**conditions, **extra})
    name = "safety_factor" if judge == "largest" else "rate_limit"
    usual = constant(f"operational_guidance.{'safety_factor' if judge == 'largest' else 'failure_rate'}").value
    made = SeaGrid(
        ship, conditions, combinations(extra), form=form, spectrum=spectrum, gamma=peak,
        spreading=checked_spreading(spreading), judge=judge,
        threshold=usual if threshold is None else number(None, name, threshold),
        hours=0.0 if hours == 0 else number(None, "simulated_hours", hours), seed=count("seed", seed, 0, 6),
        period_ratio=ratio,
    )  # fmt: skip
    made.check_loadings()
    return made


def _check_words(spectrum: Any, judge: Any, form: Any) -> None:
    if spectrum not in get_args(Spectrum):
        raise InputError(f"spectrum = {quoted(spectrum)}; allowed: {', '.join(get_args(Spectrum))}; try 'jonswap'")
    if judge not in get_args(Judge):
        raise InputError(
            f"judge = {quoted(judge)}; allowed: largest (motion of three hours), rate (of failures); try 'largest'"
        )
    if form not in get_args(Form):
        raise InputError(f"form {form!r} given; allowed: {', '.join(FORMS)}; try 'stf'")


def _one_period(tp: Any, tz: Any) -> None:
    if (tp is None) == (tz is None):
        both = "are both given; one follows from the other, leave one out" if tp is not None else "are missing"
        raise InputError(f"tp and tz {both}; give one of the two, such as tp=[8, 11, 14]")

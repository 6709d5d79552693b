"""Conditions of a study in irregular seas: speed, heading, period and height of the sea, and any loading."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.digest import fingerprint
from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.sea.sea import STEEPEST_SEA, Sea, Spectrum
from quartering.loads.sea.spreading import Spreading
from quartering.study.grid import Grid, axis, check_count, combinations, loading_columns
from quartering.study.seas.over_seas.settings import (
    TWO_PEAKED,
    Judge,
    SeaSettings,
    mean_periods,
    period_ratio,
    steepness,
)

Floats = NDArray[np.float64]
_SMALLEST, _LARGEST, _PARTS = 16, 256, 64


@dataclass(frozen=True, eq=False)
class SeaGrid(Grid):
    """Every condition of a study in irregular seas; its axes are speed, heading, tz (or tp) and hs.

    Parameters
    ----------
    spectrum, gamma, spreading, swell, judge, threshold, hours, seed    as of `SeaSettings`, checked
    """

    spectrum: Spectrum = "jonswap"
    gamma: float = 3.3
    spreading: Spreading = None
    swell: Sea | None = None
    judge: Judge = "largest"
    threshold: float = 2.0
    hours: float = 0.0
    seed: int = 0

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
            "swell": None if self.swell is None else {"name": repr(self.swell), "digest": fingerprint(self.swell)},
            "form": self.form,
        }

    @cached_property
    def digest(self) -> str:
        """Digest of what decides the results."""
        return fingerprint(self.described)

    @property
    def period(self) -> str:
        """Name of the axis of periods: tz, or tp of a spectrum of two peaks."""
        return "tp" if "tp" in self.axes else "tz"

    @property
    def one_sided(self) -> bool:
        """Do headings to port and to starboard differ?"""
        return SeaSettings(swell=self.swell).one_sided

    @cached_property
    def steepness(self) -> Floats:
        """Steepness (hs, period) of each sea, without a swell [1]."""
        hs, period = self.axes["hs"], self.axes[self.period]
        tz = period if self.period == "tz" else mean_periods(self.spectrum, self.gamma, hs, period)
        return steepness(hs[:, None], tz)

    @property
    def breaks(self) -> NDArray[np.bool_]:
        """Which seas (hs, period) are too steep to be one?"""
        return np.asarray(self.steepness > STEEPEST_SEA)

    def sea_at(self, hs: float, period: float, heading: float) -> Sea | None:
        """The sea of one condition, with the swell beside it; None where it breaks."""
        try:
            tp, tz = (period, None) if self.period == "tp" else (None, period)
            own = Sea(hs=hs, tp=tp, tz=tz, spectrum=self.spectrum, gamma=self.gamma, spreading=self.spreading)
            return (own if self.swell is None else own + self.swell).turned_to(heading)
        except InputError:  # all values are checked: what is left to be refused is its steepness
            return None


_USUAL: Final = SeaSettings()
_SETTINGS: Final = ("spectrum", "gamma", "spreading", "judge", "threshold", "hours", "seed")


def sea_grid(
    ship: Ship,
    speed: ArrayLike,
    heading: ArrayLike,
    hs: ArrayLike,
    tp: ArrayLike | None = None,
    tz: ArrayLike | None = None,
    *,
    settings: SeaSettings = _USUAL,
    factors: Mapping[str, ArrayLike] | None = None,
    values: Mapping[str, ArrayLike] | None = None,
    **axes: ArrayLike,
) -> SeaGrid:
    """All combinations of seas, speeds, headings and loadings, checked; see `quartering.guidance` for what each is.

    >>> from quartering.hull.file.read import ship
    >>> sea_grid(ship("wigley"), [5.0, 7.0], [30, 60], [2, 3], tp=[8, 10], gm=[1.0, 1.2]).shape
    (2, 2, 2, 2, 2)
    """
    told = settings.checked()
    conditions = {"speed": axis("speed", speed, ship), "heading": axis("heading", heading, ship)}
    conditions |= _periods(tp, tz, told, ship) | {"hs": axis("hs", hs, ship)}
    ship, extra = loading_columns(ship, axes, factors, values)
    check_count({**conditions, **extra})
    named = {name: getattr(told, name) for name in (*_SETTINGS, "swell")}
    made = SeaGrid(ship, conditions, combinations(extra), form=told.form, **named)
    if made.breaks.all():
        lowest, longest = conditions["hs"].min(), conditions[made.period].max()
        raise InputError(
            f"every sea asked for breaks: Hs {lowest:g} m at T{made.period[1]} {longest:.3g} s is steeper than"
            f" {STEEPEST_SEA:g}; give lower heights or longer periods"
        )
    made.check_loadings()
    return made


def _periods(tp: Any, tz: Any, told: SeaSettings, ship: Ship) -> dict[str, Floats]:
    """The axis of periods, by its name."""
    if (tp is None) == (tz is None):
        both = "are both given; one follows from the other, leave one out" if tp is not None else "are missing"
        raise InputError(f"tp and tz {both}; give one of the two, such as tp=[8, 11, 14]")
    if told.spectrum == TWO_PEAKED:
        if tp is None:
            raise InputError(
                "tz of a spectrum of two peaks: several peak periods have the same mean; give tp, of the larger peak"
            )
        return {"tp": axis("tp", tp, ship)}
    if tp is None:
        return {"tz": axis("tz", tz, ship)}
    return {"tz": axis("tp", tp, ship) * period_ratio(told.spectrum, told.gamma)}

"""Vertical datum of offsets: baseline or waterline, and how it is decided."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal, NamedTuple, cast

import numpy as np

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats
from quartering.option_checks import checked
from quartering.options import OPTIONS
from quartering.units import LENGTHS

Datum = Literal["keel", "waterline"]

NEAR: Final = 0.25
"""Distance of the keel amidships from where a datum puts it, of the draught, up to which the lines fit that datum."""
DEEPEST: Final = 0.05
"""The same for the deepest point of all, which a bar keel, a dome or the rake may have below the rest."""
DRAUGHT: Final = 0.01
"""Difference of the draught told and that of lines counted from the calm water, of the draught, that counts as rounding."""


class Profile(NamedTuple):
    """Lowest and highest points along a hull, as its file counts them.

    Parameters
    ----------
    x : (s,) float            stations [m]
    keel, top : (s,) float    lowest and highest point of each [m]
    """

    x: Floats
    keel: Floats
    top: Floats

    @property
    def middle(self) -> tuple[float, float]:
        """Keel and top of the hull: medians over the middle half of its length, so that no appendage counts."""
        low, high = float(self.x.min()), float(self.x.max())
        inner = np.abs(self.x - (low + high) / 2) <= (high - low) / 4 + 1e-9
        inner = inner if inner.any() else np.ones(self.x.shape, dtype=bool)
        return float(np.median(self.keel[inner])), float(np.median(self.top[inner]))

    @property
    def deepest(self) -> float:
        """Lowest point of all [m]."""
        return float(self.keel.min())


def profile_of(x: Floats, contours: Sequence[tuple[Floats, Floats]]) -> Profile:
    """Lowest and highest points of contours (y, height).

    >>> profile_of(np.zeros(1), [(np.array([0.0, 5.0]), np.array([-4.0, 2.0]))]).middle
    (-4.0, 2.0)
    """
    return Profile(
        np.asarray(x, dtype=float),
        np.array([height.min() for _, height in contours], dtype=float),
        np.array([height.max() for _, height in contours], dtype=float),
    )


def datum_of(
    where: str,
    profile: Profile,
    draught: float,
    told: str | None = None,
    *,
    usual: Datum | None = None,
    still_water: float | None = None,
) -> Datum:
    """Decide where heights are counted from.

    where: file named in messages
    profile: of the whole hull
    draught: of the lines [m]
    told: "keel" or "waterline", which decides
    usual: datum of the format, where it has one
    still_water: height of the calm plane in the file, where its header says it [m]
    Returns "keel" or "waterline"

    Counted from the baseline the keel amidships lies at 0, from the calm water at -T, whatever stands out below it at
    one place; and lines that end below the water can be counted from it alone.  Source: geometry.

    >>> bar = Profile(np.linspace(-50, 50, 5), np.array([0, 0, -0.05, 0, 0]), np.full(5, 3.0))
    >>> datum_of("my.csv", bar, 2.25)
    'keel'
    """
    found = (
        cast("Datum", checked(OPTIONS["datum"], told, where))
        if told
        else _decided(where, profile, draught, usual, still_water)
    )
    if found == "waterline":
        _check_draught(where, profile, draught, told)
    return found


def _decided(where: str, profile: Profile, draught: float, usual: Datum | None, still_water: float | None) -> Datum:
    (keel, top), deepest = profile.middle, profile.deepest
    fits: list[Datum] = []
    if _fits(keel, deepest, 0.0, draught) and top >= 0.98 * draught:
        fits.append("keel")
    if _fits(keel, deepest, -draught, draught) and top >= -0.02 * draught:
        fits.append("waterline")
    if usual in fits or (usual == "waterline" and deepest < 0 <= top + 0.02 * draught):
        return usual
    if len(fits) == 1:
        return fits[0]
    if still_water is not None and abs(still_water - draught) < 0.02 * draught and top >= 0.98 * draught:
        return "keel"
    if still_water == 0.0 and deepest < 0:
        return "waterline"
    if not fits and 0 <= keel <= top < 0.98 * draught:
        return "keel"  # of another size than told, which is refused in its own words
    if deepest < 0 and top < 0.98 * draught:
        return "waterline"
    both = "fits both" if fits else "fits neither"
    raise InputError(
        f"{where}: are its heights counted from the baseline or from the calm water? The keel amidships lies at {keel:.4g} m, "
        f"the lowest point at {deepest:.4g} m, the sections end at {top:.4g} m; the draught of {draught:g} m {both}; write "
        "`datum: keel` or `datum: waterline`, or correct the draught"
    )


def _fits(keel: float, deepest: float, at: float, draught: float) -> bool:
    return abs(keel - at) <= NEAR * draught or abs(deepest - at) <= DEEPEST * draught


def _check_draught(where: str, profile: Profile, draught: float, told: str | None) -> None:
    """Refuse lines counted from the calm water that are of another draught."""
    own = -profile.middle[0], -profile.deepest
    if any(abs(one - draught) <= DRAUGHT * draught for one in own):
        return
    words = f"{own[0]:.4g} m deep amidships" + (f" and {own[1]:.4g} m at the deepest" if own[1] > 1.01 * own[0] else "")
    other = "" if told else "; or write `datum: keel` if its heights count from the baseline"
    units = [
        unit for unit, metres in LENGTHS.items() if unit != "m" and abs(own[0] * metres - draught) <= NEAR * draught
    ]
    if units:
        other = f"; or are its numbers in {units[0]}? Then write `lines: {{file: .., unit: {units[0]}}}`"
    raise InputError(
        f"{where}: the draught told is {draught:g} m, and the lines lie {words} below the calm water from which their heights "
        f"count; give `draught: {own[0]:.4g} m` (or `design_draught: {own[0]:.4g} m`, and the ship's draught beside it){other}"
    )

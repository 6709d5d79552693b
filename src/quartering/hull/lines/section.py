"""One transverse section: starboard half contour, area, breadth, draught."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.hull.told import real
from quartering.option_checks import quoted

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Section:
    """Starboard half contour of a section, from the keel up; z is down from the calm water plane [m].

    Parameters
    ----------
    y : (n,) float    half breadths, >= 0 [m]
    z : (n,) float    depth below the calm plane, from the keel (largest) upward; negative above water [m]

    Raises
    ------
    InputError    fewer than two points, unequal lengths, a NaN, a negative half breadth, or no point under water

    Examples
    --------
    >>> half_circle = Section(y=[0.0, 0.7071, 1.0], z=[1.0, 0.7071, 0.0])
    >>> half_circle.draught, half_circle.half_breadth
    (1.0, 1.0)
    """

    y: Floats
    z: Floats

    def __init__(self, y: ArrayLike, z: ArrayLike) -> None:
        ys, zs = real(y), real(z)
        if ys is None or zs is None:
            raise InputError(f"y = {quoted(y)}, z = {quoted(z)}; a section is two lists of numbers [m]")
        if ys.ndim != 1 or ys.shape != zs.shape or ys.size < 2:
            raise InputError(
                f"a section needs y and z lists of one length, at least 2 points; given {ys.shape} and {zs.shape}"
            )
        if not (np.isfinite(ys).all() and np.isfinite(zs).all()):
            raise InputError("a section has a point that is not a number; every y and z must be finite metres")
        if (ys < 0).any():
            raise InputError(
                f"half breadth {ys.min():g} m is negative; give the starboard half (y >= 0) from the keel up"
            )
        if zs.max() <= 0:
            raise InputError(
                f"the section lies above the water (deepest z = {zs.max():g} m); z is measured down from the calm plane"
            )
        ys.flags.writeable = zs.flags.writeable = False
        object.__setattr__(self, "y", ys)
        object.__setattr__(self, "z", zs)

    @property
    def draught(self) -> float:
        """Depth of the deepest point below the calm plane [m]."""
        return float(self.z.max())

    @property
    def half_breadth(self) -> float:
        """Half breadth at the calm plane [m] (of the highest point when the contour stops below it)."""
        if self.z.min() > 0:
            return float(self.y[np.argmin(self.z)])
        z, y = self.z[::-1], self.y[::-1]  # from the deck down, so that a flat bottom is entered at its outer edge
        order = np.argsort(z, kind="stable")
        return float(np.interp(0.0, z[order], y[order]))

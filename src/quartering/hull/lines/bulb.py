"""End sections wholly under water, of a bulb ahead of the stem: counted in the volume, left out of strips and panels."""

from __future__ import annotations

from typing import NamedTuple

from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.strips import wholly_under_water


class Bulb(NamedTuple):
    """What strips and panels leave out.

    Parameters
    ----------
    sections : int    wholly under water
    volume : float    of them [m3]
    """

    sections: int
    volume: float

    @property
    def words(self) -> str:
        """What a source of hydrodynamics says of it; nothing where there is none."""
        if not self.sections:
            return ""
        several = "s" if self.sections > 1 else ""
        return f"without {self.sections} section{several} of a bulb wholly under water, of {self.volume:.4g} m3"


def bulb(hull: Hull) -> Bulb:
    """Sections of a bulb ahead of the stem or behind the stern."""
    immersed = strips(hull)
    under = wholly_under_water(immersed)
    return Bulb(int(under.sum()), float(immersed.weight[under] @ immersed.area[under]))

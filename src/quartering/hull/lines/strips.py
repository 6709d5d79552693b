"""The immersed hull as quadrature points: what pressure is integrated over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.section import Floats

TRANSOM_SHARE = 0.05
"""A ship has a transom when its aftmost section carries at least this share of the largest section area."""

NECK = 0.01
"""Half breadth at the waterline, of the largest under it, below which a section is one wholly under water."""


@dataclass(frozen=True, eq=False)
class Strips:
    """Immersed starboard contours of all sections as quadrature points, and weights along the ship.

    Stations run from the aft end to the fore end. On each, ``sum(f * dy)`` is the integral of f dy along the contour
    from the keel to the waterline (and likewise dz), so a kernel sees offsets and exact formulas alike.

    Parameters
    ----------
    x : (s,) float           station position from midship, + forward, ascending [m]
    weight : (s,) float      quadrature weight along the ship: sum(weight * f(x)) is the integral of f dx [m]
    y, z : (s, n) float      quadrature points of the starboard contour; z down from the calm plane, >= 0 [m]
    dy, dz : (s, n) float    contour differentials with their quadrature weights, keel to waterline [m]
    half_breadth : (s,)      at the calm plane [m]
    draught : (s,)           depth of the deepest point [m]
    area : (s,)              immersed area, both sides [m2]
    """

    x: Floats
    weight: Floats
    y: Floats
    z: Floats
    dy: Floats
    dz: Floats
    half_breadth: Floats
    draught: Floats
    area: Floats


def wholly_under_water(immersed: Strips) -> NDArray[np.bool_]:
    """Which sections are of a bulb ahead of the stem, with no more than a neck up to the waterline.

    Returns (s,): their volume counts; the flow round such a section alone is not that of the bulb, so it is left out

    >>> from quartering.hull.lines.immersed import strips
    >>> from quartering.hull.lines.hull import wigley_hull
    >>> bool(wholly_under_water(strips(wigley_hull(100.0, 10.0, 6.0, 9.0))).any())
    False
    """
    return np.asarray(immersed.half_breadth < NECK * immersed.y.max(axis=1))


def has_transom(immersed: Strips) -> bool:
    """Does the hull end aft in a section with area?

    immersed: of the hull, aft to fore
    Returns the aftmost section carries 5 % or more of the largest section area

    Source: [STF70] keeps the aft terms where the aft section is not a point; the 5 % limit is assumed.

    >>> from quartering.hull.lines.immersed import strips
    >>> from quartering.hull.lines.hull import box_hull, wigley_hull
    >>> has_transom(strips(box_hull(100.0, 20.0, 5.0, 10.0))), has_transom(strips(wigley_hull(100.0, 10.0, 6.0, 9.0)))
    (True, False)
    """
    return bool(immersed.area[0] >= TRANSOM_SHARE * immersed.area.max())

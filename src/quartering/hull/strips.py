"""The immersed hull as quadrature points: what pressure is integrated over."""

from __future__ import annotations

from dataclasses import dataclass

from quartering.hull.section import Floats


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

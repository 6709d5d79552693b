"""Station positions relative to the centre of gravity, and the transom."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.strips import has_transom
from quartering.loads.waves import Floats

if TYPE_CHECKING:
    from quartering.hull.ship import Ship


@dataclass(frozen=True, eq=False)
class Stations:
    """Sections along the ship seen from the centre of gravity G.

    Parameters
    ----------
    x : (s,) float         position from G, + forward, ascending [m]
    weight : (s,) float    quadrature weight along the ship: sum(weight * f(x)) is the integral of f dx [m]
    z0 : float             KG - T: calm plane in axes down from G; above zero when G lies above the water plane [m]
    x_aft : float          aft end from G [m]
    transom : bool         the ship ends abruptly at x_aft: the strip theory's terms of the aft section are kept

    Notes
    -----
    The aft terms take the shape and the coefficients of the aftmost station and the wave at x_aft. A ship whose
    sections shrink to nothing has none.

    Examples
    --------
    >>> import numpy as np
    >>> Stations(x=np.array([-1.0, 1.0]), weight=np.ones(2), z0=0.5, x_aft=-1.0, transom=False).z0
    0.5
    """

    x: Floats
    weight: Floats
    z0: float
    x_aft: float
    transom: bool


def stations(ship: Ship) -> Stations:
    """Sections of a ship seen from its centre of gravity.

    Returns x from G, which lies over the centre of buoyancy (even keel)

    The terms of the aft section are kept where the hull ends in a section with area (``has_transom``), as in the
    added mass and damping of the ship, and dropped for a pointed stern.
    Source: [STF70], end terms.
    """
    hull, immersed = ship.hull, strips(ship.hull)
    x_g, z0 = hydrostatics(hull).lcb, ship.loading.kg - hull.draught
    return Stations(immersed.x - x_g, immersed.weight, z0, hull.x_aft - x_g, has_transom(immersed))

"""Where the sections of a ship stand seen from its centre of gravity, and how the ship ends aft."""

from __future__ import annotations

from dataclasses import dataclass

from quartering.loads.waves import Floats


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

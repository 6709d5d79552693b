"""What drives a ship: as it was told, or resistance and a propeller estimated from its lines."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from scipy.optimize import lsq_linear

from quartering.conventions import GRAVITY
from quartering.hull.propulsion import Propulsion, propulsion_of_parts
from quartering.hull.ship import Ship
from quartering.hydro.resistance import hull_form, outside, resistance

_FIT: Final = (0.05, 0.70, 131)
"""Froude numbers over which the polynomial is fitted: up to the celerity of a wave three ship lengths long."""
_JUDGED: Final = (0.2, 0.6)
"""Froude numbers between which its miss is told."""
_PROPELLER: Final = (0.45, -0.28, -0.12)
"""K_T over J of a propeller of pitch ratio near 1 and blade area ratio 0.55, from memory of the Wageningen series."""
_SHARE_OF_DRAUGHT: Final = 0.7
"""Diameter of a single propeller."""


class Drive(NamedTuple):
    """What drives a ship, and where it comes from.

    Parameters
    ----------
    propulsion : Propulsion
    source : str        "given: ..", or "estimated: .."
    """

    propulsion: Propulsion
    source: str

    @property
    def estimated(self) -> bool:
        """Was nothing given?"""
        return self.source.startswith("estimated")


def drive_of(ship: Ship, given: Propulsion | None = None, estimate: bool = False) -> Drive | None:
    """What drives a ship: what is given here, else what the ship was told, else an estimate if it is wanted.

    given: in place of the ship's own
    estimate: estimate what neither knows

    >>> from quartering.hull.file.read import ship
    >>> drive_of(ship("wigley")) is None, drive_of(ship("wigley").with_(propulsion="estimated")).estimated
    (True, True)
    """
    if given is not None:
        return Drive(given, "given: resistance and thrust")
    told = ship.value("propulsion")
    if told is not None and not isinstance(told, str):
        return Drive(propulsion_of_parts(told), ship.provenance.get("propulsion", "given"))
    return estimated_drive(ship) if estimate or told is not None else None


@lru_cache(maxsize=64)
def estimated_drive(ship: Ship) -> Drive:
    """Resistance and a propeller of a ship of which neither is known; its source says how, and what to doubt.

    The resistance is fitted by a polynomial of degree 5 over Froude numbers up to 0.7.  One propeller of 0.7 of the draught,
    K_T = 0.45 - 0.28 J - 0.12 J^2, w = 0.5 C_B - 0.05, t = 0.6 w: thresholds of surf-riding in speed hardly depend on it.
    Source: [Holtrop82], [Holtrop84]; Taylor's wake fraction (all recalled).

    >>> from quartering.hull.file.read import ship
    >>> estimated_drive(ship("series60-cb60")).source.partition(",")[0]
    'estimated: resistance by Holtrop and Mennen'
    """
    unit = math.sqrt(GRAVITY * ship.hull.length)
    froude = np.linspace(*_FIT)
    drag = resistance(ship, froude * unit)
    powers = froude[:, None] ** np.arange(1, 6)
    scale = 1 / (drag + 0.02 * drag.max())
    least = np.array([0.0, *[-np.inf] * 4])  # no push at low speeds
    fitted = lsq_linear(powers * scale[:, None], drag * scale, (least, np.inf)).x
    judged = (froude >= _JUDGED[0]) & (froude <= _JUDGED[1])
    worst = float(np.abs(powers @ fitted / drag - 1)[judged].max())
    terms = (0.0, *(float(r) / unit ** (i + 1) for i, r in enumerate(fitted)))
    form = hull_form(ship)
    wake = max(0.5 * form.cb - 0.05, 0.0)
    made = Propulsion(terms, _SHARE_OF_DRAUGHT * form.draught, 0.6 * wake, wake, _PROPELLER)
    beyond = "".join(f"; extrapolated: {one}" for one in outside(form))
    return Drive(
        made,
        f"estimated: resistance by Holtrop and Mennen, fitted within {100 * worst:.2g} % from Fn {_JUDGED[0]:g} to "
        f"{_JUDGED[1]:g}, bare hull without a bulb; propeller of {made.diameter:.3g} m{beyond}",
    )

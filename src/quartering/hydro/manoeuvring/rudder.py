"""Rudder derivatives: side force and moments per angle, measured or estimated from its area."""

from __future__ import annotations

from typing import Literal

import numpy as np

from quartering.hull.autopilot import ASPECT, Rudder
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.manoeuvring.lift import to_si
from quartering.hydro.manoeuvring.measured import measured_set
from quartering.names import RUDDER_NAMES

_STERN = -0.5
"""Where the rudder stands when nothing else is known, lengths forward of midship (assumed: at the aft perpendicular)."""


def usual_rudder(ship: Ship) -> Rudder:
    """The least rudder a classification society asks for, when a ship file gives none.

    Returns area L T/100 (1 + 25 (B/L)^2), aspect ratio 1.8 (assumed)

    Source: [Lewis89] ch. IX, Det Norske Veritas' rule for a rudder behind a propeller.

    >>> from quartering.hull.file.read import ship
    >>> round(usual_rudder(ship("series60-cb60")).area, 2)
    11.45
    """
    hull = ship.hull
    area = hull.length * hull.draught / 100.0 * (1.0 + 25.0 * (hull.beam / hull.length) ** 2)
    return Rudder(area, ASPECT)


def rudder_derivatives(ship: Ship, speed: Floats) -> tuple[Floats, Literal["measured", "regression"], str]:
    """Force and moments per rudder angle, about G; a positive angle turns the bow to starboard.

    speed (n,): U >= 0 [m/s]
    Returns derivatives (n, 3): Y_delta [N], K_delta, N_delta [N m], per radian; kind, source: for the table of
        coefficients: "measured" or "regression"

    Estimate: Y_delta = -1/2 rho A U^2 6.13 Lambda/(Lambda + 2.25), at the aft perpendicular and half the draught (assumed);
    the water at the rudder flows at the ship's speed (assumed: wake and slipstream about cancel).
    Measured: the set's own, a set that counts port rudder positive turned round, and without roll at half the draught.
    Source: [Yasukawa15] rudder lift of the MMG model (Fujii's formula); the paper of the set.
    Valid: small rudder angles, no stall, a rudder behind one propeller; no force at zero speed.
    """
    hull, loading = ship.hull, ship.loading
    x_g, lever = hydrostatics(ship).lcb, loading.kg - hull.draught / 2
    known = measured_set(ship.measured) if ship.measured and ship.linear == "default" else None
    if ship.rudder is None and known is not None and known.rudder:
        turned = 1.0 if known.rudder["N"] > 0 else -1.0
        prime = {name: turned * known.rudder.get(name[0], 0.0) for name in RUDDER_NAMES}
        y, k, n = (to_si(name, value, hull.length, 1.0, loading.density) for name, value in prime.items())
        n -= x_g * y
        in_roll = "" if "K" in known.rudder else ", in roll at half the draught (assumed)"
        if in_roll:
            k = -lever * y
        else:
            height = (
                hull.draught / 2 if known.height is None else known.height * hull.length / known.condition["length"]
            )
            k -= (loading.kg - height) * y
        source = f"[{known.reference}] {known.name}{in_roll}"
        return np.outer(speed**2, [y, k, n]), "measured", source
    blade = ship.rudder or usual_rudder(ship)
    slope = 6.13 * blade.aspect / (blade.aspect + 2.25)
    y = -0.5 * loading.density * blade.area * slope
    whose = ship.provenance.get("rudder", "given" if ship.rudder else "least by rule")
    source = f"estimated: rudder lift by Fujii's formula, area {blade.area:.3g} m2 ({whose}), aspect ratio {blade.aspect:.3g}"
    return np.outer(speed**2, [y, -lever * y, (_STERN * hull.length - x_g) * y]), "regression", source

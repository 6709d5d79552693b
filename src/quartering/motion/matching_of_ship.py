"""The cubic drag of a ship whose reference velocity follows its motion: which terms are it, and the law they stand for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.hull.ship import Ship
from quartering.hydro.coefficient_table import Coefficients
from quartering.hydro.manoeuvring.crossflow import reference_velocity
from quartering.loads.lift import ship_water_velocity
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.equations.system import acceleration_form
from quartering.motion.equations.terms import term_table
from quartering.motion.matched import Matching
from quartering.names import CUBIC_NAMES

Floats = NDArray[np.float64]


def ship_matching(ship: Ship, c: Coefficients, frequency: Floats, *waves: Floats) -> Matching | None:
    """What matches the cubic drag at the motion; None where the drag is no cubic, is given, or acts at a velocity told."""
    if ship.velocities == "absolute" or ship.velocity_scale is not None:
        return None
    own = {name: float(c.terms[name].value[0]) for row in CUBIC_NAMES for name in row if name in c.terms}
    own = {name: value for name, value in own.items() if value and c.terms[name].kind == "cross-flow"}
    if not own:
        return None
    still = (0.0, 0.0, 0.0)
    water = ship_water_velocity(ship, *waves)
    return Matching(
        cubics=acceleration_form(c.inertia, term_table(own), frequency, still, water=water),
        strips=acceleration_form(c.inertia, term_table({}), frequency, still, strips=drag_strips(ship, *waves)),
        scale=reference_velocity(ship.hull.length),
        terms=own,
    )

"""Cross-flow drag of a ship in the water it moves in: its strips, and what of the equations feels the water."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips
from quartering.hull.ship import Ship
from quartering.hydro.coefficient_table import Coefficients
from quartering.loads.forces import Form
from quartering.loads.lift import ship_water_velocity
from quartering.loads.waves import encounter_frequency, folded, heading_components
from quartering.motion.equations.few_strips import POINTS, gauss_of_stations
from quartering.motion.equations.water import Strips
from quartering.names import DRAG_NAME

Floats = NDArray[np.float64]


def drag_strips(
    ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, *, points: int | None = POINTS
) -> Strips:
    """Cross-flow drag of a ship at many conditions, per metre of wave amplitude.

    wavenumber, speed, heading (m,): k > 0 [1/m], U [m/s], mu [deg]
    points: strips that stand for all, see `gauss_of_stations`; None for a strip at every station
    Returns the drag acts, and the water's velocity is taken, at half the draught of each section

    w = i sigma sin(delta) e^(-k T/2) e^(i k1 x) as in `water_velocity`, at the strip and not fitted.  Source: [Hoerner65] for
    the drag; wave kinematics, closed form.
    """
    k, U, mu = (np.asarray(values, dtype=float)[:, None] for values in (wavenumber, speed, heading))
    loading = ship.loading
    x, area, draught = _of_hull(ship.hull, points)
    x = x - hydrostatics(ship).lcb
    along, across = heading_components(mu)
    sigma = np.sqrt(GRAVITY * k)
    water = 1j * sigma * across * np.exp(-k * draught / 2 + 1j * k * along * x)
    omega = encounter_frequency(sigma, U, mu)[:, 0]
    return Strips(
        x=x,
        lever=loading.kg - ship.hull.draught + draught / 2,
        c=0.5 * loading.density * ship.drag_coefficient * area,
        water=folded(omega, water)[1],
    )


@lru_cache(maxsize=64)
def _of_hull(hull: Hull, points: int | None) -> tuple[Floats, Floats, Floats]:
    """Where the strips stand, their area and draught: they belong to the hull alone."""
    sections = strips(hull)
    x, area, draught = sections.x, sections.draught * sections.weight, sections.draught
    return (x, area, draught) if points is None else gauss_of_stations(x, area, draught, points)


def moving_water(
    ship: Ship, c: Coefficients, wavenumber: Floats, speed: Floats, heading: Floats, form: Form
) -> dict[str, Any]:
    """What of the equations feels the water move, per metre of wave amplitude: cubics, and drag by strips."""
    still = ship.velocities == "absolute" or form == "paper"
    moving: dict[str, Any] = {} if still else {"water": ship_water_velocity(ship, wavenumber, speed, heading)}
    if DRAG_NAME in c.terms:
        found = drag_strips(ship, wavenumber, speed, heading)
        moving["strips"] = Strips(found.x, found.lever, found.c, 0.0 * found.water) if still else found
    return moving


def at_height(moving: dict[str, Any], amplitude: float) -> dict[str, Any]:
    """The moving water of one condition, at the height of its wave."""
    made: dict[str, Any] = {}
    if "water" in moving:
        w0, w1 = moving["water"]
        made["water"] = (amplitude * complex(w0[0]), amplitude * complex(w1[0]))
    if "strips" in moving:
        at = moving["strips"]
        made["strips"] = Strips(at.x, at.lever, at.c, amplitude * at.water)
    return made

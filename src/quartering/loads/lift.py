"""Lift and measured added mass in moving water: what they add to the wave force on a ship."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from quartering._machine.rowwise import contracted
from quartering.hull.hydrostatics import hydrostatics
from quartering.hydro.coefficient_table import Coefficients
from quartering.loads.water import surface_slope, water_velocity
from quartering.loads.waves import Floats, Phasors

if TYPE_CHECKING:
    from quartering.hull.ship import Ship


def ship_water_velocity(
    ship: Ship, wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike
) -> tuple[Phasors, Phasors]:
    """Velocity of the water across a ship and its rate of turn at half the draught, where the lift acts.

    as in `water_velocity`
    Returns w0, w1 (n,): as in `water_velocity`
    """
    return water_velocity(wavenumber, speed, heading, **_where(ship))


def _where(ship: Ship) -> dict[str, float]:
    """Length, its middle forward of G, and half the draught: where the water is taken."""
    hull = ship.hull
    return {"length": hull.length, "middle": -hydrostatics(ship).lcb, "depth": hull.draught / 2}


def moving_water_force(
    lift: Floats, added_mass: Floats, frequency: ArrayLike, water: tuple[Phasors, Phasors]
) -> Phasors:
    """Force of moving water on a ship through lift and added mass, beside what its diffraction holds.

    lift (n, 3, 3): velocity derivatives that act on the velocity relative to the water; columns v and r count
    added_mass (n, 3, 3): added mass that does, likewise
    frequency (n,): |omega| [rad/s]
    water: w0, w1 of `water_velocity`, for e^{i |omega| t}
    Returns (n, 3): sway [N/m], roll and yaw about G [N m/m]: phasors of e^{i |omega| t}

    Lift acts on v - w0 and r - w1, and so does the added mass that a measured set or a given value has beyond that of the
    strips. The water's part goes to the side of the wave force:

        F = -(L[:, v] w0 + L[:, r] w1) + i omega (dA[:, v] w0 + dA[:, r] w1)

    The roll rate stays the ship's own: the wave's flow has no rotation, and round the hull's circle its velocity has opposite
    signs at side and bottom.
    Source: momentum of a slender body in a stream that varies along it, closed form.  Valid: deep water, long waves against
    the section.
    """
    w = np.stack([water[0], water[1]], axis=-1)
    rate = 1j * np.abs(np.asarray(frequency, dtype=float))[:, None]
    by_lift, by_mass = (contracted(matrix[:, :, ::2], w[:, None]) for matrix in (lift, added_mass))
    return np.asarray(rate * by_mass - by_lift)


def ship_lift_phasors(
    ship: Ship,
    coefficients: Coefficients,
    wavenumber: ArrayLike,
    speed: ArrayLike,
    heading: ArrayLike,
) -> Phasors:
    """Force of moving water on a ship with its coefficients at the same conditions; nothing with absolute velocities.

    coefficients: of the ship at the n conditions
    wavenumber, speed, heading (n,): as in `water_velocity`
    Returns (n, 3): as `moving_water_force`, per metre of wave amplitude

    Measured forces by heel, c phi, are those of a heel relative to the surface: a ship that rides on a long slope has none.
    They add -c alpha, alpha the slope, as the Froude-Krylov force holds that of the hydrostatic moment.
    """
    if ship.velocities == "absolute":
        return np.zeros((coefficients.frequency.size, 3), dtype=complex)
    c, place = coefficients, _where(ship)
    water = water_velocity(wavenumber, speed, heading, **place)
    force = moving_water_force(c.relative, c.relative_mass, c.frequency, water)
    if c.relative_heel.any():
        force -= c.relative_heel * surface_slope(wavenumber, speed, heading, **place)[:, None]
    return force

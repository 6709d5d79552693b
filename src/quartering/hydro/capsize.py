"""Capsize limit of a ship, with its given coefficients."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.righting.arm import righting_polynomial, righting_spline, vanishing_angle
from quartering.hull.righting.limit import CapsizeLimit, first_vanishing, least_limit
from quartering.hull.ship import Ship
from quartering.hydro.overrides import given_names, with_given_alone
from quartering.names import RESTORING_NAMES, RESTORING_POWERS


@lru_cache(maxsize=64)
def capsize_limit(ship: Ship) -> CapsizeLimit:
    """Roll angle that counts as a capsize, in every study and history of a ship.

    Returns the least of the vanishing angle, the ship's `openings` and 90 deg

    Where righting coefficients are given, or multiplied, the moment of the equations counts if it vanishes sooner.
    Source: `vanishing_angle`.
    """
    return least_limit(vanishing_of_equations(ship), ship.value("openings"))


def vanishing_of_equations(ship: Ship) -> float:
    """Vanishing angle of a ship [deg], its given righting coefficients among what decides."""
    vanishing = vanishing_angle(ship)
    if given_names(ship).isdisjoint(RESTORING_NAMES[1]):
        return vanishing
    return min(vanishing, first_vanishing(lambda phi: _given_arm(ship, phi)))


def _given_arm(ship: Ship, phi: Floats) -> Floats:
    """Righting moment over weight [m] with the ship's own coefficients, at heel angles [rad]."""
    weight = hydrostatics(ship).mass * GRAVITY
    if ship.righting == "spline":
        spline = righting_spline(ship)
        rest, arms = spline.value(phi) - spline.slope * phi, (spline.slope, 0.0, 0.0, 0.0)
    else:
        fit = righting_polynomial(ship)
        rest, arms = np.zeros(phi.shape), (fit.gm, fit.gz3, fit.gz5, fit.gz7)
    for name, power, arm in zip(RESTORING_NAMES[1], RESTORING_POWERS, arms, strict=True):
        moment = with_given_alone(ship, name, np.array([-weight * arm]))[0]
        rest = rest - moment / weight * phi**power
    return rest

"""Terms of a measured manoeuvring set that replace estimates in a ship's equations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.manoeuvring.measured import LEAST_FROUDE_NUMBER, MeasuredSet, measured_set, scaled_terms
from quartering.hydro.transfer import transfer
from quartering.names import INERTIA_NAMES, LINEAR_NAMES, term

_IN_PLANE = ("Y_vdot", "Y_rdot", "N_vdot", "N_rdot")


class MeasuredParts(NamedTuple):
    """A measured set at the conditions of a ship, about its G, SI.

    Parameters
    ----------
    linear : (n, 3, 3) float       velocity derivatives, no rigid-body term; they replace the estimated lift
    roll_damping : (n,) float      the part of K_p that the set measured in rolling, <= 0; 0 when it measured none
    added : (3, 3) float           Y_vdot, .. at omega -> 0, symmetric part; nan where the set measured none
    lever : float                  depth of the force below G for a set without roll [m]; nan for one with roll
    further : mapping              every other term by name -> (n,)
    drag : bool                    the set has nonlinear velocity terms, which replace the cross-flow estimate
    source : str                   for the table
    reference : str                key of the paper
    """

    linear: Floats
    roll_damping: Floats
    added: Floats
    lever: float
    further: Mapping[str, Floats]
    drag: bool
    source: str
    reference: str

    def by(self, name: str) -> str:
        """Where a coefficient of the set comes from, in words."""
        in_roll = "" if np.isnan(self.lever) else ", at half the draught (assumed)"
        return self.source + (in_roll if name.startswith("K") or "p" in name.replace("phi", "") else "")


def measured_parts(ship: Ship, speed: Floats) -> MeasuredParts:
    """The measured set of a ship at given speeds.

    ship: with a measured set
    speed (n,): U >= 0 [m/s]

    Prime values hold at every speed; terms that divide by U keep below Fn 0.1 the value they have there. A set without
    roll acts at half the draught (assumed), so that its force has a moment in roll and feels the roll rate.
    Added mass: the couplings Y_rdot and N_vdot measured apart are replaced by their mean, as energy asks.
    Source: [Abkowitz64] prime system and kinematics; the paper of the set.  Valid: a ship like the one tested.
    """
    measured = measured_set(ship.measured or "")
    centre = _gravity_centre(ship, measured)
    terms = scaled_terms(measured, ship.hull.length, ship.loading.density, x_g=centre[0], z_g=centre[1])
    floor = LEAST_FROUDE_NUMBER * np.sqrt(GRAVITY * ship.hull.length)
    values: dict[str, Floats] = {}
    for (name, power), value in terms.items():
        at_speed = value * (speed**power if power >= 0 else np.maximum(speed, floor) ** power)
        values[name] = values.get(name, np.zeros(speed.shape)) + at_speed
    own = {name for name, value, _ in measured.terms if value}
    roll = any("p" in term(name).factors or term(name).row == "K" for name in own)
    names = INERTIA_NAMES if roll else tuple(tuple(n if n in _IN_PLANE else "" for n in row) for row in INERTIA_NAMES)
    added = np.array([[values[n][0] if n in values else np.nan for n in row] for row in names])
    standard = {name for names in (LINEAR_NAMES, INERTIA_NAMES) for row in names for name in row}
    further = {name: value for name, value in values.items() if name not in standard}
    return MeasuredParts(
        linear=np.stack([[values.get(n, np.zeros(speed.shape)) for n in row] for row in LINEAR_NAMES]).transpose(
            2, 0, 1
        ),
        roll_damping=_roll_damping(ship, measured, speed) if "K_p" in own else np.zeros(speed.shape),
        added=(added + added.T) / 2,
        lever=np.nan if roll else -centre[1],
        further=further,
        drag=any(_velocities(name) > 1 for name in further),
        source=f"[{measured.reference}] {measured.name}",
        reference=measured.reference,
    )


def added_mass_shift(parts: MeasuredParts, slow: Floats) -> Floats:
    """What measured added mass adds to that of the strips, at every frequency.

    slow (3, 3): Y_vdot, .. of the strips at omega -> 0
    Returns (3, 3): measured less strips where the set gives a value; without roll in the set the difference acts at the
        depth of its force, so that roll takes part

    Source: [Abkowitz64] kinematics.

    >>> from quartering.hull.file.read import ship
    >>> parts = measured_parts(ship("mariner"), np.array([7.0]))
    >>> shift = added_mass_shift(parts, np.diag([-1.6e7, -1e9, -2e10]))
    >>> bool(np.isclose(shift[0, 1], -parts.lever * shift[0, 0]))
    True
    """
    shift = np.where(np.isnan(parts.added), 0.0, parts.added - slow)
    return shift if np.isnan(parts.lever) else transfer(shift, 0.0, parts.lever)


def _gravity_centre(ship: Ship, measured: MeasuredSet) -> tuple[float, float]:
    """G of the ship from the point the set is about, forward and down [m]."""
    hull, kg = ship.hull, ship.loading.kg
    ratio = hull.length / measured.condition["length"]
    height = hull.draught / 2 if measured.height is None else measured.height * ratio
    x_g = hydrostatics(ship).lcb if measured.midship else measured.x_g * ratio
    return x_g, height - kg


def _roll_damping(ship: Ship, measured: MeasuredSet, speed: Floats) -> Floats:
    """K_p as measured, without what the lateral force adds to it when moved to the ship's G."""
    at_point = scaled_terms(measured, ship.hull.length, ship.loading.density, x_g=0.0, z_g=0.0)
    damping = np.zeros(speed.shape)
    for (name, power), value in at_point.items():
        if name == "K_p":
            damping = damping + value * speed**power
    return damping


def _velocities(name: str) -> int:
    """Number of velocities in a term; one that holds an angle is no drag."""
    factors = term(name).factors
    return 0 if "phi" in factors else sum(factor in ("v", "p", "r") for factor in factors)

"""The table of a ship's coefficients: what stands in it, and each entry's unit, source and kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from quartering.hull.lines.section import Floats
from quartering.hull.righting.spline import OddSpline
from quartering.hydro.terms import ESTIMATES, Kind, Term
from quartering.names import CUBIC_NAMES, DRAG_NAME, INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES, RUDDER_NAMES, unit

BODY_NAMES = ("m", "I_x", "I_z", "I_xz")
"""Rigid-body entries of the table."""


STANDARD: tuple[str, ...] = (
    *BODY_NAMES,
    *(name for names in (INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES, CUBIC_NAMES) for row in names for name in row),
    DRAG_NAME,
)
"""The order of the table, without further terms and the rudder's."""
_BY_FREQUENCY = {*BODY_NAMES, *(name for names in (INERTIA_NAMES, LINEAR_NAMES) for row in names for name in row)}


class Entry(NamedTuple):
    """One line of the table of coefficients: name, value and unit, where it comes from, and which kind of source that is."""

    name: str
    value: float
    unit: str
    source: str
    kind: Kind

    @property
    def estimated(self) -> bool:
        """Is the kind of source an estimate?"""
        return self.kind in ESTIMATES


@dataclass(frozen=True, eq=False)
class Coefficients:
    """Coefficients of a ship at n conditions, about G in body axes, modes sway, roll, yaw; SI.

    Left side ``inertia d/dt (v, p, r)``; everything else stands on the right with its own sign.

    Parameters
    ----------
    ship : str                       name of the ship
    frequency : (n,) float           encounter frequency, folded to >= 0 [rad/s]
    speed : (n,) float               U [m/s]
    terms : mapping of str to Term   every coefficient by name: "m" .. "I_xz"; Y_vdot .. N_rdot; Y_v .. N_r (hydrodynamic, Y_r
                                     without its -m U); restoring; cubic, or C_D of drag by strips; further terms;
                                     rudder, beside an autopilot
    roll_frequency : float           n2 of small free roll as loaded, before overrides and multipliers [rad/s]
    references : tuple of str        keys of the papers behind the numbers
    righting : OddSpline or None     moment K over phi beyond K_phi phi of a ship whose righting curve is a spline [N m]
    relative : (n, 3, 3) float       of `linear`, what acts on moving water beside the diffraction: lift. Columns v, r count
    relative_mass : (n, 3, 3) float  the same of the added mass: measured or given less that of the potential flow
    relative_heel : (n, 3) float     of Y_phi, K_phi, N_phi, what a measured set or a value has beyond hydrostatics
    """

    ship: str
    frequency: Floats
    speed: Floats
    terms: Mapping[str, Term]
    roll_frequency: float
    references: tuple[str, ...]
    righting: OddSpline | None
    relative: Floats
    relative_mass: Floats
    relative_heel: Floats

    @property
    def body(self) -> dict[str, float]:
        """Rigid-body values "m" [kg], "I_x", "I_z", "I_xz" [kg m2]."""
        return {name: float(self.terms[name].value[0]) for name in BODY_NAMES}

    @cached_property
    def inertia(self) -> Floats:
        """Rigid body and added mass (n, 3, 3)."""
        return rigid_inertia(self.body) - matrix(self.terms, INERTIA_NAMES)

    @cached_property
    def linear(self) -> Floats:
        """Velocity derivatives (n, 3, 3): rows Y, K, N, columns v, p, r; Y_r contains -m U."""
        linear = matrix(self.terms, LINEAR_NAMES)
        linear[:, 0, 2] -= self.body["m"] * self.speed
        return linear

    @property
    def rudder(self) -> Floats | None:
        """Y_delta, K_delta, N_delta (n, 3) of a ship with an autopilot; None without one."""
        return matrix(self.terms, (RUDDER_NAMES,))[:, 0] if RUDDER_NAMES[0] in self.terms else None

    @cached_property
    def nonlinear(self) -> dict[str, Floats]:
        """Terms on the right beside inertia and `linear`, (n,) each: restoring, cubic and further ones that are not zero."""
        others = (name for name in self.terms if name not in (*_BY_FREQUENCY, *RUDDER_NAMES, DRAG_NAME))
        return {name: self.terms[name].value for name in others if self.terms[name].value.any()}

    def table(self, condition: int = 0) -> tuple[Entry, ...]:
        """Every coefficient of one condition with unit, source and kind, in a fixed order.

        condition: which of the n conditions
        Returns rigid body; Y_vdot .. N_rdot; Y_v .. N_r (hydrodynamic, Y_r without its -m U); restoring; cubic; further
            terms; rudder, beside an autopilot. What is estimated says so in its source

        Source: [H71] equation (2) for the terms; each entry names its own.
        """
        return tuple(
            Entry(name, float(term.value[condition]), unit(name), term.source, term.kind)
            for name, term in self.terms.items()
        )


def matrix(terms: Mapping[str, Term], names: Sequence[Sequence[str]]) -> Floats:
    """Values (n, rows, columns) by the names of rows and columns."""
    return np.stack([np.stack([terms[name].value for name in row], axis=-1) for row in names], axis=-2)


def in_order(terms: Mapping[str, Term]) -> dict[str, Term]:
    """Terms in the order of the table: the standard ones, further ones, the rudder's."""
    further = [name for name in terms if name not in STANDARD and name not in RUDDER_NAMES]
    return {name: terms[name] for name in (*STANDARD, *further, *RUDDER_NAMES) if name in terms}


def rigid_inertia(body: Mapping[str, float]) -> Floats:
    """Inertia matrix of the ship without water.

    body: "m" [kg], "I_x", "I_z", "I_xz" [kg m2]
    Returns (3, 3): sway, roll, yaw about G

    Source: [H71] equation (1).
    """
    cross = -body["I_xz"]
    return np.array([[body["m"], 0.0, 0.0], [0.0, body["I_x"], cross], [0.0, cross, body["I_z"]]])

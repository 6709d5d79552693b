"""The table of a ship's coefficients: what stands in it, and each entry's unit, source and kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from quartering.hull.section import Floats
from quartering.hull.spline import OddSpline
from quartering.hydro.coefficient_sources import Kind
from quartering.names import CUBIC_NAMES, INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES, RUDDER_NAMES, unit

BODY_NAMES = ("m", "I_x", "I_z", "I_xz")
"""Rigid-body entries of the table."""


class Entry(NamedTuple):
    """One line of the table of coefficients: name, value and unit, where it comes from, and which kind of source that is."""

    name: str
    value: float
    unit: str
    source: str
    kind: Kind


@dataclass(frozen=True, eq=False)
class Coefficients:
    """Coefficients of a ship at n conditions, about G in body axes, modes sway, roll, yaw; SI.

    Left side ``inertia d/dt (v, p, r)``; everything else stands on the right with its own sign.

    Parameters
    ----------
    ship : str                       name of the ship
    frequency : (n,) float           encounter frequency, folded to >= 0 [rad/s]
    speed : (n,) float               U [m/s]
    inertia : (n, 3, 3) float        rigid body and added mass
    linear : (n, 3, 3) float         rows Y, K, N, columns v, p, r; Y_r contains -m U
    restoring : (3, 4) float         columns phi, phi^3, phi^5, phi^7
    cubic : (3, 10) float            columns in the order of CUBIC_MONOMIALS
    extra : mapping of str to float  further terms by name (modulus terms, products with phi), alike at every condition
    body : mapping of str to float   "m" [kg], "I_x", "I_z", "I_xz" [kg m2]
    roll_frequency : float           n2 of small free roll as loaded, before overrides and multipliers [rad/s]
    sources : mapping                name -> (kind, source)
    references : tuple of str        keys of the papers behind the numbers
    varying : mapping of str to (n,) measured terms that vary with the speed; they add to restoring, cubic and extra
    righting : OddSpline or None     moment K over phi beyond K_phi phi of a ship whose righting curve is a spline [N m]
    rudder : (n, 3) float            Y_delta, K_delta, N_delta of a ship with an autopilot; None without one
    relative : (n, 3, 3) float       of `linear`, what acts on moving water beside the diffraction: lift. Columns v, r count
    relative_mass : (n, 3, 3) float  the same of the added mass: measured or given less that of the potential flow
    relative_heel : (n, 3) float     of Y_phi, K_phi, N_phi, what a measured set or a value has beyond hydrostatics
    """

    ship: str
    frequency: Floats
    speed: Floats
    inertia: Floats
    linear: Floats
    restoring: Floats
    cubic: Floats
    extra: Mapping[str, float]
    body: Mapping[str, float]
    roll_frequency: float
    sources: Mapping[str, tuple[Kind, str]]
    references: tuple[str, ...]
    varying: Mapping[str, Floats] = field(default_factory=dict)
    rudder: Floats | None = None
    righting: OddSpline | None = None
    relative: Floats = field(kw_only=True)
    relative_mass: Floats = field(kw_only=True)
    relative_heel: Floats = field(kw_only=True)

    def table(self, condition: int = 0) -> tuple[Entry, ...]:
        """Every coefficient of one condition with unit, source and kind, in a fixed order.

        Parameters
        ----------
        condition : int    which of the n conditions

        Returns
        -------
        tuple of Entry    rigid body; Y_vdot .. N_rdot; Y_v .. N_r (hydrodynamic, Y_r without its -m U); restoring;
                          cubic; further terms; rudder, beside an autopilot. What is estimated says so in its source.

        Notes
        -----
        Source: [H71] equation (2) for the terms; each entry names its own.
        """
        added, linear = rigid_inertia(self.body) - self.inertia[condition], self.linear[condition].copy()
        linear[0, 2] += self.body["m"] * self.speed[condition]
        values = dict(self.body)
        for names, matrix in (
            (INERTIA_NAMES, added),
            (LINEAR_NAMES, linear),
            (RESTORING_NAMES, self.restoring),
            (CUBIC_NAMES, self.cubic),
        ):
            values |= {name: float(matrix[i, j]) for i, row in enumerate(names) for j, name in enumerate(row)}
        values |= self.extra
        values |= {name: values.get(name, 0.0) + float(value[condition]) for name, value in self.varying.items()}
        if self.rudder is not None:
            values |= dict(zip(RUDDER_NAMES, self.rudder[condition].tolist(), strict=True))
        return tuple(
            Entry(name, value, unit(name), self.sources[name][1], self.sources[name][0])
            for name, value in values.items()
        )


def rigid_inertia(body: Mapping[str, float]) -> Floats:
    """Inertia matrix of the ship without water.

    Parameters
    ----------
    body : mapping    "m" [kg], "I_x", "I_z", "I_xz" [kg m2]

    Returns
    -------
    (3, 3) float    sway, roll, yaw about G

    Notes
    -----
    Source: [H71] equation (1).

    Examples
    --------
    >>> rigid_inertia({"m": 2.0, "I_x": 3.0, "I_z": 5.0, "I_xz": 0.5}).tolist()
    [[2.0, 0.0, 0.0], [0.0, 3.0, -0.5], [0.0, -0.5, 5.0]]
    """
    cross = -body["I_xz"]
    return np.array([[body["m"], 0.0, 0.0], [0.0, body["I_x"], cross], [0.0, cross, body["I_z"]]])

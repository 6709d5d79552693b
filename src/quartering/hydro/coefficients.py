"""The coefficients of the equations of motion of a ship, at many conditions at once, each with its source."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.lines.section import Floats
from quartering.hull.righting.spline import OddSpline
from quartering.hull.ship import Ship
from quartering.hull.told import numbers
from quartering.hydro.coefficient_table import Coefficients, in_order, matrix
from quartering.hydro.contributions import (
    Conditions,
    Source,
    added_roll_damping,
    cross_flow,
    measured_set_terms,
    potential_flow,
    regression_lift,
    restoring,
    righting_moment,
    rigid_body,
    rudder,
)
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.manoeuvring.measured_ship import measured_parts
from quartering.hydro.overrides import given_names, with_given, with_given_alone
from quartering.hydro.source.of_ship import source_of
from quartering.hydro.terms import Term, added
from quartering.names import CUBIC_NAMES, DRAG_NAME, INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES

SOURCES: Final[tuple[Source, ...]] = (
    rigid_body,
    regression_lift,
    measured_set_terms,
    added_roll_damping,
    potential_flow,
    restoring,
    cross_flow,
    rudder,
)
"""Sources of coefficients, added up by name."""


@takes(ship="Ship")
def coefficients(ship: Ship, frequency: ArrayLike, speed: ArrayLike) -> Coefficients:
    """Inertia, linear, restoring and cubic coefficients of a ship at n conditions, about G.

    Parameters
    ----------
    ship : Ship
    frequency : (n,) float    encounter frequency omega; a negative one counts as |omega| [rad/s]
    speed : (n,) float        U >= 0 [m/s]; the two are broadcast

    Returns
    -------
    Coefficients

    Raises
    ------
    InputError    a frequency or speed that is not a number, a negative speed, a multiplier of what has no value; a
                  frequency the ship's own database does not hold

    Notes
    -----
    linear "default": added mass and wave damping from the strips at omega; the lift part of the velocity derivatives
    from Clarke's regression times U, in place of every speed term of strip theory (the Munk moment among them).
    linear "strip": strip theory with its speed terms, U/omega^2 held below 0.15 sqrt(g/B), aft terms for a transom.
    Both: K_p has the added roll damping -2 zeta n2 (I_x + a44(n2)); Y_r has -m U. The ship's own coefficients
    (overrides, SI about G, Y_r without -m U) replace, multipliers scale.
    A ship with its own database has added mass and wave damping from there, at zero speed; "strip" adds the same speed
    terms without those of the aft end.
    A measured set, with linear "default", takes the place of the regression and of the cross-flow; of its added mass the
    value at omega -> 0 counts, where it was measured, and the change with frequency stays that of the strips; of its
    roll damping and the ship's added roll damping (at 10 deg) the larger is used; they describe the same dissipation.
    By a component method ("ikeda", "ikeda-simplified") the added roll damping is that of `added_damping` at each speed, a
    part of K_p and K_p|p|; its lift takes the place of the regression's in K_p.
    Source: [STF70] strips, [Clarke83] lift, [Hoerner65] cross-flow, [H71] equation (2).
    Valid: deep water; a rudder only beside an autopilot.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> c = coefficients(ship("wigley"), [0.4, 0.8], 5.0)
    >>> c.inertia.shape, bool((c.linear[:, 0, 0] < 0).all())
    ((2, 3, 3), True)
    """
    speed = numbers(ship, "speed", speed)
    omega, u = (
        np.array(q)
        for q in np.broadcast_arrays(*(np.atleast_1d(q) for q in (numbers(ship, "signed_frequency", frequency), speed)))
    )
    omega = np.abs(omega)
    source, roll = source_of(ship), free_roll(ship)
    source.check(np.append(omega, roll.frequency))
    at = Conditions(ship, omega, u, source, roll, None if ship.measured is None else measured_parts(ship, u))
    parts = [one(at) for one in SOURCES]
    found = added(parts)
    _check_cubics(ship, found)
    terms = in_order(with_given(ship, found, omega.size))
    linear, mass = at.potential
    papers = (key for part in parts for term in part.values() for key in term.references)
    return Coefficients(
        ship=ship.name,
        frequency=omega,
        speed=u,
        terms=MappingProxyType(terms),
        roll_frequency=roll.frequency,
        references=tuple(dict.fromkeys(("H71", *papers))),
        righting=_righting(ship),
        relative=matrix(terms, LINEAR_NAMES) - linear,
        relative_mass=mass - matrix(terms, INERTIA_NAMES),
        relative_heel=_relative_heel(at, terms),
    )


def _check_cubics(ship: Ship, terms: Mapping[str, Term]) -> None:
    """Drag by strips holds every cubic of the velocities: one given or multiplied beside it would be counted twice."""
    if DRAG_NAME not in terms or not terms[DRAG_NAME].value.any():
        return
    beside = sorted({name for row in CUBIC_NAMES for name in row} & given_names(ship) - set(terms))
    if beside:
        raise InputError(
            f"{ship.name}: {beside[0]} is given beside drag by strips, which has no cubic coefficients; change"
            ' drag_coefficient, or take drag="cubic"'
        )


def _relative_heel(at: Conditions, terms: Mapping[str, Term]) -> Floats:
    """Y_phi, K_phi, N_phi (n, 3) without hydrostatics, which has only K_phi; a given K_phi is hydrostatics too."""
    rows = []
    for name, *_ in RESTORING_NAMES:
        hydrostatic = with_given_alone(at.ship, name, restoring(at)[name].value) if name == "K_phi" else 0.0
        rows.append(terms[name].value - hydrostatic)
    return np.stack(rows, axis=-1)


def _righting(ship: Ship) -> OddSpline | None:
    """The righting spline [N m] without its slope, which is K_phi; None for a ship with a polynomial."""
    spline = righting_moment(ship)
    if spline is None:
        return None
    touched = [name for name in RESTORING_NAMES[1][1:] if name in given_names(ship)]
    if touched:
        raise InputError(
            f"{ship.name}: {touched[0]} is given beside a righting spline, which holds all beyond K_phi; change K_phi, or take "
            'righting="polynomial"'
        )
    return replace(spline, slope=0.0)

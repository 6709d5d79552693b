"""The sources of a ship's coefficients, each with the terms it gives: what of the table comes from where.

A further source is a function of this kind in a file of its own, and one line of `coefficients.SOURCES`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import Hydrostatics, hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.righting.arm import righting_polynomial, righting_spline
from quartering.hull.righting.spline import OddSpline
from quartering.hull.ship import Ship
from quartering.hydro.damping.method import LINEAR
from quartering.hydro.damping.natural_roll import FreeRoll
from quartering.hydro.damping.of_ship import damping_method
from quartering.hydro.manoeuvring.crossflow import cross_flow_cubics, reference_velocity
from quartering.hydro.manoeuvring.lift import hull_lift
from quartering.hydro.manoeuvring.measured_ship import MeasuredParts, added_mass_shift
from quartering.hydro.manoeuvring.rudder import rudder_derivatives
from quartering.hydro.source.record import Hydrodynamics
from quartering.hydro.strip.integrals import moment_matrix
from quartering.hydro.strip.lateral import derivatives_from_moments, frequency_floor
from quartering.hydro.terms import Term, Terms, named
from quartering.names import CUBIC_NAMES, DRAG_NAME, INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES, RUDDER_NAMES

Lift = Literal["regression", "measured", "none"]


@dataclass(frozen=True, eq=False)
class Conditions:
    """A ship at n frequencies and speeds, with what several sources of coefficients ask for.

    Parameters
    ----------
    ship : Ship
    frequency, speed : (n,) float       omega >= 0 [rad/s], U >= 0 [m/s]
    source : Hydrodynamics              of the ship
    roll : FreeRoll                     of the ship
    measured : MeasuredParts or None    its measured set at these speeds
    """

    ship: Ship
    frequency: Floats
    speed: Floats
    source: Hydrodynamics
    roll: FreeRoll
    measured: MeasuredParts | None

    @property
    def lift(self) -> Lift:
        """Where the lift of the hull comes from; "none" where strip theory has its speed terms."""
        if self.ship.linear == "strip":
            return "none"
        return "regression" if self.measured is None else "measured"

    @cached_property
    def floating(self) -> Hydrostatics:
        """Hydrostatic particulars of the ship."""
        return hydrostatics(self.ship)

    @cached_property
    def potential(self) -> tuple[Floats, Floats]:
        """Velocity and acceleration derivatives (n, 3, 3) of the potential flow.

        Their action on moving water is in the diffraction. With lift from elsewhere they are of zero speed: the lift stands in
        place of every speed term of strip theory.
        """
        at = self.source.at(self.frequency)
        if self.lift != "none":
            return -moment_matrix(at.b), -moment_matrix(at.a)
        floor = frequency_floor(self.ship.hull.beam)
        return derivatives_from_moments(at.a, at.b, self.speed, self.frequency, aft=at.aft, floor=floor)

    def all(self, value: float) -> Floats:
        """A value that is the same at every condition, (n,)."""
        return np.broadcast_to(value, self.frequency.shape)


Source = Callable[[Conditions], Terms]


def rigid_body(at: Conditions) -> Terms:
    """Rigid-body values of the loading."""
    mass, loading, provenance = at.floating.mass, at.ship.loading, at.ship.provenance
    roll, yaw = (provenance.get(key, "given") for key in ("gyradius_roll", "gyradius_yaw"))
    return {
        "m": Term(at.all(mass), "derived", "displacement of the lines"),
        "I_x": Term(at.all(mass * loading.gyradius_roll**2), "derived", f"m k_xx^2; k_xx {roll}"),
        "I_z": Term(at.all(mass * loading.gyradius_yaw**2), "derived", f"m k_zz^2; k_zz {yaw}"),
        "I_xz": Term(at.all(0.0), "derived", "principal axes"),
    }


def potential_flow(at: Conditions) -> Terms:
    """Added mass and damping of the ship's source of hydrodynamics."""
    linear, added = at.potential
    words, kind, references = at.source.words, at.source.kind, at.source.references
    damping = f"wave damping of {words} at omega"
    if at.lift == "none":
        damping = f"wave damping of {words} at omega with the speed terms of strip theory, without lift"
    terms = {name: Term(value, kind, damping, references) for name, value in named(LINEAR_NAMES, linear).items()}
    mass = f"added mass of {words} at omega"
    return terms | {name: Term(value, kind, mass, references) for name, value in named(INERTIA_NAMES, added).items()}


def regression_lift(at: Conditions) -> Terms:
    """Clarke's regression, where neither a measured set nor strip theory has the speed terms."""
    if at.lift != "regression":
        return {}
    terms = {}
    for name, value in named(LINEAR_NAMES, hull_lift(at.ship, at.speed)).items():
        levered = " at half draught" if "K" in name or "p" in name else ""
        terms[name] = Term(value, "regression", f"estimated: Clarke's regression{levered}", ("Clarke83",))
    if damping_method(at.ship).lift:
        del terms[LINEAR]  # the lift of a rolling hull is in the method of roll damping
    return terms


def measured_set_terms(at: Conditions) -> Terms:
    """What a measured set gives: in place of the regression its lift and added mass, and its nonlinear terms."""
    parts = at.measured
    if parts is None:
        return {}
    here = (parts.reference,)

    def term(name: str, value: Floats, words: str = "") -> Term:
        return Term(value, "measured", f"{parts.by(name)}{words}", here)

    terms: dict[str, Term] = {}
    if at.lift == "measured":
        terms |= {name: term(name, value) for name, value in named(LINEAR_NAMES, parts.linear).items()}
        slow = -at.source.matrices(np.zeros(1))[0][0]
        shift, given = added_mass_shift(parts, slow), ~np.isnan(parts.added)
        for i, row in enumerate(INERTIA_NAMES):
            for j, name in enumerate(row):
                value = at.all(shift[i, j])
                if given[i, j]:
                    terms[name] = term(name, value, f" at omega -> 0, in place of that of {at.source.words}")
                elif shift[i, j]:
                    terms[name] = Term(
                        value, at.source.kind, f"moment of the measured sway force, {parts.by(name)}", here
                    )
    if parts.drag:
        without = Term(at.all(0.0), "measured", f"{parts.source}; no such term in the set", here)
        terms |= {name: without for row in CUBIC_NAMES for name in row}
    return terms | {name: term(name, value, ", at this speed") for name, value in parts.further.items()}


def added_roll_damping(at: Conditions) -> Terms:
    """The ship's added roll damping; of this and that of a measured set the larger counts, which describe the same loss."""
    method = damping_method(at.ship)
    found, words = method.added(at.ship, at.speed, at.roll), method.words(at.ship)
    terms = dict(found.terms)
    if at.lift == "measured" and at.measured is not None:
        has = at.measured.roll_damping
        more = found.equivalent < has
        terms = {name: np.where(more, value - has if name == LINEAR else value, 0.0) for name, value in terms.items()}
        words = f"{words}, as far as it is larger at 10 deg than measured" if has.any() else words
    return {name: Term(value, method.kind, words, method.references) for name, value in terms.items()}


def restoring(at: Conditions) -> Terms:
    """The righting moment, as a polynomial or the slope of a spline."""
    weight = at.floating.mass * GRAVITY
    gm = f"-rho g V GM; GM {at.ship.provenance.get('gm', 'given')}"
    spline = _spline(at.ship)
    if spline is None:
        fit = righting_polynomial(at.ship)
        arms, words = (at.ship.loading.gm, fit.gz3, fit.gz5, fit.gz7), "fit to the righting arm of the lines"
    else:
        arms, words = (spline.slope, 0.0, 0.0, 0.0), "in the spline through the righting arm of the lines"
    terms = {n: Term(at.all(0.0), "derived", "upright symmetry") for row in RESTORING_NAMES for n in row}
    for power, (name, arm) in enumerate(zip(RESTORING_NAMES[1], arms, strict=True)):
        terms[name] = Term(at.all(-weight * arm + 0.0), "derived", words if power else gm)
    return terms


def righting_moment(ship: Ship) -> OddSpline | None:
    """The righting spline as moment K [N m], its slope K_phi included; None for a ship with a polynomial."""
    spline = _spline(ship)
    return None if spline is None else spline.times(-hydrostatics(ship).mass * GRAVITY)


def _spline(ship: Ship) -> OddSpline | None:
    return righting_spline(ship) if ship.righting == "spline" else None


def cross_flow(at: Conditions) -> Terms:
    """Cross-flow drag at half the draught of each section: ten cubics, or C_D of the strips; none beside measured cubics."""
    if at.measured is not None and at.measured.drag:
        return {}
    if at.ship.drag == "strips":
        given = at.all(at.ship.drag_coefficient)
        return {
            DRAG_NAME: Term(given, "cross-flow", "estimated: |q| q strip by strip, at half draught", ("Hoerner65",))
        }
    ship, immersed = at.ship, strips(at.ship.hull)
    hull, loading = ship.hull, ship.loading
    lever = loading.kg - hull.draught + immersed.draught / 2
    scale = ship.velocity_scale if ship.velocity_scale is not None else reference_velocity(hull.length)
    x, drag = immersed.x - at.floating.lcb, ship.drag_coefficient
    values = cross_flow_cubics(x, immersed.weight, immersed.draught, lever, drag, scale, loading.density)
    words = f"estimated: cross-flow drag, C_D {drag:g}, u0 {scale:.3g} m/s, at half draught"
    return {
        name: Term(at.all(float(values[i, j])), "cross-flow", words, ("Hoerner65",))
        for i, row in enumerate(CUBIC_NAMES)
        for j, name in enumerate(row)
    }


def rudder(at: Conditions) -> Terms:
    """Rudder derivatives; none without an autopilot to move the rudder."""
    if at.ship.autopilot is None:
        return {}
    values, kind, source = rudder_derivatives(at.ship, at.speed)
    references = ("Yasukawa15",) if at.measured is None or kind == "regression" else (at.measured.reference,)
    return {name: Term(values[:, i], kind, source, references) for i, name in enumerate(RUDDER_NAMES)}

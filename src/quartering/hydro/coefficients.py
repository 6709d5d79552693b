"""The coefficients of the equations of motion of a ship, at many conditions at once, each with its source."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY, InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.immersed import strips
from quartering.hull.righting import righting_polynomial, righting_spline
from quartering.hull.section import Floats
from quartering.hull.ship import Ship
from quartering.hull.spline import OddSpline
from quartering.hull.told import numbers
from quartering.hydro.coefficient_sources import Kind, coefficient_sources
from quartering.hydro.coefficient_table import BODY_NAMES, Coefficients, rigid_inertia
from quartering.hydro.crossflow import cross_flow_cubics, reference_velocity
from quartering.hydro.freeroll import free_roll
from quartering.hydro.given import Given
from quartering.hydro.hull_table import section_references
from quartering.hydro.integrals import moment_matrix
from quartering.hydro.manoeuvring import hull_lift
from quartering.hydro.measured_ship import MeasuredParts, added_mass_shift, measured_parts, measured_sources
from quartering.hydro.own_moments import check_frequencies, ship_moments
from quartering.hydro.rudder import rudder_derivatives
from quartering.hydro.ship_damping import MODULUS, AddedDamping, added_damping, damping_references
from quartering.hydro.strip import derivatives_from_moments, frequency_floor
from quartering.names import CUBIC_NAMES, INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES, RUDDER_NAMES


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
    roll damping and the ship's added roll damping (at 10 deg) the larger counts, since both describe the same loss.
    By a component method ("ikeda", "ikeda-simplified") the added roll damping is that of `added_damping` at each speed, a
    part of K_p and K_p|p|; its lift takes the place of the regression's in K_p.
    Source: [STF70] strips, [Clarke83] lift, [Hoerner65] cross-flow, [H71] equation (2).
    Valid: deep water; a rudder only beside an autopilot.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> c = coefficients(ship("wigley"), [0.4, 0.8], 5.0)
    >>> c.inertia.shape, bool((c.linear[:, 0, 0] < 0).all())
    ((2, 3, 3), True)
    """
    speed = numbers(ship, "speed", speed)
    omega, u = (np.array(q) for q in np.broadcast_arrays(*(np.atleast_1d(_number(q)) for q in (frequency, speed))))
    if not (np.isfinite(omega).all() and np.isfinite(u).all() and (u >= 0).all()):
        raise InputError("frequency and speed must be finite, and speed >= 0 m/s; heading tells the direction")
    omega = np.abs(omega)
    measured = None if ship.measured is None else measured_parts(ship, u)
    lift = measured if ship.linear == "default" else None
    sources = coefficient_sources(ship)
    if measured is not None:
        sources |= {name: ("measured", said) for name, said in measured_sources(ship, measured, sources).items()}
    rudder = _rudder(ship, u, sources)
    given = Given(ship, sources)
    roll = free_roll(ship)
    check_frequencies(ship, np.append(omega, roll.frequency))
    body = {name: float(given.applied(name, np.array(value))) for name, value in _body(ship).items()}
    linear, added, potential = _velocity_and_added_mass(ship, omega, u, lift)
    viscous = _beyond_measured(added_damping(ship, u, roll), lift)
    linear[:, 1, 1] += viscous.linear
    linear = given.matrix(LINEAR_NAMES, linear)
    added = given.matrix(INERTIA_NAMES, added)
    relative, relative_mass = linear - potential[0], potential[1] - added
    linear[:, 0, 2] -= body["m"] * u
    restoring = given.matrix(RESTORING_NAMES, _restoring(ship))
    varying = given.varying(_varying(ship, viscous, measured))
    known = set(BODY_NAMES).union(*LINEAR_NAMES, *INERTIA_NAMES, *RESTORING_NAMES, *CUBIC_NAMES, RUDDER_NAMES)
    return Coefficients(
        ship=ship.name,
        frequency=omega,
        speed=u,
        inertia=rigid_inertia(body) - added,
        linear=linear,
        restoring=restoring,
        cubic=given.matrix(CUBIC_NAMES, _cross_flow(ship, measured)),
        extra=MappingProxyType(given.further(known)),
        body=MappingProxyType(body),
        roll_frequency=roll.frequency,
        sources=MappingProxyType(sources),
        references=_references(ship, measured) + (("Yasukawa15",) if ship.autopilot else ()),
        varying=MappingProxyType(varying),
        righting=_righting(ship, given),
        rudder=None if rudder is None else given.matrix((RUDDER_NAMES,), rudder[:, None])[:, 0],
        relative=relative,
        relative_mass=relative_mass,
        relative_heel=_relative_heel(restoring, varying, omega.size),
    )


def _beyond_measured(viscous: AddedDamping, lift: MeasuredParts | None) -> AddedDamping:
    """The added roll damping less what a measured set has of it: at 10 deg the larger of the two counts."""
    if lift is None:
        return viscous
    more = viscous.equivalent < lift.roll_damping
    linear = np.where(more, viscous.linear - lift.roll_damping, 0.0)
    return AddedDamping(linear, np.where(more, viscous.quadratic, 0.0), viscous.equivalent)


def _varying(ship: Ship, viscous: AddedDamping, measured: MeasuredParts | None) -> dict[str, Floats]:
    """Terms that vary with the speed: those of a measured set, and the roll damping of a component method."""
    terms = dict(measured.further) if measured else {}
    if ship.roll_method != "fraction":
        terms[MODULUS] = terms.get(MODULUS, 0.0) + viscous.quadratic
    return terms


def _relative_heel(restoring: Floats, varying: Mapping[str, Floats], count: int) -> Floats:
    """Y_phi, K_phi, N_phi (n, 3) without hydrostatics, which has only K_phi."""
    sway, yaw = restoring[0, 0], restoring[2, 0]
    given = [sway, 0.0, yaw]
    rows = [own + varying.get(names[0], np.zeros(count)) for names, own in zip(RESTORING_NAMES, given, strict=True)]
    return np.stack(rows, axis=-1)


def _number(values: ArrayLike) -> Floats:
    return np.asarray(values, dtype=float)


def _body(ship: Ship) -> dict[str, float]:
    """Rigid-body values of the loading."""
    mass, loading = hydrostatics(ship).mass, ship.loading
    return {"m": mass, "I_x": mass * loading.gyradius_roll**2, "I_z": mass * loading.gyradius_yaw**2, "I_xz": 0.0}


def _references(ship: Ship, measured: MeasuredParts | None) -> tuple[str, ...]:
    """Keys of the papers the coefficients rest on."""
    lift = ("Clarke83",) if ship.linear == "default" else ()
    drag = ("Hoerner65",) if measured is None or not measured.drag else ()
    own = (measured.reference,) if measured else lift
    ends = () if ship.hull.ends == "strips" else ("Morino74",)
    water = ("STF70", *section_references(ship.hull), *ends) if ship.database is None else (ship.database.reference,)
    return ("H71", *water, *drag, *own, *damping_references(ship))


def _velocity_and_added_mass(
    ship: Ship, omega: Floats, speed: Floats, measured: MeasuredParts | None
) -> tuple[Floats, Floats, tuple[Floats, Floats]]:
    """Velocity and acceleration derivatives of the hull before overrides, (n, 3, 3) each; then those of the potential flow.

    The last two are the derivatives whose action on moving water the diffraction force holds: lift, and added mass that
    was measured, are what the first two have beyond them.
    """
    z0 = ship.loading.kg - ship.hull.draught
    at = ship_moments(ship).at(omega).about(hydrostatics(ship).lcb, z0)
    if ship.linear == "strip":
        floor = frequency_floor(ship.hull.beam)
        linear, added = derivatives_from_moments(at.a, at.b, speed, omega, aft=at.aft, floor=floor)
        return linear.copy(), added, (linear, added)
    waves, mass = -moment_matrix(at.b), -moment_matrix(at.a)
    if measured is None:
        lift = hull_lift(ship, speed)
        if ship.roll_method != "fraction":
            lift[:, 1, 1] = 0.0  # the component method has the lift of a rolling hull
        return lift + waves, mass, (waves, mass)
    slow = ship_moments(ship).at(0.0).about(hydrostatics(ship).lcb, z0)
    return measured.linear + waves, added_mass_shift(measured, -moment_matrix(slow.a)) + mass, (waves, mass)


def _restoring(ship: Ship) -> Floats:
    """K_phi, K_phiphiphi, K_phi5, K_phi7 in the roll row."""
    weight = hydrostatics(ship).mass * GRAVITY
    rows = np.zeros((3, 4))
    if ship.righting == "spline":
        rows[1, 0] = -weight * righting_spline(ship).slope
        return rows
    fit = righting_polynomial(ship)
    rows[1] = [-weight * arm for arm in (ship.loading.gm, fit.gz3, fit.gz5, fit.gz7)]
    return rows + 0.0


def _righting(ship: Ship, given: Given) -> OddSpline | None:
    """The righting spline [N m] without its slope, which is K_phi; None for a ship with a polynomial."""
    if ship.righting != "spline":
        return None
    touched = [name for name in RESTORING_NAMES[1][1:] if name in given.values or name in given.factors]
    if touched:
        raise InputError(
            f"{ship.name}: {touched[0]} is given beside a righting spline, which holds all beyond K_phi; change K_phi, or take "
            'righting="polynomial"'
        )
    return replace(righting_spline(ship).times(-hydrostatics(ship).mass * GRAVITY), slope=0.0)


def _rudder(ship: Ship, speed: Floats, sources: dict[str, tuple[Kind, str]]) -> Floats | None:
    """Rudder derivatives (n, 3) before overrides, their source noted; None without an autopilot to move the rudder."""
    if ship.autopilot is None:
        return None
    derivatives, kind, source = rudder_derivatives(ship, speed)
    sources |= dict.fromkeys(RUDDER_NAMES, (kind, source))
    return derivatives


def _cross_flow(ship: Ship, measured: MeasuredParts | None) -> Floats:
    """The ten cubics from cross-flow drag acting at half the draught of each section; none beside measured ones."""
    if measured is not None and measured.drag:
        return np.zeros((3, 10))
    immersed, hull, loading = strips(ship.hull), ship.hull, ship.loading
    lever = loading.kg - hull.draught + immersed.draught / 2
    scale = ship.velocity_scale if ship.velocity_scale is not None else reference_velocity(hull.length)
    x = immersed.x - hydrostatics(ship).lcb
    return cross_flow_cubics(x, immersed.weight, immersed.draught, lever, ship.drag_coefficient, scale, loading.density)

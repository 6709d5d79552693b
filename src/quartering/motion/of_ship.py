"""The equations of motion of a ship in waves: coefficients and wave forces put together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition
from quartering.hydro.capsize import vanishing_of_equations
from quartering.hydro.coefficient_table import Coefficients
from quartering.hydro.coefficients import coefficients
from quartering.loads.forces import Form, ship_force_phasors
from quartering.loads.lift import ship_lift_phasors
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import Wave, least_encounter_frequency
from quartering.motion.drag_of_ship import at_height, moving_water
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats, System, acceleration_form
from quartering.motion.equations.terms import TermTable, term_table
from quartering.motion.matched import Matching
from quartering.motion.matching_of_ship import ship_matching
from quartering.names import LINEAR_NAMES, RUDDER_NAMES


@dataclass(frozen=True, eq=False)
class ShipSystem:
    """Equations of a ship at m conditions per metre of wave amplitude, to be combined with any wave heights.

    Parameters
    ----------
    system : System                  with the excitation of a wave of 1 m amplitude, at the frequency |omega|
    encounter_frequency : (m,)       omega, negative where the ship overtakes the wave [rad/s]
    slow : (m,) bool                 the ship keeps pace with the wave: no periodic motion
    outside : (m,) bool              the ship's own database does not hold the condition: its equations are NaN
    coefficients : Coefficients      with their sources
    matching : Matching, optional    of cubic drag whose reference velocity follows the motion
    """

    system: System
    encounter_frequency: Floats
    slow: NDArray[np.bool_]
    outside: NDArray[np.bool_]
    coefficients: Coefficients
    matching: Matching | None = None

    def at_amplitude(self, amplitude: Floats) -> System:
        """Equations at given wave amplitudes.

        amplitude (m, h): h wave amplitudes at each condition [m]
        Returns m h conditions, the heights of one condition beside each other
        """
        count = amplitude.shape[1]
        raised = self.system.repeated(count).raised(amplitude.reshape(-1))
        return raised if self.matching is None else self.matching.at_motion(raised, amplitude.reshape(-1))


def nonlinear_terms(c: Coefficients, condition: int = 0) -> dict[str, float]:
    """Terms on the right that do not depend on the frequency: restoring, cubic and further ones, at one condition's speed.

    condition: which of its conditions; some terms differ between speeds
    Returns name -> coefficient [SI]; what is zero at every condition left out

    Source: [H71] eq. (2).
    """
    return {name: float(value[condition]) for name, value in c.nonlinear.items()}


def _term_table(c: Coefficients) -> TermTable:
    """The nonlinear terms of all conditions: one table, or coefficients by condition where they vary with the speed."""
    if all(np.ptp(value) == 0 for value in c.nonlinear.values()):
        return term_table(nonlinear_terms(c))
    _, first, back = np.unique(c.speed, return_index=True, return_inverse=True)
    tables = [term_table(nonlinear_terms(c, int(k))) for k in first]
    linear, coefficients = (np.stack([getattr(t, part) for t in tables])[back] for part in ("linear", "coefficients"))
    return TermTable(linear, tables[0].powers, tables[0].modulus, coefficients)


def excitation(
    ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, form: Form = "stf"
) -> tuple[NDArray[np.complex128], Floats]:
    """Wave force on the hull per metre of amplitude, without lift, and encounter frequency of a ship at many conditions.

    as in `ship_system`

    Returns force (m, 3): sway [N/m], roll and yaw about G [N m/m]: phasors of e^{i |omega| t}; omega (m,): negative
        where the ship overtakes the wave [rad/s]

    Froude-Krylov and diffraction alone: they depend on the loading through the height of G only, and `ship_system` adds
    the lift of the loading.  Source: [H71] Appendix B, [STF70].
    """
    pressure, scattered, omega = ship_force_phasors(ship, wavenumber, speed, heading, form)
    return pressure + scattered, omega


def ship_system(
    ship: Ship,
    wavenumber: Floats,
    speed: Floats,
    heading: Floats,
    form: Form = "stf",
    *,
    known: tuple[NDArray[np.complex128], Floats] | None = None,
) -> ShipSystem:
    """Equations of a ship at many conditions, per metre of wave amplitude.

    wavenumber (m,): k > 0 [1/m]
    speed (m,): U >= 0 [m/s]
    heading (m,): mu: 0 following, 180 head [deg]
    form: of the diffraction force, see `wave_forces`
    known: what `excitation` gives, when it has been found already

    Added mass, damping and forces at the encounter frequency; where that is negative the conjugate force at its modulus.
    Source: [H71] eqs. (2), (3), Appendix B.
    """
    force, omega = excitation(ship, wavenumber, speed, heading, form) if known is None else known
    c = coefficients(ship, omega, speed)
    if form != "paper":
        force = force + ship_lift_phasors(ship, c, wavenumber, speed, heading)
    moving = moving_water(ship, c, wavenumber, speed, heading, form)
    slow = np.abs(omega) < least_encounter_frequency(ship.hull.length)
    linear = np.concatenate([c.linear[:, :, :1], np.zeros((omega.size, 3, 1)), c.linear[:, :, 1:]], axis=2)
    table = _term_table(c)
    linear += table.linear
    frequency = np.where(slow, np.nan, np.abs(omega))
    given: dict[str, Any] = {} if c.rudder is None else {"rudder": c.rudder, "autopilot": ship.autopilot}
    given |= {"linear": linear, "restoring": c.righting, **moving}
    system = acceleration_form(c.inertia, table, frequency, (force.real, -force.imag, 0.0), **given)
    matching = None if form == "paper" else ship_matching(ship, c, frequency, wavenumber, speed, heading)
    return ShipSystem(system, omega, slow, np.zeros(omega.shape, dtype=bool), c, matching)


@takes(ship="Ship", wave="Wave", form="word")
def equations(ship: Ship, wave: Wave, speed: float | str, heading: float | str, form: Form = "stf") -> Model:
    """Equations of motion of a ship in one regular wave.

    Parameters
    ----------
    ship : Ship
    wave : Wave        length and height
    speed : float      U >= 0 [m/s]
    heading : float    mu: 0 following, 90 beam, 180 head [deg]
    form : str         of the diffraction force, see `wave_forces`

    Returns
    -------
    Model

    Raises
    ------
    InputError    the ship keeps pace with the wave; bad speed or heading

    Warns
    -----
    RangeWarning  what `warn_of_conditions` finds

    Notes
    -----
    Source: [H71] eqs. (1)-(3), Appendix B.  Valid: deep water, constant speed and coefficients, roll below the vanishing
    angle; the terms that are estimated are named by `coefficients`.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> model = equations(ship("series60-cb60"), Wave(length=150.0, height=4.0), speed=7.5, heading=30.0)
    >>> round(model.frequency, 3)
    0.369
    """
    speed, heading = condition(ship, speed, heading)
    warn_of_conditions(ship, speed, wave.length)
    one = (np.array([wave.wavenumber]), np.array([float(speed)]), np.array([float(heading)]))
    at = ship_system(ship, *one, form=form)
    if at.slow[0]:
        raise InputError(
            f"heading {heading:g} deg, speed {speed:g} m/s, wave {wave.length:g} m: the ship keeps pace with the wave"
            f" (encounter frequency {at.encounter_frequency[0]:.2g} rad/s), so there is no periodic motion; surf-riding"
            " and broaching are possible; change speed or heading"
        )
    c = at.coefficients
    further = nonlinear_terms(c)
    if at.matching is not None:
        for name, more in at.matching.added(at.system, wave.amplitude).items():
            further[name] += more
    terms = {name: float(c.linear[0, i, j]) for i, row in enumerate(LINEAR_NAMES) for j, name in enumerate(row)}
    if c.rudder is not None:
        terms |= dict(zip(RUDDER_NAMES, c.rudder[0].tolist(), strict=True))
    inertia = c.inertia[0]
    source = {"ship": ship.name, "heading": float(heading), "speed": float(speed)}
    source |= {"wave_length": wave.length, "wave_height": wave.height}
    return Model(
        inertia=inertia,
        terms=terms | further,
        frequency=float(abs(at.encounter_frequency[0])),
        force_cos=wave.amplitude * inertia @ at.system.cos[0],
        force_sin=wave.amplitude * inertia @ at.system.sin[0],
        source=source,
        references=tuple(dict.fromkeys(("H71", "STF70", *c.references))),
        autopilot=ship.autopilot,
        restoring=c.righting,
        told_vanishing=vanishing_of_equations(ship),
        openings=ship.value("openings"),
        **at_height(moving_water(ship, c, *one, form), wave.amplitude),
    )

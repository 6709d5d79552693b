"""The equations of motion of a ship in waves: coefficients and wave forces put together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.immersed import strips
from quartering.hull.ship import Ship
from quartering.hydro.coefficients import Coefficients, coefficients
from quartering.hydro.moments import section_table
from quartering.hydro.names import CUBIC_NAMES, LINEAR_NAMES, RESTORING_NAMES
from quartering.loads.forces import Form, wave_force_phasors
from quartering.loads.stations import stations
from quartering.loads.waves import Wave, least_encounter_frequency
from quartering.motion.equations import Floats, Model, System, canonical
from quartering.motion.terms import term_table


@dataclass(frozen=True, eq=False)
class ShipSystem:
    """Equations of a ship at m conditions per metre of wave amplitude, to be combined with any wave heights.

    Parameters
    ----------
    system : System                  with the excitation of a wave of 1 m amplitude, at the frequency |omega|
    encounter_frequency : (m,)       omega, negative where the ship overtakes the wave [rad/s]
    slow : (m,) bool                 the ship keeps pace with the wave: no periodic motion
    coefficients : Coefficients      with their sources
    """

    system: System
    encounter_frequency: Floats
    slow: NDArray[np.bool_]
    coefficients: Coefficients

    def at_amplitude(self, amplitude: Floats) -> System:
        """Equations at given wave amplitudes.

        Parameters
        ----------
        amplitude : (m, h) float    h wave amplitudes at each condition [m]

        Returns
        -------
        System    m h conditions, the heights of one condition beside each other
        """
        count = amplitude.shape[1]
        factor = amplitude.reshape(-1, 1)
        s = self.system

        def spread(array: Floats) -> Floats:
            return np.repeat(array, count, axis=0) if count > 1 else array

        return System(
            linear=spread(s.linear),
            coefficients=spread(s.coefficients),
            powers=s.powers,
            modulus=s.modulus,
            mean=spread(s.mean),
            cos=spread(s.cos) * factor,
            sin=spread(s.sin) * factor,
            frequency=spread(s.frequency),
        )


def nonlinear_terms(c: Coefficients) -> dict[str, float]:
    """Terms on the right that are alike at every speed and frequency: restoring, cubic and further ones.

    Parameters
    ----------
    c : Coefficients

    Returns
    -------
    dict of str to float    name -> coefficient [SI]; zeros left out

    Notes
    -----
    Source: [H71] eq. (2).

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> nonlinear_terms(coefficients(ship("wigley"), 0.5, 5.0))["K_phi"] < 0
    True
    """
    named = {
        name: float(matrix[i, j])
        for names, matrix in ((RESTORING_NAMES, c.restoring), (CUBIC_NAMES, c.cubic))
        for i, row in enumerate(names)
        for j, name in enumerate(row)
    }
    return {name: value for name, value in (named | dict(c.extra)).items() if value != 0.0}


def ship_system(ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, form: Form = "stf") -> ShipSystem:
    """Equations of a ship at many conditions, per metre of wave amplitude.

    Parameters
    ----------
    ship : Ship
    wavenumber : (m,) float    k > 0 [1/m]
    speed : (m,) float         U >= 0 [m/s]
    heading : (m,) float       mu: 0 following, 180 head [deg]
    form : str                 of the diffraction force, see `wave_forces`

    Returns
    -------
    ShipSystem

    Raises
    ------
    InputError    what `coefficients` and `wave_force_phasors` refuse

    Notes
    -----
    Added mass, damping and forces at the encounter frequency; where that is negative the conjugate force at its modulus.
    Source: [H71] eqs. (2), (3), Appendix B.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> at = ship_system(ship("wigley"), np.array([0.05]), np.array([5.0]), np.array([30.0]))
    >>> at.system.count, bool(at.slow[0])
    (1, False)
    """
    density = ship.loading.density
    pressure, scattered, omega = wave_force_phasors(
        strips(ship.hull), stations(ship), section_table(ship.hull, density), wavenumber, speed, heading,
        form=form, density=density,
    )  # fmt: skip
    c = coefficients(ship, omega, speed)
    slow = np.abs(omega) < least_encounter_frequency(ship.hull.length)
    force = pressure + scattered
    linear = np.concatenate([c.linear[:, :, :1], np.zeros((omega.size, 3, 1)), c.linear[:, :, 1:]], axis=2)
    table = term_table(nonlinear_terms(c))
    linear += table.linear
    frequency = np.where(slow, np.nan, np.abs(omega))
    system = canonical(c.inertia, table, frequency, force.real, -force.imag, linear=linear)
    return ShipSystem(system, omega, slow, c)


def equations(ship: Ship, wave: Wave, speed: float, heading: float, form: Form = "stf") -> Model:
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

    Notes
    -----
    Source: [H71] eqs. (1)-(3), Appendix B.  Valid: deep water, constant speed and coefficients, roll below the vanishing
    angle; the terms that are estimated are named by `coefficients`.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> model = equations(ship("series60-cb60"), Wave(length=150.0, height=4.0), speed=7.5, heading=30.0)
    >>> round(model.frequency, 3)
    0.369
    """
    one = (np.array([wave.wavenumber]), np.array([float(speed)]), np.array([float(heading)]))
    at = ship_system(ship, *one, form=form)
    if at.slow[0]:
        raise InputError(
            f"heading {heading:g} deg, speed {speed:g} m/s, wave {wave.length:g} m: the ship keeps pace with the wave"
            f" (encounter frequency {at.encounter_frequency[0]:.2g} rad/s), so there is no periodic motion; surf-riding"
            " and broaching are possible; change speed or heading"
        )
    c = at.coefficients
    terms = {name: float(c.linear[0, i, j]) for i, row in enumerate(LINEAR_NAMES) for j, name in enumerate(row)}
    inertia = c.inertia[0]
    source = {"ship": ship.name, "heading": float(heading), "speed": float(speed)}
    source |= {"wave_length": wave.length, "wave_height": wave.height}
    return Model(
        inertia=inertia,
        terms=terms | nonlinear_terms(c),
        frequency=float(abs(at.encounter_frequency[0])),
        force_cos=wave.amplitude * inertia @ at.system.cos[0],
        force_sin=wave.amplitude * inertia @ at.system.sin[0],
        source=source,
        references=tuple(dict.fromkeys(("H71", "STF70", *c.references))),
    )

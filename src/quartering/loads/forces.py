"""Wave forces on a ship: Froude-Krylov and diffraction together, for one condition or a million."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Literal, get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import (
    GRAVITY,
    HEADING_CONVENTION,
    MODES,
    REFERENCE_POINT,
    SYMBOLS,
    WATER_DENSITY,
    InputError,
)
from quartering.hull.immersed import strips
from quartering.hull.strips import Strips
from quartering.hydro.coefficients import coefficients
from quartering.hydro.ends import ENDS_WORDS
from quartering.hydro.moments import section_table
from quartering.hydro.table import SectionTable
from quartering.loads.database_forces import database_force_phasors
from quartering.loads.diffraction import contour_diffraction
from quartering.loads.froude_krylov import froude_krylov
from quartering.loads.lift import ship_lift_phasors
from quartering.loads.relative_motion import relative_motion_diffraction
from quartering.loads.stations import Stations, stations
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import Floats, Phasors, Wave, encounter_frequency, folded

if TYPE_CHECKING:
    from quartering.hull.ship import Ship
from quartering.hull.told import numbers

Form = Literal["paper", "paper-corrected", "relative-motion", "stf"]

FORMS: Final[dict[str, str]] = {
    "paper": "strip correction with the printed sign of the wave slope, from section coefficients",
    "paper-corrected": "strip correction with the sign of the wave slope corrected, from section coefficients",
    "relative-motion": "consistent relative motion with forward speed, from section coefficients",
    "stf": "Salvesen, Tuck and Faltinsen: with forward speed, from the potentials on the section contours",
}
"""Diffraction form -> what it is."""

LIFT_WORDS: Final = "given lift and added mass act on the velocity relative to the water"
LIFT_FOR_SPEED_TERMS: Final = (
    "lift, and measured or given added mass, on the velocity relative to the water, in place of the speed terms"
)


def wave_force_phasors(
    hull: Strips,
    place: Stations,
    table: SectionTable,
    wavenumber: ArrayLike,
    speed: ArrayLike,
    heading: ArrayLike,
    *,
    form: Form = "stf",
    density: float = WATER_DENSITY,
    speed_terms: bool = True,
) -> tuple[Phasors, Phasors, Floats]:
    """Froude-Krylov and diffraction force of many conditions, per metre of wave amplitude.

    Parameters
    ----------
    hull : Strips              section contours of the immersed hull
    place : Stations           the same sections seen from G
    table : SectionTable       section coefficients and potentials over frequency
    wavenumber : (n,) float    k > 0 [1/m]
    speed : (n,) float         U >= 0 [m/s]
    heading : (n,) float       mu: 0 following, 90 beam, 180 head [deg]
    form : str                 diffraction: "stf", "relative-motion", "paper-corrected" or "paper"
    density : float            of the water [kg/m3]
    speed_terms : bool         keep the diffraction's terms with U, see `contour_diffraction`

    Returns
    -------
    froude_krylov : (n, 3) complex    sway [N/m], roll and yaw about G [N m/m]: phasors of e^{i |omega| t}
    diffraction : (n, 3) complex      the same
    encounter_frequency : (n,)        omega, negative where the ship overtakes the wave [rad/s]; the force is
                                      Re{phasor e^{i |omega| t}}

    Raises
    ------
    InputError                 unknown form, or a condition that is not finite

    Notes
    -----
    Source: [H71] eqs. (B-3)-(B-11); [STF70] exciting force.  Valid: deep water, linear wave, mean position.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> box = ship("box")
    >>> hull, place, table = strips(box.hull), stations(box), section_table(box.hull, 1025.0)
    >>> _, diffraction, omega = wave_force_phasors(hull, place, table, [0.1, 0.1], [0.0, 20.0], [90.0, 0.0])
    >>> omega.round(3).tolist(), bool((diffraction[1] == 0).all())    # the second overtakes a following sea
    ([0.99, -1.01], True)
    """
    if form not in get_args(Form):
        raise InputError(f"form {form!r} given; allowed: {', '.join(FORMS)}; try 'stf'")
    k, U, mu = (v.copy() for v in np.broadcast_arrays(*(_column(v) for v in (wavenumber, speed, heading))))
    if not (np.isfinite(k) & (k > 0)).all():
        raise InputError("a wave number that is not a positive number was given; k = 2 pi / length [1/m]")
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    pressure = froude_krylov(hull, place, k, mu, density=density)
    if form == "stf":
        scattered = contour_diffraction(place, table, k, U, mu, density=density, speed_terms=speed_terms)
    else:
        scattered = relative_motion_diffraction(hull, place, table, k, U, mu, form=form, speed_terms=speed_terms)
    return folded(omega, pressure)[1], folded(omega, scattered)[1], omega


def form_words(ship: Ship, form: Form) -> str:
    """What a form of the wave force of a ship is, and where it comes from.

    Parameters
    ----------
    ship : Ship
    form : str

    Returns
    -------
    str

    Notes
    -----
    Source: `FORMS`.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> form_words(ship("box"), "stf") == FORMS["stf"]
    True
    """
    if ship.database is None or form != "stf":
        words = FORMS[form] if ship.hull.ends == "strips" else f"{FORMS[form]}; {ENDS_WORDS}"
    else:
        words = f"{ship.database.name}, zero speed, with speed terms of strip theory"
    if form == "paper" or ship.velocities == "absolute":
        return words
    return f"{words}; {LIFT_WORDS if keeps_speed_terms(ship) else LIFT_FOR_SPEED_TERMS}"


def keeps_speed_terms(ship: Ship) -> bool:
    """Does the diffraction of a ship keep its terms with U?

    Parameters
    ----------
    ship : Ship

    Returns
    -------
    bool    not where lift on the velocity relative to the water takes their place, as among the derivatives

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> keeps_speed_terms(ship("box")), keeps_speed_terms(ship("box").with_(linear="strip"))
    (False, True)
    """
    return ship.linear == "strip" or ship.velocities == "absolute"


def ship_force_phasors(
    ship: Ship, wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike, form: Form = "stf"
) -> tuple[Phasors, Phasors, Floats]:
    """Froude-Krylov and diffraction force of a ship at many conditions, per metre of wave amplitude.

    Parameters
    ----------
    ship, wavenumber, speed, heading, form    as in `wave_force_phasors`

    Returns
    -------
    tuple    as `wave_force_phasors`; form "stf" of a ship with its own database comes from there. `ship_lift_phasors` is
             the third part of the force

    Raises
    ------
    InputError    what `wave_force_phasors` and `database_force_phasors` refuse

    Notes
    -----
    Source: [H71] eqs. (B-3)-(B-11); [STF70] exciting force.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> ship_force_phasors(ship("box"), [0.1], [0.0], [90.0])[0].shape
    (1, 3)
    """
    speed_terms = keeps_speed_terms(ship)
    if ship.database is not None and form == "stf":
        k, U, mu = (v.copy() for v in np.broadcast_arrays(*(_column(v) for v in (wavenumber, speed, heading))))
        return database_force_phasors(ship, k, U, mu, speed_terms=speed_terms)
    density = ship.loading.density
    return wave_force_phasors(
        strips(ship.hull), stations(ship), section_table(ship.hull, density), wavenumber, speed, heading,
        form=form, density=density, speed_terms=speed_terms,
    )  # fmt: skip


def relative_phasors(
    ship: Ship, wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike, form: Form = "stf"
) -> Phasors:
    """Force of lift and measured or given added mass in moving water, per metre of wave amplitude.

    Parameters
    ----------
    ship, wavenumber, speed, heading, form    as in `wave_force_phasors`

    Returns
    -------
    (n, 3) complex    phasors of e^{i |omega| t}; 0 in form "paper" and with velocities "absolute"

    Raises
    ------
    InputError        what `coefficients` refuses

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> bool(abs(relative_phasors(ship("box"), [0.1], [5.0], [90.0])[0, 0]) > 0)
    True
    """
    k, U, mu = np.broadcast_arrays(*(_column(v) for v in (wavenumber, speed, heading)))
    if form == "paper" or ship.velocities == "absolute":
        return np.zeros((k.size, 3), dtype=complex)
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    return ship_lift_phasors(ship, coefficients(ship, omega, U), k, U, mu)


def wave_forces(
    ship: Ship, wave: Wave, speed: ArrayLike = 0.0, heading: ArrayLike = 90.0, form: Form = "stf"
) -> xr.Dataset:
    """Wave forces on a ship in one regular wave, for one or several speeds and headings.

    Parameters
    ----------
    ship : Ship
    wave : Wave                 amplitude and length
    speed : () or (u,) float    U >= 0 [m/s]
    heading : () or (h,) float  mu: 0 following, 90 beam (wave from port to starboard), 180 head [deg]
    form : str                  diffraction: "stf", "relative-motion", "paper-corrected" or "paper"; "stf" of a ship with its
                                own database comes from there, the others from strips

    Returns
    -------
    Dataset    froude_krylov, diffraction, lift, total (part, mode) [N; N m for roll and yaw about G]: the force is
               cos cos(|omega| t) + sin sin(|omega| t); encounter_frequency [rad/s]; leading dims speed, heading where
               several were given. `lift` is that of the water's velocity, with what measured or given added mass adds; it
               is 0 in form "paper" and for a ship with velocities "absolute"

    Raises
    ------
    InputError    unknown form, negative speed, anything not a number

    Warns
    -----
    RangeWarning  what `warn_of_conditions` finds

    Notes
    -----
    Time zero is when the surface at G passes its mean level on the way down. Where omega is negative (the ship
    overtakes the wave) the parts belong to |omega|.
    Source: [H71] eqs. (B-3)-(B-11); [STF70] exciting force.  Valid: deep water, linear wave, mean position.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> forces = wave_forces(ship("box"), Wave(length=200.0, height=2.0), speed=0.0, heading=[0.0, 90.0])
    >>> forces["total"].dims, forces["froude_krylov"].sel(heading=0.0, mode="sway", part="cos").item() == 0.0
    (('heading', 'part', 'mode'), True)
    """
    U, mu = numbers(ship, "speed", speed), numbers(ship, "heading", heading)
    if U.ndim > 1 or mu.ndim > 1:
        raise InputError(
            f"speed of shape {U.shape} and heading of shape {mu.shape} given; each may be a number or a list"
        )
    warn_of_conditions(ship, U, wave.length)
    grid_speed, grid_heading = (part.ravel() for part in np.meshgrid(U, mu, indexing="ij"))
    k = np.full(grid_speed.shape, wave.wavenumber)
    pressure, scattered, omega = ship_force_phasors(ship, k, grid_speed, grid_heading, form)
    lift = relative_phasors(ship, k, grid_speed, grid_heading, form)
    dims = tuple(name for name, values in (("speed", U), ("heading", mu)) if values.ndim)
    shape = U.shape + mu.shape
    parts = {"froude_krylov": pressure, "diffraction": scattered, "lift": lift, "total": pressure + scattered + lift}
    dataset = xr.Dataset(
        {name: _real_parts(name, wave.amplitude * phasors.reshape(*shape, 3), dims) for name, phasors in parts.items()},
        coords={"part": ["cos", "sin"], "mode": list(MODES), "unit": ("mode", ["N", "N m", "N m"])},
    )
    symbol, unit, meaning = SYMBOLS["encounter_frequency"]
    attributes = {"units": unit, "long_name": meaning, "symbol": symbol}
    dataset["encounter_frequency"] = (dims, omega.reshape(shape), attributes)
    for name, values in (("speed", U), ("heading", mu)):
        symbol, unit, meaning = SYMBOLS[name]
        dataset = dataset.assign_coords({name: (name if values.ndim else (), values)})
        dataset[name].attrs.update(units=unit, long_name=meaning, symbol=symbol)
    return dataset.assign_attrs(_provenance(ship, wave, form, omega))


def _real_parts(name: str, phasors: Phasors, dims: tuple[str, ...]) -> xr.DataArray:
    """Cosine and sine parts of phasors (..., mode), as (..., part, mode) with units."""
    long_name = {
        "froude_krylov": "Froude-Krylov force and moments",
        "diffraction": "diffraction force and moments",
        "lift": "force and moments of lift and measured or given added mass in moving water",
        "total": "wave force and moments, all parts together",
    }[name]
    attributes = {"units": "N (sway), N m (roll, yaw)", "long_name": long_name, "symbol": "Y, K, N"}
    return xr.DataArray(
        np.stack([phasors.real, -phasors.imag], axis=-2), dims=(*dims, "part", "mode"), attrs=attributes
    )


def _provenance(ship: Ship, wave: Wave, form: Form, omega: Floats) -> dict[str, str | float]:
    """Attributes that say what the forces are and what they rest on."""
    frequency: dict[str, str | float] = {"frequency": float(abs(omega[0]))} if omega.size == 1 else {}
    own = ship.database if form == "stf" else None
    ends = "" if ship.hull.ends == "strips" else ", Morino74"
    return frequency | {
        "ship": ship.name,
        "form": form,
        "form_meaning": form_words(ship, form),
        "heading_convention": HEADING_CONVENTION,
        "velocities": ship.velocities,
        "reference_point": REFERENCE_POINT,
        "axes": "x to the bow, y to starboard, z down; positive roll: starboard down; positive yaw: bow to starboard",
        "signal": "cos cos(|omega| t) + sin sin(|omega| t); at t = 0 the surface at G passes its mean level going down",
        "wave_length": float(wave.length),
        "wave_height": float(wave.height),
        "water_density": float(ship.loading.density),
        "references": f"H71, STF70{ends}" if own is None else f"STF70, {own.reference}",
    }


def _column(values: ArrayLike) -> Floats:
    return np.atleast_1d(np.asarray(values, dtype=float))

"""Wave forces on a ship: Froude-Krylov and diffraction together, for one condition or a million."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import (
    GRAVITY,
    HEADING_CONVENTION,
    MODES,
    REFERENCE_POINT,
    SYMBOLS,
    InputError,
)
from quartering.doors import takes
from quartering.hydro.coefficients import coefficients
from quartering.loads.lift import ship_lift_phasors
from quartering.loads.source import wave_source
from quartering.loads.strips.strip_forces import FORMS, Form, wave_force_phasors
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import Floats, Phasors, Wave, encounter_frequency

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship
from quartering.hull.told import numbers

__all__ = [
    "FORMS",
    "Form",
    "form_words",
    "keeps_speed_terms",
    "relative_phasors",
    "ship_force_phasors",
    "wave_force_phasors",
    "wave_forces",
]

LIFT_WORDS: Final = "given lift and added mass act on the velocity relative to the water"
LIFT_FOR_SPEED_TERMS: Final = (
    "lift, and measured or given added mass, on the velocity relative to the water, in place of the speed terms"
)


def form_words(ship: Ship, form: Form) -> str:
    """What a form of the wave force of a ship is, and where it comes from.

    Source: `FORMS`.

    >>> from quartering.hull.file.read import ship
    >>> form_words(ship("box").with_(ends="strips", velocities="absolute"), "stf") == FORMS["stf"]
    True
    """
    words = wave_source(ship, form).words
    if form == "paper" or ship.velocities == "absolute":
        return words
    return f"{words}; {LIFT_WORDS if keeps_speed_terms(ship) else LIFT_FOR_SPEED_TERMS}"


def keeps_speed_terms(ship: Ship) -> bool:
    """Does the diffraction of a ship keep its terms with U?

    Returns not where lift on the velocity relative to the water takes their place, as among the derivatives

    >>> from quartering.hull.file.read import ship
    >>> keeps_speed_terms(ship("box")), keeps_speed_terms(ship("box").with_(linear="strip"))
    (False, True)
    """
    return ship.linear == "strip" or ship.velocities == "absolute"


def ship_force_phasors(
    ship: Ship, wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike, form: Form = "stf"
) -> tuple[Phasors, Phasors, Floats]:
    """Froude-Krylov and diffraction force of a ship at many conditions, per metre of wave amplitude.

    as in `wave_force_phasors`

    Returns as `wave_force_phasors`, from where `wave_source` has them. `ship_lift_phasors` is the third part of the
        force

    Source: [H71] eqs. (B-3)-(B-11); [STF70] exciting force.
    """
    k, U, mu = (v.copy() for v in np.broadcast_arrays(*(_column(v) for v in (wavenumber, speed, heading))))
    return wave_source(ship, form).phasors(k, U, mu, keeps_speed_terms(ship))


def relative_phasors(
    ship: Ship, wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike, form: Form = "stf"
) -> Phasors:
    """Force of lift and measured or given added mass in moving water, per metre of wave amplitude.

    as in `wave_force_phasors`
    Returns (n, 3): phasors of e^{i |omega| t}; 0 in form "paper" and with velocities "absolute"
    """
    k, U, mu = np.broadcast_arrays(*(_column(v) for v in (wavenumber, speed, heading)))
    if form == "paper" or ship.velocities == "absolute":
        return np.zeros((k.size, 3), dtype=complex)
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    return ship_lift_phasors(ship, coefficients(ship, omega, U), k, U, mu)


@takes(ship="Ship", wave="Wave", form="word")
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
    >>> from quartering.hull.file.read import ship
    >>> forces = wave_forces(ship("box"), Wave(length=200.0, height=2.0), speed=0.0, heading=[0.0, 90.0])
    >>> forces["total"].dims, forces["froude_krylov"].sel(heading=0.0, mode="sway", part="cos").item() == 0.0
    (('heading', 'part', 'mode'), True)
    """
    import xarray as xr

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
    import xarray as xr

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
        "references": ", ".join(wave_source(ship, form).references),
    }


def _column(values: ArrayLike) -> Floats:
    return np.atleast_1d(np.asarray(values, dtype=float))

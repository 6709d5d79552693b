"""Added mass and damping of a ship over frequency, as labelled datasets: sway, roll and yaw; all six modes."""

from __future__ import annotations

import warnings
from typing import Literal, get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import MODES, REFERENCE_POINT, InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.hydro.manoeuvring.lift import hull_lift
from quartering.hydro.source.of_ship import source_of
from quartering.hydro.strip.integrals import moment_matrix
from quartering.hydro.strip.lateral import derivatives_from_moments, frequency_floor
from quartering.hydro.strip.six_modes import Axes, Reference, Terms, by_strips

LowFrequency = Literal["cap", "drop", "manoeuvring"]


@takes(ship="Ship")
def hydrodynamics(
    ship: Ship, frequency: ArrayLike, speed: float | str = 0.0, *, low_frequency: LowFrequency = "cap"
) -> xr.Dataset:
    """Added mass and damping of a ship in sway, roll and yaw over frequency, about G in body axes.

    Parameters
    ----------
    ship : Ship
    frequency : (f,) float    encounter frequency omega, >= 0 [rad/s]
    speed : float             U, >= 0 [m/s]
    low_frequency : str       "cap": the U/omega^2 terms use max(omega, 0.15 sqrt(g/B)); "drop": they are left out;
                              "manoeuvring": added mass of omega -> 0 at every frequency, no waves, and the damping is
                              the lift of Clarke's regression in place of all speed terms

    Returns
    -------
    Dataset    added_mass, damping (frequency, mode, mode_of_motion): minus the derivatives Y_vdot, .. and Y_v, ..; SI

    Raises
    ------
    InputError    a frequency or speed that is negative or not a number, an unknown low_frequency

    Notes
    -----
    No rigid-body terms, no viscous damping; the terms of the aft end are kept when the ship has a transom.
    Source: [STF70] lateral coefficients, rewritten for body axes.  Valid: slender ships, deep water.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = hydrodynamics(ship("wigley"), [0.6], speed=5.0)
    >>> ds.added_mass.dims, bool(ds.added_mass[0, 0, 0] > 0)
    (('frequency', 'mode', 'mode_of_motion'), True)
    """
    speed = number(ship, "speed", speed)
    omega = np.atleast_1d(numbers(ship, "frequency", frequency))
    if omega.ndim != 1:
        raise InputError(f"frequency of shape {omega.shape}; it is one list [rad/s]")
    if low_frequency not in get_args(LowFrequency):
        raise InputError(f'low_frequency "{low_frequency}" is unknown; allowed are "cap", "drop" and "manoeuvring"')
    damping, inertia = _ship_derivatives(ship, omega, float(speed), low_frequency)
    dims = ("frequency", "mode", "mode_of_motion")
    units = "SI: kg, kg m, kg m2 (over s for damping) between forces [N, N m] and velocities [m/s, rad/s]"
    return xr.Dataset(
        {
            "added_mass": (dims, -inertia, {"units": units, "symbol": "A", "long_name": "added mass"}),
            "damping": (dims, -damping, {"units": units, "symbol": "B", "long_name": "damping"}),
        },
        coords={
            "frequency": (
                "frequency",
                omega,
                {"units": "rad/s", "symbol": "omega", "long_name": "encounter frequency"},
            ),
            "mode": list(MODES),
            "mode_of_motion": list(MODES),
        },
        attrs=_attributes(ship, float(speed), low_frequency),
    )


def _ship_derivatives(ship: Ship, omega: Floats, speed: float, low_frequency: LowFrequency) -> tuple[Floats, Floats]:
    """Derivatives about G at the given frequencies, as the low-frequency option wants them."""
    source, manoeuvring = source_of(ship), low_frequency == "manoeuvring"
    wanted = np.zeros_like(omega) if manoeuvring else omega
    source.check(wanted)
    at = source.solved(wanted)
    if manoeuvring:
        return np.repeat(hull_lift(ship, [speed]), omega.size, axis=0), -moment_matrix(at.a)
    floor = frequency_floor(ship.hull.beam) if low_frequency == "cap" else np.inf
    return derivatives_from_moments(at.a, at.b, speed, omega, aft=at.aft, floor=floor)


def _attributes(ship: Ship, speed: float, low_frequency: LowFrequency) -> dict[str, str | float]:
    """What a dataset of hydrodynamic coefficients says of itself."""
    source = source_of(ship)
    references = ("STF70", *source.references, *(("Clarke83",) if low_frequency == "manoeuvring" else ()))
    return {
        "ship": ship.name,
        "speed": speed,
        "axes": "body axes: x to the bow, y to starboard, z down; modes sway, roll, yaw",
        "reference_point": REFERENCE_POINT,
        "density": ship.loading.density,
        "method": f"{source.method}; low frequencies: {low_frequency}",
        "references": ", ".join(dict.fromkeys(references)),
    }


@takes(ship="Ship")
def hydrodynamics6(
    ship: Ship,
    frequency: ArrayLike,
    speed: float | str = 0.0,
    *,
    reference: Reference | tuple[float, float] = "G",
    low_frequency: Terms = "cap",
    axes: Axes = "body",
    surge: Literal["spheroid", "zero"] = "spheroid",
) -> xr.Dataset:
    """Added mass and damping of a ship in surge, sway, heave, roll, pitch and yaw over frequency.

    Parameters
    ----------
    ship : Ship
    frequency : (f,) float    encounter frequency omega, not 0 [rad/s]; negative (the ship overtakes the wave) as |omega|
    speed : float             U, >= 0 [m/s]
    reference : str or (x, z) "G"; "waterline": the calm plane over G; or a point: x forward of midship, z below the
                              calm plane [m]
    low_frequency : str       "cap": the U/omega^2 terms use max(|omega|, 0.15 sqrt(g/B)); "drop": they are left out
    axes : str                "body", or "seakeeping": displacements in axes that move with the mean course
    surge : str               "spheroid": added mass of a prolate spheroid at the height of the centre of buoyancy, no
                              damping; "zero"

    Returns
    -------
    Dataset    added_mass, damping (frequency, mode, mode_of_motion); their limits *_zero and *_infinite (mode,
               mode_of_motion) for omega -> 0 (body axes only: in the others they do not exist) and -> infinity; SI,
               y to starboard and z down

    Raises
    ------
    InputError    a frequency that is 0 or not finite, a negative speed, an unknown option

    Warns
    -----
    RangeWarning  the ship has a database of its own, which is left out here

    Notes
    -----
    The terms of the aft end are kept when the ship has a transom. The added mass in heave grows like ln(1/omega): its
    limit at zero is infinite (and so are the couplings with pitch, unless fore and aft balance).
    Source: [STF70] with transom terms; surge: [Lamb32].  Valid: slender ships, deep water.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = hydrodynamics6(ship("wigley"), [0.6, -0.6], speed=5.0)
    >>> ds.added_mass.shape, bool((ds.damping[0] == ds.damping[1]).all())
    ((2, 6, 6), True)
    """
    source = source_of(ship)
    if source.kind != "strip":
        warnings.warn(
            f"{ship.name}: all six modes are by strips, and {source.words} is left out; `hydrodynamics` has its added mass and "
            "damping in sway, roll and yaw",
            RangeWarning,
            stacklevel=3,  # past the check of its arguments
        )
    return by_strips(ship, frequency, speed, reference, low_frequency, axes, surge)

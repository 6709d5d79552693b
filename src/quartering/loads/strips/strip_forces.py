"""Wave forces by strip theory: Froude-Krylov and diffraction of many conditions from the sections of a hull."""

from __future__ import annotations

from typing import Final, Literal, cast, get_args

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.lines.strips import Strips
from quartering.hydro.strip.table import SectionTable
from quartering.loads.strips.diffraction import contour_diffraction
from quartering.loads.strips.froude_krylov import froude_krylov
from quartering.loads.strips.relative_motion import relative_motion_diffraction
from quartering.loads.strips.stations import Stations
from quartering.loads.waves import Floats, Phasors, encounter_frequency, folded

Form = Literal["paper", "paper-corrected", "relative-motion", "stf"]

FORMS: Final[dict[str, str]] = {
    "paper": "strip correction with the printed sign of the wave slope, from section coefficients",
    "paper-corrected": "strip correction with the sign of the wave slope corrected, from section coefficients",
    "relative-motion": "consistent relative motion with forward speed, from section coefficients",
    "stf": "Salvesen, Tuck and Faltinsen: with forward speed, from the potentials on the section contours",
}
"""Diffraction form -> what it is."""


def checked_form(form: str) -> Form:
    """A form of the diffraction force, refused when it is none."""
    if form not in get_args(Form):
        raise InputError(f"form {form!r} given; allowed: {', '.join(FORMS)}; try 'stf'")
    return cast(Form, form)


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

    hull: section contours of the immersed hull
    place: the same sections seen from G
    table: section coefficients and potentials over frequency
    wavenumber (n,): k > 0 [1/m]
    speed (n,): U >= 0 [m/s]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    form: diffraction: "stf", "relative-motion", "paper-corrected" or "paper"
    density: of the water [kg/m3]
    speed_terms: keep the diffraction's terms with U, see `contour_diffraction`
    Returns froude_krylov (n, 3): sway [N/m], roll and yaw about G [N m/m]: phasors of e^{i |omega| t}; diffraction (n,
        3): the same; encounter_frequency (n,): omega, negative where the ship overtakes the wave [rad/s]; the force is
        Re{phasor e^{i |omega| t}}

    Source: [H71] eqs. (B-3)-(B-11); [STF70] exciting force.  Valid: deep water, linear wave, mean position.
    """
    checked_form(form)
    k, U, mu = (
        v.copy()
        for v in np.broadcast_arrays(*(np.atleast_1d(np.asarray(v, dtype=float)) for v in (wavenumber, speed, heading)))
    )
    if not (np.isfinite(k) & (k > 0)).all():
        raise InputError("a wave number that is not a positive number was given; k = 2 pi / length [1/m]")
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    pressure = froude_krylov(hull, place, k, mu, density=density)
    if form == "stf":
        scattered = contour_diffraction(place, table, k, U, mu, density=density, speed_terms=speed_terms)
    else:
        scattered = relative_motion_diffraction(hull, place, table, k, U, mu, form=form, speed_terms=speed_terms)
    return folded(omega, pressure)[1], folded(omega, scattered)[1], omega

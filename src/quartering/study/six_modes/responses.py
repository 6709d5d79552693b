"""Linear responses of a ship in all six modes in regular waves, as a labelled dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, HEADING_CONVENTION, InputError
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.loads.forces import form_words
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import Wave, encounter_frequency
from quartering.motion.six_modes import lateral_motion, vertical_motion
from quartering.study.dataset import attributes, made_by

Place = Sequence[float | str]

MODES: Final = {
    "surge": ("m", "surge of G, + forward", "eta1"),
    "sway": ("m", "sway of G, + to starboard", "eta2"),
    "heave": ("m", "heave of G, + down", "eta3"),
    "roll_amplitude": ("deg", "roll, + starboard side down", "eta4"),
    "pitch": ("deg", "pitch, + bow up", "eta5"),
    "yaw": ("deg", "yaw, + bow to starboard", "eta6"),
}
"""Name -> unit, meaning and symbol, in the order of the modes."""
_AXES: Final = ("x", "y", "z")


@takes(ship="Ship", wave="Wave")
def responses(
    ship: Ship,
    wave: Wave,
    speed: ArrayLike = 0.0,
    heading: ArrayLike = 180.0,
    gyradius_pitch: float | str | None = None,
    *,
    place: Place | None = None,
) -> xr.Dataset:
    """Linear motion of a ship in all six modes in one regular wave, for one or several speeds and headings.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : () or (u,) float      U >= 0 [m/s]
    heading : () or (h,) float    mu: 0 following, 90 beam, 180 head [deg]
    gyradius_pitch : float        k_yy without added mass [m]; None: that of the ship, 0.25 L where it was told none
    place : (x, y, height)        of accelerations: forward of midship, to starboard, over the baseline [m]; None: G

    Returns
    -------
    Dataset    amplitudes surge, sway, heave [m], roll_amplitude, pitch, yaw [deg] at G in axes that move with the mean course,
               each with .._phase [deg], its lead over the crest at G; acceleration_x, .._y, .._z of the place [m/s2], without
               gravity's share; encounter_frequency [rad/s].  NaN where the ship keeps pace with the wave

    Raises
    ------
    InputError    a number out of its range

    Warns
    -----
    RangeWarning  what `warn_of_conditions` finds

    Notes
    -----
    Heave and pitch by strip theory with the forces from the potentials on the contours; surge alone, undamped. Sway, roll and
    yaw are the ship's own equations with their products left out: no drag, and no damping that grows with the roll.
    Source: [STF70]; [H71] eq. (2), linear part.  Valid: small motions, deep water, slender ship.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = responses(ship("wigley"), Wave(length=2000.0, height=2.0), heading=[90.0, 180.0])
    >>> ds.heave.round(2).values.tolist()    # the ship follows the surface of a long wave
    [1.0, 1.0]
    """
    U, mu = numbers(ship, "speed", speed), numbers(ship, "heading", heading)
    if U.ndim > 1 or mu.ndim > 1:
        raise InputError(
            f"speed of shape {U.shape} and heading of shape {mu.shape} given; each may be a number or a list"
        )
    warn_of_conditions(ship, U, wave.length)
    found = response_grid(ship, [wave.length], np.atleast_1d(U), np.atleast_1d(mu), gyradius_pitch, place)
    scaled = found.isel(wave_length=0)
    for name in scaled.data_vars:
        if not str(name).endswith("_phase") and name != "encounter_frequency":
            scaled[name] = (wave.amplitude * scaled[name]).assign_attrs(scaled[name].attrs)
            scaled[name].attrs["units"] = str(scaled[name].attrs["units"]).removesuffix(" m-1")
    for name, values in (("speed", U), ("heading", mu)):
        scaled = scaled if values.ndim else scaled.isel({name: 0})
    return scaled.assign_attrs(wave_height=wave.height)


def response_grid(
    ship: Ship,
    lengths: Sequence[float],
    speeds: Floats,
    headings: Floats,
    gyradius_pitch: float | str | None = None,
    place: Place | None = None,
) -> xr.Dataset:
    """Responses per metre of wave amplitude over wave length, speed and heading.

    lengths: of the waves [m]
    speeds, headings (u,): [m/s], [deg]
    as for `responses`
    Returns (wave_length, speed, heading); variables as those of `responses`, units per metre

    >>> from quartering.hull.file.read import ship
    >>> dict(response_grid(ship("wigley"), [100.0, 200.0], np.zeros(1), np.array([90.0])).pitch.sizes)
    {'wave_length': 2, 'speed': 1, 'heading': 1}
    """
    kyy = ship.value("gyradius_pitch") if gyradius_pitch is None else number(ship, "gyradius_pitch", gyradius_pitch)
    grid = [part.ravel() for part in np.meshgrid(lengths, speeds, headings, indexing="ij")]
    shape = (len(lengths), speeds.size, headings.size)
    k, U, mu = 2 * np.pi / grid[0], grid[1], grid[2]
    vertical, lateral = vertical_motion(ship, k, U, mu, float(kyy)), lateral_motion(ship, k, U, mu)
    motion = np.stack([vertical[:, 0], lateral[:, 0], vertical[:, 1], lateral[:, 1], vertical[:, 2], lateral[:, 2]])
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    there, words = _lever(ship, place)
    dims = ("wave_length", "speed", "heading")
    fields: dict[str, Any] = {}
    for (name, (unit, meaning, symbol)), phasor in zip(MODES.items(), motion, strict=True):
        size = np.abs(phasor) if unit == "m" else np.degrees(np.abs(phasor))
        said = {"units": f"{unit} m-1", "long_name": f"amplitude of {meaning}, per metre of wave amplitude"}
        fields[name] = (dims, size.reshape(shape), {**said, "symbol": symbol})
        signed = np.where(omega < 0, np.conj(phasor), phasor)
        lead = {"units": "deg", "long_name": f"lead of {meaning} over the crest at G", "symbol": f"arg {symbol}"}
        fields[f"{name}_phase"] = (dims, np.degrees(np.angle(signed)).reshape(shape), lead)
    for axis, phasor in zip(_AXES, _accelerations(motion, omega, there), strict=True):
        said = {
            "units": "m s-2 m-1",
            "long_name": f"amplitude of acceleration along {axis} at {words}",
            "symbol": f"a_{axis}",
        }
        fields[f"acceleration_{axis}"] = (dims, np.abs(phasor).reshape(shape), said)
    fields["encounter_frequency"] = (dims, omega.reshape(shape), attributes("encounter_frequency"))
    coords = {
        name: (name, np.asarray(values, dtype=float), attributes(name))
        for name, values in zip(dims, (lengths, speeds, headings), strict=True)
    }
    return xr.Dataset(fields, coords, _heading(ship, float(kyy), gyradius_pitch is not None, words))


def _lever(ship: Ship, place: Place | None) -> tuple[tuple[float, float, float], str]:
    """Place from G, axes x forward, y to starboard, z down, and in words."""
    if place is None:
        return (0.0, 0.0, 0.0), "G"
    if not isinstance(place, (list, tuple, np.ndarray)) or len(place) != 3:
        raise InputError(
            f"place = {place!r}; it is x forward of midship, y to starboard and the height over the baseline, such as "
            '(0.4 * ship.hull.length, 0.0, 20.0) or ("0.4 L", "0 m", "20 m")'
        )
    x, y, height = (number(ship, "reference_x", one) for one in place)
    words = f"{x:.4g} m forward of midship, {y:.4g} m to starboard, {height:.4g} m over the baseline"
    return (x - hydrostatics(ship).lcb, y, ship.loading.kg - height), words


def _accelerations(motion: NDArray[np.complex128], omega: Floats, place: tuple[float, float, float]) -> Any:
    """Phasors of the acceleration of a place: -omega^2 (eta + rotation x place)."""
    surge, sway, heave, roll, pitch, yaw = motion
    x, y, z = place
    moved = (surge + pitch * z - yaw * y, sway + yaw * x - roll * z, heave + roll * y - pitch * x)
    return [-(omega**2) * one for one in moved]


def _heading(ship: Ship, kyy: float, given: bool, place: str) -> dict[str, Any]:
    """What a reader needs to know where the numbers come from."""
    told = given or "gyradius_pitch" in ship.particulars
    return {
        "title": f"Linear responses of {ship.name} in regular waves",
        "ship": ship.name,
        "loading": f"GM {ship.loading.gm:.4g} m, KG {ship.loading.kg:.4g} m, k_xx {ship.loading.gyradius_roll:.4g} m, "
        f"k_yy {kyy:.4g} m, k_zz {ship.loading.gyradius_yaw:.4g} m, added roll damping {ship.roll_damping_words}",
        "gyradius_pitch": kyy,
        "gyradius_pitch_source": "given" if told else "assumed: 0.25 L",
        "acceleration_place": place,
        "axes": "axes that move with the mean course: x forward, y to starboard, z down, origin at G; amplitudes are positive",
        "heading_convention": HEADING_CONVENTION,
        "surge": "added mass of a spheroid, in the wave force too, no damping, not coupled",
        "pitch_moment": "without the lever of the surge force, as in strip theory",
        "lateral_modes": "linear part of the ship's own equations, rudder amidships",
        "diffraction": f"sway, roll, yaw: {form_words(ship, 'stf')}; heave, pitch: from the heave potentials on the contours",
        "references": "STF70, Frank67, Lamb32, Taylor28, H71",
        "Conventions": "CF-1.8",
        "source": made_by(),
    }

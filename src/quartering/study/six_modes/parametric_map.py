"""Maps of parametric roll over speed and wave height in head or following seas: margin, growth and the roll itself."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import HEADING_CONVENTION, InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import STEEPEST
from quartering.motion.status import Status
from quartering.motion.steady_course.balance import Harmonics, doubled_harmonics, symmetric_harmonics
from quartering.motion.steady_course.course import Course, course, roll_inertia, warn_of_surge
from quartering.motion.steady_course.doubled import Doubled, doubled_branch, largest_roll, onsets
from quartering.motion.steady_course.orbits import climbed
from quartering.stability.averaged_roll import threshold
from quartering.stability.parametric import doubled_multipliers, roll_growth
from quartering.study.dataset import attributes, made_by
from quartering.study.six_modes.parametric_roll import whole_damping

Floats = NDArray[np.float64]

_VARIABLES: Final = {
    "growth": ("s-1", "growth of small roll, with sway and yaw"),
    "margin": ("1", "variation of GM over what roll alone needs to grow"),
    "gm_mean": ("m", "mean GM along heave and pitch"),
    "gm_first": ("m", "first harmonic of GM along heave and pitch, amplitude"),
    "roll_settled": ("deg", "largest roll of the stable motions of two wave periods; 0 where there is none"),
}


@takes(ship="Ship")
def parametric_map(
    ship: Ship,
    wave_length: float | str,
    wave_heights: Sequence[float | str],
    speeds: Sequence[float | str],
    heading: float | str = 180.0,
) -> xr.Dataset:
    """Parametric roll of a ship over speed and wave height, in head or following seas of one length.

    Parameters
    ----------
    ship : Ship
    wave_length : float        [m]
    wave_heights : (h,) float  above 0, rising [m]
    speeds : (u,) float        [m/s]
    heading : float            180 head or 0 following sea [deg]

    Returns
    -------
    Dataset    over speed and wave_height: growth [1/s], margin, gm_mean, gm_first [m], roll_settled [deg], and status (int8);
               NaN without a motion in heave and pitch, or where the ship keeps pace with the wave

    Raises
    ------
    InputError    another heading, heights that do not rise or break, a number out of its range

    Notes
    -----
    As `parametric_roll`.  Where small roll grows and no stable motion was found roll_settled is 0: the ship may capsize.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = parametric_map(ship("wigley"), 100.0, [0.5, 1.0], [3.0])
    >>> ds.growth.dims, bool((ds.growth < 0).all())
    (('speed', 'wave_height'), True)
    """
    length, mu = number(ship, "wave_length", wave_length), number(ship, "heading", heading)
    heights = np.atleast_1d(numbers(ship, "wave_height", wave_heights))
    U = np.atleast_1d(numbers(ship, "speed", speeds))
    if mu not in (0.0, 180.0):
        raise InputError(f"heading = {mu:g} deg; it is 180 (head) or 0 (following sea); try 180")
    if not (heights[0] > 0 and (np.diff(heights) > 0).all()):
        raise InputError(f"wave_heights = {heights.tolist()}; they are above 0 and rise; try [1, 2, 3]")
    if heights[-1] > STEEPEST * length:
        raise InputError(f"wave_height = {heights[-1]:g} m on {length:g} m; above 1/7 of its length a wave breaks")
    warn_of_conditions(ship, U, length)
    amplitudes = heights / 2
    many = course(ship, 2 * np.pi / length, np.full(U.size, amplitudes[0]), U, np.full(U.size, mu))
    warn_of_surge(many.at_amplitude(np.full(U.size, amplitudes[-1])))
    basis = doubled_harmonics()
    found = _on_the_motion(ship, many, amplitudes)
    rolls = np.full((U.size, heights.size), np.nan)
    for i in np.flatnonzero(~many.slow):
        rolls[i] = stable_rolls(many.rows(np.array([i])), amplitudes, basis)
    found["roll_settled"] = np.where(np.isfinite(found["growth"]), rolls, np.nan)
    dims = ("speed", "wave_height")
    fields: dict[str, Any] = {
        name: (dims, found[name], {"units": unit, "long_name": meaning}) for name, (unit, meaning) in _VARIABLES.items()
    }
    flags = np.array([one.value for one in Status], np.int8)
    said = {"flag_values": flags, "flag_meanings": " ".join(one.name for one in Status)}
    said |= {"units": "1", "long_name": "outcome of the search for heave and pitch"}
    fields["status"] = (dims, found["status"], said)
    coords = {name: (name, values, attributes(name)) for name, values in (("speed", U), ("wave_height", heights))}
    return xr.Dataset(fields, coords, _heading(ship, length, mu))


def _heading(ship: Ship, length: float, heading: float) -> dict[str, Any]:
    return {
        "title": f"Parametric roll of {ship.name}",
        "ship": ship.name,
        "loading": f"GM {ship.loading.gm:.4g} m, added roll damping {ship.roll_damping_words}",
        "ship_length": ship.hull.length,
        "wave_length": length,
        "heading": heading,
        "heading_convention": HEADING_CONVENTION,
        "references": "STF70",
        "source": made_by(),
    }


def _on_the_motion(ship: Ship, many: Course, amplitudes: Floats) -> dict[str, Any]:
    """Growth, margin and GM on the symmetric motions, (speeds, heights) each."""
    shape = (many.count, amplitudes.size)
    orbits = climbed(many, amplitudes, symmetric_harmonics())
    growth = roll_growth(orbits, 0.0)
    spectrum = np.fft.rfft(growth.gm, axis=1) / growth.gm.shape[1]
    mean, first = spectrum[:, 0].real, 2 * np.abs(spectrum[:, 1])
    omega = orbits.course.numbers.omega
    zeta = np.repeat([whole_damping(ship, float(u)) for u in many.speed], amplitudes.size)
    w0 = np.sqrt(many.numbers.scale.prod() * ship.loading.gm / roll_inertia(ship, 0.5 * omega))
    with np.errstate(invalid="ignore", divide="ignore"):
        at_mean = w0 * np.sqrt(mean / ship.loading.gm)
        margin = first / mean / threshold(omega / at_mean, zeta * w0 / at_mean)
    found = {"growth": growth.growth, "margin": margin, "gm_mean": mean, "gm_first": first, "status": orbits.status}
    return {name: np.asarray(values).reshape(shape) for name, values in found.items()}


def stable_rolls(one: Course, amplitudes: Floats, basis: Harmonics) -> Floats:
    """Largest stable roll of two periods of one condition at rising wave amplitudes [deg]; 0 where there is none."""
    top = float(amplitudes[-1])
    found = np.zeros(amplitudes.size)
    followed: list[Doubled] = []
    for onset in onsets(one, np.append(0.02 * amplitudes[0], amplitudes), basis):
        if any(abs(b.amplitude[-1] - onset[0]) < 0.02 * top and b.ends_small for b in followed):
            continue
        followed.append(doubled_branch(one, onset, 1.02 * top, basis))
        for k, amplitude in enumerate(amplitudes):
            x = followed[-1].at(float(amplitude))
            if len(x):
                steady = np.abs(doubled_multipliers(one.at_amplitude(amplitudes[[k]]), basis, x)).max(axis=1) < 1.0
                found[k] = max(found[k], *np.degrees(largest_roll(basis, x)) * steady)
    return found

"""Wave forces from a ship's own database: read between its frequencies and headings, moved to G, and given speed terms."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from quartering.conventions import GRAVITY, InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.immersed import strips
from quartering.hull.own_database import Database
from quartering.hydro.integrals import moment_matrix
from quartering.hydro.own_moments import check_frequencies, own_database, ship_moments
from quartering.hydro.transfer import transfer_matrix
from quartering.loads.froude_krylov import froude_krylov
from quartering.loads.stations import stations
from quartering.loads.waves import Floats, Phasors, encounter_frequency, folded

if TYPE_CHECKING:
    from quartering.hull.ship import Ship

FEWEST_HEADINGS = 4


class _Surfaces(NamedTuple):
    """Splines over wave frequency and heading of one force: cos and sin parts of sway, roll, yaw."""

    name: str
    parts: tuple[tuple[RectBivariateSpline, RectBivariateSpline], ...]

    def at(self, frequency: Floats, heading: Floats) -> Phasors:
        """Phasors (n, 3)."""
        columns = [re.ev(frequency, heading) + 1j * im.ev(frequency, heading) for re, im in self.parts]
        return np.stack(columns, axis=-1)


def database_force_phasors(
    ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, *, speed_terms: bool = True
) -> tuple[Phasors, Phasors, Floats]:
    """Froude-Krylov and diffraction force of many conditions from a ship's own database, per metre of wave amplitude.

    Parameters
    ----------
    ship : Ship                with a database that holds forces
    wavenumber : (n,) float    k > 0 [1/m]
    speed : (n,) float         U >= 0 [m/s]
    heading : (n,) float       mu: 0 following, 90 beam, 180 head [deg]
    speed_terms : bool         keep the term with U below, see `contour_diffraction`

    Returns
    -------
    froude_krylov, diffraction : (n, 3) complex    sway [N/m], roll and yaw about G [N m/m]: phasors of e^{i |omega| t}
    encounter_frequency : (n,)                     omega, negative where the ship overtakes the wave [rad/s]

    Raises
    ------
    InputError                 no forces in the database, a frequency or heading outside what it holds

    Notes
    -----
    The database is of zero speed. The pressure of the undisturbed wave does not feel the speed. The diffraction D0 at the
    wave frequency sigma is that of a hull moving with -W, W = C(sigma)^-1 D0/(i sigma), C = A + B/(i omega); at speed

        D = i omega C(|omega|, sign of omega) W,  and  N_D += U (C W)_1

    which are the speed terms of strip theory with the motion of the water averaged over the hull. A file with totals alone
    gives D0 as the total less the Froude-Krylov force of the ship's lines.
    Source: [STF70] exciting force at speed.  Valid: no aft terms; exact at zero speed, waves not short at speed.

    Examples
    --------
    See `quartering.wave_forces`.
    """
    omega = encounter_frequency(np.sqrt(GRAVITY * wavenumber), speed, heading)
    surfaces = _forces(ship)
    sigma, mu = _wave(wavenumber, heading)
    _check(ship, sigma, mu)
    port = np.where((heading + 180.0) % 360.0 - 180.0 < 0, -1.0, 1.0)[:, None]
    found = {one.name: port * _about_gravity_centre(ship, one.at(sigma, mu), wavenumber, mu) for one in surfaces}
    if "total" in found:
        density = ship.loading.density
        pressure = froude_krylov(strips(ship.hull), stations(ship), wavenumber, heading, density=density)
        at_rest = found["total"] - pressure
    else:
        pressure, at_rest = found["froude_krylov"], found["diffraction"]
    scattered = _at_speed(ship, at_rest, sigma, omega, speed, speed_terms)
    return folded(omega, pressure)[1], folded(omega, scattered)[1], omega


def _at_speed(ship: Ship, at_rest: Phasors, sigma: Floats, omega: Floats, speed: Floats, speed_terms: bool) -> Phasors:
    """Diffraction at speed from that at rest; what stays at rest is left as it is."""
    moving = np.flatnonzero(speed > 0.0)
    out = at_rest.copy()
    if moving.size:
        w, U = omega[moving], speed[moving]
        check_frequencies(ship, np.abs(w))
        motion = np.linalg.solve(_radiation(ship, sigma[moving]), at_rest[moving, :, None]) / (
            1j * sigma[moving, None, None]
        )
        slow = np.where(np.abs(w) > 0.0, w, 1.0)
        momentum = (_radiation(ship, slow) @ motion)[..., 0]
        out[moving] = 1j * w[:, None] * momentum
        if speed_terms:
            out[moving, 2] += U * momentum[:, 0]
    return out


def _radiation(ship: Ship, omega: Floats) -> Phasors:
    """C = A + B/(i omega) about G (n, 3, 3), omega of either sign."""
    z0 = ship.loading.kg - ship.hull.draught
    at = ship_moments(ship).at(np.abs(omega)).about(hydrostatics(ship).lcb, z0)
    return np.asarray(moment_matrix(at.a) + moment_matrix(at.b) / (1j * omega[:, None, None]))


def _about_gravity_centre(ship: Ship, force: Phasors, k: Floats, mu: Floats) -> Phasors:
    """Forces about midship at the calm plane, moved to G with the surface at G as reference of the phases."""
    x_g = hydrostatics(ship).lcb
    phase = np.exp(1j * k * x_g * np.cos(np.radians(mu)))
    return np.asarray(phase[:, None] * force @ transfer_matrix(-x_g, ship.loading.kg - ship.hull.draught))


def _forces(ship: Ship) -> tuple[_Surfaces, ...]:
    assert ship.database is not None
    return _surfaces(ship.database, ship.loading.density)


@lru_cache(maxsize=8)
def _surfaces(database: Database, density: float) -> tuple[_Surfaces, ...]:
    """Splines of every force of a database; at 0 and 180 deg the lateral forces vanish and go on with reversed sign."""
    own = own_database(database, density)
    if not own.at.forces:
        raise InputError(
            f"{database.source} holds no wave forces; add the forces of every heading wanted (Capytaine: Froude-Krylov and "
            "diffraction; WAMIT: the .3 file)"
        )
    if own.at.heading.size < FEWEST_HEADINGS:
        raise InputError(
            f"{database.source}: {own.at.heading.size} headings are too few to interpolate between; give at least "
            f"{FEWEST_HEADINGS}, closer than 15 deg for good forces"
        )
    found = []
    for name, force in own.at.forces.items():
        heading, values = _mirrored(own.at.heading, force)
        parts = tuple(
            (
                RectBivariateSpline(own.frequency, heading, values[..., k].real),
                RectBivariateSpline(own.frequency, heading, values[..., k].imag),
            )
            for k in range(3)
        )
        found.append(_Surfaces(name, parts))
    return tuple(found)


def _mirrored(heading: Floats, force: Phasors) -> tuple[Floats, NDArray[np.complex128]]:
    """Headings and forces continued beyond 0 and 180 deg, where the file reaches so far."""
    beyond = min(3, heading.size - 1)
    if np.isclose(heading[-1], 180.0):
        near = slice(-2, -2 - beyond, -1)
        heading = np.concatenate([heading, 360.0 - heading[near]])
        force = np.concatenate([force, -force[:, near]], axis=1)
    if np.isclose(heading[0], 0.0):
        near = slice(beyond, 0, -1)
        heading = np.concatenate([-heading[near], heading])
        force = np.concatenate([-force[:, near], force], axis=1)
    return heading, force


def waves_held(ship: Ship, wavenumber: Floats, heading: Floats) -> NDArray[np.bool_]:
    """Which waves a ship's own database holds the forces of; strips hold every one.

    Parameters
    ----------
    ship : Ship
    wavenumber : (n,) float    k > 0 [1/m]
    heading : (n,) float       mu, any turn [deg]

    Returns
    -------
    (n,) bool                  between the lowest and the highest frequency, and the first and the last heading, of the file

    Raises
    ------
    InputError                 what `own_database` refuses

    Notes
    -----
    Source: none; a check.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> waves_held(ship("wigley"), np.array([0.05]), np.array([30.0])).tolist()
    [True]
    """
    if ship.database is None:
        return np.ones(wavenumber.shape, dtype=bool)
    in_frequency, in_heading = _held(ship, *_wave(wavenumber, heading))
    return in_frequency & in_heading


def _wave(wavenumber: Floats, heading: Floats) -> tuple[Floats, Floats]:
    """Frequency at rest [rad/s] and heading folded to starboard, 0 to 180 [deg]."""
    return np.sqrt(GRAVITY * wavenumber), np.abs((heading + 180.0) % 360.0 - 180.0)


def _held(ship: Ship, sigma: Floats, mu: Floats) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which frequencies and which headings lie within those of the database."""
    assert ship.database is not None
    own = own_database(ship.database, ship.loading.density)
    heading, frequency = own.at.heading, own.frequency
    if heading.size == 0:
        return np.ones(sigma.shape, dtype=bool), np.ones(mu.shape, dtype=bool)  # no forces at all: `_surfaces` says so
    return (
        (sigma >= frequency[0] * (1 - 1e-9)) & (sigma <= frequency[-1] * (1 + 1e-9)),
        (mu >= heading[0] - 1e-9) & (mu <= heading[-1] + 1e-9),
    )


def _check(ship: Ship, sigma: Floats, mu: Floats) -> None:
    """Refuse waves and headings the database does not hold."""
    assert ship.database is not None
    own = own_database(ship.database, ship.loading.density)
    heading, frequency = own.at.heading, own.frequency
    in_frequency, in_heading = _held(ship, sigma, mu)
    if not in_frequency.all():
        short, long = (2 * np.pi * GRAVITY / w**2 for w in (frequency[-1], frequency[0]))
        worst = sigma[~in_frequency][0]
        raise InputError(
            f"{ship.name}: {ship.database.name} holds wave frequencies {frequency[0]:.4g} to {frequency[-1]:.4g} rad/s (waves "
            f"of {short:.4g} to {long:.4g} m), and {worst:.4g} rad/s ({2 * np.pi * GRAVITY / worst**2:.4g} m) is asked for; "
            "ask for waves between these, or compute further"
        )
    if not in_heading.all():
        raise InputError(
            f"{ship.name}: {ship.database.name} holds headings {heading[0]:g} to {heading[-1]:g} deg, and "
            f"{mu[~in_heading][0]:g} deg is asked for; compute that heading too (0 is a following sea: minus the direction "
            "of the file), or leave it out"
        )

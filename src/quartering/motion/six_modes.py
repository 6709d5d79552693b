"""Linear motion of a ship in all six modes: surge, heave and pitch by strip theory beside sway, roll and yaw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.ship import Ship
from quartering.hydro.strip.heave import heave_table
from quartering.hydro.strip.lateral import frequency_floor
from quartering.hydro.strip.six_mode_matrices import seakeeping_axes, section_matrix, six_mode_matrices
from quartering.hydro.strip.surge import spheroid_surge
from quartering.loads.strips.interpolation import frequency_weights, interpolated
from quartering.loads.strips.stations import stations
from quartering.loads.strips.vertical import vertical_forces
from quartering.loads.waves import encounter_frequency, least_encounter_frequency
from quartering.motion.of_ship import ship_system

Floats = NDArray[np.float64]
Phasors = NDArray[np.complex128]


def vertical_motion(ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, gyradius_pitch: float) -> Phasors:
    """Surge, heave and pitch of a ship in many regular waves, per metre of wave amplitude.

    wavenumber (n,): k > 0 [1/m]
    speed (n,): U >= 0 [m/s]
    heading (n,): mu: 0 following, 180 head [deg]
    gyradius_pitch: k_yy without added mass [m]
    Returns (n, 3): surge and heave of G, + down [m/m], and pitch, + bow up [rad/m], in axes that move with the mean
        course: phasors of e^{i omega t}, omega the signed encounter frequency, of a crest at G at t = 0; NaN where the
        ship keeps pace with the wave

    [-w^2 (M + A) + i w B + C] eta = F in heave and pitch; surge alone, with a spheroid's added mass, no damping.
    C33 = rho g int b dx, C35 = -rho g int x b dx, C55 = rho g int x^2 b dx - rho g V (KG - KB).
    Source: [STF70]; surge [Lamb32].  Valid: small motions, slender ship.
    """
    k, U, mu = (np.asarray(v, dtype=float) for v in np.broadcast_arrays(wavenumber, speed, heading))
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    force = np.sum(vertical_forces(ship, k, U, mu), axis=0)
    mass, damping, stiffness = vertical_system(ship, omega, U, gyradius_pitch)
    w = omega[:, None, None]
    slow = np.abs(omega) < least_encounter_frequency(ship.hull.length)
    impedance = -(w**2) * mass + 1j * w * damping + stiffness
    impedance[slow] = np.eye(3)
    motion = np.linalg.solve(impedance, force[:, :, None])[..., 0]
    motion[slow] = np.nan
    return np.asarray(motion)


def vertical_system(ship: Ship, omega: Floats, speed: Floats, gyradius_pitch: float) -> tuple[Floats, Floats, Floats]:
    """Mass with added mass, damping and stiffness in surge, heave and pitch about G, at signed encounter frequencies.

    omega, speed (n,): [rad/s], [m/s]
    gyradius_pitch: [m]
    Returns mass, damping (n, 3, 3): [kg, kg m, kg m2; over s]; stiffness (3, 3): [N/m, N, N m]
    """
    place, immersed, water = stations(ship), strips(ship.hull), hydrostatics(ship)
    density, weight = ship.loading.density, ship.loading.density * GRAVITY
    table = heave_table(ship.hull, density)
    first, lagrange = frequency_weights(table.frequency, np.abs(omega))
    a, b = (interpolated(part, first, lagrange).real for part in (table.a, table.b))
    still = np.zeros((omega.size, place.x.size, 3))
    sections = section_matrix(still, a), section_matrix(still, b)
    floor, x_aft = frequency_floor(ship.hull.beam), place.x_aft if place.transom else None
    added, damping = np.zeros((omega.size, 6, 6)), np.zeros((omega.size, 6, 6))
    for one in np.unique(speed):
        at = speed == one
        found = six_mode_matrices(
            place.x, place.weight, sections[0][at], sections[1][at], float(one), omega[at], x_aft=x_aft, floor=floor
        )
        added[at], damping[at] = seakeeping_axes(*found, float(one), np.maximum(np.abs(omega[at]), floor))
    mass, damping = added[:, ::2, ::2].copy(), damping[:, ::2, ::2].copy()
    own = density * water.volume
    mass += np.diag([own * (1 + spheroid_surge(ship.hull.length, water.volume)), own, own * gyradius_pitch**2])
    breadth = 2 * immersed.half_breadth * place.weight
    area, first_moment, second = (float(breadth @ place.x**power) for power in range(3))
    tilt = second - water.volume * (ship.loading.kg - water.kb)
    stiffness = weight * np.array([[0, 0, 0], [0, area, -first_moment], [0, -first_moment, tilt]])
    return mass, damping, stiffness


def lateral_motion(ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats) -> Phasors:
    """Sway, roll and yaw of a ship in many regular waves, per metre of wave amplitude, from its linear equations.

    as in `vertical_motion`

    Returns (n, 3): sway of G [m/m], roll and yaw [rad/m], in axes that move with the mean course; phasors as those of
        `vertical_motion`

    The equations of `equations` with their products left out, rudder amidships; d eta2/dt = v + U psi.
    Source: [H71] eq. (2), linear part.

    Roll in a long beam wave is its slope.

    >>> from quartering.hull.file.read import ship
    >>> roll = lateral_motion(ship("wigley"), np.array([5e-4]), np.zeros(1), np.array([90.0]))[0, 1]
    >>> round(float(abs(roll) / 5e-4), 1)
    1.0
    """
    k, U, mu = (np.ascontiguousarray(v, dtype=float) for v in np.broadcast_arrays(wavenumber, speed, heading))
    found = ship_system(replace(ship, autopilot=None), k, U, mu)
    system, signed = found.system, found.encounter_frequency
    w = np.abs(signed)
    linear = system.linear
    matrix = np.zeros((w.size, 4, 4), dtype=complex)
    matrix[:, [0, 2, 3]] = -linear[:, :, :4]
    matrix[:, 1, 2] = -1.0
    matrix[:, range(4), range(4)] += 1j * w[:, None]
    force = np.zeros((w.size, 4), dtype=complex)
    force[:, [0, 2, 3]] = system.cos - 1j * system.sin
    usable = np.isfinite(matrix).all(axis=(1, 2)) & ~found.slow
    matrix[~usable] = np.eye(4)
    state = np.linalg.solve(matrix, force[:, :, None])[..., 0]
    yaw = state[:, 3] / (1j * np.where(usable, w, 1.0))
    sway = (state[:, 0] + U * yaw) / (1j * np.where(usable, w, 1.0))
    motion = np.stack([sway, state[:, 1], yaw], axis=1)
    motion[~usable] = np.nan
    # there the surface at G passes its mean level on the way down at t = 0, and omega is its modulus
    return np.where(signed[:, None] < 0, np.conj(motion), motion) / 1j

"""Diffraction force from section coefficients alone: the section moves against an averaged wave motion."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY
from quartering.hull.lines.strips import Strips
from quartering.hydro.strip.integrals import about_gravity_centre
from quartering.hydro.strip.table import SectionTable
from quartering.loads.strips.interpolation import frequency_weights, interpolated
from quartering.loads.strips.stations import Stations
from quartering.loads.waves import Floats, Phasors, encounter_frequency, heading_components

RelativeForm = Literal["paper", "paper-corrected", "relative-motion"]


def relative_motion_diffraction(
    strips: Strips,
    stations: Stations,
    table: SectionTable,
    wavenumber: ArrayLike,
    speed: ArrayLike,
    heading: ArrayLike,
    *,
    form: RelativeForm,
    speed_terms: bool = True,
) -> Phasors:
    """Diffraction force of many conditions from added mass and damping of the sections, per metre of wave amplitude.

    strips: section contours, for the averages of the wave motion
    stations: the same sections seen from G
    table: section coefficients about the waterline point, over frequency
    wavenumber (n,): k > 0 [1/m]
    speed (n,): U >= 0 [m/s]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    form: "paper" (as printed), "paper-corrected" (sign of the wave slope) or "relative-motion"
    speed_terms: keep the terms with U of "relative-motion", see `contour_diffraction`
    Returns (n, 3): phasors of e^{i omega t}, omega the signed encounter frequency: sway [N/m], roll and yaw about G [N
        m/m]

    With <e^{-m k zeta} cos k2 y> the average over the section area and sinc = sin(k2 b)/(k2 b) over the waterline:
    "paper": u = i s sin(d) <m=1>, slope a = +k sin(d) sinc, Y' = (b22 + i s a22) u + (i s b24 - s^2 a24) a, K' in the
    same way, N' = x Y', with coefficients about G; s is the wave frequency, and the forward speed enters only through
    the frequency of the coefficients. "paper-corrected": a = -k sin(d) sinc, the surface's own slope across the ship.
    "relative-motion": V2 = i s sin(d) <m=2>, V4 = -i s k sin(d) sinc, m_i = sum (a_ij + b_ij/(i w)) V_j and

        Y = i w int m2 dx + U m2(x_A),  K likewise with m4,  N = int (i w x + U) m2 dx + U x_A m2(x_A)

    about the waterline point, then K about G = K - z0 Y.
    Source: [H71] eqs. (B-5)-(B-11), with 2 sigma A/(k a) in (B-11); [STF70] for the speed terms.
    Valid: deep water; half breadth below about 0.3/k (the wave is long against the section).
    """
    k, U, mu = np.broadcast_arrays(*(np.asarray(v, dtype=float)[..., None] for v in (wavenumber, speed, heading)))
    along, across = heading_components(mu)
    sigma, consistent = np.sqrt(GRAVITY * k), form == "relative-motion"
    omega = encounter_frequency(sigma, U, mu)
    slope = -k * across * np.sinc(k * across * strips.half_breadth / np.pi)
    sway = 1j * sigma * across * section_average(strips, k[:, 0], mu[:, 0], depth_factor=2.0 if consistent else 1.0)
    roll = 1j * sigma * (-slope if form == "paper" else slope)
    first, weights = frequency_weights(table.frequency, np.abs(omega[:, 0]))
    if consistent:
        mass = interpolated(_complex_mass(table.frequency, table.a, table.b), first, weights)
        mass = np.where(omega[..., None] < 0, mass.conj(), mass)
        phasors = _along_ship(
            stations, _momentum(mass, sway, roll), k * along, omega, U if speed_terms else np.zeros_like(U)
        )
        phasors[:, 1] -= stations.z0 * phasors[:, 0]
        return phasors
    a, b = (about_gravity_centre(values, stations.z0) for values in (table.a, table.b))
    mass = interpolated(_complex_mass(table.frequency, a, b), first, weights)
    mass = mass.real + 1j * (np.abs(omega) / sigma)[..., None] * mass.imag
    return _along_ship(stations, _momentum(mass, sway, roll), k * along, sigma, np.zeros_like(U))


def section_average(strips: Strips, wavenumber: ArrayLike, heading: ArrayLike, *, depth_factor: float = 1.0) -> Floats:
    """Average of e^{-m k zeta} cos(k2 y) over each immersed section area, for many waves.

    strips: section contours, s of them
    wavenumber (n,): k > 0 [1/m]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    depth_factor: m: 1 as the paper averages, 2 for the consistent relative motion [1]
    Returns (n, s): averages, at most 1 [1]

    The area integral over y is done: int e^{-m k zeta} cos(k2 y) dA = -2 int e^{-m k zeta} y sinc(k2 y) dz along the
    starboard contour, keel to waterline. A section without breadth takes the average over its depth.
    Source: [H71] eq. (B-11).  Valid: port-starboard symmetry.
    """
    k = np.asarray(wavenumber, dtype=float)
    k2 = k * heading_components(heading)[1]
    average = np.ones((k.size, strips.x.size))
    for s in range(strips.x.size):
        breadth = (
            strips.y[s] if strips.y[s] @ -strips.dz[s] > 1e-9 * strips.draught[s] ** 2 else np.ones_like(strips.y[s])
        )
        share = -breadth * strips.dz[s]
        if share.sum() > 0:
            field = np.exp(-depth_factor * np.outer(k, strips.z[s])) * np.sinc(np.outer(k2, strips.y[s]) / np.pi)
            average[:, s] = (field * (share / share.sum())).sum(axis=1)  # row by row, see `rowwise`
    return average


def _complex_mass(frequency: Floats, a: Floats, b: Floats) -> Phasors:
    """Added mass and damping (f, s, 3) as one number a + b/(i w); its limit a at zero frequency."""
    w = frequency[:, None, None]
    return a - 1j * np.divide(b, w, out=np.zeros_like(b), where=w > 0)


def _momentum(mass: Phasors, sway: Phasors, roll: Phasors) -> tuple[Phasors, Phasors]:
    """Sway and roll momentum of the water that a section's motion relative to the wave sets in motion, (n, s)."""
    return mass[..., 0] * sway + mass[..., 1] * roll, mass[..., 1] * sway + mass[..., 2] * roll


def _along_ship(
    stations: Stations, momentum: tuple[Phasors, Phasors], k1: Floats, rate: Floats, speed: Floats
) -> Phasors:
    """Integrate (i rate - U d/dx) of the momentum along the ship, by parts: (n, 3)."""
    m2, m4 = momentum
    x, w, U = stations.x, 1j * rate, speed
    wave = np.exp(1j * k1 * x) * stations.weight
    end = float(stations.transom) * U[:, 0] * np.exp(1j * k1[:, 0] * stations.x_aft)
    Y = np.sum(w * m2 * wave, axis=1) + end * m2[:, 0]
    K = np.sum(w * m4 * wave, axis=1) + end * m4[:, 0]
    N = np.sum((w * x + U) * m2 * wave, axis=1) + end * stations.x_aft * m2[:, 0]
    return np.stack([Y, K, N], axis=1)

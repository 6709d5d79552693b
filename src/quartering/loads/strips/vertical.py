"""Linear wave force in surge, heave and pitch by strip theory: Froude-Krylov, and diffraction."""

from __future__ import annotations

import cmath
import math

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import kernel
from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.ship import Ship
from quartering.hydro.strip.heave import heave_table
from quartering.hydro.strip.surge import spheroid_surge
from quartering.loads.strips.interpolation import frequency_weights
from quartering.loads.strips.stations import stations
from quartering.loads.waves import Floats, Phasors, encounter_frequency, heading_components


def vertical_forces(ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats) -> tuple[Phasors, Phasors]:
    """Wave force in surge and heave and wave moment in pitch of many conditions, per metre of wave amplitude.

    wavenumber (n,): k > 0 [1/m]
    speed (n,): U >= 0 [m/s]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    Returns froude_krylov, diffraction (n, 3): phasors of e^{i omega t}, omega the signed encounter frequency, of a
        crest at G at t = 0: surge [N/m] and heave, + down [N/m], pitch about G, + bow up [N m/m]

    With G3(x) = rho int psi3 (u.n) ds, u the orbital velocity on the contour and x_A the aft end of a transom,

        Z = -i w int G3 dx - U G3(x_A),  M = int (i w x + U) G3 dx + U x_A G3(x_A)

    A body in a stream that changes along it is pushed as the water it displaces is, and as its added mass of water besides:
    diffraction in surge is k1 times the Froude-Krylov force, k1 of `spheroid_surge`, and a long wave carries a ship as far
    along as it carries the water. The lever of the surge force is left out of the pitch moment, as in strip theory.
    Source: [STF70] exciting force; [Taylor28] surge.  Valid: deep water, slender ship.
    """
    k, U, mu = (np.ascontiguousarray(v, dtype=float) for v in np.broadcast_arrays(wavenumber, speed, heading))
    place, hull, density = stations(ship), strips(ship.hull), ship.loading.density
    table = heave_table(ship.hull, density)
    ahead, across = heading_components(mu)
    sigma = np.sqrt(GRAVITY * k)
    omega = encounter_frequency(sigma, U, mu)
    waves = np.stack([k, k * ahead, across, sigma, omega, U], axis=1)
    pressure = density * GRAVITY * _pressure(place.x, place.weight, hull.y, hull.z, hull.dy, waves)
    first, weights = frequency_weights(table.frequency, np.abs(omega))
    scattered = 2.0 * density * _scattered(
        place.x, place.weight, table.y, table.z, table.ny, table.nz, table.psi, first, weights, waves,
        place.x_aft, float(place.transom),
    )  # fmt: skip
    scattered[:, 0] = spheroid_surge(ship.hull.length, hydrostatics(ship).volume) * pressure[:, 0]
    return pressure, scattered


# A wave that has its crest at G at t = 0 is eta = Re a e^{i (omega t + k1 x - k2 y)}, k1 = -k cos mu, k2 = k sin mu. Its
# pressure is rho g a e^{-kz}; the contour runs from the keel to the waterline, so the force up is the integral of p dy. Along
# the ship  X = -int int dp/dx dA,  where the area integral of e^{-kz} at one breadth is (1 - e^{-kz})/k of the contour's depth.
@kernel
def _pressure(x: Floats, weight: Floats, y: Floats, z: Floats, dy: Floats, waves: Floats) -> Phasors:
    """Surge, heave and pitch of the undisturbed wave, over density and gravity."""
    out = np.zeros((waves.shape[0], 3), dtype=np.complex128)
    for n in range(waves.shape[0]):
        k, k1, across = waves[n, 0], waves[n, 1], waves[n, 2]
        for s in range(x.size):
            up = along = 0.0
            for p in range(y.shape[1]):
                decay, side = math.exp(-k * z[s, p]), 2.0 * math.cos(k * across * y[s, p]) * dy[s, p]
                up += side * decay
                along += side * (1.0 - decay) / k
            wave = cmath.exp(1j * k1 * x[s]) * weight[s]
            out[n, 0] -= 1j * k1 * wave * along
            out[n, 1] -= wave * up
            out[n, 2] += x[s] * wave * up
    return out


@kernel
def _scattered(
    x: Floats, weight: Floats, y: Floats, z: Floats, ny: Floats, nz: Floats, psi: Phasors,
    first: NDArray[np.int64], lagrange: Floats, waves: Floats, x_aft: float, transom: float,
) -> Phasors:  # fmt: skip
    """Diffraction per (2 rho amplitude); the orbital velocity of the wave is -i sigma e^{-kz} down, sigma e^{-kz} along it."""
    out = np.zeros((waves.shape[0], 3), dtype=np.complex128)
    for n in range(waves.shape[0]):
        k, k1, across, sigma, omega, U = waves[n]
        for s in range(x.size):
            g3 = 0.0j
            for p in range(y.shape[1]):
                t = k * across * y[s, p]
                normal = math.exp(-k * z[s, p]) * (math.cos(t) * nz[s, p] + across * math.sin(t) * ny[s, p])
                for q in range(lagrange.shape[1]):
                    g3 += lagrange[n, q] * normal * psi[first[n] + q, s, p]
            if omega < 0:
                g3 = g3.conjugate()
            wave = -1j * sigma * cmath.exp(1j * k1 * x[s]) * weight[s]
            out[n, 1] -= 1j * omega * wave * g3
            out[n, 2] += (1j * omega * x[s] + U) * wave * g3
            if s == 0:
                end = -1j * sigma * U * transom * cmath.exp(1j * k1 * x_aft) * g3
                out[n, 1] -= end
                out[n, 2] += x_aft * end
    return out

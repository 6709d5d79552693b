"""Diffraction force by strip theory from the potentials on the section contours (Salvesen, Tuck, Faltinsen)."""

from __future__ import annotations

import cmath
import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.compiled import summing
from quartering.conventions import GRAVITY, WATER_DENSITY
from quartering.hydro.strip.table import SectionTable
from quartering.loads.strips.interpolation import frequency_weights
from quartering.loads.strips.stations import Stations
from quartering.loads.waves import Floats, Phasors, encounter_frequency, heading_components


def contour_diffraction(
    stations: Stations,
    table: SectionTable,
    wavenumber: ArrayLike,
    speed: ArrayLike,
    heading: ArrayLike,
    *,
    density: float = WATER_DENSITY,
    speed_terms: bool = True,
) -> Phasors:
    """Diffraction sway force, roll moment and yaw moment of many conditions, per metre of wave amplitude.

    stations: positions, weights and aft end
    table: radiation potentials on the section contours, over frequency
    wavenumber (n,): k > 0 [1/m]
    speed (n,): U >= 0 [m/s]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    density: of the water [kg/m3]
    speed_terms: keep the terms with U; without them the speed acts through the encounter frequency alone
    Returns (n, 3): phasors of e^{i omega t}, omega the signed encounter frequency: sway [N/m], roll and yaw about G [N
        m/m]

    With G_j(x) = rho int psi_j (u.n) ds, u the wave's orbital velocity on the contour and x_A the aft end,

        Y = -i w int G2 dx - U G2(x_A),  K likewise with G4,  N = -int (i w x + U) G2 dx - U x_A G2(x_A)

    (the derivative along the ship is integrated by parts), then K about G = K - z0 Y. For w < 0 the potentials of |w|
    are conjugated. Every term with U has its twin among the derivatives of strip theory (N_v, N_p, N_r and those of the aft
    end); where lift takes the place of those, the terms here go too.
    Source: [STF70] exciting force, body axes x forward, z down.  Valid: deep water, slender ship, and w sqrt(B/g) not
    small when U > 0 (the speed terms assume that the section's wave is short against the ship).
    """
    k, U, mu = (a.copy() for a in np.broadcast_arrays(*(np.asarray(v, float) for v in (wavenumber, speed, heading))))
    along, across = heading_components(mu)
    sigma = np.sqrt(GRAVITY * k)
    omega = encounter_frequency(sigma, U, mu)
    first, weights = frequency_weights(table.frequency, np.abs(omega))
    waves = np.stack([k, k * along, across, sigma, omega, U if speed_terms else np.zeros_like(U)], axis=1)
    s = stations
    forces: Phasors = _contour_forces(
        s.x, s.weight, table.y, table.z, table.ny, table.nz, table.psi, first, weights, waves,
        s.x_aft, float(s.transom),
    )  # fmt: skip
    forces[:, 1] -= s.z0 * forces[:, 0]
    return 2.0 * density * forces


@summing
def _contour_forces(
    x: Floats, weight: Floats, y: Floats, z: Floats, ny: Floats, nz: Floats, psi: Phasors,
    first: NDArray[np.int64], lagrange: Floats, waves: Floats, x_aft: float, transom: float,
) -> Phasors:  # fmt: skip
    """Forces per (2 rho amplitude) about the waterline point; waves (n, 6) are k, k1, sin delta, sigma, omega, U."""
    out = np.zeros((waves.shape[0], 3), dtype=np.complex128)
    decay, normal, of = np.empty_like(y), np.empty(y.shape[1]), -1.0
    for n in range(waves.shape[0]):
        k, k1, across, sigma, omega, U = waves[n]
        if k != of:  # waves of one length, from several sides, decay alike with depth
            of = k
            for s in range(x.size):
                for p in range(y.shape[1]):
                    decay[s, p] = math.exp(-k * z[s, p])
        for s in range(x.size):
            g2 = g4 = 0.0j
            for p in range(y.shape[1]):
                t = k * across * y[s, p]
                normal[p] = decay[s, p] * (across * math.cos(t) * ny[s, p] - math.sin(t) * nz[s, p])
            for q in range(lagrange.shape[1]):
                a2 = b2 = a4 = b4 = 0.0
                for p in range(y.shape[1]):
                    sway, roll = psi[first[n] + q, s, p, 0], psi[first[n] + q, s, p, 1]
                    a2 += normal[p] * sway.real
                    b2 += normal[p] * sway.imag
                    a4 += normal[p] * roll.real
                    b4 += normal[p] * roll.imag
                g2 += lagrange[n, q] * complex(a2, b2)
                g4 += lagrange[n, q] * complex(a4, b4)
            if omega < 0:
                g2, g4 = g2.conjugate(), g4.conjugate()
            wave = 1j * sigma * cmath.exp(1j * k1 * x[s]) * weight[s]
            out[n, 0] -= 1j * omega * wave * g2
            out[n, 1] -= 1j * omega * wave * g4
            out[n, 2] -= (1j * omega * x[s] + U) * wave * g2
            if s == 0:
                end = U * transom * 1j * sigma * cmath.exp(1j * k1 * x_aft)
                out[n, 0] -= end * g2
                out[n, 1] -= end * g4
                out[n, 2] -= end * x_aft * g2
    return out

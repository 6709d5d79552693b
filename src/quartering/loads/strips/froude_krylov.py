"""Froude-Krylov force: the pressure of the undisturbed wave on the hull, from the section contours."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quartering._machine.compiled import inlined, kernel
from quartering.conventions import GRAVITY, WATER_DENSITY
from quartering.hull.lines.strips import Strips
from quartering.loads.strips.stations import Stations
from quartering.loads.waves import Floats, Phasors, heading_components


def froude_krylov(
    strips: Strips,
    stations: Stations,
    wavenumber: ArrayLike,
    heading: ArrayLike,
    *,
    density: float = WATER_DENSITY,
) -> Phasors:
    """Froude-Krylov sway force, roll moment and yaw moment of many waves, per metre of wave amplitude.

    strips: section contours; their place along the ship is read from stations
    stations: the same sections seen from G
    wavenumber (n,): k > 0 [1/m]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    density: of the water [kg/m3]
    Returns (n, 3): phasors of e^{i omega t}, omega the signed encounter frequency: sway [N/m], roll and yaw about G [N
        m/m]

    Per section, with the starboard contour from keel to waterline, zeta the depth and P = i rho g e^{i k1 x}:

        Y' = 2 rho g e^{i k1 x} int e^{-k zeta} sin(k2 y) dz
        K' = -2 rho g e^{i k1 x} int e^{-k zeta} sin(k2 y) (y dy + (zeta + z0) dz)
        N' = x Y' - 2 i k1 rho g e^{i k1 x} int e^{-k zeta} J(y) dz,   J(y) = int_0^y t sin(k2 t) dt

    The last integral is the pressure on the tapering ends (n_x), turned into a section integral by Gauss's theorem, so
    bow, stern and a transom below water are all counted as wetted.
    Source: [H71] eq. (B-3), equal to (B-4).  Valid: deep water, linear wave, mean position, port-starboard symmetry.
    """
    k, mu = np.broadcast_arrays(np.asarray(wavenumber, dtype=float), np.asarray(heading, dtype=float))
    along, across = heading_components(mu)
    hull, x, weight, z0 = strips, stations.x, stations.weight, stations.z0
    phasors: Phasors = _pressure_integrals(
        x, weight, hull.y, hull.z, hull.dy, hull.dz, k.copy(), k * along, k * across, z0
    )
    return density * GRAVITY * phasors


@kernel
def _pressure_integrals(
    x: Floats,
    weight: Floats,
    y: Floats,
    z: Floats,
    dy: Floats,
    dz: Floats,
    wavenumber: Floats,
    along: Floats,
    across: Floats,
    z0: float,
) -> Phasors:
    """Force per (rho g amplitude) of each condition: (n, 3) complex; x from G, k1 = along, k2 = across [1/m]."""
    out, decays, of = np.zeros((wavenumber.size, 3), dtype=np.complex128), np.empty_like(y), -1.0
    for n in range(wavenumber.size):
        k, k1, k2 = wavenumber[n], along[n], across[n]
        if k != of:  # waves of one length, from several sides, decay alike with depth
            of = k
            for s in range(x.size):
                for p in range(y.shape[1]):
                    decays[s, p] = math.exp(-k * z[s, p])
        # Port and starboard together: e^{i k2 y} - e^{-i k2 y} leaves 2 i sin(k2 y), whose i stands in the phasor P of the
        # docstring. The lever of roll is y dy + (zeta + z0) dz; J(y) of the tapering ends is k2 y^3 _lid(k2 y).
        for s in range(x.size):
            sway = roll = taper = 0.0
            for p in range(y.shape[1]):
                t = k2 * y[s, p]
                decay, sine = decays[s, p], math.sin(t)
                sway += decay * sine * dz[s, p]
                roll -= decay * sine * (y[s, p] * dy[s, p] + (z[s, p] + z0) * dz[s, p])
                taper += decay * k2 * y[s, p] ** 3 * _lid(t, sine) * dz[s, p]
            phase = 2.0 * weight[s] * complex(math.cos(k1 * x[s]), math.sin(k1 * x[s]))
            out[n, 0] += phase * sway
            out[n, 1] += phase * roll
            out[n, 2] += phase * complex(x[s] * sway, -k1 * taper)
    return out


@inlined
def _lid(t: float, sine: float) -> float:
    """Value of (sin t - t cos t)/t^3, by its series where the difference would cancel."""
    if abs(t) < 0.3:
        q = t * t
        return 1.0 / 3.0 - q * (1.0 / 30.0 - q * (1.0 / 840.0 - q * (1.0 / 45360.0 - q / 3991680.0)))
    return (sine - t * math.cos(t)) / t**3

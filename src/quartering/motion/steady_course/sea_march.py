"""Motion in time in the pressure of a sum of waves over the instantaneous wetted hull: compiled Runge-Kutta steps.

The load is that of one wave, `table_load`, with the surface and its slopes summed over the waves. Their decay with depth is
taken by bands of the wave number, each with tables of its own: load = F1(s, chi) + sum over bands of eta_b F2(s, chi; k_b).
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel, summing
from quartering._machine.simd import LANES
from quartering.loads.wetted_hull.section_tables import section_share, spline_at
from quartering.motion.steady_course.march import AFLOAT, CAPSIZED, UNDER, motion_rates
from quartering.motion.steady_course.pressure_and_drag import add_products

Floats = NDArray[np.float64]


class Components(NamedTuple):
    """Waves of a sea that meet a ship.

    Parameters
    ----------
    amplitude, omega, phase : (n,)  [m]; modulus of the encounter frequency [rad/s]; at time 0, a crest at G where it is 0 [rad]
    wave : (n, 3)                   as `Numbers`
    force : (n, 5) complex          as `Numbers`
    water : (n, z, 2)               of the strips of the drag, cos and sin
    surge : (n, 2)                  cos and sin
    band : (n,) int                 of the wave number
    turned : (n, 2, s)              cos and sin of k x cos mu at the sections
    """

    amplitude: Floats
    omega: Floats
    phase: Floats
    wave: Floats
    force: NDArray[np.complex128]
    water: Floats
    surge: Floats
    band: NDArray[np.int64]
    turned: Floats


@summing
def _sea_at(sea, time, rise, surface, force, water):
    """Surface and slopes (3, b, s), forces (5,), water (z,) and surge of all waves at a time."""
    surface[:] = 0.0
    force[:] = 0.0
    water[:] = 0.0
    xi = 0.0
    for i in range(sea.amplitude.size):
        angle = sea.omega[i] * time + sea.phase[i]
        xi += rise * sea.amplitude[i] * (sea.surge[i, 0] * math.cos(angle) + sea.surge[i, 1] * math.sin(angle))
    for i in range(sea.amplitude.size):
        a, along, across, way = rise * sea.amplitude[i], sea.wave[i, 0], sea.wave[i, 1], sea.wave[i, 2]
        angle = sea.omega[i] * time + sea.phase[i] - way * along * xi
        c, s = a * math.cos(angle), a * math.sin(angle)
        for m in range(5):
            force[m] += sea.force[i, m].real * c - sea.force[i, m].imag * s
        for z in range(water.size):
            water[z] += sea.water[i, z, 0] * c + sea.water[i, z, 1] * s
        b, turned_s = sea.band[i], way * s
        for x in range(surface.shape[2]):
            real, imaginary = sea.turned[i, 0, x], sea.turned[i, 1, x]
            sine = real * turned_s - imaginary * c  # -a sin(k x cos mu - phase)
            surface[0, b, x] += real * c + imaginary * turned_s
            surface[1, b, x] += along * sine
            surface[2, b, x] += across * sine
    return xi


# As in `table_load`, the surface at a section is taken straight across: eta + eta_y b, which at the reference point is
# eta + eta_y b0, and its decaying part -sum_b k_b (eta_b + eta_y,b b) e^{-k_b d}. The waves of one band decay alike, so a
# section has its hydrostatic integrals once, columns 0 to 2 of ``read`` with band 0, and the weighted ones of every band times
# that band's elevation and slope. The slopes of the pressure, by which it drives surge and sway, take the whole decaying part
# at once: share = 1 - sum_b k_b eta_b.
@batch_kernel
def _load(tables, splines, k, surface, y, read, load):
    """Loads (6,) over density times gravity; False where a section leaves its table."""
    heave, roll, pitch = y[0], y[5], y[1]
    sp, cp, st, ct = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    b0, q0 = -tables.z0 * sp, tables.z0 * cp
    load[:] = 0.0
    for s in range(tables.x.size):
        eta = slope = decaying = 0.0
        for b in range(k.size):
            slope += surface[2, b, s]
            eta += surface[0, b, s]
            decaying += k[b] * (surface[0, b, s] + surface[2, b, s] * b0)
        gamma = math.sqrt(1.0 + slope * slope)
        depth = ((heave - tables.z0 - tables.x[s] * st + eta + slope * b0) / ct + q0) / gamma
        share = 1.0 - decaying
        for b in range(k.size):
            if not spline_at(splines[b], s, tables.first, tables.step, k[b], depth, roll + math.atan(slope), read):
                return False
            if b > 0:
                read[0, 0] = read[0, 1] = read[0, 2] = 0.0
            here = surface[0, b, s] + surface[2, b, s] * b0
            factors = (
                1.0 / gamma, slope / gamma, k[b] * here, k[b] * surface[2, b, s],
                surface[1, b, s] * share, surface[2, b, s] * share,
            )  # fmt: skip
            given, _ = section_share(read, 0, (tables.x[s], st, ct, b0, q0), factors)
            for m in range(6):
                load[m] += tables.weight[s] * given[m]
    return True


# The classical fourth-order method on the state of `motion_rates`. The sea at a time is alike for all stages there, so each
# step sums it twice, in its middle and at its end; its beginning is the end of the step before. ``force`` is the pressure on
# the wetted hull, weight and buoyancy in balance at rest (``scale``, rho g), diffraction, what heel adds, products of the
# state, and drag by strips, -|q| q, q the velocity of a strip through the orbiting water.
@kernel
def march_in_a_sea(
    tables, splines, k, numbers, sea, up, across, damp_up, damp_across, h, run_up, rise, kick, limit, steps, out
):
    """Steps from rest in a sea that rises over ``rise`` seconds; heel by ``kick`` is added at the end of the run-up.

    steps: after the run-up
    out (6,): sums of heave, pitch and roll squared, their count, the largest roll, the time of the end since the run-up
    Returns how it ends; a loss in the run-up has a time below 0
    """
    bands, strips = k.size, numbers.strips.shape[1]
    surfaces, forces = np.empty((3, 3, bands, tables.x.size)), np.empty((3, 5))
    water, y, stage, rate, total = np.empty((3, strips)), np.zeros(10), np.empty(10), np.empty(10), np.empty(10)
    read, load, force = np.empty((3, LANES)), np.empty(6), np.empty(5)
    state, slope = np.empty(5), np.empty((5, 6))
    _sea_at(sea, 0.0, 0.0 if rise > 0.0 else 1.0, surfaces[2], forces[2], water[2])
    for n in range(run_up + steps):
        surfaces[0], forces[0], water[0] = surfaces[2], forces[2], water[2]
        for j in range(1, 3):
            time = (n + 0.5 * j) * h
            _sea_at(sea, time, min(1.0, time / rise) if rise > 0.0 else 1.0, surfaces[j], forces[j], water[j])
        total[:] = 0.0
        for j in range(4):
            at = 0 if j == 0 else 2 if j == 3 else 1
            ahead = 0.5 * h * at
            for i in range(10):
                stage[i] = y[i] + ahead * rate[i] if j > 0 else y[i]
            if not _load(tables, splines, k, surfaces[at], stage, read, load):
                out[5] = (n - run_up) * h
                return UNDER
            scale = numbers.scale[0]
            force[0], force[1] = scale * (load[2] + numbers.scale[1]) + forces[at, 0], scale * load[4] + forces[at, 1]
            force[2], force[3] = scale * load[1] + forces[at, 2], scale * load[3] + forces[at, 3]
            force[4] = scale * load[5] + forces[at, 4]
            for m in range(3):
                force[2 + m] += numbers.heel[0, m] * stage[5]
            state[0], state[1], state[2], state[3], state[4] = stage[0], stage[1], stage[4], stage[5], stage[7]
            add_products(numbers, 0, state, stage[6], force, slope)
            for z in range(strips):
                ev, ep, er = numbers.strips[0, z, 0], numbers.strips[0, z, 1], numbers.strips[0, z, 2]
                q = ev * stage[4] + ep * stage[6] + er * stage[7] - water[at, z]
                force[2] -= q * abs(q) * ev
                force[3] -= q * abs(q) * ep
                force[4] -= q * abs(q) * er
            motion_rates(numbers, 0, up, across, damp_up, damp_across, stage, force, rate)
            for i in range(10):
                total[i] += (1.0 if j == 0 or j == 3 else 2.0) * rate[i]
        for i in range(10):
            y[i] += h / 6.0 * total[i]
        if n + 1 == run_up:
            y[5] += kick
        if n >= run_up:
            out[0] += y[0] * y[0]
            out[1] += y[1] * y[1]
            out[2] += y[5] * y[5]
            out[3] += 1.0
            out[4] = max(out[4], abs(y[5]))
        if not abs(y[5]) <= limit:
            out[5] = (n + 1 - run_up) * h
            return CAPSIZED
    out[5] = steps * h
    return AFLOAT

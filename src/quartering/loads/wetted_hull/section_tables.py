"""Loads of a wave on the instantaneous wetted hull from tables of its sections: fast, for time histories.

A section that meets a straight surface is known by the depth s of its reference point (centreline at the calm waterline) below
that surface and its heel chi against it. Area and moments over (s, chi) are made once for a hull, those weighted with e^{-kd}
once for a wave number, and read by cubic splines with their gradients.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from quartering._machine.compiled import batch_kernel, inlined, kernel
from quartering._machine.simd import LANES, every, store
from quartering._machine.simd import load as vector
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.section import Floats
from quartering.loads.wetted_hull.pressure import (
    PIECES,
    Waves,
    along_surface,
    wetted_hull,
)

DEPTHS: Final = 97
HEELS: Final = 61
"""Points of a table in depth, and in heel."""
LARGEST_HEEL: Final = 75.0
"""Heel against the surface up to which a table reaches [deg]."""


_REACH: Final = 1.1
"""How far above and below its reference point a heeled section meets the surface, over the largest half breadth."""
_DROWNED: Final = math.asin(0.5 * _REACH)
"""Heel up to which a section below the last depth of its table is under water as a whole [rad]."""


class SectionTables(NamedTuple):
    """Tables of all sections of a hull.

    Parameters
    ----------
    x, weight : (s,) float            as `WettedHull`
    z0 : float                        of the calm plane, down from G [m]
    wavenumber : float                k of the weighted integrals; 0 where there are none [1/m]
    first : (2,) float                first depth [m] and heel [rad]
    step : (2,) float                 their steps
    spline : (s, d, c, 8) float       coefficients of cubic B-splines: area, its moments across and down from the reference
                                      point; the same weighted with e^{-kd}, or again where there is no wave number; the
                                      weighted second moment across [m2, m3, m4]; nothing, to fill a vector
    """

    x: Floats
    weight: Floats
    z0: float
    wavenumber: float
    first: Floats
    step: Floats
    spline: Floats

    def about(self, x_g: float, height: float) -> SectionTables:
        """The same tables with G moved forward and up [m]."""
        return self._replace(x=self.x - x_g, z0=self.z0 + height)


@lru_cache(maxsize=16)
def section_tables(hull: Hull, wavenumber: float = 0.0, pieces: int = PIECES) -> SectionTables:
    """Tables of a hull's sections about the point of the calm plane amidships.

    wavenumber: k of the pressure that decays with depth; 0: hydrostatic alone [1/m]
    pieces: straight pieces, at least, of half a smooth section
    Returns `about` moves it to G
    """
    from scipy.ndimage import spline_filter1d

    wet = wetted_hull(hull, pieces)
    top, keel = float(-wet.z.min()), float(wet.z.max())
    reach = _REACH * float(
        wet.y.max()
    )  # a heeled section meets the surface this far above and below its reference point
    depth = np.linspace(-(keel + 0.5 * reach), top + 0.5 * reach, DEPTHS)
    heel = np.radians(np.linspace(-LARGEST_HEEL, LARGEST_HEEL, HEELS))
    values = np.zeros((wet.x.size, DEPTHS, HEELS, 7 if wavenumber > 0.0 else 3))
    _fill(wet.points, wet.y, wet.z, depth, heel, wavenumber, values)
    for axis in (1, 2):
        values = spline_filter1d(values, 3, axis=axis, mode="mirror")
    first, step = np.array([depth[0], heel[0]]), np.array([depth[1] - depth[0], heel[1] - heel[0]])
    spline = np.zeros((*values.shape[:3], LANES))
    spline[..., : values.shape[3]] = values
    if wavenumber == 0.0:
        spline[..., 3:6] = values
    return SectionTables(wet.x, wet.weight, 0.0, wavenumber, first, step, spline)


@kernel
def _fill(points, y, z, depth, heel, k, values):  # type: ignore[no-untyped-def]
    """Integrals of every section at every depth and heel."""
    scratch = np.empty((7, max(y.shape[1], 8)))
    for s in range(y.shape[0]):
        for j in range(heel.size):
            for i in range(depth.size):
                along_surface(points[s], y[s], z[s], depth[i], heel[j], k, scratch)
                for n in range(values.shape[3]):
                    values[s, i, j, n] = scratch[3, n]


def table_loads(tables: SectionTables, state: Floats, waves: Waves) -> tuple[Floats, Floats]:
    """Loads of the pressure of frozen waves on a hull at given heave, roll and pitch, over density times gravity.

    tables: about G; with a wave number the pressure of the wave decays with depth
    state (n, 3): heave of G, + down [m], roll and pitch [rad]
    waves: (n,), or one for all states; of the tables' wave number where they have one
    Returns loads (n, 6): X, Y, Z [m3], K, M, N about G [m4]; times rho g; jacobian (n, 6, 3): by heave, roll and pitch;
        NaN, as the loads, where a section leaves its table

    The surface is straight across a section: exact in head and following seas, and in oblique ones for k B sin mu below 0.3;
    beyond, `direct_loads`.  At small pitch the decay with depth is that of the upright section.
    Source: as `direct_loads`.
    """
    states = np.ascontiguousarray(np.atleast_2d(state), dtype=float)
    packed = np.array([np.broadcast_to(part, len(states)) for part in waves]).T.copy()
    loads, jacobian = np.empty((len(states), 6)), np.empty((len(states), 6, 3))
    _by_table(*tables, states, packed, loads, jacobian)
    return loads, jacobian


@kernel
def _by_table(x, weight, z0, k, first, step, spline, state, waves, loads, jacobian):  # type: ignore[no-untyped-def]
    """Loads of n states in n waves."""
    room, change = table_room(x.size), np.empty((6, 4))
    for n in range(state.shape[0]):
        table_load(x, weight, z0, k, first, step, spline, state[n], waves[n], room, loads[n], change)
        jacobian[n] = change[:, :3]


@inlined
def table_room(sections):  # type: ignore[no-untyped-def]
    """What `table_load` works in: integrals of a section; e^{i k x cos mu} of all sections, for the k cos mu it was last at."""
    return np.empty((3, LANES)), np.full((2, sections + 1), np.nan)


# Let the surface at a section rise by eta_y to starboard; gamma = sqrt(1 + eta_y^2). Across and down from the reference point,
# which lies b0 = -z0 sin phi, q0 = z0 cos phi from G, a point b' along and q' below the direction of the surface is
#     b = b0 + (b' + eta_y q')/gamma,  q = q0 + (q' - eta_y b')/gamma,
# so that the tables of A, B', Q' at s = depth/gamma, chi = phi + atan eta_y give A and the integrals of b and q about G. In the
# decaying part -k eta e^{-kd} the elevation goes with its slope across the section too, hence the second moment.
#
# What a section gives is linear in its integrals. So a change of depth or of heel is the same with their derivatives; a change
# of the wave's angle, k x cos mu + k b0 sin mu - phase, by which roll and a place further along the course act too, changes the
# depth, the heel and the factors: eta' = s, s' = -eta with s = -a sin(angle).
@batch_kernel
def table_load(x, weight, z0, k, first, step, spline, state, wave, room, load, jacobian):  # type: ignore[no-untyped-def]
    """Loads (6,) of one state in one frozen wave, and Jacobian (6, 4) by heave, roll, pitch and place along the course."""
    read, turned = room
    heave, roll, pitch = state[0], state[1], state[2]
    a, along, across, phase = wave[0], wave[1], wave[2], wave[3]
    sp, cp, st, ct = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    b0, q0 = -z0 * sp, z0 * cp
    load[:] = 0.0
    jacobian[:] = 0.0
    if turned[0, x.size] != along:
        for s in range(x.size):
            turned[0, s], turned[1, s] = math.cos(along * x[s]), math.sin(along * x[s])
        turned[0, x.size] = along
    real, imaginary = a * math.cos(across * b0 - phase), a * math.sin(across * b0 - phase)
    for s in range(x.size):
        xs, w = x[s], weight[s]
        eta = turned[0, s] * real - turned[1, s] * imaginary
        sine = -(turned[1, s] * real + turned[0, s] * imaginary)
        slope = across * sine
        gamma, tilt = 1.0, 0.0
        if across != 0.0:
            gamma, tilt = math.sqrt(1.0 + slope * slope), math.atan(slope)
        depth = ((heave - z0 - xs * st + eta) / ct + q0) / gamma
        if not spline_at(spline, s, first, step, k, depth, roll + tilt, read):
            load[:] = np.nan
            jacobian[:] = np.nan
            return
        share = 1.0 - k * eta
        forward, starboard = along * sine * share, slope * share
        g1, g2 = 1.0 / gamma, slope / gamma
        place, wave_here = (xs, st, ct, b0, q0), (g1, g2, k * eta, k * slope, forward, starboard)
        here, moments = section_share(read, 0, place, wave_here)
        deeper, _ = section_share(read, 1, place, wave_here)
        heeled, _ = section_share(read, 2, place, wave_here)
        steeper = -across * eta
        factors = (
            -slope * steeper * g1 * g1 * g1, steeper * g1 * g1 * g1, k * sine, k * steeper,
            -along * (eta * share + k * sine * sine), steeper * share - k * slope * sine,
        )  # fmt: skip
        turning = _factors_change(read, place, wave_here, factors, moments)
        by_depth, by_heel = sine * g1 / ct - depth * slope * steeper * g1 * g1, steeper * g1 * g1
        to_heave, to_roll, to_pitch = g1 / ct, -z0 * sp * g1, ((depth * gamma - q0) * st / ct - xs) * g1
        for i in range(6):
            angle = turning[i] + deeper[i] * by_depth + heeled[i] * by_heel
            load[i] += w * here[i]
            jacobian[i, 0] += w * deeper[i] * to_heave
            jacobian[i, 1] += w * (deeper[i] * to_roll + heeled[i] - across * z0 * cp * angle)
            jacobian[i, 2] += w * deeper[i] * to_pitch
            jacobian[i, 3] += w * along * angle
        up, up_b, up_q = -here[2], moments[0], moments[1]
        # the reference point moves round G as the ship rolls, and the directions of the moments turn with the pitch
        sideways, down = -z0 * cp, -z0 * sp
        jacobian[3, 1] += w * (starboard * down * read[0, 3] - ct * sideways * up)
        jacobian[4, 1] += w * st * down * (read[0, 0] - k * eta * read[0, 3])
        jacobian[5, 1] += w * forward * sideways * read[0, 3]
        jacobian[3, 2] += w * st * up_b
        jacobian[4, 2] += w * (ct * up_q - xs * st * up)


@batch_kernel
def section_share(read, row, place, wave_here):  # type: ignore[no-untyped-def]
    """X, Y, Z, K, M, N a metre of a section, and int up b, int up q, int e^{-kd} b and q about G."""
    xs, st, ct, b0, q0 = place
    g1, g2, e, f, forward, starboard = wave_here
    r0, r1, r2, r3 = read[row, 0], read[row, 1], read[row, 2], read[row, 3]
    r4, r5, r6 = read[row, 4], read[row, 5], read[row, 6]
    b = b0 * r0 + g1 * r1 + g2 * r2
    q = q0 * r0 + g1 * r2 - g2 * r1
    b_, q_ = b0 * r3 + g1 * r4 + g2 * r5, q0 * r3 + g1 * r5 - g2 * r4
    up = r0 - e * r3 - f * r4
    up_b, up_q = b - e * b_ - f * (r6 + b0 * r4), q - e * q_
    return (
        -forward * r3, -starboard * r3, -up,
        starboard * q_ - ct * up_b, xs * ct * up + st * up_q, forward * b_ - xs * starboard * r3,
    ), (up_b, up_q, b_, q_)  # fmt: skip


@batch_kernel
def _factors_change(read, place, wave_here, factors, moments):  # type: ignore[no-untyped-def]
    """What X, Y, Z, K, M, N of a section change by with the factors of its integrals."""
    xs, st, ct, b0, _ = place
    _, _, e, _, forward, starboard = wave_here
    g1, g2, de, df, d_forward, d_starboard = factors
    r1, r2, r3, r4, r5, r6 = read[0, 1], read[0, 2], read[0, 3], read[0, 4], read[0, 5], read[0, 6]
    b_, q_ = moments[2], moments[3]
    db_, dq_ = g1 * r4 + g2 * r5, g1 * r5 - g2 * r4
    up = -de * r3 - df * r4
    up_b = g1 * r1 + g2 * r2 - de * b_ - e * db_ - df * (r6 + b0 * r4)
    up_q = g1 * r2 - g2 * r1 - de * q_ - e * dq_
    return (
        -d_forward * r3, -d_starboard * r3, -up,
        d_starboard * q_ + starboard * dq_ - ct * up_b, xs * ct * up + st * up_q,
        d_forward * b_ + forward * db_ - xs * d_starboard * r3,
    )  # fmt: skip


# Below the last depth of its table a section heeled by less than 33 deg is under water up to its deck: area and moments stay,
# and what is weighted with e^{-kd} falls as e^{-kd}.
@batch_kernel
def spline_at(spline, s, first, step, k, depth, heel, read):  # type: ignore[no-untyped-def]
    """Integrals and their derivatives by depth and heel; False outside the table."""
    last = first[0] + (spline.shape[1] - 3) * step[0]
    drowned = depth > last and abs(heel) <= _DROWNED
    by = math.exp(-k * (depth - last)) if drowned else 1.0
    depth = last if drowned else depth
    u, v = (depth - first[0]) / step[0], (heel - first[1]) / step[1]
    i, j = math.floor(u) - 1, math.floor(v) - 1
    if i < 0:  # above the water
        read[:] = 0.0
        return True
    if i > spline.shape[1] - 4 or j < 0 or j > spline.shape[2] - 4:
        return False
    across_depth, slope_depth = _weights(u - i - 1)
    (v0, v1, v2, v3), (t0, t1, t2, t3) = _weights(v - j - 1)
    value, by_u, by_v = every(0.0), every(0.0), every(0.0)
    for r in range(4):
        c0, c1 = vector(spline, (s, i + r, j)), vector(spline, (s, i + r, j + 1))
        c2, c3 = vector(spline, (s, i + r, j + 2)), vector(spline, (s, i + r, j + 3))
        line = v0 * c0 + v1 * c1 + v2 * c2 + v3 * c3
        value += across_depth[r] * line
        by_u += slope_depth[r] * line
        by_v += across_depth[r] * (t0 * c0 + t1 * c1 + t2 * c2 + t3 * c3)
    store(read, 0, value)
    store(read, 1, by_u * (1.0 / step[0]))
    store(read, 2, by_v * (1.0 / step[1]))
    if drowned:
        for n in range(read.shape[1]):
            decay = by if n > 2 else 1.0
            read[0, n] *= decay
            read[2, n] *= decay
            read[1, n] = -k * read[0, n] if n > 2 else 0.0
    return True


@batch_kernel
def _weights(t):  # type: ignore[no-untyped-def]
    """Cubic B-spline and its derivative at four neighbours."""
    o = 1.0 - t
    w = (o * o * o / 6.0, 2.0 / 3.0 - t * t * (1.0 - 0.5 * t), 2.0 / 3.0 - o * o * (1.0 - 0.5 * o), t * t * t / 6.0)
    return w, (-0.5 * o * o, t * (1.5 * t - 2.0), -o * (1.5 * o - 2.0), 0.5 * t * t)

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

from quartering._machine.compiled import batch_kernel, inner, kernel
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.section import Floats
from quartering.loads.wetted_hull.pressure import (
    PIECES,
    Waves,
    add_section,
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
    spline : (s, d, c, 3 or 7) float  coefficients of cubic B-splines: area, its moments across and down from the reference
                                      point; with a wave number the same weighted with e^{-kd}, and the weighted second
                                      moment across [m2, m3, m4]
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
    return SectionTables(wet.x, wet.weight, 0.0, wavenumber, first, step, np.ascontiguousarray(values))


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
    scratch = np.empty((7, 18))
    for n in range(state.shape[0]):
        table_load(x, weight, z0, k, first, step, spline, state[n], waves[n], scratch, loads[n], jacobian[n])


# Let the surface at a section rise by eta_y to starboard; gamma = sqrt(1 + eta_y^2). Across and down from the reference point,
# which lies b0 = -z0 sin phi, q0 = z0 cos phi from G, a point b' along and q' below the direction of the surface is
#     b = b0 + (b' + eta_y q')/gamma,  q = q0 + (q' - eta_y b')/gamma,
# so that the tables of A, B', Q' at s = depth/gamma, chi = phi + atan eta_y give A and the integrals of b and q about G. In the
# decaying part -k eta e^{-kd} the elevation goes with its slope across the section too, hence the second moment.
@inner
def table_load(x, weight, z0, k, first, step, spline, state, wave, scratch, load, jacobian):  # type: ignore[no-untyped-def]
    """Loads and Jacobian of one state in one frozen wave."""
    heave, roll, pitch = state[0], state[1], state[2]
    a, along, across, phase = wave[0], wave[1], wave[2], wave[3]
    sp, cp, st, ct = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    b0, q0 = -z0 * sp, z0 * cp
    load[:] = 0.0
    jacobian[:] = 0.0
    read, sums = scratch[:3], scratch[3:]
    # Across one section the wave's surface is nearly straight: eta + slope y. In axes of the ship it is a plane tilted by
    # chi = roll + atan(slope) at depth d = down/gamma under the reference point, gamma = sqrt(1 + slope^2), which is what the
    # tables are made over. Effective gravity turns with it (theory of 3.3): with A, B, Q the wetted area and its moments across
    # and down, the section's moments about G's axes are b0 A + (B + slope Q)/gamma and q0 A + (Q - slope B)/gamma.
    for s in range(x.size):
        xs, w = x[s], weight[s]
        angle = along * xs + across * b0 - phase
        eta, sine = a * math.cos(angle), -a * math.sin(angle)
        slope = across * sine
        gamma = math.sqrt(1.0 + slope * slope)
        down = (heave - z0 - xs * st + eta) / ct + q0
        if not _spline(spline[s], first, step, k, down / gamma, roll + math.atan(slope), read):
            load[:] = np.nan
            jacobian[:] = np.nan
            return
        change = (1.0 / ct, -(z0 * sp + slope * z0 * cp / ct), (down - q0) * st / ct - xs)
        share = 1.0 - k * eta
        # Row 0 holds the values, rows 1 to 3 their derivatives by heave, roll and pitch: all three change the depth, roll
        # changes chi as well. The second half of a table, weighted with e^{-kd}, is the pressure that dies out downwards.
        for row in range(4):
            out = sums[row]
            by_depth = 0.0 if row == 0 else change[row - 1] / gamma
            for half in range(2 if k > 0.0 else 1):
                i = 3 * half
                if row == 0:
                    A, B, Q = read[0, i], read[0, i + 1], read[0, i + 2]
                else:
                    A, B, Q = read[1, i] * by_depth, read[1, i + 1] * by_depth, read[1, i + 2] * by_depth
                    if row == 2:
                        A, B, Q = A + read[2, i], B + read[2, i + 1], Q + read[2, i + 2]
                across_g = b0 * A + (B + slope * Q) / gamma
                down_g = q0 * A + (Q - slope * B) / gamma
                if row == 2:  # G stays, the reference point moves
                    across_g -= z0 * cp * read[0, i]
                    down_g -= z0 * sp * read[0, i]
                if half == 0:
                    out[0], out[1], out[2] = A, across_g, down_g
                out[8], out[9], out[10] = A, across_g, down_g
            if k > 0.0:
                second = read[0, 6] if row == 0 else read[1, 6] * by_depth + (read[2, 6] if row == 2 else 0.0)
                out[0] -= k * (eta * out[8] + slope * B)
                out[1] -= k * (eta * out[9] + slope * (second + b0 * B))
                out[2] -= k * eta * out[10]
            forward, starboard = along * sine * share, slope * share
            out[3], out[4], out[5] = forward * out[8], forward * out[9], forward * out[10]
            out[6], out[7] = starboard * out[8], starboard * out[10]
        add_section(w, xs, st, ct, False, sums, load, jacobian)


# Below the last depth of its table a section heeled by less than 33 deg is under water up to its deck: area and moments stay,
# and what is weighted with e^{-kd} falls as e^{-kd}.
@batch_kernel
def _spline(coefficients, first, step, k, depth, heel, read):  # type: ignore[no-untyped-def]
    """Integrals and their derivatives by depth and heel; False outside the table."""
    last = first[0] + (coefficients.shape[0] - 3) * step[0]
    drowned = depth > last and abs(heel) <= _DROWNED
    by = math.exp(-k * (depth - last)) if drowned else 1.0
    depth = last if drowned else depth
    u, v = (depth - first[0]) / step[0], (heel - first[1]) / step[1]
    i, j = math.floor(u) - 1, math.floor(v) - 1
    if i < 0:  # above the water
        for n in range(coefficients.shape[2]):
            read[0, n] = read[1, n] = read[2, n] = 0.0
        return True
    if i > coefficients.shape[0] - 4 or j < 0 or j > coefficients.shape[1] - 4:
        return False
    (u0, u1, u2, u3), (s0, s1, s2, s3) = _weights(u - i - 1)
    (v0, v1, v2, v3), (t0, t1, t2, t3) = _weights(v - j - 1)
    for n in range(coefficients.shape[2]):
        value = by_u = by_v = 0.0
        for r in range(4):
            c0, c1 = coefficients[i + r, j, n], coefficients[i + r, j + 1, n]
            c2, c3 = coefficients[i + r, j + 2, n], coefficients[i + r, j + 3, n]
            line = v0 * c0 + v1 * c1 + v2 * c2 + v3 * c3
            across = u0 if r == 0 else u1 if r == 1 else u2 if r == 2 else u3
            value += across * line
            by_u += (s0 if r == 0 else s1 if r == 1 else s2 if r == 2 else s3) * line
            by_v += across * (t0 * c0 + t1 * c1 + t2 * c2 + t3 * c3)
        read[0, n], read[1, n], read[2, n] = value, by_u / step[0], by_v / step[1]
        if drowned:
            decay = by if n > 2 else 1.0
            read[0, n], read[2, n] = decay * value, decay * read[2, n]
            read[1, n] = -k * read[0, n] if n > 2 else 0.0
    return True


@batch_kernel
def _weights(t):  # type: ignore[no-untyped-def]
    """Cubic B-spline and its derivative at four neighbours."""
    o = 1.0 - t
    w = (o * o * o / 6.0, 2.0 / 3.0 - t * t * (1.0 - 0.5 * t), 2.0 / 3.0 - o * o * (1.0 - 0.5 * o), t * t * t / 6.0)
    return w, (-0.5 * o * o, t * (1.5 * t - 2.0), -o * (1.5 * o - 2.0), 0.5 * t * t)

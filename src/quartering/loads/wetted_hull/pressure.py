"""Pressure of a wave over the instantaneous wetted hull, integrated section by section: loads and their Jacobian.

A section is a closed polygon, watertight up to the top of the offsets. Depth d is measured below the instantaneous surface, so
that the pressure is that of the theory of small waves stretched to it: p = rho g [d + eta (e^{-kd} - 1)], or rho g d when
only the hydrostatic part is wanted.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import inner, kernel
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.section import Floats
from quartering.hull.righting.heeled import PIECES as PIECES
from quartering.hull.righting.heeled import polygons

Pressure = Literal["hydrostatic", "smith"]
"""Pressure under the wave: that of the depth alone, or with the exponential decay of the wave's own pressure."""

LOADS: Final = ("X", "Y", "Z", "K", "M", "N")
"""Forces on axes level with the calm plane, x along the course, y to starboard, z down; moments about G by roll, pitch, yaw."""


PIECE: Final = 0.5
"""Longest piece of an edge with a Gauss rule of its own, times the wave number."""


class WettedHull(NamedTuple):
    """Starboard halves of the sections of a hull as polygons, from keel over deck edge to the centreline.

    Parameters
    ----------
    x : (s,) float           from G, + forward [m]
    weight : (s,) float      sum(weight * f(x)) is the integral of f along the ship [m]
    points : (s,) int        vertices of each polygon
    y, z : (s, n) float      starboard and down from G, upright [m]
    z0 : float               of the calm plane, down from G [m]
    """

    x: Floats
    weight: Floats
    points: NDArray[np.int64]
    y: Floats
    z: Floats
    z0: float

    def about(self, x_g: float, height: float) -> WettedHull:
        """The same hull with G moved forward and up [m]."""
        return self._replace(x=self.x - x_g, z=self.z + height, z0=self.z0 + height)


@lru_cache(maxsize=64)
def wetted_hull(hull: Hull, pieces: int = PIECES) -> WettedHull:
    """Polygons of a hull's sections about the point of the calm plane amidships.

    pieces: straight pieces, at least, of half a smooth section; those on one line are one
    Returns `about` moves it to G
    """
    y, height = polygons(hull, pieces)
    half = y.shape[1] // 2
    kept = [_corners(*side) for side in zip(y[:, :half], hull.draught - height[:, :half], strict=True)]
    longest = max(len(ys) for ys, _ in kept)
    filled = np.zeros((2, len(kept), longest))
    for i, half_section in enumerate(kept):
        filled[:, i, : len(half_section[0])] = half_section
    points = np.array([len(ys) for ys, _ in kept], dtype=np.int64)
    return WettedHull(hull.x.copy(), hull.weight.copy(), points, filled[0].copy(), filled[1].copy(), 0.0)


def _corners(y: Floats, z: Floats) -> tuple[Floats, Floats]:
    """Points of half a section closed along the deck, without those repeated or on the line of their neighbours."""
    y, z = np.append(y, 0.0), np.append(z, z[-1])
    moved = np.append(True, np.hypot(np.diff(y), np.diff(z)) > 0.0)
    y, z = y[moved], z[moved]
    ahead, behind = (np.stack([np.diff(part)[side] for part in (y, z)]) for side in (slice(1, None), slice(None, -1)))
    turn = np.abs(ahead[0] * behind[1] - ahead[1] * behind[0])
    straight = (turn <= 1e-12 * np.hypot(*ahead) * np.hypot(*behind)) & ((ahead * behind).sum(axis=0) > 0.0)
    corner = np.concatenate([[True], ~straight, [True]])
    return y[corner], z[corner]


class Waves(NamedTuple):
    """Frozen waves eta = a cos(k (x cos mu + y sin mu) - phase), up, x and y from G.

    Parameters
    ----------
    amplitude : (n,) float     a [m]
    along, across : (n,) float k cos mu and k sin mu [1/m]
    phase : (n,) float         at G; the crest lies k x cos mu = phase ahead of it [rad]
    """

    amplitude: Floats
    along: Floats
    across: Floats
    phase: Floats


def direct_loads(
    hull: WettedHull, state: Floats, waves: Waves, pressure: Pressure = "smith", exact: bool = False
) -> tuple[Floats, Floats]:
    """Loads of the pressure of frozen waves on a hull at given heave, roll and pitch, over density times gravity.

    hull: about G
    state (n, 3): heave of G, + down [m], roll, + starboard down, and pitch, + bow up [rad]
    waves: (n,), or one for all states
    pressure: "hydrostatic" or "smith"
    exact: with the lever of the surge force in pitch, the wave at the true place of a trimmed section and its area
        across the sloping surface; without any of the three as strip theory has it
    Returns loads (n, 6): X, Y, Z [m3], K, M, N about G [m4]; times rho g; jacobian (n, 6, 3): by heave, roll and pitch
        [m2, m3, m4]

    K and M are the generalised forces of roll and pitch, so hydrostatic loads have a potential.  With ``exact`` the Jacobian
    leaves out how the slope of the wave changes with the place.
    Source: the pressure of linear theory, with Gauss's theorem on each section.  Valid: small trim; slopes of the hull along
    the ship enter through the areas.
    """
    states = np.ascontiguousarray(np.atleast_2d(state), dtype=float)
    packed = np.array([np.broadcast_to(part, len(states)) for part in waves]).T.copy()
    loads, jacobian = np.empty((len(states), 6)), np.empty((len(states), 6, 3))
    _direct(*hull, states, packed, pressure == "smith", exact, loads, jacobian)
    return loads, jacobian


def immersion(
    hull: WettedHull, roll: Floats, heave: Floats, pitch: Floats, waves: Waves, height: float | None = None
) -> Floats:
    """How deep the top of a hull lies below the surface, at the place where it lies deepest.

    roll, heave, pitch (n,): state [rad, m, rad]
    waves: (n,)
    height: of a level on the sides in place of the deck edge, down from G; at sections that do not reach it the deck
        [m]
    Returns (n,): below zero where it is dry [m]

    >>> from quartering.hull.lines.hull import box_hull
    >>> box = wetted_hull(box_hull(100.0, 20.0, 5.0, 10.0))
    >>> calm, zero = Waves(*np.zeros((4, 1))), np.zeros(1)
    >>> float(immersion(box, zero, zero, zero, calm)[0])
    -5.0
    """
    top = hull.z[np.arange(hull.x.size), hull.points - 1]
    at_top = (np.arange(hull.y.shape[1]) < hull.points[:, None]) & (hull.z <= top[:, None] + 1e-9)
    breadth = np.where(at_top, hull.y, -np.inf).max(axis=1)
    z = top if height is None else np.maximum(top, height)
    column = [np.asarray(part)[:, None] for part in (roll, heave, pitch, *waves)]
    phi, h, theta, a, along, across, phase = column
    deepest = np.full(len(roll), -np.inf)
    sides = (1.0, -1.0) if phi.any() or across.any() else (1.0,)  # upright in a wave along the ship both lie as deep
    for side in sides:
        b, q = side * breadth * np.cos(phi) - z * np.sin(phi), side * breadth * np.sin(phi) + z * np.cos(phi)
        eta = a * np.cos(along * hull.x + across * b - phase)
        depth = h - hull.z0 - hull.x * np.sin(theta) + q * np.cos(theta) + eta
        deepest = np.maximum(deepest, depth.max(axis=1))
    return deepest


@kernel
def _direct(x, weight, count, y, z, z0, state, waves, smith, exact, loads, jacobian):  # type: ignore[no-untyped-def]
    """Loads of n states in n waves."""
    scratch = np.empty((7, max(y.shape[1], 8)))  # b, q, d of the vertices; integrals and their derivatives
    for n in range(state.shape[0]):
        direct_load(x, weight, count, y, z, z0, state[n], waves[n], smith, exact, scratch, loads[n], jacobian[n])


# The integrals of a section. On its plane let b point to starboard and q down from G, both level when theta is small,
#     b = y cos phi - z sin phi,  q = y sin phi + z cos phi,  d = -z0 + h - x sin theta + c q + eta(b),  c = cos theta,
# and let f = -grad p / (rho g) be the force per volume: up g = 1 - k eta E, forward -eta_x s E, to starboard -eta_y s E with
# E = e^{-kd}, s = 1 - k eta (hydrostatic: E = s = g = 1). Each load is an integral of f, or of f times a lever, over the
# immersed area. At fixed b the wave does not change with depth, so by Green's theorem
#     int int F dA = (1/c) contour integral of (int_0^d F dt) db,
# in which the surface itself, d = 0, adds nothing. When the hull moves by delta, the integral changes by the contour integral
# of F times the normal displacement, again without the surface. For roll that is F (b db + q dq); where the depth changes by
# delta_d = e0 + e1 q it is F delta_d db / c, less what the lever q about G loses (heave: e0 = 1, e1 = 0; pitch: e0 = -x cos
# theta, e1 = -sin theta): for a lever q^m,  (m e0 I_{m-1} + (m + 1) e1 I_m) / c.
_V, _VB, _VQ, _HX, _HXB, _HXQ, _HY, _HYQ = range(8)


@inner
def direct_load(x, weight, count, y, z, z0, state, wave, smith, exact, scratch, load, jacobian):  # type: ignore[no-untyped-def]
    """Loads and Jacobian of one state in one frozen wave."""
    heave, roll, pitch = state[0], state[1], state[2]
    a, along, across, phase = wave[0], wave[1], wave[2], wave[3]
    sp, cp, st, ct = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    oblique = across != 0.0 and a != 0.0
    both = oblique or roll != 0.0
    k = math.sqrt(along * along + across * across) if smith and a != 0.0 else 0.0
    load[:] = 0.0
    jacobian[:] = 0.0
    sums = scratch[3:]
    for s in range(x.size):
        sums[:, :8] = 0.0
        xs = x[s]
        c, e0, e1, angle = ct, -xs * ct, -st, along * xs - phase
        eta, eta_x = a * math.cos(angle), -a * along * math.sin(angle)
        level = heave - z0 - xs * st
        if exact:  # the wave along the section's own plane, linear about the point where it meets the surface
            at = -(level + eta) / ct
            angle = along * (xs * ct + at * st) - phase
            eta, eta_x = a * math.cos(angle), -a * along * math.sin(angle)
            at = -(level + eta) / ct
            level -= eta_x * st * at
            c, e0, e1 = ct + eta_x * st, -xs * (ct + eta_x * st), -st + eta_x * ct
        surface = (level, c, a, along, across, angle, eta, eta_x, k)
        for side in range(2 if both else 1):
            _side(count[s], y[s], z[s], -1.0 if side else 1.0, sp, cp, surface, oblique, e0, e1, scratch)
        if not oblique:
            _combine(sums, both, eta, eta_x, k)
        _lever_terms(sums[0], sums[1], 1.0, 0.0, c)
        _lever_terms(sums[0], sums[3], e0, e1, c)
        add_section(weight[s], xs, st, ct, exact, sums, load, jacobian)


@inner
def along_surface(points, y, z, depth, heel, k, scratch):  # type: ignore[no-untyped-def]
    """Area of a section, its moments across and down, and the same weighted with e^{-kd}, in the first row of the sums.

    After them the weighted second moment across.
    The section lies with its reference point at a depth below a level surface, at a heel.
    """
    scratch[3:, :8] = 0.0
    surface = (depth, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, k)
    for sign in (1.0, -1.0):
        _side(points, y, z, sign, math.sin(heel), math.cos(heel), surface, False, 0.0, 0.0, scratch)


@inner
def _side(count, y, z, sign, sp, cp, surface, oblique, e0, e1, scratch):  # type: ignore[no-untyped-def]
    """Contour integrals along one side of a section, clipped at the surface edge by edge, two Gauss points a piece."""
    level, c, a, along, across, angle, eta0, _, k = surface
    b, q, d, sums = scratch[0], scratch[1], scratch[2], scratch[3:]
    for i in range(count):
        ys = sign * y[i]
        b[i] = ys * cp - z[i] * sp
        q[i] = ys * sp + z[i] * cp
        d[i] = level + c * q[i] + (a * math.cos(angle + across * b[i]) if oblique else eta0)
    for i in range(count - 1):
        d0, d1 = d[i], d[i + 1]
        if d0 <= 0.0 and d1 <= 0.0:
            continue
        t0 = d0 / (d0 - d1) if d0 < 0.0 else 0.0
        t1 = d0 / (d0 - d1) if d1 < 0.0 else 1.0
        whole_b, whole_q = b[i + 1] - b[i], q[i + 1] - q[i]
        span = t1 - t0
        pieces = 1 + int(span * max(k, abs(across)) * (abs(whole_b) + abs(whole_q)) / PIECE)
        half = 0.5 * span / pieces
        db, dq = sign * half * whole_b, sign * half * whole_q
        for point in range(2 * pieces):
            t = t0 + half * (1 + 2 * (point // 2) + (0.5773502691896257 if point % 2 else -0.5773502691896257))
            bp, qp = b[i] + t * whole_b, q[i] + t * whole_q
            if oblique:
                turned = angle + across * bp
                eta, sine = a * math.cos(turned), -a * math.sin(turned)
                dp = max(level + c * qp + eta, 0.0)
                _point(bp, qp, dp, db, dq, eta, along * sine, across * sine, k, c, e0, e1, sums)
            else:
                _point_along(bp, qp, d0 + t * (d1 - d0), db, dq, k, c, e0, e1, sums)


# Where the wave runs along the ship, eta is one number for a section: with A, B, Q the integrals of 1, b, q, and A', B', Q'
# those of E, E b, E q,  int up = A - k eta A',  int forward = eta_x s A', and likewise with levers. Rows hold A .. Q'.
@inner
def _point_along(b, q, d, db, dq, k, c, e0, e1, sums):  # type: ignore[no-untyped-def]
    """What one Gauss point adds to A, B, Q, A', B', Q' and to their derivatives by heave, roll and pitch."""
    inv = db / c
    q_surface = q - d / c
    value, by_heave, by_roll, by_pitch = sums[0], sums[1], sums[2], sums[3]
    rolls, pitches = b * db + q * dq, inv * (e0 + e1 * q)
    value[0] += inv * d
    value[1] += inv * b * d
    value[2] += inv * (q_surface + 0.5 * d / c) * d
    by_heave[0] += inv
    by_heave[1] += inv * b
    by_heave[2] += inv * q
    by_roll[0] += rolls
    by_roll[1] += rolls * b
    by_roll[2] += rolls * q
    by_pitch[0] += pitches
    by_pitch[1] += pitches * b
    by_pitch[2] += pitches * q
    if k > 0.0:
        decay = math.exp(-k * d)
        whole = (1.0 - decay) / k
        value[3] += inv * whole
        value[4] += inv * b * whole
        value[5] += inv * (q_surface * whole + (whole - d * decay) / (k * c))
        value[6] += inv * b * b * whole  # asked for by tables
        inv, rolls, pitches = inv * decay, rolls * decay, pitches * decay
        by_heave[3] += inv
        by_heave[4] += inv * b
        by_heave[5] += inv * q
        by_roll[3] += rolls
        by_roll[4] += rolls * b
        by_roll[5] += rolls * q
        by_pitch[3] += pitches
        by_pitch[4] += pitches * b
        by_pitch[5] += pitches * q


@inner
def _combine(sums, both, eta, eta_x, k):  # type: ignore[no-untyped-def]
    """Integrals of the force per volume from A .. Q'; upright, the port half is the mirror image of the starboard one."""
    share = 1.0 - k * eta
    for row in range(4):
        out = sums[row]
        if not both:
            for i in range(6):
                odd = (i % 3 == 1) != (row == 2)  # b is odd, and so is the displacement by roll
                out[i] = 0.0 if odd else 2.0 * out[i]
        A, B, Q, A_, B_, Q_ = out[0], out[1], out[2], out[3], out[4], out[5]
        if k == 0.0:
            A_, B_, Q_ = A, B, Q
        out[_V], out[_VB], out[_VQ] = A - k * eta * A_, B - k * eta * B_, Q - k * eta * Q_
        out[_HX], out[_HXB], out[_HXQ] = eta_x * share * A_, eta_x * share * B_, eta_x * share * Q_
        out[_HY] = out[_HYQ] = 0.0


@inner
def _point(b, q, d, db, dq, eta, eta_x, eta_y, k, c, e0, e1, sums):  # type: ignore[no-untyped-def]
    """What one Gauss point adds: values, then derivatives by heave, roll and pitch."""
    decay, share, up = 1.0, 1.0, 1.0
    up_0, up_1, sideways_0, sideways_1 = d, 0.5 * d * d, d, 0.5 * d * d
    if k > 0.0:
        decay = math.exp(-k * d)
        share, up = 1.0 - k * eta, 1.0 - k * eta * decay
        sideways_0 = (1.0 - decay) / k
        sideways_1 = (sideways_0 - d * decay) / k
        up_0, up_1 = d - k * eta * sideways_0, up_1 - k * eta * sideways_1
    inv = db / c
    q_surface = q - d / c
    forward, starboard = eta_x * share, eta_y * share
    value = sums[0]
    value[_V] += inv * up_0
    value[_VB] += inv * b * up_0
    value[_VQ] += inv * (q_surface * up_0 + up_1 / c)
    lever = q_surface * sideways_0 + sideways_1 / c
    value[_HX] += inv * forward * sideways_0
    value[_HXB] += inv * forward * b * sideways_0
    value[_HXQ] += inv * forward * lever
    value[_HY] += inv * starboard * sideways_0
    value[_HYQ] += inv * starboard * lever
    forward, starboard = forward * decay, starboard * decay
    normal = (inv, b * db + q * dq, inv * (e0 + e1 * q))
    for by in range(3):
        n, out = normal[by], sums[1 + by]
        out[_V] += n * up
        out[_VB] += n * b * up
        out[_VQ] += n * q * up
        out[_HX] += n * forward
        out[_HXB] += n * forward * b
        out[_HXQ] += n * forward * q
        out[_HY] += n * starboard
        out[_HYQ] += n * starboard * q


@inner
def _lever_terms(value, change, e0, e1, c):  # type: ignore[no-untyped-def]
    """What a change of depth e0 + e1 q takes from integrals with the lever q."""
    for i in (_V, _VB, _HX, _HXB, _HY):
        change[i] -= e1 * value[i] / c
    change[_VQ] -= (e0 * value[_V] + 2.0 * e1 * value[_VQ]) / c
    change[_HXQ] -= (e0 * value[_HX] + 2.0 * e1 * value[_HXQ]) / c
    change[_HYQ] -= (e0 * value[_HY] + 2.0 * e1 * value[_HYQ]) / c


@inner
def add_section(weight, x, st, ct, exact, sums, load, jacobian):  # type: ignore[no-untyped-def]
    """Add what a section gives to the loads and to their Jacobian."""
    _add(weight, x, st, ct, exact, sums[0], load)
    for by in range(3):
        _add(weight, x, st, ct, exact, sums[1 + by], jacobian[:, by])
    # the directions of the moments turn with the pitch
    value = sums[0]
    jacobian[3, 2] += weight * st * value[_VB]
    jacobian[4, 2] += weight * (ct * value[_VQ] - x * st * value[_V])
    if exact:
        jacobian[3, 2] -= weight * ct * value[_HXB]
        jacobian[4, 2] += weight * (st * value[_HXQ] + x * ct * value[_HX])


@inner
def _add(weight, x, st, ct, exact, value, out):  # type: ignore[no-untyped-def]
    """The section's share of X, Y, Z, K, M, N."""
    out[0] -= weight * value[_HX]
    out[1] -= weight * value[_HY]
    out[2] -= weight * value[_V]
    out[3] += weight * (value[_HYQ] - ct * value[_VB])
    out[4] += weight * (x * ct * value[_V] + st * value[_VQ])
    out[5] += weight * (value[_HXB] - x * value[_HY])
    if exact:
        out[3] -= weight * st * value[_HXB]
        out[4] += weight * (x * st * value[_HX] - ct * value[_HXQ])

"""The right-hand side: accelerations and their derivatives by the state, the one place where they are computed.

A row of lanes is worked on at once: every operation is done for all of them before the next, so that a processor's vector units
take several together. The lanes are conditions, realisations of a sea, or instants of one motion; one lane is the single case.
The arrays hold the lane in their last axis and nothing a lane does depends on its neighbours.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.compiled import abreast
from quartering.motion.program import SIGN, SIZE, TIMES

Floats = NDArray[np.float64]

WIDTH = 64
"""Lanes of a full row: enough that beginning a loop over them costs little, few enough to stay near the processor."""


class Parts(NamedTuple):
    """The numbers of a system, the condition in the first axis of each array.

    Parameters
    ----------
    linear : (n, k, s)        k rows, s states
    coefficients : (n, 3, t)  of the products
    mean, cos, sin : (n, 3)   excitation
    frequency : (n,)
    inputs : (n, e, h)        Fourier series of the known inputs: mean, then cos and sin of each harmonic of the wave
    strips : (n, z, 5)        e_v, e_p, e_r of the normal velocity, cos and sin of the water's; see `drag`
    push : (n, 3, 3)          accelerations per unit of force (Y, K, N) of the strips
    knots : (n, b)            roll angles where the cubic of the restoring moment changes, the first 0
    cubics : (n, b, 4)        of each interval: a + b x + c x^2 + d x^3 beyond its knot
    arm : (n, 3)              accelerations per unit of that moment
    """

    linear: Floats
    coefficients: Floats
    mean: Floats
    cos: Floats
    sin: Floats
    frequency: Floats
    inputs: Floats
    strips: Floats
    push: Floats
    knots: Floats
    cubics: Floats
    arm: Floats


class Lanes(NamedTuple):
    """`Parts` of a row of lanes, the lane in the last axis; ``one_hull`` (1,): all have the same strips but for the water."""

    linear: Floats
    coefficients: Floats
    mean: Floats
    cos: Floats
    sin: Floats
    frequency: Floats
    inputs: Floats
    strips: Floats
    push: Floats
    knots: Floats
    cubics: Floats
    arm: Floats
    one_hull: NDArray[np.bool_]


@abreast
def row_of_lanes(parts, width):
    """An empty row of lanes for the numbers of a system."""
    rows, states = parts.linear.shape[1], parts.linear.shape[2]
    return Lanes(
        np.zeros((rows, states, width)), np.zeros((3, parts.coefficients.shape[2], width)), np.zeros((3, width)),
        np.zeros((3, width)), np.zeros((3, width)), np.zeros(width),
        np.zeros((parts.inputs.shape[1], parts.inputs.shape[2], width)), np.zeros((parts.strips.shape[1], 5, width)),
        np.zeros((3, 3, width)), np.zeros((parts.knots.shape[1], width)), np.zeros((parts.knots.shape[1], 4, width)),
        np.zeros((3, width)), np.zeros(1, np.bool_),
    )  # fmt: skip


@abreast
def _put(parts, i, strength, lanes, l):
    """Copy condition ``i`` into lane ``l``, its nonlinear parts times ``strength``."""
    lanes.frequency[l] = parts.frequency[i]
    for k in range(parts.linear.shape[1]):
        for s in range(parts.linear.shape[2]):
            lanes.linear[k, s, l] = parts.linear[i, k, s]
    for k in range(3):
        lanes.mean[k, l], lanes.cos[k, l], lanes.sin[k, l] = parts.mean[i, k], parts.cos[i, k], parts.sin[i, k]
        lanes.arm[k, l] = strength * parts.arm[i, k]
        for t in range(parts.coefficients.shape[2]):
            lanes.coefficients[k, t, l] = strength * parts.coefficients[i, k, t]
        for j in range(3):
            lanes.push[k, j, l] = strength * parts.push[i, k, j]
    for e in range(parts.inputs.shape[1]):
        for h in range(parts.inputs.shape[2]):
            lanes.inputs[e, h, l] = parts.inputs[i, e, h]
    for z in range(parts.strips.shape[1]):
        for j in range(5):
            lanes.strips[z, j, l] = parts.strips[i, z, j]
    for b in range(parts.knots.shape[1]):
        lanes.knots[b, l] = parts.knots[i, b]
        for j in range(4):
            lanes.cubics[b, j, l] = parts.cubics[i, b, j]


@abreast
def _one_hull(strips):
    """Have all lanes the same forms of their strips?"""
    for z in range(strips.shape[0]):
        for j in range(3):
            for l in range(1, strips.shape[2]):
                if strips[z, j, l] != strips[z, j, 0]:
                    return False
    return True


@abreast
def gather(begin, last, parts, lanes):
    """Copy the conditions from ``begin`` on into the lanes; those left over hold the last condition again."""
    for l in range(lanes.frequency.size):
        _put(parts, min(begin + l, last - 1), 1.0, lanes, l)
    lanes.one_hull[0] = _one_hull(lanes.strips)


@abreast
def fill_lane(parts, i, lanes, l):
    """Copy condition ``i`` into lane ``l``."""
    _put(parts, i, 1.0, lanes, l)


@abreast
def fill(i, strength, parts, lanes):
    """Copy one condition into all lanes, its nonlinear parts times ``strength``."""
    for l in range(lanes.frequency.size):
        _put(parts, i, strength, lanes, l)
    lanes.one_hull[0] = True


@abreast
def at_instants(i, share, parts, waves, begin, lanes):
    """Known inputs of condition ``i`` at the instants from ``begin`` on of ``waves`` (h, m), one a lane, times a share.

    They stand where the mean of the input and the cosine of the water would: such lanes are evaluated at waves 1, 0, 0, ..
    """
    last = waves.shape[1] - 1
    for l in range(lanes.frequency.size):
        n = min(begin + l, last)
        for e in range(parts.inputs.shape[1]):
            value = 0.0
            for h in range(parts.inputs.shape[2]):
                value += parts.inputs[i, e, h] * waves[h, n]
                lanes.inputs[e, h, l] = 0.0
            lanes.inputs[e, 0, l] = share * value
        for z in range(parts.strips.shape[1]):
            value = parts.strips[i, z, 3] * waves[1, n] + parts.strips[i, z, 4] * waves[2, n]
            lanes.strips[z, 3, l], lanes.strips[z, 4, l] = share * value, 0.0


@abreast
def room_for(program, lanes):
    """What one evaluation needs: columns, forces, their derivatives, and the sums over strips."""
    width = lanes.frequency.size
    rows, states = lanes.linear.shape[0], lanes.linear.shape[1]
    return (np.zeros((program.width, width)), np.zeros((rows, width)), np.zeros((rows, states, width)),
            np.zeros((6, width)))  # fmt: skip


@abreast
def enter_inputs(program, lanes, waves, columns):
    """Columns of the variables that known inputs enter: input, plus the state it is added to.

    ``waves`` (h,) are 1 and cos, sin of the wave's phase and its multiples, alike in all lanes.
    """
    for e in range(program.extra.size):
        column, of = program.states + e, program.extra[e]
        for l in range(columns.shape[1]):
            columns[column, l] = columns[of, l] if of >= 0 else 0.0
        for h in range(lanes.inputs.shape[1]):
            for l in range(columns.shape[1]):
                columns[column, l] += waves[h] * lanes.inputs[e, h, l]


@abreast
def multiply(links, first, last, columns):
    """Make the columns of links first..last."""
    width = columns.shape[1]
    for i in range(first, last):
        kind, made, a, b = links[i, 0], links[i, 1], links[i, 2], links[i, 3]
        if kind == TIMES:
            for l in range(width):
                columns[made, l] = columns[a, l] * columns[b, l]
        elif kind == SIZE:
            for l in range(width):
                columns[made, l] = abs(columns[a, l])
        elif kind == SIGN:
            for l in range(width):
                columns[made, l] = 1.0 if columns[a, l] >= 0.0 else -1.0
        else:
            for l in range(width):
                columns[made, l] = 1.0


@abreast
def forces(program, lanes, c, s, columns, sums, force):
    """Right-hand sides (k, W) without excitation; the states and known inputs stand in ``columns``, the products are made here.

    ``c, s``: cosine and sine of the wave's phase, for the water at the strips.

    Notes
    -----
    Source: [H71] eq. (3).
    """
    width = columns.shape[1]
    linear, coefficients, products = lanes.linear, lanes.coefficients, program.products
    multiply(program.links, 0, program.values, columns)
    for k in range(linear.shape[0]):
        for l in range(width):
            first = linear[k, 0, l] * columns[0, l] + linear[k, 1, l] * columns[1, l]
            force[k, l] = first + linear[k, 2, l] * columns[2, l] + linear[k, 3, l] * columns[3, l]
        for state in range(4, linear.shape[1]):
            for l in range(width):
                force[k, l] += linear[k, state, l] * columns[state, l]
    for t in range(products.size):
        p = products[t]
        for l in range(width):
            force[0, l] += coefficients[0, t, l] * columns[p, l]
            force[1, l] += coefficients[1, t, l] * columns[p, l]
            force[2, l] += coefficients[2, t, l] * columns[p, l]
    add_strips_and_table(program, lanes, c, s, columns, sums, force)


@abreast
def add_strips_and_table(program, lanes, c, s, columns, sums, force):
    """Add to the right-hand sides what drag by strips and a table of the restoring moment do."""
    width = columns.shape[1]
    if lanes.strips.shape[0] > 0:
        if lanes.one_hull[0]:
            _drag_of_one_hull(lanes.strips, program.velocities, c, s, columns, sums)
        else:
            _drag(lanes.strips, program.velocities, c, s, columns, sums)
        for k in range(3):
            for l in range(width):
                part = lanes.push[k, 0, l] * sums[0, l] + lanes.push[k, 1, l] * sums[1, l]
                force[k, l] += part + lanes.push[k, 2, l] * sums[2, l]
    if lanes.knots.shape[0] > 0:
        _restoring(lanes.knots, lanes.cubics, 0, columns[program.displacements[1]], sums)
        for k in range(3):
            for l in range(width):
                force[k, l] += lanes.arm[k, l] * sums[0, l]


@abreast
def slopes(program, lanes, c, s, columns, sums, jacobian):
    """Derivatives (k, s, W) of the right-hand sides by the state; arguments as of `forces`.

    Notes
    -----
    Source: [H71] eq. (8).
    """
    width = columns.shape[1]
    linear, coefficients = lanes.linear, lanes.coefficients
    multiply(program.links, 0, program.links.shape[0], columns)
    for k in range(linear.shape[0]):
        for state in range(linear.shape[1]):
            for l in range(width):
                jacobian[k, state, l] = linear[k, state, l]
    for i in range(program.factors.size):
        t, state, column = program.slopes[i, 0], program.slopes[i, 1], program.slopes[i, 2]
        factor = program.factors[i]
        for l in range(width):
            slope = factor * columns[column, l]
            jacobian[0, state, l] += coefficients[0, t, l] * slope
            jacobian[1, state, l] += coefficients[1, t, l] * slope
            jacobian[2, state, l] += coefficients[2, t, l] * slope
    if lanes.strips.shape[0] > 0:
        sway, roll, yaw = program.velocities[0], program.velocities[1], program.velocities[2]
        _drag_slopes(lanes.strips, program.velocities, c, s, columns, sums)
        for k in range(3):
            for l in range(width):
                y, m, n = lanes.push[k, 0, l], lanes.push[k, 1, l], lanes.push[k, 2, l]
                jacobian[k, sway, l] += y * sums[0, l] + m * sums[1, l] + n * sums[2, l]
                jacobian[k, roll, l] += y * sums[1, l] + m * sums[3, l] + n * sums[4, l]
                jacobian[k, yaw, l] += y * sums[2, l] + m * sums[4, l] + n * sums[5, l]
    if lanes.knots.shape[0] > 0:
        _restoring(lanes.knots, lanes.cubics, 1, columns[program.displacements[1]], sums)
        for k in range(3):
            for l in range(width):
                jacobian[k, program.displacements[1], l] += lanes.arm[k, l] * sums[0, l]


# Drag of one strip: the water passes it at q = v + x r - h p - w and pushes with f = -c |q| q, c = (1/2) rho C_D T dx, in
# (Y, K, N) = f (1, -h, x): along the gradient of q by (v, p, r). With e = c^(1/3) (1, -h, x) and w times c^(1/3) likewise,
# the force is -|q| q e and its derivative -2 |q| e e^T, with no coefficient left: six numbers of a symmetric matrix.


@abreast
def _drag(strips, velocities, c, s, columns, sums):
    """Sums over strips of |q| q e (3, W); the minus stands in ``push``."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for l in range(width):
        sums[0, l], sums[1, l], sums[2, l] = 0.0, 0.0, 0.0
    for z in range(strips.shape[0]):
        for l in range(width):
            across = strips[z, 0, l] * columns[sway, l] + strips[z, 2, l] * columns[yaw, l]
            q = across + strips[z, 1, l] * columns[roll, l] - (c * strips[z, 3, l] + s * strips[z, 4, l])
            f = q * abs(q)
            sums[0, l] += f * strips[z, 0, l]
            sums[1, l] += f * strips[z, 1, l]
            sums[2, l] += f * strips[z, 2, l]


@abreast
def _drag_of_one_hull(strips, velocities, c, s, columns, sums):
    """`_drag` where all lanes have the strips of one hull, so that their forms are numbers: a third of the memory is read."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for l in range(width):
        sums[0, l], sums[1, l], sums[2, l] = 0.0, 0.0, 0.0
    for z in range(strips.shape[0]):
        v, p, r = strips[z, 0, 0], strips[z, 1, 0], strips[z, 2, 0]
        for l in range(width):
            own = v * columns[sway, l] + p * columns[roll, l] + r * columns[yaw, l]
            q = own - (c * strips[z, 3, l] + s * strips[z, 4, l])
            f = q * abs(q)
            sums[0, l] += f * v
            sums[1, l] += f * p
            sums[2, l] += f * r


@abreast
def _drag_slopes(strips, velocities, c, s, columns, sums):
    """Sums over strips of 2 |q| e e^T: the six entries (vv, vp, vr, pp, pr, rr; W)."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for j in range(6):
        for l in range(width):
            sums[j, l] = 0.0
    for z in range(strips.shape[0]):
        for l in range(width):
            v, p, r = strips[z, 0, l], strips[z, 1, l], strips[z, 2, l]
            own = v * columns[sway, l] + p * columns[roll, l] + r * columns[yaw, l]
            g = 2.0 * abs(own - (c * strips[z, 3, l] + s * strips[z, 4, l]))
            sums[0, l] += g * v * v
            sums[1, l] += g * v * p
            sums[2, l] += g * v * r
            sums[3, l] += g * p * p
            sums[4, l] += g * p * r
            sums[5, l] += g * r * r


@abreast
def _restoring(knots, cubics, by, angle, sums):
    """Moment (by = 0) or its slope (by = 1) at the roll angle, odd in it, from the table of cubics: into sums[0]."""
    most = knots.shape[0] - 1
    for l in range(angle.size):
        roll = angle[l]
        size, b = abs(roll), 0
        while b < most and size > knots[b + 1, l]:
            b += 1
        x = size - knots[b, l]
        if by == 0:
            moment = cubics[b, 0, l] + x * (cubics[b, 1, l] + x * (cubics[b, 2, l] + x * cubics[b, 3, l]))
            sums[0, l] = moment if roll >= 0.0 else -moment
        else:
            sums[0, l] = cubics[b, 1, l] + x * (2.0 * cubics[b, 2, l] + 3.0 * x * cubics[b, 3, l])

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

from quartering._machine.compiled import batch_kernel
from quartering.motion.equations.drag import drag, drag_of_one_hull, drag_slopes, drag_slopes_of_one_hull, one_hull
from quartering.motion.equations.program import SIGN, SIZE, TIMES
from quartering.motion.equations.restoring import (
    CELLS,
    lay_out,
    moment_of_table,
    moment_of_tables,
    one_table,
    slope_of_table,
    slope_of_tables,
)

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
    """`Parts` of a row of lanes, the lane in the last axis, and what `note_equal_lanes` finds.

    ``alike`` (2,): have all the same strips but for the water, and the same table of the restoring moment? Then that table
    stands in ``table`` (b, 5) and ``guide`` (c,), see `restoring`.
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
    table: Floats
    guide: NDArray[np.int64]
    alike: NDArray[np.bool_]


@batch_kernel
def row_of_lanes(parts, width):
    """An empty row of lanes for the numbers of a system."""
    rows, states = parts.linear.shape[1], parts.linear.shape[2]
    return Lanes(
        np.zeros((rows, states, width)), np.zeros((3, parts.coefficients.shape[2], width)), np.zeros((3, width)),
        np.zeros((3, width)), np.zeros((3, width)), np.zeros(width),
        np.zeros((parts.inputs.shape[1], parts.inputs.shape[2], width)), np.zeros((parts.strips.shape[1], 5, width)),
        np.zeros((3, 3, width)), np.zeros((parts.knots.shape[1], width)), np.zeros((parts.knots.shape[1], 4, width)),
        np.zeros((3, width)), np.zeros((parts.knots.shape[1], 5)), np.zeros(CELLS, np.int64), np.zeros(2, np.bool_),
    )  # fmt: skip


@batch_kernel
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


@batch_kernel
def note_equal_lanes(lanes):
    """Note what all lanes have alike, so that it need be read once for them all."""
    lanes.alike[0] = one_hull(lanes.strips)
    lanes.alike[1] = lanes.knots.shape[0] > 0 and one_table(lanes.knots, lanes.cubics)
    if lanes.alike[1]:
        lay_out(lanes.knots, lanes.cubics, lanes.table, lanes.guide)


@batch_kernel
def gather(begin, last, parts, lanes):
    """Copy the conditions from ``begin`` on into the lanes; those left over hold the last condition again."""
    for l in range(lanes.frequency.size):
        _put(parts, min(begin + l, last - 1), 1.0, lanes, l)
    note_equal_lanes(lanes)


@batch_kernel
def fill_lane(parts, i, lanes, l):
    """Copy condition ``i`` into lane ``l``."""
    _put(parts, i, 1.0, lanes, l)


@batch_kernel
def fill(i, strength, parts, lanes):
    """Copy one condition into all lanes, its nonlinear parts times ``strength``."""
    for l in range(lanes.frequency.size):
        _put(parts, i, strength, lanes, l)
    lanes.alike[0], lanes.alike[1] = True, lanes.knots.shape[0] > 0
    if lanes.alike[1]:
        lay_out(lanes.knots, lanes.cubics, lanes.table, lanes.guide)


@batch_kernel
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


@batch_kernel
def room_for(program, lanes):
    """What one evaluation needs: columns, forces, their derivatives, and the sums over strips."""
    width = lanes.frequency.size
    rows, states = lanes.linear.shape[0], lanes.linear.shape[1]
    return (np.zeros((program.width, width)), np.zeros((rows, width)), np.zeros((rows, states, width)),
            np.zeros((6, width)))  # fmt: skip


@batch_kernel
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


@batch_kernel
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


@batch_kernel
def forces(program, lanes, c, s, columns, sums, force):
    """Right-hand sides (k, W) without excitation; the states and known inputs stand in ``columns``, the products are made here.

    ``c, s``: cosine and sine of the wave's phase, for the water at the strips.

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


@batch_kernel
def add_strips_and_table(program, lanes, c, s, columns, sums, force):
    """Add to the right-hand sides what drag by strips and a table of the restoring moment do."""
    width = columns.shape[1]
    if lanes.strips.shape[0] > 0:
        if lanes.alike[0]:
            drag_of_one_hull(lanes.strips, program.velocities, c, s, columns, sums)
        else:
            drag(lanes.strips, program.velocities, c, s, columns, sums)
        for k in range(3):
            for l in range(width):
                part = lanes.push[k, 0, l] * sums[0, l] + lanes.push[k, 1, l] * sums[1, l]
                force[k, l] += part + lanes.push[k, 2, l] * sums[2, l]
    if lanes.knots.shape[0] > 0:
        angle = columns[program.displacements[1]]
        if lanes.alike[1]:
            moment_of_table(lanes.table, lanes.guide, angle, sums[0])
        else:
            moment_of_tables(lanes.knots, lanes.cubics, angle, sums[0])
        for k in range(3):
            for l in range(width):
                force[k, l] += lanes.arm[k, l] * sums[0, l]


@batch_kernel
def slopes(program, lanes, c, s, columns, sums, jacobian):
    """Derivatives (k, s, W) of the right-hand sides by the state; arguments as of `forces`.

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
        if lanes.alike[0]:
            drag_slopes_of_one_hull(lanes.strips, program.velocities, c, s, columns, sums)
        else:
            drag_slopes(lanes.strips, program.velocities, c, s, columns, sums)
        for k in range(3):
            for l in range(width):
                y, m, n = lanes.push[k, 0, l], lanes.push[k, 1, l], lanes.push[k, 2, l]
                jacobian[k, sway, l] += y * sums[0, l] + m * sums[1, l] + n * sums[2, l]
                jacobian[k, roll, l] += y * sums[1, l] + m * sums[3, l] + n * sums[4, l]
                jacobian[k, yaw, l] += y * sums[2, l] + m * sums[4, l] + n * sums[5, l]
    if lanes.knots.shape[0] > 0:
        angle = columns[program.displacements[1]]
        if lanes.alike[1]:
            slope_of_table(lanes.table, lanes.guide, angle, sums[0])
        else:
            slope_of_tables(lanes.knots, lanes.cubics, angle, sums[0])
        for k in range(3):
            for l in range(width):
                jacobian[k, program.displacements[1], l] += lanes.arm[k, l] * sums[0, l]

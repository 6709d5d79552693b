"""The right-hand side: accelerations and their derivatives by the state, the one place where they are computed.

A row of lanes is worked on at once: every operation is done for all of them before the next, so that a processor's vector units
take several together. The lanes are conditions, realisations of a sea, or instants of one motion; one lane is the single case.
The arrays hold the lane in their last axis and nothing a lane does depends on its neighbours.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, maker
from quartering._machine.simd import LANES, every, load, size, store, where_less
from quartering.motion.equations.drag import (
    drag,
    drag_of_one_hull,
    drag_slopes,
    drag_slopes_of_one_hull,
    lay_out_forms,
    one_hull,
)
from quartering.motion.equations.program import PLAIN, SIGN, SIZE, TIMES
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

WIDTH: Final = LANES
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

    ``of`` (W,): which condition stands in each lane. ``alike`` (2,): have all the same strips but for the water, and the same
    table of the restoring moment? Then what the strips have alike stands in ``forms`` (z, 9), see `drag`, and that table in
    ``table`` (5, b) and ``guide`` (2, c), see `restoring`. ``laid`` (2,): the condition whose forms and whose table stand
    there, -1 for none.
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
    guide: Floats
    forms: Floats
    of: NDArray[np.int64]
    alike: NDArray[np.bool_]
    laid: NDArray[np.int64]


@maker
def row_of_lanes(parts, width):
    """An empty row of lanes for the numbers of a system."""
    rows, states = parts.linear.shape[1], parts.linear.shape[2]
    return Lanes(
        np.zeros((rows, states, width)), np.zeros((3, parts.coefficients.shape[2], width)), np.zeros((3, width)),
        np.zeros((3, width)), np.zeros((3, width)), np.zeros(width),
        np.zeros((parts.inputs.shape[1], parts.inputs.shape[2], width)), np.zeros((parts.strips.shape[1], 5, width)),
        np.zeros((3, 3, width)), np.zeros((parts.knots.shape[1], width)), np.zeros((parts.knots.shape[1], 4, width)),
        np.zeros((3, width)), np.zeros((5, parts.knots.shape[1])), np.zeros((2, CELLS + 1)),
        np.zeros((parts.strips.shape[1], 9)), np.zeros(width, np.int64), np.zeros(2, np.bool_), np.full(2, -1),
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
        lanes.strips[z, 3, l], lanes.strips[z, 4, l] = parts.strips[i, z, 3], parts.strips[i, z, 4]
    lanes.of[l] = i


@batch_kernel
def note_equal_lanes(parts, lanes):
    """Lay out once for all lanes what they have alike: the forms of strips, and the table of the restoring moment.

    What differs is copied into the lanes, which is to be done after conditions have been put into them.
    """
    of, laid, first, last = lanes.of, lanes.laid, lanes.of[0], parts.knots.shape[1] - 1
    lanes.alike[0] = laid[0] >= 0 and one_hull(parts.strips, of, laid[0])
    if not lanes.alike[0] and one_hull(parts.strips, of, first):
        lay_out_forms(parts.strips[first], lanes.forms)
        lanes.alike[0], laid[0] = True, first
    lanes.alike[1] = laid[1] >= 0 and one_table(parts.knots, parts.cubics, of, laid[1])
    if not lanes.alike[1] and last >= 0 and one_table(parts.knots, parts.cubics, of, first):
        lanes.alike[1] = lay_out(parts.knots[first], parts.cubics[first], lanes.table, lanes.guide)
        laid[1] = first if lanes.alike[1] else -1
    for l in range(lanes.of.size):
        i = lanes.of[l]
        if not lanes.alike[0]:
            for z in range(parts.strips.shape[1]):
                for j in range(3):
                    lanes.strips[z, j, l] = parts.strips[i, z, j]
        if not lanes.alike[1]:
            for b in range(last + 1):
                lanes.knots[b, l] = parts.knots[i, b]
                for j in range(4):
                    lanes.cubics[b, j, l] = parts.cubics[i, b, j]


@batch_kernel
def gather(begin, last, parts, lanes):
    """Copy the conditions from ``begin`` on into the lanes; those left over hold the last condition again."""
    for l in range(lanes.frequency.size):
        _put(parts, min(begin + l, last - 1), 1.0, lanes, l)
    note_equal_lanes(parts, lanes)


@batch_kernel
def fill_lane(parts, i, lanes, l):
    """Copy condition ``i`` into lane ``l``; `note_equal_lanes` follows when all are there."""
    _put(parts, i, 1.0, lanes, l)


@batch_kernel
def fill(i, strength, parts, lanes):
    """Copy one condition into all lanes, its nonlinear parts times ``strength``."""
    for l in range(lanes.frequency.size):
        _put(parts, i, strength, lanes, l)
    note_equal_lanes(parts, lanes)


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


@maker
def room_for(program, lanes):
    """What one evaluation needs: columns, forces, their derivatives, and the sums over strips with room for each strip."""
    width = lanes.frequency.size
    rows, states = lanes.linear.shape[0], lanes.linear.shape[1]
    return (np.zeros((program.width, width)), np.zeros((rows, width)), np.zeros((rows, states, width)),
            np.zeros((7 + lanes.strips.shape[0], width)))  # fmt: skip


@batch_kernel
def enter_inputs(program, lanes, waves, columns):
    """Columns of the variables that known inputs enter: input, plus the state it is added to.

    ``waves`` (h,) are 1 and cos, sin of the wave's phase and its multiples, alike in all lanes. Without products nobody asks
    for them.
    """
    if program.products.size == 0:
        return
    for e in range(program.extra.size):
        column, of = program.states + e, program.extra[e]
        value = load(columns, of) if of >= 0 else every(0.0)
        for h in range(lanes.inputs.shape[1]):
            value += waves[h] * load(lanes.inputs, (e, h))
        store(columns, column, value)


@batch_kernel
def multiply(links, first, last, columns):
    """Make the columns of links first..last."""
    for i in range(first, last):
        kind, made, a, b = links[i, 0], links[i, 1], links[i, 2], links[i, 3]
        if kind == TIMES:
            store(columns, made, load(columns, a) * load(columns, b))
        elif kind == SIZE:
            store(columns, made, size(load(columns, a)))
        elif kind == SIGN:
            store(columns, made, where_less(load(columns, a), 0.0, -1.0, 1.0))
        else:
            store(columns, made, every(1.0))


@batch_kernel
def forces(program, lanes, c, s, columns, sums, force):
    """Right-hand sides (k, W) without excitation; the states and known inputs stand in ``columns``, the products are made here.

    ``c, s``: cosine and sine of the wave's phase, for the water at the strips.

    Source: [H71] eq. (3).
    """
    linear, coefficients, products = lanes.linear, lanes.coefficients, program.products
    if _without_products(program, lanes):
        _forces_without_products(program, lanes, c, s, columns, sums, force)
        return
    multiply(program.links, 0, program.values, columns)
    for k in range(3, linear.shape[0]):
        row = every(0.0)
        for state in range(linear.shape[1]):
            row += load(linear, (k, state)) * load(columns, state)
        store(force, k, row)
    x, y, z = every(0.0), every(0.0), every(0.0)
    for state in range(linear.shape[1]):
        own = load(columns, state)
        x += load(linear, (0, state)) * own
        y += load(linear, (1, state)) * own
        z += load(linear, (2, state)) * own
    for t in range(products.size):
        own = load(columns, products[t])
        x += load(coefficients, (0, t)) * own
        y += load(coefficients, (1, t)) * own
        z += load(coefficients, (2, t)) * own
    store(force, 0, x)
    store(force, 1, y)
    store(force, 2, z)
    add_strips_and_table(program, lanes, c, s, columns, sums, force)


@batch_kernel
def add_strips_and_table(program, lanes, c, s, columns, sums, force):
    """Add to the right-hand sides what drag by strips and a table of the restoring moment do."""
    if lanes.strips.shape[0] > 0:
        _forces_of_strips(program, lanes, c, s, columns, sums)
        y, m, n = load(sums, 0), load(sums, 1), load(sums, 2)
        for k in range(3):
            part = load(lanes.push, (k, 0)) * y + load(lanes.push, (k, 1)) * m
            store(force, k, load(force, k) + (part + load(lanes.push, (k, 2)) * n))
    if lanes.knots.shape[0] > 0:
        _moment(program, lanes, columns, sums)
        for k in range(3):
            store(force, k, load(force, k) + load(lanes.arm, k) * load(sums, 6))


@batch_kernel
def _without_products(program, lanes):
    """Is there nothing beside linear terms in (v, phi, p, r) but drag by strips and a table, as of most ships?"""
    plain = program.products.size == 0 and program.states == PLAIN
    return plain and lanes.strips.shape[0] > 0 and lanes.knots.shape[0] > 0


@batch_kernel
def _forces_of_strips(program, lanes, c, s, columns, sums):
    """The three sums of drag by strips, in front."""
    if lanes.alike[0]:
        drag_of_one_hull(lanes.strips, lanes.forms, program.velocities, c, s, columns, sums)
    else:
        drag(lanes.strips, program.velocities, c, s, columns, sums)


@batch_kernel
def _moment(program, lanes, columns, sums):
    """Moment of the table, behind the sums of strips."""
    angle = columns[program.displacements[1]]
    if lanes.alike[1]:
        moment_of_table(lanes.table, lanes.guide, angle, sums[6])
    else:
        moment_of_tables(lanes.knots, lanes.cubics, angle, sums[6])


@batch_kernel
def _forces_without_products(program, lanes, c, s, columns, sums, force):
    """`forces` where `_without_products`: each is written once."""
    linear, push = lanes.linear, lanes.push
    _forces_of_strips(program, lanes, c, s, columns, sums)
    _moment(program, lanes, columns, sums)
    v, angle, p, r = load(columns, 0), load(columns, 1), load(columns, 2), load(columns, 3)
    y, m, n, moment = load(sums, 0), load(sums, 1), load(sums, 2), load(sums, 6)
    for k in range(3):
        own = load(linear, (k, 0)) * v + load(linear, (k, 1)) * angle + load(linear, (k, 2)) * p
        own += load(linear, (k, 3)) * r
        own += load(push, (k, 0)) * y + load(push, (k, 1)) * m + load(push, (k, 2)) * n
        store(force, k, own + load(lanes.arm, k) * moment)


@batch_kernel
def slopes(program, lanes, c, s, columns, sums, jacobian):
    """Derivatives (k, s, W) of the right-hand sides by the state; arguments as of `forces`.

    Source: [H71] eq. (8).
    """
    linear, coefficients = lanes.linear, lanes.coefficients
    if _without_products(program, lanes):
        _slopes_without_products(program, lanes, c, s, columns, sums, jacobian)
        return
    multiply(program.links, 0, program.links.shape[0], columns)
    for k in range(3, linear.shape[0]):
        for state in range(linear.shape[1]):
            store(jacobian, (k, state), load(linear, (k, state)))
    i = 0
    for state in range(linear.shape[1]):  # the slopes stand in the order of the states
        x, y, z = load(linear, (0, state)), load(linear, (1, state)), load(linear, (2, state))
        while i < program.factors.size and program.slopes[i, 1] == state:
            t = program.slopes[i, 0]
            slope = program.factors[i] * load(columns, program.slopes[i, 2])
            x += load(coefficients, (0, t)) * slope
            y += load(coefficients, (1, t)) * slope
            z += load(coefficients, (2, t)) * slope
            i += 1
        store(jacobian, (0, state), x)
        store(jacobian, (1, state), y)
        store(jacobian, (2, state), z)
    if lanes.strips.shape[0] > 0:
        _slopes_of_strips(program, lanes, c, s, columns, sums)
        _add_drag_slopes(program.velocities, lanes.push, sums, jacobian)
    if lanes.knots.shape[0] > 0:
        held = program.displacements[1]
        _slopes_of_table(program, lanes, columns, sums)
        for k in range(3):
            own = load(jacobian, (k, held)) + load(lanes.arm, k) * load(sums, 6)
            store(jacobian, (k, held), own)


@batch_kernel
def _slopes_of_strips(program, lanes, c, s, columns, sums):
    """The six sums of drag by strips, in front."""
    if lanes.alike[0]:
        drag_slopes_of_one_hull(lanes.strips, lanes.forms, program.velocities, c, s, columns, sums)
    else:
        drag_slopes(lanes.strips, program.velocities, c, s, columns, sums)


@batch_kernel
def _slopes_of_table(program, lanes, columns, sums):
    """Slope of the table of the restoring moment, behind the sums of strips."""
    angle = columns[program.displacements[1]]
    if lanes.alike[1]:
        slope_of_table(lanes.table, lanes.guide, angle, sums[6])
    else:
        slope_of_tables(lanes.knots, lanes.cubics, angle, sums[6])


@batch_kernel
def _slopes_without_products(program, lanes, c, s, columns, sums, jacobian):
    """`slopes` where `_without_products`: each is written once."""
    _slopes_of_strips(program, lanes, c, s, columns, sums)
    _slopes_of_table(program, lanes, columns, sums)
    for k in range(3):
        y, m, n = load(lanes.push, (k, 0)), load(lanes.push, (k, 1)), load(lanes.push, (k, 2))
        for j, (a, b, d) in enumerate(((0, 1, 2), (1, 3, 4), (2, 4, 5))):
            state = program.velocities[j]
            own = y * load(sums, a) + m * load(sums, b) + n * load(sums, d)
            store(jacobian, (k, state), load(lanes.linear, (k, state)) + own)
        held = program.displacements[1]
        store(jacobian, (k, held), load(lanes.linear, (k, held)) + load(lanes.arm, k) * load(sums, 6))


@batch_kernel
def _add_drag_slopes(velocities, push, sums, jacobian):
    """Add accelerations per unit of force times the symmetric matrix of the strips (vv, vp, vr, pp, pr, rr; W)."""
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    vv, vp, vr = load(sums, 0), load(sums, 1), load(sums, 2)
    pp, pr, rr = load(sums, 3), load(sums, 4), load(sums, 5)
    for k in range(3):
        y, m, n = load(push, (k, 0)), load(push, (k, 1)), load(push, (k, 2))
        store(jacobian, (k, sway), load(jacobian, (k, sway)) + (y * vv + m * vp + n * vr))
        store(jacobian, (k, roll), load(jacobian, (k, roll)) + (y * vp + m * pp + n * pr))
        store(jacobian, (k, yaw), load(jacobian, (k, yaw)) + (y * vr + m * pr + n * rr))

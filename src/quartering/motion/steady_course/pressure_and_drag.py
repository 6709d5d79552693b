"""Forces on a ship that moves on its course, at one instant: pressure, products of the velocities, drag. Compiled kernels."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math

import numpy as np

from quartering._machine.compiled import batch_kernel, inlined
from quartering.loads.wetted_hull.section_tables import table_load, table_room

# Order of the modes: heave, pitch, sway, roll, yaw. A state is (h, theta, v, phi, r) and the rate p of roll beside it; the
# derivatives of the five forces are by (h, theta, v, phi, r, p).


@inlined
def rooms(tables):
    """What one evaluation works in."""
    return table_room(tables.x.size), np.empty(6), np.empty((6, 4)), np.empty(3), np.empty(4)


# The ship surges by xi = a sum (c_j cos j w t + s_j sin j w t) about the place of its mean speed, and meets the wave at
# k cos mu xi before its time.
@batch_kernel
def phase_met(numbers, i, phase):
    """Phase of the wave at G, with the surge."""
    xi = 0.0
    for j in range(numbers.surge.shape[1]):
        xi += numbers.surge[i, j, 0] * math.cos((j + 1) * phase) + numbers.surge[i, j, 1] * math.sin((j + 1) * phase)
    return phase - numbers.wave[i, 2] * numbers.wave[i, 0] * numbers.amplitude[i] * xi


@batch_kernel
def instant(tables, numbers, i, course_phase, x, p, room, force, slope):
    """Forces (5,) and their derivatives (5, 6) at a phase of the encounter; False where a section leaves its table."""
    scratch, load, jacobian, state, wave = room
    phase = phase_met(numbers, i, course_phase)
    state[0], state[1], state[2] = x[0], x[3], x[1]
    a = numbers.amplitude[i]
    wave[0], wave[1], wave[2], wave[3] = a, numbers.wave[i, 0], numbers.wave[i, 1], numbers.wave[i, 2] * phase
    table_load(
        tables.x, tables.weight, tables.z0, tables.wavenumber, tables.first, tables.step, tables.spline,
        state, wave, scratch, load, jacobian,
    )  # fmt: skip
    if math.isnan(load[2]):
        return False
    weight, share = numbers.scale[0], numbers.share
    load[2] += numbers.scale[1]
    for m in range(5):
        row = 2 if m == 0 else 4 if m == 1 else 1 if m == 2 else 3 if m == 3 else 5
        by = weight * share[m]
        force[m] = by * load[row]
        slope[m, 0], slope[m, 1], slope[m, 2] = by * jacobian[row, 0], by * jacobian[row, 2], 0.0
        slope[m, 3], slope[m, 4], slope[m, 5] = by * jacobian[row, 1], 0.0, 0.0
    c, s = math.cos(phase), math.sin(phase)
    for m in range(5):
        force[m] += a * (numbers.force[i, m].real * c - numbers.force[i, m].imag * s)
    for m in range(3):
        force[2 + m] += numbers.heel[i, m] * x[3]
        slope[2 + m, 3] += numbers.heel[i, m]
    add_products(numbers, i, x, p, force, slope)
    _drag(numbers, i, a * c, a * s, x, p, force, slope)
    return True


@batch_kernel
def add_products(numbers, i, x, p, force, slope):
    """Add the products of (v, phi, p, r)."""
    for t in range(numbers.modulus.size):
        value = 1.0
        for s in range(4):
            value *= _of(x, p, s) ** numbers.powers[t, s]
        bar = numbers.modulus[t] - 1
        size = abs(_of(x, p, bar)) if bar >= 0 else 1.0
        for m in range(3):
            force[2 + m] += numbers.products[i, m, t] * value * size
        for s in range(4):
            change, power = 0.0, numbers.powers[t, s]
            if power > 0:
                change = float(power) * size
                for other in range(4):
                    change *= _of(x, p, other) ** (numbers.powers[t, other] - (1 if other == s else 0))
            if s == bar:
                change += value * (1.0 if _of(x, p, s) >= 0.0 else -1.0)
            column = 2 if s == 0 else 3 if s == 1 else 5 if s == 2 else 4
            for m in range(3):
                slope[2 + m, column] += numbers.products[i, m, t] * change


@inlined
def _of(x, p, s):
    """v, phi, p or r."""
    return x[2] if s == 0 else x[3] if s == 1 else p if s == 2 else x[4]


@batch_kernel
def _drag(numbers, i, c, s, x, p, force, slope):
    """Add the drag -|q| q e of every strip, and -2 |q| e e^T; see `equations.drag`."""
    strips = numbers.strips
    for z in range(strips.shape[1]):
        ev, ep, er = strips[i, z, 0], strips[i, z, 1], strips[i, z, 2]
        q = ev * x[2] + ep * p + er * x[4] - (strips[i, z, 3] * c + strips[i, z, 4] * s)
        f, g = -q * abs(q), -2.0 * abs(q)
        force[2] += f * ev
        force[3] += f * ep
        force[4] += f * er
        slope[2, 2] += g * ev * ev
        slope[2, 4] += g * ev * er
        slope[2, 5] += g * ev * ep
        slope[3, 2] += g * ep * ev
        slope[3, 4] += g * ep * er
        slope[3, 5] += g * ep * ep
        slope[4, 2] += g * er * ev
        slope[4, 4] += g * er * er
        slope[4, 5] += g * er * ep

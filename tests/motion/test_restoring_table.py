"""The table of the restoring moment in the kernels is the spline it was made from.

Authority: closed form, the sum of truncated powers that `OddSpline` is.
"""

import numba
import numpy as np
import pytest

import quartering as qt
from quartering._machine.simd import LANES
from quartering.hull.righting.spline import odd_spline
from quartering.motion.equations.rates import forces, gather, room_for, row_of_lanes, slopes

TERMS = {"Y_v": -0.4, "K_p": -0.05, "N_r": -0.6}
WIDE = np.arange(4.0, 85.0, 4.0)
TABLES = {
    "a ship's": WIDE,
    "no knot": np.array([20.0, 40.0, 60.0]),
    "closer than cells": np.arange(0.5, 60.0, 0.5),
    "two knots in one cell": np.insert(WIDE, 5, 20.2),
    "one beyond the last cell": np.append(WIDE, [92.0, 105.0, 120.0]),
    "two beyond it": np.append(WIDE, [100.0, 110.0, 120.0, 130.0]),
}
SEARCHED = {"closer than cells", "two knots in one cell", "two beyond it"}


@numba.njit
def _at(program, parts, angles, moment, slope):
    """Roll acceleration and its slope (n, W) at roll angles (n, W); is the table found by cells?"""
    lanes = row_of_lanes(parts, LANES)
    columns, force, jacobian, sums = room_for(program, lanes)
    gather(0, 1, parts, lanes)
    for i in range(angles.shape[0]):
        columns[:] = 0.0
        columns[1] = angles[i]
        forces(program, lanes, 1.0, 0.0, columns, sums, force)
        slopes(program, lanes, 1.0, 0.0, columns, sums, jacobian)
        moment[i], slope[i] = force[1], jacobian[1, 1]
    return lanes.alike[1]


def _angles(knots):
    """All about, and on either side of every knot and every end of a cell, of both signs [rad]."""
    ends = np.radians(0.75) * np.arange(131)
    at = np.concatenate([[0.0], knots, ends])
    at = np.concatenate([at, at * (1 + 1e-15), at * (1 - 1e-15), np.radians(np.linspace(0.0, 170.0, 501))])
    at = np.concatenate([at, -at])
    return np.append(at, np.zeros(-at.size % LANES)).reshape(-1, LANES)


@pytest.mark.parametrize("table", TABLES)
def test_moment_and_slope_are_those_of_the_spline(table):
    degrees = TABLES[table]
    values = np.sin(np.radians(degrees)) + 0.1 * np.sin(np.radians(4.0 * degrees))
    spline = odd_spline(degrees, values)
    system = qt.Model(np.eye(3), TERMS, 0.8, (0, 0.1, 0), (0, 0, 0), restoring=(degrees, values)).system
    angles = _angles(spline.knots)
    moment, slope = np.empty_like(angles), np.empty_like(angles)
    by_cells = _at(system.program, system.parts, angles, moment, slope)
    assert by_cells is (table not in SEARCHED)
    size = np.abs(spline.value(angles)).max()
    np.testing.assert_allclose(moment, -spline.value(angles), rtol=0, atol=1e-12 * size)
    np.testing.assert_allclose(slope, -spline.derivative(angles), rtol=0, atol=1e-12 * size)


def test_an_angle_that_is_no_number_leaves_its_neighbours_as_they_are():
    degrees = TABLES["a ship's"]
    system = qt.Model(
        np.eye(3), TERMS, 0.8, (0, 0.1, 0), (0, 0, 0), restoring=(degrees, np.sin(np.radians(degrees)))
    ).system
    angles = np.linspace(-1.0, 1.0, 2 * LANES).reshape(2, LANES)
    angles[1] = np.where(np.arange(LANES) == 3, np.nan, angles[0])
    moment, slope = np.empty_like(angles), np.empty_like(angles)
    _at(system.program, system.parts, angles, moment, slope)
    others = np.arange(LANES) != 3
    assert np.isnan(moment[1, 3])
    assert np.isnan(slope[1, 3])
    np.testing.assert_array_equal(moment[1, others], moment[0, others])
    np.testing.assert_array_equal(slope[1, others], slope[0, others])

"""Piecewise cubics and zeros by numpy alone are those of scipy, to the last digit."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.optimize import brentq

from quartering._machine.piecewise import cubic_spline, monotone_cubic, monotone_slopes, zero

SHAPES = ((), (2,), (4, 3, 3))


def points(seed, fewest=3):
    """Places, values of several shapes with flats and knees among them, and places between and beyond."""
    made = np.random.default_rng(seed)
    count = int(made.integers(fewest, 40))
    x = np.cumsum(made.uniform(0.01, 3.0, count))
    y = np.cumsum(made.normal(size=(count, *SHAPES[seed % 3])), axis=0)
    return x, np.round(y) if seed % 4 == 0 else y, made.uniform(x[0] - 1, x[-1] + 1, 50)


@pytest.mark.parametrize("seed", range(30))
def test_monotone_cubics_are_those_of_pchip(seed):
    x, y, between = points(seed)
    ours, theirs = monotone_cubic(x, y), PchipInterpolator(x, y)
    assert np.array_equal(ours.c, theirs.c)
    assert np.array_equal(ours(between), theirs(between))
    assert np.array_equal(monotone_slopes(x, y), theirs.derivative()(x))


@pytest.mark.parametrize("seed", range(30))
def test_splines_are_those_of_scipy(seed):
    x, y, between = points(seed, fewest=4)
    size = np.abs(y).max()
    natural = ((2, np.zeros(y.shape[1:])), "not-a-knot")
    for ours, theirs in (
        (cubic_spline(x, y), CubicSpline(x, y)),
        (cubic_spline(x, y, True), CubicSpline(x, y, 0, natural)),
    ):
        # The library of linear algebra may eliminate in another order on another processor: a few digits are left to it.
        assert np.abs(ours.c - theirs.c).max() <= 1e-12 * np.abs(theirs.c).max()
        inside = between[(between > x[0]) & (between < x[-1])]
        assert np.abs(ours(inside) - theirs(inside)).max() <= 1e-12 * max(size, np.abs(theirs(inside)).max())


def test_one_place_gives_one_value():
    x, y, _ = points(5)
    assert monotone_cubic(x, y)(x[1]).shape == SHAPES[2]
    assert np.array_equal(monotone_cubic(x, y)(x[1]), y[1])


def test_a_line_between_two_points_keeps_its_slope():
    x, y = np.array([1.0, 3.0]), np.array([2.0, -2.0])
    assert monotone_slopes(x, y).tolist() == [-2.0, -2.0]


@pytest.mark.parametrize("steep", [0.1, 0.7, 2.9])
@pytest.mark.parametrize("xtol", [1e-3, 2e-12, 1e-14])
def test_zeros_are_those_of_brentq(steep, xtol):
    def of(x):
        return np.tanh(steep * (x - 1)) + 0.1 * steep * (x - 1) ** 3 - 0.2

    assert zero(of, -2.0, 7.3, xtol=xtol) == brentq(of, -2.0, 7.3, xtol=xtol)


def test_a_zero_at_an_end_is_found_there():
    assert zero(lambda x: x - 2.0, 2.0, 5.0) == 2.0
    assert zero(lambda x: x - 5.0, 2.0, 5.0) == 5.0


def test_no_change_of_sign_is_refused_with_both_values():
    with pytest.raises(ValueError, match="9 at 0 and 16 at 1"):
        zero(lambda x: (x + 3.0) ** 2, 0.0, 1.0)

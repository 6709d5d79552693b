"""Vectors of eight numbers in kernels: each operation is that of numpy on the same numbers (IEEE 754 arithmetic)."""

import numba
import numpy as np
import pytest

from quartering._machine.simd import LANES, all_at_most, every, load, pick, root, size, store, where_less


@numba.njit
def _operations(a, out):
    x, y = load(a, 0), load(a, 1)
    store(out, 0, x + y)
    store(out, 1, x - 2.0 * y)
    store(out, 2, x / y)
    store(out, 3, -x * 3.0)
    store(out, 4, size(x))
    store(out, 5, root(size(x)))
    store(out, 6, where_less(x, y, x, y))
    store(out, 7, where_less(x, 0.0, -1.0, every(1.0)))
    total = every(0.0)
    for i in range(2):
        total += load(a, i)
    total -= y
    store(out, 8, total)


def test_each_operation_is_that_of_numpy():
    a = np.random.default_rng(4).normal(size=(2, LANES))
    x, y = a
    out = np.empty((9, LANES))
    _operations(a, out)
    wanted = [x + y, x - 2 * y, x / y, -x * 3, np.abs(x), np.sqrt(np.abs(x)), np.minimum(x, y), np.where(x < 0, -1, 1)]
    # a multiply-add may be done in one rounding: 2 units in the last place of the larger part
    assert np.allclose(out[:8], wanted, rtol=0, atol=4e-16 * np.abs(wanted).max())
    assert np.allclose(out[8], x, rtol=0, atol=4e-16 * np.abs(a).max())


@numba.njit
def _inside(a, limit):
    return all_at_most(load(a, 0), limit)


@pytest.mark.parametrize(("worst", "inside"), [(1.0, True), (1.5, False), (np.nan, False), (-9.0, True)])
def test_one_lane_past_a_limit_or_not_a_number_tells_for_all(worst, inside):
    a = np.zeros((1, LANES))
    a[0, LANES - 1] = worst
    assert _inside(a, 1.0) is inside


@numba.njit
def _picked(array, places, out):
    store(out, (), pick(array, load(places, ())))


def test_each_lane_picks_its_own_element():
    array, places = np.random.default_rng(6).normal(size=50), np.array([7.0, 0.0, 49.0, 7.0, 31.0, 48.0, 1.0, 2.0])
    out = np.empty(LANES)
    _picked(array, places, out)
    assert out.tolist() == array[places.astype(int)].tolist()


@numba.njit
def _first_of_three_axes(a, i, j, out):
    store(out, (), load(a, (i, j)))


def test_a_place_is_that_of_the_leading_indices():
    a = np.arange(2 * 3 * LANES, dtype=float).reshape(2, 3, LANES)
    out = np.empty(LANES)
    _first_of_three_axes(a, 1, 2, out)
    assert out.tolist() == a[1, 2].tolist()


def test_arrays_that_do_not_lie_row_by_row_are_refused_as_the_kernel_is_compiled():
    with pytest.raises(numba.TypingError, match="row-major"):
        _inside(np.zeros((LANES, 2)).T, 1.0)

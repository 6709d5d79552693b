import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from quartering.conventions import InputError
from quartering.loads.strips.interpolation import frequency_weights, interpolated

GRID = np.array([0.05, 0.1, 0.2, 0.5, 0.9, 1.6, 3.0])


@given(st.floats(0.05, 3.0), st.tuples(*[st.floats(-5, 5)] * 4))
def test_cubics_are_interpolated_exactly(frequency, coefficients):
    first, weights = frequency_weights(GRID, [frequency])
    assert weights.sum() == pytest.approx(1.0, abs=1e-12)
    exact = np.polyval(coefficients, frequency)
    assert interpolated(np.polyval(coefficients, GRID), first, weights)[0] == pytest.approx(exact, abs=1e-9)


def test_at_a_grid_point_the_table_value_itself_comes_back():
    values = np.arange(7) ** 2 + 1j
    np.testing.assert_allclose(interpolated(values, *frequency_weights(GRID, GRID)), values, rtol=1e-14)


def test_beyond_the_ends_the_end_values_stand():
    values = np.exp(-GRID)
    np.testing.assert_allclose(interpolated(values, *frequency_weights(GRID, [0.0, 50.0])), values[[0, -1]], rtol=1e-14)


@pytest.mark.parametrize("grid", [[0.5], [0.5, 1.0], [0.5, 1.0, 2.0]])
def test_short_tables_are_read_with_what_they_have(grid):
    first, weights = frequency_weights(grid, [0.7])
    assert first.tolist() == [0]
    assert weights.shape == (1, len(grid))
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, rtol=1e-14)


def test_error_falls_with_the_fourth_power_of_the_spacing():
    errors = []
    for points in (21, 41, 81):
        grid, at = np.linspace(0, 3, points), np.linspace(0.5, 2.5, 301)
        errors.append(np.abs(interpolated(np.sin(2 * grid), *frequency_weights(grid, at)) - np.sin(2 * at)).max())
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 4.0, atol=0.15)


@pytest.mark.parametrize(
    ("grid", "frequency"), [([], [0.5]), ([1.0, 0.5], [0.7]), ([0.5, 1.0], [-0.7]), ([0.5, 1.0], [np.nan])]
)
def test_bad_tables_and_frequencies_are_refused(grid, frequency):
    with pytest.raises(InputError):
        frequency_weights(grid, frequency)

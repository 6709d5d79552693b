"""Eigenvalues of small matrices against closed forms and LAPACK."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from quartering.stability.variational.eigenvalues import eigenvalues

pytestmark = pytest.mark.quick


def apart(found, expected):
    """Largest distance (n,) from an expected eigenvalue to the nearest found one, and back, over the largest of them."""
    distance = np.abs(found[:, :, None] - expected[:, None, :])
    size = np.abs(expected).max(axis=1)
    return np.maximum(distance.min(axis=1).max(axis=1), distance.min(axis=2).max(axis=1)) / size


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5, 6])
def test_random_matrices_as_lapack(size):
    """numpy.linalg.eigvals (LAPACK dgeev); rows of sizes apart by e^9, as metres and radians are."""
    random = np.random.default_rng(size)
    matrices = random.normal(size=(3000, size, size)) * np.exp(3 * random.normal(size=(3000, size, 1)))
    assert apart(eigenvalues(matrices), np.linalg.eigvals(matrices).astype(complex)).max() < 1e-11


@given(st.lists(st.floats(-3, 3), min_size=4, max_size=4))
def test_companion_matrix_has_the_roots_it_was_made_from(roots):
    """Closed form; eigenvalues of multiplicity m move by the m-th root of rounding, so the polynomial is compared."""
    coefficients = np.poly(roots)
    matrix = np.diag(np.ones(3), -1)
    matrix[0] = -coefficients[1:]
    np.testing.assert_allclose(np.poly(eigenvalues(matrix[None])[0]).real, coefficients, atol=1e-11 * 4**4)


def test_rotation_that_plain_shifts_never_reduce():
    """A cyclic permutation has the fourth roots of one; ordinary shifts leave it as it is."""
    found = eigenvalues(np.roll(np.eye(4), 1, axis=0)[None])[0]
    np.testing.assert_allclose(sorted(found, key=np.angle), [-1j, 1, 1j, -1], atol=1e-14)


def test_defective_and_zero_matrices():
    jordan = np.array([[[0.5, 1.0, 0.0], [0.0, 0.5, 1.0], [0.0, 0.0, 0.5]], np.zeros((3, 3))])
    np.testing.assert_allclose(eigenvalues(jordan), [[0.5] * 3, [0.0] * 3], atol=1e-15)


def test_not_a_number_in_one_matrix_stays_there():
    matrices = np.stack([np.eye(4), np.full((4, 4), np.nan), np.diag([4.0, 3.0, 2.0, 1.0])])
    found = eigenvalues(matrices)
    assert np.isnan(found[1]).all()
    np.testing.assert_allclose(found[2], [4, 3, 2, 1])


def test_no_matrix_feels_its_neighbours():
    """Eight go side by side, easy and hard ones: in another order each has the same bytes."""
    random = np.random.default_rng(8)
    matrices = random.normal(size=(200, 6, 6)) * np.exp(3 * random.normal(size=(200, 6, 1)))
    matrices[::7], matrices[3::11] = np.roll(np.eye(6), 1, axis=0), np.diag(np.arange(6.0))
    order = random.permutation(200)
    np.testing.assert_array_equal(eigenvalues(matrices[order]), eigenvalues(matrices)[order])

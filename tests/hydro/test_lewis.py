import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from quartering.conventions import InputError
from quartering.hydro.section.lewis import (
    added_mass_at_infinite_frequency,
    added_mass_at_zero_frequency,
    area_coefficient_limits,
    lewis_contour,
    lewis_forms,
)
from quartering.hydro.section.multipole import radiation
from tests.hydro.section_cases import read_table

pytestmark = pytest.mark.quick

ratios = st.floats(0.02, 50.0)
shares = st.floats(0.03, 0.9)


@pytest.mark.parametrize("row", read_table("lewis_limits.csv"), ids=lambda row: row["breadth_to_draught"])
def test_limits_agree_with_independently_evaluated_closed_forms(row):
    value = {key: float(entry) for key, entry in row.items()}
    B = value["breadth_to_draught"]
    A = B * value["area_coefficient"]
    forms = lewis_forms(B / 2.0, 1.0, A)
    zero = added_mass_at_zero_frequency(forms, 1.0)[0] / [A, A * B, A * B**2]
    infinite, heave = added_mass_at_infinite_frequency(forms, 1.0)
    infinite = infinite[0] / [A, A * B, A * B**2]
    # the table is rounded to 6 decimals, its area coefficient too (half a digit, 5e-7, moves a3 by as much at most);
    # its a22 at infinity is good to 1e-5
    assert np.allclose([forms.a1[0], forms.a3[0]], [value["a1"], value["a3"]], rtol=0, atol=5e-7)
    assert np.allclose(zero, [value["a22_zero"], value["a24_zero"], value["a44_zero"]], rtol=0, atol=1e-6)
    assert np.allclose(infinite, [value["a22_infinite"], value["a24_infinite"], value["a44_infinite"]], atol=1e-5)
    assert heave[0] / A == pytest.approx(value["a33_infinite"], abs=1e-6)


def test_half_circle_closed_forms():
    circle = lewis_forms(2.0, 2.0, 2.0 * np.pi)
    half_disc = 1025.0 * 2.0 * np.pi  # rho pi r^2/2
    infinite, heave = added_mass_at_infinite_frequency(circle, 1025.0)
    assert np.allclose(added_mass_at_zero_frequency(circle, 1025.0)[0], [half_disc, 0.0, 0.0], atol=1e-9)
    assert np.allclose(infinite[0], [4.0 / np.pi**2 * half_disc, 0.0, 0.0], atol=1e-9)
    assert heave[0] == pytest.approx(half_disc)


def test_solution_at_zero_frequency_is_the_closed_form():
    B, T = np.array([0.2, 1.0, 2.0, 3.0, 8.0]), np.ones(5)
    forms = lewis_forms(B / 2.0, T, 0.85 * B * T)
    solved = radiation(forms, [0.0], density=1.0)
    limit = added_mass_at_zero_frequency(forms, 1.0)
    a = solved.added_mass[0]
    assert np.allclose(a[:, 0, 0], limit[:, 0], rtol=1e-6)
    assert np.allclose(a[:, 0, 1], limit[:, 1], rtol=0, atol=1e-6 * np.sqrt(limit[:, 0] * limit[:, 2]).max())
    assert np.allclose(a[:, 1, 1], limit[:, 2], rtol=1e-6)
    assert (solved.damping == 0.0).all()


def test_solution_approaches_the_infinite_frequency_closed_form_like_one_over_the_wavenumber():
    forms = lewis_forms([1.0, 0.6, 1.5], 1.0, [0.8 * 2.0, 0.8 * 1.2, 0.9 * 3.0])
    infinite, heave = added_mass_at_infinite_frequency(forms, 1.0)
    w = np.sqrt(9.81 * np.array([30.0, 60.0]))
    lateral = radiation(forms, w, density=1.0).added_mass
    missing = np.stack([lateral[..., 0, 0] - infinite[:, 0], lateral[..., 1, 1] - infinite[:, 2]])
    vertical = radiation(forms, w, "heave", density=1.0).added_mass[..., 0, 0] - heave
    assert np.allclose(missing[:, 1] / missing[:, 0], 0.5, atol=0.1)
    assert np.allclose(vertical[1] / vertical[0], 0.5, atol=0.1)


@given(ratio=ratios, share=shares, size=st.floats(0.01, 100.0))
def test_form_keeps_breadth_draught_and_area(ratio, share, size):
    lower, upper = area_coefficient_limits(ratio)
    sigma = lower + share * (upper - lower)
    form = lewis_forms(ratio * size, size, 2.0 * ratio * size**2 * sigma)
    point, _ = lewis_contour(form, np.array([0.0, np.pi / 2.0]))
    theta, weight = np.polynomial.legendre.leggauss(24)
    fine, normal = lewis_contour(form, (theta + 1.0) * np.pi / 4.0)
    area = 2.0 * np.pi / 4.0 * (fine.imag * normal.imag * weight).sum()  # 2 int z n_z ds
    assert not form.clipped[0]
    assert point[0, 0] == pytest.approx(ratio * size, rel=1e-9, abs=1e-9 * size)
    assert point[0, 1] == pytest.approx(1j * size, rel=1e-9, abs=1e-9 * ratio * size)
    assert area == pytest.approx(form.area[0], rel=1e-9)
    assert area == pytest.approx(2.0 * ratio * size**2 * sigma, rel=1e-9)


@given(ratio=ratios, share=st.floats(-2.0, 3.0))
def test_area_outside_the_range_takes_the_nearest_form_and_says_by_how_much(ratio, share):
    lower, upper = area_coefficient_limits(ratio)
    asked = max(lower + share * (upper - lower), 0.0)
    form = lewis_forms(ratio, 1.0, 2.0 * ratio * asked)
    assert lower < form.area_coefficient[0] < upper
    assert form.excess[0] == pytest.approx(asked - form.area_coefficient[0], abs=1e-12)
    assert form.clipped[0] == (form.excess[0] != 0.0)
    if share > 1.0:
        assert form.area_coefficient[0] == pytest.approx(upper - 0.05 * (upper - lower))
    if share < 0.0:
        assert form.area_coefficient[0] == pytest.approx(lower + 0.02 * (upper - lower))


def test_sections_without_breadth_draught_or_extent_become_small_forms_and_are_marked():
    form = lewis_forms([0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [0.1, 0.0, 0.0, 1.5])
    assert form.stretched.tolist() == [True, True, True, False]
    assert form.half_breadth[0] == pytest.approx(0.02)
    assert form.draught[1] == pytest.approx(0.02)
    assert form.half_breadth[2] == pytest.approx(0.02e-6)
    assert np.isfinite(form.scale).all()


@pytest.mark.parametrize(
    ("sizes", "word"),
    [
        (([1.0], [-1.0], [1.0]), "draught"),
        (([np.nan], [1.0], [1.0]), "half breadth"),
        (([1.0], [1.0], [np.inf]), "area"),
    ],
)
def test_impossible_sizes_are_refused_by_name(sizes, word):
    with pytest.raises(InputError, match=f"section 0: {word}"):
        lewis_forms(*sizes)

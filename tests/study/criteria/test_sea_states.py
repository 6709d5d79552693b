"""Sea states of the criteria are consistent with one another, with closed forms, and with the theory's reference."""

import math

import numpy as np
import pytest

from quartering.study.criteria.sea_states import (
    bretschneider,
    effective_deviation,
    joint_density,
    scatter,
    wave_cases,
)

EFFECTIVE = [  # length [m], Hs [m], Tz [s], root of m0 [m], quadrature of the theory's reference
    (262.0, 8.5, 10.5, 1.534360226897493), (175.0, 5.5, 9.5, 0.9518828348188736), (120.0, 3.5, 7.5, 0.6209326395079781)
]  # fmt: skip
DENSITY = [  # length, Hs, Tz, ratio, steepness, density: closed form of the theory's reference
    (262.0, 8.5, 10.5, 1.0, 0.03, 14.324278371865391), (262.0, 8.5, 10.5, 1.25, 0.06, 0.0007959348258640487),
    (262.0, 8.5, 10.5, 2.0, 0.1, 2.478109422572691e-56), (175.0, 5.5, 9.5, 1.0, 0.1, 1.8356983999874844e-06),
    (175.0, 5.5, 9.5, 2.0, 0.03, 0.004312795241914677),
]  # fmt: skip


def test_the_wave_cases_follow_from_the_scatter_table():
    """Authority: 48 numbers recalled apart from the table: weight, length of the mean period, 0.7 of the mean height."""
    table, cases = scatter(), wave_cases()
    share = table.weight.sum(axis=0)
    kept = share > 0
    height = (table.weight * table.hs[:, None]).sum(axis=0)[kept] / share[kept]
    np.testing.assert_allclose(cases[:, 0], share[kept], atol=5e-7)
    mean = 1.0864 * table.tz[kept]
    np.testing.assert_allclose(cases[:, 1], 9.81 * mean**2 / (2 * math.pi), rtol=3e-5)
    np.testing.assert_allclose(cases[:, 2], 0.7 * height, atol=6e-4)


def test_the_spectrum_has_the_moments_of_its_closed_form():
    """m0 = Hs^2/16; T01/Tz = pi^(1/4)/Gamma(3/4) and nu = sqrt(m0 m2/m1^2 - 1) = 0.42467."""
    w = np.geomspace(0.05, 400.0, 400_000)
    density = bretschneider(w, 4.0, 8.0)
    m0, m1, m2 = (np.trapezoid(w**n * density, w) for n in range(3))
    assert m0 == pytest.approx(1.0, rel=1e-6)
    assert 2 * math.pi * math.sqrt(m0 / m2) == pytest.approx(8.0, rel=2e-4)  # m2's tail falls with w^-2
    assert 2 * math.pi * m0 / m1 / 8.0 == pytest.approx(math.pi**0.25 / math.gamma(0.75), rel=1e-5)
    assert math.sqrt(m0 * m2 / m1**2 - 1) == pytest.approx(0.42467, rel=1e-3)


@pytest.mark.parametrize(("length", "hs", "tz", "deviation"), EFFECTIVE)
def test_the_effective_wave_is_that_of_the_reference(length, hs, tz, deviation):
    assert effective_deviation(length, hs, tz) == pytest.approx(deviation, rel=1e-4)


def test_the_effective_wave_vanishes_for_a_ship_much_longer_than_the_waves():
    assert effective_deviation(5000.0, 4.0, 6.0) < 0.03


@pytest.mark.parametrize(("length", "hs", "tz", "ratio", "steepness", "density"), DENSITY)
def test_the_joint_density_is_that_of_the_reference(length, hs, tz, ratio, steepness, density):
    assert joint_density(length, hs, tz, ratio, steepness) == pytest.approx(density, rel=1e-9)


def test_the_joint_density_integrates_to_one():
    """By definition of a density; waves of up to three significant heights, of any length: the tail falls with r^-1.5."""
    ratio = np.geomspace(1e-4, 1e12, 4000)[:, None]
    height_share = np.linspace(1e-6, 3.0, 800)[None, :]
    per_height = 3.5 / (120.0 * ratio)
    density = joint_density(120.0, 3.5, 7.5, ratio, height_share * per_height) * per_height
    over_heights = np.trapezoid(density, height_share, axis=1)
    assert np.trapezoid(over_heights * ratio[:, 0], np.log(ratio[:, 0])) == pytest.approx(1.0, abs=1e-4)

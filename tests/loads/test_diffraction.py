from types import SimpleNamespace

import numpy as np
import pytest

from quartering.conventions import GRAVITY, WATER_DENSITY
from quartering.loads.strips.diffraction import contour_diffraction
from quartering.loads.strips.interpolation import frequency_weights, interpolated
from quartering.loads.strips.stations import Stations

SECTIONS, POINTS = 5, 6


def made_up_table(seed=7):
    """Any numbers will do where only the bookkeeping of the integrals is tested."""
    draw = np.random.default_rng(seed)
    y, z, ny, nz = (draw.uniform(0.1, 5.0, (SECTIONS, POINTS)) for _ in range(4))
    psi = draw.normal(size=(6, SECTIONS, POINTS, 2)) + 1j * draw.normal(size=(6, SECTIONS, POINTS, 2))
    return SimpleNamespace(frequency=np.linspace(0.1, 2.0, 6), y=y, z=z, ny=ny, nz=nz, psi=psi)


def by_definition(stations, table, k, U, mu):
    """The same integrals over both sides of the contour, with the complex wave and no symmetry used."""
    sigma, delta = np.sqrt(GRAVITY * k), np.pi - np.deg2rad(mu)
    k1, k2 = k * np.cos(delta), k * np.sin(delta)
    w = sigma + k1 * U
    psi = interpolated(table.psi, *frequency_weights(table.frequency, [abs(w)]))[0]
    psi = psi.conj() if w < 0 else psi

    def momentum(s, x):
        total = np.zeros(2, complex)
        for side in (1, -1):
            y, z, ny, nz = side * table.y[s], table.z[s], side * table.ny[s], table.nz[s]
            wave = np.exp(-k * z) * np.exp(1j * (k1 * x - k2 * y))
            normal = 1j * sigma * np.sin(delta) * wave * ny + sigma * wave * nz
            total += WATER_DENSITY * (side * psi[s] * normal[:, None]).sum(axis=0)
        return total

    G = np.array([momentum(s, x) for s, x in enumerate(stations.x)])
    end = momentum(0, stations.x_aft) * stations.transom
    sway, roll = -(1j * w * stations.weight @ G + U * end)
    yaw = -(((1j * w * stations.x + U) * stations.weight) @ G[:, 0] + U * stations.x_aft * end[0])
    return np.array([sway, roll - stations.z0 * sway, yaw])


@pytest.mark.parametrize("transom", [False, True])
@pytest.mark.parametrize(
    ("k", "U", "mu"), [(0.05, 0.0, 90.0), (0.1, 6.0, 30.0), (0.02, 8.0, 150.0), (0.2, 15.0, 20.0), (0.2, 15.0, -20.0)]
)
def test_kernel_agrees_with_the_contour_integral_over_both_sides(transom, k, U, mu):
    table = made_up_table()
    stations = Stations(np.linspace(-9, 11, SECTIONS), np.linspace(2, 4, SECTIONS), 0.7, -10.0, transom)
    ours = contour_diffraction(stations, table, [k], [U], [mu])[0]
    np.testing.assert_allclose(ours, by_definition(stations, table, k, U, mu), rtol=1e-11)


def test_a_batch_is_the_conditions_one_by_one():
    table = made_up_table()
    stations = Stations(np.linspace(-9, 11, SECTIONS), np.ones(SECTIONS), 0.7, -9.0, True)
    k, U, mu = np.array([0.05, 0.1, 0.2]), np.array([0.0, 6.0, 15.0]), np.array([30.0, -60.0, 0.0])
    together = contour_diffraction(stations, table, k, U, mu)
    alone = [contour_diffraction(stations, table, k[i : i + 1], U[i : i + 1], mu[i : i + 1])[0] for i in range(3)]
    np.testing.assert_array_equal(together, alone)


def test_at_exactly_zero_encounter_frequency_the_force_is_finite():
    k = 0.1
    stations = Stations(np.linspace(-9, 11, SECTIONS), np.ones(SECTIONS), 0.7, -9.0, True)
    U = np.sqrt(GRAVITY / k) / np.cos(np.deg2rad(30.0))
    assert np.isfinite(contour_diffraction(stations, made_up_table(), [k], [U], [30.0])).all()


def test_in_head_and_following_seas_nothing_pushes_sideways():
    stations = Stations(np.linspace(-9, 11, SECTIONS), np.ones(SECTIONS), 0.7, -9.0, True)
    np.testing.assert_array_equal(
        contour_diffraction(stations, made_up_table(), [0.1, 0.1], [5.0, 5.0], [0.0, 180.0]), 0.0
    )

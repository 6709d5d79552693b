"""The edge of stability against closed forms, shooting, and verdicts on either side of it."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.paper.model import paper_ship
from tests.shooting import shoot

IDLE = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0}
ZETA, BETA, FORCE = 0.02, 0.2, 0.1


@pytest.fixture(scope="module")
def duffing_folds():
    model = qt.Model(np.eye(3), IDLE | {"K_phiphiphi": -BETA, "K_p": -2 * ZETA}, 1.0, (0, FORCE, 0), (0, 0, 0))
    return qt.edge(model, ("frequency", "excitation"), limits=((0.9, 1.6), (0.1, 1.5)), harmonics=1)


@pytest.mark.soak
def test_every_point_is_a_fold_of_the_one_harmonic_duffing_curve(duffing_folds):
    """Closed form [H71] App. C with damping: both the response curve and its fold condition hold."""
    w, force = duffing_folds["frequency"].values, FORCE * duffing_folds["excitation"].values
    square = np.radians(duffing_folds["roll"].values) ** 2
    stiff = 1 - w**2 + 0.75 * BETA * square
    np.testing.assert_allclose((stiff**2 + (2 * ZETA * w) ** 2) * square, force**2, rtol=1e-9)
    np.testing.assert_allclose(stiff * (1 - w**2 + 2.25 * BETA * square) + (2 * ZETA * w) ** 2, 0.0, atol=1e-12)
    assert set(duffing_folds["kind"].values) == {"fold"}


@pytest.mark.soak
def test_both_folds_and_their_cusp_are_one_curve(duffing_folds):
    """Closed form: the fold condition has a double root where w^2 - 1 = 2 sqrt(3) zeta w."""
    assert set(duffing_folds["curve"].values) == {0}
    w = duffing_folds["frequency"].values
    cusp = np.sqrt(3) * ZETA + np.sqrt(1 + 3 * ZETA**2)
    assert cusp - 1e-12 < w.min() < cusp + 1e-3
    lowest = int(w.argmin())
    assert 0 < lowest < w.size - 1
    # The double root of 27/16 b^2 s^2 + 3 b (1 - w^2) s + .. = 0 in s = P^2:
    square = 8 * (cusp**2 - 1) / (9 * BETA)
    assert np.radians(duffing_folds["roll"].values[lowest]) ** 2 == pytest.approx(square, rel=0.05)


def escape(force, frequency):
    return qt.Model(np.eye(3), IDLE | {"K_p": -0.1, "K_phiphi": 1.0}, frequency, (0, 0, 0), (0, force, 0))


@pytest.mark.soak
def test_period_doubling_of_the_escape_equation_in_two_parameters_agrees_with_shooting():
    """At every point of the edge a multiplier of the motion, by shooting, is -1."""
    ds = qt.edge(escape(1.0, 0.85), ("excitation", "frequency"), limits=((0.08, 0.11), (0.82, 0.86)), harmonics=7)
    doubling = np.flatnonzero((ds["kind"] == "period-doubling") & (ds["periods"] == 1))
    assert doubling.size > 4
    for i in doubling[:: max(1, doubling.size // 4)]:
        force, frequency = float(ds["excitation"][i]), float(ds["frequency"][i])
        model = escape(force, frequency)
        motion = min(qt.all_motions(model, 9), key=lambda m: abs(np.degrees(m.amplitude[1]) - float(ds["roll"][i])))
        _, multipliers = shoot(lambda x: (x - x**2, 1 - 2 * x), 0.1, force, frequency, motion.state(0.0)[1:3])
        assert np.abs(multipliers + 1).min() < 1e-5


@pytest.mark.soak
def test_a_ships_edge_divides_stable_verdicts_from_unstable_ones():
    """Brute force: 3 % less wave height is stable and 3 % more is not, at every heading along the edge."""
    ship = paper_ship().with_(factors={"K_prr": -60.0})
    wave, speed = qt.Wave(121.92, 3.0), 8.6
    ds = qt.edge(
        ship, ("wave_height", "heading"), limits=((2.2, 3.6), (24.0, 36.0)), wave=wave, speed=speed, heading=30.0
    )
    first = ds.isel(point=np.flatnonzero((ds["kind"] == "neimark-sacker") & (ds["roll"] < 10)))
    assert first.sizes["point"] > 5
    np.testing.assert_allclose(first["exponent"], 0.0, atol=1e-9)
    for i in range(0, first.sizes["point"], 4):
        height, heading = float(first["wave_height"][i]), float(first["heading"][i])
        heights = [0.97 * height, 1.03 * height]
        around = qt.sweep(
            ship, speed=[speed], heading=[heading], wave_length=[wave.length], wave_height=heights, harmonics=9
        )
        below, above = around["verdict"].values.ravel()
        assert below == 0
        assert above > 0


@pytest.mark.soak
def test_where_nothing_changes_the_edge_is_empty():
    calm = qt.Model(np.eye(3), IDLE | {"K_p": -0.3}, 1.0, (0, 0.1, 0), (0, 0, 0))
    ds = qt.edge(calm, ("frequency", "excitation"), limits=((0.8, 1.2), (0.5, 1.0)))
    assert ds.sizes["point"] == 0
    assert {"frequency", "excitation", "kind"} <= set(ds.variables)


@pytest.mark.soak
def test_one_parameter_twice_and_a_ship_without_a_wave_are_refused():
    model = qt.Model(np.eye(3), IDLE, 1.0, (0, 0.1, 0), (0, 0, 0))
    with pytest.raises(qt.InputError, match="different"):
        qt.edge(model, ("frequency", "frequency"))
    with pytest.raises(qt.InputError, match="wave"):
        qt.edge(qt.ship("wigley"))

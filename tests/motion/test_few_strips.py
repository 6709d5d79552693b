"""Few strips and few samples of a cycle against many: what the drag and the table of the righting arm lose by them."""

from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.equations.few_strips import gauss_of_stations
from quartering.motion.of_ship import ship_system
from quartering.motion.steady import harmonic
from quartering.motion.steady.harmonic import harmonic_balance


def test_rule_of_stations_has_the_moments_of_all_of_them():
    """Gauss' rule of m points is exact to degree 2 m - 1 [Golub69]; with a depth beside, to degree m - 1."""
    random = np.random.default_rng(5)
    x, c, depth = np.sort(random.uniform(-80, 70, 41)), random.uniform(0, 3, 41), random.uniform(2, 9, 41)
    places, weights, depths = gauss_of_stations(x, c, depth, 8)
    assert weights.min() > 0
    assert x[0] < places.min()
    assert places.max() < x[-1]
    for degree in range(16):
        size = (c * np.abs(x) ** degree).sum()
        assert (weights * places**degree).sum() == pytest.approx((c * x**degree).sum(), abs=1e-11 * size)
        if degree < 8:
            wanted = (c * depth * x**degree).sum()
            assert (weights * depths * places**degree).sum() == pytest.approx(wanted, abs=1e-10 * 9 * size)
    assert gauss_of_stations(x, c, depth, 41)[0].tolist() == x.tolist()


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
@pytest.mark.parametrize(
    "name", ["s175", *(pytest.param(one, marks=pytest.mark.soak) for one in ("series60-cb60", "dtc"))]
)
def test_roll_is_that_of_a_strip_at_every_station_and_of_many_samples(name, monkeypatch):
    """In steep waves of 0.5 to 30 lengths: 1e-4 of roll or slope in 99 of 100, 2e-4 in all; by samples of the cycle 2e-4.

    Those that miss most lie where a small change of the damping is a large one of roll, at resonance and near folds.
    """
    ship = qt.ship(name)
    scale, length = np.sqrt(9.81 * ship.hull.length), ship.hull.length
    axes = (np.array([0.0, 0.1, 0.25]) * scale, np.arange(15.0, 180.0, 30.0), np.array([0.5, 0.75, 1, 2, 3, 5, 30]))
    speed, heading, ratio, steepness = (a.ravel() for a in np.meshgrid(*axes, [1 / 60, 1 / 20], indexing="ij"))
    waves = (2 * np.pi / (ratio * length), speed, heading)
    amplitude = 0.5 * steepness * ratio * length
    base = ship_system(ship, *waves).system

    def roll(points: int | None):
        system = replace(base, strips=drag_strips(ship, *waves, points=points).array).raised(amplitude)
        u, status, _ = harmonic_balance(system, (1,), from_rest=True)
        return np.where(status <= 1, np.hypot(u[:, 1, 0], u[:, 1, 1]), np.nan)

    few, every = roll(20), roll(None)
    assert base.strips.shape[1] == 20
    usual = every < np.radians(50)
    assert usual.mean() > 0.95
    size = np.maximum(every, amplitude * waves[0])[usual]
    apart = (np.abs(few - every)[usual]) / size
    assert np.quantile(apart, 0.99) < 1e-4
    assert apart.max() < 2e-4
    monkeypatch.setattr(harmonic, "FEWEST", 256)
    by_samples = np.abs(roll(None) - every)[usual] / every[usual]
    other = by_samples > 0.1
    assert other.sum() <= 1  # where the motion from rest passes a fold, a last digit may decide which one is found
    assert np.quantile(by_samples, 0.99) < 1e-4
    assert by_samples[~other].max() < 2e-4

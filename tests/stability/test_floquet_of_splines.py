"""Multipliers of ships with a righting spline in maps: long steps of Magnus' series against Runge-Kutta's short ones."""

import numpy as np
import pytest

import quartering as qt
from quartering.hydro.capsize import capsize_limit
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.motion import roll_peaks, steady_motions
from quartering.stability.assessment import assess
from quartering.study.conditions import ACCURACY


@pytest.mark.parametrize(("drag", "share"), [("cubic", 1.0), ("strips", 2.0)])
@pytest.mark.parametrize("name", ["dtmb5415", "series60-cb60"])
def test_multipliers_of_a_map_have_its_accuracy(name, drag, share):
    """Authority: fourth-order Runge-Kutta at 1e-10.

    The corners that |q| has in time fall between the samples of the variation, which no more steps mend: twice the accuracy.
    Of motions whose two largest multipliers nearly meet the difference is magnified, by either method: one in a hundred.
    """
    ship, random, n = qt.ship(name).with_(righting="spline", drag=drag), np.random.default_rng(1971), 300
    length = ship.hull.length
    wave = length * random.uniform(0.5, 2.5, n)
    speed, heading = random.uniform(0.0, 0.25, n) * np.sqrt(9.81 * length), random.uniform(0.0, 180.0, n)
    amplitude = 0.5 * wave / random.uniform(12.0, 40.0, n)
    system = ship_system(ship, 2 * np.pi / wave, speed, heading).at_amplitude(amplitude[:, None])
    u, orders, status, _ = steady_motions(system, 1, start="rest")
    peak = roll_peaks(u, orders)
    kept = (status <= 1) & (peak < capsize_limit(ship).radians)
    u = np.where(kept[:, None, None], u, np.nan)
    assert np.degrees(peak[kept]).max() > 30.0
    fast, exact = (assess(system, u, orders, accuracy, detail="map") for accuracy in (ACCURACY, 1e-10))
    found, expected = (np.abs(one.floquet.multipliers[kept, 0]) for one in (fast, exact))
    assert np.quantile(np.abs(found - expected) / np.maximum(1.0, expected), 0.99) < share * ACCURACY
    np.testing.assert_array_equal(fast.kind, exact.kind)

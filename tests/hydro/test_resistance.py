"""Estimated resistance against the worked example of its authors, and limits."""

import math

import numpy as np
import pytest

import quartering as qt
from quartering.hydro.propulsion import drive_of, estimated_drive
from quartering.hydro.resistance import (
    HullForm,
    correlation,
    entrance,
    form_factor,
    friction,
    outside,
    resistance,
    wave_resistance,
)

# Worked example of [Holtrop82] (recalled): L 205 m, B 32 m, T 10 m, 37,500 m3, C_M 0.98, C_WP 0.75, centre of buoyancy 0.75 per
# cent of the waterline aft of its middle, transom 16 m2, bulb 20 m2 at 4 m, 25 knots, S 7381.45 m2, appendages 50 m2.
CB = 37500 / (205 * 32 * 10)
EXAMPLE = HullForm(205.0, 32.0, 10.0, 37500.0, 7381.45, -0.75, CB / 0.98, 0.98, 0.75, CB, 16.0)
SPEED, SEA = 25 * 0.5144, 1025.0


def test_the_example_of_the_authors_comes_out():
    """R_F 869.63 kN, R_W 557.11 kN with the bulb's factor, R_A 221.98 kN with appendages, 1 + k 1.156 with C_stern 10."""
    assert EXAMPLE.run * 205 == pytest.approx(81.385, abs=0.001)
    assert entrance(EXAMPLE) == pytest.approx(12.08, abs=0.005)
    assert 1.03 * form_factor(EXAMPLE) == pytest.approx(1.156, abs=0.0006)
    assert float(friction(EXAMPLE, SPEED, SEA)) / 1e3 == pytest.approx(869.63, rel=1e-4)
    bulb = math.exp(-1.89 * math.sqrt(0.56 * 20**1.5 / (32 * 10 * (0.31 * math.sqrt(20) + 10 - 4))))
    assert bulb * float(wave_resistance(EXAMPLE, SPEED, SEA)) / 1e3 == pytest.approx(557.11, rel=1e-3)
    allowance = 7431.45 / 7381.45 * float(correlation(EXAMPLE, SPEED, SEA)) / 1e3
    assert allowance == pytest.approx(221.98, rel=1e-3)


def test_the_wave_resistance_has_no_step_where_its_formulas_meet():
    unit = math.sqrt(9.81 * 205)
    for froude in (0.4, 0.55):
        low, high = wave_resistance(EXAMPLE, unit * np.array([froude - 1e-9, froude + 1e-9]), SEA)
        assert high == pytest.approx(low, rel=1e-6)


@pytest.mark.parametrize("name", ["fishing-30m", "coaster-90m", "dtc", "s175", "dtmb5415", "series60-cb60", "wigley"])
def test_the_polynomial_is_the_estimate_within_what_it_says(name):
    ship = qt.ship(name)
    drive = estimated_drive(ship)
    said = float(drive.source.partition("within ")[2].partition(" %")[0])
    speed = np.linspace(0.2, 0.6, 41) * math.sqrt(9.81 * ship.hull.length)
    miss = np.array([drive.propulsion.drag(u) for u in speed]) / resistance(ship, speed) - 1
    assert 0.5 * said < 100 * np.abs(miss).max() <= 1.06 * said  # it is told with two digits
    assert all(drive.propulsion.drag(u) >= 0 for u in np.linspace(0, speed[0], 20))


def test_what_is_given_comes_before_what_is_told_and_what_is_told_before_an_estimate():
    ship, given = qt.ship("s175"), qt.Propulsion((0, 0, 2e4), 6.0, thrust=(0.4, -0.3, -0.1))
    assert drive_of(ship) is None
    assert drive_of(ship, estimate=True).estimated
    told = ship.with_(propulsion={"diameter": 6.5, "k0": 0.45, "k1": -0.3, "r2": 2e4})
    assert drive_of(told, estimate=True).propulsion.diameter == 6.5
    assert drive_of(told, given).propulsion == given


def test_a_hull_far_from_the_models_is_said_or_refused():
    assert any("B/T" in one for one in outside(HullForm(100, 20, 2, 3000, 2000, 0, 0.7, 0.9, 0.8, 0.63, 0.0)))
    with pytest.raises(qt.InputError, match="give propulsion"):
        resistance(qt.ship("box").with_(beam=60.0), 5.0)

"""Irregular seas in six modes: one wave is the regular one, low seas are linear, failures are counted."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.six_modes import vertical_motion
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.march import march_in_steps
from quartering.study.six_modes.irregular import Banded, _cells, components, marched
from tests.tiers import mostly_soak

SHIP = qt.ship("s175").with_(gm=1.0)


@pytest.mark.parametrize(("heading", "miss"), [(180.0, 1e-8), (0.0, 1e-8), (150.0, 1e-4)])
def test_a_sea_of_one_wave_is_that_wave(heading, miss):
    """Authority: the march in one regular wave by another kernel; 1e-4 in oblique seas.

    There the surface at a section that roll moves aside is taken by its slope, (k z0 sin mu)^2/2 of it off at the most.
    """
    k, a, speed = 2 * np.pi / 175, 2.6, 5.0
    one = course(SHIP, k, *(np.array([v]) for v in (a, speed, heading)))
    wave = tuple(np.array([v]) for v in (a, np.sqrt(9.81 * k), heading, 0.0))
    banded = Banded(np.empty(0), np.array([k]), one.tables, one.tables.spline[None])
    sea = components(one, banded, wave)
    h, steps, out = 2 * np.pi / one.numbers.omega[0] / 48, 48 * 20, np.zeros(6)
    marched(one, banded, sea, h, 0.0, 0.0, 1.5, steps, out)
    state = march_in_steps(one, np.zeros(10), h, steps).state[1:]
    assert out[:2] == pytest.approx((state[:, :2] ** 2).sum(axis=0), rel=miss)
    if heading == 150.0:
        assert out[2] == pytest.approx((state[:, 5] ** 2).sum(), rel=miss)
        assert out[4] == pytest.approx(np.abs(state[:, 5]).max(), rel=miss)


LOW_SEAS = [(180.0, 5.0), (0.0, 7.0)]


@pytest.mark.parametrize(("heading", "speed"), mostly_soak(LOW_SEAS, LOW_SEAS[1], several=True))
def test_a_low_sea_has_the_heave_and_pitch_of_linear_theory(heading, speed):
    """Spectrum times squared linear responses, 200 waves in 2 h: 6 %.

    In the following sea each ship's own heave and pitch would grow with the coefficients of that slow encounter.
    """
    sea = qt.Sea(hs=0.2, tp=12, heading=heading)
    found = qt.irregular(SHIP, sea, speed, hours=2, seed=3, modes="six")
    cells = _cells(sea)
    speeds = np.full(cells.sigma.size, speed)
    moved = vertical_motion(SHIP, cells.sigma**2 / 9.81, speeds, cells.heading, float(SHIP.value("gyradius_pitch")))
    wanted = np.sqrt(cells.m0 * (np.diff(cells.share, prepend=0.0) @ np.abs(moved[:, 1:]) ** 2))
    assert float(found.heave_rms) == pytest.approx(wanted[0], rel=0.06)
    assert np.radians(float(found.pitch_rms)) == pytest.approx(wanted[1], rel=0.06)
    assert (found.failures, float(found.exposure)) == (0, 2.0)
    again = qt.irregular(SHIP, sea, speed, hours=0.5, seed=3, modes="six")
    assert float(again.roll_largest[0]) == float(found.roll_largest[0])


def test_failures_are_counted_with_their_interval():
    """Closed form: k failures in T have the rate k/T; each block ends with its own."""
    sea = qt.Sea(hs=5, tp=12, heading=60)
    found = qt.irregular(SHIP, sea, 5.0, hours=2, seed=1, limit=np.radians(9.0), modes="six")
    times, failed = found.failure_time.values, np.isfinite(found.failure_time.values)
    assert found.failures == failed.sum() > 0
    assert (found.failure_cause.values[failed] == "roll").all()
    assert (found.roll_largest.values[failed] >= 9.0).all()
    assert (found.roll_largest.values[~failed] < 9.0).all()
    exposure = np.where(failed, times, 1800.0).sum()
    assert float(found.exposure) == pytest.approx(exposure / 3600)
    assert float(found.failure_rate) == pytest.approx(failed.sum() / exposure)
    assert float(found.rate_lower) < float(found.failure_rate) < float(found.rate_upper)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"modes": "four"}, '"three"'),
        ({"strips": 3}, "leave strips out"),
        ({"seed": -1}, "whole number"),
        ({"hours": 0}, "hours"),
    ],
)
def test_what_it_cannot_be_asked_is_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        qt.irregular(SHIP, qt.Sea(hs=2, tp=10), 5.0, **({"modes": "six"} | given))


def test_a_sea_that_the_ship_keeps_pace_with_is_refused():
    with pytest.raises(qt.InputError, match="near encounter frequency 0"):
        qt.irregular(SHIP, qt.Sea(hs=3, tp=10, heading=0), 15.0, hours=0.5, modes="six")

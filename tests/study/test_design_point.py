"""Rare rolls by their likeliest sea and importance sampling: exact for a linear ship, against counting for another."""

import numpy as np
import pytest
from scipy.special import ndtr

import quartering as qt
from quartering.study.seas.simulated.asked import asked_of
from quartering.study.seas.simulated.design_point import _sampled, _windows
from quartering.study.seas.simulated.planned import planned
from tests.study.sea_cases import CASES, MODEL, force, matrix

LINEAR = qt.Model(np.eye(3), dict(list(MODEL.terms.items())[:12]), 1.0, (0, 0, 0), (0, 0, 0))
pytestmark = pytest.mark.filterwarnings("ignore:sea of .* steepness:quartering.conventions.RangeWarning")


@pytest.mark.parametrize("name", CASES)
def test_a_linear_ship_is_known_exactly(name):
    """beta = level/deviation, P = N(-beta), up-crossings exp(-beta^2/2)/Tz: deviations and Tz of an independent program.

    Windows of 220 s from rest lack exp(-2 0.03 220) of the variance at most; records of 880 s smear the narrowest resonance
    by some 3e-3 of it.
    """
    sea, speed, linear, _, _, period, *_ = CASES[name]
    sigma = np.degrees(np.sqrt(matrix(linear)[1, 1]))
    found = qt.design_point(LINEAR, qt.Sea(**sea), speed, roll=3.5 * sigma, force=force)
    np.testing.assert_allclose((found["beta"], found["linear_beta"]), 3.5, rtol=3e-3)
    smeared = 3.5 * 3e-3 * 3.8  # change of ln N(-b) by that of b
    for value, error, expected in (
        ("probability", "probability_error", ndtr(-3.5)),
        ("crossing_rate", "crossing_rate_error", np.exp(-0.5 * 3.5**2) / period),
    ):
        assert abs(float(found[value]) - expected) < 3 * float(found[error]) + smeared * expected
    assert float(found["roll"][-1]) == pytest.approx(3.5 * sigma, rel=3e-3)
    assert float(found["roll"][0]) == 0.0
    # an eighth or so of the windows counts: of N windows N(-b)^2/(e^(b^2) N(-2b)) in closed form
    expected = 4096 * ndtr(-3.5) ** 2 / (np.exp(3.5**2) * ndtr(-7.0))
    np.testing.assert_allclose(found["effective"], expected, rtol=0.2)


@pytest.mark.parametrize(("windows", "level"), [(12_288, 24.0), pytest.param(131_072, 30.0, marks=pytest.mark.soak)])
def test_a_nonlinear_ship_is_met_by_counting(windows, level):
    """The same windows drawn without a shift and counted, both signs: within three combined standard errors."""
    sea, speed, *_ = CASES["long_quartering"]
    found = qt.design_point(MODEL, qt.Sea(**sea), speed, roll=level, force=force)
    assert float(found["beta"]) > 1.05 * float(
        found["linear_beta"]
    )  # it hardens: a linear ship would roll there oftener
    asked = asked_of(MODEL, qt.Sea(**sea), speed, None, 20, True, force, "stf")
    ready = planned(asked)
    own = _windows(ready, asked.sea, MODEL.capsize_limit.radians)
    nothing = np.zeros((*own.record.roots.shape[:2], 2))
    counted = _sampled(own, nothing, 0.0, np.radians(level), windows, (20, ready.plan.condition), ready.roll_frequency)
    error = np.hypot(float(found["probability_error"]), counted.probability_error)
    assert counted.effective > 50
    assert abs(float(found["probability"]) - counted.probability) < 3 * error
    error = np.hypot(float(found["crossing_rate_error"]), counted.rate_error)
    assert abs(float(found["crossing_rate"]) - counted.rate) < 3 * error


def test_the_same_numbers_from_the_same_seed_and_others_from_another():
    sea, speed, *_ = CASES["long_beam"]
    given = {"roll": 30.0, "force": force, "windows": 1024}
    one, same, other = (qt.design_point(MODEL, qt.Sea(**sea), speed, seed=seed, **given) for seed in (1, 1, 2))
    assert one.identical(same)
    assert float(one["probability"]) != float(other["probability"])
    np.testing.assert_array_equal(one["beta"], other["beta"])


SEA = qt.Sea(**CASES["long_beam"][0])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: qt.design_point(MODEL, SEA, 0.0, 0.0, force=force), "roll = 0 deg; it is above 0 deg"),
        (lambda: qt.design_point(MODEL, SEA, 0.0, "95 deg", force=force), "at most 90 deg"),
        (lambda: qt.design_point(qt.ship("series60-cb60"), SEA, 5.0, 85.0), "beyond it a ship does not come back"),
        (lambda: qt.design_point(MODEL, SEA, 0.0, 30.0, 0.0, force=force), "does not roll the ship"),
        (lambda: qt.design_point(MODEL, SEA, 0.0, 30.0, force=force, windows=64), "effective windows of 64 count"),
        (lambda: qt.design_point(MODEL, SEA, 0.0, 30.0, force=force, windows=10), "windows = 10"),
        (lambda: qt.design_point(MODEL, "x", 0.0, 30.0, force=force), "is no Sea"),
    ],
)
def test_what_cannot_be_is_refused(call, words):
    with pytest.raises(qt.InputError, match=words):
        call()

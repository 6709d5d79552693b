"""The record of parametric roll and pure loss: its numbers, kinds, and what it says of conditions without an answer."""

import math
import warnings

import numpy as np
import pytest

import quartering as qt
from quartering.motion.status import Status

SHIP = qt.ship("s175").with_(gm=1.0, gyradius_roll=8.89, gyradius_pitch=43.75, roll_damping=0.02)


def judged(ship, *condition):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        return qt.parametric_roll(ship, *condition)


def test_parametric_roll_and_its_numbers():
    """Closed forms beside the record: threshold 2 sqrt((1 - W^2/4)^2 + (zeta_m W)^2), tenfold ln 10 over the growth."""
    found = judged(SHIP, qt.Wave(175.0, 5.25), 3.3)
    assert (found.kind, found.unstable, found.status) == ("parametric", True, Status.CONVERGED)
    w0 = found.encounter_frequency / found.frequency_ratio / math.sqrt(found.gm_mean / 1.0)
    at_mean = 0.02 * w0 / (w0 * math.sqrt(found.gm_mean))
    W = found.frequency_ratio
    assert found.threshold == pytest.approx(2 * math.hypot(1 - W**2 / 4, at_mean * W), rel=1e-9)
    assert found.margin == pytest.approx(found.gm_first / found.gm_mean / found.threshold, rel=1e-12)
    assert found.tenfold == pytest.approx(math.log(10) / found.growth, rel=1e-12)
    assert found.growth < found.growth_roll_only  # sway, yaw, lift and waves damp
    assert len(found.amplitude) == 1
    assert f"{found.amplitude[0]:.3g} deg" in found.sentence
    assert found.deck_under > 0


def test_values_at_rest_on_the_wave_are_those_of_an_independent_code():
    """Balanced on 24 crest positions: mean and first harmonic of GM to 0.1 %."""
    found = judged(SHIP, qt.Wave(175.0, 5.25), 1.77)
    assert found.gm_mean_quasistatic == pytest.approx(1.104552, rel=1e-3)
    assert found.gm_first_quasistatic == pytest.approx(0.342008, rel=1e-3)


def test_a_ship_that_keeps_pace_with_a_crest_is_lost_on_it_or_not():
    """On a frozen wave roll grows with -zeta w0 + sqrt((zeta w0)^2 - w0^2 GM_wave/GM), least GM of the balance."""
    wave, celerity = qt.Wave(175.0, 7.0), math.sqrt(9.81 * 175.0 / (2 * math.pi))
    for gm, kind in ((0.1, "pure-loss"), (1.0, "stable")):
        found = judged(SHIP.with_(gm=gm), wave, celerity, 0.0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", qt.RangeWarning)
            least = float(qt.gm_in_waves(SHIP.with_(gm=gm), wave, 0.0, 24).gm.min())
        assert (found.kind, found.gm_least < 0) == (kind, kind == "pure-loss")
        assert found.gm_least == pytest.approx(least, abs=1e-9)
        assert found.status is Status.ENCOUNTER_FREQUENCY_NEAR_ZERO
        assert "change speed or heading" in found.sentence
        assert found.amplitude == ()


def test_an_overtaking_wave_takes_the_restoring_moment_away_for_a_time():
    """GM below zero on the crest for a part of each encounter, and what roll grows meanwhile, from GM along the motion."""
    found = judged(SHIP.with_(gm=0.05), qt.Wave(175.0, 7.0), 12.0, 0.0)
    assert found.gm_least < 0 < found.gm_mean
    assert 0 < found.time_below_zero < 2 * math.pi / abs(found.encounter_frequency)
    assert found.growth_below_zero > 0
    assert "below zero" in found.sentence


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        ((qt.Wave(175.0, 0.0), 3.0), "needs a wave"),
        ((qt.Wave(175.0, 5.0), -3.0), "speed"),
    ],
)
def test_what_cannot_be_asked_is_refused_with_what_can(condition, words):
    with pytest.raises(qt.InputError, match=words):
        qt.parametric_roll(SHIP, *condition)


def test_water_over_the_deck_is_said():
    with pytest.warns(qt.RangeWarning, match="over the top of the offsets"):
        qt.parametric_roll(SHIP, qt.Wave(175.0, 5.25), 3.3)


def test_a_ship_that_overtakes_the_wave_has_a_motion_with_the_encounter_frequency_below_zero():
    found = judged(SHIP, qt.Wave(120.0, 2.0), 18.0, 0.0)
    assert found.encounter_frequency < 0
    assert found.status.ok
    assert np.isfinite(found.growth)

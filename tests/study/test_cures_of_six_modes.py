"""Cures in six modes: just before each one small roll grows, just beyond it decays, by the record's own growth."""

import warnings

import pytest

import quartering as qt

SHIP, WAVE = qt.ship("dtc"), qt.Wave(355.0, 5.0)


def growth(name, value):
    """Growth by the record, of a condition with one value changed."""
    given = {"speed": 5.0, "heading": 180.0, "wave_height": 5.0}
    given |= {name: value} if name in given else {}
    ship = SHIP if name in ("speed", "heading", "wave_height") else SHIP.with_(**{name: value})
    with warnings.catch_warnings():
        warnings.simplefilter(
            "ignore", qt.RangeWarning
        )  # the surface bends across the ship in oblique seas, in both alike
        return _of(ship, given)


def _of(ship, given):
    return qt.parametric_roll(ship, qt.Wave(355.0, given["wave_height"]), given["speed"], given["heading"]).growth


def test_each_cure_is_where_growth_changes_its_sign():
    """Authority: `parametric_roll` on both sides, 1 % of the change away."""
    found = qt.cures(SHIP, WAVE, 5.0, 180.0, modes="six")
    assert {"gm", "speed", "heading", "wave_height", "roll_damping"} <= {one.parameter for one in found}
    for one in found:
        beyond, before = (one.now + share * (one.needed - one.now) for share in (1.01, 0.97))
        assert growth(one.parameter, beyond) < 0 < growth(one.parameter, before), one.parameter
        assert one.sentence


def test_a_ship_whose_roll_decays_needs_no_cure():
    assert qt.cures(SHIP.with_(roll_damping=0.15), WAVE, 5.0, 180.0, modes="six") == []


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"modes": "four"}, "three"),
        ({"parameters": ["K_ppp"]}, "no cure in six modes"),
        ({"harmonics": 3}, "of its own"),
    ],
)
def test_what_cannot_be_asked_is_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        qt.cures(SHIP, WAVE, 5.0, 180.0, **({"modes": "six"} | given))

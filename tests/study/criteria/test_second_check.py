"""Second check of parametric rolling: the roll behind it, and the sum over sea states."""

import math
import warnings

import pytest

import quartering as qt
from quartering.study.criteria import parametric_rolling
from quartering.study.criteria.particulars import particulars
from quartering.study.criteria.roll_in_waves import STEEPNESSES, largest_rolls

SHIP = qt.ship("series60-cb60").with_(gm=0.8)


def test_rolls_of_the_check_are_those_of_the_record_of_one_wave():
    """Fewer harmonics are taken for the many waves of the check: within 3 % of the record, and the same verdicts."""
    speed, length = 4.323, SHIP.hull.length
    rolls = largest_rolls(SHIP, speed, 180.0)
    assert rolls[0] == 0.0
    for i in (1, 5):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", qt.RangeWarning)  # water over the deck of steep waves
            found = qt.parametric_roll(SHIP, qt.Wave(length, float(STEEPNESSES[i]) * length), speed)
        assert (found.kind == "stable") == (rolls[i] == 0.0)
        assert rolls[i] == pytest.approx(max(found.amplitude, default=0.0), rel=0.03, abs=0.05)


def test_a_ship_that_passes_the_first_check_needs_no_second():
    found = parametric_rolling.level2(particulars(SHIP, 8.645935, 14.0))
    assert found.verdict == "not vulnerable"
    assert math.isnan(found.value("c2"))


@pytest.mark.soak
@pytest.mark.parametrize(("name", "gm", "froude"), [("s175", 1.0, 0.275), ("dtmb5415", 0.95, 0.41)])
def test_a_ship_that_fails_the_first_check_is_judged_by_its_roll(name, gm, froude):
    """The sum by hand: 24 speeds whole and rest in head and following seas by halves, over 25."""
    ship = qt.ship(name).with_(gm=gm)
    p = particulars(ship, froude * math.sqrt(9.81 * ship.hull.length), None)
    found = parametric_rolling.level2(p)
    assert found.vulnerable is (found.value("c2") > 0.025)
    assert 0.0 <= found.value("c2") < 1.0
    assert found.value("largest_roll") > 0.0

"""Limiting KG: the shift of G in the righting arms of waves, and verdicts on either side of each limit."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.criteria import in_waves, parametric_rolling, pure_loss
from quartering.study.criteria.particulars import particulars


def test_moving_g_moves_the_arms_as_cross_curves_say():
    """Against the balance made anew with the other G: what is left out is of the order of the trim, here 2 mm."""
    base = qt.ship("series60-cb60")
    higher = base.with_(kg=base.loading.kg + 0.5)
    shifted, anew = particulars(higher, None, None, base), particulars(higher, None, None)
    length, height = base.hull.length, 0.04 * base.hull.length
    assert in_waves.gm_least(shifted, length, height) == pytest.approx(
        in_waves.gm_least(anew, length, height), abs=2e-3
    )
    difference = in_waves.arms(shifted, length, height) - in_waves.arms(anew, length, height)
    assert np.nanmax(np.abs(difference[:, :41])) < 2e-3


@pytest.mark.parametrize(
    "criterion", ["parametric_rolling.level1", pytest.param("pure_loss.level1", marks=pytest.mark.soak)]
)
def test_on_either_side_of_a_limit_the_verdicts_differ(criterion):
    ship = qt.ship("series60-cb60")
    limit = float(qt.limiting_kg(ship, speed="0.3 Fn", levels=[criterion])["kg_max"][0, 0])
    judge = {"parametric_rolling.level1": parametric_rolling.level1, "pure_loss.level1": pure_loss.level1}[criterion]
    below, above = (judge(particulars(ship.with_(kg=limit + d), 10.0, None)) for d in (-0.005, 0.005))
    assert below.vulnerable is False
    assert above.vulnerable is True


def test_what_is_not_judged_has_no_limit():
    found = qt.limiting_kg(qt.ship("box"), levels=["dead_ship.level1"])
    assert int(found["found"][0, 0]) == 1
    assert np.isnan(found["kg_max"][0, 0])


def test_a_level_that_is_none_is_refused():
    with pytest.raises(qt.InputError, match=r"allowed: parametric_rolling\.level1"):
        qt.limiting_kg(qt.ship("box"), levels=["pure_loss"])

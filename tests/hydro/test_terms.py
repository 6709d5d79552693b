"""Sources of coefficients added up by name: values, kinds, words, and what of it counts as an estimate."""

from typing import get_args

import numpy as np
import pytest

from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import _floating, hydrostatics
from quartering.hydro.coefficients import coefficients
from quartering.hydro.damping.of_ship import METHODS
from quartering.hydro.strip.moments import hull_moments, section_table
from quartering.hydro.terms import ESTIMATES, KINDS, Kind, Term, added, estimates

S60 = ship("series60-cb60")
DAMPING = {"fraction": 0.05, "ikeda": "ikeda", "ikeda-simplified": "ikeda-simplified"}


def test_every_kind_has_its_place_in_a_sum_and_every_estimate_is_a_kind():
    assert set(KINDS) == set(get_args(Kind))
    assert set(ESTIMATES) <= set(KINDS)


def test_a_sum_has_the_values_words_and_papers_of_its_parts_and_the_first_kind_of_the_list():
    lift = Term(np.array([1.0, 2.0]), "regression", "lift", ("A",))
    wave = Term(np.array([0.5, 0.5]), "strip", "waves", ("B",))
    for order in ((lift, wave), (wave, lift)):
        total = added([{"Y_v": order[0]}, {"Y_v": order[1], "N_v": wave}])
        np.testing.assert_array_equal(total["Y_v"].value, [1.5, 2.5])
        assert total["Y_v"].kind == "regression"
        assert total["Y_v"].source == "lift; and waves"
        assert set(total["Y_v"].references) == {"A", "B"}
        assert total["N_v"] == wave


@pytest.mark.parametrize("method", METHODS)
def test_what_is_estimated_follows_from_the_kind(method):
    """All that says "estimated" in its words is an estimate by kind, and nothing else is."""
    table = coefficients(S60.with_(roll_damping=DAMPING[method]), 0.5, 7.0).table()
    found = {name for names in estimates(table).values() for name in names}
    assert found == {entry.name for entry in table if entry.source.startswith("estimated")}
    assert ({"K_p|p|"} <= found) == (method != "fraction")


def test_the_hull_is_computed_once_whatever_is_loaded_on_it():
    counted = (_floating, section_table, hull_moments)
    before = [one.cache_info().misses for one in counted]
    made = S60.with_(draught="6.1 m")  # a hull nobody has asked for yet
    for loaded in (made, made.with_(gm=0.7), made.with_(roll_damping="ikeda"), made.with_(gyradius_roll="0.4 B")):
        assert loaded.hull is made.hull
        for speed in (0.0, 5.0):
            coefficients(loaded, [0.3, 0.6], speed)
        assert hydrostatics(loaded).kg == loaded.loading.kg
    assert [one.cache_info().misses - was for one, was in zip(counted, before, strict=True)] == [1, 1, 1]

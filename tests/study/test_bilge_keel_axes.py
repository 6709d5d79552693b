"""Bilge keels as axes of a study: each loading is the ship that `with_` gives those keels."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.case.read import case_grid
from quartering.study.loadings import loaded, user_value

SHIP = qt.ship("series60-cb60")
AT = {"speed": 7.5, "heading": [60.0, 80.0], "wave_length": 150.0, "wave_height": 2.0}


def test_a_sweep_over_keels_is_the_ship_with_each_pair():
    breadths = [0.0, 0.3, 0.6]
    found = qt.sweep(SHIP, **AT, bilge_keel_length=[36.0], bilge_keel_breadth=breadths)
    for i, breadth in enumerate(breadths):
        fitted = SHIP.with_(roll_damping="ikeda", bilge_keels=(36.0, breadth) if breadth else (0.0, 0.0))
        np.testing.assert_allclose(found["roll"].values[i], qt.sweep(fitted, **AT)["roll"].values, rtol=1e-12)
    roll = found["roll"].squeeze().values
    assert (np.diff(roll, axis=0) < 0).all()  # wider keels, less roll: [Ikeda78c] force rises with the breadth


def test_a_case_file_takes_keels_in_lengths_and_breadths_of_the_ship(tmp_path):
    (tmp_path / "case.yaml").write_text(
        "ship: series60-cb60\nspeed: 7.5\nheading: 60\nwave_length: 150\nwave_height: 4\n"
        "loading: {bilge_keel_length: 0.25 L, bilge_keel_breadth: [0, 0.02 B]}\n"
    )
    made = case_grid(tmp_path / "case.yaml")
    assert made.loaded(0).bilge_keels is None
    assert made.loaded(1).bilge_keels == pytest.approx((0.25 * SHIP.hull.length, 0.02 * SHIP.hull.beam))
    assert [made.loaded(i).roll_method for i in (0, 1)] == ["ikeda", "ikeda"]


@pytest.mark.parametrize(
    ("keels", "message"),
    [
        ("bilge_keel_breadth: 0.3", "line 7: bilge_keel_breadth is given, .*give bilge_keel_length too"),
        (
            "bilge_keel_length: 30\n  bilge_keel_breadth: 9 m",
            "line 8: bilge_keel_breadth = 9 m; it is from 0 m to 0.25 B = 4.064 m",
        ),
        ("bilge_keel_length: 30\n  bilge_keel_breadth: 0.3\n  roll_damping: 5 %", "line 7: .*leave out the one"),
    ],
)
def test_keels_that_cannot_be_are_refused_with_their_line(tmp_path, keels, message):
    (tmp_path / "case.yaml").write_text(
        f"ship: series60-cb60\nspeed: 7.5\nheading: 60\nwave_length: 150\nsteepness: 1/50\nloading:\n  {keels}\n"
    )
    with pytest.raises(qt.InputError, match=message):
        case_grid(tmp_path / "case.yaml")


def test_a_ship_with_keels_is_swept_over_their_breadth_from_none_on():
    own = SHIP.with_(roll_damping="ikeda", bilge_keels=(36.0, 0.3))
    found = qt.sweep(own, **AT, bilge_keel_breadth=[0.0, 0.6])
    for i, keels in enumerate([(0.0, 0.0), (36.0, 0.6)]):
        np.testing.assert_allclose(
            found["roll"].values[i], qt.sweep(own.with_(bilge_keels=keels), **AT)["roll"].values, rtol=1e-12
        )


def test_keels_of_the_ship_stand_for_the_size_not_given():
    own = SHIP.with_(roll_damping="ikeda-simplified", bilge_keels=(30.0, 0.3))
    wider = loaded(own, {"bilge_keel_breadth": 0.5})
    assert wider.bilge_keels == (30.0, 0.5)
    assert wider.roll_method == "ikeda-simplified"
    assert [user_value(wider, f"bilge_keel_{size}") for size in ("length", "breadth")] == [30.0, 0.5]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"bilge_keel_breadth": 0.4}, "give bilge_keel_length too; try 30 m"),
        ({"bilge_keel_length": 30.0}, "give bilge_keel_breadth too; try 0.33 m"),
        (
            {"bilge_keel_length": 30.0, "bilge_keel_breadth": 0.4, "roll_damping": 0.05},
            "leave out the one or the others",
        ),
        ({"bilge_keel_length": 30.0, "bilge_keel_breadth": 9.0}, "it is from 0 m to 0.25 B = 4.064 m"),
        ({"bilge_keel_length": -30.0, "bilge_keel_breadth": 0.4}, "it is from 0 m to 1 L"),
    ],
)
def test_keels_that_cannot_be_are_refused(values, message):
    with pytest.raises(qt.InputError, match=message):
        loaded(SHIP, values)

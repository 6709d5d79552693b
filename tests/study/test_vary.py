"""Values varied: the same numbers as one ship at a time, and flips where the one-case verdict flips."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import quartering as qt
from quartering.stability.kind import Kind
from quartering.study.effects.cure import cures
from quartering.study.effects.vary import refined_flips
from quartering.study.paper.model import paper_ship

SHIP = paper_ship()
LENGTH = SHIP.hull.length
SPEED, HEADING = 0.25 * np.sqrt(9.81 * LENGTH), 30.0
WAVE = qt.Wave(LENGTH, LENGTH / 30)
RESTLESS = SHIP.with_(factors={"K_prr": -60.0})


def alone(ship, wave=WAVE, speed=SPEED, heading=HEADING):
    """One case through its own path: equations, motion, verdict."""
    model = qt.equations(ship, wave, speed, heading)
    motion = qt.steady_motion(model, 1, start="rest")
    return motion, qt.stability(model, motion)


def test_every_value_gives_what_that_ship_gives_alone():
    gm = [0.6, 0.8, 1.1]
    ds = qt.vary(SHIP, WAVE, SPEED, HEADING, {"gm": gm})
    for value in gm:
        motion, verdict = alone(SHIP.with_(gm=value))
        here = ds.sel(gm=value)
        assert float(here["roll"]) == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-8)
        assert float(here["k2"]) == pytest.approx(verdict.k2, rel=1e-8)
        assert float(here["exponent"]) == pytest.approx(verdict.exponents[0].real, abs=1e-5)


def test_two_parameters_stand_on_their_own_axes_whatever_their_order():
    """A loading, a coefficient and a condition in turn: each cell is the ship and condition its axes say."""
    gm, factors, speeds = [0.7, 0.9, 1.0], [0.5, 2.0], [5.0, 8.0]
    ds = qt.vary(SHIP, WAVE, SPEED, HEADING, {"K_ppp": factors, "gm": gm})
    assert ds["roll"].dims == ("K_ppp", "gm")
    motion, _ = alone(SHIP.with_(gm=0.9, factors={"K_ppp": 2.0}))
    assert float(ds["roll"].sel(gm=0.9, K_ppp=2.0)) == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-8)
    ds = qt.vary(SHIP, WAVE, SPEED, HEADING, {"speed": speeds, "gm": gm})
    motion, _ = alone(SHIP.with_(gm=0.7), speed=8.0)
    assert float(ds["roll"].sel(gm=0.7, speed=8.0)) == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-8)


def test_the_verdict_flips_where_it_is_said_to():
    """The judge is the one-case verdict a hair to either side."""
    ds = qt.vary(SHIP, WAVE, SPEED, HEADING, {"K_prr": np.linspace(-60.0, 0.0, 7)})
    (flip,) = ds["flip"].values
    assert [Kind(int(ds[name][0])).label for name in ("verdict_below", "verdict_above")] == ["roll", "stable"]
    step = 10.0 / 16**3
    assert not alone(SHIP.with_(factors={"K_prr": flip - step}))[1].stable
    assert alone(SHIP.with_(factors={"K_prr": flip + step}))[1].stable


@given(st.floats(0.001, 0.999), st.integers(2, 9), st.sampled_from([(0, 1), (2, 0), (0, -1), (-1, 3)]))
def test_a_step_is_found_wherever_it_lies(place, count, kinds):
    """Closed form: the verdict is a step at a known place."""
    values = np.linspace(0.0, 1.0, count)

    def at(x):
        return np.where(x < place, *kinds).astype(np.int8)

    ((found, before, after),) = refined_flips(at, values, at(values))
    assert (before, after) == kinds
    assert found == pytest.approx(place, abs=1.0 / (count - 1) / 16**3)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({}, "one or two"),
        ({"gm": [1, 2], "kg": [1, 2], "K_ppp": [1, 2]}, "one or two"),
        ({"gm": 0.5}, "two or more"),
        ({"K_pq": [1, 2]}, "unknown"),
        ({"K_rvr": [1, 2], "K_vrr": [1, 2]}, "twice"),
        ({"gm": [0.5, np.nan]}, "finite"),
    ],
)
def test_what_cannot_be_varied_is_refused(parameters, words):
    with pytest.raises(qt.InputError, match=words):
        qt.vary(SHIP, WAVE, SPEED, HEADING, parameters)


NAMES = ["gm", "kg", "gyradius_roll", "roll_damping", "K_prr", "K_p"]


def test_tornado_bars_are_the_ship_with_that_value_changed():
    ds = qt.tornado(SHIP, WAVE, SPEED, HEADING, change=0.1, parameters=NAMES)
    for name, changed in (
        ("gm", SHIP.with_(gm=1.1 * SHIP.loading.gm)),
        ("kg", SHIP.with_(kg=1.1 * SHIP.loading.kg)),
        ("K_prr", SHIP.with_(factors={"K_prr": 1.1})),
    ):
        motion, verdict = alone(changed)
        more = ds.sel(parameter=name, side="more")
        assert float(more["roll"]) == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-6)
        assert float(more["index"]) == pytest.approx(verdict.index, rel=1e-6)
    motion, verdict = alone(SHIP)
    assert ds.attrs["base_roll"] == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-8)
    effect = np.abs(ds["roll"] - ds.attrs["base_roll"]).max(dim="side")
    assert str(effect["parameter"].values[np.argmax(effect.values)]) == str(ds["parameter"].values[0]) == "kg"


def test_small_tornado_bars_are_the_derivatives_of_the_sensitivity():
    """Agreement with another method: fourth-order differences of one branch, whose error is far below 1e-3."""
    names, change = ["gm", "gyradius_roll", "K_prr", "N_r"], 0.01
    ds = qt.tornado(SHIP, WAVE, SPEED, HEADING, change=change, parameters=names, harmonics=3)
    slopes = qt.sensitivity(SHIP, WAVE, SPEED, HEADING, harmonics=3)
    for name in names:
        bars = ds["roll"].sel(parameter=name)
        slope = float(bars.sel(side="more") - bars.sel(side="less")) / (2 * change)
        # the error of a central difference is change^2/6 times the third derivative
        assert slope == pytest.approx(float(slopes["roll"].sel(parameter=name)), rel=5e-3, abs=1e-4)


def test_tornado_flips_are_those_of_the_cures():
    """Agreement with another search: root finding on the exponent itself."""
    names = ["roll_damping", "K_prr", "gyradius_roll"]
    ds = qt.tornado(RESTLESS, WAVE, SPEED, HEADING, parameters=names, harmonics=3)
    found = {
        cure.parameter: cure.needed for cure in cures(RESTLESS, WAVE, SPEED, HEADING, parameters=names, harmonics=3)
    }
    assert "K_prr" in found
    for name, needed in found.items():
        # A cure ends where disturbances die out at 1e-6 1/s at least, on the stable side of the flip.
        assert float(ds["flip"].sel(parameter=name)) == pytest.approx(needed, rel=1e-3)
        assert int(ds["verdict_beyond"].sel(parameter=name)) == Kind.STABLE


def test_a_change_that_cannot_be_made_is_not_made_up():
    """KG 30 % up is above the metacentre: there is no such ship, and the bar is missing."""
    ds = qt.tornado(SHIP, WAVE, SPEED, HEADING, change=0.3, parameters=["kg"])
    assert np.isnan(ds["roll"].sel(parameter="kg", side="more"))
    assert int(ds["verdict_beyond"].sel(parameter="kg")) == Kind.NO_ANSWER
    km = SHIP.loading.kg + SHIP.loading.gm
    assert float(ds["flip"].sel(parameter="kg")) == pytest.approx(km, rel=1e-3)


@pytest.mark.parametrize("change", [0.0, 1.0, -0.1, np.nan])
def test_a_change_out_of_range_is_refused(change):
    with pytest.raises(qt.InputError, match="change"):
        qt.tornado(SHIP, WAVE, SPEED, HEADING, change=change)


def test_a_varied_fraction_of_critical_replaces_ikedas_components_and_says_so():
    """The same numbers as for a ship whose damping is a fraction; nothing of the component method in the sources."""
    wave, values = qt.Wave(120.0, 2.0), [0.02, 0.08]
    fraction = qt.ship("series60-cb60")
    by_components = fraction.with_(roll_damping="ikeda")
    one, other = (qt.vary(ship, wave, 7.0, 45.0, {"roll_damping": values}) for ship in (by_components, fraction))
    assert one["roll"].values == pytest.approx(other["roll"].values, rel=1e-12)
    assert "K_p|p|" not in one.attrs["estimated_coefficients"]
    assert "of critical" in one.attrs["loading"]

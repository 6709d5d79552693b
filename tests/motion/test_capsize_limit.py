"""One roll angle that counts as a capsize, asked by every door; a hull past it does not come back."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.hull.file.read import available_ships
from quartering.hull.righting.arm import righting_arm, righting_spline, vanishing_angle
from quartering.hull.righting.limit import least_limit
from quartering.hydro.capsize import capsize_limit
from quartering.motion.status import Status
from quartering.motion.steady.motion import steady_motion, within_limit
from quartering.motion.transient.basin import basin, capsize_times
from tests.tiers import mostly_soak

SHIPS = [entry.name for entry in available_ships()]
IDLE = {"Y_v": -1.0, "N_r": -1.0, "K_p": -0.1}
CALM = (0.0, 0.0, 0.0)


def roll_alone(terms, **given):
    return qt.Model(np.eye(3), IDLE | terms, 0.8, CALM, CALM, **given)


def test_the_limit_is_the_least_of_the_three_and_says_which():
    assert least_limit(50.0, 60.0) == (50.0, "vanishing")
    assert least_limit(50.0, 40.0) == (40.0, "openings")
    assert least_limit(np.inf, 120.0) == (90.0, "on its side")
    assert least_limit(50.0).words == "50 deg, where the righting arm vanishes"


@pytest.mark.parametrize(
    ("terms", "root"),
    [
        ({"K_phi": -1.0, "K_phiphiphi": 1.0}, 1.0),  # phi (1 - phi^2)
        ({"K_phi": -4.0, "K_phi5": 64.0}, 0.5),  # 4 phi (1 - 16 phi^4)
        ({"K_phi": -1.0, "K_phiphi": 1.25}, 0.8),  # phi (1 - 1.25 phi), to starboard alone
        ({"K_phi": -1.0, "K_phiphi": -1.25}, 0.8),  # to port alone
        ({"K_phi": 0.5, "K_phiphiphi": -2.5, "K_phi5": 2.0}, 1.0),  # lolls at 0.5: -2 phi (phi^2 - 1/4)(1 - phi^2)
        ({"K_phi": -1.0, "K_phi|phi|": 2.0}, 0.5),  # phi (1 - 2 |phi|)
        ({"K_phi": -1.0}, np.inf),
        ({"K_phi": 1.0}, np.inf),  # never rights: nothing vanishes
        ({}, np.inf),
    ],
)
def test_vanishing_angle_of_bare_numbers_is_the_root_of_their_moment(terms, root):
    """Closed form: the factors beside each."""
    assert roll_alone(terms).vanishing_angle == pytest.approx(np.degrees(root), rel=1e-9)


def test_vanishing_angle_of_a_given_curve_is_its_zero():
    angles = np.arange(0.0, 91.0, 5.0)
    model = roll_alone({}, restoring=(angles, np.sin(np.radians(180.0 / 70.0 * angles))))  # closed form: 0 at 70 deg
    assert model.vanishing_angle == pytest.approx(70.0, abs=1e-6)
    assert "spline to 90 deg" in repr(model)
    assert "capsize at 70 deg, where the righting arm vanishes" in repr(model)


def test_a_model_may_be_told_its_vanishing_angle():
    terms = {"K_phi": -1.0, "K_phiphiphi": 1.0}
    told = roll_alone(terms, told_vanishing=30.0)
    assert told.capsize_limit == (30.0, "vanishing")
    assert replace(told, openings=20.0).capsize_limit == (20.0, "openings")
    assert replace(roll_alone(terms), terms=terms | {"K_phiphiphi": 4.0}).vanishing_angle == pytest.approx(
        np.degrees(0.5)
    )
    for bad in ({"told_vanishing": 0.0}, {"openings": -5.0}, {"openings": float("nan")}):
        with pytest.raises(qt.InputError, match="above 0"):
            roll_alone(terms, **bad)


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_righting_curve_does_not_turn_up_again(name):
    """Past its vanishing angle, with the deck closed at the top of the offsets, no hull rights itself below 90 deg.

    The heeled sections are the authority, the spline is held to them; both at every degree.
    """
    angles = np.arange(0.5, 90.0, 0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        arms = righting_arm(qt.ship(name), angles)
    spline = righting_spline(qt.ship(name)).value(np.radians(angles))
    vanishing = vanishing_angle(qt.ship(name).with_(righting="spline"))
    assert (spline[angles < vanishing] > 0).all()
    assert (spline[angles > vanishing] < 0).all()
    assert (arms[angles > vanishing + 0.5] < 0).all()
    assert np.abs(spline - arms).max() < 0.003 * np.abs(arms).max()


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_a_hull_past_its_vanishing_angle_goes_over(name):
    """Known fault: a polynomial that turned up rolled for ever. With no limit but 90 deg the equations go on by themselves."""
    ship = qt.ship(name).with_(righting="spline")
    limit = capsize_limit(ship)
    if limit.reason == "on its side":
        pytest.skip("its righting arm does not vanish below 90 deg")
    length = ship.hull.length
    model = replace(qt.equations(ship, qt.Wave(length, 1e-3), 0.0, 90.0), told_vanishing=np.inf)
    natural = 2 * np.pi / float(qt.coefficients(ship, 0.0, 0.0).roll_frequency)
    trace = qt.simulate(model, 3 * natural, (0.0, np.radians(limit.angle + 2.0), 0.0, 0.0))
    assert trace.attrs["capsize_reason"] == "on its side"
    assert trace.attrs["capsize_time"] < 2 * natural


@pytest.mark.soak
def test_histories_stop_at_the_limit_of_their_model():
    model = roll_alone({"K_phi": -1.0}, openings=20.0)
    pushed = (0.0, 0.0, np.radians(40.0), 0.0)
    trace = qt.simulate(model, 30.0, pushed)
    assert trace.attrs["capsize_angle"] == 20.0
    assert trace.attrs["capsize_reason"] == "openings"
    after = trace["time"] > trace.attrs["capsize_time"]
    assert np.isnan(trace["roll"].values[after]).all()
    assert np.nanmax(trace["roll"]) < 25.0  # one sample of 0.13 s at 40 deg/s past the limit, at the most
    times, _ = capsize_times(model, [pushed, (0.0, 0.0, np.radians(10.0), 0.0)])
    assert np.isfinite(times[0])
    assert times[0] == pytest.approx(trace.attrs["capsize_time"], abs=0.27)  # two samples
    assert np.isnan(times[1])
    ds = basin(model, [10.0, 25.0], [0.0], periods=4)
    assert ds.attrs["safe_share"] == 0.5
    assert ds.attrs["capsize_reason"] == "openings"
    sea = qt.irregular(model, [1.0], [[0, 0.3, 0]], [[0.0]], 200.0)
    assert np.isfinite(sea["capsize_time"]).all()
    assert sea.attrs["capsize_angle"] == pytest.approx(20.0)


def test_map_motion_and_verdict_ask_the_same_limit():
    """One condition, three doors; the openings stand just below and just above the roll it reaches."""
    ship, wave = qt.ship("wigley").with_(righting="spline"), qt.Wave(100.0, 2.0)
    peak = float(qt.polar(ship, wave, [5.0], [60.0])["roll_peak"].max())
    for openings, status in ((0.99 * peak, Status.BEYOND_CAPSIZE_LIMIT), (1.01 * peak, Status.CONVERGED)):
        told = ship.with_(openings=openings)
        assert int(qt.polar(told, wave, [5.0], [60.0])["status"].squeeze()) == int(status)
        model = qt.equations(told, wave, 5.0, 60.0)
        motion = within_limit(model, steady_motion(model, start="rest"))
        assert motion.status is status
        sentence = qt.stability(model, motion).sentence
        assert ("where unprotected openings go under" in sentence) == (status is Status.BEYOND_CAPSIZE_LIMIT)


def test_given_righting_coefficients_count():
    ship = qt.ship("wigley").with_(righting="polynomial")
    softer = ship.with_(values={"K_phiphiphi": 0.0, "K_phi5": 0.0, "K_phi7": 0.0}, factors={"K_phi": 1.0})
    model = qt.equations(softer, qt.Wave(100.0, 1.0), 0.0, 90.0)
    assert capsize_limit(softer).angle == model.capsize_limit.angle == 90.0
    stiffness = -model.terms["K_phi"]
    softer = ship.with_(values={"K_phiphiphi": 4 * stiffness, "K_phi5": 0.0, "K_phi7": 0.0})
    assert capsize_limit(softer).angle == pytest.approx(np.degrees(0.5))  # closed form: phi (1 - 4 phi^2)
    assert qt.equations(softer, qt.Wave(100.0, 1.0), 0.0, 90.0).capsize_limit == capsize_limit(softer)

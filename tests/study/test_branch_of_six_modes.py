"""Branches in six modes: motions of two wave periods beside an integration in time, closed ends, refusals at both doors."""

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.motion.steady_course.continuation import OfAmplitude, Splined
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.march import STATES, march
from quartering.view.cli import app

SHIP, WAVE = qt.ship("dtc"), qt.Wave(355.0, 5.0)


def curve(ds, number):
    return ds.isel(point=np.flatnonzero(ds["curve"] == number))


def roll_of_a_march(speed, height):
    """Largest roll after 200 periods of a march from 3 deg [deg]."""
    one = course(SHIP, WAVE.wavenumber, *(np.array([v]) for v in (height / 2, speed, 180.0)))
    start = np.zeros(len(STATES))
    start[5] = 0.05
    late = march(one, start, 200.0).state[-48 * 10 :, 5]
    return float(np.degrees(np.abs(late).max()))


def test_a_branch_over_speed_begins_and_ends_in_doublings_and_rolls_as_a_march_does():
    """Authority: integration in time from 3 deg, 1 %; beyond both ends of the branch the march comes to rest."""
    ds = qt.branch(SHIP, "speed", wave=WAVE, heading=180.0, limits=(1.5, 9.0), modes="six")
    main, doubled = curve(ds, 0), curve(ds, 1)
    assert (main["roll_peak"] == 0).all()
    ends = main["speed"].values[main["event"] == "period-doubling"]
    assert ends.size == 2
    assert doubled["speed"].values[[0, -1]] == pytest.approx(ends)
    inside = (main["speed"].values > ends[0] + 0.01) & (main["speed"].values < ends[1] - 0.01)
    outside = (main["speed"].values < ends[0] - 0.01) | (main["speed"].values > ends[1] + 0.01)
    assert (main["exponent"].values[inside] > 0).all()
    assert (main["exponent"].values[outside] < 0).all()
    for speed in (3.0, 6.0):
        rolls = np.interp(speed, doubled["speed"].values, doubled["roll_peak"].values)
        assert rolls == pytest.approx(roll_of_a_march(speed, 5.0), rel=0.01)
    assert roll_of_a_march(8.2, 5.0) < 0.5


def test_a_branch_over_height_is_that_of_the_record():
    """The record's stable motions at a height, found at that height alone, lie on the branch."""
    ds = qt.branch(SHIP, "wave_height", wave=WAVE, speed=5.0, heading=180.0, limits=(2.0, 7.0), modes="six")
    doubled = curve(ds, 1)
    for height in (4.0, 6.0):
        found = qt.parametric_roll(SHIP, qt.Wave(355.0, height), 5.0)
        there = np.interp(height, doubled["wave_height"].values, doubled["roll_peak"].values)
        assert [there] == pytest.approx(list(found.amplitude), rel=5e-3)
    assert (doubled["periods"] == 2).all()
    assert ds.attrs["modes"] == "six"


def test_numbers_splined_over_speed_are_those_of_the_speed():
    """Midway between two values, where no spline passes by itself; 1e-6 of the largest up to twice the encounter.

    Beyond, the frequencies of some values leave the table of sections, where its limit takes over with a kink: 1e-4.
    """
    values = np.linspace(2.0, 8.0, 33)
    many = course(SHIP, WAVE.wavenumber, np.full(33, 2.5), values, np.full(33, 180.0))
    own = course(SHIP, WAVE.wavenumber, *(np.array([v]) for v in (2.5, 3.28125, 180.0)))
    splined = Splined(many, values).at(3.28125)
    for name in ("omega", "mass", "damping", "force", "strips", "surge"):
        there, here = getattr(splined.numbers, name), getattr(own.numbers, name)
        miss = np.abs(there - here) / np.abs(here).max()
        if name in ("mass", "damping"):
            assert miss.max() < 1e-4
            miss = miss[:, :5]
        assert miss.max() < 1e-6
    assert OfAmplitude(own).at(1.0).numbers.amplitude[0] == 1.0
    assert own.numbers.amplitude[0] == 2.5


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"over": "gm"}, "wave_height, speed, heading"),
        ({"modes": "seven"}, '"three"'),
        ({"harmonics": 3}, "of its own"),
        ({"over": "speed", "limits": (20.0, 26.0), "heading": 0.0}, "keeps pace"),
        ({"limits": (1.0, 60.0)}, "1/7"),
        ({"limits": (3.0, 2.0)}, "rising"),
    ],
)
def test_what_a_branch_cannot_be_asked_is_refused(given, words):
    asked = {"over": "wave_height", "wave": WAVE, "speed": 5.0, "heading": 180.0, "modes": "six"} | given
    with pytest.raises(qt.InputError, match=words):
        qt.branch(SHIP, **asked)


def test_the_command_writes_the_branch_and_refuses_with_two(tmp_path):
    path = tmp_path / "branch.csv"
    words = ["branch", "wigley", "--heading", "180", "--speed", "3", "--wave-length", "1L", "--wave-height", "1"]
    made = CliRunner().invoke(app, [*words, "--modes", "six", "--limits", "0.5:1", "-o", str(path)])
    assert made.exit_code == 0, made.output
    assert "# modes: six" in path.read_text()
    refused = CliRunner().invoke(app, [*words, "--modes", "six", "--over", "gm"])
    assert refused.exit_code == 2

"""Maps in six modes: each cell is the record of its condition, a low wave gives the linear motion, nonsense is refused."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.motion.status import Status
from quartering.stability.kind import Kind
from quartering.view.cli import app

DTC = qt.ship("dtc")
WAVE = qt.Wave(355.0, 7.0)


pytestmark = pytest.mark.filterwarnings("ignore:.*surface is not straight across the ship")


def test_each_cell_is_the_record_of_its_condition():
    """`parametric_roll` finds the same growth and the same largest stable roll, head on, oblique, and on the quarter."""
    headings = [0.0, 60.0, 150.0, 180.0]
    ds = qt.polar(DTC, WAVE, [5.0], headings, modes="six")
    for j, heading in enumerate(headings):
        cell, one = ds.isel(speed=0, heading=j, wave_length=0), qt.parametric_roll(DTC, WAVE, 5.0, heading)
        assert float(cell.exponent) == pytest.approx(one.growth, rel=1e-6)
        assert (int(cell.verdict) > 0) is one.unstable
        assert float(cell.roll_peak) == pytest.approx(max(one.amplitude, default=0.0), rel=1e-6)
        assert float(cell.encounter_frequency) == pytest.approx(one.encounter_frequency, rel=1e-12)
    assert int(ds.verdict[0, 3, 0]) == Kind.PERIOD_DOUBLING
    assert float(ds.roll_peak[0, 3, 0]) > 15 > float(ds.roll_peak[0, 1, 0])
    assert ds.attrs["modes"] == "six"
    assert np.isnan(ds.k2).all()


def test_in_a_low_wave_roll_sway_and_yaw_are_linear():
    """Authority: `responses`, from coefficients alone; 2.5 %, as tables hold the surface straight across a section."""
    ship, wave = qt.ship("s175"), qt.Wave(350.0, 0.05)
    ds = qt.polar(ship, wave, [5.0], [60.0, 120.0], modes="six").isel(speed=0, wave_length=0)
    for j, heading in enumerate((60.0, 120.0)):
        linear = qt.responses(ship, wave, 5.0, heading)
        assert float(ds["roll"][j]) == pytest.approx(float(linear.roll_amplitude), rel=0.025)
        assert float(ds["yaw"][j]) == pytest.approx(float(linear.yaw), rel=0.025)


def test_headings_mirror_and_a_ship_that_keeps_pace_has_no_motion():
    ds = qt.polar(DTC, WAVE, [5.0], [150.0, 210.0], modes="six")
    np.testing.assert_allclose(ds.roll_peak[0, 0], ds.roll_peak[0, 1], rtol=1e-6)
    celerity = float(np.sqrt(9.81 * 355.0 / (2 * np.pi)))
    pace = qt.polar(DTC, WAVE, [celerity], [0.0], modes="six")
    assert int(pace.status[0, 0, 0]) == Status.ENCOUNTER_FREQUENCY_NEAR_ZERO
    assert int(pace.verdict[0, 0, 0]) == Kind.NO_ANSWER
    assert np.isnan(pace.roll_peak).all()


def test_a_wave_short_across_the_ship_is_said():
    with pytest.warns(qt.RangeWarning, match="surface is not straight across the ship"):
        qt.polar(DTC, qt.Wave(300.0, 1.0), [5.0], [90.0], modes="six")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"modes": "five"}, "modes = 'five'; it is \"three\""),
        ({"modes": "six", "harmonics": 3}, "leave harmonics and form out"),
    ],
)
def test_modes_that_are_none_are_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        qt.polar(DTC, WAVE, [5.0], **given)


def test_the_commands_take_six_modes(tmp_path):
    words = [
        "dtc",
        "--wave-length",
        "355",
        "--wave-height",
        "7",
        "--speed",
        "5",
        "--heading",
        "180",
        "--modes",
        "six",
        "--json",
    ]
    told = json.loads(CliRunner().invoke(app, ["verdict", *words]).stdout)
    one = qt.parametric_roll(DTC, WAVE, 5.0, 180.0)
    assert (told["kind"], told["growth"], told["amplitude"]) == (one.kind, one.growth, list(one.amplitude))
    data = tmp_path / "six.nc"
    asked = ["polar", "dtc", "--speed", "5", "--headings", "180", "--wave-lengths", "355", "--wave-height", "7"]
    answer = CliRunner().invoke(app, [*asked, "--modes", "six", "-o", str(data)])
    assert answer.exit_code == 0, answer.output
    assert "--modes six" in " ".join(answer.output.split())
    assert (tmp_path / "six.png").stat().st_size > 10_000
    for command in (["verdict", *words[:-3], "--modes", "two"], [*asked, "--modes", "two", "-o", str(data)]):
        refused = CliRunner().invoke(app, command)
        assert refused.exit_code == 2
        assert "two" in refused.output

"""Waves of one steepness in a sweep: the same numbers as a polar map of those waves, in memory, on disk and by case file."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.case.read import case_grid
from quartering.study.grid import grid
from quartering.study.maps.query import worst, write_csv
from quartering.study.maps.result import open_result
from quartering.study.maps.sweep import evaluated

SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length
LENGTHS = LENGTH * np.array([0.8, 1.2, 1.6])
SPEEDS, HEADINGS, STEEPNESSES = [5.0, 7.5], [30.0, 60.0, 120.0], [0.02, 0.04]
CASE = """
ship: series60-cb60
speed: [5, 7.5]
heading: [30, 60, 120]
wave_length: [0.8 L, 1.2 L, 1.6 L]
steepness: [1/50, 4 %]
"""


def same_as_polar(found):
    """A polar map of waves of that steepness is another way through the library to the same conditions."""
    for i, steepness in enumerate(STEEPNESSES):
        waves = [qt.Wave(length, steepness * length) for length in LENGTHS]
        shown = qt.polar(SHIP, waves, SPEEDS, HEADINGS)
        part = found.isel(steepness=i)
        np.testing.assert_allclose(part["wave_height"].values, shown["wave_height"].values, rtol=1e-12)
        for name in ("roll", "roll_peak", "exponent", "k2"):
            # The forces are the same; the two paths put them together in another order of operations.
            np.testing.assert_allclose(part[name].values, shown[name].values, rtol=1e-9, atol=1e-12)
        np.testing.assert_array_equal(part["verdict"].values, shown["verdict"].values)


def test_a_sweep_over_steepness_is_the_polar_map_of_those_waves():
    found = qt.sweep(SHIP, SPEEDS, HEADINGS, LENGTHS, steepness=STEEPNESSES)
    assert found["roll"].dims == ("speed", "heading", "wave_length", "steepness")
    assert found["steepness"].attrs["units"] == "1"
    same_as_polar(found)


def test_a_case_file_with_steepness_gives_the_same_in_memory_and_on_disk(tmp_path):
    (tmp_path / "case.yaml").write_text(CASE)
    wanted = case_grid(tmp_path / "case.yaml")
    found = evaluated(wanted)
    same_as_polar(found)
    qt.sweep(SHIP, SPEEDS, HEADINGS, wanted.axes["wave_length"], steepness=STEEPNESSES, store=tmp_path / "s")
    assert open_result(tmp_path / "s").load().identical(found)


def test_questions_to_a_result_name_height_and_steepness(tmp_path):
    found = qt.sweep(SHIP, SPEEDS, HEADINGS, LENGTHS, steepness=STEEPNESSES)
    first = worst(found, count=1)
    assert float(first["wave_height"][0]) == pytest.approx(float(first["steepness"][0] * first["wave_length"][0]))
    write_csv(found, tmp_path / "slice.csv", steepness=0.04)
    head = (tmp_path / "slice.csv").read_text().splitlines()[0]
    assert head.startswith("speed [m/s],heading [deg],wave_length [m],steepness,wave_height [m]")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "steepness: [1/50, 4 %]",
            "wave_height: 2 m\nsteepness: 1/50",
            "line 6: wave_height and steepness .*leave one out",
        ),
        ("steepness: [1/50, 4 %]", "", "wave_height or steepness is missing; give one of the two"),
        ("1/50", "1/5", "line 6: steepness = 1/5; it is above 0 and at most 1/7"),
        ("1/50", "0", "line 6: steepness = 0; it is above 0 and at most 1/7"),
        ("[1/50, 4 %]", "0.1..0.3 step 0.1", "line 6: steepness = 0.3; .*at most 1/7"),
        ("1/50", "1/2/3", "line 6: steepness = 1/2/3; that is no ratio"),
        ("4 %", "4 m", "line 6: steepness"),
    ],
)
def test_a_sea_that_cannot_be_is_refused_with_its_line(tmp_path, old, new, message):
    (tmp_path / "case.yaml").write_text(CASE.replace(old, new))
    with pytest.raises(qt.InputError, match=message):
        case_grid(tmp_path / "case.yaml")


def test_height_and_steepness_exclude_each_other_in_python():
    with pytest.raises(qt.InputError, match="leave one out"):
        qt.sweep(SHIP, 5.0, 60.0, 100.0, 2.0, steepness=0.02)
    with pytest.raises(qt.InputError, match="give one of the two"):
        qt.sweep(SHIP, 5.0, 60.0, 100.0)
    with pytest.raises(qt.InputError, match="1/7"):
        grid(SHIP, 5.0, 60.0, 100.0, steepness=[0.02, 0.2])

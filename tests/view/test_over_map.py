"""What a value does to a whole map: against maps made one by one, and at the command line."""

import json

import numpy as np
import pytest

import quartering as qt
from quartering.stability.kind import Kind
from quartering.study.effects.over_map import over_map
from quartering.view.plots.over_map import over_map_picture

WIGLEY = qt.ship("wigley")
HEADINGS, LENGTHS, STEEP = np.array([30.0, 60.0, 90.0]), np.array([80.0, 120.0, 200.0]), 0.04


def test_a_value_of_the_map_is_that_of_the_map_of_the_changed_ship():
    axes = {"speed": np.array([5.0]), "heading": HEADINGS, "wave_length": LENGTHS, "steepness": np.array([STEEP])}
    ds = over_map(WIGLEY, axes, {"gm": [0.3, 0.6], "K_p": [0.2, 1.0]})
    assert ds["unstable"].dims == ("gm", "K_p")
    waves = [qt.Wave(length, STEEP * length) for length in LENGTHS]
    for gm in (0.3, 0.6):
        for factor in (0.2, 1.0):
            alone = qt.polar(WIGLEY.with_(gm=gm, factors={"K_p": factor}), waves, [5.0], HEADINGS)
            own = ds.sel(gm=gm, K_p=factor)
            kinds, roll = alone["verdict"].values, alone["roll_peak"].values
            bad = (kinds > Kind.STABLE) & (kinds != Kind.COURSE_IN_CALM_WATER)
            assert float(own["unstable"]) == pytest.approx(bad.mean())
            assert float(own["without_answer"]) == pytest.approx((kinds == Kind.NO_ANSWER).mean())
            assert float(own["roll_peak"]) == pytest.approx(np.nanmax(roll), rel=1e-6)
            _, i, j = np.unravel_index(np.nanargmax(roll), roll.shape)
            assert (float(own["worst_heading"]), float(own["worst_wave_length"])) == (HEADINGS[i], LENGTHS[j])


def test_the_command_names_the_map_and_the_present_value(run, tmp_path):
    words = ("vary", "wigley", "--gm", "0.4:0.8:3", "--heading", "30:90:3", "--wave-length", "0.8L:2L:3", "--over-map")
    facts = json.loads(run(*words, "-o", "m.png", "--json").stdout)
    assert facts["parameters"]["gm"]["values"] == pytest.approx([0.4, 0.6, 0.8])
    assert facts["parameters"]["gm"]["now"] == pytest.approx(WIGLEY.loading.gm)
    assert facts["conditions_of_a_map"] == "1 x 3 x 3 x 1"
    assert (tmp_path / "m.png").stat().st_size > 10_000
    assert (
        "The map of 3 headings from 30 to 90 deg and 3 wave lengths from 0.8 to 2 L, H/λ = 0.02" in run(*words).stdout
    )


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["--gm", "0.4:0.8", "--wave-height", "2:4"], "all waves are as steep"),
        (["--gm", "0.4:0.8", "--tornado", "10%"], "leave one out"),
        (["--heading", "0:90"], "nothing to vary"),
    ],
)
def test_what_makes_no_map_is_refused(run, words, hint):
    result = run("vary", "wigley", *words, "--over-map")
    assert result.exit_code == 2
    assert hint in result.stderr


def test_the_picture_has_units_and_the_present_value():
    axes = {"speed": np.array([5.0]), "heading": HEADINGS, "wave_length": LENGTHS, "steepness": np.array([STEEP])}
    figure = over_map_picture(over_map(WIGLEY, axes, {"gm": [0.3, 0.9]}), "said")
    above, below = figure.axes
    assert above.get_ylabel() == "share of the map [%]"
    assert below.get_ylabel() == "angle [deg]"
    assert "GM [m]" in below.get_xlabel()
    assert any(str(line.get_label()).startswith("now, ") for line in above.lines)

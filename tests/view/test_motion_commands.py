"""`quartering branch` and `quartering basin` as a user meets them."""

import json

import numpy as np
import pytest
from matplotlib.text import Text

import quartering as qt
from quartering.view.plots.basin import basin_picture
from quartering.view.plots.branch import branch_picture

CONDITION = ["--heading", "60", "--speed", "8", "--wave-length", "1L", "--wave-height", "4"]


def texts(figure):
    return " ".join(text.get_text() for text in figure.findobj(Text))


def test_branch_says_what_is_found_and_draws_it(run, tmp_path):
    result = run("branch", "series60-cb60", *CONDITION, "--limits", "3:5", "-o", "branch.png")
    assert result.exit_code == 0, result.output
    assert "from the lower limit" in result.stdout
    assert "stable throughout" in result.stdout
    assert "quartering basin" in result.stdout
    assert (tmp_path / "branch.png").stat().st_size > 10_000


def test_branch_leads_on_with_the_options_it_was_given(run):
    stdout = run("branch", "series60-cb60", *CONDITION, "--limits", "3:5", "--harmonics", "3").stdout
    assert (
        f"quartering branch series60-cb60 {' '.join(CONDITION)} --over wave_height --harmonics 3 --limits 3:5" in stdout
    )


def test_branch_of_a_steep_wave_ends_where_waves_break(run):
    words = ["--heading", "60", "--speed", "8", "--wave-length", "100", "--wave-height", "12", "--json"]
    (curve, *_) = json.loads(run("branch", "series60-cb60", *words).stdout)["curves"]
    assert curve["from"] == pytest.approx(6.0)
    assert curve["to"] == pytest.approx(100 / 7, rel=0.02)  # the last step of a curve may pass the limit


def test_branch_in_json_agrees_with_python(run):
    facts = json.loads(run("branch", "series60-cb60", *CONDITION, "--limits", "3:5", "--json").stdout)
    ship = qt.ship("series60-cb60")
    wave = qt.Wave(ship.hull.length, 4.0)
    ds = qt.branch(ship, "wave_height", limits=(3.0, 5.0), wave=wave, speed=8.0, heading=60.0, harmonics=9)
    assert facts["curves"][0]["largest_roll_deg"] == pytest.approx(float(ds["roll_peak"].max()))
    assert facts["events"] == []


def test_branch_takes_units_and_refuses_what_it_cannot_follow(run):
    assert (
        run("branch", "series60-cb60", *CONDITION, "--over", "speed", "--limits", "14kn:16kn", "--json").exit_code == 0
    )
    for words, said in (
        (["--over", "colour"], "colour"),
        (["--limits", "3"], "from:to"),
        (["--limits", "5:3"], "rising"),
        (["--limits", "1:60"], "1/7"),
        (["--over", "wave_length", "--limits", "10:100"], "1/7"),
        (["--over", "heading", "--limits", "0:400"], "--limits: heading = 400"),
        (["-o", "branch.txt"], ".png"),
    ):
        result = run("branch", "series60-cb60", *CONDITION, *words)
        assert result.exit_code == 2, words
        assert said in result.stderr, result.stderr
        assert "Traceback" not in result.output


def test_basin_prints_the_integrity_and_draws_it(run, tmp_path):
    result = run("basin", "series60-cb60", *CONDITION, "--wave-heights", "4,8", "--periods", "4", "-o", "basin.png")
    assert result.exit_code == 0, result.output
    assert "where the righting arm vanishes" in " ".join(result.stdout.split())
    assert "quartering branch" in result.stdout
    assert (tmp_path / "basin.png").stat().st_size > 10_000
    facts = run("basin", "series60-cb60", *CONDITION, "--wave-heights", "4,8", "--periods", "4", "--json")
    curve = json.loads(facts.stdout)["curve"]
    assert [row["wave_height"] for row in curve] == [0.0, 4.0, 8.0]
    assert curve[0]["integrity"] == 1.0
    assert all(0 < row["integrity"] <= 1.02 for row in curve)


def test_basin_refuses_a_wave_that_breaks(run):
    result = run("basin", "series60-cb60", *CONDITION[:-1], "40")
    assert result.exit_code == 2
    assert "Traceback" not in result.output


def test_branch_picture_names_events_dashes_unstable_motions_and_shows_the_unit_circle():
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    ds = qt.branch(qt.Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0)), limits=(0.8, 1.5), harmonics=1)
    figure = branch_picture(ds, "frequency", "Duffing")
    words = texts(figure)
    for needed in ("fold", "stable", "unstable", "[rad/s]", "[deg]", "multipliers"):
        assert needed in words, needed
    curve, circle = figure.axes
    dashes = {line.get_linestyle() for line in curve.lines if line.get_marker() in ("None", None)}
    assert dashes == {"-", "--"}
    # The drawn pieces cover the whole curve: solid ones up to a fold, dashed between the folds.
    drawn = sum(len(line.get_xdata()) for line in curve.lines if line.get_linestyle() == "--")
    assert drawn == int((ds["verdict"] != 0).sum()) + int((ds["fold"] & (ds["verdict"] == 0)).sum())
    round_line = circle.lines[0]
    np.testing.assert_allclose(np.hypot(*round_line.get_data()), 1.0)


def test_basin_picture_has_units_and_both_panels():
    model = qt.Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_phiphi": 1.0, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    from quartering.motion.transient.basin import basin

    ds = basin(model, np.linspace(-60, 80, 15), np.linspace(-40, 40, 11), periods=2)
    heights = np.array([0.0, 1.0])
    words = texts(basin_picture(ds, (heights, np.array([1.0, 0.5])), 1.0, 57.0, "Escape"))
    for needed in ("[deg]", "[deg/s]", "[m]", "time to capsize [s]", "safe"):
        assert needed in words, needed

"""The pictures of the paper's figures hold what their datasets hold, and the commands that make them."""

import json

import numpy as np
import pytest
from matplotlib.text import Text

import quartering as qt
from quartering.conventions import GRAVITY
from quartering.study.paper.conditions import speed_of
from quartering.study.paper.curves import loading_curves, response_curves
from quartering.study.paper.model import paper_ship
from quartering.view.plots.paper_axes import wave_direction
from quartering.view.plots.paper_curves import loading_picture, response_picture, stability_picture
from quartering.view.plots.paper_figures import FIGURES, draw_figure
from quartering.view.plots.paper_points import panels

SHIP = paper_ship()
HEADINGS = np.arange(0.0, 181.0, 20.0)


def texts(figure):
    return " ".join(text.get_text() for text in figure.findobj(Text))


@pytest.fixture(scope="module")
def gyradii():
    beam = SHIP.hull.beam
    return {"gyradius_roll": loading_curves(SHIP, "gyradius_roll", [0.3 * beam, 0.45 * beam], HEADINGS)}


def test_there_are_23_figures():
    assert list(FIGURES) == list(range(1, 24))


@pytest.mark.parametrize("heading", [0.0, 30.0, 90.0, 135.0, 180.0])
def test_the_wave_of_fig_1_runs_the_way_the_encounter_frequency_says(heading):
    """Closed form: a ship that moves along the bow at U meets sigma - k U (direction . bow)."""
    right, up = wave_direction(heading)
    k = 0.05
    assert right >= 0.0
    assert np.hypot(right, up) == pytest.approx(1.0)
    met = qt.encounter_frequency(np.sqrt(GRAVITY * k), 8.0, heading)
    assert float(met) == pytest.approx(np.sqrt(GRAVITY * k) - k * 8.0 * up)


def test_stability_figure_shows_k2_and_beside_its_rate_the_largest_floquet_exponent(gyradii):
    ds = gyradii["gyradius_roll"]
    upper, lower = stability_picture(gyradii, "title").axes
    for i in range(2):
        np.testing.assert_array_equal(upper.lines[i].get_ydata(), ds["k2"].isel(loading=i))
        np.testing.assert_array_equal(lower.lines[2 * i].get_ydata(), ds["exponent"].isel(loading=i))
        np.testing.assert_array_equal(lower.lines[2 * i + 1].get_ydata(), -ds["index"].isel(loading=i))
    assert [ax.get_gid() for ax in (upper, lower)] == ["k2", "growth"]
    assert "[1/s²]" in upper.get_ylabel()
    assert "[1/s]" in lower.get_ylabel()


def test_captions_tell_ship_speed_wave_loading_and_what_is_estimated(gyradii):
    figure = loading_picture(gyradii, "roll", "title", "a note")
    for needed in (
        "Series 60, CB 0.60",
        "Fn 0.250",
        "λ/L = 1",
        "1/50",
        "GM 0.8128 m",
        "Estimated",
        "Assumed",
        "a note",
    ):
        assert needed in texts(figure), needed
    assert "ours" in texts(figure)


def test_lines_can_be_told_apart_without_colour(gyradii):
    lines = loading_picture(gyradii, "roll", "title").axes[0].lines
    drawn = [line for line in lines if line.get_label().startswith("k_xx")]
    assert len({(line.get_linestyle(), line.get_marker()) for line in drawn}) == 2


def test_response_figure_marks_resonance_and_instability():
    ds = response_curves(SHIP, [1.0], np.arange(0.0, 181.0, 5.0))
    assert "unstable" not in texts(response_picture(ds, "roll", "title"))
    changed = ds.copy(deep=True)
    changed["verdict"][9, 0] = 1
    axes = response_picture(changed, "roll", "title").axes[0]
    crosses = [line for line in axes.lines if line.get_marker() == "x" and line.get_xdata().size]
    assert [line.get_xdata().tolist() for line in crosses] == [[45.0]]


@pytest.mark.parametrize(
    ("number", "mode", "panel"), [(2, "sway", "sway_force"), (3, "roll", "roll_moment"), (4, "yaw", "yaw_moment")]
)
def test_force_figures_show_four_forms_in_three_waves(number, mode, panel):
    """Against the forces themselves, in the prefix the axis has."""
    made = draw_figure(number)
    assert panels(made) == [panel]
    compared = qt.compare_forces(SHIP, [SHIP.hull.length], HEADINGS, speed_of(SHIP))
    middle = made.axes[1]
    assert middle.get_title() == f"{mode}, λ/L = 1"
    for line in middle.lines:
        wanted = compared["amplitude"].sel(form=line.get_label(), mode=mode)[0]
        shown = np.interp(HEADINGS, line.get_xdata(), line.get_ydata()) * 1e6
        np.testing.assert_allclose(shown, wanted, rtol=1e-12, atol=1e-6)
    assert {line.get_label() for line in middle.lines} == {"froude-krylov", "paper", "paper-corrected", "stf"}


def test_figures_writes_what_was_asked_for_and_draws_points(run, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "fig06.csv").write_text("# source: a test\nquantity,series,x,y\nroll,measured,30,4.5\n")
    result = run("figures", 1, "6-7", "-o", "out", "--kind", "png", "--kind", "svg", "--points", "mine", "--json")
    assert result.exit_code == 0, result.stderr
    said = json.loads(result.stdout)
    assert [entry["number"] for entry in said["figures"]] == [1, 6, 7]
    assert said["points"] == {"6": 1}
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert names == [f"fig{n:02d}.{kind}" for n in (1, 6, 7) for kind in ("png", "svg")]
    assert "paper: measured" in (tmp_path / "out" / "fig06.svg").read_text()
    assert "paper: measured" not in (tmp_path / "out" / "fig07.svg").read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["24"], "figures 1 to 23"),
        (["7-5"], "figures 1 to 23"),
        (["1", "--kind", "gif"], "png, svg, pdf"),
        (["1", "--points", "nowhere"], "no such folder"),
    ],
)
def test_bad_input_is_one_message_and_leaves_nothing(run, tmp_path, words, said):
    result = run("figures", *words, "-o", "out")
    assert result.exit_code == 2
    assert said in result.stderr
    assert not (tmp_path / "out").exists()


def test_points_of_a_panel_that_is_not_there_leave_no_folder(run, tmp_path):
    (tmp_path / "fig01.csv").write_text("# source: a test\nquantity,series,x,y\nroll,measured,30,4.5\n")
    result = run("figures", 1, "-o", "out", "--points", ".")
    assert result.exit_code == 2
    assert 'no panel "roll"' in result.stderr
    assert not (tmp_path / "out").exists()


def test_every_panel_the_readme_of_the_points_names_exists(gyradii):
    """Figures whose panels are named by their kind: forces, response, loading, stability."""
    assert panels(stability_picture(gyradii, "t")) == ["k2", "growth"]
    assert panels(loading_picture(gyradii, "yaw", "t")) == ["yaw"]


def test_duffing_prints_the_exact_motions_and_draws_them(run, tmp_path):
    """Folds in closed form: [H71] (C-4) with P^3 = -2 X0/(3 beta), which the third harmonic moves by less than 0.1 %."""
    result = run("duffing", "--frequency", "1,1.3", "-o", "duffing.png", "--json")
    assert result.exit_code == 0, result.stderr
    said = json.loads(result.stdout)
    assert [(row["frequency"], row["stable"]) for row in said["motions"]] == [
        (1.0, True), (1.3, True), (1.3, False), (1.3, True),
    ]  # fmt: skip
    (fold,) = said["folds"]
    assert fold["frequency"] == pytest.approx(np.sqrt(1 + 2.25 * 0.2), rel=1e-3)
    assert (tmp_path / "duffing.png").stat().st_size > 10_000
    table = run("duffing", "--frequency", "1.3")
    assert table.stdout.count("│ 1.3") == 3
    assert "Fold at" in table.stdout


@pytest.mark.parametrize(("option", "value"), [("--frequency", "0"), ("--damping", "-1"), ("--beta", "much")])
def test_duffing_refuses_what_cannot_be(run, option, value):
    result = run("duffing", option, value)
    assert result.exit_code == 2
    assert result.stderr.startswith("quartering:")


def test_speed_of_the_figures_is_that_of_their_froude_number():
    assert speed_of(SHIP, 0.25) == pytest.approx(0.25 * np.sqrt(GRAVITY * SHIP.hull.length))

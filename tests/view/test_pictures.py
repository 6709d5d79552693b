"""What stands in the pictures: units on axes, panels, hatches where the dataset says unstable."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.contour import QuadContourSet
from matplotlib.text import Text

import quartering as qt
from quartering.hull.righting.arm import righting_polynomial
from quartering.loads.comparison import compare_forces
from quartering.stability.kind import Kind
from quartering.view.plots import style
from quartering.view.plots.forces import forces_picture
from quartering.view.plots.guidance import Diagram, guidance_picture
from quartering.view.plots.hull import hull_picture
from quartering.view.plots.polar_map import edges, polar_map
from quartering.view.plots.response import response_picture

SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length


@pytest.fixture(scope="module")
def small_map():
    waves = [qt.Wave(f * LENGTH, f * LENGTH / 50) for f in (0.7, 1.0, 1.5)]
    return qt.polar(SHIP, waves, [5.0, 8.0], np.arange(0.0, 181.0, 20.0))


def marks(figure, name):
    return [c for axes in figure.axes for c in axes.collections if c.get_gid() == name]


def texts(figure):
    return " ".join(text.get_text() for text in figure.findobj(Text))


def test_map_has_a_panel_a_speed_and_says_units_loading_and_estimates(small_map):
    figure = polar_map(small_map)
    assert sum(axes.name == "polar" for axes in figure.axes) == 2
    words, n2 = texts(figure), small_map.attrs["natural_roll_frequency"]
    for needed in ("[deg]", "following", "beam", "head", "GM 0.8128 m", "Estimated", "1/50", f"{n2:.3f} rad/s"):
        assert needed in words, needed


@pytest.mark.parametrize("columns", [2, 3])
def test_a_corner_without_a_speed_holds_the_key(columns):
    waves = [qt.Wave(f * LENGTH, f * LENGTH / 50) for f in (0.7, 1.0, 1.5)]
    figure = polar_map(qt.polar(SHIP, waves, [4.0, 5.0, 8.0], np.arange(0.0, 181.0, 20.0)), columns)
    within = any(axes.get_legend() is not None for axes in figure.axes)
    assert (within, bool(figure.legends)) == (columns == 2, columns == 3)


def test_stable_map_has_no_hatches_and_unstable_cells_are_hatched(small_map):
    assert not marks(polar_map(small_map), "unstable")
    changed = small_map.copy(deep=True)
    changed["verdict"][1, 3, 1] = int(Kind.ROLL)
    changed["verdict"][1, 4, 1] = int(Kind.COURSE_IN_CALM_WATER)
    changed["verdict"][1, 5, 1] = int(Kind.NO_ANSWER)
    figure = polar_map(changed)
    for name in ("unstable", "course", "no answer"):
        assert len(marks(figure, name)) == 2, name  # both sides of the one panel
    assert all(collection.get_hatch() for collection in marks(figure, "unstable"))
    assert {c.get_hatch() for c in marks(figure, "unstable")}.isdisjoint(c.get_hatch() for c in marks(figure, "course"))
    assert [len(c.get_paths()) for c in marks(figure, "unstable")] == [1, 1]
    words = texts(figure)
    assert "unstable: roll" in words
    assert "course-unstable even in calm water" in words
    assert "no answer" in words


def test_resonance_lines_lie_where_the_ship_meets_waves_at_its_roll_frequency(small_map):
    """Against the dataset's own encounter frequency, interpolated between its cells."""
    n2 = small_map.attrs["natural_roll_frequency"]
    axes = next(axes for axes in polar_map(small_map).axes if axes.name == "polar")
    levels = {}
    for collection in axes.collections:
        if isinstance(collection, QuadContourSet):
            theta, ratio = np.concatenate([path.vertices for path in collection.get_paths()]).T
            inside = (ratio > 0.7) & (ratio < 1.5)
            heading = xr.DataArray(np.degrees(np.abs(theta[inside])), dims="point")
            length = xr.DataArray(LENGTH * ratio[inside], dims="point")
            omega = small_map["encounter_frequency"].isel(speed=0)
            levels[float(collection.levels[0])] = np.abs(omega.interp(heading=heading, wave_length=length).values)
    assert set(levels) == {n2, 2 * n2}
    for level, met in levels.items():
        np.testing.assert_allclose(met, level, rtol=0.05)  # error of linear interpolation in this coarse map


def test_a_map_all_round_is_not_mirrored():
    waves = [qt.Wave(f * LENGTH, f * LENGTH / 50) for f in (0.7, 1.0, 1.5)]
    figure = polar_map(qt.polar(SHIP, waves, [5.0], np.arange(0.0, 360.0, 30.0)))
    assert "mirrors" not in texts(figure)
    assert "330°" in texts(figure)


def test_hull_picture_has_both_halves_and_the_tangent_gm():
    angles = np.linspace(0.0, 20.0, 5)
    fit = righting_polynomial(SHIP)
    body, arm = hull_picture(SHIP, angles, qt.righting_arm(SHIP, angles), fit).axes
    assert "[m]" in body.get_xlabel()
    assert "[m]" in body.get_ylabel()
    sides = {np.sign(line.get_xdata()[np.argmax(np.abs(line.get_xdata()))]) for line in body.lines[:-4]}
    assert sides == {-1.0, 1.0}
    assert "[deg]" in arm.get_xlabel()
    tangent = next(line for line in arm.lines if "GM" in str(line.get_label()))
    assert tangent.get_ydata()[-1] / np.radians(tangent.get_xdata()[-1]) == pytest.approx(SHIP.loading.gm)


def test_small_print_of_a_page_is_legible(small_map):
    """Typography: at least 6 pt when the figure spans the 180 mm of text of an A4 page with 15 mm margins."""
    angles = np.linspace(0.0, 60.0, 13)
    fit = righting_polynomial(SHIP)
    roll = np.full((2, 10), 10.0)
    verdict, failure = np.zeros((2, 10), dtype=np.int8), np.zeros((2, 10), dtype=bool)
    diagram = Diagram(
        "wave", np.array([5.0, 8.0]), np.linspace(0, 180, 10), roll, verdict, failure, np.full_like(roll, np.nan)
    )
    for figure in (
        polar_map(small_map, 2, style.PAGE),
        response_picture(small_map, columns=2),
        hull_picture(SHIP, angles, np.sin(np.radians(angles)), fit, style.PAGE),
        guidance_picture([diagram] * 3, 40.0),
    ):
        smallest = min(text.get_fontsize() for text in figure.findobj(Text) if text.get_text())
        assert smallest * 180.0 / 25.4 / figure.get_figwidth() > 6.0


@pytest.mark.parametrize("modes", [("sway", "roll", "yaw"), ("roll",)])
def test_forces_picture_has_a_panel_a_wave_and_mode_and_a_line_a_form(modes):
    compared = compare_forces(SHIP, SHIP.hull.length * np.array([0.5, 2.0]), np.arange(0.0, 181.0, 30.0))
    chosen = compared.sel(form=["froude-krylov", "paper", "stf"])
    figure = forces_picture(chosen, "title", "note", modes)
    assert [len(axes.lines) for axes in figure.axes] == [3] * 2 * len(modes)
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == [f"{mode}, λ/L = {ratio:g}" for ratio in (0.5, 2.0) for mode in modes]
    for axes in figure.axes:
        mode, ratio = axes.get_title().split(", λ/L = ")
        line = next(line for line in axes.lines if line.get_label() == "paper")
        wanted = chosen.amplitude.sel(form="paper", mode=mode)[0 if ratio == "0.5" else 1]
        scale = {"MN/m": 1e6, "MN m/m": 1e6}[axes.get_ylabel().split("[")[1][:-1]]
        np.testing.assert_allclose(line.get_ydata(), wanted / scale)
    dashes = {(str(line._unscaled_dash_pattern), line.get_marker()) for line in figure.axes[0].lines}
    assert len(dashes) == 3  # told apart without colour


def test_response_marks_what_is_unstable(small_map):
    assert "unstable" not in texts(response_picture(small_map))
    changed = small_map.isel(wave_length=[0]).copy(deep=True)
    changed["verdict"][0, 4, 0] = int(Kind.FOLD)
    figure = response_picture(changed)
    marked = [line for line in figure.axes[0].lines if line.get_marker() == "x"]
    assert [line.get_xdata().tolist() for line in marked] == [[80.0]]


def test_cell_edges_lie_between_centres():
    np.testing.assert_allclose(edges(np.array([1.0, 2.0, 4.0]), 1.0)[1:-1], [1.5, 3.0])


def test_response_over_heading_labels_its_axes(small_map):
    words = texts(response_picture(small_map))
    assert "largest roll over a cycle [deg]" in words
    assert "sway amplitude, fundamental [m]" in words

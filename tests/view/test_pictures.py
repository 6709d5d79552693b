"""What stands in the pictures: units on axes, panels, hatches where the dataset says unstable."""

import numpy as np
import pytest
from matplotlib.text import Text

import quartering as qt
from quartering.stability.kind import Kind
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
    words = texts(figure)
    for needed in ("[deg]", "following", "beam", "head", "GM 0.8128 m", "Estimated", "1/50", "0.467 rad/s"):
        assert needed in words, needed


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


def test_cell_edges_lie_between_centres():
    np.testing.assert_allclose(edges(np.array([1.0, 2.0, 4.0]), 1.0)[1:-1], [1.5, 3.0])


def test_response_over_heading_labels_its_axes(small_map):
    words = texts(response_picture(small_map))
    assert "roll amplitude [deg]" in words
    assert "sway amplitude [m]" in words

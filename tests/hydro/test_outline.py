"""Contours given by points: straight sides however many points lie on them, and contours that cross themselves."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.hull.lines.section import Section
from quartering.hydro.section.closefit.coefficients import close_fit, close_fit_limits
from quartering.hydro.section.dataset import section_coefficients
from quartering.hydro.section.outline import section_outline

# half breadth and depth of the corners over breadth and draught, keel to waterline
SHAPES = {
    "triangle": ([0.0, 1.0], [1.0, 0.0]),
    "box": ([0.0, 1.0, 1.0], [1.0, 1.0, 0.0]),
    "flared": ([0.0, 0.3, 1.0], [1.0, 1.0, 0.0]),
    "tumblehome": ([0.0, 1.0, 0.6], [1.0, 0.9, 0.0]),
    "hull with a tunnel": ([0.0, 0.5, 1.0], [0.4, 1.0, 0.0]),
    "bulb below a narrow neck": ([0.0, 1.0, 0.2, 0.2], [1.0, 0.7, 0.4, 0.0]),
    "wedge with sides above the water": ([0.0, 1.0, 1.2], [1.0, 0.0, -0.3]),
}


def filled(y, z, rng):
    """The polygon with 3 to 40 points on each side, at even or uneven distances."""
    parts = []
    for k in range(len(y) - 1):
        n = int(rng.integers(3, 41))
        t = np.linspace(0.0, 1.0, n) if rng.random() < 0.5 else np.sort([0.0, *rng.random(n - 2), 1.0])
        parts.append([y[k] + t * (y[k + 1] - y[k]), z[k] + t * (z[k + 1] - z[k])])
    inner = np.concatenate(parts, axis=1)
    points = np.concatenate([[[y[0]], [z[0]]], inner, [[y[-1]], [z[-1]]]], axis=1)
    return points[:, np.concatenate([[True], np.abs(np.diff(points, axis=1)).max(axis=0) > 1e-6 * max(z)])]


@pytest.mark.parametrize("name", SHAPES)
def test_straight_sides_are_accepted_however_many_points_lie_on_them(name):
    rng = np.random.default_rng(12)
    for _ in range(150):
        breadth, draught = 10.0 ** rng.uniform(-2.0, 2.0, 2)
        y, z = filled(breadth * np.array(SHAPES[name][0]), draught * np.array(SHAPES[name][1]), rng)
        outline = section_outline(Section(y, z))
        assert outline.corners[0] == 0.0
        assert not outline.submerged


@pytest.mark.parametrize("name", SHAPES)
def test_points_on_straight_sides_change_nothing(name):
    """Geometry: points on the sides of a polygon describe the same polygon as its corners."""
    rng = np.random.default_rng(7)
    y, z = 4.0 * np.array(SHAPES[name][0]), 3.0 * np.array(SHAPES[name][1])
    w = np.array([0.3, 0.8, 1.5])
    few = section_outline(Section(y, z))
    for _ in range(5):
        many = section_outline(Section(*filled(y, z, rng)))
        for modes in ("lateral", "heave"):
            a, b = (close_fit([outline], w, modes, density=1.0, panels=40) for outline in (few, many))
            for one, other in ((a.added_mass, b.added_mass), (a.damping, b.damping)):
                np.testing.assert_allclose(other, one, rtol=1e-7, atol=1e-9 * np.abs(one).max())


def test_a_wedge_of_many_points_has_the_limits_of_the_schwarz_christoffel_map():
    """Published limits of the 45 degree triangle: a33(inf) 1.188440, a22(0) 1.188440, a22(inf) 0.682980 over rho T^2."""
    t = np.linspace(0.0, 1.0, 61)
    zero, infinite, heave = close_fit_limits([section_outline(Section(t, 1.0 - t))], 1.0, panels=48)
    np.testing.assert_allclose([heave[0], zero[0, 0], infinite[0, 0]], [1.188440, 1.188440, 0.682980], rtol=3e-3)


@pytest.mark.parametrize("size", [1e-2, 1.0, 1e2])
def test_contours_that_cross_themselves_are_refused_at_any_size(size):
    rng = np.random.default_rng(3)
    for _ in range(60):
        # a side that turns back below and inside and crosses the bottom it came along
        y = np.array([0.0, 2.0, 2.0, 0.5, 0.5]) + np.append(0.0, rng.uniform(-0.1, 0.1, 4))
        z = np.array([2.0, 0.5, 1.5, 1.5, 0.0]) + np.append(rng.uniform(-0.1, 0.1, 4), 0.0)
        with pytest.raises(InputError, match="crosses itself"):
            section_outline(Section(size * y, size * z))
        with pytest.raises(InputError, match="crosses itself"):
            section_outline(Section(*filled(size * y, size * z, rng)))


def test_two_neighbouring_points_in_the_wrong_order_on_a_bend_are_refused():
    t = np.linspace(0.0, np.pi / 2.0, 40)
    order = np.arange(40)
    order[[20, 22]] = order[[22, 20]]
    circle = Section(np.sin(t)[order], np.cos(t)[order])
    with pytest.raises(InputError, match="crosses itself: the piece from"):
        section_coefficients(circle, [1.0], "close-fit")

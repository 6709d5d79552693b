"""Potentials of a hull with its image in the calm plane: closed forms, and the order of convergence."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe

from quartering.hull.file.read import ship
from quartering.hull.lines.mesh import Grid, hull_grid
from quartering.hydro.strip.double_body import double_body
from tests.tiers import mostly_soak

FINE = (40, 16)
TURN = np.linspace(0.0, np.pi / 2, 33)


def ellipsoid(a, b, c, along=30, around=12):
    """Starboard lower quarter of an ellipsoid with these half axes, ahead, abeam and down."""
    turn, girth = np.linspace(0.0, np.pi, along + 1)[:, None], np.linspace(0.0, np.pi / 2, around + 1)
    return Grid(-a * np.cos(turn[:, 0]), b * np.sin(turn) * np.sin(girth), c * np.sin(turn) * np.cos(girth))


def added_mass(grid):
    """Added mass of sway and roll over density, both sides: (limit, 2, 2) in three dimensions and by strips."""
    body = double_body(grid)
    whole = -2.0 * np.einsum("lnmi,nmj->lij", body.hull, body.velocity)
    return whole, -2.0 * np.einsum("lnmi,nmj->lij", body.sections, body.along)


def lamb(a, b, c, along):
    """Lamb's integral alpha_0, beta_0 or gamma_0 of an ellipsoid, for the half axis ``along`` (Hydrodynamics, art. 114)."""
    inside = quad(lambda u: 1 / ((along**2 + u) * np.sqrt((a * a + u) * (b * b + u) * (c * c + u))), 0, np.inf)[0]
    return a * b * c * inside


@pytest.mark.parametrize(
    ("axes", "published"),
    mostly_soak(
        [((1.0, 1.0, 1.0), 0.5), ((4.0, 1.0, 1.0), 0.860), ((10.0, 1.0, 1.0), 0.960)],
        ((4.0, 1.0, 1.0), 0.860),
        several=True,
    ),
)
def test_spheroids_abeam_carry_the_water_of_lambs_table(axes, published):
    """Lamb, Hydrodynamics, art. 115: k2 of the sphere and of prolate spheroids, given to three digits."""
    whole, _ = added_mass(ellipsoid(*axes, *FINE))
    assert whole[0, 0, 0] / (2 / 3 * np.pi * np.prod(axes)) == pytest.approx(published, abs=1.5e-3)


@pytest.mark.parametrize("axes", mostly_soak([(8.0, 1.0, 0.6), (8.0, 0.5, 0.8), (4.0, 1.0, 1.5)], (8.0, 1.0, 0.6)))
def test_ellipsoids_meet_lambs_integrals_in_sway_and_roll(axes):
    """Closed form, art. 114 and 115. Rolling about its own axis the ellipsoid's lower half and its image move as one body
    when the image is odd, the limit of infinite frequency. The polyhedron has less volume, its roll lever squared."""
    a, b, c = axes
    beta, gamma = lamb(*axes, b), lamb(*axes, c)
    sway = beta / (2 - beta)
    roll = 0.2 * (b**2 - c**2) ** 2 * (gamma - beta) / (2 * (b**2 - c**2) + (b**2 + c**2) * (beta - gamma))
    whole, _ = added_mass(ellipsoid(*axes, *FINE))
    found = whole / (2 / 3 * np.pi * a * b * c)
    assert found[0, 0, 0] == pytest.approx(sway, rel=3e-3)
    assert found[1, 1, 1] == pytest.approx(roll, rel=0.01)


def test_half_sphere_without_potential_on_the_calm_plane():
    """Hulme (1982), J. Fluid Mech. 121: surge added mass of the floating half sphere at infinite frequency, 0.2732."""
    whole, _ = added_mass(ellipsoid(1.0, 1.0, 1.0, 48, 24))
    assert whole[1, 0, 0] / (2 / 3 * np.pi) == pytest.approx(0.2732, abs=1e-3)


@pytest.mark.soak
def test_error_falls_with_the_square_of_the_panels():
    """Measured on the sphere: halving the panels both ways leaves a quarter."""
    errors = [
        abs(added_mass(ellipsoid(1.0, 1.0, 1.0, 2 * n, n))[0][0, 0, 0] / (2 / 3 * np.pi) - 0.5) for n in (6, 12, 24)
    ]
    order = np.log2(errors[0] / errors[2]) / 2
    assert 1.4 < order < 2.6, errors


@pytest.mark.parametrize("breadth", mostly_soak([0.1, 0.02, 0.002], 0.1, 0.002))
def test_thin_bodies_are_no_harder_than_thick_ones(breadth):
    """Lamb's integral for an ellipsoid, and its limit for a plate, 1/E of the strips' pi c^2: to 1 % at 1/400 of breadth."""
    a, c = 10.0, 0.8
    beta = lamb(a, breadth, c, breadth)
    exact = beta / (2 - beta) * breadth / c if breadth > 0.01 else 1 / ellipe(1 - (c / a) ** 2)
    whole, strips = added_mass(ellipsoid(a, breadth, c, *FINE))
    assert whole[0, 0, 0] / strips[0, 0, 0] == pytest.approx(exact, rel=0.01)


@pytest.mark.parametrize("name", ["series60-cb60", "wigley", "dtmb5415"])
def test_sway_force_of_roll_is_the_roll_moment_of_sway(name):
    """Green's theorem; to discretisation, over the geometric mean of the diagonal terms."""
    whole, _ = added_mass(hull_grid(ship(name).hull, 30, 12))
    for matrix in whole:
        assert abs(matrix[0, 1] - matrix[1, 0]) < 0.005 * np.sqrt(matrix[0, 0] * matrix[1, 1])


def test_sections_in_the_plane_meet_the_half_circle():
    """Closed form: rho pi r^2/2 under a rigid lid, 4/pi^2 of that where the potential vanishes; no roll moment."""
    _, strips = added_mass(Grid(np.array([0.0, 1.0]), *(np.tile(f(TURN), (2, 1)) for f in (np.sin, np.cos))))
    assert strips[:, 0, 0] / (np.pi / 2) == pytest.approx([1.0, 4 / np.pi**2], rel=2e-3)
    assert np.abs(strips[:, 1, 1]).max() < 1e-12
